#include "output/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carom {
namespace {

struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    void add(double value) {
        if (!std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool empty() const { return low > high; }
};

// Time series fill the width of their axes; other curves keep away from the border.
bool runs_along_x(const Panel& panel) {
    return panel.discs.empty() && panel.lines.empty() && panel.endless.empty() &&
           std::all_of(panel.curves.begin(), panel.curves.end(),
                       [](const Curve& curve) { return std::is_sorted(curve.x.begin(), curve.x.end()); });
}

void add_lines(const std::vector<Line>& lines, bool along_x, Extent& all) {
    for (const Line& line : lines) {
        all.add(along_x ? line.from.x : line.from.y);
        all.add(along_x ? line.to.x : line.to.y);
    }
}

Extent extent(const Panel& panel, bool along_x, bool log) {
    Extent all;
    add_lines(panel.lines, along_x, all);
    add_lines(panel.endless, along_x, all);
    for (const Curve& curve : panel.curves) {
        for (std::size_t i = 0; i < curve.x.size() && i < curve.y.size(); ++i) {
            const double value = along_x ? curve.x[i] : curve.y[i], bar = along_x ? 0 : bar_at(curve, i);
            for (const double end : {value - bar, value + bar})
                if (!log || end > 0) all.add(end);
        }
    }
    for (const DiscMark& disc : panel.discs) {
        const double centre = along_x ? disc.centre.x : disc.centre.y;
        all.add(centre - disc.radius);
        all.add(centre + disc.radius);
    }
    for (const ShapeMark& shape : panel.shapes)
        for (const Vec2 point : shape.points) all.add(along_x ? point.x : point.y);
    return all;
}

Axis linear(Extent data, double margin) {
    if (data.empty()) return {0, 1};
    const double more = margin * (data.high - data.low);
    const Interval seen = with_room(data.low - more, data.high + more);
    return {seen.low, seen.high};
}

/// Where a metre is as long on both axes, the other one says how large what is alike here is to be seen.
void widen_beside(Extent& data, const Extent& other) {
    const double half = 0.005 * (other.high - other.low), middle = data.low + (data.high - data.low) / 2;
    data.add(middle - half);
    data.add(middle + half);
}

// A room that encloses everything is the frame of its picture, without a margin.
bool enclosed(const Panel& panel, bool along_x, const Extent& all) {
    Extent room;
    add_lines(panel.lines, along_x, room);
    return room.low == all.low && room.high == all.high;
}

Axis around(const Panel& panel, bool along_x, double margin) {
    Extent data = extent(panel, along_x, false);
    if (enclosed(panel, along_x, data)) return linear(data, 0);
    if (panel.equal_aspect && !data.empty()) widen_beside(data, extent(panel, !along_x, false));
    return linear(data, margin);
}

Axis decades(Extent data) {
    Axis axis{0.1, 10, true};
    if (data.empty()) return axis;
    const double low = std::log10(data.low), high = std::log10(data.high);
    axis.low = std::floor(low);
    axis.high = std::ceil(high);
    if (high > low && axis.high - axis.low > 2 * (high - low)) {  // which would leave half of them empty
        constexpr double margin = 0.06;
        axis.low = low - margin * (high - low);
        axis.high = high + margin * (high - low);
    }
    if (axis.high == axis.low) axis.high += 1;
    axis.low = std::pow(10, axis.low);
    axis.high = std::pow(10, axis.high);
    return axis;
}

}  // namespace

double bar_at(const Curve& curve, std::size_t point) {
    return point < curve.error.size() && std::isfinite(curve.error[point]) ? curve.error[point] : 0;
}

Axes axes(const Panel& panel) {
    Axes both;
    const bool tight = runs_along_x(panel) && !panel.equal_aspect;
    const auto one = [&](bool along_x, bool log, const std::optional<Interval>& range, double margin) {
        if (range) return Axis{range->low, range->high, log};
        return log ? decades(extent(panel, along_x, true)) : around(panel, along_x, margin);
    };
    both.x = one(true, panel.log_x, panel.x_range, tight ? 0 : 0.03);
    both.y = one(false, panel.log_y, panel.y_range, panel.equal_aspect ? 0.03 : 0.06);
    return both;
}

Interval with_room(double low, double high) {
    const double largest = std::max(std::abs(low), std::abs(high));
    constexpr double rounding = 1e-11;  // of sums of larger terms that cancel, too
    if (high - low > std::max(rounding * largest, 1e-300)) return {low, high};
    const double room = largest > 1e-290 ? 1e-4 * largest : 1;
    return {low - room, high + room};
}

double Axis::unit() const { return std::pow(10.0, exponent); }

double Axis::beyond(double value, double part) const {
    return std::min(high, log ? value * std::pow(high / low, part) : value + part * (high - low));
}

double Axis::largest() const { return std::max(std::abs(low - offset), std::abs(high - offset)); }

void choose_offset(Axis& axis) {
    const double size = axis.high - axis.low;
    if (axis.log || size > 0.99e-4 * axis.largest()) return;
    const double power = std::pow(10.0, std::ceil(std::log10(size)));
    axis.offset = power * std::round((axis.low + 0.5 * size) / power);
}

namespace {

/// Numbers from low to high with one of these digits, and zeros.
std::vector<double> marks_of(const Axis& axis, std::initializer_list<int> digits) {
    std::vector<double> marks;
    for (double power = std::floor(std::log10(axis.low)); power <= std::log10(axis.high); ++power)
        for (const int digit : digits)
            if (const double mark = digit * std::pow(10.0, power); mark >= axis.low && mark <= axis.high)
                marks.push_back(mark);
    return marks;
}

}  // namespace

void choose_unit(Axis& axis, double largest) {
    if (axis.log || largest <= 0 || (largest >= 0.01 && largest < 1e5)) return;
    axis.exponent = 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
}

void choose_ticks(Axis& axis, double pixels, double apart) {
    const double count = std::max(2.0, pixels / apart);
    if (axis.log) {
        axis.step = std::max(1.0, std::ceil((std::log10(axis.high) - std::log10(axis.low)) / count));
        axis.marks.clear();
        if (marks_of(axis, {1}).size() > 1) return;
        axis.marks = marks_of(axis, {1, 2, 5});
        if (axis.marks.size() < 3) axis.marks = marks_of(axis, {1, 2, 3, 4, 5, 6, 7, 8, 9});
        return;
    }
    const double raw = (axis.high - axis.low) / axis.unit() / count;
    const double power = std::floor(std::log10(raw));
    const double digit = raw / std::pow(10.0, power);
    const bool short_axis = count < 5;  // which 1, 2, 5 alone would leave with two ticks
    constexpr std::array<double, 5> nice{1, 2, 2.5, 5, 10};
    std::size_t k = 0;
    while (digit > nice[k] && k + 1 < nice.size()) k += k == 1 && !short_axis ? 2 : 1;
    const auto ticks = [&] {
        const double unit = nice[k] * std::pow(10.0, power) * axis.unit();
        return std::floor((axis.high - axis.offset) / unit) - std::ceil((axis.low - axis.offset) / unit) + 1;
    };
    if (k > 0 && ticks() < 2) --k;  // a single tick shows no scale
    axis.step = nice[k] * std::pow(10.0, power);
    axis.decimals = std::max(0, (nice[k] == 2.5 ? 1 : nice[k] == 10 ? -1 : 0) - static_cast<int>(power));
}

std::size_t Axis::label_length() const {
    if (log && marks.empty()) return 4;  // 10⁻¹²
    if (log) return 6;                   // 2·10⁻⁷
    const double most = largest() / unit();
    const auto whole = static_cast<std::size_t>(std::max(0.0, std::floor(std::log10(std::max(most, 1.0))))) + 1;
    return whole + (decimals > 0 ? 1 + static_cast<std::size_t>(decimals) : 0) + (low < offset ? 1 : 0);
}

std::string mark_words(double value) {
    if (value > 0.999e-3 && value < 1e5) return fmt::format("{:.4g}", value);
    const double power = std::floor(std::log10(value) + 1e-9);
    return fmt::format("{:.0f}·{}", value / std::pow(10.0, power), power_of_ten(static_cast<int>(power)));
}

std::string power_of_ten(int exponent) {
    static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string result = exponent < 0 ? "10⁻" : "10";
    for (char c : fmt::format("{}", std::abs(exponent))) result += digits[c - '0'];
    return result;
}

std::string exact_words(double value) {
    const std::string words = fmt::format("{:.15g}", value);  // of rounding nothing is left
    const auto e = words.find('e');
    if (e == words.npos) return words;
    return fmt::format("{} · {}", words.substr(0, e), power_of_ten(std::stoi(words.substr(e + 1))));
}

std::string words_in_thousands(double value) {
    const int exponent = 3 * static_cast<int>(std::floor(std::log10(std::abs(value)) / 3 + 1e-9));
    return fmt::format("{:.6g} · {}", value / std::pow(10.0, exponent), power_of_ten(exponent));
}

std::string time_words(double time) {
    if (std::abs(time) < 1e5) return fmt::format("t = {:.6g} s", time);
    return fmt::format("t = {} s", words_in_thousands(time));
}

}  // namespace carom
