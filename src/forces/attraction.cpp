#include "forces/attraction.hpp"

#include <algorithm>

#include "threads/parallel.hpp"

namespace carom {

namespace {

/// Calls f for all pairs i < j with i in [first, last).
template <class F>
[[gnu::always_inline]] inline void for_each_pair(const AttractionRows& a, const State& state, std::size_t first,
                                                 std::size_t last, F f) {
    const std::size_t n = state.size();
    const double *const coupling = a.coupling.data(), softening = a.squared_softening;
    const char* const moves = a.moves.data();
    const Vec2* const x = state.x.linear.data();
    for (std::size_t i = first; i < last; ++i) {
        const double of_one = a.strength * coupling[i];
        for (std::size_t j = i + 1; j < n; ++j) {
            const double strength = of_one * coupling[j];
            if (strength == 0 || !(moves[i] || moves[j])) continue;
            const Vec2 d = x[j] - x[i];
            f(i, j, strength, d, squared_length(d) + softening);
        }
    }
}

/// Returns the power of the forces added.
double add_forces(const AttractionRows& a, const State& state, std::size_t first, std::size_t last, Vec2* force) {
    double power = 0;
    const Vec2* const v = state.v.linear.data();
    for_each_pair(a, state, first, last,
                  [&power, v, force, law = a.law](auto i, auto j, double strength, Vec2 d, double r2) {
                      const double r3 = law == DistanceLaw::inverse ? r2 : r2 * std::sqrt(r2);
                      const Vec2 on_i = strength / r3 * d;
                      force[i] += on_i;
                      force[j] -= on_i;
                      power += dot(on_i, v[i] - v[j]);
                  });
    return power;
}

}  // namespace

// The rows are cut into parts by their number alone, each part adds up on its own, and the parts are added in order:
// the same bits for every number of threads.
void add_loads(const Attractions& attractions, int threads, const State& state, Loads& loads) {
    const std::size_t n = state.size(), parts = std::clamp<std::size_t>(n / 128, 1, 64);
    for (const AttractionRows& a : attractions) {
        if (parts == 1) {
            loads.flow[Account::field] += add_forces(a, state, 0, n, loads.force.data());
            continue;
        }
        std::vector<std::vector<Vec2>> force(parts, std::vector<Vec2>(n));
        std::vector<double> power(parts);
        // Part k begins where the rows before it hold k/parts of all pairs.
        const auto begin = [&](std::size_t k) {
            return n - static_cast<std::size_t>(static_cast<double>(n) *
                                                std::sqrt(1 - static_cast<double>(k) / static_cast<double>(parts)));
        };
        parallel_for(threads, parts,
                     [&](std::size_t k) { power[k] = add_forces(a, state, begin(k), begin(k + 1), force[k].data()); });
        for (const double part : power) loads.flow[Account::field] += part;
        for (const auto& part : force)
            for (std::size_t i = 0; i < n; ++i) loads.force[i] += part[i];
    }
}

double potential(const Attractions& attractions, const State& state) {
    double sum = 0;
    for (const AttractionRows& a : attractions) {
        for_each_pair(a, state, 0, state.size(), [&](std::size_t, std::size_t, double strength, Vec2, double r2) {
            sum += a.law == DistanceLaw::inverse ? 0.5 * strength * portable::log(r2) : -strength / std::sqrt(r2);
        });
    }
    return sum;
}

}  // namespace carom
