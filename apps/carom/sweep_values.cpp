#include "sweep_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace carom::app {

namespace {

constexpr std::size_t most_runs = 1000000;

Error wrong(const std::string& text) {
    return Error(
        fmt::format("--sweep {}: must be NAME=FROM:TO, NAME=FROM:TO:BY or NAME=VALUE,VALUE,..., with at most a million "
                    "values",
                    text));
}

/// The parts between separators that are in no bracket and no quotes.
std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts{""};
    int open = 0;
    bool quoted = false;
    for (const char c : text) {
        if (c == '"') quoted = !quoted;
        open += c == '[' || c == '{' || c == '(' ? 1 : c == ']' || c == '}' || c == ')' ? -1 : 0;
        if (c == separator && open == 0 && !quoted)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

std::optional<double> read_number(const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return {};
    return number;
}

/// The value of an expression of numbers and parameters alone.
std::optional<double> read_expression(const std::string& text, const std::map<std::string, double>& parameters = {}) {
    try {
        constexpr double no_time = std::numeric_limits<double>::quiet_NaN();  // what depends on it is no number
        if (const double number = closed_form(text, parameters)(no_time); std::isfinite(number)) return number;
    } catch (const Error&) {
    }
    return {};
}

/// A decimal in units of its last digit, of a scale_of(); with 1 any number as it is.
double times(double x, double scale) { return scale == 1 ? x : std::round(x * scale); }

/// The power of ten that makes whole numbers of two decimals: counted in those, 0.1 three times is 0.3. 1 if there is
/// none, as of pi/4.
double scale_of(double a, double b) {
    constexpr double largest = 1e15;  // of which all digits are exact, times ten to some power as well
    double scale = 1;
    for (int digits = 0; digits <= 22; ++digits, scale *= 10) {  // beyond, powers of ten are rounded
        const auto is_whole = [scale](double x) {
            return std::abs(x * scale) < largest && std::round(x * scale) / scale == x;
        };
        if (is_whole(a) && is_whole(b)) return scale;
    }
    return 1;
}

/// The numbers of FROM:TO or FROM:TO:BY; nothing of any other text. An Error if some are numbers and one is not.
std::optional<std::vector<std::string>> read_range(const std::string& text) {
    const std::vector<std::string> parts = split(text, ':');
    if (parts.size() != 2 && parts.size() != 3) return {};
    std::vector<double> numbers;
    std::string other;
    for (const std::string& part : parts)
        if (const auto number = read_number(part))
            numbers.push_back(*number);
        else if (const auto value = read_expression(part))
            numbers.push_back(*value);  // such as 30*deg
        else
            other = part;
    // "a ? b : c" is an expression, and so may be what is before a comma.
    if (numbers.empty() || text.find_first_of("?,") != std::string::npos) return {};
    if (numbers.size() < parts.size())
        throw Error(fmt::format(
            "must be numbers from FROM to TO in steps of BY, as in 0:1:0.25 or 0:pi:pi/4, got \"{}\"", other));
    const double from = numbers[0], to = numbers[1], by = numbers.size() == 3 ? numbers[2] : 1;
    const double scale = scale_of(from, by), first = times(from, scale), each = times(by, scale);
    const double steps = std::floor((to * scale - first) / each + 1e-9);
    if (numbers.size() == 2 && !(std::abs(from + steps * by - to) <= 1e-9 * std::abs(to)))
        throw Error(fmt::format("goes from {} in steps of 1, which do not lead to {}: say by how much, as in {}:{}:{}",
                                from, to, from, to, (to - from) / 4));
    if (steps < 0)
        throw Error(fmt::format("leads away from {}: from {} to it BY is {}", to, from, to < from ? "< 0" : "> 0"));
    std::vector<std::string> values;
    if (!(steps >= 0 && steps < static_cast<double>(most_runs))) return values;
    for (double k = 0; k <= steps; ++k) {
        const double value = (first + k * each) / scale;
        const bool is_rounding = k > 0 && std::abs(value) < 1e-9 * std::abs(by);
        values.push_back(fmt::format("{}", is_rounding ? 0 : value));
    }
    return values;
}

/// What a value is as a number, if it is one.
std::optional<double> number_of(const Scene& scene, const std::string& name, const std::string& value) {
    const auto parameters = scene.parameters();
    if (const auto found = parameters.find(name); found != parameters.end()) return found->second;
    // A word alone is pi, or a method's name, whatever a parameter of that name is.
    const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; };
    const bool word = std::all_of(value.begin(), value.end(), letter);
    return read_expression(value, word ? std::map<std::string, double>{} : parameters);
}

Swept read_swept(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw wrong(text);
    Swept swept{.name = text.substr(0, equals)};
    const std::string values = text.substr(equals + 1);
    try {
        const auto range = read_range(values);
        swept.is_range = range.has_value();
        swept.values = range ? *range : split(values, ',');
    } catch (const Error& e) {
        throw Error(fmt::format("--sweep {}: {}", text, e.what()));
    }
    if (swept.values.empty() || std::count(swept.values.begin(), swept.values.end(), "") > 0) throw wrong(text);
    return swept;
}

}  // namespace

Sweep read_sweep(const std::vector<std::string>& texts) {
    if (texts.size() > 2) throw Error(fmt::format("--sweep {}: a sweep is over one parameter or two", texts.back()));
    Sweep sweep;
    for (const std::string& text : texts) sweep.over.push_back(read_swept(text));
    if (sweep.over.size() < 2) return sweep;
    const Swept &a = sweep.over[0], &b = sweep.over[1];
    if (a.name == b.name) throw Error(fmt::format("--sweep {}: {} is swept already", texts[1], b.name));
    if (a.values.size() * b.values.size() > most_runs)
        throw Error(fmt::format("--sweep {} --sweep {}: {} x {} runs, and a million is the most", texts[0], texts[1],
                                a.values.size(), b.values.size()));
    return sweep;
}

std::vector<Point> points_of(const Sweep& sweep) {
    std::vector<Point> points{{}};
    for (const Swept& parameter : sweep.over) {
        std::vector<Point> longer;
        for (const Point& point : points)
            for (const std::string& value : parameter.values) (longer.emplace_back(point)).push_back(value);
        points = std::move(longer);
    }
    return points;
}

std::vector<std::size_t> telling_points_of(const Sweep& sweep) {
    std::vector<std::size_t> telling;
    const std::size_t second = sweep.over.size() > 1 ? sweep.over[1].values.size() : 1;
    const std::size_t all = sweep.over[0].values.size() * second;
    const auto tells = [&](std::size_t parameter, std::size_t value) {
        const Swept& swept = sweep.over[parameter];
        return !swept.is_range || value == 0 || value + 1 == swept.values.size();
    };
    for (std::size_t k = 0; k < all; ++k) {
        const std::size_t i = k / second, j = k % second;
        if ((j == 0 && tells(0, i)) || (i == 0 && tells(1, j)) || k + 1 == all) telling.push_back(k);
    }
    return telling;
}

std::string in_words(const Sweep& sweep, const Point& point) {
    std::string words;
    for (std::size_t k = 0; k < point.size(); ++k)
        words += fmt::format("{}{}={}", k ? " " : "", sweep.over[k].name, point[k]);
    return words;
}

std::vector<std::optional<double>> numbers_of(const Scene& scene, const Sweep& sweep, const Point& point) {
    std::vector<std::optional<double>> numbers;
    for (std::size_t k = 0; k < point.size(); ++k) numbers.push_back(number_of(scene, sweep.over[k].name, point[k]));
    return numbers;
}

}  // namespace carom::app
