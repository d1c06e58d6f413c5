// The precise solve of an island: Newton's method on the velocities of its bodies.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/secants.hpp"
#include "solvers/interior_point.hpp"
#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/newton_points.hpp"

namespace carom {

namespace {

using namespace newton;

/// min ½ |v − v̂|²_M + Σ ½ w (t − J v)₊² + Huber's function of the tangential speeds: the impulses are its slopes. It is
/// convex (Castro, Permenter, Han, arXiv 2110.10107), and Newton's method with an exact line search finds its minimum;
/// the bounds of friction follow the normal impulses from solve to solve, until Coulomb's law holds. The compliance 1 /
/// w is small, and what it gives way is taken back by starting from the impulses of the substep before, as in the
/// method of multipliers.
class Newton {
  public:
    Newton(Island& island, const PreciseIslands& islands, const SoftScene& scene, const std::vector<Mover>& free,
           const Aim& aim, SoftContacts& contacts)
        : island_(island),
          bodies_(scene.bodies, island.bodies),
          at_rest_(velocities_at_rest(island, islands, contacts)),
          v_(bodies_.size()),
          next_(bodies_.size()) {
        for (std::size_t i = 0; i < island.bodies.size(); ++i) {
            const Mover m = without_contacts(island, free, contacts, island.bodies[i]);
            double* v = &bodies_.free[3 * i];
            v[0] = m.vx, v[1] = m.vy, v[2] = m.w;
            const double* ground = &at_rest_[3 * i];
            island.fastest = std::max({island.fastest, std::abs(m.vx - ground[0]), std::abs(m.vy - ground[1])});
        }
        for (const std::uint32_t k : island.mechanisms)
            for (const Mechanism::Part& p : scene.mechanisms.all[k].parts)
                if (const std::uint32_t place = islands.place_of(p.row); place != no_place)
                    bodies_.slow_down(place, p.slow);
        for (const std::uint32_t row : island.bodies) heaviest_ = std::max(heaviest_, scene.bodies.mass[row]);
        unbound_ = bodies_.free;
        std::fill(next_.begin(), next_.end(), 0.0);
        for (const std::uint32_t k : island.mechanisms)
            tie(scene.mechanisms.all[k], islands, aim, contacts.motion.movers);
        if (!bodies_.ties.empty()) bind();
        points_.reserve(2 * island.contacts.size());
        for (const std::uint32_t index : island.contacts) add_points(contacts.all[index], islands, aim, contacts);
        if (!bodies_.ties.empty()) leave_to_joints();
        forget_blows();
    }

    /// What has changed little is found at once; else an interior point finds what pushes and slides, and comes near
    /// enough where Newton's method then does not get to rounding.
    bool run() {
        start();
        stiffen();
        // Among few the way through the sets is short, and keeps symmetries to rounding. Where many slide the bounds of
        // friction settle slowly: these have to be nearly at rest.
        constexpr std::size_t few = 3 * 20;
        if (minimise(bodies_.size() <= few ? 100 : 8)) return take();
        if (is_slow() && minimise(40) && is_slow()) return take();
        if (!find_inside()) return false;
        // What rests is found again at once in the steps to come, so that only others took long. Who was not found in a
        // substep is not in the next ones.
        if (!island_.took_long && is_slow() && minimise(200)) return take();
        island_.took_long = true;
        for_each_direction([](Direction& d) { d.given = d.inside; });
        return true;
    }

    /// Whether points push against one another by way of joints, which hold bodies inside one another, or one against
    /// two corners of another. Any such push fits; once there is one it stays and grows, and throws whoever comes free.
    /// It is more than a load could be, and without the others would move by far more than what moves: what a lever
    /// bears is more, too, but moves little.
    bool is_jammed() const {
        if (bodies_.ties.empty()) return false;
        constexpr double much = 10, far = 1000;  // times the momentum, and the energy, that there is
        const double hard = much * bodies_.whole_mass() * bodies_.fastest(unbound_);
        double moving = 0;
        for (std::size_t i = 0; i < v_.size(); ++i)
            moving += unbound_[i] == 0 ? 0 : 0.5 * bodies_.mass[i] * unbound_[i] * unbound_[i];
        return std::any_of(points_.begin(), points_.end(), [=](const Point& p) {
            return p.normal.given > hard && 0.5 * p.normal.given * p.normal.given * p.normal.ease > far * moving;
        });
    }

