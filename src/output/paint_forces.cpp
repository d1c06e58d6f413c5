// The forces at contacts as arrows, and the key that says how long they are.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/paint.hpp"

namespace carom {
namespace {

constexpr Colour force_colour{200, 0, 40, 255};
constexpr double shortest = 1;  ///< of the arrows that are seen [pixels]

struct Arrow {
    Vec2 from;  ///< [m]
    Vec2 way;   ///< in the world's directions [pixels]
};
struct Arrows {
    std::vector<Arrow> all{};
    double pixels_per_newton = 0;  ///< 0 if none is to be seen
};

// The mean weight is an arrow of 40 pixels, or less if the largest force would be one of more than 100.
Arrows arrows_of(const World& world) {
    const std::vector<ContactPoint> points = world.contacts();
    double unit = 0, largest = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < world.size(); ++i)
        if (world.kinds()[i] == Kind::dynamic) unit += length(world.settings().gravity) * world.masses()[i], ++count;
    unit = count > 0 ? unit / static_cast<double>(count) : 0;
    const auto force_at = [](const ContactPoint& p) {
        return p.normal_force * p.normal + p.tangent_force * perpendicular(p.normal);
    };
    for (const ContactPoint& p : points) largest = std::max(largest, length(force_at(p)));
    const double scale = std::min(unit > 0 ? 40 / unit : HUGE_VAL, 100 / largest);
    if (!(largest * scale >= shortest)) return {};
    Arrows arrows{.pixels_per_newton = scale};
    // Of both that press on one another: which of them comes first is a matter of their numbers.
    for (const ContactPoint& p : points)
        for (const Vec2 at : places(world, p.point))
            for (const double sign : {1.0, -1.0}) arrows.all.push_back({at, sign * scale * force_at(p)});
    return arrows;
}

}  // namespace

Bounds bounds_of_forces(const World& world, const View& view) {
    Bounds box = bounds(world);
    if (world.periodic()) return box;
    for (const auto& [from, way] : arrows_of(world).all) {
        const Vec2 tip = from + way / view.scale();
        box = join(box, {tip, tip});
    }
    return box;
}

void Painter::contact_forces(const World& world) {
    const auto [arrows, scale] = arrows_of(world);
    pixels_per_newton_ = scale;
    for (const auto& [from, way] : arrows) arrow(view_.pixel(from), way, force_colour);
}

/// From a pixel along a way in the world's directions.
void Painter::arrow(Vec2 from, Vec2 way, Colour paint) {
    const double size = length(way), head = std::min(9.0, 0.5 * size);
    if (size < shortest) return;
    const Vec2 along = Vec2{way.x, -way.y} / size, across = perpendicular(along), tip = from + size * along;
    colour(paint);
    move_to(from);
    line_to(tip - 0.8 * head * along);
    stroke(2);
    move_to(tip);
    line_to(tip - head * along + 0.4 * head * across);
    line_to(tip - head * along - 0.4 * head * across);
    cairo_close_path(cairo_);
    cairo_fill(cairo_);
}

// The force that an arrow of 20 to 50 pixels stands for, a round one.
void Painter::force_bar(double left, double middle) {
    const double force = round_length(50 / pixels_per_newton_), size = force * pixels_per_newton_;
    arrow({left, middle}, {size, 0}, force_colour);
    colour(ink_colour);
    cairo_move_to(cairo_, left + size + 10, middle + 6);
    cairo_show_text(cairo_, with_prefix(force, "N").c_str());
}

}  // namespace carom
