#pragma once
// Colours as a scene writes them.

#include <carom/body.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// Names that need no table beside them, with the colours that CSS gives them (W3C, CSS Color Module Level 4).
struct ColourName {
    std::string_view name;
    Colour colour;
};
inline constexpr ColourName colour_names[] = {
    {"black", {0, 0, 0}},       {"grey", {128, 128, 128}}, {"gray", {128, 128, 128}}, {"silver", {192, 192, 192}},
    {"white", {255, 255, 255}}, {"red", {255, 0, 0}},      {"maroon", {128, 0, 0}},   {"brown", {165, 42, 42}},
    {"orange", {255, 165, 0}},  {"gold", {255, 215, 0}},   {"yellow", {255, 255, 0}}, {"olive", {128, 128, 0}},
    {"lime", {0, 255, 0}},      {"green", {0, 128, 0}},    {"teal", {0, 128, 128}},   {"cyan", {0, 255, 255}},
    {"blue", {0, 0, 255}},      {"navy", {0, 0, 128}},     {"purple", {128, 0, 128}}, {"violet", {238, 130, 238}},
    {"magenta", {255, 0, 255}}, {"pink", {255, 192, 203}}};

/// The colour of a name, of #rgb or #rrggbb, or of these with an opacity; none if it is no colour.
inline std::optional<Colour> colour_of(const std::string& text) {
    for (const auto& [name, colour] : colour_names)
        if (text == name) return colour;
    const bool hex = text.starts_with('#') && text.find_first_not_of("0123456789abcdefABCDEF", 1) == text.npos;
    const std::size_t digits = text.size() - 1, wide = digits > 4 ? 2 : 1;
    if (!hex || (digits != 3 * wide && digits != 4 * wide)) return {};
    const auto part = [&](std::size_t k) {
        const int value = std::stoi(text.substr(1 + k * wide, wide), nullptr, 16);
        return static_cast<std::uint8_t>(wide == 1 ? 17 * value : value);
    };
    return Colour{part(0), part(1), part(2), digits == 4 * wide ? part(3) : std::uint8_t{255}};
}

}  // namespace carom