    /// Whether points press as hard as they are stiff and still are not kept, as between a floor and what is driven
    /// against it: nothing solves that, and the least slope among such forces throws whoever is between them; or what
    /// solves it throws them, as a stone is pinched out of a cherry: they may sink in instead.
    bool is_pressed_without_end() const {
        constexpr double kept = 0.25, much = 100, thrown = 10;
        double wanted = 0, of_all = 0;  // those in a row part at the sum of it
        for (const Point& p : points_)
            if (p.normal.given > 0)
                wanted = std::max(wanted, p.normal.wanted), of_all += std::max(p.normal.wanted, 0.0);
        if (wanted == 0) return false;  // to rest solves it
        const double moving = std::max(wanted, bodies_.fastest_rim(bodies_.free));
        if (bodies_.fastest_rim(v_) > std::max(of_all, thrown * moving)) return true;
        const double missed = kept * wanted / static_cast<double>(island_.bodies.size() + 1),
                     hard = much * std::max(bodies_.whole_mass() * wanted, bodies_.momentum(bodies_.free));
        return std::any_of(points_.begin(), points_.end(), [&](const Point& p) {
            return p.normal.given > hard && p.normal.wanted - p.normal.row.speed(v_) > missed;
        });
    }

    /// Sweeps from point to point in place of Newton's method. Each takes energy, however little they agree.
    void sweep() {
        for_each_direction([](Direction& d) { d.given = 0; });
        sweep_on(0);
    }

    void write(std::vector<Mover>& movers) const {
        Scratch<double> given(bodies_.size(), 0.0);
        for (const Point& p : points_) {
            *p.normal.impulse = p.normal.given;
            p.normal.row.push(p.normal.given, given);
            for (const Friction& f : p.all_friction()) {
                *f.impulse = f.given;
                f.row.push(f.given, given);
            }
        }
        for (std::size_t i = 0; i < island_.bodies.size(); ++i) {
            Mover& m = movers[island_.bodies[i]];
            const double *mass = &bodies_.mass[3 * i], *v = &unbound_[3 * i], *impulse = &given[3 * i];
            const double* slow = &bodies_.slow[3 * i];
            m.vx = (v[0] + impulse[0] / mass[0]) / slow[0];
            m.vy = (v[1] + impulse[1] / mass[1]) / slow[1];
            m.w = (mass[2] < unturnable ? v[2] + impulse[2] / mass[2] : v[2]) / slow[2];
        }
    }

  private:
    template <class Work>
    void for_each_direction(Work work) {
        for (Point& p : points_) {
            work(p.normal);
            for (Friction& f : p.all_friction()) work(f);
        }
    }

