// When friction has stopped a slip: a substep ends there, for from then on it is another friction.

#include <optional>

#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"

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

}  // namespace

double until_slip_ends(const PreciseIslands& islands, const SoftScene& scene, State& state, SoftContacts& contacts,
                       double h) {
    constexpr std::size_t few = 20;
    constexpr double at_once = 1e-4;  // of h: what is left out by that is its square
    if (islands.all.empty() || contacts.all.size() > few) return h;
    Accelerations accelerations(scene, state, contacts);
    double first = h;
    const auto end_at = [&](double slip, double rate) {
        const double time = slip * rate < 0 ? -slip / rate : h;
        if (time > at_once * h && time < (1 - at_once) * h) first = std::min(first, time);
    };
    for (const SoftContact& c : contacts.all) {
        const auto is_joined = [&](std::uint32_t row) { return moves(scene, row) && scene.mechanisms.holds[row]; };
        if (!islands.hold(c) || is_joined(c.a) || is_joined(c.b)) continue;  // of what joints give is not known here
        const ContactBlock& block = contacts.blocks[c.block];
        const std::uint32_t k = c.row;
        const Vec2 t = perpendicular(Vec2{block.normal_x[k], block.normal_y[k]});
        const auto turning = [&](std::uint32_t row) { return row < state.size() ? state.v.angular[row] : 0; };
        std::optional<std::array<Twist, 2>> rates;
        for (int i = 0; i < c.manifold.count; ++i) {
            const auto& more = block.more[i];
            const double pressed = more.normal_force[k];
            const Vec2 lever_a = lever_a_of(block, i, k), lever_b = lever_b_of(block, i, k);
            const double slip =
                dot(velocity_at(state, c.b, lever_b) - velocity_at(state, c.a, lever_a), t) - block.surface_speed[k];
            const double roll = turning(c.b) - turning(c.a);
            const bool slides =
                resists(more.tangent_force[k], block.friction[k] * pressed, block.point[i].tangent_mass[k] * slip, h);
            const bool rolls =
                resists(more.rolling_moment[k], block.rolling[k] * pressed, block.rolling_mass[k] * roll, h);
            if (!slides && !rolls) continue;
            if (!rates) rates = {accelerations.of(c.a), accelerations.of(c.b)};
            const auto& [a, b] = *rates;
            const auto at = [](const Twist& twist, Vec2 lever) {
                return twist.velocity + cross(twist.angular_velocity, lever);
            };
            if (slides) end_at(slip, dot(at(b, lever_b) - at(a, lever_a), t));
            if (rolls) end_at(roll, b.angular_velocity - a.angular_velocity);
        }
    }
    return first;
}

}  // namespace carom
