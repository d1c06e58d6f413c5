#include <fmt/format.h>

#include <algorithm>
#include <carom/output.hpp>
#include <cmath>
#include <limits>

#include "output/paint.hpp"
#include "output/rim.hpp"

namespace carom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void include(Bounds& box, Vec2 point, double radius = 0) {
    box = join(box, {point - Vec2{radius, radius}, point + Vec2{radius, radius}});
}

}  // namespace

double View::scale() const {
    const double free_height = height - (caption ? caption_height : 0);
    return std::min(width / (high.x - low.x), free_height / (high.y - low.y));
}

Vec2 View::pixel(Vec2 point) const {
    const double free_height = height - (caption ? caption_height : 0);
    const Vec2 from_middle = scale() * (point - 0.5 * (low + high));
    return {width / 2.0 + from_middle.x, free_height / 2 - from_middle.y};
}

void check(const View& view) {
    const Vec2 size = view.high - view.low;
    if (!(size.x > 0 && size.y > 0 && std::isfinite(size.x) && std::isfinite(size.y))) {
        throw Error(fmt::format("a view from ({}, {}) to ({}, {}) m: high must lie above and right of low", view.low.x,
                                view.low.y, view.high.x, view.high.y));
    }
    // Beyond 32767 Cairo has no surfaces.
    for (int side : {view.width, view.height}) {
        if (side < 2 * caption_height || side > 32767) {
            throw Error(fmt::format("a picture of {} x {} pixels: allowed are {} to 32767", view.width, view.height,
                                    2 * caption_height));
        }
    }
}

Vec2 end_of(const World& world, BodyId body, Vec2 anchor) {
    const double angle = world.angle(body), c = std::cos(angle), s = std::sin(angle);
    return world.position(body) + Vec2{c * anchor.x - s * anchor.y, s * anchor.x + c * anchor.y};
}

Vec2 end_of(const World& world, const std::optional<BodyId>& body, Vec2 anchor) {
    return body ? end_of(world, *body, anchor) : anchor;
}

Bounds join(const Bounds& a, const Bounds& b) {
    return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
            {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

Bounds bounds(const World& world) {
    if (const auto periodic = world.periodic()) return {periodic->low, periodic->high};
    Bounds box{{infinity, infinity}, {-infinity, -infinity}};
    for (const Rectangle& room : world.rectangles()) box = join(box, {room.low, room.high});
    for (const Stadium& room : world.stadiums())
        for (const Vec2 point : rim_of(room).points) include(box, point);
    const auto positions = world.positions();
    const auto radii = world.radii(), angles = world.angles();
    const auto shapes = world.shapes();
    if (world.rectangles().empty()) {
        for (std::size_t i = 0; i < positions.size(); ++i) {
            if (shapes[i].empty()) include(box, positions[i], radii[i]);
            for (const Shape& shape : shapes[i])
                for (const Vec2 point : placed(rim_of(shape.geometry).points, positions[i], angles[i]))
                    include(box, point);
        }
        for (const Joint& joint : world.joints()) {
            if (std::holds_alternative<GearJoint>(joint.type)) continue;
            include(box, end_of(world, joint.a, joint.anchor_a));
            if (const auto* pulley = std::get_if<PulleyJoint>(&joint.type))
                include(box, pulley->ground_a), include(box, pulley->ground_b);
        }
        for (const Spring& spring : world.springs()) {
            include(box, end_of(world, spring.a, spring.anchor_a));
            include(box, end_of(world, spring.b, spring.anchor_b));
        }
    }
    if (!(box.low.x <= box.high.x)) box = {};  // an empty world
    const Vec2 middle = 0.5 * (box.low + box.high);
    for (const HalfPlane& wall : world.half_planes()) {
        const double above = dot(middle - wall.point, wall.normal) / squared_length(wall.normal);
        if (world.rectangles().empty()) include(box, middle - above * wall.normal);
    }
    return box;
}

View fit(const Bounds& box) {
    const Vec2 middle = 0.5 * (box.low + box.high), size = box.high - box.low;
    double longest = std::max(size.x, size.y);
    if (!(longest > 0)) longest = 2;  // a single point: something around it
    // Not flatter than 4 : 1, so that the walls and a motion to the side are seen; not higher than a page.
    const Vec2 half{0.54 * std::max(size.x, longest / 1.5), 0.54 * std::max(size.y, longest / 4)};
    View view{.low = middle - half, .high = middle + half};
    const double scale = 800 / (2 * std::max(half.x, half.y));
    // Even numbers, which films need.
    view.width = 2 * static_cast<int>(std::lround(half.x * scale));
    view.height = 2 * static_cast<int>(std::lround(half.y * scale)) + caption_height;
    return view;
}

View fit(const World& world) { return fit(bounds(world)); }

View centred(View view, const World& world) {
    if (!view.follow || !world.contains(*view.follow)) return view;
    const Vec2 half = 0.5 * (view.high - view.low), middle = world.wrapped(world.position(*view.follow));
    view.low = middle - half;
    view.high = middle + half;
    return view;
}

}  // namespace carom
