// Worlds as they are not meant to be, or are asked for in another way: bodies inside one another, kilometres and
// millimetres, filters, a user's force, and the precise solve as the oracle of the other.

#include <algorithm>
#include <array>
#include <vector>

#include "physics/contacts.hpp"
#include "throughput.hpp"

namespace carom::test {
namespace {

/// How deep any two bodies are in one another.
double deepest(const World& world) {
    double depth = 0;
    for (std::size_t i = 0; i < world.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (const auto closest = world.closest_points(world.ids()[i], world.ids()[k]))
                depth = std::max(depth, -closest->distance);
    return depth;
}

// ---- Inside one another ---------------------------------------------------------------------------------------------

/// Four boxes and a disc of about a metre, up to 80 cm inside one another.
World inside_one_another(SoftStep solver, Vec2 gravity) {
    World world = floor_world(0.5, solver, gravity);
    for (int i = 0; i < 4; ++i) world.add(box({0.1 * i, 0.5 + 0.3 * i}, 1, 1, 0.5));
    Body wheel{.position = {0.1, 1}, .shapes = {{.geometry = Disc{{}, 0.4}}}, .restitution = 0, .friction = 0.3};
    wheel.shapes[0].rolling_resistance = 0.05;  // else nothing stops it
    world.add(wheel);
    return world;
}

// Without weight nothing but being parted moves them: half of a size in a second, and that is no velocity to speak of.
// Under their weight the upper ones fall off the heap, and all come to rest side by side, and asleep.
TEST(InsideOneAnother, BodiesArePartedAndTheLedgerCloses) {
    for (const Precise precise : {Precise::never, Precise::some, Precise::all})
        for (const double weight : {0.0, g}) {
            SCOPED_TRACE(testing::Message() << "precise " << static_cast<int>(precise) << ", g " << weight);
            World world = inside_one_another({.precise = precise}, {0, -weight});
            Throughput through(world);
            ASSERT_GT(deepest(world), 0.7);
            std::vector<Vec2> before(world.positions().begin(), world.positions().end());
            for (int step = 0; step < 600; ++step) {
                world.step(frame);
                through.add(world);
                expect_closed(world, through);
                for (std::size_t i = 0; weight == 0 && i < before.size(); ++i) {
                    EXPECT_LE(length(world.positions()[i] - before[i]), 3 * frame) << "three contacts push at most";
                    EXPECT_LE(length(world.velocities()[i]), 0.1);
                    before[i] = world.positions()[i];
                }
            }
            EXPECT_LE(deepest(world), 1e-3);
            if (weight > 0) {
                EXPECT_GT(energy(world).work.overlap, 0);
                EXPECT_TRUE(world.asleep(world.ids()[0]));
            }
        }
}

// ---- Large and small ------------------------------------------------------------------------------------------------

/// Five boxes of a size that fall by 0.3 of it on one another: how deep two neighbours overlap in a minute, in it.
double overlap_of_stack(double size, double step) {
    World world = floor_world(0.6);
    for (int i = 0; i < 5; ++i) world.add(box({0, (0.5 + i + 0.3 * (i + 1)) * size}, size, size, 0.6));
    double most = 0;
    for (int k = 0; k < 3600; ++k) {
        world.step(step);
        double under = -0.5 * size;
        for (const Vec2 place : world.positions()) {
            most = std::max(most, under + size - place.y);
            under = place.y;
            EXPECT_LE(place.y, 6 * size);
        }
    }
    EXPECT_LE(motion(world), 1e-8 * size * size);
    EXPECT_LE(std::abs(world.positions()[4].x), 0.1 * size);
    return most / size;
}

// A contact gives way by 1.3 g/ω² a load of its own weight, which follows the substep and no size: 0.1 mm at the
// default step. It is nothing to a kilometre, and much of a millimetre: that takes a step as much shorter as it falls
// faster through its own size.
TEST(Stack, OfKilometresOrMillimetresStands) {
    EXPECT_LE(overlap_of_stack(1e3, frame), 1e-5);
    EXPECT_LE(overlap_of_stack(1e-3, frame), 0.5);
    EXPECT_LE(overlap_of_stack(1e-3, frame / 32), 1e-3);
}

// ---- Filters --------------------------------------------------------------------------------------------------------

/// Whether two discs with these filters bounce off one another.
bool collide(const Filter& a, const Filter& b) {
    World world({.solver = SoftStep{}});
    for (const auto& [x, filter] : {std::pair{-1.0, a}, std::pair{1.0, b}}) {
        Body body{.position = {x, 0}, .velocity = {-x, 0}, .shapes = {{.geometry = Disc{{}, 0.3}, .filter = filter}}};
        world.add(body);
    }
    pass(world, 2);
    const bool bounced = world.velocities()[0].x < 0;
    EXPECT_EQ(world.collisions(), bounced ? 1u : 0u);
    EXPECT_NEAR(std::abs(world.velocities()[0].x), 1, 1e-12);
    return bounced;
}

TEST(Filters, DecideWhoCollides) {
    EXPECT_TRUE(collide({}, {}));
    EXPECT_TRUE(collide({.category = 2, .mask = 4}, {.category = 4, .mask = 2}));
    EXPECT_TRUE(collide({.category = 6, .mask = 1}, {.category = 1, .mask = 4}));   // one bit is enough
    EXPECT_FALSE(collide({.category = 2, .mask = 4}, {.category = 4, .mask = 1}));  // one that does not want is enough
    EXPECT_FALSE(collide({.mask = 0}, {}));
    EXPECT_FALSE(collide({.category = 0}, {}));
    EXPECT_FALSE(collide({.group = -3}, {.group = -3}));
    EXPECT_TRUE(collide({.group = -3}, {.group = -4}));
    EXPECT_TRUE(collide({.mask = 0, .group = 3}, {.mask = 0, .group = 3}));
    EXPECT_FALSE(collide({.mask = 0, .group = 3}, {.mask = 0, .group = 4}));
}

// ---- The oracle -----------------------------------------------------------------------------------------------------

// A tower that leans: where each corner presses, and how much, follows from its weights alone. Sweeps find what
// Newton's method does, to what soft contacts give way: a tenth of a millimetre under five metres.
TEST(Sweeps, FindWhatThePreciseSolveDoes) {
    const auto tower = [](Precise precise) {
        World world = floor_world(0.5, {.precise = precise, .sleep = false});
        for (int i = 0; i < 5; ++i) world.add(box({0.1 * (i % 2) + 0.05 * i, 0.5 + i}, 1, 1, 0.5));
        for (int i = 0; i < 100; ++i) world.add(disc({100.0 + 2 * i, 0.4}, 0.4));  // with whom it is no small world
        pass(world, 5);
        return world;
    };
    const World swept = tower(Precise::some), exact = tower(Precise::all);
    const std::vector<ContactPoint> a = swept.contacts(), b = exact.contacts();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].shapes, b[i].shapes);
        EXPECT_NEAR(a[i].normal_force, b[i].normal_force, 1e-3 * 5 * g);
    }
    double apart = 0;
    for (std::size_t i = 0; i < 5; ++i) apart = std::max(apart, length(swept.positions()[i] - exact.positions()[i]));
    EXPECT_LE(apart, 1e-3);
    EXPECT_GT(apart, 1e-9);  // else both are the one method
}

