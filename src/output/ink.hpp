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

}  // namespace carom
