#include "forces/field.hpp"

#include "math/slope.hpp"

namespace carom {

namespace {

bool is_finite(Vec2 a) { return a.x - a.x + (a.y - a.y) == 0; }

}  // namespace

void add_loads(const ConstantForces& forces, const State& state, Loads& loads) {
    for (const ConstantForceRow& f : forces) {
        if (!loads.act_on(f.body)) continue;
        const Vec2 arm = turned(f.point, state.x.angular[f.body]);
        const double w = state.v.angular[f.body];
        loads.force[f.body] += f.force;
        loads.torque[f.body] += f.torque + cross(arm, f.force);
        loads.flow[Account::field] += dot(f.force, state.v.linear[f.body] + cross(w, arm));
        loads.flow[Account::user] += f.torque * w;
        loads.flow[Giver::field].add(f.force, cross(state.x.linear[f.body] + arm, f.force) + f.torque);
    }
}

double potential(const ConstantForces& forces, const State& state) {
    double sum = 0;
    for (const ConstantForceRow& f : forces)
        sum -= dot(f.force, state.x.linear[f.body] + turned(f.point, state.x.angular[f.body]));
    return sum;
}

void add_loads(const Fields& fields, std::span<const double> mass, std::span<const double> inverse_mass,
               const State& state, Loads& loads, std::optional<FieldDoubt>& doubt) {
    for (std::size_t k = 0; k < fields.size(); ++k) {
        const FieldRow& f = fields[k];
        loads.each_row(f.first, f.last, [&](Row i) {
            if (inverse_mass[i] == 0) return;
            const Vec2 force = f.force(state.x.linear[i], state.v.linear[i], mass[i], state.time);
            if (!is_finite(force) && is_finite(state.x.linear[i]) && !doubt)
                doubt = {k, i, force, state.x.linear[i], state.v.linear[i], mass[i], state.time};
            const double power = dot(force, state.v.linear[i]);
            loads.force[i] += force;
            loads.flow[f.potential ? Giver::field : Giver::user].add_at(state.x.linear[i], force);
            if (!f.potential) {
                loads.flow[Account::user] += power;
                return;
            }
            // What the potential rises by with nobody moving is the work of whoever changes it.
            const double change =
                slope([&](double t) { return f.potential(state.x.linear[i], mass[i], t); }, state.time);
            loads.flow[Account::field] += power - change;
            loads.flow[Account::user] += change;
        });
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
