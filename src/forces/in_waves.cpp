#include "forces/dynamics.hpp"
#include "forces/wave.hpp"

namespace carom {

namespace {

/// Of a block.
struct Gained {
    Flows flow, first_gain, gain;
    bool bad = false;

    void operator+=(const Gained& other) {
        flow += other.flow, first_gain += other.first_gain, gain += other.gain;
        bad |= other.bad;
    }
};

}  // namespace

namespace {

/// One for each run.
std::vector<SpringNetwork::Pass> passes(const Wave& wave, const SpringNetwork& network) {
    std::vector<SpringNetwork::Pass> all;
    for (std::size_t run = 0; run < wave.runs(); ++run) all.emplace_back(network, wave.first_of_run(run));
    return all;
}

}  // namespace

bool Dynamics::moves_in_waves(const State& state) const {
    constexpr std::size_t least_runs = 32;  // so long that they have more inside than between them
    return !some_ && !guidance_ && !network_.empty() && soft_discs_.empty() && !others_ && !needs_velocity_ &&
           state.size() > 8 * rows_at_once && least_runs * reach_ < state.size();
}

Dynamics::Wave Dynamics::kick_then_drift(double h, State& state, Rates& rates) const {
    const carom::Wave wave(state.size(), reach_, threads_);
    std::vector<Gained> gained(wave.blocks());
    std::vector<SpringNetwork::Pass> pass = passes(wave, network_);
    const auto work = [&](std::size_t b, std::size_t run) {
        std::array<Vec2, rows_at_once> force;
        const Block block{wave.first(b), wave.last(b), force.data(), nullptr};
        write_forces_between(state, block, gained[b].flow, &pass[run]);
        accelerate(state, block, gained[b].flow);
        gained[b].bad = !kick(block.first, block.last, force.data(), {}, h, state, gained[b].gain);
    };
    const auto behind = [&](std::size_t b) { gained[b].bad |= !drift(wave.first(b), wave.last(b), h, state); };
    wave.go([](std::size_t) {}, work, behind);
    const Gained all = wave.total(gained);
    rates.flow = all.flow;
    return {{}, all.gain, !all.bad};
}

Dynamics::Wave Dynamics::drift_then_kick(double kick_time, double drift_time, State& state, Rates& rates) const {
    const carom::Wave wave(state.size(), reach_, threads_);
    std::vector<Gained> gained(wave.blocks());
    std::vector<SpringNetwork::Pass> pass = passes(wave, network_);
    Vec2* acceleration = rates.acceleration.linear.data();
    const auto kick_block = [&](std::size_t b, Flows& gain) {
        return kick(wave.first(b), wave.last(b), acceleration + wave.first(b), {}, kick_time, state, gain);
    };
    const auto ahead = [&](std::size_t b) {
        kick_block(b, gained[b].first_gain);
        gained[b].bad = !drift(wave.first(b), wave.last(b), drift_time, state);
    };
    const auto work = [&](std::size_t b, std::size_t run) {
        const std::size_t first = wave.first(b), last = wave.last(b);
        const Block block{first, last, acceleration + first, nullptr};
        write_forces_between(state, block, gained[b].flow, &pass[run]);
        accelerate(state, block, gained[b].flow);
        gained[b].bad |= !kick_block(b, gained[b].gain);
    };
    wave.go(ahead, work, [](std::size_t) {});
    const Gained all = wave.total(gained);
    rates.flow = all.flow;
    return {all.first_gain, all.gain, !all.bad};
}

}  // namespace carom
