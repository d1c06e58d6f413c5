#include "collision/convex.hpp"

#include <algorithm>

#include "math/elementary.hpp"

namespace carom {

namespace {

double least_width(const Convex& c) {
    double least = 0;
    for (int i = 0; i < c.count; ++i) {
        double across = 0;
        for (int j = 0; j < c.count; ++j) across = std::max(across, -dot(c.corner[j] - c.corner[i], c.normal[i]));
        if (i == 0 || across < least) least = across;
    }
    return least;
}

}  // namespace

Convex convex(std::span<const Vec2> corners, double radius) {
    Convex c;
    c.count = static_cast<int>(corners.size());
    c.radius = radius;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        c.corner[i] = corners[i];
        // From the first corner, so that a shape far from its body's origin loses nothing.
        c.centre += (corners[i] - corners[0]) / static_cast<double>(corners.size());
        if (corners.size() == 1) break;
        const Vec2 edge = corners[(i + 1) % corners.size()] - corners[i];
        c.normal[i] = -perpendicular(edge / length(edge));
    }
    c.centre += corners[0];
    c.width = c.count == 2 ? length(corners[1] - corners[0]) : least_width(c);
    return c;
}

Vec2 to_world(const Pose& pose, Vec2 point) { return pose.position + frame_at(pose.position, pose.angle).turn(point); }
Vec2 to_body(const Pose& pose, Vec2 point) {
    return frame_at(pose.position, pose.angle).turn_back(point - pose.position);
}

Aabb bounds(const Convex& outline, const Frame& at) {
    struct Turned {
        const Convex& outline;
        const Frame& at;
        Vec2 operator[](int i) const { return at.turn(outline.corner[i]); }
    };
    return bounds_of(outline.count, Turned{outline, at}, at.position, outline.radius);
}

bool may_meet(const Filter& a, const Filter& b) {
    if (a.group == b.group && a.group != 0) return a.group > 0;
    return (a.mask & b.category) != 0 && (b.mask & a.category) != 0;
}

}  // namespace carom
