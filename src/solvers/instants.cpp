// Instants at which the forces of a few contacts change at once: friction has stopped a slip, or who leans on something
// lands on something else. A substep ends there, for its forces are those of all of it.

#include <optional>

#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/passage.hpp"

namespace carom {

namespace {

/// What a few contacts and the forces do to a body just now.
class Accelerations {
  public:
    Accelerations(const SoftScene& scene, State& state, SoftContacts& contacts)
        : scene_(scene), state_(state), contacts_(contacts) {}

    Twist of(std::uint32_t row) {
        if (!moves(scene_, row)) return {};
        Twist all = of_forces(row);
        for (const SoftContact& c : contacts_.all)
            if (c.a == row || c.b == row) add(c, row, all);
        return all;
    }

  private:
    Twist of_forces(std::uint32_t row) {
        const Dynamics& dynamics = scene_.flight.dynamics;
        if (dynamics.is_free_flight()) return {dynamics.gravity(), 0};
        if (!is_evaluated_) dynamics.evaluate(state_, contacts_.rates);
        is_evaluated_ = true;
        const Motion& a = contacts_.rates.acceleration;
        return {a.linear[row], a.angular[row]};
    }
    /// By the forces that it bore in the substep before.
    void add(const SoftContact& c, std::uint32_t row, Twist& all) const {
        const ContactBlock& block = contacts_.blocks[c.block];
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

    const SoftScene& scene_;
    State& state_;
    SoftContacts& contacts_;
    bool is_evaluated_ = false;
};

/// Whether friction does all it can against a momentum that is more than what solves leave of one at rest, and more
/// than it stops alone in a millionth of a substep.
bool resists(double friction, double most, double momentum, double h) {
    constexpr double rounding = 1e-6;
    return friction * momentum < 0 && std::abs(friction) >= (1 - rounding) * most &&
           std::abs(momentum) > rounding * h * std::abs(friction);
}

/// Few enough for each to be asked when it changes.
constexpr std::size_t few = 20;

bool is_joined(const SoftScene& scene, std::uint32_t row) { return moves(scene, row) && scene.mechanisms.holds[row]; }
/// Whether it is known what acts on the two of a contact: of what joints give it is not known here.
bool is_foreseeable(const SoftContact& c, const PreciseIslands& islands, const SoftScene& scene) {
    return islands.hold(c) && !is_joined(scene, c.a) && !is_joined(scene, c.b);
}

double turning(const State& state, std::uint32_t row) { return row < state.size() ? state.v.angular[row] : 0; }
Vec2 at(const Twist& twist, Vec2 lever) { return twist.velocity + cross(twist.angular_velocity, lever); }

/// Whether a body that moves was borne by something in the substep before.
bool leans(const SoftScene& scene, const SoftContacts& contacts, std::uint32_t row) {
    const auto bears = [&](const SoftContact& c) {
        const ContactBlock& block = contacts.blocks[c.block];
        return (c.a == row || c.b == row) && std::max(block.more[0].normal_force[c.row],
                                                      c.manifold.count > 1 ? block.more[1].normal_force[c.row] : 0) > 0;
    };
    return moves(scene, row) && std::any_of(contacts.all.begin(), contacts.all.end(), bears);
}

/// When the two of a contact touch with another point, as they go on now; h [s] if they do not before.
double touching(const SoftScene& scene, const State& state, const SoftContacts& contacts, const SoftContact& c,
                double h, Accelerations& accelerations) {
    constexpr double slow = 1e-6, anywhere = 1e300;  // of the size in a substep
    const Frame &a = contacts.frames[c.a], &b = contacts.frames[c.b];
    const Vec2 between = b.position - a.position;
    const Manifold m = look(scene, c.candidate(), a, b, anywhere);
    double first = h;
    for (int k = 0; k < m.count; ++k) {
        const auto [lever_a, lever_b] = levers(c, m, k, between);
        const double gap = m.point[k].gap;
        const double rate = dot(velocity_at(state, c.b, lever_b) - velocity_at(state, c.a, lever_a), m.normal),
                     way = -rate * h;
        if (way <= slow * c.size || gap >= 2 * way) continue;
        const auto acceleration = [&](std::uint32_t row, Vec2 core) {
            const double w = turning(state, row);
            return at(accelerations.of(row), core) - w * w * core;
        };
        const Vec2 faster =
            acceleration(c.b, m.point[k].core_b) - acceleration(c.a, core_a_of(c.at_wall, m, k, between));
        const Gap now{std::max(gap, 0.0), rate, dot(faster, m.normal)};
        if (const auto closes = now.closes()) first = std::min(first, *closes);
    }
    return first;
}

}  // namespace

double until_slip_ends(const PreciseIslands& islands, const SoftScene& scene, State& state, SoftContacts& contacts,
                       double h) {
    constexpr double at_once = 1e-4;  // of h: what is left out by that is its square
    if (islands.all.empty() || contacts.all.size() > few) return h;
    Accelerations accelerations(scene, state, contacts);
    double first = h;
    const auto end_at = [&](double slip, double rate) {
        const double time = slip * rate < 0 ? -slip / rate : h;
        if (time > at_once * h && time < (1 - at_once) * h) first = std::min(first, time);
    };
    for (const SoftContact& c : contacts.all) {
        if (!is_foreseeable(c, islands, scene)) continue;
        const ContactBlock& block = contacts.blocks[c.block];
        const std::uint32_t k = c.row;
        const Vec2 t = perpendicular(Vec2{block.normal_x[k], block.normal_y[k]});
        std::optional<std::array<Twist, 2>> rates;
        for (int i = 0; i < c.manifold.count; ++i) {
            const auto& more = block.more[i];
            const double pressed = more.normal_force[k];
            const Vec2 lever_a = lever_a_of(block, i, k), lever_b = lever_b_of(block, i, k);
            const double slip =
                dot(velocity_at(state, c.b, lever_b) - velocity_at(state, c.a, lever_a), t) - block.surface_speed[k];
            const double roll = turning(state, c.b) - turning(state, c.a);
            const bool slides =
                resists(more.tangent_force[k], block.friction[k] * pressed, block.point[i].tangent_mass[k] * slip, h);
            const bool rolls =
                resists(more.rolling_moment[k], block.rolling[k] * pressed, block.rolling_mass[k] * roll, h);
            if (!slides && !rolls) continue;
            if (!rates) rates = {accelerations.of(c.a), accelerations.of(c.b)};
            const auto& [a, b] = *rates;
            if (slides) end_at(slip, dot(at(b, lever_b) - at(a, lever_a), t));
            if (rolls) end_at(roll, b.angular_velocity - a.angular_velocity);
        }
    }
    return first;
}

double await_landing(const PreciseIslands& islands, const SoftScene& scene, State& state, SoftContacts& contacts,
                     double h) {
    constexpr double at_once = 2e-3;  // of h
    constexpr double just = 0.97;     // before it: ways of what turns are foreseen to a per cent
    if (islands.all.empty() || contacts.all.size() > few) return h;
    Accelerations accelerations(scene, state, contacts);
    double first = h;
    std::uint32_t lands = 0;
    const auto let_strike = [&](std::uint32_t i) {
        SoftContact& c = contacts.all[i];
        if (c.rests) return;  // with its other corner: what ends the approach of the two together is a blow too
        if (!may_strike(c)) contacts.strikers.push_back(i);
        c.lands = true;
    };
    for (std::uint32_t i = 0; i < contacts.all.size(); ++i) {
        const SoftContact& c = contacts.all[i];
        if (!is_foreseeable(c, islands, scene)) continue;
        if (!leans(scene, contacts, c.a) && !leans(scene, contacts, c.b)) continue;
        const double time = touching(scene, state, contacts, c, h, accelerations);
        if (time <= at_once * h)
            let_strike(i);
        else if (time < first)
            first = std::max(just * time, at_once * h), lands = i;
    }
    if (first < h) let_strike(lands);
    return first;
}

}  // namespace carom
