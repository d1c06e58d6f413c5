// A disc so light that 1 / m is infinite has no place after its impact, and the broad phase made a whole number of
// that: undefined, as the sanitizers say. It is the step's end that says which body is lost.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(Regression, DiscWithoutAPlaceIsAnError) {
    World world({.gravity = {4.625, -7.125}, .integrator = Pefrl{}, .solver = Impulse{.time_of_impact = true}});
    world.add(Rectangle{.low = {-7.4375, -7.5}, .high = {-1.4375, -7.4375}});
    world.add(Body{.position = {-7.5, -7.5}, .velocity = {-7.5, -7.5}, .mass = 4e-323, .radius = 4.625});
    EXPECT_THROW(world.step(0.1171875), Error);
}

}  // namespace
}  // namespace carom
