#pragma once
#include <carom/joint.hpp>
#include <carom/vec2.hpp>
#include <vector>

// What happened in a world's last step.

namespace carom {

/// Two shapes. a is the sensor or the wall if there is one, else the shape of the body with the smaller index. A wall
/// belongs to no body (its generation is 0) and is known by its number: first the left, right, bottom and top of every
/// rectangle, then the half-planes, then the stadiums, which appear in no contact.
struct ShapePair {
    ShapeId a, b;
    /// Whether a is a wall. A wall is not a body: asking the world for a.body is an Error.
    bool at_wall() const { return a.body.generation == 0; }
    bool operator==(const ShapePair&) const = default;
};

/// Two shapes that strike each other: they bounce, or they touch now and did not in the step before.
struct Impact {
    ShapePair shapes;
    double time = 0;      ///< the instant of a bounce, else the end of the substep [s]
    Vec2 point{};         ///< where they meet, in the middle of all the impulses [m]
    Vec2 normal{};        ///< from a to b, of length 1
    double approach = 0;  ///< relative speed along the normal before the impact [m/s]
    double impulse = 0;   ///< along the normal [kg m/s]
    bool operator==(const Impact&) const = default;
};

/// A point at which two shapes are pressed together, and the force that b gets there; a gets the opposite.
struct ContactPoint {
    ShapePair shapes;
    Vec2 point{};              ///< on the outline of b [m]
    Vec2 normal{};             ///< from a to b, of length 1
    double normal_force = 0;   ///< along the normal, never pulling [N]
    double tangent_force = 0;  ///< of friction, along the normal turned left by 90° [N]
    bool operator==(const ContactPoint&) const = default;
};

/// What happened in a step. The order of each list depends on the world alone: pairs are sorted by walls, indices and
/// shapes, impacts by time. Adding every begin and dropping it at its end gives what touches now; the contacts of a
/// removed body end in the next step, under its stale id.
struct StepEvents {
    std::vector<ShapePair> begins, ends;  ///< of contacts: shapes pressed together, or that struck each other
    std::vector<Impact> impacts;
    std::vector<ShapePair> sensor_begins, sensor_ends;  ///< of overlap or touch, at the end of the step
    std::vector<BodyId> sleeps, wakes;                  ///< under SoftStep; of a body in both, asleep() tells
    std::vector<JointId> broken;                        ///< joints that broke under their load and are removed
    bool operator==(const StepEvents&) const = default;
};

}  // namespace carom
