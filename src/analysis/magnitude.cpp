#include "analysis/magnitude.hpp"

#include <algorithm>
#include <carom/analysis.hpp>
#include <carom/random.hpp>
#include <cmath>

namespace carom {

namespace {

/// The largest of a kind in a world and its run. None is compared with another, for each has a unit of its own.
struct Extremes {
    double place = 0, turn = 1, speed = 0, energy = 0;  // [m, rad, m/s, J]
};

Extremes extremes_of(const World& start, const Track& raw) {
    Extremes out;
    const auto grow = [](double& most, double value) {
        if (std::isfinite(value)) most = std::max(most, std::abs(value));
    };
    for (const auto& sample : raw)
        for (std::size_t i = 0; i < sample.size(); ++i) grow(i % 6 < 3 ? out.place : out.speed, sample[i]);
    const Energy e = energy(start);
    for (const double joules : {e.kinetic + e.rotational, e.gravity, e.spring, e.field}) grow(out.energy, joules);
    double mass = 0;
    for (std::size_t i = 0; i < start.size(); ++i)
        if (start.kinds()[i] == Kind::dynamic) mass += start.masses()[i], grow(out.turn, start.angles()[i]);
    // So fast all could be, who are at rest now.
    if (mass > 0) grow(out.speed, std::sqrt(2 * out.energy / mass));
    return out;
}

/// How far anything goes in a run, and how fast.
Extremes ways_of(const World& start, const Track& raw) {
    Extremes out{.turn = 0};
    for (const auto& sample : raw)
        for (std::size_t i = 0, row = 0; i + 5 < sample.size(); i += 6, ++row) {
            while (start.kinds()[row] != Kind::dynamic) ++row;
            const Vec2 way{sample[i] - raw[0][i], sample[i + 1] - raw[0][i + 1]};
            const double inertia = start.moments_of_inertia()[row], angle = sample[i + 2] - raw[0][i + 2];
            const double turn = inertia > 0 ? std::abs(angle) / std::sqrt(inertia / start.masses()[row]) : 0;
            const double speed = length({sample[i + 3], sample[i + 4]});
            if (!std::isfinite(length(way) + turn + speed)) continue;
            out.place = std::max(out.place, length(way)), out.turn = std::max(out.turn, turn);
            out.speed = std::max(out.speed, speed);
        }
    return out;
}

World strewn(const World& start, const Extremes& most, Random& random) {
    World out = start;
    const double turning = most.place > 0 ? most.speed / most.place : 0;
    const auto part = [&](double of) { return of * random.uniform(-1, 1); };
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (out.kinds()[i] != Kind::dynamic) continue;
        const double x = part(most.place), y = part(most.place), angle = part(most.turn);
        const double vx = part(most.speed), vy = part(most.speed), w = part(turning);
        out.set_position(out.ids()[i], out.positions()[i] + Vec2{x, y}, out.angles()[i] + angle);
        out.set_velocity(out.ids()[i], out.velocities()[i] + Vec2{vx, vy}, out.angular_velocities()[i] + w);
    }
    return out;
}

/// By how much each number changes at most, where bodies are strewn.
std::vector<double> changes(const World& start, const Extremes& most, const std::vector<Probe>& probes) {
    std::vector<double> out(probes.size(), 0.0);
    Random random(1);
    constexpr int draws = 4;
    for (int n = 0; n < draws; ++n) {
        const World elsewhere = strewn(start, most, random);
        for (std::size_t k = 0; k < probes.size(); ++k) {
            const double change = std::abs(probes[k].value(elsewhere) - probes[k].value(start));
            if (std::isfinite(change)) out[k] = std::max(out[k], change);
        }
    }
    return out;
}

}  // namespace

std::vector<double> magnitudes(const World& start, const Track& raw, const std::vector<Probe>& probes) {
    const Extremes most = extremes_of(start, raw);
    std::vector<double> out = changes(start, most, probes);
    for (double& magnitude : out)
        if (magnitude == 0) magnitude = most.energy;
    return out;
}

std::vector<double> scales(const World& start, const Track& raw, const std::vector<Probe>& probes) {
    return changes(start, ways_of(start, raw), probes);
}

}  // namespace carom
