#include "collision/toi.hpp"

#include <algorithm>
#include <cmath>

#include "collision/nearest.hpp"

namespace carom {

namespace {

/// How far the core reaches from its body's position.
double reach_of(const Convex& outline) {
    double squared = 0;
    for (int i = 0; i < outline.count; ++i) squared = std::max(squared, squared_length(outline.corner[i]));
    return std::sqrt(squared);
}

/// A direction that turns at a rate, as an edge's normal turns with its body.
struct Axis {
    Vec2 direction;
    double turn;
};

/// How far a corner is along an axis, and how fast it gets farther.
struct Along {
    double place, speed;
};

/// The corners of an outline whose body is at a place and moves with a velocity and a turn.
struct Corners {
    int count;
    Along corner[Convex::most_corners];

    Corners(const Placed& outline, Vec2 place, Vec2 velocity, double turn, const Axis& axis) : count(outline.count) {
        const Vec2 n = axis.direction;
        const double speed = dot(velocity, n) + axis.turn * dot(perpendicular(n), place);
        for (int i = 0; i < count; ++i) {
            const Vec2 r = outline.corner(i) - place;
            corner[i] = {dot(outline.corner(i), n), speed + dot(cross(turn - axis.turn, r), n)};
        }
    }
};

/// The first time > 0 at which distance + speed t − acceleration t²/2 is 0, for a distance > 0; infinity if never.
double first_zero(double distance, double speed, double acceleration) {
    const double root = std::sqrt(speed * speed + 2 * acceleration * distance);
    return speed > 0 ? (speed + root) / acceleration : 2 * distance / (root - speed);
}

/// A time before which no corner of q comes as near to one of p, along the direction, as the target.
double safe_time(const Corners& p, const Corners& q, double target, double least, double acceleration) {
    double first = HUGE_VAL;
    for (int i = 0; i < p.count; ++i)
        for (int j = 0; j < q.count; ++j) {
            const double distance = std::max(least, q.corner[j].place - p.corner[i].place - target);
            first = std::min(first, first_zero(distance, q.corner[j].speed - p.corner[i].speed, acceleration));
        }
    return first;
}

bool starts_behind(const Convex& piece, const Frame& frame, Vec2 to_other) {
    return piece.one_sided && dot(to_other - frame.turn(piece.corner[0]), frame.turn(piece.normal[0])) < 0;
}

/// The bodies in a step, seen from a's position.
struct Step {
    const Convex &a, &b;
    const Sweeping &motion_a, &motion_b;
    Vec2 between, velocity;
    double reach_a, reach_b;

    Vec2 place(double time) const { return between + time * velocity; }

    /// A bound on the acceleration of any corner along an axis, to the end of the step.
    double acceleration(double time, double axis_turn) const {
        const double a_turn = motion_a.turn - axis_turn, b_turn = motion_b.turn - axis_turn;
        const double apart = std::max(length(place(time)), length(place(1)));
        return a_turn * a_turn * reach_a + b_turn * b_turn * reach_b + axis_turn * axis_turn * apart +
               2 * std::abs(axis_turn) * length(velocity);
    }
};

}  // namespace

// Conservative advancement (Mirtich 1996): no corner passes the axis of the largest separation before a time that
// follows from its speed and a bound on its acceleration; there the axis is taken anew. With an axis that turns with
// its edge, and the acceleration instead of a bound on the speed, it converges quadratically.
std::optional<double> time_of_impact(const Convex& a, const Sweeping& motion_a, const Convex& b,
                                     const Sweeping& motion_b, Vec2 between, double target) {
    const Step step{a,           b,          motion_a, motion_b, between, motion_b.displacement - motion_a.displacement,
                    reach_of(a), reach_of(b)};
    const double size_a = step.reach_a + a.radius, size_b = step.reach_b + b.radius;
    const double tolerance = 1e-9 * std::min(size_a, size_b) + 1e-14 * std::max(size_a, size_b);
    const double core_target = target + a.radius + b.radius;
    double time = 0;
    for (;;) {
        const Frame frame_a = frame_at({}, motion_a.angle + time * motion_a.turn);
        const Frame frame_b = frame_at({}, motion_b.angle + time * motion_b.turn);
        const Vec2 place = step.place(time);
        const Placed p(a, frame_a, {}), q(b, frame_b, place);
        if (time == 0 && (starts_behind(a, frame_a, q.centre) || starts_behind(b, frame_b, p.centre - place)))
            return {};
        const CoreDistance apart = core_distance(p, q);
        if (apart.distance <= core_target + tolerance) return time;
        const double turn = apart.edge == CoreDistance::Edge::of_p   ? motion_a.turn
                            : apart.edge == CoreDistance::Edge::of_q ? motion_b.turn
                                                                     : 0;
        const Axis axis{apart.normal, turn};
        const double safe = safe_time({p, {}, {}, motion_a.turn, axis}, {q, place, step.velocity, motion_b.turn, axis},
                                      core_target, tolerance, step.acceleration(time, turn));
        if (!(time + safe <= 1)) return {};
        if (time + safe == time) return time;
        time += safe;
    }
}

}  // namespace carom
