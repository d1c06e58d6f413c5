#pragma once
#include <carom/body.hpp>
#include <carom/event.hpp>
#include <carom/field.hpp>
#include <carom/vec2.hpp>
#include <cstdint>
#include <optional>

// Questions to a world about what is where. They change nothing.

namespace carom {

/// Which shapes a question is about: a query filter. All but sensors, unless more is said.
struct Sought {
    std::optional<Filter> filter{};
    bool sensors = false;
    std::optional<BodyId> except{};
    bool walls = false;
    bool operator==(const Sought&) const = default;
};
constexpr std::string_view describe(const Sought*) { return "Which shapes a question is about."; }
constexpr auto fields(const Sought*) {
    return std::tuple{
        field("filter", &Sought::filter, "found is what a shape of this filter collides with; if absent everything"),
        field("sensors", &Sought::sensors, "whether sensors are found"),
        field("except", &Sought::except, "a body that is not found: the one that asks"),
        field("walls", &Sought::walls,
              "whether rays and moving shapes find walls, too, whatever the filter; it changes no other question")};
}

/// What a ray or a moving shape meets.
struct Hit {
    BodyId body{};
    std::uint32_t shape = 0;  ///< among its body's shapes; of a wall its number, as in a ShapePair
    Vec2 point{};             ///< on the shape's rim [m]
    Vec2 normal{};            ///< out of the shape that was met, of length 1
    double fraction = 0;      ///< of the way
    /// Whether it is a wall, which is no body: asking the world for it is an Error.
    bool at_wall() const { return body.generation == 0; }
};

/// An upright rectangle around something [m].
struct Bounds {
    Vec2 low{}, high{};
};

/// Where two bodies are nearest.
struct ClosestPoints {
    Vec2 on_a{}, on_b{};                     ///< on the rims [m]
    double distance = 0;                     ///< [m]; overlap is negative: the shortest way out
    std::uint32_t shape_a = 0, shape_b = 0;  ///< among their bodies' shapes
};

/// Two shapes that collide and are inside one another; or a wall and a shape.
struct Overlap {
    ShapePair shapes;
    double depth = 0;  ///< the shortest way out [m]
    double part = 0;   ///< of the thickness of the thinner one
};

}  // namespace carom
