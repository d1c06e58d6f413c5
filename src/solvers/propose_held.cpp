// The integrator's flight of bodies that hang on joints.

#include <algorithm>
#include <optional>

#include "forces/gains.hpp"
#include "solvers/parts.hpp"

namespace carom {

namespace {

/// Whether a joint's force along a row is one that lasts. What joints did to a blow, or to what was fast when they were
/// made, is an impulse: in a substep of another length it would be any velocity.
bool lasts(const JointMemory& memory, std::uint32_t row) {
    constexpr double much = 4;
    const double now = memory.pull[row], before = 2 * memory.mean[row] - now;
    return now * before > 0 && std::abs(now) <= much * std::abs(before);
}

/// Whether so much may be given to a mechanism. Joints take what leads out of their ways of what forces give, and turn
/// what moves: of energy no more than there is of both. Those that contradict one another pull a million times as hard
/// at one another, and what is left of that on rows that have turned since is anything.
bool may_get(const Mechanism& m, double h, const Dynamics& dynamics, State& state, const Scratch<Twist>& given,
             std::optional<Rates>& rates) {
    constexpr double much = 4;
    const auto energy_of = [&](auto velocity_of, auto turning_of) {
        double sum = 0;
        for (const Mechanism::Part& p : m.parts) {
            if (p.inverse_mass == 0) continue;
            const double w = turning_of(p.row);
            sum += dynamics.mass()[p.row] * squared_length(velocity_of(p.row)) + dynamics.inertia()[p.row] * w * w;
        }
        return sum;
    };
    const auto of = [&](const Motion& motion) {
        return energy_of([&](std::uint32_t i) { return motion.linear[i]; },
                         [&](std::uint32_t i) { return motion.angular[i]; });
    };
    const double gift = energy_of([&](std::uint32_t i) { return given[i].velocity; },
                                  [&](std::uint32_t i) { return given[i].angular_velocity; });
    if (gift <= much * of(state.v)) return true;
    if (!rates) dynamics.evaluate(state, rates.emplace());
    return gift <= much * (of(state.v) + h * h * of(rates->acceleration));
}

/// What the joints gave each body in half of the substep before, by forces that last.
void expect(const Mechanisms& mechanisms, double h, const Dynamics& dynamics, State& state, Scratch<Twist>& given) {
    std::optional<Rates> rates;
    for (const Mechanism& m : mechanisms.all) {
        if (m.is_asleep) continue;
        const auto add = [&](const Mechanism::Part& p, const double* j, double impulse) {
            if (p.inverse_mass == 0) return;
            given[p.row].velocity += p.inverse_mass * impulse * Vec2{j[0], j[1]};
            given[p.row].angular_velocity += p.inverse_inertia * impulse * j[2];
        };
        for (const Member& k : m.members)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                if (!lasts(mechanisms.memory[k.joint], r)) continue;
                const JointRow& row = m.lines[k.line + r].first;
                const double impulse = h * mechanisms.memory[k.joint].half[r];
                add(m.parts[k.a], row.a, impulse), add(m.parts[k.b], row.b, impulse);
            }
        if (may_get(m, h, dynamics, state, given, rates)) continue;
        for (const Mechanism::Part& p : m.parts)
            if (p.inverse_mass != 0) given[p.row] = {};
    }
}

/// The rows that joints hold and that are awake, in their order.
Scratch<std::uint32_t> held_rows(const Mechanisms& mechanisms) {
    Scratch<std::uint32_t> rows;
    for (const Mechanism& m : mechanisms.all)
        for (const Mechanism::Part& p : m.parts)
            if (!m.is_asleep && p.inverse_mass != 0) rows.push_back(p.row);
    if (!std::is_sorted(rows.begin(), rows.end())) std::sort(rows.begin(), rows.end());
    return rows;
}

}  // namespace

void propose_held(const SoftScene& scene, const Mechanisms& mechanisms, double h, State& state) {
    const Dynamics& dynamics = scene.flight.dynamics;
    if (mechanisms.empty() || !dynamics.needs_velocity() || !gives_halves(scene)) return scene.flight.propose(state, h);
    Scratch<Twist> given(state.size());
    expect(mechanisms, h, dynamics, state, given);
    const Scratch<std::uint32_t> rows = held_rows(mechanisms);
    Gains gains(dynamics);
    const auto shift = [&](double sign, double time) {
        for (const std::uint32_t i : rows) {
            Vec2 &x = state.x.linear[i], &v = state.v.linear[i];
            double &angle = state.x.angular[i], &w = state.v.angular[i];
            const Vec2 dv = sign * given[i].velocity;
            const double dw = sign * given[i].angular_velocity;
            gains.add(i, x, v, w, time * dv, dv, dw);
            x += time * dv, v += dv, angle += time * dw, w += dw;
        }
    };
    shift(1, 0);
    scene.flight.propose(state, h);
    shift(-1, h);
    gains.book(state.account);
}

}  // namespace carom
