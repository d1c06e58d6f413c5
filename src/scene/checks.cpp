#include "scene/checks.hpp"

#include <algorithm>
#include <initializer_list>

namespace carom {

namespace {

/// That there is a field, its description says.
void need_text(const std::string& text, const Place& place) {
    if (text.find_first_not_of(" \t\n\r") == text.npos) throw place.expected("an expression", text);
}

}  // namespace

void check(const Expectation& e, const Place& place) { need_text(e.quantity, place / "quantity"); }

void check(const Twin& t, const Place& place) {
    need_text(t.quantity, place / "quantity");
    need_text(t.formula, place / "formula");
}

namespace {

/// What says nothing to a picture's type was most likely meant for another one.
void check_type(const Picture& p, const Place& place) {
    using enum PictureType;
    const auto is_of = [&](const char* field, bool is_given, std::initializer_list<PictureType> types) {
        const auto has = [types](PictureType type) {
            return std::find(types.begin(), types.end(), type) != types.end();
        };
        if (!is_given || has(p.type)) return;
        std::string names;
        for (const auto& choice : choices(&p.type))
            if (has(choice.value)) names += fmt::format("{}{}", names.empty() ? "" : " or ", choice.name);
        throw(place / std::string(field)).error("is of pictures of the type " + names);
    };
    is_of("bodies", !p.bodies.empty(), {trajectories});
    is_of("quantities", !p.quantities.empty(), {time, phase, twin});
    is_of("at", !p.at.empty(), {snapshots, profile});
    is_of("from", p.from.has_value(), {time, phase});
    is_of("change", p.change, {time, energy});
    is_of("period", p.period.has_value(), {phase});
}

}  // namespace

void check(const Picture& p, const Place& place) {
    const auto need = [&](const char* field, bool right, const char* allowed, std::size_t got) {
        if (!right) throw(place / std::string(field)).error(fmt::format("must be {}, got {}", allowed, got));
    };
    // It becomes the name of a file, which stays in the folder that was asked for.
    if (p.name.find_first_of("/\\") != std::string::npos || p.name.starts_with('.'))
        throw(place / "name").expected("the name of a file, without a folder", p.name);
    check_type(p, place);
    if (p.from && p.until && *p.from > *p.until)
        throw(place / "from").error(fmt::format("must be before until, {} s, got {} s", *p.until, *p.from));
    switch (p.type) {
        case PictureType::time:
            return need("quantities", !p.quantities.empty(), "one or more", 0);
        case PictureType::phase:
            return need("quantities", p.quantities.size() == 2, "two", p.quantities.size());
        default:
            return;
    }
}

}  // namespace carom
