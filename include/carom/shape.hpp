#pragma once
#include <array>
#include <carom/field.hpp>
#include <carom/vec2.hpp>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

// What bodies are made of. A shape's lengths are in its body's frame: x to the right at angle 0, the origin at the
// body's position.

namespace carom {

struct Disc {
    Vec2 centre{};
    double radius = 0.5;
    static constexpr const char* name = "disc";
};
constexpr std::string_view describe(const Disc*) { return "A disc."; }
template <std::same_as<Disc> T>
constexpr auto fields(const T*) {
    return std::tuple{field("centre", &T::centre, "m", any, "its centre"),
                      field("radius", &T::radius, "m", positive, "its radius")};
}

struct Capsule {
    Vec2 a{-0.5, 0}, b{0.5, 0};
    double radius = 0.25;
    static constexpr const char* name = "capsule";
};
constexpr std::string_view describe(const Capsule*) { return "All points within a radius of a line from a to b."; }
template <std::same_as<Capsule> T>
constexpr auto fields(const T*) {
    return std::tuple{field("a", &T::a, "m", any, "centre of one end"),
                      field("b", &T::b, "m", any, "centre of the other end"),
                      field("radius", &T::radius, "m", positive, "half its thickness")};
}

struct Box {
    double width = 1, height = 1;
    Vec2 centre{};
    double angle = 0;
    double rounding = 0;
    static constexpr const char* name = "box";
};
constexpr std::string_view describe(const Box*) { return "A rectangle."; }
template <std::same_as<Box> T>
constexpr auto fields(const T*) {
    return std::tuple{field("width", &T::width, "m", positive, "size along x"),
                      field("height", &T::height, "m", positive, "size along y"),
                      field("centre", &T::centre, "m", any, "its centre"),
                      field("angle", &T::angle, "rad", any, "how it is turned in the body"),
                      field("rounding", &T::rounding, "m", non_negative,
                            "radius of its corners, at most half the shorter side; the size stays")};
}

struct Polygon {
    std::vector<Vec2> points{};
    double rounding = 0;
    static constexpr const char* name = "polygon";
};
constexpr std::string_view describe(const Polygon*) {
    return "A polygon by its corners in order, either way round. A concave one is split into convex parts.";
}
template <std::same_as<Polygon> T>
constexpr auto fields(const T*) {
    return std::tuple{needed(field("points", &T::points, "m", any, "its corners, at least 3, in order"), "its corners"),
                      field("rounding", &T::rounding, "m", non_negative,
                            "thickness of a round rim put around it; for a convex polygon only")};
}

struct Hull {
    std::vector<Vec2> points{};
    double rounding = 0;
    static constexpr const char* name = "hull";
};
constexpr std::string_view describe(const Hull*) { return "The convex hull of points."; }
template <std::same_as<Hull> T>
constexpr auto fields(const T*) {
    return std::tuple{needed(field("points", &T::points, "m", any, "points in any order, at least 3 not in a line"),
                             "what it goes around"),
                      field("rounding", &T::rounding, "m", non_negative, "thickness of a round rim put around it")};
}

struct Segment {
    Vec2 a{-0.5, 0}, b{0.5, 0};
    static constexpr const char* name = "segment";
};
constexpr std::string_view describe(const Segment*) {
    return "A line without thickness, solid from both sides for everything that has thickness: points and other lines "
           "pass through it.";
}
template <std::same_as<Segment> T>
constexpr auto fields(const T*) {
    return std::tuple{field("a", &T::a, "m", any, "one end"), field("b", &T::b, "m", any, "the other end")};
}

struct Chain {
    std::vector<Vec2> points{};
    bool closed = false;
    static constexpr const char* name = "chain";
};
constexpr std::string_view describe(const Chain*) {
    return "Lines from point to point, solid only from the left, smooth where they meet: ground without bumps. A body "
           "that comes from behind goes through, and meets no resistance until it is out in front; what has no "
           "thickness, as points and other lines, always does.";
}
template <std::same_as<Chain> T>
constexpr auto fields(const T*) {
    return std::tuple{needed(field("points", &T::points, "m", any,
                                   "at least 2 points; seen along the chain, the free side is on the left"),
                             "where it leads"),
                      field("closed", &T::closed, "whether the last point is joined to the first")};
}

using Geometry = std::variant<Disc, Capsule, Box, Polygon, Hull, Segment, Chain>;

/// Which shapes collide: each one's mask must have a bit of the other's category; within one group its sign decides.
struct Filter {
    int category = 1;
    int mask = 0x7fffffff;
    int group = 0;
    bool operator==(const Filter&) const = default;
};
constexpr std::string_view describe(const Filter*) { return "Which shapes collide with which."; }
template <std::same_as<Filter> T>
constexpr auto fields(const T*) {
    constexpr Range bits{0, 0x7fffffff, false, "a whole number from 0 to 2147483647"};
    constexpr Range whole{-0x7fffffff, 0x7fffffff, false, "a whole number"};
    return std::tuple{field("category", &T::category, "", bits, "bits: what the shape is"),
                      field("mask", &T::mask, "", bits, "bits: the categories that it collides with"),
                      field("group", &T::group, "", whole,
                            "shapes of the same group > 0 always collide, of the same group < 0 never; 0 is no group")};
}

struct Shape {
    Geometry geometry = Disc{};
    std::optional<double> density{};
    std::optional<double> restitution{}, friction{};
    double rolling_resistance = 0;
    double surface_speed = 0;
    bool sensor = false;
    Filter filter{};
};
constexpr std::string_view describe(const Shape*) {
    return "A part of a body: its form, and how it behaves in contact.";
}
template <std::same_as<Shape> T>
constexpr auto fields(const T*) {
    return std::tuple{
        flat("type", &T::geometry, "its form"),
        field("density", &T::density, "kg/m²", positive,
              "mass per area; given for all shapes of a body but sensors, or for none: then the body's mass is spread "
              "evenly over them"),
        field("restitution", &T::restitution, "", fraction, "rebound speed over approach speed; if absent the body's"),
        field("friction", &T::friction, "", non_negative, "Coulomb's coefficient; if absent the body's"),
        field("rolling_resistance", &T::rolling_resistance, "", non_negative,
              "largest moment against rolling, divided by normal force times radius; where two shapes touch the larger "
              "value counts"),
        field("surface_speed", &T::surface_speed, "m/s", any,
              "speed of the surface, as of a conveyor belt, counterclockwise around the shape: if > 0 what lies on it "
              "is carried to the left"),
        field("sensor", &T::sensor,
              "whether it is a sensor, which reports what touches it, lets everything pass and weighs nothing"),
        field("filter", &T::filter, "which shapes it collides with")};
}

}  // namespace carom
