#pragma once
#include <carom/body.hpp>
#include <carom/field.hpp>
#include <carom/vec2.hpp>
#include <cstdint>

// Questions to a world about what is where. They change nothing.

namespace carom {

/// Which shapes a question is about.
struct Sought {
    int categories = 0x7fffffff;
    bool sensors = false;
    bool operator==(const Sought&) const = default;
};
constexpr std::string_view describe(const Sought*) { return "Which shapes a question is about."; }
constexpr auto fields(const Sought*) {
    constexpr Range bits{0, 0x7fffffff, false, "a whole number from 0 to 2147483647"};
    return std::tuple{field("categories", &Sought::categories, "", bits, "bits: a shape of any of these is found"),
                      field("sensors", &Sought::sensors, "whether sensors are found")};
}

/// What a ray or a moving shape meets.
struct Hit {
    BodyId body{};
    std::uint32_t shape = 0;  ///< among its body's shapes
    Vec2 point{};             ///< on the shape's rim [m]
    Vec2 normal{};            ///< out of the shape that was met, of length 1
    double fraction = 0;      ///< of the way
};

/// Where two shapes are nearest.
struct ClosestPoints {
    Vec2 on_a{}, on_b{};  ///< on the rims [m]
    double distance = 0;  ///< [m]; overlap is negative: the shortest way out
};

}  // namespace carom