/// A hundred on one: sweeps are pressed in by 5 mm, and a world that may solve islands as a whole is not.
TEST(Precise, NeverIsByChoiceAlone) {
    const auto sunk = [](Precise precise) {
        World world = floor_world(0.6, {.precise = precise});
        world.add(box({0, 0.5}, 1, 1, 0.6));
        const BodyId load = world.add(box({0, 1.5}, 1, 1, 0.6, 100));
        pass(world, 5);
        return 1.5 - world.position(load).y;
    };
    EXPECT_GT(sunk(Precise::never), 1e-3);
    EXPECT_LE(std::abs(sunk(Precise::some)), 1e-12);
    EXPECT_LE(std::abs(sunk(Precise::all)), 1e-12);
}

// ---- A user's force -------------------------------------------------------------------------------------------------

/// A planet of e = 0.6 about a sun that is a user's force, GM = a = 1.
World orbit(const Integrator& integrator, const Solver& solver) {
    World world({.integrator = integrator, .solver = solver});
    world.add(Body{.position = {0.4, 0}, .velocity = {0, 2}, .radius = 0.01});
    world.add(UserForce{.name = "sun", .add = [](const Snapshot& now, std::span<Vec2> force, std::span<double>) {
                            for (std::size_t i = 0; i < force.size(); ++i) {
                                const double r = length(now.position[i]);
                                force[i] -= now.mass[i] / (r * r * r) * now.position[i];
                            }
                        }});
    return world;
}

// Where nothing touches SoftStep leaves the integrator alone: its substeps are steps, to the bit.
TEST(UserForce, MovesAPlanetUnderSoftStepAsWithoutAnySolver) {
    for (const Integrator& method : {Integrator{Verlet{}}, Integrator{Pefrl{}}, Integrator{Rk4{}}}) {
        World soft = orbit(method, SoftStep{.substeps = 4}), alone = orbit(method, NoContact{});
        for (int step = 0; step < 600; ++step) {
            soft.step(1.0 / 128);
            for (int part = 0; part < 4; ++part) alone.step(1.0 / 512);
            ASSERT_EQ(soft.positions()[0], alone.positions()[0]) << step;
            ASSERT_EQ(soft.velocities()[0], alone.velocities()[0]) << step;
        }
    }
}

}  // namespace
}  // namespace carom::test
