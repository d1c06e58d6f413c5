#include "analysis/growth.hpp"

#include <algorithm>
#include <carom/random.hpp>
#include <cmath>

#include "math/elementary.hpp"

namespace carom {

World perturbed(const World& start, const Track& state) {
    World out = start;
    Random random(1);
    std::size_t at = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (out.kinds()[i] != Kind::dynamic) continue;
        double fastest[3]{};
        for (const auto& sample : state)
            for (std::size_t k = 0; k < 3; ++k)
                if (std::isfinite(sample[at + 3 + k])) fastest[k] = std::max(fastest[k], std::abs(sample[at + 3 + k]));
        at += 6;
        const double k = std::sqrt(out.moments_of_inertia()[i] / out.masses()[i]);
        double change[3];
        for (std::size_t c = 0; c < 3; ++c) change[c] = perturbation * fastest[c] * random.normal();
        out.set_velocity(out.ids()[i], out.velocities()[i] + Vec2{change[0], change[1]},
                         out.angular_velocities()[i] + (k > 0 ? change[2] / k : 0));
    }
    return out;
}

namespace {

/// The slope of ln(distance) over time, by least squares.
double slope(const std::vector<double>& time, const std::vector<double>& distance, std::size_t from, std::size_t to) {
    double n = 0, st = 0, ss = 0, stt = 0, sts = 0;
    for (std::size_t i = from; i < to; ++i) {
        if (!(distance[i] > 0)) continue;
        const double t = time[i], s = portable::log(distance[i]);
        n += 1, st += t, ss += s, stt += t * t, sts += t * s;
    }
    return (n * sts - st * ss) / (n * stt - st * st);
}

}  // namespace

std::optional<Growth> growth_of(const std::vector<double>& time, const std::vector<double>& distance,
                                double tolerance) {
    constexpr double saturated = 1e-3, rounding = 1e-16;
    const auto end = static_cast<std::size_t>(
        std::find_if(distance.begin(), distance.end(), [](double d) { return !(d < saturated); }) - distance.begin());
    if (end < 8 || !(distance[1] > 0)) return {};

    // The largest distance so far, at the ends of four quarters: what only comes and goes does not count.
    double reached[4];
    for (std::size_t k = 0; k < 4; ++k)
        reached[k] =
            portable::log(*std::max_element(distance.begin(), distance.begin() + static_cast<long>((k + 1) * end / 4)));
    const double gained[3] = {reached[1] - reached[0], reached[2] - reached[1], reached[3] - reached[2]};
    const double mean = (reached[3] - reached[0]) / 3;
    // An exponential gains the same in every quarter; a power of time less and less: t^q gains q ln 2 in all over the
    // second half, and regular motion has q = 1, tides q = 2. Seven: a growth of a thousand over the window.
    const double cubic = 3 * portable::log(2), enough = 7;
    const auto steady = std::count_if(gained, gained + 3, [&](double g) { return g > 0.5 * mean; });
    if (gained[1] + gained[2] < cubic || 4 * mean < enough || steady < 2) return {};

    const double rate = slope(time, distance, end / 4, end);
    if (!(rate > 0)) return {};
    const double last = time[end - 1],
                 apart = *std::max_element(distance.begin(), distance.begin() + static_cast<long>(end));
    // From there on at the same rate to the tolerance; and rounding starts that much later than the perturbation.
    const double to_go = portable::log(tolerance / apart) + portable::log(perturbation / rounding);
    return Growth{rate, last + to_go / rate};
}

}  // namespace carom
