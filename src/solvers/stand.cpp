// Islands in which nothing moves: forces that hold them up, if their contacts can bear them (docs/theory/softstep.md).

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"
#include "threads/parallel.hpp"

namespace carom {

namespace {

/// A direction in which a point of a contact holds, as a spring does.
struct Prop {
    IslandRow row;
    double limit;      ///< largest force, of a normal force of 1
    double stiffness;  ///< if it holds at all
    double before;     ///< what it bore so far [N], of rolling [N m]
    double force = 0;  ///< that it bears, likewise
};
struct Support {
    SoftContact* contact;
    int point;
    double mass;  ///< effective, along the normal [kg]
    Prop normal, slip, roll;
    bool is_closed = true;
    int opened = 0;  ///< so many times
};

/// An island on the springs of its points, which begin with what these bore and else without a load: of the many ways
/// in which forces may be in balance it is one that came about without wedging anything. Points that would have to pull
/// let go, and who would have to rub harder than Coulomb's law allows gives way, until the others bear what they can.
/// These forces are then in balance and within their cones: nothing has a reason to move.
class Statics {
  public:
    Statics(const SoftScene& scene, const SoftContacts& contacts, const Scratch<std::uint32_t>& rows)
        : contacts_(contacts), bodies_(scene.bodies, rows), v_(bodies_.size()) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::uint32_t row = rows[i];
            double* free = &bodies_.free[3 * i];
            const Motion& acceleration = contacts.rates.acceleration;
            free[0] = acceleration.linear[row].x, free[1] = acceleration.linear[row].y;
            free[2] = acceleration.angular[row];
        }
        fastest_ = fastest(bodies_.free);
    }

    /// Adds the points at which a contact is closed, between the bodies at these places of the island: they touch, or
    /// press on one another by a preload, as near as that holds them.
    void add(SoftContact& c, std::uint32_t place_a, std::uint32_t place_b) {
        const Vec2 x_a = contacts_.frames[c.a].position, x_b = contacts_.frames[c.b].position, n = c.manifold.normal;
        constexpr double of_size = 1e-12, of_places = 16 * std::numeric_limits<double>::epsilon();
        const double farthest = std::max({std::abs(x_a.x), std::abs(x_a.y), std::abs(x_b.x), std::abs(x_b.y)});
        const bool is_elsewhere = is_put_down(c.a, place_a) || is_put_down(c.b, place_b);
        for (int i = 0; i < c.manifold.count; ++i) {
            const bool presses = !is_elsewhere && c.preload[i] > 0 && c.normal_force[i] > 0;
            if (!presses && c.manifold.point[i].gap > of_size * c.size + of_places * farthest) continue;
            const auto [lever_a, lever_b] = levers(c, c.manifold, i, x_b - x_a);
            const auto push = [&, &a = lever_a, &b = lever_b](Vec2 along) {
                return IslandRow::push(place_a, place_b, along, a, b);
            };
            const Prop normal = prop(push(n), 1, c.normal_force[i]);
            supports_.push_back({&c, i, normal.stiffness, normal,
                                 prop(push(perpendicular(n)), c.friction, c.tangent_force[i]),
                                 prop(IslandRow::turn(place_a, place_b), c.rolling, c.rolling_moment[i])});
            if (place_a != no_place && place_b != no_place) couplings_.emplace_back(place_a, place_b);
        }
    }

    /// False if there are none, or none were found.
    bool find_forces() {
        constexpr int most_rounds = 60, most_in_vain = 15, few = 2, many = 30;
        constexpr double collapses = 1e-3, hardly_less = 0.5;
        if (!(fastest_ > 0)) return false;  // without a load nothing has to be held
        matrix_.analyse(bodies_.size() / 3, couplings_);
        double part = 0.5;
        std::size_t fewest = supports_.size() + 1;
        for (int i = 0, in_vain = 0; i < most_rounds && in_vain < most_in_vain; ++i) {
            factor();
            balance(few);
            const bool falls = fastest(v_) > std::max(collapses * fastest_, hardly_less * fastest(bent_));
            const std::size_t over = count_over();
            if (!falls) in_vain = over < fewest ? 0 : in_vain + 1;
            if (!falls) fewest = std::min(fewest, over);
            if (over == 0 && !falls && balance(many) && count_over() == 0) return true;
            const bool closes = give_way(part, falls);
            if (falls && !closes) return false;
            if (falls) part = (1 + part) / 2;
        }
        return false;
    }

