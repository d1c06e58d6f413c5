// Sleep: islands at rest are left out of the solve, and their bodies stay where they are.

#include <algorithm>
#include <iterator>

#include "forces/gains.hpp"
#include "math/scratch.hpp"
#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"

namespace carom {

namespace {

constexpr double time_to_sleep = 0.5;  // s

/// A body is at rest while it is slower than this part of what gravity gives it in a step. What sweeps leave of the
/// motion of a stack is a thousandth of that; what begins to tip or to slide is faster in a hundredth of the time.
constexpr double slowness = 1e-6;

/// Whether what a body touches may move it at any time.
bool keeps_awake(const SoftScene& scene, const SoftContact& c) {
    const auto driven = [&](std::uint32_t row) {
        return row < scene.bodies.size() && scene.bodies.kind[row] == Kind::driven;
    };
    return c.surface_speed != 0 || driven(c.a) || driven(c.b);
}

bool keeps_awake(const SoftScene& scene, const Mechanism& m) {
    const auto is_driven = [&](const Mechanism::Part& p) {
        return p.row < scene.bodies.size() && scene.bodies.kind[p.row] == Kind::driven;
    };
    return std::any_of(m.lines.begin(), m.lines.end(), [](const Line& l) { return l.law.speed != 0; }) ||
           std::any_of(m.parts.begin(), m.parts.end(), is_driven);
}

/// By row, for the first of every island: whether all of it may sleep.
Scratch<bool> quiet_islands(const SoftScene& scene, const Scratch<std::uint32_t>& first, const SoftContacts& contacts) {
    Scratch<bool> quiet(first.size(), true);
    for (std::size_t i = 0; i < first.size(); ++i)
        if (!scene.may_sleep[i] || contacts.still[i] < time_to_sleep) quiet[first[i]] = false;
    for (const auto* some : {&contacts.all, &contacts.resting})
        for (const SoftContact& c : *some)
            if (keeps_awake(scene, c)) quiet[first[moves(scene, c.a) ? c.a : c.b]] = false;
    for (const Mechanism& m : scene.mechanisms.all) {
        if (!keeps_awake(scene, m)) continue;
        for (const Mechanism::Part& p : m.parts)
            if (moves(scene, p.row)) quiet[first[p.row]] = false;
    }
    return quiet;
}

/// Takes what little velocity there is, on the method's account.
void stop(const SoftScene& scene, std::size_t row, State& state) {
    Gains gains(scene.flight.dynamics);
    Vec2& v = state.v.linear[row];
    double& w = state.v.angular[row];
    gains.add(row, state.x.linear[row], v, w, {}, -v, -w);
    gains.book(state.account);
    v = {}, w = 0;
}

/// The contacts of those that sleep.
void set_aside(const SoftScene& scene, SoftContacts& contacts) {
    const auto awake = std::stable_partition(contacts.all.begin(), contacts.all.end(), [&](const SoftContact& c) {
        return !contacts.asleep[moves(scene, c.a) ? c.a : c.b];
    });
    const auto old = static_cast<std::ptrdiff_t>(contacts.resting.size());
    for (auto c = awake; c != contacts.all.end(); ++c) c->touched = c->touched || c->touched_before;
    std::move(awake, contacts.all.end(), std::back_inserter(contacts.resting));
    contacts.all.erase(awake, contacts.all.end());
    std::inplace_merge(contacts.resting.begin(), contacts.resting.begin() + old, contacts.resting.end(),
                       [](const SoftContact& c, const SoftContact& d) { return c.key < d.key; });
}

}  // namespace

void SoftContacts::stir(std::size_t row) {
    if (row < still.size()) still[row] = 0;
}

void SoftContacts::remove(std::size_t row, std::size_t bodies) {
    const auto close = [=](auto& array) {
        array.resize(bodies);
        array[row] = array.back();
        array.pop_back();
    };
    close(still), close(asleep);
}

bool let_sleep(const SoftScene& scene, const Scratch<std::uint32_t>& first, State& state, SoftContacts& contacts) {
    const Scratch<bool> quiet = quiet_islands(scene, first, contacts);
    const auto changes = [&](std::uint32_t i) {
        return moves(scene, i) && quiet[first[i]] != (contacts.asleep[i] != 0);
    };
    for (std::uint32_t i = 0; i < first.size() && contacts.knows_resting; ++i)
        if (contacts.asleep[i] && changes(i)) return false;
    contacts.knows_resting = true;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
        if (!changes(i)) continue;
        contacts.asleep[i] = quiet[first[i]];
        (contacts.asleep[i] ? contacts.sleeps : contacts.wakes).push_back(scene.bodies.id[i]);
        if (contacts.asleep[i]) stop(scene, i, state);
        contacts.knows_resting = false;  // before all is as it is for those that have slept for long
    }
    set_aside(scene, contacts);
    return true;
}

void hold_sleepers(const SoftContacts& contacts, const State& start, std::size_t first, std::size_t last,
                   State& state) {
    for (std::size_t i = first; i < last; ++i) {
        if (!contacts.asleep[i]) continue;
        state.x.linear[i] = start.x.linear[i], state.x.angular[i] = start.x.angular[i];
        state.v.linear[i] = {}, state.v.angular[i] = 0;
    }
}

void book_resting(const SoftScene& scene, const State& state, double dt, SoftContacts& contacts, Flows& account) {
    for (const SoftContact& c : contacts.resting) {
        if (moves(scene, c.a) && moves(scene, c.b)) continue;
        const Vec2 n = c.manifold.normal;
        for (int i = 0; i < c.manifold.count; ++i) {
            book_held(scene, c, point_of(c, i, state.x.linear[c.b]),
                      dt * (c.normal_force[i] * n + c.tangent_force[i] * perpendicular(n)), dt * c.rolling_moment[i],
                      {}, {}, account);
        }
    }
}

void stir_parted(double h, SoftContacts& contacts) {
    constexpr double slight = 0.01;  // of the overlap that a spring takes on without a load
    const Softness soft = softness(h);
    const auto is_parted = [&](const SoftContact& c) {
        const ContactBlock& block = contacts.blocks[c.block];
        const std::uint32_t k = c.row;
        for (int i = 0; i < c.manifold.count; ++i) {
            const auto& more = block.more[i];
            const double loaded = soft.give * more.normal_force[k] / block.point[i].normal_mass[k];
            if (more.open[k] == 0 && -block.point[i].gap[k] > slight * block.shallow[k] + loaded) return true;
        }
        return false;
    };
    for (const SoftContact& c : contacts.all)
        if (is_parted(c)) contacts.stir(c.a), contacts.stir(c.b);
}

void note_rest(const SoftScene& scene, const State& state, double dt, SoftContacts& contacts) {
    const double most = slowness * length(scene.flight.dynamics.gravity()) * dt;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const Vec2 v = state.v.linear[i];
        const double w = state.v.angular[i], gyration = scene.bodies.inertia[i] / scene.bodies.mass[i];
        contacts.still[i] = dot(v, v) + gyration * w * w <= most * most ? contacts.still[i] + dt : 0;
    }
}

}  // namespace carom
