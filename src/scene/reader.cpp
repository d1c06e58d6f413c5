#include "scene/reader.hpp"

#include <cmath>
#include <limits>

#include "scene/colours.hpp"
#include "scene/expression.hpp"
#include "state/nearest.hpp"

namespace carom {

namespace {

std::string in(const char* unit) { return *unit ? fmt::format(" in {}", unit) : ""; }

std::string near_or_all(const std::string& name, const std::vector<std::string>& known) {
    const auto is_in = [](const std::string& one, const std::vector<std::string>& all) {
        return std::find(all.begin(), all.end(), one) != all.end();
    };
    if (is_in("side", known) && is_in(name, Reader::keys(Side{})))
        return fmt::format("; did you mean 'side.{}'?", name);
    const std::string near = did_you_mean(name, known);
    return near.empty() ? fmt::format("; known are {}", fmt::join(known, ", ")) : near;
}

}  // namespace

std::string not_one_of(const std::vector<std::string>& names, const Json& given) {
    return fmt::format("must be one of {}, got {}{}", fmt::join(names, ", "), shown(given),
                       given.is_string() ? did_you_mean(given.get<std::string>(), names) : "");
}

void Reader::check_known(const Json& object, const Place& place, const std::vector<std::string>& known) {
    for (const auto& [key, value] : object.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw place.error(fmt::format("has no field {}{}", shown(key), near_or_all(key, known)));
}

void Reader::require(const Json& object, const Place& place, const char* name, const char* what) {
    if (!object.contains(name)) throw place.error(fmt::format("must have the field \"{}\": {}", name, what));
}

double Reader::number(const Json& value, const Place& place, const Range& range, const char* unit) const {
    const std::string allowed = fmt::format("{}{}", range.words, in(unit));
    if (value.is_number()) {
        if (!range.contains(value.get<double>())) throw place.expected(allowed, value);
        return value.get<double>();
    }
    if (!value.is_string()) throw place.expected(allowed, value);
    double result = 0;
    try {
        result = Function(value.get<std::string>(), {}, names_.parameters, names_.later)();
    } catch (const Error& e) {
        throw place.expected(fmt::format("{} or an expression of the parameters", allowed), value, e.what());
    }
    if (!range.contains(result))
        throw place.expected(allowed, value, std::isnan(result) ? "it is no number" : fmt::format("it is {}", result));
    return result;
}

int Reader::whole(const Json& value, const Place& place, const Range& range, const char* unit) const {
    const double n = number(value, place, range, unit);
    constexpr int most = std::numeric_limits<int>::max();
    if (n != std::floor(n) || std::abs(n) > most)
        throw place.expected(fmt::format("{}, and whole and at most {}", range.words, most), value);
    return static_cast<int>(n);
}

std::string Reader::text(const Json& value, const Place& place) {
    if (value.is_number()) throw place.expected(fmt::format("a text, for example \"{}\"", shown(value)), value);
    if (!value.is_string()) throw place.expected("a text", value);
    return value.get<std::string>();
}

Vec2 Reader::vector(const Json& value, const Place& place, const Range& range, const char* unit) const {
    if (!value.is_array() || value.size() != 2) throw place.expected(fmt::format("[x, y]{}", in(unit)), value);
    return {number(value[0], place / std::size_t{0}, range, unit),
            number(value[1], place / std::size_t{1}, range, unit)};
}

BodyId Reader::body(const Json& value, const Place& place) const {
    if (!value.is_string()) throw place.expected("the name of a body", value);
    try {
        return names_.world->find(value.get<std::string>());
    } catch (const Error& e) {
        throw place.expected("the name of a body", value, e.what());
    }
}

Colour Reader::colour(const Json& value, const Place& place) {
    const std::string text = value.is_string() ? value.get<std::string>() : "";
    if (const auto known = colour_of(text)) return *known;
    std::vector<std::string> names;
    for (const ColourName& c : colour_names) names.emplace_back(c.name);
    throw place.error(fmt::format("must be a colour like \"#0072b2\", \"#0072b280\" or \"blue\", got {}{}",
                                  shown(value), did_you_mean(text, names)));
}

}  // namespace carom
