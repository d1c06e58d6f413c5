// Instants at which the forces of a few contacts change at once: friction has stopped a slip, or who leans on something
// lands on something else. A substep ends there, for its forces are those of all of it.

#include <optional>

#include "forces/dynamics.hpp"
#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/passage.hpp"

namespace carom {

namespace {

/// How bodies go on in the next h [s] whose few contacts are solved precisely.
class Prospect {
  public:
    Prospect(const PreciseIslands& islands, const SoftScene& scene, State& state, SoftContacts& contacts, double h)
        : islands_(islands), scene_(scene), state_(state), contacts_(contacts), h_(h) {}

    /// Whether it is known what acts on the two of a contact: of what joints give it is not.
    bool knows(const SoftContact& c) const {
        const auto is_joined = [&](std::uint32_t row) { return moves(scene_, row) && scene_.mechanisms.holds[row]; };
        return islands_.hold(c) && !is_joined(c.a) && !is_joined(c.b);
    }
    double spin(std::uint32_t row) const { return row < state_.size() ? state_.v.angular[row] : 0; }
    /// What forces and contacts do to a body just now; and what its curve does to a driven one, in the mean.
    Twist acceleration(std::uint32_t row) {
        if (!moves(scene_, row)) return row < state_.size() ? of_curve(row) : Twist{};
        Twist all = of_forces(row);
        for (const SoftContact& c : contacts_.all)
            if (c.a == row || c.b == row) add(c, row, all);
        return all;
    }
    /// Whether its two come together by more than the slowest that may land.
    bool moves_on(const SoftContact& c) const {
        return closing_speed(state_, c.a, c.b, contacts_) * h_ > slow * c.size;
    }
    /// Whether something bore one of the two in the substep before.
    bool leans(const SoftContact& c) const {
        const auto is_borne = [&](std::uint32_t row) {
            const auto bears = [&](const SoftContact& other) {
                const ContactBlock& block = contacts_.layout.blocks[other.block];
                double force = 0;
                for (std::uint32_t i = 0; i < block.points; ++i) force += block.more[i].normal_force[other.row];
                return (other.a == row || other.b == row) && force > 0;
            };
            return moves(scene_, row) && std::any_of(contacts_.all.begin(), contacts_.all.end(), bears);
        };
        return is_borne(c.a) || is_borne(c.b);
    }
    /// Of a point by its lever, where its body moves so, or is accelerated so.
    static Vec2 of_point(const Twist& body, Vec2 lever) { return body.velocity + cross(body.angular_velocity, lever); }
    /// When the two of a contact touch with another point; h if they do not before.
    double touching(const SoftContact& c);

  private:
    static constexpr double slow = 1e-6;  ///< of the size in a substep

    Twist of_curve(std::uint32_t row) {
        const Dynamics& dynamics = scene_.flight.dynamics;
        if (!dynamics.places()) return {};
        if (!end_) {
            end_ = state_, end_->time += h_;
            dynamics.place_driven(*end_);
        }
        const Motion &before = state_.v, &after = end_->v;
        return {(1 / h_) * (after.linear[row] - before.linear[row]), (after.angular[row] - before.angular[row]) / h_};
    }
    Twist of_forces(std::uint32_t row) {
        const Dynamics& dynamics = scene_.flight.dynamics;
        if (dynamics.is_free_flight()) return {dynamics.gravity(), 0};
        if (!is_evaluated_) dynamics.evaluate(state_, contacts_.motion.rates);
        is_evaluated_ = true;
        const Motion& a = contacts_.motion.rates.acceleration;
        return {a.linear[row], a.angular[row]};
    }
    /// By the forces that it bore in the substep before.
    void add(const SoftContact& c, std::uint32_t row, Twist& all) const {
        const ContactBlock& block = contacts_.layout.blocks[c.block];
        const std::uint32_t k = c.row;
        const Vec2 n{block.normal_x[k], block.normal_y[k]};
        const double sign = row == c.a ? -1 : 1;
        for (int i = 0; i < c.manifold.count; ++i) {
            const auto& more = block.more[i];
            const Vec2 force = sign * (more.normal_force[k] * n + more.tangent_force[k] * perpendicular(n));
            const Vec2 lever = row == c.a ? lever_a_of(block, i, k) : lever_b_of(block, i, k);
            all.velocity += scene_.bodies.inverse_mass[row] * force;
            all.angular_velocity +=
                scene_.bodies.inverse_inertia[row] * (cross(lever, force) + sign * more.rolling_moment[k]);
        }
    }

