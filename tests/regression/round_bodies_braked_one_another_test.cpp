// Round bodies that touched braked one another's motion round each other, without any friction: the normal of a contact
// was that of the step's beginning, and its force on average half a step behind. What rolled over them was braked
// alike. And with the solver `impulse` discs that rested on one another went round faster and faster: they were put
// apart across their way, with the velocities that they had nearer to one another.
// Later their motion was right, but who was off by the error of a substep's bend, more than a billionth of the radii,
// was let fall on a tangent and landed anew in each: that was heat of impacts and residual, and the precise solve told
// forces of anything from none to twice what they were.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Smooth discs that touch and attract one another, in so many rings round the first one, and turn as one.
World raft(Solver solver, int rings, double rate) {
    World world({.solver = solver});
    const auto put = [&](Vec2 x) {
        Body disc{.position = x, .velocity = rate * perpendicular(x)};
        disc.radius = 0.5, disc.restitution = 0;
        world.add(disc);
    };
    put({});
    for (int ring = 1; ring <= rings; ++ring)
        for (int side = 0; side < 6; ++side)
            for (int k = 0; k < ring; ++k) {
                const auto corner = [](int i) { return Vec2{std::cos(pi * i / 3), std::sin(pi * i / 3)}; };
                put((ring - k) * corner(side) + static_cast<double>(k) * corner(side + 1));
            }
    world.add(Attraction{.strength = 2});
    return world;
}

// Every impulse is along the line of two centres as they are then, so that nothing turns the raft but rounding, and
// what a contact does in the one substep in which it is found. Seven are solved by sweeps, and 61 are a crowd.
TEST(RoundBodies, TurnFreelyRoundOneAnother) {
    for (const int rings : {1, 4}) {
        World world = raft(SoftStep{}, rings, 0.3);
        const double turning = momentum_balance(world).total.angular, kinetic = energy(world).kinetic;
        run(world, rings == 1 ? 5 : 1, 1.0 / 60);
        EXPECT_NEAR(momentum_balance(world).total.angular, turning, 1e-4 * turning) << rings;
        EXPECT_NEAR(energy(world).kinetic, kinetic, 0.01 * kinetic) << rings;  // overlaps make it smaller, and come
    }
}

// Nothing is lost, and nothing landed anew: what is booked is of second order, about (ω h)² = 7e-5 of the energy at
// 60/s and more where twelve contacts bear. Of a pair it was 1.66 J of 21 J, of seven discs 13 J and 5 J of 222 J.
TEST(RoundBodies, LoseNothingWhereTheyAreSmooth) {
    const auto check = [](World& world, double dt, double most) {
        const double turning = momentum_balance(world).total.angular, all = energy(world).total();
        run(world, 10, dt);
        const Energy after = energy(world);
        EXPECT_NEAR(after.heat.impact, 0, most * all) << dt;
        EXPECT_NEAR(after.residual, 0, most * all) << dt;
        EXPECT_NEAR(after.work.overlap, 0, most * all) << dt;
        EXPECT_NEAR(after.total(), all, 3e-4 * all) << dt;
        // Forces at the end of a substep are those where it would end without contacts: of third order.
        EXPECT_NEAR(momentum_balance(world).total.angular, turning, 4e-3 * turning) << dt;
    };
    for (const double dt : {1.0 / 60, 1.0 / 240}) {
        World seven({.solver = SoftStep{.sleep = false}}), pair = seven;
        std::vector<BodyId> ids;
        const auto put = [](World& world, Vec2 x, double mass) {
            Body disc{.position = x, .velocity = 2.0 * perpendicular(x), .mass = mass};
            disc.radius = 0.5, disc.restitution = 0;
            return world.add(disc);
        };
        const BodyId a = put(pair, {-0.25, 0}, 1), b = put(pair, {0.75, 0}, 0.5);
        pair.add(Spring{.a = a, .b = b, .stiffness = 40});
        check(pair, dt, 2e-4);
        ids.push_back(put(seven, {}, 1));
        for (int k = 0; k < 6; ++k) ids.push_back(put(seven, {std::cos(pi * k / 3), std::sin(pi * k / 3)}, 1));
        for (std::size_t i = 0; i < ids.size(); ++i)
            for (std::size_t j = i + 1; j < ids.size(); ++j)
                seven.add(Spring{.a = ids[i], .b = ids[j], .stiffness = i == 0 ? 40.0 : 5.0});
        check(seven, dt, 2e-4);
    }
}

