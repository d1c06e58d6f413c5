#pragma once
#include <carom/body.hpp>
#include <carom/event.hpp>
#include <carom/field.hpp>
#include <carom/vec2.hpp>
#include <cstdint>
#include <optional>

// Queries: what is where in a world. They change nothing.

namespace carom {

/// A query filter: which shapes are found. By default all shapes but sensors, and no walls.
struct Sought {
    std::optional<Filter> filter{};
    bool sensors = false;
    std::optional<BodyId> except{};
    bool walls = false;
    bool operator==(const Sought&) const = default;
};
constexpr std::string_view describe(const Sought*) { return "A query filter: which shapes are found."; }
template <std::same_as<Sought> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("filter", &T::filter,
              "only shapes that would collide with a shape of this filter are found; if absent all are"),
        field("sensors", &T::sensors, "whether sensors are found"),
        field("except", &T::except, "a body that is not found, such as the one that asks"),
        field("walls", &T::walls,
              "whether rays and moving shapes also find walls, whatever the filter; other queries never do")};
}

/// What a ray or a moving shape meets.
struct Hit {
    BodyId body{};
    std::uint32_t shape = 0;  ///< its number among the body's shapes; of a wall its number, as in a ShapePair
    Vec2 point{};             ///< on the shape's rim [m]
    Vec2 normal{};            ///< out of the shape that was met, of length 1
    double fraction = 0;      ///< how far along the way, from 0 to 1
    /// Whether it is a wall. A wall is not a body: asking the world for `body` is an Error.
    bool at_wall() const { return body.generation == 0; }
};

/// An upright rectangle around something [m].
struct Bounds {
    Vec2 low{}, high{};
};

/// Where two bodies are nearest.
struct ClosestPoints {
    Vec2 on_a{}, on_b{};                     ///< on the rims [m]
    double distance = 0;                     ///< [m]; negative where they overlap: minus the shortest way out
    std::uint32_t shape_a = 0, shape_b = 0;  ///< among their bodies' shapes
};

/// Two shapes that collide and are inside one another; or a wall and a shape.
struct Overlap {
    ShapePair shapes;
    double depth = 0;  ///< the shortest way out [m]
    double part = 0;   ///< the depth as a fraction of the thickness of the thinner one
};

}  // namespace carom
