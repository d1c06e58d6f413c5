// What had no rolling resistance any more kept the moment that it had borne by it, if something else nearby still had
// some: the books had its work, and the body did not.

#include "physics/contacts.hpp"
#include "throughput.hpp"

namespace carom::test {
namespace {

TEST(RollingMoment, IsGoneWithTheResistance) {
    World world = ramp_world(0.05, 1);
    Body wheel = disc({0, 0.5}, 0, 1);
    wheel.shapes = {{.geometry = Disc{.radius = 0.5}, .rolling_resistance = 0.2}};
    const BodyId id = world.add(wheel);
    wheel.position.x = -3;
    world.add(wheel);
    Throughput through(world);
    for (int i = 0; i < 60; ++i) {
        if (i == 30) {
            wheel = world.body(id);
            wheel.shapes[0].rolling_resistance = 0;
            world.set(id, wheel);
        }
        world.step(frame);
        through.add(world);
        expect_closed(world, through);
    }
    EXPECT_NEAR(world.angular_velocity(id), -0.5 * g * std::sin(0.05) / 1.5 / 0.5, 0.02) << "rolls for half a second";
}

}  // namespace
}  // namespace carom::test
