#include <fmt/format.h>

#include <algorithm>
#include <carom/scene.hpp>
#include <cmath>
#include <utility>

namespace carom {

namespace {

struct Sample {
    double t, value;
};

/// The cubic through the last four samples, or the lower polynomial through fewer (Lagrange).
double interpolated(const std::vector<Sample>& samples, double t) {
    double sum = 0;
    const std::size_t first = samples.size() > 4 ? samples.size() - 4 : 0;
    for (std::size_t i = first; i < samples.size(); ++i) {
        double weight = samples[i].value;
        for (std::size_t j = first; j < samples.size(); ++j)
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

/// The second divided difference about sample k.
double curvature_at(const std::vector<Sample>& s, std::size_t k) {
    const Sample a = s[k - 1], b = s[k], c = s[k + 1];
    return ((c.value - b.value) / (c.t - b.t) - (b.value - a.value) / (b.t - a.t)) / (c.t - a.t);
}

/// Whether the quantity bends about sample k as it does about the samples beside it. Through a jump or a kink a
/// parabola would be higher than the quantity ever was.
bool is_smooth_at(const std::vector<Sample>& s, std::size_t k) {
    const double own = curvature_at(s, k);
    const auto agrees = [&](std::size_t beside) {
        const double ratio = curvature_at(s, beside) / own;
        return ratio >= 0.5 && ratio <= 2;
    };
    const bool has_left = k >= 2, has_right = k + 2 < s.size();
    return (has_left || has_right) && (!has_left || agrees(k - 1)) && (!has_right || agrees(k + 1));
}

/// The larger (in sign × value) of sample k and, where it is an extreme of a smooth quantity, the vertex of the
/// parabola through it and the samples beside it.
double extreme_at(const std::vector<Sample>& s, std::size_t k, double sign) {
    const Sample a = s[k - 1], b = s[k], c = s[k + 1];
    if (sign * b.value < std::max(sign * a.value, sign * c.value) || !is_smooth_at(s, k)) return b.value;
    const double left = (b.value - a.value) / (b.t - a.t), curvature = curvature_at(s, k);
    const double t = 0.5 * (a.t + b.t) - 0.5 * left / curvature;
    return a.value + left * (t - a.t) + curvature * (t - a.t) * (t - b.t);
}

}  // namespace

struct Judge::Watch {
    std::string place;  // what errors call it
    Expectation expectation;
    Quantity quantity;
    std::vector<Sample> last{};  // at most five
    double result = std::nan("");
    double area = 0, start = 0;
    int zeros = 0;
    int sign = 0;                  // of the last value that was not zero
    double maybe = std::nan("");   // when it changed, where the next value says whether through zero
    std::uint64_t collisions = 0;  // until the last sample
    bool done = false;             // what comes later does not count
    bool broken = false;           // a value was not finite: no statistic of it means anything

    /// What changes in a run: all but the first three. (A name of a member would shadow it.)
    friend auto members(Maybe_const<Watch> auto& watch) {
        auto& [called, given, looked_at, w1, w2, w3, w4, w5, w6, w7, w8, w9, w10] = watch;
        return std::tie(w1, w2, w3, w4, w5, w6, w7, w8, w9, w10);
    }

    void observe(const World& world, const std::vector<GasNumber>& measures) {
        if (done) return;
        const Sample now{world.time(), value(world, measures)};
        if (!last.empty() && last.back().t == now.t) return;
        if (last.size() == 5) last.erase(last.begin());
        last.push_back(now);
        if (expectation.at) end_at(*expectation.at);
        if (!std::isfinite(last.back().value) && expectation.statistic != Statistic::end) broken = true;
        const Sample before = last.size() > 1 ? last[last.size() - 2] : last.back();
        switch (expectation.statistic) {
            case Statistic::end:
                result = !expectation.at || done ? last.back().value : std::nan("");
                return;
            case Statistic::maximum:
                return extreme(1);
            case Statistic::minimum:
                return extreme(-1);
            case Statistic::mean:
                return mean(before, last.back());
            case Statistic::zero:
                return change_of_sign(before, last.back(), world.collisions());
        }
    }

    double value(const World& world, const std::vector<GasNumber>& measures) const {
        try {
            return quantity(world, measures);
        } catch (const Error& e) {
            throw Error(fmt::format("{} is wrong at t = {:.4g} s: {}", place, world.time(), e.what()));
        }
    }

    /// A sample at or after the time that was asked for becomes the one at that time, and the last.
    void end_at(double at) {
        const Sample now = last.back();
        const double step = last.size() > 1 ? now.t - last[last.size() - 2].t : 0;
        if (now.t < at - 1e-9 * step) return;
        if (now.t > at + 1e-9 * step) last.back() = {at, interpolated(last, at)};
        done = true;
    }

    void extreme(double direction) {
        result = larger(direction, result, last.back().value);
        // How it bends is known on both sides when two more samples are.
        if (last.size() >= 4) result = larger(direction, result, extreme_at(last, last.size() - 3, direction));
    }
    static double larger(double direction, double known, double value) {
        return std::isnan(known) || direction * value > direction * known ? value : known;
    }

    /// The result, with an extreme about the last sample but one, behind which nothing came.
    double final_result() const {
        const double direction = expectation.statistic == Statistic::maximum   ? 1
                                 : expectation.statistic == Statistic::minimum ? -1
                                                                               : 0;
        if (direction == 0 || last.size() < 3) return result;
        return larger(direction, result, extreme_at(last, last.size() - 2, direction));
    }

    void mean(Sample before, Sample now) {
        if (last.size() == 1) start = now.t, result = now.value;
        area += 0.5 * (now.value + before.value) * (now.t - before.t);
        if (now.t > start) result = area / (now.t - start);
    }

    /// A value that starts at zero has not changed its sign, and one that touches zero has not either. What grows
    /// towards the change on both sides jumps there, as an angle does by a turn, or has a pole; but a velocity may in
    /// an impact.
    void change_of_sign(Sample before, Sample now, std::uint64_t collisions_now) {
        if (!std::isnan(maybe) && std::abs(now.value) > std::abs(before.value)) count(maybe);
        maybe = std::nan("");
        const bool struck = collisions_now != std::exchange(collisions, collisions_now);
        const int after = now.value > 0 ? 1 : now.value < 0 ? -1 : 0;
        if (after == 0 || zeros == expectation.number) return;
        const bool changed = sign != 0 && after != sign;
        sign = after;
        if (!changed) return;
        const double at = before.value == 0 ? before.t : zero_of(last);
        const bool grew = last.size() > 2 && std::abs(before.value) > std::abs(last[last.size() - 3].value);
        if (grew && !struck)
            maybe = at;
        else
            count(at);
    }
    void count(double at) {
        if (++zeros != expectation.number) return;
        result = at;
        done = true;
    }

    Verdict verdict(bool cut_short) const {
        if (!done && (cut_short || expectation.at)) return {expectation, std::nan(""), false, false};
        // Of a change in the last step nothing says that it is no zero.
        const bool at_the_end = std::isnan(result) && zeros + 1 == expectation.number;
        const double value = broken ? std::nan("") : at_the_end ? maybe : final_result();
        const double error = std::abs(value - expectation.value);
        const double allowed =
            expectation.relative ? expectation.tolerance * std::abs(expectation.value) : expectation.tolerance;
        return {expectation, value, error <= allowed};
    }
};

Judge::Judge(const Scene& scene, const World& start) : plan_(scene.plan()) {
    const auto expectations = scene.expectations();
    const auto parameters = scene.parameters();
    for (std::size_t i = 0; i < expectations.size(); ++i) {
        const std::string place = fmt::format("{}: expects[{}].quantity", scene.file(), i);
        try {
            watches_.push_back(std::make_unique<Watch>(
                Watch{place, expectations[i], {expectations[i].quantity, start, parameters, true}}));
            if (!watches_.back()->quantity.needs_measures()) continue;
            if (expectations[i].statistic != Statistic::end || expectations[i].at)
                throw Error("measures of a gas are known at the end alone: 'statistic' must be end, without 'at'");
            if (!meter_) meter_.emplace(start);
        } catch (const Error& e) {
            throw Error(fmt::format("{} is wrong: {}", place, e.what()));
        }
    }
    observe(start);
}
Judge::Judge(Judge&&) noexcept = default;
Judge::~Judge() = default;

void Judge::observe(const World& world) {
    const std::uint64_t steps = steps_of(plan_);
    const bool end = seen_ == steps;
    // What is measured looks as often as data do.
    if (meter_ && (end || seen_ % static_cast<std::uint64_t>(plan_.every) == 0))
        meter_->observe(world, plan_.measure_from);
    ++seen_;
    const auto measures = meter_ && end ? meter_->numbers() : std::vector<GasNumber>{};
    for (const auto& watch : watches_)
        if (end || !watch->quantity.needs_measures()) watch->observe(world, measures);
}

void Judge::save(Saver& to) const {
    to(seen_);
    if (meter_) meter_->save(to);
    for (const auto& watch : watches_) to(std::as_const(*watch));
}
void Judge::restore(Loader& from) {
    from(seen_);
    if (meter_) meter_->restore(from);
    for (const auto& watch : watches_) from(*watch);
}

std::uint64_t steps_of(const Plan& plan) { return steps_of(plan.duration, plan.step); }

std::vector<Verdict> Judge::verdicts(bool cut_short) const {
    std::vector<Verdict> out;
    for (const auto& watch : watches_) out.push_back(watch->verdict(cut_short));
    return out;
}

}  // namespace carom
