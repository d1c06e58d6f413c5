#pragma once
#include <carom/joint.hpp>
#include <carom/vec2.hpp>
#include <vector>

// What happened in a world's last step.

namespace carom {

/// Two shapes: first that of a sensor, of a wall, or of the body with the smaller index. A wall's shape has no body
/// (its generation is 0); its number counts the left, right, bottom and top of every rectangle, then the half-planes,
/// then the stadiums, which no contact has.
struct ShapePair {
    ShapeId a, b;
    /// Whether a is a wall, which is no body: asking the world for it is an Error.
    bool at_wall() const { return a.body.generation == 0; }
    bool operator==(const ShapePair&) const = default;
};

/// Two shapes that strike each other: they bounce, or they did not touch in the step before and do now.
struct Impact {
    ShapePair shapes;
    double time = 0;      ///< of a bounce its instant, else the end of the substep [s]
    Vec2 point{};         ///< where they meet, in the middle of all the impulses [m]
    Vec2 normal{};        ///< from a to b, of length 1
    double approach = 0;  ///< speed along the normal with which they came [m/s]
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

/// What happened in a step. Each list is in an order that depends on nothing but the world: pairs by walls, indices and
/// shapes, impacts by time. Whoever counts begins and ends knows what touches now; where a body was removed, what it
/// touched ends in the next step, under its stale id.
struct StepEvents {
    std::vector<ShapePair> begins, ends;  ///< to touch, which is to be pressed together or struck in a step
    std::vector<Impact> impacts;
    std::vector<ShapePair> sensor_begins, sensor_ends;  ///< to overlap or touch at the end of a step
    std::vector<BodyId> sleeps, wakes;                  ///< under SoftStep; of who is in both, asleep() tells
    std::vector<JointId> broken;                        ///< joints that bore more than they could, and are gone
    bool operator==(const StepEvents&) const = default;
};

}  // namespace carom
