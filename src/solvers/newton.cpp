// The precise solve of an island: Newton's method on the velocities of its bodies.

#include <algorithm>
#include <cmath>
#include <span>

#include "solvers/islands.hpp"

namespace carom {

namespace {

/// A row of the Jacobian: what (v, ω) of a and of b are multiplied with.
struct Jacobian {
    double a[3], b[3];

    static Jacobian push(Vec2 along, Vec2 lever_a, Vec2 lever_b) {
        return {{-along.x, -along.y, -cross(lever_a, along)}, {along.x, along.y, cross(lever_b, along)}};
    }
    static Jacobian turn() { return {{0, 0, -1}, {0, 0, 1}}; }
    double held_speed(const Mover& m, bool of_b) const {
        const double* j = of_b ? b : a;
        return j[0] * m.vx + j[1] * m.vy + j[2] * m.w;
    }
};

/// A direction in which a contact point pushes: impulse = weight (target − speed), within bounds.
struct Direction {
    Jacobian jacobian;
    double mass, wanted;  ///< effective mass, and the speed that is wanted
    double warm;          ///< impulse that the force before gives
    double arm;           ///< by which turning is compared with what moves [m]; else 1
    double weight = 0, target = 0;
    double speed = 0, change = 0;  ///< at the velocities of now, and along the step that Newton's method makes
    double given = 0;              ///< impulse that was found

    /// Between light ones the heaviest may have to be borne: they are as stiff as if one were a part of its mass.
    void stiffen(double compliance, double heaviest, bool from_warm) {
        constexpr double lightest = 1e-4;
        weight = std::max(mass, lightest * heaviest * arm * arm) / compliance;
        target = wanted + (from_warm ? warm / weight : 0);
    }
};

/// One that pushes only.
struct Normal : Direction {
    double* impulse;
    bool closed = false;  ///< pushes

    double impulse_at(double v) const { return std::max(0.0, weight * (target - v)); }
};
/// Friction of sliding or of rolling.
struct Friction : Direction {
    double coefficient;
    double* impulse;
    double bound = 0;  ///< largest impulse
    int slides = 0;    ///< the sign of the impulse at its bound

    double impulse_at(double v) const { return std::clamp(weight * (target - v), -bound, bound); }
    int sliding() const {
        const double sticking = weight * (target - speed);
        return sticking >= bound ? 1 : sticking <= -bound ? -1 : 0;
    }
};

struct Point {
    std::uint32_t a, b;  ///< places in the island, or no_place
    Normal normal;
    Friction friction[2];  ///< of sliding, and of rolling
    int frictions;

    std::span<Friction> all_friction() { return {friction, static_cast<std::size_t>(frictions)}; }
    std::span<const Friction> all_friction() const { return {friction, static_cast<std::size_t>(frictions)}; }
};

/// min ½ |v − v̂|²_M + Σ ½ w (t − J v)₊² + Huber's function of the tangential speeds: the impulses are its slopes. It is
/// convex (Castro, Permenter, Han, arXiv 2110.10107), and Newton's method with an exact line search finds its minimum;
/// the bound of friction follows the normal impulses from solve to solve. The compliance 1 / w is small, and what it
/// gives way is taken back by starting from the impulses of the substep before, as in the method of multipliers.
class Newton {
  public:
    Newton(Island& island, const PreciseIslands& islands, const SoftScene& scene, const std::vector<Mover>& free,
           const Aim& aim, SoftContacts& contacts)
        : island_(island), n_(3 * island.bodies.size()), mass_(n_), free_(n_), v_(n_), next_(n_) {
        constexpr double unturnable = 1e300;
        for (std::size_t i = 0; i < island.bodies.size(); ++i) {
            const std::uint32_t row = island.bodies[i];
            mass_[3 * i] = mass_[3 * i + 1] = scene.bodies.mass[row];
            mass_[3 * i + 2] = scene.bodies.inverse_inertia[row] > 0 ? scene.bodies.inertia[row] : unturnable;
            free_[3 * i] = free[row].vx, free_[3 * i + 1] = free[row].vy, free_[3 * i + 2] = free[row].w;
        }
        for (const std::uint32_t row : island.bodies) heaviest_ = std::max(heaviest_, scene.bodies.mass[row]);
        for (const std::uint32_t index : island.contacts) add_points(contacts.all[index], islands, aim, contacts);
    }

