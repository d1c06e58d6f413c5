#include <carom/scene.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace carom {

namespace {

struct Sample {
    double t, value;
};

/// The cubic through the last four samples, or the lower polynomial through fewer (Lagrange).
double interpolated(const std::vector<Sample>& samples, double t) {
    double sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        double weight = samples[i].value;
        for (std::size_t j = 0; j < samples.size(); ++j)
            if (j != i) weight *= (t - samples[j].t) / (samples[i].t - samples[j].t);
        sum += weight;
    }
    return sum;
}

/// Where that cubic vanishes between the last two samples, which differ in sign.
double zero_of(const std::vector<Sample>& samples) {
    double low = samples[samples.size() - 2].t, high = samples.back().t;
    const bool falls = samples[samples.size() - 2].value > 0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((interpolated(samples, middle) > 0) == falls ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// The vertex of the parabola through the last three samples, whose middle one is the largest (in sign × value).
double vertex_of(const std::vector<Sample>& s) {
    const Sample a = s[s.size() - 3], b = s[s.size() - 2], c = s[s.size() - 1];
    const double left = (b.value - a.value) / (b.t - a.t), right = (c.value - b.value) / (c.t - b.t);
    const double curvature = (right - left) / (c.t - a.t);
    if (curvature == 0) return b.value;
    const double t = 0.5 * (a.t + b.t) - 0.5 * left / curvature;
    return a.value + left * (t - a.t) + curvature * (t - a.t) * (t - b.t);
}

}  // namespace

struct Judge::Watch {
    Expectation expectation;
    Quantity quantity;
    std::vector<Sample> last{};  // at most four
    double result = std::nan("");
    double area = 0, start = 0;
    int zeros = 0, side = 0;  // side: the sign of the last value that was not 0

    void observe(const World& world) {
        const Statistic what = expectation.statistic;
        if (what == Statistic::zero && zeros >= expectation.number) return;
        if (expectation.at && !last.empty() && last.back().t > *expectation.at) return;
        if (last.size() == 4) last.erase(last.begin());
        last.push_back({world.time(), quantity(world)});
        const Sample now = last.back(), before = last.size() > 1 ? last[last.size() - 2] : now;
        switch (what) {
            case Statistic::end: return at_time(now, before);
            case Statistic::maximum: return extreme(1);
            case Statistic::minimum: return extreme(-1);
            case Statistic::mean:
                if (last.size() == 1) start = now.t, result = now.value;
                area += 0.5 * (now.value + before.value) * (now.t - before.t);
                if (now.t > start) result = area / (now.t - start);
                return;
            case Statistic::zero:
                // A start at 0 is no change of sign; a value of exactly 0 between two signs is one.
                if (now.value == 0 || (now.value > 0 ? 1 : -1) == side) return;
                if (std::exchange(side, now.value > 0 ? 1 : -1) == 0) return;
                if (++zeros == expectation.number) result = before.value == 0 ? before.t : zero_of(last);
                return;
        }
    }

    void at_time(Sample now, Sample before) {
        if (!expectation.at)
            result = now.value;
        else if (std::abs(now.t - *expectation.at) <= 1e-9 * std::max(now.t - before.t, 1e-300))
            result = now.value;
        else if (before.t < *expectation.at && *expectation.at < now.t && std::isnan(result))
            result = interpolated(last, *expectation.at);
    }

    void extreme(double sign) {
        const auto larger = [&](double value) {
            if (std::isnan(result) || sign * value > sign * result) result = value;
        };
        larger(last.back().value);
        const std::size_t n = last.size();
        if (n >= 3 && sign * last[n - 2].value >= std::max(sign * last[n - 3].value, sign * last[n - 1].value))
            larger(vertex_of(last));
    }

    Verdict verdict() const {
        const double error = std::abs(result - expectation.value);
        const double allowed = expectation.relative ? expectation.tolerance * std::abs(expectation.value) : expectation.tolerance;
        return {expectation, result, error <= allowed};
    }
};

Judge::Judge(const Scene& scene, const World& start) {
    const auto expectations = scene.expectations();
    for (std::size_t i = 0; i < expectations.size(); ++i) {
        try {
            watches_.push_back(std::make_unique<Watch>(Watch{expectations[i], Quantity(expectations[i].quantity, start, scene.parameters())}));
        } catch (const Error& e) {
            throw Error(fmt::format("expects[{}].quantity is wrong: {}", i, e.what()));
        }
    }
    observe(start);
}
Judge::Judge(Judge&&) noexcept = default;
Judge::~Judge() = default;

void Judge::observe(const World& world) {
    for (const auto& watch : watches_) watch->observe(world);
}

std::vector<Verdict> Judge::verdicts() const {
    std::vector<Verdict> out;
    for (const auto& watch : watches_) out.push_back(watch->verdict());
    return out;
}

}  // namespace carom
