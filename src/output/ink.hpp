#pragma once
#include <carom/output.hpp>

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

}  // namespace carom