    /// Whether it explains every overlap, in substeps of h [s].
    bool explains_overlaps(double h) const {
        const double give = softness(h).give;
        return std::all_of(supports_.begin(), supports_.end(), [&](const Support& s) {
            const double force = std::max(s.normal.force, s.contact->normal_force[s.point]);
            return -s.contact->manifold.point[s.point].gap <=
                   explained_overlap(spring_depth(*s.contact), give * force / s.mass);
        });
    }

    /// How fast these bodies move [m/s] as no spring hinders, in their places by threes: what rolls or slides freely.
    double moves_freely(Scratch<double> velocities) {
        for (std::size_t k = 0; k < v_.size(); ++k) velocities[k] *= bodies_.mass[k];
        matrix_.solve(velocities);
        return fastest(velocities);
    }

    /// Products of blocks so far.
    std::size_t work() const { return work_; }

    /// Overlaps stay as they are: what a spring bears more than before it bears by its preload. Never less than by
    /// its overlap alone: that would be another way to overlap by more each time.
    void write_forces() const {
        for (const Support& s : supports_) {
            SoftContact& c = *s.contact;
            double& preload = c.preload[s.point];
            preload = std::max(preload + (s.normal.force - c.normal_force[s.point]), 0.0);
            c.normal_force[s.point] = s.normal.force, c.tangent_force[s.point] = s.slip.force;
            c.rolling_moment[s.point] = s.roll.force;
            c.touched = c.touched || s.normal.force > 0;
        }
    }

  private:
    static constexpr double rounding = 1e-12, finest = 1e-14;
    static constexpr double stiff = 1e6;  ///< springs, in masses

    Prop prop(const IslandRow& row, double limit, double before) const {
        double inverse_mass = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (row.a != no_place) inverse_mass += row.on_a[i] * row.on_a[i] / bodies_.mass[3 * row.a + i];
            if (row.b != no_place) inverse_mass += row.on_b[i] * row.on_b[i] / bodies_.mass[3 * row.b + i];
        }
        return {row, limit, limit > 0 && inverse_mass > 0 ? 1 / inverse_mass : 0, before};
    }

    /// Of bodies that hold others up nobody notes how long they have been at rest.
    bool is_put_down(std::uint32_t row, std::uint32_t place) const {
        return place != no_place && contacts_.still[row] == put_down;
    }

    template <class Work>
    void each_prop(Work work) {
        for (Support& s : supports_)
            for (Prop* p : {&s.normal, &s.slip, &s.roll})
                if (s.is_closed && p->stiffness > 0) work(*p);
    }

    /// Turning counts by the radius of gyration.
    double fastest(const Scratch<double>& v) const {
        double most = 0;
        for (std::size_t i = 0; i < v.size(); ++i) {
            const double arm = i % 3 == 2 ? std::sqrt(bodies_.mass[i] / bodies_.mass[i - 1]) : 1;
            most = std::max(most, v[i] == 0 ? 0 : arm * std::abs(v[i]));
        }
        return most;
    }

    void factor() {
        bodies_.weigh(matrix_);
        each_prop([&](Prop& p) { p.row.couple(stiff * p.stiffness, matrix_), p.force = p.before; });
        matrix_.factor();
        work_ += matrix_.work_per_row() * bodies_.size() / 3;
        bent_.clear();
    }

    /// The forces of the springs, by the method of multipliers: what springs that are `stiff` times as stiff as masses
    /// leave of the accelerations, the next round takes up. Whether they balance then.
    bool balance(int most_rounds) {
        Scratch<double> left(v_.size()), size(v_.size());
        for (int i = 0; i < most_rounds; ++i) {
            for (std::size_t k = 0; k < v_.size(); ++k) {
                left[k] = bodies_.mass[k] * bodies_.free[k];
                size[k] = std::abs(left[k]);
            }
            each_prop([&](const Prop& p) { p.row.push(p.force, left), p.row.add_sizes(p.force, size); });
            const bool is_first = bent_.empty(), is_last = i + 1 == most_rounds;
            if (!is_first && is_small(left, size, is_last ? rounding : finest)) return true;
            v_ = left;
            matrix_.solve(v_);
            if (is_first) bent_ = v_;
            each_prop([&](Prop& p) { p.force -= stiff * p.stiffness * p.row.speed(v_); });
        }
        return false;
    }

    /// Whether what is left of the forces on each body is this part of their sizes. Torques have the rounding of
    /// forces, too.
    bool is_small(const Scratch<double>& left, const Scratch<double>& size, double part) const {
        for (std::size_t i = 0; i < left.size(); i += 3) {
            const double forces = part * (size[i] + size[i + 1]);
            const double torques = part * size[i + 2] + std::sqrt(bodies_.mass[i + 2] / bodies_.mass[i]) * forces;
            if (!(std::abs(left[i]) <= forces && std::abs(left[i + 1]) <= forces && std::abs(left[i + 2]) <= torques))
                return false;
        }
        return true;
    }

    /// What a point that bears no more than this [m/s²] of its mass bears is nothing.
    double nothing() const { return rounding * fastest_; }
    bool pulls(const Support& s) const { return s.normal.force <= nothing() * s.mass; }
    static bool is_over(const Support& s, const Prop& p) { return std::abs(p.force) > p.limit * s.normal.force; }
    /// How many points would have to do what they can not.
    std::size_t count_over() const {
        return static_cast<std::size_t>(std::count_if(supports_.begin(), supports_.end(), [this](const Support& s) {
            return s.is_closed && (pulls(s) || is_over(s, s.slip) || is_over(s, s.roll));
        }));
    }

    /// Points that pull open, those that bodies go into where the springs give way close, and who bears more than he
    /// can gives way. Of what pulls or closes the most goes first: with it much of the rest is over. Who has opened so
    /// often closes only where all falls without. Whether somebody closed.
    bool give_way(double part, bool falls) {
        constexpr double eased = 0.8;
        constexpr int often = 3;
        const double no_way = rounding * fastest(bent_);
        double most_pull = 0, most_near = 0;
        for (const Support& s : supports_)
            if (s.is_closed)
                most_pull = std::max(most_pull, -s.normal.force / s.mass);
            else
                most_near = std::max(most_near, -s.normal.row.speed(bent_));
        bool closes = false;
        for (Support& s : supports_) {
            if (!s.is_closed) {
                if (!(falls || s.opened < often)) continue;
                if (-s.normal.row.speed(bent_) > std::max(no_way, part * most_near)) s.is_closed = closes = true;
            } else if (pulls(s)) {
                const double pull = -s.normal.force / s.mass;
                if (pull > nothing() && pull < part * most_pull) continue;
                s.is_closed = false, ++s.opened;
                for (Prop* p : {&s.normal, &s.slip, &s.roll}) p->force = p->before = 0;
            } else {
                for (Prop* p : {&s.slip, &s.roll}) {
                    if (!is_over(s, *p)) continue;
                    const double share = eased * p->limit * s.normal.force / std::abs(p->force);
                    p->stiffness *= std::max(share, rounding), p->before *= std::max(share, rounding);
                }
            }
        }
        return closes;
    }

    const SoftContacts& contacts_;
    IslandBodies bodies_;
    Scratch<double> v_;     ///< accelerations that the springs leave, three numbers a body
    Scratch<double> bent_;  ///< by how much they give way, likewise
    double fastest_ = 0;
    Scratch<Support> supports_;
    Scratch<std::pair<std::uint32_t, std::uint32_t>> couplings_;
    BlockMatrix<3> matrix_;
    std::size_t work_ = 0;
};

