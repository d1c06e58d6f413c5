#include "forces/field.hpp"

namespace carom {

void add_loads(const ConstantForces& forces, const State& state, Loads& loads) {
    for (const ConstantForceRow& f : forces) {
        loads.force[f.body] += f.force;
        loads.torque[f.body] += f.torque + cross(turned(f.point, state.x.angular[f.body]), f.force);
        loads.power[Account::user] += f.torque * state.v.angular[f.body];
    }
}

double potential(const ConstantForces& forces, const State& state) {
    double sum = 0;
    for (const ConstantForceRow& f : forces)
        sum -= dot(f.force, state.x.linear[f.body] + turned(f.point, state.x.angular[f.body]));
    return sum;
}

void add_loads(const Fields& fields, std::span<const double> mass, std::span<const double> inverse_mass,
               const State& state, Loads& loads) {
    for (const FieldRow& f : fields) {
        for (Row i = f.first; i < f.last; ++i) {
            if (inverse_mass[i] == 0) continue;
            const Vec2 force = f.force(state.x.linear[i], state.v.linear[i], mass[i], state.time);
            loads.force[i] += force;
            if (!f.potential) loads.power[Account::user] += dot(force, state.v.linear[i]);
        }
    }
}

double potential(const Fields& fields, std::span<const double> mass, std::span<const double> inverse_mass,
                 const State& state) {
    double sum = 0;
    for (const FieldRow& f : fields) {
        if (!f.potential) continue;
        for (Row i = f.first; i < f.last; ++i)
            if (inverse_mass[i] != 0) sum += f.potential(state.x.linear[i], mass[i], state.time);
    }
    return sum;
}

}  // namespace carom