    bool take() {
        for (Point& p : points_) {
            p.normal.given = p.normal.impulse_at(p.normal.speed);
            for (Friction& f : p.all_friction()) f.given = f.impulse_at(f.speed);
        }
        // Sweeps make one body alone right to rounding, and soon: stiffness has made impulses of that of speeds, and
        // what did not give way before does so a little.
        constexpr double rounding = 1e-12;
        if (island_.bodies.size() == 1 && bodies_.ties.empty()) sweep_on(rounding);
        return true;
    }
    /// Sweeps from the impulses given so far, until they change by no more than this part of the largest one.
    void sweep_on(double enough) {
        constexpr int sweeps = 30;
        Scratch<double> given(bodies_.size(), 0.0);
        for_each_direction([&](const Direction& d) { d.row.push(d.given, given); });
        for (std::size_t i = 0; i < v_.size(); ++i) v_[i] = unbound_[i] + given[i] / bodies_.mass[i];
        double change = HUGE_VAL, most = 0;
        for (int i = 0; i < sweeps && change > enough * most; ++i) {
            change = most = 0;
            const auto set = [&](Direction& d, double impulse) {
                change = std::max(change, std::abs(impulse - d.given) / d.arm);
                most = std::max(most, std::abs(impulse) / d.arm);
                give(d, impulse);
            };
            for (Point& p : points_) {
                set(p.normal, std::max(0.0, p.normal.given + missing(p.normal)));
                for (Friction& f : p.all_friction()) {
                    f.bound = f.coefficient * p.normal.given;
                    set(f, std::clamp(f.given + missing(f), -f.bound, f.bound));
                }
            }
        }
    }
    double missing(const Direction& d) const { return d.mass * (d.wanted - d.row.speed(v_)); }
    void give(Direction& d, double impulse) {
        const auto push = [&](std::uint32_t place, const double* on) {
            for (std::size_t i = 0; i < 3 && place != no_place; ++i)
                v_[3 * place + i] += on[i] * (impulse - d.given) / bodies_.mass[3 * place + i];
        };
        push(d.row.a, d.row.on_a), push(d.row.b, d.row.on_b);
        d.given = impulse;
    }

    /// Guesses that what pushed does so again, or what approaches, and that nothing slides.
    void start() {
        v_ = bodies_.free;
        for (Point& p : points_) {
            p.normal.closed = p.normal.warm > 0 || p.normal.wanted > p.normal.row.speed(v_);
            for (Friction& f : p.all_friction()) {
                f.bound = f.coefficient * p.normal.warm;
                f.slides = f.bound > 0 ? 0 : 1;
            }
        }
    }
    void stiffen() {
        for_each_direction([&](Direction& d) {
            d.stiffen(heaviest_);
            d.speed = d.row.speed(v_);
        });
    }

    /// The solution by an interior point, and what pushes and slides in it.
    bool find_inside() {
        InteriorPoint inside(bodies_, island_.matrix);
        for (const Point& p : points_) {
            const Friction &slip = p.friction[0], &roll = p.friction[1];
            inside.add({p.normal.row, slip.row, roll.row, p.normal.mass, slip.coefficient, roll.coefficient,
                        p.normal.wanted, slip.wanted, roll.wanted});
        }
        if (!inside.solve()) return false;
        v_ = inside.velocities();
        for_each_direction([&](Direction& d) { d.speed = d.row.speed(v_); });
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const auto [normal, slip, roll] = inside.impulse(i);
            points_[i].normal.inside = normal;
            points_[i].friction[0].inside = slip, points_[i].friction[1].inside = roll;
            points_[i].guess_sets();
        }
        return true;
    }

    /// Whether the contacts leave little of the velocities without them, as what holds the island sees it.
    bool is_slow() const {
        constexpr double little_left = 0.05;
        return fastest(v_) <= little_left * fastest(bodies_.free);
    }
    double fastest(const Scratch<double>& v) const {
        Scratch<double> seen = v;
        for (std::size_t i = 0; i < v.size(); ++i) seen[i] -= at_rest_[i];
        return bodies_.fastest(seen);
    }

    /// Newton's method, with bounds of friction that follow to rounding. False where it is not balanced by Coulomb's
    /// law.
    bool minimise(int most) {
        constexpr int enough = 40;
        Secants secants;
        int moves = 0;
        for (int i = 0; i < most; ++i) {
            minimise_as_if_sets_stayed();
            const double length = search_line();
            const bool stays = take_step(length);
            if (!stays && !balanced() && !(i > 0 && length < 1e-10)) continue;
            if (moves == enough) break;
            if (!move_bounds(moves++, secants)) return balanced();
        }
        for (Point& p : points_)
            for (Friction& f : p.all_friction()) f.bound = p.bound_of(f);
        return balanced();
    }

