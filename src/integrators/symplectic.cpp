#include "integrators/propose.hpp"
#include "integrators/splitting.hpp"

namespace carom {

void propose(const SymplecticEuler&, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    const auto kick_and_drift = [&](std::size_t first, std::size_t last) {
        advance_rows(first, last, h, state.v, memory.rates.acceleration);
        advance_rows(first, last, h, state.x, state.v);
    };
    dynamics.evaluate_between([](auto...) {}, state, memory.rates, kick_and_drift);
    state.account.add(h, memory.rates.power);
    state.time += h;
    dynamics.place_driven(state);
}

// Swope, Andersen, Berens, Wilson, J. Chem. Phys. 76, 637 (1982): half a kick, a drift, half a kick. The rates at the
// end of a step are those at the start of the next. If they depend on velocity, a half kick takes them at its middle,
// whose velocity the last rates known foretell: their error of order h becomes one of order h³ in the new velocity.
void propose(const Verlet&, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    Rates& rates = memory.rates;
    if (!memory.continues) dynamics.evaluate(state, rates);
    if (dynamics.needs_velocity()) {
        const auto half_kick = [&] {
            evaluate_ahead(dynamics, state, h / 4, memory);
            add(state, h / 2, rates);
        };
        half_kick();
        drift(dynamics, state, h);
        return half_kick();
    }
    const auto half_kick = [&](std::size_t first, std::size_t last) {
        advance_rows(first, last, h / 2, state.v, rates.acceleration);
    };
    const auto half_kick_and_drift = [&](std::size_t first, std::size_t last) {
        half_kick(first, last);
        advance_rows(first, last, h, state.x, state.v);
    };
    state.account.add(h / 2, rates.power);
    state.time += h;
    dynamics.evaluate_between(half_kick_and_drift, state, rates, half_kick);
    state.account.add(h / 2, rates.power);
}

// Omelyan, Mryglod, Folk, Comput. Phys. Commun. 146, 188 (2002), equations 20 and 22.
void propose(const Pefrl&, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    constexpr double xi = 0.1786178958448091, lambda = -0.2123418310626054, chi = -0.06626458266981849;
    drift(dynamics, state, xi * h);
    kick(dynamics, state, (1 - 2 * lambda) / 2 * h, 4, memory);
    drift(dynamics, state, chi * h);
    kick(dynamics, state, lambda * h, 4, memory);
    drift(dynamics, state, (1 - 2 * (chi + xi)) * h);
    kick(dynamics, state, lambda * h, 4, memory);
    drift(dynamics, state, chi * h);
    kick(dynamics, state, (1 - 2 * lambda) / 2 * h, 4, memory);
    drift(dynamics, state, xi * h);
}

}  // namespace carom
