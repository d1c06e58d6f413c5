// Bodies that nothing turns: they stand where others would tip over, and who holds them so is in the books.

#include "physics/contacts.hpp"
#include "physics/joints.hpp"
#include "throughput.hpp"

namespace carom::test {
namespace {

Body upright(Vec2 position, double width, double height, double friction, double mass = 1) {
    Body body = box(position, width, height, friction, mass);
    body.fixed_rotation = true;
    return body;
}

void pass_closed(World& world, double duration) {
    Throughput through(world);
    run(world, duration, frame, [&](const World& now) {
        through.add(now);
        expect_closed(now, through);
    });
}

TEST(FixedRotation, IsReadBackAndLeavesTheMomentOfInertia) {
    World world;
    Body body = upright({0, 0}, 1, 2, 0.5, 3);
    const BodyId id = world.add(body);
    EXPECT_TRUE(world.body(id).fixed_rotation);
    EXPECT_NEAR(*world.body(id).moment_of_inertia, 3 * (1 + 4) / 12.0, 1e-14);
    body = world.body(id), body.fixed_rotation = false;
    world.set(id, body);
    EXPECT_FALSE(world.body(id).fixed_rotation);
    EXPECT_NEAR(*world.body(id).moment_of_inertia, 3 * (1 + 4) / 12.0, 1e-14);
}

// A cupboard whose centre is beyond the edge, a disc that slides like a block, a tall box that is run into.
TEST(FixedRotation, KeepsAnAngleToTheBitWhateverIsStruck) {
    for (const bool sleeps : {false, true}) {
        World world({.gravity = {0, -g}, .solver = SoftStep{.sleep = sleeps}});
        world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Box{10, 1, {0, -0.5}}}}, .friction = 0.5});
        const BodyId leans = world.add(upright({5.2, 1.5}, 1, 3, 0.5));
        const BodyId tall = world.add(upright({0, 1}, 0.2, 2, 0.5));
        Body disc{.position = {-4, 0.5}, .velocity = {3, 0}, .radius = 0.5, .friction = 0.5};
        disc.fixed_rotation = true, disc.restitution = 0;
        const BodyId slides = world.add(disc);
        Body ball{.position = {2, 1.9}, .velocity = {-4, 0}, .radius = 0.1, .restitution = 0.5, .friction = 0.5};
        world.add(ball);
        pass_closed(world, 2);
        for (const BodyId id : {leans, tall, slides}) EXPECT_EQ(world.angle(id), 0);
        EXPECT_NEAR(world.position(leans).y, 1.5, 1e-6);
        // Like a block, and not like what rolls.
        EXPECT_NEAR(world.position(slides).x, -4 + 9 / (2 * 0.5 * g), 1e-6);
    }
}

// A turntable of fixed rotation turns on, and drags what lies on it: who turns it does the work.
TEST(FixedRotation, KeepsASpinAtTheExpenseOfWhoKeepsIt) {
    World world({.gravity = {0, -g}, .solver = SoftStep{.sleep = false}});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.3}});
    Body wheel{.position = {0, 0.5}, .angular_velocity = -4, .radius = 0.5, .friction = 0.3};
    wheel.fixed_rotation = true, wheel.restitution = 0;
    const BodyId id = world.add(wheel);
    pass_closed(world, 3);
    EXPECT_EQ(world.angular_velocity(id), -4);
    EXPECT_NEAR(world.velocity(id).x, 2, 1e-9);  // it rolls in the end
    // µ m g over the way of its rim: ½ m v² for the body and as much for heat.
    EXPECT_NEAR(energy(world).work.driven, 2 * 0.5 * 4, 0.02);
}

// Rough discs in a box, every other one of fixed rotation.
TEST(FixedRotation, IsKeptByEverySolver) {
    for (const Solver& solver :
         {Solver(Impulse{}), Solver(Impulse{.time_of_impact = false}), Solver(Events{}), Solver(SoftStep{})}) {
        World world({.gravity = {}, .solver = solver});
        const Side side{.friction = 0.3};
        world.add(Rectangle{{0, 0}, {5, 5}, side, side, side, side});
        for (int i = 0; i < 16; ++i) {
            const Vec2 at{0.7 + 1.2 * (i % 4), 0.7 + 1.2 * (i / 4)};
            Body body = disc(at, 0.3, 0.3, 1);
            body.velocity = {std::cos(2.0 * i), std::sin(2.0 * i)};
            body.fixed_rotation = i % 2 == 0, body.angular_velocity = i % 4 == 0 ? 2 : 0;
            world.add(body);
        }
        pass_closed(world, 5);
        int turned = 0;
        for (const BodyId id : world.ids()) {
            const double spin = id.index % 4 == 0 ? 2 : 0;
            if (id.index % 2 == 0) {
                EXPECT_EQ(world.angular_velocity(id), spin) << solver.index();
            }
            turned += world.angular_velocity(id) != spin;
        }
        EXPECT_EQ(turned, 8) << solver.index();
    }
}

// Torques of springs, forces off the centre and impulses.
TEST(FixedRotation, IsTurnedByNoForce) {
    for (const Integrator& method : {Integrator(Verlet{}), Integrator(Rk4{}), Integrator(GaussRadau{})}) {
        World world({.gravity = {}, .integrator = method, .solver = SoftStep{}});
        const BodyId id = world.add(upright({0, 0}, 1, 2, 0));
        const BodyId nail = world.add(Body{.kind = Kind::fixed, .position = {3, 3}});
        world.add(Spring{.a = nail, .b = id, .anchor_b = {0.5, 1}, .stiffness = 20, .rest_length = 1});
        world.apply_impulse(id, {0, 1}, {0.5, 0});
        pass_closed(world, 3);
        EXPECT_EQ(world.angle(id), 0) << method.index();
        EXPECT_GT(length(world.position(id)), 0.1) << method.index();
    }
}

// What hangs by its side hangs there; what is welded to it is as upright.
TEST(FixedRotation, HangsOnJointsByItsSide) {
    for (const bool welded : {false, true}) {
        World world({.gravity = {0, -g}, .solver = SoftStep{.sleep = false}});
        const BodyId id = world.add(upright({0.5, -1}, 1, 2, 0));
        const BodyId other = world.add(box({0.5, -2.5}, 1, 1, 0));
        world.add(Joint{.b = id, .anchor_a = Vec2{0, 1}, .anchor_b = Vec2{-0.5, 1}, .type = DistanceJoint{}});
        const Vec2 at{1, -2};
        if (welded)
            world.add(Joint{.a = id, .b = other, .anchor_a = at, .anchor_b = at, .type = WeldJoint{}});
        else
            world.add(Joint{.a = id, .b = other, .anchor_a = at, .anchor_b = at, .type = RevoluteJoint{}});
        world.apply_impulse(id, {0.3, 0}, world.position(id));
        pass_closed(world, 3);
        EXPECT_EQ(world.angle(id), 0) << welded;
        if (welded) {
            EXPECT_NEAR(world.angle(other), 0, 1e-9);
        }
        EXPECT_NEAR(length(world.position(id) + Vec2{-0.5, 1} - Vec2{0, 1}), length(Vec2{0, -1}), 1e-6);
    }
}

}  // namespace
}  // namespace carom::test
