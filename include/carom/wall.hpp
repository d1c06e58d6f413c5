#pragma once
#include <array>
#include <carom/field.hpp>
#include <carom/id.hpp>
#include <carom/vec2.hpp>
#include <cstdint>
#include <optional>

namespace carom {

/// The number of walls among those of their kind in their world, never given twice; 0 is none.
template <class Walls>
struct WallId {
    std::uint32_t number = 0;
    auto operator<=>(const WallId&) const = default;
};
template <class Walls>
constexpr std::uint64_t key(WallId<Walls> id) {
    return id.number;
}

/// One side of a rectangle, or a half-plane's edge.
struct Side {
    double restitution = 1;
    double friction = 0;
    std::optional<double> temperature{};
};
constexpr std::string_view describe(const Side*) { return "Restitution, friction and temperature of a wall."; }
template <std::same_as<Side> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("restitution", &T::restitution, "", fraction,
              "rebound speed over approach speed; mixed with the body's as two bodies' are"),
        field("friction", &T::friction, "", non_negative,
              "Coulomb's coefficient; mixed with the body's as two bodies' are"),
        field("temperature", &T::temperature, "J", positive,
              "k T of a thermal wall: what strikes it comes back with a velocity drawn from Maxwell's distribution at "
              "this temperature, whatever restitution and friction say; only under 'events'")};
}

struct Rectangle {
    Vec2 low{0, 0}, high{1, 1};
    Side left{}, right{}, bottom{}, top{};
};
constexpr std::string_view describe(const Rectangle*) {
    return "Four walls around the bodies; each side has its own restitution and friction.";
}
template <std::same_as<Rectangle> T>
constexpr auto fields(const T*) {
    return std::tuple{field("low", &T::low, "m", any, "lower left corner"),
                      field("high", &T::high, "m", any, "upper right corner, above and right of low"),
                      field("left", &T::left, "wall at low x"),
                      field("right", &T::right, "wall at high x"),
                      field("bottom", &T::bottom, "wall at low y"),
                      field("top", &T::top, "wall at high y")};
}

struct HalfPlane {
    Vec2 point{};
    Vec2 normal{0, 1};
    Side side{};
};
constexpr std::string_view describe(const HalfPlane*) { return "An infinite straight wall: floor, ramp or ceiling."; }
template <std::same_as<HalfPlane> T>
constexpr auto fields(const T*) {
    return std::tuple{field("point", &T::point, "m", any, "a point of the wall"),
                      field("normal", &T::normal, "", any, "direction out of the wall into the room, of any length"),
                      field("side", &T::side, "its restitution, friction and temperature")};
}

struct Stadium {
    Vec2 a{-0.5, 0}, b{0.5, 0};
    double radius = 0.5;
    Side side{};
};
constexpr std::string_view describe(const Stadium*) {
    return "A room with two straight sides and round ends (L. Bunimovich, Commun. Math. Phys. 65, 295 (1979)); a "
           "circle if both ends are one point. Only under 'events'.";
}
template <std::same_as<Stadium> T>
constexpr auto fields(const T*) {
    return std::tuple{field("a", &T::a, "m", any, "centre of one round end"),
                      field("b", &T::b, "m", any, "centre of the other one"),
                      field("radius", &T::radius, "m", positive, "of the round ends; half of the width"),
                      field("side", &T::side, "its restitution, friction and temperature, all around")};
}

/// Positions are not wrapped (a trajectory stays continuous); World::wrapped says where a body is in the box.
struct Periodic {
    Vec2 low{0, 0}, high{1, 1};
};
constexpr std::string_view describe(const Periodic*) {
    return "A box whose opposite sides are the same: no walls, no end.";
}
template <std::same_as<Periodic> T>
constexpr auto fields(const T*) {
    return std::tuple{field("low", &T::low, "m", any, "lower left corner"),
                      field("high", &T::high, "m", any, "upper right corner, above and right of low")};
}

}  // namespace carom
