// How walls look.

#include <array>
#include <cmath>

#include "output/paint.hpp"
#include "output/rim.hpp"

namespace carom {
namespace {

constexpr Colour ground{228, 228, 228, 255};

}  // namespace

void Painter::walls(const World& world) {
    for (const Rectangle& walls : world.rectangles()) room(walls);
    for (const Stadium& walls : world.stadiums()) stadium(walls);
    for (const HalfPlane& plane : world.half_planes()) half_plane(plane);
    if (const auto box = world.periodic()) periodic(*box);
}

void Painter::room(const Rectangle& walls) {
    const Vec2 a = view_.pixel({walls.low.x, walls.high.y}), b = view_.pixel({walls.high.x, walls.low.y});
    const double line = 3;
    cairo_rectangle(cairo_, 0, 0, view_.width, scene_height());
    cairo_rectangle(cairo_, a.x, a.y, b.x - a.x, b.y - a.y);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
    colour(ground);
    cairo_fill(cairo_);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_WINDING);
    // Outside of the room, where no disc can be.
    cairo_rectangle(cairo_, a.x - line / 2, a.y - line / 2, b.x - a.x + line, b.y - a.y + line);
    colour(wall_colour);
    stroke(line);
}

void Painter::stadium(const Stadium& walls) {
    cairo_rectangle(cairo_, 0, 0, view_.width, scene_height());
    cairo_new_sub_path(cairo_);
    for (const Vec2 point : rim_of(walls).points) {
        const Vec2 p = view_.pixel(point);
        cairo_line_to(cairo_, p.x, p.y);
    }
    cairo_close_path(cairo_);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
    colour(ground);
    cairo_fill_preserve(cairo_);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_WINDING);
    colour(wall_colour);
    stroke(3);
}

void Painter::half_plane(const HalfPlane& plane) {
    const Vec2 normal = plane.normal / length(plane.normal);
    const Vec2 middle = 0.5 * (view_.low + view_.high);
    const Vec2 foot = view_.pixel(middle - dot(middle - plane.point, normal) * normal);
    const double reach = view_.width + view_.height, spacing = 12;
    const double turned = std::atan2(normal.x, normal.y);
    const Vec2 from_foot = origin() - foot;
    const double first = std::fmod(dot(from_foot, {std::cos(turned), std::sin(turned)}), spacing);
    cairo_save(cairo_);
    // x runs along the wall and y into it.
    cairo_translate(cairo_, foot.x, foot.y);
    cairo_rotate(cairo_, turned);
    cairo_rectangle(cairo_, -reach, 0, 2 * reach, 2 * reach);
    colour(ground);
    cairo_fill(cairo_);
    for (double x = (view_.follow ? first : 0) - reach; x < reach; x += spacing) {
        cairo_move_to(cairo_, x, 0);
        cairo_line_to(cairo_, x - spacing, spacing);
    }
    colour(wall_colour);
    stroke(1);
    cairo_rectangle(cairo_, -reach, 0, 2 * reach, 3);
    cairo_fill(cairo_);
    cairo_restore(cairo_);
}

void Painter::periodic(const Periodic& box) {
    const Vec2 a = view_.pixel({box.low.x, box.high.y}), b = view_.pixel({box.high.x, box.low.y});
    cairo_rectangle(cairo_, a.x, a.y, b.x - a.x, b.y - a.y);
    const std::array<double, 2> dashes{8, 6};
    cairo_set_dash(cairo_, dashes.data(), 2, 0);
    colour(wall_colour);
    stroke(1.5);
    cairo_set_dash(cairo_, nullptr, 0, 0);
    clip_to(box);
}

void Painter::clip_to(const Periodic& box) {
    const Vec2 a = view_.pixel({box.low.x, box.high.y}), b = view_.pixel({box.high.x, box.low.y});
    cairo_rectangle(cairo_, a.x, a.y, b.x - a.x, b.y - a.y);
    cairo_clip(cairo_);
}

}  // namespace carom
