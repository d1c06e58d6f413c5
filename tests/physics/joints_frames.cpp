// Random mechanisms, seen by others: who is turned by 90°, who flies past, who looks at them in a mirror.

#include <numbers>

#include "choices.hpp"
#include "joints.hpp"
#include "trials.hpp"

namespace carom::test {
namespace {

/// How a world is looked at: first in a mirror that changes the sign of x, then turned by 90°, then flying past.
struct Look {
    bool mirrored = false, turned = false;
    Vec2 wind{};

    double side() const { return mirrored ? -1 : 1; }
    double turn() const { return turned ? pi / 2 : 0; }
    /// Of a body's own frame, which is mirrored and not turned.
    Vec2 own(Vec2 v) const { return {side() * v.x, v.y}; }
    Vec2 of(Vec2 v) const { return turned ? Vec2{-v.y, side() * v.x} : own(v); }
    Body of(Body body) const {
        body.position = of(body.position), body.angle = side() * body.angle + turn();
        body.velocity = of(body.velocity) + wind, body.angular_velocity *= side();
        return body;
    }
    void turn_limits(JointLimits& limits) const {
        const auto negative = [](std::optional<double> x) { return x ? std::optional(-*x) : x; };
        if (mirrored) limits = {negative(limits.upper), negative(limits.lower)};
    }
    Joint of(Joint joint) const {
        joint.at = of(*joint.at);
        std::visit(
            [this]<class T>(T& type) {
                if constexpr (requires { type.axis; }) type.axis = own(type.axis);
                if constexpr (std::is_same_v<T, RevoluteJoint>) turn_limits(type.limits);
                if constexpr (std::is_same_v<T, RevoluteJoint> || std::is_same_v<T, WheelJoint>)
                    if (type.motor) type.motor->speed *= side();
                if constexpr (std::is_same_v<T, MotorJoint>)
                    type.velocity = of(type.velocity), type.angular_velocity *= side();
            },
            joint.type);
        return joint;
    }
};

JointType random_type(Choices& any) {
    const double most = any.magnitude(1, 300);
    JointLimits limits;
    if (any.chance(0.5)) limits = {-any.between(0, 0.6), any.between(0, 0.6)};
    std::optional<JointSpring> spring;
    if (any.chance(0.4)) spring = {.stiffness = any.magnitude(1, 1e5), .damping = any.chance(0.5) ? 0.0 : 1.0};
    std::optional<JointMotor> motor;
    if (any.chance(0.5)) motor = {.speed = any.between(-6, 6), .maximum = most};
    const Vec2 axis{any.between(-1, 1), 1};
    return any.one_of<JointType>(
        {RevoluteJoint{.spring = spring, .motor = motor, .limits = limits},
         PrismaticJoint{.axis = axis, .spring = spring, .motor = motor, .limits = limits},
         WheelJoint{.axis = axis, .spring = spring, .motor = motor, .limits = limits}, WeldJoint{.spring = spring},
         MotorJoint{.velocity = {1, 0.5}, .angular_velocity = 1, .maximum_force = most, .maximum_torque = most},
         FrictionJoint{most, 0.3 * most}, DragHandle{.maximum = most}});
}

/// A few sticks in free flight, some of them joined.
World random_mechanism(std::uint64_t seed, const Look& look) {
    Choices any(seed);
    const Vec2 g = any.chance(0.5) ? Vec2{} : Vec2{any.between(-3, 3), -9};
    World world = mechanism_world({.sleep = false, .keep_energy = any.chance(0.5)}, look.of(g));
    std::optional<BodyId> last;
    Vec2 before{};
    for (int i = 0; i < 5; ++i) {
        const Vec2 at{i + any.between(-0.2, 0.2), any.between(-0.2, 0.2)};
        Body stick = rod(at, 1, any.magnitude(0.3, 30));
        stick.angle = any.between(-3, 3);
        stick.velocity = {any.between(-3, 3), any.between(-3, 3)}, stick.angular_velocity = any.between(-9, 9);
        const BodyId next = world.add(look.of(stick));
        const Vec2 between = 0.5 * (before + at);
        if (last) world.add(look.of(Joint{.a = last, .b = next, .at = between, .type = random_type(any)}));
        last = next, before = at;
    }
    return world;
}

// What is of second order in a step is the same for all, and so are steps, bounds and thresholds: until chaos has made
// much of the last bit nothing differs. Hands were as stiff as a stick was turned, and springs lost less in flight.
TEST(RandomMechanisms, AreTheSameForWhoeverLooks) {
    constexpr std::uint64_t worlds = trials(200);
    const Look looks[]{{.mirrored = true}, {.turned = true}, {.wind = {40, -25}}, {true, true, {-9, 3}}};
    for (std::uint64_t seed = 0; seed < worlds; ++seed)
        for (const Look& look : looks) {
            World world = random_mechanism(seed, {}), other = random_mechanism(seed, look);
            run(world, 0.25, frame), run(other, 0.25, frame);
            for (std::size_t i = 0; i < world.size(); ++i) {
                const Vec2 seen = look.of(world.positions()[i]) + 0.25 * look.wind;
                EXPECT_NEAR(length(seen - other.positions()[i]), 0, 1e-8) << seed << ", body " << i;
                EXPECT_NEAR(look.side() * world.angles()[i] + look.turn(), other.angles()[i], 1e-8) << seed;
            }
        }
}

}  // namespace
}  // namespace carom::test
