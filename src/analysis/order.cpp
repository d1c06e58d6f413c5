#include "analysis/order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/elementary.hpp"

namespace carom {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double reference_error = 1e-9;  // relative to the largest value
constexpr double own_ways = 0.1;          // of the size: runs so far apart go theirs

/// The difference of two samples, of angles the shorter way round.
double difference(double a, double b, double period) {
    const double d = a - b;
    return period > 0 ? d - period * std::round(d / period) : d;
}

/// The largest size of a vector in a run, or of its change since the start.
double extent(const Track& track, bool change) {
    double most = 0;
    for (const auto& sample : track) {
        double sum = 0;
        for (std::size_t i = 0; i < sample.size(); ++i) {
            const double value = change ? sample[i] - track[0][i] : sample[i];
            sum += value * value;
        }
        if (std::isfinite(sum)) most = std::max(most, std::sqrt(sum));
    }
    return most;
}

/// Richardson's assumption, put to the test: the error of a run is a shape that shrinks by ratio^order from one run to
/// the next. So the differences of the first two runs and of the last two have to be parallel, all over the window.
struct Shape {
    double coarse = 0, fine = 0, product = 0;  // sums of squares and of products

    void add(const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& c, double period) {
        double coarse_here = 0, fine_here = 0, product_here = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double ab = difference(a[i], b[i], period), bc = difference(b[i], c[i], period);
            coarse_here += ab * ab, fine_here += bc * bc, product_here += ab * bc;
        }
        if (!std::isfinite(coarse_here + fine_here)) return;
        coarse += coarse_here, fine += fine_here, product += product_here;
    }
    bool parallel() const {
        constexpr double cosine = 0.95;
        return product > cosine * std::sqrt(coarse) * std::sqrt(fine);
    }
};

/// The order in the samples before `end`, if there is one and rounding does not drown it. Errors that are mere delays
/// are parallel whatever their sizes; so half the samples must have the same order.
std::optional<double> order_within(std::size_t end, const std::array<const Track*, 3>& runs, double floor,
                                   const Ladder& ladder, double period) {
    Shape shape, half;
    for (std::size_t i = 1; i < end; ++i) {
        shape.add((*runs[0])[i], (*runs[1])[i], (*runs[2])[i], period);
        if (i == end / 2) half = shape;
    }
    constexpr double clear_of_rounding = 10, least_order = 0.5, same = 0.25;
    if (end < 2 || !(std::sqrt(shape.fine / static_cast<double>(end)) > clear_of_rounding * floor)) return {};
    if (!shape.parallel()) return {};
    const auto order_of = [&](const Shape& s) {
        return 0.5 * portable::log(s.coarse / s.fine) / portable::log(ladder.ratio);
    };
    const double order = order_of(shape);
    const bool half_counts = std::sqrt(half.fine / static_cast<double>(end)) > clear_of_rounding * floor;
    if (half_counts && !(std::abs(order_of(half) - order) < same)) return {};
    return order > least_order ? std::optional(order) : std::nullopt;
}

/// The samples before the first that is so far off.
std::size_t samples_within(const std::vector<double>& distance, double far) {
    return static_cast<std::size_t>(
        std::find_if(distance.begin(), distance.end(), [&](double d) { return !(d < far); }) - distance.begin());
}

/// The range of a number. One that shrinks with the step, on to the reference, belongs to a constant, and it is the
/// constant that counts. What shrinks altogether, or is rounding, is nothing but error and has no size.
double size_of(const std::array<const Track*, 3>& runs, const Track* reference, const Ladder& ladder,
               double magnitude) {
    const auto shrinks = [&](bool change) {
        constexpr double clearly = 0.6;  // at order 1 it is a half
        const double a = extent(*runs[0], change), b = extent(*runs[1], change), c = extent(*runs[2], change);
        return b < clearly * a && c < clearly * b && !(reference && extent(*reference, change) > clearly * c);
    };
    const double range = extent(*runs[2], true), value = extent(*runs[2], false);
    if (value <= 10 * ladder.rounding * magnitude) return 0;
    if (!shrinks(true) && range > 10 * ladder.rounding * std::max(value, magnitude)) return range;
    return shrinks(false) ? 0 : value;
}

}  // namespace

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

std::vector<double> distances(const Track& a, const Track& b, double period) {
    std::vector<double> out;
    for (std::size_t i = 0; i < a.size(); ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < a[i].size(); ++k) {
            if (std::isnan(a[i][k]) || std::isnan(b[i][k])) continue;
            const double d = difference(a[i][k], b[i][k], period);
            sum += d * d;
        }
        out.push_back(std::isfinite(sum) ? std::sqrt(sum) : infinite);
    }
    // An impact that falls on this side of a sample in one run and on that side in the other: no error that lasts.
    for (std::size_t i = 1; i + 1 < out.size(); ++i)
        if (out[i - 1] < out[i] && out[i + 1] < out[i]) out[i] = std::max(out[i - 1], out[i + 1]);
    return out;
}