// A normal that turns towards who goes on has him part by as much as he came nearer along the one before: only both
// together are work, and undo an overlap if one is there. It was 1.4 J of overlap, and of heat.
TEST(RoundBodies, UndoNoOverlapWhereThereIsNone) {
    World world({.solver = SoftStep{.precise = Precise::never, .sleep = false}});
    std::vector<BodyId> ids;
    for (const int side : {-1, 1}) {
        Body disc{.position = {0.5 * side, 0}, .velocity = {0, 1.0 * side}};
        disc.radius = 0.5, disc.friction = 50, disc.restitution = 0;
        ids.push_back(world.add(disc));
    }
    world.add(Spring{.a = ids[0], .b = ids[1], .stiffness = 40});
    run(world, 10, 1.0 / 60);
    const Energy after = energy(world);
    EXPECT_NEAR(after.work.overlap, 0, 1e-4 * after.total());
    EXPECT_NEAR(after.heat.impact, 0, 1e-4 * after.total());
}

// m g cos θ − m v² / R, to a hundredth of the weight: what is told is the mean of a substep, in which it falls by about
// as much. It was 0 N, or 4 N for 2 N, now and then.
TEST(RoundBodies, TellWhatPressesThem) {
    for (const double radius : {0.05, 0.5})
        for (const double dt : {1.0 / 60, 1.0 / 240}) {
            World world({.gravity = {0, -10}, .solver = SoftStep{.sleep = false, .statics = false}});
            Body hill{.kind = Kind::fixed}, disc;
            hill.radius = 1, disc.radius = radius;
            disc.position = (1 + radius) * Vec2{std::sin(0.2), std::cos(0.2)};
            for (Body* body : {&hill, &disc}) body->friction = 1.5, body->restitution = 0;
            world.add(hill);
            const BodyId id = world.add(disc);
            for (int k = 0; k < 3 / dt; ++k) {
                world.step(dt);
                const Vec2 x = world.position(id), v = world.velocity(id);
                const double wanted = (10 * x.y - dot(v, v)) / length(x);
                if (wanted < 1) break;
                if (k < 3) continue;  // it begins with the force of no substep before
                ASSERT_EQ(world.contacts().size(), 1U) << radius << ' ' << dt << ' ' << k;
                EXPECT_NEAR(world.contacts()[0].normal_force, wanted, 0.1) << radius << ' ' << dt << ' ' << k;
            }
        }
}

// In pure rolling nothing pulls along the rims. It was 10 % in 5 s.
TEST(RoundBodies, RollOverOneAnotherFreely) {
    World world({.solver = SoftStep{}});
    Body still{.kind = Kind::fixed}, planet{.position = {1, 0}, .velocity = {0, 0.3}, .angular_velocity = 0.6};
    for (Body* body : {&still, &planet}) body->radius = 0.5, body->friction = 1, body->restitution = 0;
    const BodyId centre = world.add(still), disc = world.add(planet);
    world.add(Spring{.a = centre, .b = disc, .stiffness = 8, .rest_length = 0.5});
    run(world, 5, 1.0 / 60);
    EXPECT_NEAR(length(world.velocity(disc)), 0.3, 1e-4);
    EXPECT_NEAR(world.angular_velocity(disc), 0.6, 2e-4);
}

