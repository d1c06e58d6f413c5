// A box rides on the inside of a driven plank that turns evenly. Contacts of what does not rest keep their normal for a
// step, and what that turned in a step looked like an approach: so it never rested, sank in by 11 mm/s and was said to
// be pressed by its weight alone, or by nothing where there is none.
#include <cmath>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

TEST(Rider, IsPressedByWhatKeepsItOnItsCircle) {
    for (const double gravity : {0.0, 9.81})
        for (const double omega : {0.3, 1.0, 3.0}) {
            World world({.gravity = {0, -gravity}, .solver = SoftStep{}});
            const BodyId plank =
                world.add(Body{.kind = Kind::driven,
                               .angular_velocity = omega,
                               .shapes = {{.geometry = Box{.width = 8, .height = 1, .centre = {0, -4}}}},
                               .restitution = 0,
                               .friction = 0.5});
            constexpr double radius = 3.3;
            const BodyId rider = world.add(Body{.position = {0, -radius},
                                                .velocity = {radius * omega, 0},
                                                .angular_velocity = omega,
                                                .shapes = {{.geometry = Box{.width = 0.6, .height = 0.4}}},
                                                .restitution = 0,
                                                .friction = 0.5});
            run(world, 0.4, 1.0 / 60);
            double pressed = 0;
            for (const auto& c : world.contacts()) pressed += c.normal_force;
            const double exact = radius * omega * omega + gravity * std::cos(omega * world.time());
            // Within a substep the force keeps its direction, which turns by ω h: an error of that part.
            EXPECT_NEAR(pressed, exact, omega / 240 * exact) << gravity << ' ' << omega;
            EXPECT_GT(world.closest_points(plank, rider)->distance, -1e-6) << gravity << ' ' << omega;
        }
}

}  // namespace
}  // namespace carom::test
