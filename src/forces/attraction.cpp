#include "forces/attraction.hpp"

namespace carom {

namespace {

template <class F>
void for_each_pair(const AttractionRows& a, const State& state, F f) {
    const auto n = static_cast<Row>(state.size());
    for (Row i = 0; i < n; ++i) {
        for (Row j = i + 1; j < n; ++j) {
            const double strength = a.strength * a.coupling[i] * a.coupling[j];
            if (strength == 0 || !(a.moves[i] || a.moves[j])) continue;
            const Vec2 d = state.x.linear[j] - state.x.linear[i];
            f(i, j, strength, d, squared_length(d) + a.squared_softening);
        }
    }
}

}  // namespace

void add_loads(const Attractions& attractions, const State& state, Loads& loads) {
    for (const AttractionRows& a : attractions) {
        for_each_pair(a, state, [&](Row i, Row j, double strength, Vec2 d, double r2) {
            const double r3 = a.law == DistanceLaw::inverse ? r2 : r2 * std::sqrt(r2);
            const Vec2 on_i = strength / r3 * d;
            loads.force[i] += on_i;
            loads.force[j] -= on_i;
        });
    }
}

double potential(const Attractions& attractions, const State& state) {
    double sum = 0;
    for (const AttractionRows& a : attractions) {
        for_each_pair(a, state, [&](Row, Row, double strength, Vec2, double r2) {
            sum += a.law == DistanceLaw::inverse ? 0.5 * strength * portable::log(r2) : -strength / std::sqrt(r2);
        });
    }
    return sum;
}

}  // namespace carom
