#include "forces/spring.hpp"

namespace carom {

Stretch stretch(const SpringRow& s, const State& state) {
    Stretch out{};
    out.arm_a = turned(s.anchor_a, state.x.angular[s.a]);
    out.arm_b = turned(s.anchor_b, state.x.angular[s.b]);
    const Vec2 d = (state.x.linear[s.b] + out.arm_b) - (state.x.linear[s.a] + out.arm_a);
    out.length = length(d);
    // At length zero Hooke's force has no direction of its own; any one will do, and +x is the same everywhere.
    out.direction = out.length > 0 ? d / out.length : Vec2{1, 0};
    out.velocity = (state.v.linear[s.b] + cross(state.v.angular[s.b], out.arm_b)) -
                   (state.v.linear[s.a] + cross(state.v.angular[s.a], out.arm_a));
    return out;
}

void add_loads(const Springs& springs, const State& state, Loads& loads) {
    for (const SpringRow& s : springs) {
        if (!loads.act_on(s.a)) continue;
        const Stretch now = stretch(s, state);
        const Vec2 damping = s.damping_law == DampingLaw::along
                                 ? s.damping * dot(now.velocity, now.direction) * now.direction
                                 : s.damping * now.velocity;
        const double tension = s.stiffness * (now.length - s.rest_length);
        const Vec2 on_a = tension * now.direction + damping;
        loads.force[s.a] += on_a;
        loads.force[s.b] -= on_a;
        loads.torque[s.a] += cross(now.arm_a, on_a);
        loads.torque[s.b] -= cross(now.arm_b, on_a);
        loads.flow[Account::spring] -= tension * dot(now.direction, now.velocity);
        loads.flow[Account::damping] += dot(damping, now.velocity);
        // A damping that is not along the spring turns the pair, as a medium would.
        if (s.damping_law == DampingLaw::isotropic)
            loads.flow[Giver::medium].torque -= cross(now.length * now.direction, damping);
    }
}

void add_loads(const TorsionSprings& springs, const State& state, Loads& loads) {
    for (const TorsionRow& s : springs) {
        if (!loads.act_on(s.a)) continue;
        const double twist = state.x.angular[s.b] - state.x.angular[s.a] - s.rest_angle;
        const double rate = state.v.angular[s.b] - state.v.angular[s.a];
        const double elastic = s.stiffness * twist, on_a = elastic + s.damping * rate;
        loads.torque[s.a] += on_a;
        loads.torque[s.b] -= on_a;
        loads.flow[Account::spring] -= elastic * rate;
        loads.flow[Account::damping] += s.damping * rate * rate;
    }
}

double potential(const Springs& springs, const State& state) {
    double sum = 0;
    for (const SpringRow& s : springs) {
        const double extension = stretch(s, state).length - s.rest_length;
        sum += 0.5 * s.stiffness * extension * extension;
    }
    return sum;
}

double potential(const TorsionSprings& springs, const State& state) {
    double sum = 0;
    for (const TorsionRow& s : springs) {
        const double twist = state.x.angular[s.b] - state.x.angular[s.a] - s.rest_angle;
        sum += 0.5 * s.stiffness * twist * twist;
    }
    return sum;
}

}  // namespace carom
