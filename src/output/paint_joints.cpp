// How joints look.

#include <array>
#include <numbers>

#include "output/paint.hpp"
#include "output/rim.hpp"

namespace carom {
namespace {

constexpr Colour joint_colour{40, 40, 40, 255};

Vec2 first_end(const World& world, const Joint& j) { return world.wrapped(end_of(world, j.a, j.anchor_a)); }
Vec2 second_end(const World& world, const Joint& j) {
    const Vec2 a = end_of(world, j.a, j.anchor_a), b = end_of(world, std::optional(j.b), j.anchor_b);
    return world.wrapped(a) + (b - a);
}

}  // namespace

std::array<Line, 3> rope_of(const World& world, const Joint& j, const PulleyJoint& pulley) {
    const Vec2 a = pulley.ground_a, b = pulley.ground_b;
    return {Line{first_end(world, j), a}, Line{a, b}, Line{b, second_end(world, j)}};
}

void Painter::joints(const World& world) {
    for (const Joint& j : world.joints()) std::visit([&](const auto& type) { joint(world, j, type); }, j.type);
}

void Painter::segment(Vec2 from, Vec2 to, double width, bool dashed) {
    const std::array<double, 2> dashes{6, 4};
    if (dashed) cairo_set_dash(cairo_, dashes.data(), 2, 0);
    colour(joint_colour);
    move_to(view_.pixel(from)), line_to(view_.pixel(to));
    stroke(width);
    cairo_set_dash(cairo_, nullptr, 0, 0);
}

void Painter::pin(Vec2 at, double radius) {
    const Vec2 pixel = view_.pixel(at);
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, pixel.x, pixel.y, radius, 0, 2 * std::numbers::pi);
    colour(paper);
    cairo_fill_preserve(cairo_);
    colour(joint_colour);
    stroke(1.5);
}

/// An axis of a through its anchor, as far as b is and a little more.
void Painter::rail(const World& world, const Joint& j, Vec2 axis) {
    const Vec2 a = first_end(world, j), b = second_end(world, j);
    const double angle = j.a ? world.angle(*j.a) : 0;
    const Vec2 n = placed({axis / length(axis)}, {}, angle)[0];
    const double way = dot(b - a, n), more = 16 / scale_;
    segment(a + (std::min(way, 0.0) - more) * n, a + (std::max(way, 0.0) + more) * n, 1.5, true);
}

void Painter::joint(const World& world, const Joint& j, const DistanceJoint& rod) {
    const Vec2 a = first_end(world, j), b = second_end(world, j);
    if (rod.spring) {
        colour(joint_colour);
        coil(view_.pixel(a), view_.pixel(b), rod.length.value_or(0));
    } else {
        const bool rope = rod.limits.lower || rod.limits.upper;
        segment(a, b, rope ? 1.5 : 3, rope && rod.limits.upper && length(b - a) < *rod.limits.upper * (1 - 1e-6));
    }
    pin(a, 2.5), pin(b, 2.5);
}
void Painter::joint(const World& world, const Joint& j, const RevoluteJoint&) {
    const Vec2 at = second_end(world, j);
    const bool many = world.joints().size() > 100;
    // What ties a disc to a pin beside it is the body's, and has no shape.
    const auto arm = [&](BodyId id, Vec2 anchor) {
        const Body body = world.body(id);
        const double rim = body.radius * (1 + 1e-9);
        if (!body.shapes.empty() || !(length(anchor) > rim)) return;
        const Vec2 out = placed({anchor / length(anchor)}, {}, world.angle(id))[0];
        segment(at - (length(anchor) - rim) * out, at, 1.5);
    };
    if (!many) arm(j.b, j.anchor_b);
    if (!many && j.a) arm(*j.a, j.anchor_a);
    pin(at, many ? 1.5 : 3.5);
}
void Painter::joint(const World& world, const Joint& j, const PrismaticJoint& slide) { rail(world, j, slide.axis); }
void Painter::joint(const World& world, const Joint& j, const WeldJoint&) {
    const Vec2 at = view_.pixel(second_end(world, j));
    colour(joint_colour);
    for (const double side : {-1.0, 1.0}) {
        move_to(at + Vec2{-4, -4 * side}), line_to(at + Vec2{4, 4 * side});
        stroke(1.5);
    }
}
void Painter::joint(const World& world, const Joint& j, const WheelJoint& wheel) {
    rail(world, j, wheel.axis);
    pin(second_end(world, j), 3.5);
}
void Painter::joint(const World& world, const Joint& j, const GearJoint&) {
    if (j.a) segment(world.wrapped(world.position(*j.a)), world.wrapped(world.position(j.b)), 1, true);
}
void Painter::joint(const World& world, const Joint& j, const PulleyJoint& pulley) {
    for (const auto& [from, to] : rope_of(world, j, pulley)) segment(from, to, 1.5);
    pin(pulley.ground_a, 4), pin(pulley.ground_b, 4);
}
void Painter::joint(const World& world, const Joint& j, const DragHandle&) {
    segment(first_end(world, j), second_end(world, j), 1, true);
    pin(first_end(world, j), 4);
}

}  // namespace carom
