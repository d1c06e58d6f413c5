// A sensor was matter: a box of 1 m with a sensor of 5 m around it had 74 times its moment of inertia, 79.5 times its
// mass by density, and its centre where the sensor had it.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(Regression, SensorWeighed) {
    const Shape box{.geometry = Box{.width = 1, .height = 1}, .density = 1};
    const Shape sensor{.geometry = Disc{.centre = {3, 0}, .radius = 5}, .sensor = true};
    World world({.solver = SoftStep{}});
    for (const std::vector<Shape>& shapes : {std::vector{box, sensor}, std::vector{sensor, box}}) {
        const Body with = world.body(world.add(Body{.position = {2, 1}, .shapes = shapes}));
        EXPECT_DOUBLE_EQ(with.mass, 1);
        EXPECT_DOUBLE_EQ(*with.moment_of_inertia, 1. / 6);
        EXPECT_EQ(with.position, (Vec2{2, 1}));
    }
    // Without densities the mass is spread over what weighs; a density of a sensor is nobody's.
    Shape plain = box, dense = sensor;
    plain.density = {}, dense.density = 3;
    for (const Shape& beside : {sensor, dense}) {
        const Body with = world.body(world.add(Body{.mass = 6, .shapes = {plain, beside}}));
        EXPECT_EQ(with.mass, 6);
        EXPECT_DOUBLE_EQ(*with.moment_of_inertia, 1);
    }
}

TEST(Regression, BodyOfSensorsAloneHasTheirMassStill) {
    World world({.solver = SoftStep{}});
    const Body alone = world.body(
        world.add(Body{.mass = 2, .shapes = {{.geometry = Disc{.centre = {1, 0}, .radius = 3}, .sensor = true}}}));
    EXPECT_EQ(alone.mass, 2);
    EXPECT_DOUBLE_EQ(*alone.moment_of_inertia, 9);
    EXPECT_EQ(alone.position, (Vec2{1, 0}));
}

}  // namespace
}  // namespace carom
