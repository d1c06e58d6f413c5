#include "integrators/propose.hpp"
#include "integrators/splitting.hpp"

namespace carom {

void propose(const SymplecticEuler&, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    if (dynamics.moves_in_waves(state)) {
        const auto wave = dynamics.kick_then_drift(h, state, memory.rates);
        state.account += wave.gain;
        state.account.add(h, memory.rates.flow);
        state.time += h;
        memory.finite = wave.finite;
        return;
    }
    const bool kicked = kick(dynamics, state, h, 1, memory);
    memory.finite = drift(dynamics, state, h) && kicked;
}

// Swope, Andersen, Berens, Wilson, J. Chem. Phys. 76, 637 (1982): half a kick, a drift, half a kick. The rates at the
// end of a step are those at the start of the next. If they depend on velocity, a half kick takes them at its middle,
// whose velocity the last rates known foretell: their error of order h becomes one of order h³ in the new velocity.
void propose(const Verlet&, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    const bool by_velocity = dynamics.needs_velocity();
    if (!memory.continues) dynamics.evaluate(state, memory.rates);
    if (dynamics.moves_in_waves(state)) {
        const Flows before = memory.rates.flow;
        const auto wave = dynamics.drift_then_kick(h / 2, h, state, memory.rates);
        state.account += wave.first_gain;
        state.account.add(h / 2, before);
        state.account += wave.gain;
        state.account.add(h / 2, memory.rates.flow);
        state.time += h;
        memory.finite = wave.finite;
        return;
    }
    if (by_velocity) evaluate_midway(dynamics, state, h / 4, memory);
    const bool drifted = add_and_drift(dynamics, state, h / 2, h, memory.rates);
    if (!by_velocity) {
        memory.finite =
            evaluate_and_add(dynamics, state, h / 2, memory.rates, Dynamics::Keep::accelerations) && drifted;
        return;
    }
    evaluate_midway(dynamics, state, h / 4, memory);
    memory.finite = add(dynamics, state, h / 2, memory.rates) && drifted;
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