    void add_points(const SoftContact& c, const PreciseIslands& islands, const Aim& aim, SoftContacts& contacts) {
        ContactBlock& block = contacts.layout.blocks[c.block];
        const std::uint32_t k = c.row;
        const Mover &a = contacts.motion.movers[c.a], &b = contacts.motion.movers[c.b];
        const std::uint32_t place_a = islands.place_of(c.a), place_b = islands.place_of(c.b);
        const Vec2 n{block.normal_x[k], block.normal_y[k]};
        for (int i = 0; i < static_cast<int>(block.points); ++i) {
            auto& p = block.point[i];
            auto& more = block.more[i];
            if (!c.is_solved[i]) continue;
            const Vec2 lever_a = lever_a_of(block, i, k), lever_b = lever_b_of(block, i, k);
            const auto direction = [&](IslandRow row, double mass, double wanted, double force, double arm = 1) {
                row.locate(island_.matrix);
                if (row.a == no_place) wanted -= row.held_speed(a, false);
                if (row.b == no_place) wanted -= row.held_speed(b, true);
                return Direction{row, mass, wanted, aim.share * aim.lasting * force, arm};
            };
            const IslandRow push = IslandRow::push(place_a, place_b, n, lever_a, lever_b);
            const IslandRow rub = IslandRow::push(place_a, place_b, perpendicular(n), lever_a, lever_b);
            const Direction normal =
                direction(push, p.normal_mass[k], speed_apart(block, i, k, aim), more.normal_force[k]);
            const Direction slip = direction(rub, p.tangent_mass[k], speed_of_slip(block, i, k), more.tangent_force[k]);
            const Direction roll = direction(IslandRow::turn(place_a, place_b), block.rolling_mass[k], 0,
                                             more.rolling_moment[k], block.rolling[k]);
            points_.push_back(
                {{normal, &p.normal_impulse[k]},
                 {{slip, block.friction[k], &p.tangent_impulse[k]}, {roll, block.rolling[k], &more.rolling_impulse[k]}},
                 block.rolling[k] > 0 ? 2 : 1});
        }
    }

    /// Rigid joints hold while contacts push. What they bear is found by their own solve, which follows.
    void tie(const Mechanism& m, const PreciseIslands& islands, const Aim& aim, const std::vector<Mover>& movers) {
        constexpr double compliance = 1e-6;
        double turned_hardest = 0;  // kg m²
        for (std::size_t i = 2; i < bodies_.size(); i += 3)
            if (bodies_.mass[i] < unturnable) turned_hardest = std::max(turned_hardest, bodies_.mass[i]);
        for (const Member& k : m.members)
            for (std::uint32_t r = 0; r < k.rigid; ++r) {
                const JointLine& line = m.lines[k.line + r];
                const JointRow& row = aim.recovers ? line.first : line.last;
                IslandRow on{islands.place_of(m.parts[k.a].row), islands.place_of(m.parts[k.b].row), {}, {}};
                std::copy(row.a, row.a + 3, on.on_a), std::copy(row.b, row.b + 3, on.on_b);
                on.locate(island_.matrix);
                const double mass = (line.law->turns ? turned_hardest : heaviest_) / compliance;
                double speed = aim.recovers ? (line.aim - line.first.error) / aim.h : 0;
                if (on.a == no_place) speed -= on.held_speed(movers[m.parts[k.a].row], false);
                if (on.b == no_place) speed -= on.held_speed(movers[m.parts[k.b].row], true);
                on.push(mass * (speed - on.speed(unbound_)), next_);
                bodies_.ties.push_back({on, mass});
            }
    }
    /// The free velocities become those with which joints hold.
    void bind() {
        bodies_.weigh(island_.matrix);
        island_.matrix.factor();
        island_.matrix.solve(next_);
        for (std::size_t i = 0; i < v_.size(); ++i) bodies_.free[i] += next_[i];
    }

    /// Drops the points of those whom joints hold as they are, whatever they push: it would be more in each substep.
    void leave_to_joints() {
        constexpr double least = 1e-3;  // of what would move if all did
        const double mass = bodies_.whole_mass();
        std::erase_if(points_, [&](Point& p) {
            std::fill(next_.begin(), next_.end(), 0.0);
            p.normal.row.push(1, next_);
            island_.matrix.solve(next_);
            p.normal.ease = p.normal.row.speed(next_);
            if (p.normal.ease * mass >= least) return false;
            *p.normal.impulse = 0;
            for (Friction& f : p.all_friction()) *f.impulse = 0;
            return true;
        });
    }

