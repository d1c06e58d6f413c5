#pragma once
#include <array>
#include <carom/field.hpp>
#include <carom/id.hpp>
#include <carom/shape.hpp>
#include <carom/vec2.hpp>
#include <cstdint>
#include <optional>
#include <string>

namespace carom {

/// A body's number in its world. It stays valid while other bodies come and go; after its own body is removed every
/// use of it is an Error that says so.
struct BodyId {
    std::uint32_t index = 0xffffffff;
    std::uint32_t generation = 0;
    auto operator<=>(const BodyId&) const = default;
};
constexpr std::uint64_t key(BodyId id) { return std::uint64_t{id.generation} << 32 | id.index; }

/// A shape of a body, by its number among the body's shapes; a body without shapes is one shape, number 0.
struct ShapeId {
    BodyId body{};
    std::uint32_t shape = 0;
    auto operator<=>(const ShapeId&) const = default;
};
constexpr std::uint64_t key(ShapeId id) {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;  // 2^64 / φ: shapes of a body lie far from one another
    return key(id.body) + id.shape * golden;
}

/// Where a body is, and how it is turned.
struct Pose {
    Vec2 position{};   ///< [m]
    double angle = 0;  ///< [rad]
};
/// The position in the world [m] of a point that is given in the frame of a body with this pose.
Vec2 to_world(const Pose& pose, Vec2 point);
/// The inverse: the position in the body's frame [m] of a point that is given in the world.
Vec2 to_body(const Pose& pose, Vec2 point);

enum class Kind : std::uint8_t { dynamic, fixed, driven };
constexpr auto choices(const Kind*) {
    return std::array{Choice<Kind>{"dynamic", Kind::dynamic, "moves under forces"},
                      Choice<Kind>{"fixed", Kind::fixed, "never moves"},
                      Choice<Kind>{"driven", Kind::driven, "moves with the velocity it is given, whatever the forces"}};
}

/// Red, green, blue, opacity, 0 to 255 each.
struct Colour {
    std::uint8_t r = 0, g = 114, b = 178, a = 255;
    bool operator==(const Colour&) const = default;
};

struct Body {
    Kind kind = Kind::dynamic;
    Vec2 position{};
    double angle = 0;
    Vec2 velocity{};
    double angular_velocity = 0;
    double mass = 1;
    std::optional<double> moment_of_inertia{};
    bool fixed_rotation = false;
    double radius = 0;
    std::vector<Shape> shapes{};
    double charge = 0;
    double restitution = 1;
    double friction = 0;
    std::string name{};
    std::optional<Colour> colour{};
};

constexpr std::string_view describe(const Body*) {
    return "A body: a point mass, a disc, or what its shapes make of it.";
}
template <std::same_as<Body> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("name", &T::name, "unique name by which a scene refers to the body; may be empty"),
        field("kind", &T::kind, "how the body moves"),
        field("position", &T::position, "m", any,
              "where it is at the start: the origin of its shapes if it has any, else its centre of mass"),
        field("angle", &T::angle, "rad", any, "orientation at the start, counterclockwise"),
        field("velocity", &T::velocity, "m/s", any, "velocity of the centre of mass at the start"),
        field("angular_velocity", &T::angular_velocity, "rad/s", any, "angular velocity at the start"),
        field("mass", &T::mass, "kg", positive,
              "inertial and gravitational mass; that of a fixed or driven body matters only for what it attracts; left "
              "out if the shapes have a density, from which it follows"),
        field("moment_of_inertia", &T::moment_of_inertia, "kg m²", positive,
              "about the centre of mass; if absent that of the shapes, or of a solid disc, ½ m r²; a point does not "
              "turn"),
        field("fixed_rotation", &T::fixed_rotation,
              "of a dynamic body: its angular velocity never changes, whatever the torque; the work that this takes is "
              "booked as that of driven bodies"),
        field("radius", &T::radius, "m", non_negative, "radius of the disc; 0 is a point"),
        field("shapes", &T::shapes,
              "what it is made of, if it is neither a point nor a disc; its radius must be 0 then"),
        field("charge", &T::charge, "C", any, "charge, felt by attractions between charges"),
        field("restitution", &T::restitution, "", fraction,
              "rebound speed over approach speed; where two bodies touch the smaller value counts, or what the world's "
              "restitution_mixing says"),
        field("friction", &T::friction, "", non_negative,
              "Coulomb's coefficient; where two bodies touch the geometric mean counts, or what the world's "
              "friction_mixing says"),
        field("colour", &T::colour,
              "drawn in this colour, as #rrggbb, #rrggbbaa, #rgb or a name like red; if absent one is chosen"),
    };
}

}  // namespace carom