    /// What has changed little is found at once; else what pushes and slides is found by contacts that stiffen.
    bool run() {
        if (rests()) return true;
        start(true);
        stiffen(compliance, true);
        if (minimise(8, 1e-9)) return take();
        start(false);
        stiffen(1e4 * compliance, false);
        minimise(40, 1e-2);
        stiffen(1e2 * compliance, false);
        minimise(40, 1e-2);
        stiffen(compliance, true);
        return minimise(100, 1e-9) && take();
    }

    /// Sweeps from point to point in place of Newton's method. Each takes energy, however little they agree.
    void sweep() {
        constexpr int sweeps = 30;
        v_ = free_;
        for_each_direction([](const Point&, Direction& d) { d.given = 0; });
        for (int i = 0; i < sweeps; ++i)
            for (Point& p : points_) {
                give(p, p.normal, std::max(0.0, p.normal.given + missing(p, p.normal)));
                for (Friction& f : p.all_friction()) {
                    f.bound = f.coefficient * p.normal.given;
                    give(p, f, std::clamp(f.given + missing(p, f), -f.bound, f.bound));
                }
            }
    }

    void write(std::vector<Mover>& movers) const {
        Scratch<double> given(n_, 0.0);
        for (const Point& p : points_) {
            *p.normal.impulse = p.normal.given;
            push(p, p.normal, p.normal.given, given);
            for (const Friction& f : p.all_friction()) {
                *f.impulse = f.given;
                push(p, f, f.given, given);
            }
        }
        for (std::size_t i = 0; i < island_.bodies.size(); ++i) {
            Mover& m = movers[island_.bodies[i]];
            m.vx = free_[3 * i] + given[3 * i] / mass_[3 * i];
            m.vy = free_[3 * i + 1] + given[3 * i + 1] / mass_[3 * i + 1];
            m.w = free_[3 * i + 2] + given[3 * i + 2] / mass_[3 * i + 2];
        }
    }

  private:
    static constexpr double compliance = 1e-6;  ///< of the inverse effective mass

    template <class Work>
    void for_each_direction(Work work) {
        for (Point& p : points_) {
            work(p, p.normal);
            for (Friction& f : p.all_friction()) work(p, f);
        }
    }

    bool take() {
        for (Point& p : points_) {
            p.normal.given = p.normal.impulse_at(p.normal.speed);
            for (Friction& f : p.all_friction()) f.given = f.impulse_at(f.speed);
        }
        return true;
    }
    double missing(const Point& p, const Direction& d) const { return d.mass * (d.wanted - speed(p, d, v_)); }
    void give(const Point& p, Direction& d, double impulse) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (p.a != no_place) v_[3 * p.a + i] += d.jacobian.a[i] * (impulse - d.given) / mass_[3 * p.a + i];
            if (p.b != no_place) v_[3 * p.b + i] += d.jacobian.b[i] * (impulse - d.given) / mass_[3 * p.b + i];
        }
        d.given = impulse;
    }

    /// Whether the impulses that the forces before give are the solution still, as those of bodies at rest are: then
    /// these are taken.
    bool rests() {
        constexpr double rounding = 1e-10;  // of velocities, and of places by which gaps are closed
        Scratch<double> given(n_, 0.0);
        double fastest = 0;
        for_each_direction([&](const Point& p, Direction& d) { push(p, d, d.given = d.warm, given); });
        for (std::size_t i = 0; i < n_; ++i) {
            v_[i] = free_[i] + given[i] / mass_[i];
            if (i % 3 != 2) fastest = std::max(fastest, std::abs(free_[i]));
        }
        const auto stays = [&](const Point& p) {
            const auto lacks = [&](const Direction& d) { return d.arm * (d.wanted - speed(p, d, v_)); };
            const auto sticks = [&](const Friction& f) {
                const double bound = f.coefficient * p.normal.warm;
                return bound == 0 ? f.warm == 0 : std::abs(f.warm) < bound && std::abs(lacks(f)) <= rounding * fastest;
            };
            const double lack = lacks(p.normal);
            return (p.normal.warm > 0 ? std::abs(lack) : lack) <= rounding * fastest &&
                   std::all_of(p.all_friction().begin(), p.all_friction().end(), sticks);
        };
        return std::all_of(points_.begin(), points_.end(), stays);
    }

