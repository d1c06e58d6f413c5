// Of two square corners within a hair of one height there is no contact, so that boxes slide over seams; but it was
// left out as well while the two were still apart, and for the whole step: two tumbling boxes went 43 mm into one
// another before they struck, and spun the other way after it.
#include <algorithm>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

struct Outcome {
    double nearest = 1, spin_a = 0, spin_b = 0;
};

Outcome meet(double rate) {
    World world({.solver = SoftStep{}});
    const BodyId a = world.add(Body{.angle = 3.9009242237868338,
                                    .angular_velocity = -1.8513673342636583,
                                    .shapes = {{.geometry = Box{.width = 0.8, .height = 0.5}}}});
    const BodyId b = world.add(Body{.position = {1.5, 0.039460901742142007},
                                    .angle = 1.2826638931437231,
                                    .velocity = {-3.77142098751977, 0},
                                    .angular_velocity = -2.3520500629020882,
                                    .shapes = {{.geometry = Box{.width = 0.7, .height = 0.6}}}});
    Outcome outcome;
    for (int step = 0; step < rate / 2; ++step) {
        world.step(1 / rate);
        outcome.nearest = std::min(outcome.nearest, world.closest_points(a, b)->distance);
    }
    outcome.spin_a = world.angular_velocity(a), outcome.spin_b = world.angular_velocity(b);
    return outcome;
}

TEST(Corner, ThatIsLevelWithAnotherIsMetWhereTheyTouch) {
    // What flies freely is exact, and so is the instant: the step is of no account.
    const Outcome coarse = meet(60), fine = meet(960);
    EXPECT_GT(coarse.nearest, -1e-9);
    EXPECT_NEAR(coarse.spin_a, fine.spin_a, 1e-8);
    EXPECT_NEAR(coarse.spin_b, fine.spin_b, 1e-8);
}

}  // namespace
}  // namespace carom::test
