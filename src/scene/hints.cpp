#include "scene/hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "state/nearest.hpp"

namespace carom {

namespace {

constexpr LookAlike look_alikes[] = {{"−", "a typographic minus (U+2212)", "-"},
                                     {"–", "a dash (U+2013)", "-"},
                                     {"—", "a dash (U+2014)", "-"},
                                     {"‐", "a typographic hyphen (U+2010)", "-"},
                                     {"‑", "a typographic hyphen (U+2011)", "-"},
                                     {"－", "a wide minus (U+FF0D)", "-"},
                                     {"×", "a typographic times sign (U+00D7)", "*"},
                                     {"·", "a typographic times sign (U+00B7)", "*"},
                                     {"⋅", "a typographic times sign (U+22C5)", "*"},
                                     {"÷", "a typographic division sign (U+00F7)", "/"},
                                     {"²", "a raised 2 (U+00B2)", "^2"},
                                     {"³", "a raised 3 (U+00B3)", "^3"},
                                     {"≤", "a typographic sign (U+2264)", "<="},
                                     {"≥", "a typographic sign (U+2265)", ">="},
                                     {"≠", "a typographic sign (U+2260)", "!="},
                                     {"π", "a Greek letter (U+03C0)", "pi"},
                                     {"‘", "a typographic quote (U+2018)", "'"},
                                     {"’", "a typographic quote (U+2019)", "'"},
                                     {"\u00a0", "no plain blank (U+00A0)", " "},
                                     {"\u2009", "no plain blank (U+2009)", " "},
                                     {"\u202f", "no plain blank (U+202F)", " "}};

struct Elsewhere {
    std::string_view there, here;
};
// The logarithms first of all: the nearest name here is another function.
constexpr Elsewhere names_elsewhere[] = {{"log10", "ln(x)/ln(10)"},
                                         {"log2", "ln(x)/ln(2)"},
                                         {"exp2", "2^x"},
                                         {"if", "c ? a : b"},
                                         {"where", "c ? a : b"},
                                         {"round", "floor(x + 0.5)"},
                                         {"trunc", "sign(x)*floor(abs(x))"},
                                         {"int", "sign(x)*floor(abs(x))"},
                                         {"fmod", "sign(a)*mod(abs(a), abs(b)), or mod(a, b)"},
                                         {"remainder", "mod(a, b)"},
                                         {"cbrt", "sign(x)*abs(x)^(1/3)"},
                                         {"e", "exp(1)"},
                                         {"sqr", "x^2"},
                                         {"square", "x^2"},
                                         {"sgn", "sign(x)"},
                                         {"fabs", "abs(x)"},
                                         {"ceiling", "ceil(x)"},
                                         {"clamp", "min(max(x, low), high)"},
                                         {"clip", "min(max(x, low), high)"},
                                         {"heaviside", "(x > 0)"},
                                         {"sec", "1/cos(x)"},
                                         {"csc", "1/sin(x)"},
                                         {"cot", "1/tan(x)"},
                                         {"asinh", "ln(x + sqrt(x^2 + 1))"},
                                         {"acosh", "ln(x + sqrt(x^2 - 1))"},
                                         {"atanh", "ln((1 + x)/(1 - x))/2"},
                                         {"rad", "x*deg"},
                                         {"radians", "x*deg"},
                                         {"deg2rad", "x*deg"},
                                         {"degrees", "x/deg"},
                                         {"rad2deg", "x/deg"}};
constexpr Elsewhere operators_elsewhere[] = {{"%", "mod(a, b)"}, {"mod", "mod(a, b)"}, {"&", "a && b"},
                                             {"and", "a && b"},  {"|", "a || b"},      {"or", "a || b"},
                                             {"=", "a == b"},    {"if", "c ? a : b"}};

}  // namespace

std::string instead_of(std::string_view name, const std::vector<std::string>& known) {
    for (const auto& [there, here] : names_elsewhere)
        if (name == there) return fmt::format("; that is written {}", here);
    return did_you_mean(name, known);
}

std::string written_for(std::string_view rest) {
    for (const auto& [there, here] : operators_elsewhere) {
        if (!rest.starts_with(there)) continue;
        const std::string_view next = rest.substr(there.size());
        if (there[0] < 'a' || next.empty() || next[0] == ' ' || next[0] == '(')
            return fmt::format("; that is written {}", here);
    }
    return "";
}

const LookAlike* look_alike_in(std::string_view text, std::size_t& at) {
    const LookAlike* first = nullptr;
    for (const LookAlike& one : look_alikes)
        if (const std::size_t found = text.find(one.seen); found != text.npos && (!first || found < at))
            first = &one, at = found;
    return first;
}

std::string in_words(const LookAlike& one) {
    return fmt::format("'{}' is {}, and what is meant is written '{}'", one.seen, one.name, one.meant);
}

std::string about_units(const std::string& text) {
    constexpr std::string_view units[] = {"m", "cm", "mm", "km", "kg", "g",  "t", "s",  "ms",  "min", "h",
                                          "N", "kN", "J",  "kJ", "W",  "Pa", "K", "Hz", "rad", "C",   "u"};
    const std::size_t number = text.find_first_not_of("+-0123456789.eE \t");
    if (number == text.npos || number == 0 || text.find_first_of("0123456789") >= number) return "";
    const std::string_view rest = std::string_view(text).substr(number);
    const std::string_view unit = rest.substr(0, std::min(rest.find_first_of("/*^ "), rest.size()));
    if (unit == "°" || unit == "deg" || unit == "degrees")
        return fmt::format("; angles are in rad, and so many degrees are {}*deg",
                           text.substr(0, text.find_last_not_of(" \t", number - 1) + 1));
    const bool known = std::find(std::begin(units), std::end(units), unit) != std::end(units);
    return known ? "; numbers are in SI units, which are not written" : "";
}

}  // namespace carom