    /// Begins with no impulses where some are those of a blow, and not of what presses: light bodies that a heavy one
    /// struck would throw it up again, and what friction wedges between two that joints hold together would go on for
    /// ever, for it presses nobody anywhere.
    void forget_blows() {
        constexpr double much = 10;  // times what all would give that moves
        const double hard = much * bodies_.whole_mass() * bodies_.fastest(bodies_.free);
        if (std::any_of(points_.begin(), points_.end(), [hard](const Point& p) { return p.normal.warm > hard; }))
            for_each_direction([](Direction& d) { d.warm = 0; });
    }

    void couple(const Direction& d) {
        d.row.couple(d.weight, island_.matrix);
        d.row.push(d.weight * (d.target - d.speed), next_);
    }

    /// By what the velocities change, and not for these themselves: what is solved for has a rounding of its own size.
    void minimise_as_if_sets_stayed() {
        bodies_.weigh(island_.matrix);
        bodies_.lack(v_, next_);
        for (const Point& p : points_) {
            if (p.normal.closed) couple(p.normal);
            for (const Friction& f : p.all_friction())
                f.slides != 0 ? f.row.push(f.slides * f.bound, next_) : couple(f);
        }
        island_.matrix.factor();
        island_.matrix.solve(next_);
        for (std::size_t i = 0; i < v_.size(); ++i) next_[i] += v_[i];
    }

    /// The slope of what is minimised, this far along the step.
    double slope(double length) const {
        Scratch<double> there(v_.size()), lack(v_.size());
        for (std::size_t i = 0; i < v_.size(); ++i) there[i] = v_[i] + length * (next_[i] - v_[i]);
        bodies_.lack(there, lack);
        double sum = 0;
        for (std::size_t i = 0; i < v_.size(); ++i) sum -= lack[i] * (next_[i] - v_[i]);
        for (const Point& p : points_) {
            const auto downwards = [length](const auto& d) {
                return d.impulse_at(d.speed + length * d.change) * d.change;
            };
            sum -= downwards(p.normal);
            for (const Friction& f : p.all_friction()) sum -= downwards(f);
        }
        return sum;
    }
    /// Where the slope, which grows from line to line, is none: by the Illinois way of false position.
    double search_line() {
        constexpr double rounding = 1e-12;
        for_each_direction([&](Direction& d) { d.change = d.row.speed(next_) - d.speed; });
        double low = 0, high = 1, down = slope(0), up = slope(1);
        const double none = -rounding * down;
        // The step goes down, but for rounding: then it is as good as none, and is taken.
        if (down >= 0 || up <= none) return 1;
        for (int i = 0, side = 0; i < 40; ++i) {
            const double length = low + (high - low) * down / (down - up), there = slope(length);
            if (std::abs(there) <= none) return length;
            if (there > 0)
                high = length, up = there, down *= std::exchange(side, 1) == 1 ? 0.5 : 1;
            else
                low = length, down = there, up *= std::exchange(side, -1) == -1 ? 0.5 : 1;
        }
        return high;
    }

    /// Whether the sets of those that push and slide are what the whole step took them for.
    bool take_step(double length) {
        bool stays = length == 1;
        for (std::size_t i = 0; i < v_.size(); ++i)
            v_[i] = length == 1 ? next_[i] : v_[i] + length * (next_[i] - v_[i]);
        for_each_direction([&](Direction& d) { d.speed = d.row.speed(v_); });
        for (Point& p : points_) {
            const bool closed = p.normal.target > p.normal.speed;
            stays = stays && closed == p.normal.closed;
            p.normal.closed = closed;
            for (Friction& f : p.all_friction()) {
                const int slides = f.sliding();
                stays = stays && slides == f.slides;
                f.slides = slides;
            }
        }
        return stays;
    }

