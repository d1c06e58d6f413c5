// What shows that a view moves that follows a body.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/paint.hpp"

namespace carom {
namespace {

constexpr Colour faint{226, 226, 226, 255}, number_ink{120, 120, 120, 255};

/// Calls f(place) of each multiple of `apart` from low to high.
template <class F>
void for_lines(double low, double high, double apart, F f) {
    const double first = std::ceil(low / apart);
    // Far out all numbers are alike, and there would be no end.
    for (int k = 0; k < 100 && (first + k) * apart <= high; ++k) f((first + k) * apart);
}

}  // namespace

std::vector<Vec2> Painter::repeats(const World& world) const {
    const auto box = world.periodic();
    if (!view_.follow || !box) return {{0, 0}};
    const Vec2 size = box->high - box->low;
    const Bounds seen = all_seen();
    const Vec2 low = seen.low - box->low, high = seen.high - box->low;
    std::vector<Vec2> shifts;
    for (double x = std::floor(low.x / size.x); x * size.x < high.x; ++x)
        for (double y = std::floor(low.y / size.y); y * size.y < high.y; ++y)
            shifts.push_back({x * size.x, y * size.y});
    return shifts;
}

Bounds Painter::all_seen() const {
    const Vec2 middle = 0.5 * (view_.low + view_.high), half = 0.5 / scale_ * Vec2{double(view_.width), scene_height()};
    return {middle - half, middle + half};
}

// Its squares are as wide as the scale bar is long.
double Painter::grid_spacing() const { return round_length(view_.width / (6 * scale_)); }

void Painter::grid() {
    const double apart = grid_spacing();
    const Bounds seen = all_seen();
    for_lines(seen.low.x, seen.high.x, apart, [&](double x) {
        const double at = view_.pixel({x, 0}).x;
        move_to({at, 0}), line_to({at, scene_height()});
    });
    for_lines(seen.low.y, seen.high.y, apart, [&](double y) {
        const double at = view_.pixel({0, y}).y;
        move_to({0, at}), line_to({double(view_.width), at});
    });
    colour(faint);
    stroke(1);
}

void Painter::grid_numbers() {
    const double apart = grid_spacing();
    const Bounds seen = all_seen();
    colour(number_ink);
    cairo_select_font_face(cairo_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, 12);
    // Far out neighbours differ in later digits, and not every number has room beside the next.
    const double far = std::max({-seen.low.x, seen.high.x, -seen.low.y, seen.high.y});
    const int digits =
        std::clamp(static_cast<int>(std::floor(std::log10(far)) - std::floor(std::log10(apart))) + 1, 6, 15);
    const auto words = [digits](double value) { return fmt::format("{:.{}g}", value, digits); };
    cairo_text_extents_t size;
    cairo_text_extents(cairo_, words(-far).c_str(), &size);
    const double each = std::ceil((size.x_advance + 8) / (apart * scale_));
    const auto show = [&](Vec2 at, double value) {
        const std::string number = words(value);
        cairo_text_extents(cairo_, number.c_str(), &size);
        // Half of a number is another one: at the edge it moves back, if it does not come upon the one before.
        const double left = std::min(at.x + 4, view_.width - size.x_advance - 2);
        if (left < at.x + 4 && left < at.x + 8 + size.x_advance - each * apart * scale_) return;
        cairo_move_to(cairo_, left, at.y - 4);
        cairo_show_text(cairo_, number.c_str());
    };
    constexpr double row = 16;  // of the numbers of x, in which there are none of y
    for_lines(seen.low.x, seen.high.x, apart, [&](double x) {
        if (std::fmod(std::round(x / apart), each) == 0) show({view_.pixel({x, 0}).x, row}, x);
    });
    for_lines(seen.low.y, seen.high.y, apart, [&](double y) {
        if (const double at = view_.pixel({0, y}).y; at > 2 * row) show({0, at}, y);
    });
}

}  // namespace carom
