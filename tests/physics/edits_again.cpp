// A step makes ready anew only what was changed since the one before: that must be as if it made all anew.

#include <functional>

#include "physics/contacts.hpp"
#include "restored.hpp"

namespace carom::test {
namespace {

/// A floor of tiles, crates that sleep, two of them joined, a cart that carries a box, and a lift.
struct Yard {
    World world{{.gravity = {0, -g}, .solver = SoftStep{}}};
    std::vector<BodyId> crates;
    BodyId tile, cart, rider, lift;
    ForceId<ConstantForce> thrust;
    JointId wheel;

    Yard() {
        cart = world.add(box({-8, 0.6}, 2, 0.4, 0.5, 3));
        for (int i = 0; i < 40; ++i)
            tile = world.add(Body{.kind = Kind::fixed,
                                  .position = {i - 20.0, -0.5},
                                  .shapes = {{.geometry = Box{1, 1}}},
                                  .restitution = 0,
                                  .friction = 0.6});
        for (int i = 0; i < 12; ++i) crates.push_back(world.add(box({0.1 + 1.5 * (i / 3), 0.5 + i % 3}, 1, 1, 0.6)));
        world.add(Joint{.a = crates[0], .b = crates[3], .type = DistanceJoint{}});
        rider = world.add(box({-8, 1.1}, 0.6, 0.6, 0.9));
        const BodyId rim = world.add(disc({-8, 0.4}, 0.35, 0.9));
        wheel = world.add(Joint{.a = cart,
                                .b = rim,
                                .at = Vec2{-8, 0.4},
                                .type = WheelJoint{.motor = JointMotor{.speed = -2, .maximum = 5}}});
        lift = world.add(Body{.kind = Kind::driven, .position = {1.5, 6}, .shapes = {{.geometry = Box{1, 0.2}}}});
        thrust = world.add(ConstantForce{.body = cart, .force = {1, 0}});
    }
};

/// What is done to it before a step.
using Edit = std::function<void(Yard&, int step)>;

struct Case {
    const char* name;
    Edit edit;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class EditsOfAFew : public testing::TestWithParam<Case> {};

TEST_P(EditsOfAFew, AreAsIfAllWereMadeAnew) {
    Yard yard, anew;
    for (int step = 0; step < 150; ++step) {
        if (step > 60) GetParam().edit(yard, step), GetParam().edit(anew, step);
        yard.world.step(frame), anew.world.step(frame);
        restore_from(anew.world, anew.world);  // nothing is left that was made ready
        ASSERT_EQ(state_hash(yard.world), state_hash(anew.world)) << step;
    }
    EXPECT_NEAR(energy(yard.world).unaccounted(), 0, 1e-9);  // rounding, of some 1000 J in 150 steps
}

INSTANTIATE_TEST_SUITE_P(
    All, EditsOfAFew,
    testing::Values(
        Case{"impulses",
             [](Yard& y, int step) {
                 y.world.apply_impulse(y.cart, {0.5, 1}, y.world.position(y.cart));
                 if (step % 20 == 0) y.world.apply_angular_impulse(y.crates[step / 20 % 12], 2);
             }},
        Case{"velocities",
             [](Yard& y, int step) {
                 y.world.set_velocity(y.lift, {0, step < 100 ? -4.0 : 3.0}, 0);
                 if (step % 16 == 0) y.world.set_velocity(y.crates[11], {3, 3}, 1);
             }},
        Case{"places",
             [](Yard& y, int step) {
                 if (step % 10 == 0) y.world.set_position(y.crates[0], {0.1, 8.0 + 0.01 * step}, 0.1);
             }},
        Case{"bodies",
             [](Yard& y, int step) {
                 const BodyId id = y.world.add(disc({0.02 * step, 5}, 0.2, 0.3));
                 if (step % 3 == 0) y.world.remove(id);
                 if (step % 40 == 0) y.world.remove(y.crates[step / 40]);
             }},
        Case{"shapes",
             [](Yard& y, int step) {
                 Body b = y.world.body(y.crates[5]);
                 b.shapes[0].geometry = Box{1, 0.5 + 0.003 * step};
                 b.moment_of_inertia.reset();
                 if (step % 7 == 0) y.world.set(y.crates[5], b);
             }},
        Case{"joints",
             [](Yard& y, int step) {
                 Joint j = y.world.joint(y.wheel);
                 std::get<WheelJoint>(j.type).motor->speed = -0.05 * step;
                 y.world.set(y.wheel, j);
             }},
        Case{"links",
             [filter = JointId()](Yard& y, int step) mutable {
                 if (step % 10 == 2) filter = y.world.add(Joint{.a = y.cart, .b = y.rider, .type = FilterJoint{}});
                 if (step % 10 == 3) y.world.remove(filter);
             }},
        Case{"springs",
             [spring = ForceId<Spring>()](Yard& y, int step) mutable {
                 if (step == 80)
                     spring = y.world.add(Spring{.a = y.tile, .b = y.cart, .anchor_b = {0, 0.1}, .stiffness = 9});
                 if (step == 110) y.world.remove(spring);
             }},
        Case{"forces",
             [](Yard& y, int step) {
                 y.world.set(y.thrust,
                             ConstantForce{.body = step < 110 ? y.cart : y.crates[3], .force = {0.1 * step, 0}});
             }}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace carom::test
