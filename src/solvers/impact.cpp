#include "solvers/impact.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// One side of an impact: a body's velocities and how readily they change. A wall has neither.
struct Party {
    Vec2* v = nullptr;
    double* w = nullptr;
    double inverse_mass = 0, inverse_inertia = 0, radius = 0;
    bool driven = false;

    Vec2 velocity() const { return v ? *v : Vec2{}; }
    double spin() const { return w ? *w : 0; }
};

/// Applies impulse J to b and −J to a; `tangential` is its part across the normal, which alone turns discs.
void apply(Party& a, Party& b, Vec2 J, double tangential, Impacts& impacts) {
    for (auto [party, sign] : {std::pair{&a, -1.0}, std::pair{&b, 1.0}}) {
        // a is touched at +r n and b at −r n, so that the same torque −r J_t turns both.
        const double turn = -party->radius * tangential;
        if (party->driven) impacts.work_driven -= sign * dot(J, party->velocity()) + turn * party->spin();
        if (party->inverse_mass != 0) *party->v += sign * party->inverse_mass * J;
        if (party->inverse_inertia != 0 && turn != 0) *party->w += party->inverse_inertia * turn;
    }
}

bool collide(Party a, Party b, const Touch& touch, Impacts& impacts) {
    const Vec2 n = touch.normal, t = perpendicular(n);
    const double inverse_mass = a.inverse_mass + b.inverse_mass;
    if (inverse_mass == 0) return false;
    const double approach = dot(a.velocity() - b.velocity(), n);
    const double normal = (1 + touch.restitution) * approach / inverse_mass;
    apply(a, b, normal * n, 0, impacts);
    const double after = dot(a.velocity() - b.velocity(), n);
    impacts.heat_impact += 0.5 * normal * (approach + after);
    if (touch.friction > 0) {
        // Slip of a's surface over b's; the surfaces' velocities are v ± r ω t.
        const auto slip = [&] {
            return dot(a.velocity() - b.velocity(), t) + a.radius * a.spin() + b.radius * b.spin();
        };
        const double easiness =
            inverse_mass + a.radius * a.radius * a.inverse_inertia + b.radius * b.radius * b.inverse_inertia;
        const double before = slip();
        const double most = touch.friction * std::abs(normal);
        const double tangential = std::clamp(before / easiness, -most, most);
        apply(a, b, tangential * t, tangential, impacts);
        impacts.heat_friction += 0.5 * tangential * (before + slip());
    }
    ++impacts.collisions;
    return approach > 0;
}

Party party(std::size_t i, const Bodies& bodies, Motion& v) {
    return {&v.linear[i],           &v.angular[i],
            bodies.inverse_mass[i], bodies.inverse_inertia[i],
            bodies.radius[i],       bodies.kind[i] == Kind::driven};
}

}  // namespace

bool collide(std::size_t i, std::size_t j, const Touch& touch, const Bodies& bodies, Motion& v, Impacts& impacts) {
    return collide(party(i, bodies, v), party(j, bodies, v), touch, impacts);
}

bool collide(std::size_t i, const Touch& touch, const Bodies& bodies, Motion& v, Impacts& impacts) {
    return collide(party(i, bodies, v), Party{}, touch, impacts);
}

}  // namespace carom