/// An island that leans on something, and of which nobody moves, or hardly.
struct Still {
    Scratch<std::uint32_t> bodies, contacts;
    bool stands = false;
    std::size_t work = 0;
};

/// What is known of an island.
struct Sight {
    bool stirs = false;   ///< something may move it at any time
    bool moves = false;   ///< somebody does, however slowly
    bool is_new = false;  ///< some were put there, and did not come to rest by themselves
    bool is_calm = true;  ///< all have been slow for a while
    bool is_still = true;

    /// Whether it is worth looking at: bodies that are to stay where they were put, or that hardly move any more.
    bool is_worth(bool sleeps) const { return !stirs && (moves ? sleeps && is_calm && !is_still : is_new); }
};

/// Whether any body is new or calm: where all move nothing else is looked at.
bool any_may_stand(const SoftScene& scene, const SoftContacts& contacts) {
    bool any = false;
    each_row_looked_at(contacts, [&](std::size_t i) {
        const bool may = contacts.still[i] == put_down || contacts.calm[i] >= time_to_sleep;
        any = any || (may && moves(scene, static_cast<std::uint32_t>(i)));
    });
    return any;
}

/// By the first body of an island.
Scratch<Sight> look_at_islands(const SoftScene& scene, const Scratch<std::uint32_t>& first, const State& state,
                               const SoftContacts& contacts) {
    Scratch<Sight> islands(first.size());
    each_row_looked_at(contacts, [&](std::size_t row) {
        const auto i = static_cast<std::uint32_t>(row);
        if (!moves(scene, i)) return;
        Sight& island = islands[first[i]];
        island.stirs = island.stirs || !scene.may_rest[i] || scene.mechanisms.holds[i];
        island.moves = island.moves || state.v.linear[i] != Vec2{} || state.v.angular[i] != 0;
        island.is_new = island.is_new || contacts.still[i] == put_down;
        island.is_calm = island.is_calm && contacts.calm[i] >= time_to_sleep;
        island.is_still = island.is_still && contacts.still[i] >= time_to_sleep;
    });
    return islands;
}