    /// Whether the impulses are those that change the free velocities into these, to rounding.
    bool balanced() const {
        constexpr double tolerance = 1e-9;
        Scratch<double> given(v_.size(), 0.0);
        for (const Point& p : points_) {
            p.normal.row.push(p.normal.impulse_at(p.normal.speed), given);
            for (const Friction& f : p.all_friction()) f.row.push(f.impulse_at(f.speed), given);
        }
        return bodies_.imbalance(v_, given) <= tolerance;
    }

    /// Towards Coulomb's bounds for the normal impulses of now; false if they are those already, or to the rounding of
    /// speeds. To take just these is soon done where bounds hardly change what presses, and else need not end: what
    /// brakes a wedge under a load presses the two together. Secants know how much the moves before did so.
    bool move_bounds(int moves, Secants& secants) {
        constexpr double tolerance = 1e-9;
        constexpr int plain = 2;
        const double rounding = moves < plain ? 0 : 4 * std::numeric_limits<double>::epsilon() * bodies_.fastest(v_);
        double most = 0, worst = 0;
        Scratch<double> missing;
        for (const Point& p : points_)
            for (const Friction& f : p.all_friction()) {
                const double wanted = p.bound_of(f);
                missing.push_back((wanted - f.bound) / f.arm);
                most = std::max(most, wanted / f.arm);
                worst = std::max(worst, std::abs(missing.back()) - f.coefficient * p.normal.weight * rounding / f.arm);
            }
        if (worst <= tolerance * most) return false;
        Scratch<double> step = missing;
        if (moves >= plain) secants.improve(missing.data(), step.data(), step.size());
        auto next = step.begin();
        for (Point& p : points_)
            for (Friction& f : p.all_friction()) {
                const double bound = f.bound + f.arm * *next++;
                f.bound = bound > 0 && bound < HUGE_VAL ? bound : 0;  // steps that hardly differ may lead nowhere
                f.slides = f.sliding();
            }
        return true;
    }

    Island& island_;
    double heaviest_ = 0;  ///< of its bodies [kg]
    IslandBodies bodies_;
    Scratch<double> at_rest_;   ///< velocities of what rests on what holds it
    Scratch<double> unbound_;   ///< velocities without contacts, whatever joints make of it
    Scratch<double> v_, next_;  ///< three numbers a body
    Scratch<Point> points_;
};

/// Notes which points may press. At the end of a substep nothing is asked of those that did not touch in it, where the
/// next one will end at the instant at which they do.
void note_solved(const Island& island, const Aim& aim, SoftContacts& contacts) {
    constexpr double touching = 1e-9;  // of the size
    const bool awaits = are_foreseen(contacts);
    for (const std::uint32_t index : island.contacts) {
        SoftContact& c = contacts.all[index];
        const ContactBlock& block = contacts.layout.blocks[c.block];
        for (int i = 0; i < static_cast<int>(block.points); ++i) {
            const auto& p = block.point[i];
            const auto& more = block.more[i];
            const bool touched = aim.recovers || !awaits || p.normal_impulse[c.row] > 0 || more.normal_force[c.row] > 0;
            c.is_solved[i] = more.open[c.row] == 0 && (touched || p.gap[c.row] <= touching * c.size);
        }
    }
}

}  // namespace

void solve_precisely(Island& island, const PreciseIslands& islands, const SoftScene& scene,
                     const std::vector<Mover>& free, const Aim& aim, SoftContacts& contacts) {
    note_solved(island, aim, contacts);
    if (take_warm_solution(island, islands, free, aim, contacts)) return;
    Newton newton(island, islands, scene, free, aim, contacts);
    // What hardly holds is not moved as its masses say.
    const bool is_sound = std::all_of(island.mechanisms.begin(), island.mechanisms.end(),
                                      [&](std::uint32_t k) { return !scene.mechanisms.all[k].is_projected; });
    const auto fails = [&newton] { return !newton.run() || newton.is_jammed() || newton.is_pressed_without_end(); };
    island.gave_up = island.gave_up || (is_sound && fails());
    if (island.gave_up || !is_sound) newton.sweep();
    newton.write(contacts.motion.movers);
}

}  // namespace carom
