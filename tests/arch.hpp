#pragma once
// Arches of loose stones, for tests and for the table of quality.

#include <carom/carom.hpp>
#include <cmath>
#include <iterator>

namespace carom::test {

/// Builds that of the scene "Arch" of Box2D's samples of seventeen stones on the floor y = 0, from foot to foot, with
/// four slabs on top. Returns the keystone.
inline BodyId add_arch(World& world, double friction) {
    // Its right half, from the foot to the keystone [m].
    constexpr Vec2 inner[] = {{4, 0},
                              {3.73451, 1.28340},
                              {3.44968, 2.56232},
                              {3.14063, 3.83527},
                              {2.80010, 5.09964},
                              {2.41630, 6.35092},
                              {1.96795, 7.57948},
                              {1.40880, 8.75955},
                              {0.60148, 9.77389}};
    constexpr Vec2 outer[] = {{6, 0},
                              {5.58405, 1.50575},
                              {5.13734, 3.00241},
                              {4.65215, 4.48676},
                              {4.11692, 5.95342},
                              {3.51331, 7.39270},
                              {2.80888, 8.78444},
                              {1.93814, 10.07613},
                              {0.75423, 11.07223}};
    const auto add = [&](Vec2 at, const Geometry& geometry) {
        return world.add(Body{
            .position = at, .shapes = {{.geometry = geometry, .density = 1}}, .restitution = 0, .friction = friction});
    };
    const auto mirrored = [](Vec2 p) { return Vec2{-p.x, p.y}; };
    const std::size_t top = std::size(inner) - 1;
    for (std::size_t i = 0; i < top; ++i) {
        add({}, Hull{{inner[i], outer[i], outer[i + 1], inner[i + 1]}});
        add({}, Hull{{mirrored(inner[i]), mirrored(outer[i]), mirrored(outer[i + 1]), mirrored(inner[i + 1])}});
    }
    const BodyId key = add({}, Hull{{inner[top], outer[top], mirrored(outer[top]), mirrored(inner[top])}});
    for (int i = 0; i < 4; ++i) add({0, outer[top].y + 0.5 + i}, Box{4, 1});
    return key;
}

/// Builds half a circle of mean radius 10 m of so many equal stones on the floor y = 0, as thick as this part of that.
inline void add_half_circle(World& world, double thickness, int stones) {
    const double pi = 3.14159265358979323846, inner = 10 * (1 - thickness / 2), outer = 10 * (1 + thickness / 2);
    const auto corner = [&](double radius, int end) {
        const double angle = pi * end / stones;
        return Vec2{radius * std::cos(angle), end % stones == 0 ? 0 : radius * std::sin(angle)};
    };
    for (int i = 0; i < stones; ++i)
        world.add(Body{.shapes = {{.geometry = Polygon{{corner(outer, i), corner(outer, i + 1), corner(inner, i + 1),
                                                        corner(inner, i)}},
                                   .density = 1}},
                       .restitution = 0,
                       .friction = 0.9});
}

}  // namespace carom::test
