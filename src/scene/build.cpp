#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/bits.hpp"
#include "scene/document.hpp"
#include "scene/kinds.hpp"
#include "scene/memory.hpp"
#include "scene/typed.hpp"

namespace carom {

namespace {

// What a builder will make, before it makes it.
Amount amount_of(const Rope& r) { return {double(r.segments), double(r.segments), !r.name.empty()}; }
Amount amount_of(const Lattice& l) {
    const double nodes = static_cast<double>(l.nx) * l.ny;
    return {nodes, nodes * (2 + 2 * (l.shear_stiffness > 0) + 2 * (l.bend_stiffness > 0)), !l.name.empty()};
}
Amount amount_of(const GridOf& g) { return {static_cast<double>(g.nx) * g.ny, 0, !g.body.name.empty()}; }
Amount amount_of(const NotebookGas& g) { return {double(g.count), 0, !g.body.name.empty()}; }
Amount amount_of(const Fill& f) {
    const double r1 = f.smallest_radius, r2 = f.largest_radius, mean_square = (r1 * r1 + r1 * r2 + r2 * r2) / 3;
    const double covered = f.fraction.value_or(0) * (f.high.x - f.low.x) * (f.high.y - f.low.y);
    return {f.count ? *f.count : covered / (3.14 * mean_square), 0, !f.body.name.empty()};
}
Amount amount_of(const Gas& g) { return amount_of(g.fill); }
Amount amount_of(const TrackExpression& t) { return {double(t.segments), 0, false}; }  // as many pieces

/// A builder that draws random numbers and names no seed of its own takes one of the scene's.
int* seed_of(Fill& f) { return &f.seed; }
int* seed_of(Gas& g) { return &g.fill.seed; }
int* seed_of(NotebookGas& g) { return &g.seed; }
template <class T>
int* seed_of(T&) {
    return nullptr;
}

bool names_seed(const Json& item) {
    return item.contains("seed") ||
           (item.contains("fill") && item["fill"].is_object() && item["fill"].contains("seed"));
}

/// Where a builder says what its bodies are like.
Place place_of_body(const Json& item, const Place& at) {
    if (item.contains("body")) return at / "body";
    const Json& fill = part(item, "fill");
    return fill.is_object() && fill.contains("body") ? at / "fill" / "body" : at;
}

/// Two gases of one stream would be one gas twice.
int nth_seed(int seed, std::uint64_t n) {
    constexpr std::uint64_t most = 2147483647;
    return n == 0 ? seed : static_cast<int>(mixed(mixed(0, static_cast<std::uint64_t>(seed)), n) & most);
}

}  // namespace

void check_mass(const Reader& reader, const Json& body, const Place& place, std::span<const double> made) {
    if (!body.is_object() || !body.contains("mass")) return;
    const double given = reader.number(body["mass"], place / "mass");
    constexpr double rounding = 1e-9;  // a world that was saved has both
    for (const double mass : made)
        if (std::abs(mass - given) > rounding * mass)
            throw(place / "mass")
                .error(fmt::format("must not be given beside a density, which makes it {:.6g} kg, got {}", mass,
                                   shown(body["mass"])));
}

namespace {

/// What a builder builds, once its expressions are known.
template <class T>
const T& ready(const T& builder, const Reader&, const Json&, const Place&) {
    return builder;
}
Body ready(const TrackExpression& track, const Reader& reader, const Json& item, const Place& place) {
    const auto coordinate = [&](const std::string& text, const char* field) {
        const Place own = place / std::string(field);
        return [&, own, f = function_of(text, own, {"s"}, reader.names())](double s) {
            const double value = f(s);
            if (std::isfinite(value)) return value;
            throw own.expected(
                "a finite number in m all along", text,
                fmt::format("it is {} at s = {}", std::isnan(value) ? "no number" : fmt::format("{}", value), s));
        };
    };
    const auto x = coordinate(track.x, "x"), y = coordinate(track.y, "y");
    if (track.closed && track.segments < 2)
        throw(place / "segments").expected("2 lines or more, for a curve that is closed", item["segments"]);
    Chain chain{.points = {}, .closed = track.closed};
    for (int k = 0; k < track.segments + !track.closed; ++k) {
        const double part = double(k) / track.segments, s = (1 - part) * track.from + part * track.to;
        const Vec2 next{x(s), y(s)};
        if (k > 0 && next == chain.points.back())
            throw place.error(
                fmt::format("must lead on, and does not before s = {}: it is at ({}, {}) m again", s, next.x, next.y));
        chain.points.push_back(next);
    }
    Body body = track.body;
    if (body.kind == Kind::dynamic) {
        if (part(item, "body").is_object() && part(item, "body").contains("kind"))
            throw(place / "body" / "kind").expected("fixed or driven, for a curve has no mass", item["body"]["kind"]);
        body.kind = Kind::fixed;
    }
    body.shapes.push_back({.geometry = std::move(chain)});
    return body;
}

void build(World& world, const Body& body) { world.add(body); }

}  // namespace

void build_all(World& world, const Reader& reader, const Json& root, const Place& top, int seed) {
    std::uint64_t drawn = 0;
    for_each_item(root, top, "builders", [&](const Json& item, const Place& place) {
        read_typed(reader, item, place, builder_types, [&](auto builder, const Place& at) {
            require_memory_for(amount_of(builder), place);
            if (int* own = seed_of(builder); own && !names_seed(item)) *own = nth_seed(seed, drawn++);
            const std::size_t before = world.size();
            const auto& all = ready(builder, reader, item, at);
            try {
                build(world, all);
            } catch (const Error& e) {
                const bool of_body = std::string_view(e.what()).starts_with("Body");
                throw at_field(of_body ? place_of_body(item, at) : at, e.what());
            }
            const auto made = world.masses().subspan(before);
            if (item.contains("body")) check_mass(reader, item["body"], at / "body", made);
            if (const Json& fill = part(item, "fill"); fill.is_object() && fill.contains("body"))
                check_mass(reader, fill["body"], at / "fill" / "body", made);
        });
    });
}

std::string Scene::put_off_curves(const World& start) const {
    const auto& [root, top] = *document_;
    const Names names = document_->names(&start);
    const Reader reader(names);
    const auto differs = [](double put, double begins) {
        constexpr double much = 1e-3, dust = 1e-12;  // what is written by hand is rounded
        return std::abs(put - begins) > much * std::max(std::abs(put), std::abs(begins)) + dust;
    };
    std::string text;
    std::size_t row = 0;  // those of the list come first in a world
    for_each_item(root, top, "bodies", [&](const Json& item, const Place& place) {
        const BodyId id = start.ids()[row++];
        if (!start.follows_curve(id)) return;
        Body put;
        reader.read(item, place, put);
        const Vec2 x = put.position, begins = start.position(id);
        const std::string name = put.name.empty() ? fmt::format("body {}", row - 1) : fmt::format("'{}'", put.name);
        if (item.contains("position") && (differs(x.x, begins.x) || differs(x.y, begins.y)))
            text += fmt::format(
                "{}{} is put at ({:.6g}, {:.6g}) m, and the curve that drives it begins at ({:.6g}, "
                "{:.6g}) m",
                text.empty() ? "" : "; ", name, x.x, x.y, begins.x, begins.y);
        if (item.contains("angle") && differs(put.angle, start.angle(id)))
            text += fmt::format(
                "{}{} is put at an angle of {:.6g} rad, and the curve that drives it begins at {:.6g} "
                "rad",
                text.empty() ? "" : "; ", name, put.angle, start.angle(id));
    });
    return text;
}

}  // namespace carom