    /// Guesses that what pushed does so again, or what approaches, and that nothing slides.
    void start(bool from_warm) {
        v_ = free_;
        for (Point& p : points_) {
            p.normal.closed = (from_warm && p.normal.warm > 0) || p.normal.wanted > speed(p, p.normal, v_);
            for (Friction& f : p.all_friction()) {
                f.bound = from_warm ? f.coefficient * p.normal.warm : 0;
                f.slides = f.bound > 0 ? 0 : 1;
            }
        }
    }
    void stiffen(double to, bool from_warm) {
        for_each_direction([&](const Point& p, Direction& d) {
            d.stiffen(to, heaviest_, from_warm);
            d.speed = speed(p, d, v_);
        });
    }
    /// Newton's method, with bounds of friction that follow to so much of themselves.
    bool minimise(int most, double tolerance) {
        constexpr int enough = 10;
        int bounds = 0;
        for (int i = 0; i < most; ++i) {
            minimise_as_if_sets_stayed();
            const double length = search_line();
            const bool stays = take_step(length);
            if (!stays && !balanced() && !(i > 0 && length < 1e-10)) continue;
            if (bounds++ == enough || !move_bounds(tolerance)) return balanced(1e-6);
        }
        return balanced(1e-6);
    }

    void add_points(const SoftContact& c, const PreciseIslands& islands, const Aim& aim, SoftContacts& contacts) {
        // Of an overlap in a substep, and of the speed that sweeps may undo it with: where bodies are jammed not every
        // overlap can be undone at once, and rigid contacts that ask for it throw light bodies about.
        constexpr double recovered = 0.2, slower = 0.05;
        ContactBlock& block = contacts.blocks[c.block];
        const std::uint32_t k = c.row;
        const Mover &a = contacts.movers[c.a], &b = contacts.movers[c.b];
        const auto place = [&](std::uint32_t row) {
            return row < islands.place.size() ? islands.place[row] : no_place;
        };
        const Vec2 n{block.normal_x[k], block.normal_y[k]};
        for (int i = 0; i < static_cast<int>(block.points); ++i) {
            auto& p = block.point[i];
            auto& more = block.more[i];
            if (more.open[k] != 0) continue;
            const Vec2 lever_a = lever_a_of(block, i, k), lever_b = lever_b_of(block, i, k);
            const double gap = p.gap[k];
            const double bias = gap > 0        ? gap / aim.h
                                : aim.recovers ? std::max(gap * recovered / aim.h, -slower * block.recovery[k])
                                               : 0;
            const auto direction = [&](const Jacobian& j, double mass, double wanted, double force, double arm = 1) {
                if (place(c.a) == no_place) wanted -= j.held_speed(a, false);
                if (place(c.b) == no_place) wanted -= j.held_speed(b, true);
                return Direction{j, mass, wanted, aim.share * aim.h * force, arm};
            };
            const Jacobian push = Jacobian::push(n, lever_a, lever_b);
            const Jacobian rub = Jacobian::push(perpendicular(n), lever_a, lever_b);
            const Direction normal = direction(push, p.normal_mass[k], -bias, more.normal_force[k]);
            const Direction slip = direction(rub, p.tangent_mass[k], block.surface_speed[k], more.tangent_force[k]);
            const Direction roll =
                direction(Jacobian::turn(), block.rolling_mass[k], 0, more.rolling_moment[k], block.rolling[k]);
            points_.push_back(
                {place(c.a),
                 place(c.b),
                 {normal, &p.normal_impulse[k]},
                 {{slip, block.friction[k], &p.tangent_impulse[k]}, {roll, block.rolling[k], &more.rolling_impulse[k]}},
                 block.rolling[k] > 0 ? 2 : 1});
        }
    }