/// Those that are worth looking at and lean on something, by the first body of each.
Scratch<std::uint32_t> number_still(const SoftScene& scene, const Scratch<std::uint32_t>& first, Scratch<Sight> sights,
                                    const SoftContacts& contacts, Scratch<Still>& islands) {
    const auto is_worth = [&](const Sight& s) { return s.is_worth(scene.sleeps); };
    Scratch<std::uint32_t> number(first.size(), no_place);
    if (std::none_of(sights.begin(), sights.end(), is_worth)) return number;
    for (std::size_t i = 0; i < contacts.all.size(); ++i)
        if (Sight& sight = sights[first_of(scene, first, contacts.ends[i])]; is_worth(sight))
            sight.stirs = keeps_awake(scene, contacts.all[i]);
    for (const ContactEnds& c : contacts.ends) {
        const std::uint32_t f = first_of(scene, first, c);
        if (!is_worth(sights[f]) || number[f] != no_place || (moves(scene, c.a) && moves(scene, c.b))) continue;
        number[f] = static_cast<std::uint32_t>(islands.size());
        islands.emplace_back();
    }
    return number;
}

/// Those islands with their bodies and contacts; and the place of each body in its own.
Scratch<Still> find_still(const SoftScene& scene, const Scratch<std::uint32_t>& first, const State& state,
                          const SoftContacts& contacts, Scratch<std::uint32_t>& place) {
    Scratch<Still> islands;
    const Scratch<std::uint32_t> number =
        number_still(scene, first, look_at_islands(scene, first, state, contacts), contacts, islands);
    if (islands.empty()) return islands;
    const auto each_row = [&](const auto& act) { each_row_looked_at(contacts, act); };
    list_islands(scene, first, number, contacts, each_row, islands, place);
    // What a large one costs is to be earned back before the next is looked at.
    constexpr std::size_t small = 500, most = 10000;  // bodies
    std::erase_if(islands,
                  [&](const Still& island) { return island.bodies.size() > (contacts.owed > 0 ? small : most); });
    return islands;
}

Scratch<double> velocities(const Still& island, const State& state) {
    Scratch<double> v;
    for (const std::uint32_t row : island.bodies)
        for (const double speed : {state.v.linear[row].x, state.v.linear[row].y, state.v.angular[row]})
            v.push_back(speed);
    return v;
}

}  // namespace

void earn(SoftContacts& contacts) {
    constexpr double earned = 30;  // products of blocks a contact
    const auto all = static_cast<double>(contacts.warm.size() + contacts.warm_at_rest.size());
    contacts.owed = std::max(contacts.owed - earned * all, 0.0);
}

void find_standing(const SoftScene& scene, const Scratch<std::uint32_t>& first, double dt, double h, const State& state,
                   SoftContacts& contacts) {
    if (!scene.statics || contacts.midway || !any_may_stand(scene, contacts)) return;
    Scratch<std::uint32_t> place(contacts.movers.size(), no_place);
    Scratch<Still> islands = find_still(scene, first, state, contacts, place);
    if (islands.empty()) return;
    State& at_rest = contacts.proposed;  // storage, of which every substep writes what moves
    at_rest = state;
    std::fill(at_rest.v.linear.begin(), at_rest.v.linear.end(), Vec2{});
    std::fill(at_rest.v.angular.begin(), at_rest.v.angular.end(), 0.0);
    scene.flight.dynamics.evaluate(at_rest, contacts.rates, nullptr);
    parallel_ranges(scene.threads, islands.size(), 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t k = from; k < to; ++k) {
            Still& island = islands[k];
            Statics statics(scene, contacts, island.bodies);
            for (const std::uint32_t i : island.contacts) {
                SoftContact& c = contacts.all[i];
                statics.add(c, place[c.a], place[c.b]);
            }
            const bool is_new = std::any_of(island.bodies.begin(), island.bodies.end(),
                                            [&](std::uint32_t row) { return contacts.still[row] == put_down; });
            island.stands = statics.find_forces() && (!is_new || statics.explains_overlaps(h)) &&
                            statics.moves_freely(velocities(island, state)) <= speed_at_rest(scene, dt);
            island.work = statics.work();
            if (island.stands) statics.write_forces();
        }
    });
    for (const Still& island : islands) {
        contacts.owed += static_cast<double>(island.work);
        for (const std::uint32_t row : island.bodies)
            island.stands ? contacts.still[row] = stands : contacts.calm[row] = 0;
    }
}

}  // namespace carom
