// What a gas is said to be, with its error, is true of it: or it is not said.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <carom/gas.hpp>
#include <cmath>
#include <optional>

namespace carom {
namespace {

/// The coefficient of diffusion of a gas of 100 discs, if the meter has one.
template <class Room>
std::optional<GasNumber> diffusion(const Room& room, double side, double step, double duration) {
    World world({.solver = Events{}});
    world.add(room);
    build(world, Gas{.fill = {.high = {side, side}, .count = 100, .smallest_radius = 0.2, .largest_radius = 0.2}});
    GasMeter meter(world);
    run(world, duration, step, [&](const World& now) { meter.observe(now); });
    for (const GasNumber& n : meter.numbers())
        if (n.name == "diffusion") return n;
    return {};
}

// A disc collides 1.8 times a second. It was 0.245 ± 0.0004 m²/s for ways of half a second, and 0.38 ± 0.006 between
// walls.
TEST(Gas, DiffusesWhereDiscsForgetTheirVelocityAndMeetNoWalls) {
    const auto measured = diffusion(Periodic{.high = {10, 10}}, 10, 0.2, 1000);
    ASSERT_TRUE(measured);
    // Other steps look at other times, and in a plane diffusion grows with them, slowly: by 2 % from here.
    const auto longer = diffusion(Periodic{.high = {10, 10}}, 10, 0.25, 1000);
    ASSERT_TRUE(longer);
    EXPECT_NEAR(measured->value, longer->value,
                3 * std::hypot(measured->error, longer->error) + 0.02 * measured->value);

    EXPECT_FALSE(diffusion(Periodic{.high = {10, 10}}, 10, 0.02, 100)) << "ways of an instant";
    EXPECT_FALSE(diffusion(Rectangle{.high = {10, 10}}, 10, 0.2, 100)) << "ways from wall to wall";
}

}  // namespace
}  // namespace carom