// Sides that lie on one another turn as their bodies do, and so do the rims beneath their cores: at the end of a
// substep the normal is not that of its middle. Two boxes of round corners that turn as one were put apart by ω² h r /
// 2 in each substep; friction brought them together: -1.4 J of heat of impacts at 60/s, and 3 % (in shorter steps 25 %)
// of their turning was lost. What is left is of when they are spun up, in the first substeps.
TEST(RoundBodies, TurnAsOneOnFlatSides) {
    for (const double rounding : {0.45, 0.495, 0.4995})
        for (const double dt : {1.0 / 60, 1.0 / 960}) {
            World world({.solver = SoftStep{.sleep = false}});
            std::vector<BodyId> ids;
            for (const int side : {-1, 1}) {
                Body box{.position = {0.5 * side, 0}, .velocity = {0, 1.0 * side}};
                box.shapes = {{.geometry = Box{.width = 1, .height = 1, .rounding = rounding}}};
                box.friction = 50, box.restitution = 0;
                ids.push_back(world.add(box));
            }
            world.add(Spring{.a = ids[0], .b = ids[1], .stiffness = 40});
            run(world, 2 * dt, dt);
            const Energy then = energy(world);
            const double turning = momentum_balance(world).total.angular;
            run(world, 2, dt);
            const Energy now = energy(world);
            EXPECT_NEAR(now.heat.impact, then.heat.impact, 1e-4 * then.total()) << rounding << ' ' << dt;
            EXPECT_NEAR(now.total(), then.total(), 1e-4 * then.total()) << rounding << ' ' << dt;
            EXPECT_NEAR(momentum_balance(world).total.angular, turning, 1e-3 * turning) << rounding << ' ' << dt;
        }
}

// A plank that rocks on a cylinder keeps its energy, to the second order of a substep, (ω h)² = 4e-4 of it at most. It
// lost 1.25 %.
TEST(RoundBodies, LetAPlankRock) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{.sleep = false, .statics = false}});
    Body cylinder{.kind = Kind::fixed}, plank;
    cylinder.radius = 1;
    plank.shapes = {{.geometry = Box{.width = 2, .height = 0.2}}};
    const double tilt = 0.1;
    const Vec2 up{std::sin(tilt), std::cos(tilt)}, along{std::cos(tilt), -std::sin(tilt)};
    plank.position = 1.1 * up - tilt * along, plank.angle = -tilt;
    for (Body* body : {&cylinder, &plank}) body->friction = 1, body->restitution = 0;
    world.add(cylinder), world.add(plank);
    const double before = energy(world).total(), swings = 9.81 * (1 - 0.1) * tilt * tilt / 2;
    run(world, 12.5, 1.0 / 60);
    const Energy after = energy(world);
    EXPECT_NEAR(after.total(), before, 4e-4 * swings);
    EXPECT_NEAR(after.heat.impact, 0, 0.01 * swings);  // it was 0.7 of them, and the residual as much
}

// Under forces the solver `impulse` puts apart who rest on one another at the end of a step, so that their distance is
// that of the start: their momentum about one another stays to rounding, and their energy is then right for two, and of
// second order among many.
TEST(RoundBodies, RestOnOneAnotherUnderImpulses) {
    const auto error = [](double dt) {
        World world = raft(Impulse{}, 1, 0.3);
        const double turning = momentum_balance(world).total.angular, kinetic = energy(world).kinetic;
        run(world, 5, dt);
        EXPECT_NEAR(momentum_balance(world).total.angular, turning, 1e-9 * turning) << dt;
        EXPECT_NEAR(momentum_balance(world).unaccounted().angular, 0, 1e-9) << dt;
        EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-9) << dt;
        return std::abs(energy(world).kinetic / kinetic - 1);
    };
    const double at_60 = error(1.0 / 60), at_240 = error(1.0 / 240);
    EXPECT_LT(at_60, 0.06);  // it was 0.7
    EXPECT_LT(at_240, at_60 / 8);
}

}  // namespace
}  // namespace carom
