#include "solvers/impact.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Applies impulse J to b and −J to a; `tangential` is its part across the normal, which alone turns discs.
void apply(Party& a, Party& b, Vec2 J, double tangential, Flows& account) {
    Wrench given;
    for (auto [party, sign] : {std::pair{&a, -1.0}, std::pair{&b, 1.0}}) {
        // a is touched at +r n and b at −r n, so that the same torque −r J_t turns both.
        const double turn = -party->radius * tangential;
        if (party->inverse_mass != 0) {
            given.add_at(party->x, sign * J);
            *party->v += sign * party->inverse_mass * J;
        } else {
            account[Account::driven] -= sign * dot(J, party->velocity());
        }
        if (party->inverse_inertia != 0) {
            given.torque += turn;
            *party->w += party->inverse_inertia * turn;
        } else {
            account[Account::driven] -= turn * party->spin();
        }
    }
    // Two that move give each other what they take; a torque is left over if they do not touch where they should.
    const bool both = a.inverse_mass != 0 && b.inverse_mass != 0;
    account[both ? Giver::method : (a.inverse_mass != 0 ? b : a).holder].add(given.force, given.torque);
}

/// Coulomb's friction, of an impulse of `most` at most.
void rub(Party& a, Party& b, Vec2 n, double most, Flows& account) {
    const Vec2 t = perpendicular(n);
    // Slip of a's surface over b's; the surfaces' velocities are v ± r ω t.
    const auto slip = [&] { return dot(a.velocity() - b.velocity(), t) + a.radius * a.spin() + b.radius * b.spin(); };
    const double easiness = a.inverse_mass + b.inverse_mass + a.radius * a.radius * a.inverse_inertia +
                            b.radius * b.radius * b.inverse_inertia;
    const double before = slip();
    const double tangential = std::clamp(before / easiness, -most, most);
    apply(a, b, tangential * t, tangential, account);
    account[Account::friction] += 0.5 * tangential * (before + slip());
}

}  // namespace

bool collide(Party a, Party b, const Touch& touch, Flows& account) {
    const Vec2 n = touch.normal;
    const double inverse_mass = a.inverse_mass + b.inverse_mass;
    if (inverse_mass == 0) return false;
    const double approach = dot(a.velocity() - b.velocity(), n);
    const double normal = std::max((1 + touch.restitution) * approach, approach + touch.least) / inverse_mass;
    apply(a, b, normal * n, 0, account);
    const double after = dot(a.velocity() - b.velocity(), n);
    account[Account::impact] += 0.5 * normal * (approach + after);
    if (touch.friction != 0) rub(a, b, n, touch.friction * std::abs(normal), account);
    return true;
}

namespace {

Party party(std::size_t i, const Bodies& bodies, State& state) {
    return {state.x.linear[i],         &state.v.linear[i], &state.v.angular[i], bodies.inverse_mass[i],
            bodies.inverse_inertia[i], bodies.radius[i],   Giver::held};
}

}  // namespace

bool collide(std::size_t i, std::size_t j, const Touch& touch, const Bodies& bodies, State& state) {
    return collide(party(i, bodies, state), party(j, bodies, state), touch, state.account);
}

bool collide(std::size_t i, const Touch& touch, const Bodies& bodies, State& state) {
    return collide(party(i, bodies, state), Party{}, touch, state.account);
}

void rub(std::size_t i, std::size_t j, Vec2 normal, double most, const Bodies& bodies, State& state) {
    Party a = party(i, bodies, state), b = party(j, bodies, state);
    if (most > 0) rub(a, b, normal, most, state.account);
}

void keep_turning(std::size_t i, std::size_t j, Vec2 normal, double part, const Bodies& bodies, State& state) {
    Party a = party(i, bodies, state), b = party(j, bodies, state);
    const Vec2 t = perpendicular(normal);
    const double across = dot(b.velocity() - a.velocity(), t);
    const double impulse = (part - 1) * across / (a.inverse_mass + b.inverse_mass);
    apply(a, b, impulse * t, 0, state.account);
    state.account[Account::parting] += 0.5 * (1 + part) * across * impulse;
}

void shift(std::size_t i, Vec2 by, const Bodies& bodies, Vec2 gravity, State& state) {
    state.x.linear[i] += by;
    if (bodies.inverse_mass[i] == 0) return;
    state.account[Account::overlap] -= bodies.mass[i] * dot(gravity, by);
    state.account[Giver::method].torque += bodies.mass[i] * cross(by, state.v.linear[i]);
}

}  // namespace carom
