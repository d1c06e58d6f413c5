#include "sweep_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "outputs.hpp"

namespace carom::app {

namespace {

constexpr std::size_t most_curves = 7;  // that have colours of their own
/// Of the first curves in these colours, of the next in the same, and of all others.
constexpr Stroke strokes[] = {Stroke::line_and_points, Stroke::dashed, Stroke::dotted};

/// Whether all values of a parameter are numbers.
bool is_axis(std::size_t parameter, const std::vector<SweepRow>& rows) {
    return std::all_of(rows.begin(), rows.end(), [=](const SweepRow& r) { return r.numbers[parameter].has_value(); });
}

/// Of one result over a parameter; of those rows alone that have this word for the other one, unless it is empty.
Curve curve_of(const std::vector<SweepRow>& rows, std::size_t result, std::size_t parameter, const std::string& word) {
    std::vector<const SweepRow*> points;
    for (const SweepRow& row : rows)
        if (word.empty() || row.words[1 - parameter] == word) points.push_back(&row);
    std::stable_sort(points.begin(), points.end(), [=](const SweepRow* a, const SweepRow* b) {
        return *a->numbers[parameter] < *b->numbers[parameter];
    });
    Curve curve{.stroke = strokes[0]};
    for (const SweepRow* point : points) {
        curve.x.push_back(*point->numbers[parameter]);
        curve.y.push_back(point->results[result]);
        curve.error.push_back(point->errors[result]);
    }
    return curve;
}

/// All finite numbers of some curves along an axis, the least first.
std::vector<double> values_of(const std::vector<Curve>& curves, std::vector<double> Curve::*along) {
    std::vector<double> all;
    for (const Curve& curve : curves)
        for (const double value : curve.*along)
            if (std::isfinite(value)) all.push_back(value);
    std::sort(all.begin(), all.end());
    return all;
}

/// Whether most of some values would lie in a corner of an even axis: they are positive, the last is many times the
/// first, and the one in the middle far from half way between them.
bool span_decades(const std::vector<double>& sorted) {
    constexpr double many = 30, least = 1e-290;  // beyond which no margin is left that is a number
    if (sorted.empty() || sorted.front() < least || sorted.back() < many * sorted.front()) return false;
    return sorted[(sorted.size() - 1) / 2] < 0.25 * sorted.back();
}

/// The largest gap between neighbours over the smallest.
double unevenness(const std::vector<double>& sorted) {
    double least = INFINITY, most = 0;
    for (std::size_t k = 1; k < sorted.size(); ++k) {
        const double gap = sorted[k] - sorted[k - 1];
        least = std::min(least, gap), most = std::max(most, gap);
    }
    return most / least;
}

/// Whether values of a parameter go on by factors, as 0.1, 0.05, 0.025 do, and not by steps.
bool is_geometric(std::vector<double> sorted) {
    constexpr double many = 3, least = 1e-290, more_even = 1.5;
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (sorted.size() < 3 || sorted.front() < least || sorted.back() < many * sorted.front()) return false;
    std::vector<double> logs;
    for (const double value : sorted) logs.push_back(std::log(value));
    return unevenness(sorted) > more_even * unevenness(logs);
}

/// Of a parameter. Steps that are halved make an order a slope, as steps over decades do.
bool is_logarithmic(const std::vector<double>& sorted) { return span_decades(sorted) || is_geometric(sorted); }

/// Of a result. Over a logarithmic axis a power is a line only on another one.
bool is_result_logarithmic(const std::vector<double>& sorted, bool over_log) {
    constexpr double many = 3, least = 1e-290;
    if (over_log && !sorted.empty() && sorted.front() > least && sorted.back() > many * sorted.front()) return true;
    return span_decades(sorted);
}

/// Around all points: on the frame they would be cut in two.
Interval with_margin(const std::vector<double>& sorted, bool log) {
    if (sorted.empty()) return {};
    const double low = sorted.front(), high = sorted.back();
    if (log) {
        const double factor = std::min(std::pow(high, 0.03) / std::pow(low, 0.03), 10.0);
        return {low / factor, high * factor};
    }
    const double large = std::max(std::abs(low), std::abs(high));
    const bool is_range = high - low > 1e-11 * large;  // and not rounding
    const double margin = is_range ? 0.03 * (high - low) : std::max(0.5, 1e-4 * large);
    return {low - margin, high + margin};
}

/// A number of many digits, as it is read in a legend.
std::string short_of(const std::string& word) {
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc() && end == word.data() + word.size() ? fmt::format("{:.6g}", number) : word;
}

HeatMap map_of(const std::vector<SweepRow>& rows, std::size_t result, const std::string& label) {
    std::set<double> x, y;
    std::map<std::pair<double, double>, double> values;  // at (y, x), so that they come row by row
    for (const SweepRow& row : rows) {
        x.insert(*row.numbers[0]), y.insert(*row.numbers[1]);
        values.emplace(std::pair(*row.numbers[1], *row.numbers[0]), row.results[result]);
    }
    HeatMap map{.x = {x.begin(), x.end()}, .y = {y.begin(), y.end()}, .label = label};
    for (const double of_row : y)
        for (const double of_column : x) {
            const auto found = values.find({of_row, of_column});
            map.values.push_back(found == values.end() ? std::numeric_limits<double>::quiet_NaN() : found->second);
        }
    return map;
}

/// What is larger, or its distance from another number, could not be told from what is infinite.
void check_axis(const Sweep& sweep, std::size_t parameter, const std::vector<SweepRow>& rows) {
    constexpr double largest = 1e300;
    for (const SweepRow& row : rows)
        if (const double number = *row.numbers[parameter]; std::abs(number) > largest)
            throw Error(fmt::format("--picture {}: draws over numbers up to {}, and a value of {} is {}", sweep.picture,
                                    largest, sweep.over[parameter].name, number));
}

}  // namespace

void check_sweep_picture(const Sweep& sweep, const std::vector<SweepRow>& rows) {
    const std::string ending = std::filesystem::path(sweep.picture).extension().string();
    if (ending != ".png" && ending != ".svg" && ending != ".pdf")
        throw Error(fmt::format("--picture {}: must end with .png, .svg or .pdf", sweep.picture));
    check_folder(sweep.picture);
    bool has_axis = false;
    for (std::size_t k = 0; k < sweep.over.size(); ++k)
        if (is_axis(k, rows)) check_axis(sweep, k, rows), has_axis = true;
    if (has_axis) return;
    throw Error(fmt::format("--picture {}: draws over numbers, and not all values of {} are", sweep.picture,
                            sweep.over.back().name));
}

Figure sweep_figure(const Sweep& sweep, const std::vector<std::string>& labels, const std::vector<SweepRow>& rows) {
    const bool grid = sweep.over.size() > 1;
    // Along x is the first parameter, if it can be.
    const std::size_t along = is_axis(0, rows) ? 0 : 1, other = 1 - along;
    const bool map = grid && is_axis(other, rows) && sweep.over[other].values.size() > most_curves;
    Figure figure;
    figure.columns = labels.size() > 3 ? 2 : 1;
    figure.shared_x = !map && labels.size() > 1;
    for (std::size_t k = 0; k < labels.size(); ++k) {
        if (map) {
            HeatMap cells = map_of(rows, k, labels[k]);
            const bool log_x = is_logarithmic(cells.x), log_y = is_logarithmic(cells.y);
            figure.panels.push_back(map_panel(std::move(cells), sweep.over[0].name, sweep.over[1].name, log_x, log_y));
            continue;
        }
        Panel panel{.x_label = sweep.over[along].name, .y_label = labels[k]};
        const auto words = grid ? sweep.over[other].values : std::vector<std::string>{""};
        for (std::size_t i = 0; i < words.size(); ++i) {
            Curve curve = curve_of(rows, k, along, words[i]);
            if (grid && k == 0) curve.label = fmt::format("{} = {}", sweep.over[other].name, short_of(words[i]));
            curve.colour = palette(i);
            if (curve.x.size() > 1) curve.stroke = strokes[std::min(i / most_curves, std::size(strokes) - 1)];
            panel.curves.push_back(std::move(curve));
        }
        const std::vector<double> x = values_of(panel.curves, &Curve::x);
        panel.log_x = is_logarithmic(x);
        panel.log_y = is_result_logarithmic(values_of(panel.curves, &Curve::y), panel.log_x);
        panel.x_range = with_margin(x, panel.log_x);
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

}  // namespace carom::app
