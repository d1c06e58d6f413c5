#pragma once
#include <carom/body.hpp>
#include <functional>
#include <span>
#include <vector>

namespace carom {

/// A force's number among those of its kind in its world, never given twice; 0 is none.
template <class Force>
struct ForceId {
    std::uint32_t number = 0;
    auto operator<=>(const ForceId&) const = default;
};
template <class Force>
constexpr std::uint64_t key(ForceId<Force> id) {
    return id.number;
}

enum class DampingLaw : std::uint8_t { along, isotropic };
constexpr auto choices(const DampingLaw*) {
    return std::array{
        Choice<DampingLaw>{"along", DampingLaw::along, "F = −c (n·Δv) n: only the rate of stretch is damped"},
        Choice<DampingLaw>{"isotropic", DampingLaw::isotropic, "F = −c Δv: the whole relative velocity is damped"}};
}

/// F = −k (|d| − L) d/|d| − c Δv on b, and the opposite on a.   U = ½ k (|d| − L)²
struct Spring {
    BodyId a{}, b{};
    Vec2 anchor_a{}, anchor_b{};
    double stiffness = 1;
    double rest_length = 0;
    double damping = 0;
    DampingLaw damping_law = DampingLaw::along;
};
constexpr std::string_view describe(const Spring*) { return "A spring between points of two bodies (Hooke's law)."; }
template <std::same_as<Spring> T>
constexpr auto fields(const T*) {
    return std::tuple{field("a", &T::a, "body at one end"),
                      field("b", &T::b, "body at the other end"),
                      field("anchor_a", &T::anchor_a, "m", any, "point of a, seen from its centre in its own frame"),
                      field("anchor_b", &T::anchor_b, "m", any, "point of b, seen from its centre in its own frame"),
                      field("stiffness", &T::stiffness, "N/m", non_negative, "force per stretch, k"),
                      field("rest_length", &T::rest_length, "m", non_negative, "length without force, L"),
                      field("damping", &T::damping, "N s/m", non_negative, "force per relative velocity, c"),
                      field("damping_law", &T::damping_law, "which part of the relative velocity is damped")};
}

/// τ = −k (θ_b − θ_a − θ₀) − c (ω_b − ω_a) on b, and the opposite on a.   U = ½ k (θ_b − θ_a − θ₀)²
struct TorsionSpring {
    BodyId a{}, b{};
    double stiffness = 1;
    double rest_angle = 0;
    double damping = 0;
};
constexpr std::string_view describe(const TorsionSpring*) { return "A spring that resists the turning of two bodies."; }
template <std::same_as<TorsionSpring> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("a", &T::a, "one body"), field("b", &T::b, "the other body"),
        field("stiffness", &T::stiffness, "N m/rad", non_negative, "torque per angle, k"),
        field("rest_angle", &T::rest_angle, "rad", any, "θ_b − θ_a without torque"),
        field("damping", &T::damping, "N m s/rad", non_negative, "torque per relative angular velocity, c")};
}

/// F = −(b + c |u|) u with u = v − wind.   Rotation: τ = −angular ω
struct Drag {
    std::optional<BodyId> body{};
    double linear = 0;
    double quadratic = 0;
    double angular = 0;
    Vec2 wind{};
};
constexpr std::string_view describe(const Drag*) { return "Resistance of a medium, which may itself move."; }
template <std::same_as<Drag> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("body", &T::body, "the body that feels it; if absent all do"),
        field("linear", &T::linear, "N s/m", non_negative, "force per speed, b (Stokes)"),
        field("quadratic", &T::quadratic, "N s²/m²", non_negative, "force per squared speed, c = ½ ρ C_d A (Newton)"),
        field("angular", &T::angular, "N m s/rad", non_negative, "torque per angular velocity"),
        field("wind", &T::wind, "m/s", any, "velocity of the medium")};
}

enum class Couples : std::uint8_t { mass, charge };
constexpr auto choices(const Couples*) {
    return std::array{Choice<Couples>{"mass", Couples::mass, "attraction, F ∝ m₁ m₂"},
                      Choice<Couples>{"charge", Couples::charge, "repulsion of like charges, F ∝ q₁ q₂"}};
}
enum class DistanceLaw : std::uint8_t { inverse_square, inverse };
constexpr auto choices(const DistanceLaw*) {
    return std::array{
        Choice<DistanceLaw>{"inverse-square", DistanceLaw::inverse_square, "F ∝ r/(r²+ε²)^(3/2): three dimensions"},
        Choice<DistanceLaw>{"inverse", DistanceLaw::inverse, "F ∝ r/(r²+ε²): Gauss's law in the plane"}};
}

