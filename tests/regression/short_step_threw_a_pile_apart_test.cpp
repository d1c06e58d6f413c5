// One short step among longer ones, such as the rest of a run: what rests on one another flew apart. The rest of a
// velocity that is stopped in a microsecond is a great force, with which the next step began for all of its own time;
// and contacts became so stiff at once that they threw apart what leant as deep on one another as longer steps let it.
#include <cmath>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

/// A disc rolls on the pile still: 0.27 J at most in steps of 1/60 s, and 0.4 J with a short one. It was 20 J after one
/// of a millisecond, and 2e9 J after 7e-8 s.
constexpr double still_moving = 0.6;  // J

World pile() {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
    world.add(HalfPlane{.point = {-2, 0}, .normal = {1, 0}, .side = {.restitution = 0}});
    world.add(HalfPlane{.point = {2, 0}, .normal = {-1, 0}, .side = {.restitution = 0}});
    for (int i = 0; i < 60; ++i) {
        Body body{.position = {-1.5 + (i % 5) * 0.75, 0.5 + 0.7 * (i / 5)}, .restitution = 0, .friction = 0.5};
        if (i % 2 != 0)
            body.shapes = {{.geometry = Box{.width = 0.6, .height = 0.5}}};
        else
            body.radius = 0.3;
        world.add(body);
    }
    run(world, 5, 1.0 / 60);
    return world;
}

TEST(APile, BearsAShortStepAmongLongerOnes) {
    const World settled = pile();
    for (const double seconds : {1e-3, 1e-4, 1e-6, 7e-8}) {
        World world = settled;
        double most = 0;
        world.step(seconds);
        for (int step = 0; step < 10; ++step) {
            world.step(1.0 / 60);
            most = std::max(most, energy(world).kinetic);
        }
        EXPECT_LT(most, still_moving) << seconds;
    }
}

TEST(APile, BearsShortStepsFromNowOn) {
    World world = pile();
    double most = 0;
    for (int step = 0; step < 1000; ++step) {
        world.step(1e-4);
        most = std::max(most, energy(world).kinetic);
    }
    EXPECT_LT(most, still_moving);
}

}  // namespace
}  // namespace carom::test
