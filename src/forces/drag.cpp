#include "forces/drag.hpp"

namespace carom {

// The power of the drag on a body, F·v, falls into two: the medium is heated by −F·u, and a medium that moves does the
// work F·wind on the body. Both are positive numbers for a body at rest in a wind.
void add_loads(const Drags& drags, std::span<const double> inverse_mass, const State& state, Loads& loads) {
    for (const DragRow& d : drags) {
        loads.each_row(d.first, d.last, [&](Row i) {
            if (inverse_mass[i] == 0) return;
            const Vec2 u = state.v.linear[i] - d.wind;
            const double w = state.v.angular[i];
            const Vec2 force = -(d.linear + d.quadratic * length(u)) * u;
            loads.force[i] += force;
            loads.torque[i] -= d.angular * w;
            loads.flow[Account::drag] += d.angular * w * w - dot(force, u);
            loads.flow[Account::wind] += dot(force, d.wind);
            loads.flow[Giver::medium].add(force, cross(state.x.linear[i], force) - d.angular * w);
        });
    }
}

}  // namespace carom
