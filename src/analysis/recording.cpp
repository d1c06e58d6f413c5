#include "analysis/recording.hpp"

#include <algorithm>
#include <carom/analysis.hpp>
#include <cmath>
#include <limits>

#include "state/validate.hpp"
#include "world/steps.hpp"

namespace carom {

namespace {

constexpr double most_numbers = 3e6;  // in a recording: 24 MB
constexpr double most_samples = 500, fewest_samples = 25;

std::vector<double> state_of(const World& world) {
    std::vector<double> out;
    for (std::size_t i = 0; i < world.size(); ++i) {
        if (world.kinds()[i] != Kind::dynamic) continue;
        const double k = std::sqrt(world.moments_of_inertia()[i] / world.masses()[i]);
        const Vec2 x = world.positions()[i], v = world.velocities()[i];
        out.insert(out.end(), {x.x, x.y, k * world.angles()[i], v.x, v.y, k * world.angular_velocities()[i]});
    }
    return out;
}

/// A run that is being sampled. What the world had behind it is none of the run's.
struct Recorder {
    Recording& out;
    const std::vector<Probe>& probes;
    Energy first{};
    Momentum kept_before{}, walls_before{};
    std::uint64_t collisions_before = 0;

    void sample(const World& world) {
        out.state.push_back(state_of(world));
        for (std::size_t k = 0; k < probes.size(); ++k) out.probes[k].push_back({probes[k].value(world)});
        const MomentumBalance momentum = momentum_balance(world);
        const Momentum& kept = momentum.residual;
        const Energy e = energy(world);
        if (out.state.size() == 1) {
            first = e, kept_before = kept, walls_before = momentum.walls;
            collisions_before = world.collisions();
        }
        out.collisions.push_back(world.collisions() - collisions_before);
        for (const double joules :
             {e.kinetic + e.rotational, e.gravity - first.gravity, e.spring - first.spring, e.field - first.field})
            if (std::isfinite(joules)) out.energies = std::max(out.energies, std::abs(joules));
        out.made_or_lost.push_back(std::abs(e.residual - first.residual));
        out.run.energy_drift = std::max(out.run.energy_drift, out.made_or_lost.back());
        out.run.momentum_drift = std::max(out.run.momentum_drift, length(kept.linear - kept_before.linear));
        // Of what leaves a periodic box and comes in again elsewhere, the angular momentum about a point jumps.
        if (!world.periodic())
            out.run.angular_drift =
                std::max(out.run.angular_drift.value_or(0), std::abs(kept.angular - kept_before.angular));
        out.run.collisions = out.collisions.back();
        // What slides or rolls along strikes nothing.
        out.touched = out.touched || out.run.collisions > 0 || !world.contacts().empty() ||
                      e.heat.friction != first.heat.friction || momentum.walls.linear != walls_before.linear;
    }

    void leave_the_rest(std::size_t samples) {
        const double unreached = std::numeric_limits<double>::infinity();
        out.state.resize(samples, std::vector<double>(out.state[0].size(), unreached));
        for (Track& probe : out.probes) probe.resize(samples, {unreached});
        out.collisions.resize(samples, out.collisions.back());
        out.made_or_lost.resize(samples, unreached);
    }
};

}  // namespace

Schedule::Schedule(const World& start, const StudyPlan& plan) {
    validate_field(plan.duration, "study: duration", "s", positive);
    validate_field(plan.tolerance, "study: tolerance", "", positive);
    validate_field(plan.step, "study: step", "s", positive);
    const Steps steps(plan.duration, plan.step);
    const double whole = static_cast<double>(steps.whole);
    const double limit = start.stable_step();
    if (limit < plan.step && start.settings().long_step == LongStep::substep) cut_ = std::ceil(plan.step / limit);

    const double numbers = static_cast<double>(6 * start.size());
    const double samples = std::clamp(most_numbers / std::max(numbers, 1.0), fewest_samples, most_samples);
    const auto stride = static_cast<std::uint64_t>(std::max(1.0, std::ceil(whole / samples)));
    time_.push_back(0);
    for (std::uint64_t done = 0; done < steps.whole;) {
        const std::uint64_t now = std::min(stride, steps.whole - done);
        done += now;
        legs_.push_back({{now, plan.step}});
        time_.push_back(static_cast<double>(done) * plan.step);
    }
    if (steps.rest > 0) {
        if (legs_.empty()) legs_.emplace_back(), time_.push_back(0);
        legs_.back().push_back({1, steps.rest});
        time_.back() = plan.duration;
    }
    steps_ = whole + 1;
}

void Schedule::advance(World& world, const std::vector<Leg>& legs, double division) const {
    if (division == 0) {
        double whole = 0;
        for (const Leg& leg : legs) whole += static_cast<double>(leg.steps) * leg.step;
        return world.step(whole);
    }
    const double parts = division == 1 ? 1 : division * cut_;
    for (const Leg& leg : legs)
        for (std::uint64_t n = 0; n < leg.steps * static_cast<std::uint64_t>(parts); ++n) world.step(leg.step / parts);
}

Recording Schedule::record(World world, double division, const std::vector<Probe>& probes,
                           const std::function<void(double)>& progress) const {
    Recording out;
    out.probes.resize(probes.size());
    Recorder recorder{out, probes};
    recorder.sample(world);
    for (const auto& legs : legs_) {
        try {
            advance(world, legs, division);
        } catch (const Error& e) {
            if (e.cause() == Error::Cause::input) throw;
            out.run.failure = e.what();
            recorder.leave_the_rest(time_.size());
            break;
        }
        recorder.sample(world);
        progress(std::max(division, 1.0) * steps_ / static_cast<double>(legs_.size()));
    }
    return out;
}

}  // namespace carom