/// Between all pairs. Inverse square: U = ∓ s c₁ c₂ / √(r²+ε²). Inverse: U = ± ½ s c₁ c₂ ln((r²+ε²)/m²).
/// c is mass (upper sign) or charge (lower sign).
struct Attraction {
    double strength = 1;
    Couples couples = Couples::mass;
    DistanceLaw law = DistanceLaw::inverse_square;
    double softening = 0;
};
constexpr std::string_view describe(const Attraction*) {
    return "Attraction or repulsion between all pairs of bodies.";
}
template <std::same_as<Attraction> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("strength", &T::strength, "N m²/kg² or N m²/C²", any,
              "G between masses, 1/(4πε₀) between charges; one power of m less under the inverse law"),
        field("couples", &T::couples, "what the force is proportional to"),
        field("law", &T::law, "how the force falls with distance"),
        field("softening", &T::softening, "m", non_negative, "length ε below which the force is softened (Plummer)")};
}

/// Pushes apart all pairs of discs that overlap, by δ = r₁ + r₂ − |d|: F = k δ n − m γ (n·Δv) n, with m = m₁ m₂/(m₁ +
/// m₂).   U = ½ k δ²   (Cundall, Strack, Géotechnique 29, 47 (1979); LAMMPS's gran/hooke.)
struct SoftDiscs {
    double stiffness = 1e5;
    double damping = 0;
};
constexpr std::string_view describe(const SoftDiscs*) {
    return "Discs that are soft: a linear spring with damping wherever two of them overlap.";
}
template <std::same_as<SoftDiscs> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("stiffness", &T::stiffness, "N/m", non_negative, "force per overlap, k"),
        field("damping", &T::damping, "1/s", non_negative,
              "γ; a collision lasts t = π/√(k/m − γ²/4) and leaves exp(−γ t/2) of the speed, with the reduced mass m")};
}

/// F and τ that do not change.   U = −F·(position of the point) (the torque is booked as work)
struct ConstantForce {
    BodyId body{};
    Vec2 force{};
    Vec2 point{};
    double torque = 0;
};
constexpr std::string_view describe(const ConstantForce*) { return "A constant force and torque on one body."; }
template <std::same_as<ConstantForce> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("body", &T::body, "the body that feels it"),
        field("force", &T::force, "N", any, "force, in the world's frame"),
        field("point", &T::point, "m", any, "where it acts, seen from the centre in the body's own frame"),
        field("torque", &T::torque, "N m", any, "torque in addition to that of the force, counterclockwise")};
}

/// What a force may read: the bodies' rows, in the order of World::ids().
struct Snapshot {
    double time;
    std::span<const Vec2> position;
    std::span<const double> angle;
    std::span<const Vec2> velocity;
    std::span<const double> angular_velocity;
    std::span<const double> mass;
};

/// A force of your own on every body: called for one body at a time, at every stage of every integrator.
struct ForceField {
    std::string name{};
    std::optional<BodyId> body{};  ///< the body that feels it; if absent all do
    /// Force [N] on a body of mass m at position x with velocity v at time t.
    std::function<Vec2(Vec2 x, Vec2 v, double m, double t)> force{};
    /// Its potential energy [J], if it has one; without one its work is booked as the user's. A potential that changes
    /// with time does work by its slope in t, so it is called for times before and after now, also before 0 s, as a
    /// curve is: see World::drive().
    std::function<double(Vec2 x, double m, double t)> potential{};
    /// Whether the force looks at v. That it does not is a promise, and lets 'nystrom' have it if it has a potential.
    bool sees_velocity = true;
};

/// A force of your own on the world as a whole: adds to force[i] and torque[i]. Its work is booked as the user's.
struct UserForce {
    std::string name{};
    std::function<void(const Snapshot& now, std::span<Vec2> force, std::span<double> torque)> add{};
};

}  // namespace carom
