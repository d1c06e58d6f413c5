#pragma once
#include <algorithm>
#include <carom/output.hpp>
#include <iterator>
#include <vector>

namespace carom {

/// The colour of a line on white: one that is hardly seen there, as a white body's, is darker by as much as it takes.
inline Colour on_white(Colour c) {
    constexpr double most = 0.65;  // of white's brightness; all of the palette is darker
    const double brightness = (299.0 * c.r + 587.0 * c.g + 114.0 * c.b) / 255e3;
    if (brightness <= most) return c;
    const auto part = [&](std::uint8_t x) { return static_cast<std::uint8_t>(x * most / brightness); };
    return {part(c.r), part(c.g), part(c.b), c.a};
}

/// The colour of a body on which its path is to be seen.
inline Colour pale(Colour c) {
    const auto part = [](std::uint8_t x) { return static_cast<std::uint8_t>((x + 255) / 2); };
    return {part(c.r), part(c.g), part(c.b), c.a};
}

/// A mark on a body of that colour.
inline Colour mark_on(Colour c) {
    const bool bright = 299 * c.r + 587 * c.g + 114 * c.b > 140 * 1000;
    return bright ? Colour{34, 34, 34, 255} : Colour{255, 255, 255, 255};
}

inline constexpr double dot_radius = 3;  ///< pixels

/// Whether a disc with a radius of so many pixels is shown as a dot: where bodies are few it would not be found as it
/// is. Of a crowd it counts how much of the picture its discs take.
inline bool is_dot(double pixels, std::size_t bodies) {
    constexpr std::size_t few = 100;
    return pixels == 0 || (pixels < dot_radius && bodies <= few);
}

/// The next way to draw a line of that colour, so that those of one colour are told apart.
inline Stroke next_stroke(const std::vector<Curve>& drawn, const Colour& colour) {
    constexpr Stroke ways[] = {Stroke::line, Stroke::dashed, Stroke::dotted};
    const auto before = std::count_if(drawn.begin(), drawn.end(), [&](const Curve& curve) {
        return curve.colour == colour && std::find(std::begin(ways), std::end(ways), curve.stroke) != std::end(ways);
    });
    return ways[static_cast<std::size_t>(before) % std::size(ways)];
}

}  // namespace carom