    static double speed(const Point& p, const Direction& d, const Scratch<double>& v) {
        double s = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (p.a != no_place) s += d.jacobian.a[i] * v[3 * p.a + i];
            if (p.b != no_place) s += d.jacobian.b[i] * v[3 * p.b + i];
        }
        return s;
    }
    static void push(const Point& p, const Direction& d, double impulse, Scratch<double>& to) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (p.a != no_place) to[3 * p.a + i] += d.jacobian.a[i] * impulse;
            if (p.b != no_place) to[3 * p.b + i] += d.jacobian.b[i] * impulse;
        }
    }
    void couple(const Point& p, const Direction& d) {
        const auto& [a, b] = d.jacobian;
        if (p.a != no_place) island_.matrix.add(p.a, p.a, d.weight, a, a);
        if (p.b != no_place) island_.matrix.add(p.b, p.b, d.weight, b, b);
        if (p.a != no_place && p.b != no_place) island_.matrix.add(p.a, p.b, d.weight, a, b);
        push(p, d, d.weight * (d.target - d.speed), next_);
    }

    /// By what the velocities change, and not for these themselves: what is solved for has a rounding of its own size.
    void minimise_as_if_sets_stayed() {
        island_.matrix.clear();
        for (std::size_t i = 0; i < n_; ++i) {
            island_.matrix.diagonal(static_cast<std::uint32_t>(i / 3)).at[i % 3][i % 3] = mass_[i];
            next_[i] = mass_[i] * (free_[i] - v_[i]);
        }
        for (const Point& p : points_) {
            if (p.normal.closed) couple(p, p.normal);
            for (const Friction& f : p.all_friction())
                f.slides != 0 ? push(p, f, f.slides * f.bound, next_) : couple(p, f);
        }
        island_.matrix.factor();
        island_.matrix.solve(next_);
        for (std::size_t i = 0; i < n_; ++i) next_[i] += v_[i];
    }

    /// The slope of what is minimised, this far along the step.
    double slope(double length) const {
        double sum = 0;
        for (std::size_t i = 0; i < n_; ++i)
            sum += mass_[i] * (v_[i] + length * (next_[i] - v_[i]) - free_[i]) * (next_[i] - v_[i]);
        for (const Point& p : points_) {
            const auto downwards = [length](const auto& d) {
                return d.impulse_at(d.speed + length * d.change) * d.change;
            };
            sum -= downwards(p.normal);
            for (const Friction& f : p.all_friction()) sum -= downwards(f);
        }
        return sum;
    }
    double search_line() {
        for_each_direction([&](const Point& p, Direction& d) { d.change = speed(p, d, next_) - d.speed; });
        // The step goes down, but for rounding: then it is as good as none, and is taken.
        if (slope(0) >= 0 || slope(1) <= 0) return 1;
        double low = 0, high = 1;
        for (int i = 0; i < 40; ++i) {
            const double middle = 0.5 * (low + high);
            (slope(middle) > 0 ? high : low) = middle;
        }
        return high;
    }

    /// Whether the sets of those that push and slide are what the whole step took them for.
    bool take_step(double length) {
        bool stays = length == 1;
        for (std::size_t i = 0; i < n_; ++i) v_[i] = length == 1 ? next_[i] : v_[i] + length * (next_[i] - v_[i]);
        for_each_direction([&](const Point& p, Direction& d) { d.speed = speed(p, d, v_); });
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
    bool balanced(double tolerance = 1e-9) const {
        Scratch<double> left(n_, 0.0);
        double most = 0, worst = 0;
        for (const Point& p : points_) {
            push(p, p.normal, p.normal.impulse_at(p.normal.speed), left);
            for (const Friction& f : p.all_friction()) push(p, f, f.impulse_at(f.speed), left);
        }
        for (std::size_t i = 0; i < n_; ++i) {
            const double arm = i % 3 == 2 ? std::sqrt(mass_[i] / mass_[i - 1]) : 1;  // radius of gyration
            most = std::max(most, (std::abs(left[i]) + std::abs(mass_[i] * free_[i])) / arm);
            worst = std::max(worst, std::abs(mass_[i] * (v_[i] - free_[i]) - left[i]) / arm);
        }
        return worst <= tolerance * most;
    }

    /// Coulomb's bounds for the normal impulses of now; false if they are those already.
    bool move_bounds(double tolerance) {
        double most = 0, worst = 0;
        for (Point& p : points_)
            for (Friction& f : p.all_friction()) {
                const double bound = f.coefficient * p.normal.impulse_at(p.normal.speed);
                if (f.arm > 0)
                    worst = std::max(worst, std::abs(bound - f.bound) / f.arm), most = std::max(most, bound / f.arm);
                f.bound = bound;
            }
        if (worst <= tolerance * most) return false;
        for (Point& p : points_)
            for (Friction& f : p.all_friction()) f.slides = f.sliding();
        return true;
    }

    Island& island_;
    double heaviest_ = 0;  ///< of its bodies [kg]
    std::size_t n_;
    Scratch<double> mass_, free_, v_, next_;  ///< three numbers a body
    Scratch<Point> points_;
};

}  // namespace

void solve_precisely(Island& island, const PreciseIslands& islands, const SoftScene& scene,
                     const std::vector<Mover>& free, const Aim& aim, SoftContacts& contacts) {
    Newton newton(island, islands, scene, free, aim, contacts);
    island.gave_up = island.gave_up || !newton.run();
    if (island.gave_up) newton.sweep();
    newton.write(contacts.movers);
}

}  // namespace carom