    const PreciseIslands& islands_;
    const SoftScene& scene_;
    State& state_;
    SoftContacts& contacts_;
    double h_;
    std::optional<State> end_;  ///< with those in their places then whom curves drive
    bool is_evaluated_ = false;
};

double Prospect::touching(const SoftContact& c) {
    constexpr double anywhere = 1e300;
    constexpr double grazes = 0.999;  // of the radii: the way past a corner
    const Frame &a = contacts_.motion.frames[c.a], &b = contacts_.motion.frames[c.b];
    const Vec2 between = b.position - a.position;
    const Manifold m = look(scene_, c.candidate(), a, b, anywhere);
    double first = h_;
    for (int k = 0; k < m.count; ++k) {
        const auto [lever_a, lever_b] = levers(c, m, k, between);
        const Vec2 v = velocity_at(state_, c.b, lever_b) - velocity_at(state_, c.a, lever_a);
        const double gap = std::max(m.point[k].gap, 0.0), rate = dot(v, m.normal);
        if (-rate * h_ <= std::max(slow * c.size, 0.5 * gap)) continue;
        const auto of_core = [&](std::uint32_t row, Vec2 core) {
            return of_point(acceleration(row), core) - spin(row) * spin(row) * core;
        };
        const Vec2 bends = of_core(c.b, m.point[k].core_b) - of_core(c.a, core_a_of(c.at_wall, m, k, between));
        Gap now{gap, rate, dot(bends, m.normal)};
        if (rounds_a_corner(m, c.radius_a, c.radius_b)) {
            const double radii = c.radius_a + c.radius_b, across = std::abs(cross(m.normal, v));
            if ((radii + gap) * across > grazes * radii * length(v)) continue;
            now.acceleration += across * across / (radii + gap);  // the normal turns
        }
        if (const auto closes = now.closes()) first = std::min(first, *closes);
    }
    return first;
}

/// Whether friction does all it can against a momentum that is more than what solves leave of one at rest, and more
/// than it stops alone in a millionth of a substep.
bool resists(double friction, double most, double momentum, double h) {
    constexpr double rounding = 1e-6;
    return friction * momentum < 0 && std::abs(friction) >= (1 - rounding) * most &&
           std::abs(momentum) > rounding * h * std::abs(friction);
}

/// When friction has stopped the first slip or roll, of the next h [s]; h if it stops none, or as good as at once.
double until_slip_ends(Prospect& prospect, const State& state, const SoftContacts& contacts, double h) {
    constexpr double at_once = 1e-4;  // of h: what is left out by that is its square
    double first = h;
    const auto end_at = [&](double slip, double rate) {
        const double time = slip * rate < 0 ? -slip / rate : h;
        if (time > at_once * h && time < (1 - at_once) * h) first = std::min(first, time);
    };
    for (const SoftContact& c : contacts.all) {
        if (!prospect.knows(c)) continue;
        const ContactBlock& block = contacts.layout.blocks[c.block];
        const std::uint32_t k = c.row;
        const Vec2 t = perpendicular(Vec2{block.normal_x[k], block.normal_y[k]});
        std::optional<std::array<Twist, 2>> rates;
        for (int i = 0; i < c.manifold.count; ++i) {
            const auto& more = block.more[i];
            const double pressed = more.normal_force[k];
            const Vec2 lever_a = lever_a_of(block, i, k), lever_b = lever_b_of(block, i, k);
            const double slip =
                dot(velocity_at(state, c.b, lever_b) - velocity_at(state, c.a, lever_a), t) - block.surface_speed[k];
            const double roll = prospect.spin(c.b) - prospect.spin(c.a);
            const bool slides =
                resists(more.tangent_force[k], block.friction[k] * pressed, block.point[i].tangent_mass[k] * slip, h);
            const bool rolls =
                resists(more.rolling_moment[k], block.rolling[k] * pressed, block.rolling_mass[k] * roll, h);
            if (!slides && !rolls) continue;
            if (!rates) rates = {prospect.acceleration(c.a), prospect.acceleration(c.b)};
            const auto& [a, b] = *rates;
            if (slides) end_at(slip, dot(Prospect::of_point(b, lever_b) - Prospect::of_point(a, lever_a), t));
            if (rolls) end_at(roll, b.angular_velocity - a.angular_velocity);
        }
    }
    return first;
}

/// When one of the bodies that lean on something touches something else, or with another corner, of the next h [s]; h
/// if none does, or as good as at once. It is to be struck there, however gently. Where so many do that their parts
/// would be shorter than the least [s] several strike in one.
double await_landing(Prospect& prospect, SoftContacts& contacts, double h, double least) {
    constexpr double at_once = 2e-3;  // of h
    constexpr double just = 0.97;     // before it: ways of what turns are foreseen to a per cent
    struct Landing {
        std::uint32_t contact;
        double time;
    };
    Scratch<Landing> landings;
    const auto let_strike = [&](std::uint32_t i) {
        SoftContact& c = contacts.all[i];
        if (c.rests) return;  // with its other point: the solve of the two is as good as a blow
        if (!may_strike(c)) contacts.lists.strikers.push_back(i);
        c.lands = true;
    };
    for (std::uint32_t i = 0; i < contacts.all.size(); ++i) {
        const SoftContact& c = contacts.all[i];
        if (!prospect.moves_on(c) || !prospect.knows(c) || !prospect.leans(c)) continue;
        if (const double time = prospect.touching(c); time < h) landings.push_back({i, time});
    }
    // Who passes more corners of a chain than there are parts left strikes several in one. Going straight on he would
    // meet up to twice as many as he does.
    const bool are_many = static_cast<double>(landings.size()) * least > 1.5 * h;
    const double part = are_many ? least : at_once * h;
    double first = h;
    std::uint32_t lands = 0;
    bool lands_within = false;
    for (const auto& [contact, time] : landings) {
        lands_within = lands_within || (time > at_once * h && time <= part);
        if (time <= part)
            let_strike(contact);
        else if (time < first)
            first = std::max(just * time, at_once * h), lands = contact;
    }
    if (lands_within) return part;
    if (first < h) let_strike(lands);
    return first;
}

}  // namespace

double await_change(const PreciseIslands& islands, const SoftScene& scene, State& state, SoftContacts& contacts,
                    double h, double least) {
    if (islands.all.empty() || !are_foreseen(contacts)) return h;
    Prospect prospect(islands, scene, state, contacts, h);
    return std::min(until_slip_ends(prospect, state, contacts, h), await_landing(prospect, contacts, h, least));
}

}  // namespace carom