namespace {

/// Whether the runs converge to the reference: the finest is no farther from it than from the run before.
bool converges(const std::array<const Track*, 3>& runs, const Track& reference, std::size_t end, double floor,
               double period) {
    const auto last = distances(*runs[2], reference, period), before = distances(*runs[1], *runs[2], period);
    double a = 0, b = 0;
    for (std::size_t i = 0; i < end; ++i) a += last[i] * last[i], b += before[i] * before[i];
    constexpr double slack = 1.5;  // at order 1 the two are equal
    return std::sqrt(a) <= slack * std::sqrt(b) + std::sqrt(static_cast<double>(end)) * 10 * floor;
}

/// By what the second difference of runs is less than the first, before they go their own ways. Two that are as large
/// say little; then the error is taken to be no more than so many times what is seen.
double shrink_of(const std::vector<double>& first, const std::vector<double>& second, std::size_t end) {
    constexpr double slowest = 0.9;
    double a = 0, b = 0;
    for (std::size_t i = 0; i < end; ++i) a += first[i] * first[i], b += second[i] * second[i];
    return b > 0 ? std::min(std::sqrt(b / a), slowest) : 0;
}

}  // namespace

Followed follow(const std::array<const Track*, 3>& runs, const Track* reference, const Ladder& ladder, double size,
                double period, double magnitude) {
    Followed out;
    out.size = size > 0 ? size : size_of(runs, reference, ladder, magnitude);
    const double floor = ladder.rounding * extent(*runs[2], false);
    const auto apart = distances(*runs[0], *runs[1], period);
    const std::size_t all = apart.size();

    // The whole run; while the runs stay together; before the first impact.
    std::vector<std::size_t> windows{all, samples_within(apart, 0.01 * out.size)};
    if (ladder.impact)
        windows.push_back(static_cast<std::size_t>(
            std::lower_bound(ladder.time.begin(), ladder.time.end(), *ladder.impact) - ladder.time.begin()));
    if (ladder.impact && !ladder.smooth_impacts) windows.erase(windows.begin(), windows.end() - 1);
    std::size_t window = all;
    for (std::size_t k = 0; k < windows.size() && !out.order; ++k)
        if ((out.order = order_within(windows[k], runs, floor, ladder, period))) window = windows[k];
    // What is as small as rounding beside what it is made of has the order of chance.
    if (size == 0 && extent(*runs[2], false) <= 10 * ladder.rounding * magnitude) out.order.reset(), window = all;
    out.order_until = ladder.time[window - 1];

    const std::size_t together = std::max<std::size_t>(2, std::min(samples_within(apart, own_ways * out.size), all));
    const bool has_truth = reference && (!ladder.impact || ladder.smooth_impacts);
    if (std::max(largest(apart), largest(distances(*runs[0], *runs[2], period))) <= 10 * floor)
        out.by = ErrorBy::rounding;
    else if (has_truth && converges(runs, *reference, together, floor, period))
        out.by = ErrorBy::reference;
    else
        out.by = out.order && window == all ? ErrorBy::order : ErrorBy::difference;
    if (out.by == ErrorBy::difference && !has_truth)  // else the reference says how far off, and needs no estimate
        out.shrink = shrink_of(apart, distances(*runs[1], *runs[2], period), together);
    auto error = errors_of(0, out, runs, reference, ladder, period);

    // Runs can agree and be wrong: where all of them meet a fast force at the same phase, or do not feel the tolerance.
    const bool agree = out.by == ErrorBy::rounding || together == all;
    if (has_truth && agree && out.by != ErrorBy::reference) {
        const double off = largest(distances(*runs[2], *reference, period));
        const double seen = largest(error) + 10 * floor;
        const double blur = reference_error * std::max({extent(*runs[2], false), size, magnitude});
        out.apart = std::isfinite(off) && off > seen + blur;
    }
    if (out.apart) {
        out.by = ErrorBy::reference;
        out.order.reset();  // it is that of the way to somewhere else
        error = errors_of(0, out, runs, reference, ladder, period);
    }
    out.error = largest(error);
    out.end_error = error.back();
    if (!runs[0]->back().empty()) out.value = runs[0]->back()[0];
    return out;
}

std::vector<double> errors_of(std::size_t level, const Followed& followed, const std::array<const Track*, 3>& runs,
                              const Track* reference, const Ladder& ladder, double period) {
    if (followed.by == ErrorBy::reference) return distances(*runs[level], *reference, period);
    if (followed.by != ErrorBy::order) {
        auto out = distances(*runs[level], *runs[2], period);
        // Of what may be left, the sum of a geometric series; of runs that go their own ways it says nothing.
        const double all = 1 / (1 - (level == 0 ? followed.shrink * followed.shrink : followed.shrink));
        for (double& error : out) error = std::max(error, std::min(error * all, own_ways * followed.size));
        return out;
    }
    auto out = distances(*runs[level], *runs[level + 1], period);
    const double shrinks = portable::pow(ladder.ratio, *followed.order);
    for (double& error : out) error *= shrinks / (shrinks - 1);
    return out;
}

}  // namespace carom
