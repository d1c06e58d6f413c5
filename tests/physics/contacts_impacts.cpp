// Impacts: bounces that lose what restitution says, and not more; rows that pass a blow on; motion that nothing
// touches.

#include <array>

#include "physics/contacts.hpp"
#include "reference/truth.hpp"

namespace carom::test {
namespace {

// ---- Bounces --------------------------------------------------------------------------------------------------------

/// Height that a ball dropped from 5 m comes back to after each impact, over what Newton's law says.
void expect_bounces(double e, int count) {
    World world = floor_world(0);
    const BodyId ball = world.add(disc({0, 5.5}, 0.5, 0, e));
    for (int n = 0; n < count;) {
        world.step(frame);
        if (world.collisions() == static_cast<std::uint64_t>(n)) continue;
        n = static_cast<int>(world.collisions());
        const double v = world.velocity(ball).y, apex = world.position(ball).y - 0.5 + v * v / (2 * g);
        EXPECT_NEAR(apex / (5 * std::pow(e, 2 * n)), 1, 1e-9) << "after " << n << " impacts";
        ASSERT_LT(world.time(), 60);
    }
}

// A bounce is found at its instant: rounding is all that is lost, 1e-16 of 5 m over a height of a few centimetres.
TEST(Ball, BouncesToTheSquareOfItsRestitution) {
    expect_bounces(0.8, 12);
    expect_bounces(0.5, 4);
}

TEST(Ball, BouncesForAMinuteToWhereItFellFrom) {
    World world = floor_world(0);
    const BodyId ball = world.add(disc({0, 5.5}, 0.5, 0, 1));
    for (int step = 0; step < 3600; ++step) {
        world.step(frame);
        const double v = world.velocity(ball).y;
        ASSERT_NEAR((world.position(ball).y - 0.5 + v * v / (2 * g)) / 5, 1, 1e-9) << world.time();
    }
    EXPECT_EQ(world.collisions(), 30u);  // one every 2 √(2h/g)
}

TEST(Gas, OfElasticDiscsKeepsItsEnergy) {
    World world({.solver = SoftStep{}});
    world.add(Rectangle{{0, 0}, {10, 10}});
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        Body body = disc({0.5 + i % 10, 0.5 + i / 10}, 0.2, 0, 1);
        const double vx = random.uniform(-8, 8);
        body.velocity = {vx, random.uniform(-8, 8)};
        world.add(body);
    }
    const double before = motion(world);
    pass(world, 10);
    EXPECT_GT(world.collisions(), 3000u);
    EXPECT_NEAR(motion(world) / before, 1, 1e-9);
}

/// So many elastic boxes in a room of 10 m.
World boxes(int columns, double width, double height, double fastest) {
    World world({.solver = SoftStep{}});
    world.add(Rectangle{{0, 0}, {10, 10}});
    Random random(1);
    for (int i = 0; i < columns * columns; ++i) {
        const double pitch = 10.0 / columns;
        Body body{.position = {pitch * (i % columns + 0.5), pitch * (i / columns + 0.5)}, .restitution = 1};
        body.angle = random.uniform(0, 6);
        const double vx = random.uniform(-fastest, fastest);
        body.velocity = {vx, random.uniform(-fastest, fastest)};
        body.shapes = {{.geometry = Box{width, height}, .density = 1}};
        world.add(body);
    }
    return world;
}

// A box of 5 cm that is struck at 100 m/s turns by 16 rad in a substep. It lost three quarters of its energy in 4 s
// where its corners were not followed closely enough.
TEST(Gas, OfSmallFastBoxesKeepsItsEnergy) {
    World world = boxes(4, 0.05, 0.05, 120);
    const double before = motion(world);
    pass(world, 2);
    EXPECT_GT(world.collisions(), 300u);
    EXPECT_NEAR(motion(world) / before, 1, 1e-9);
}

// Of three ways to move each has a third of the energy in equilibrium (Maxwell's equipartition). From one arrangement
// to the next the mean of 15 s is off by 0.0045 (six of them), of which 0.02 is more than four times.
TEST(Gas, OfBoxesHasAThirdOfItsEnergyInItsSpin) {
    World world = boxes(10, 0.5, 0.3, 8);
    const double before = motion(world);
    pass(world, 5);
    double spin = 0, all = 0;
    for (int step = 0; step < 900; ++step) {
        world.step(frame);
        spin += energy(world).rotational, all += motion(world);
    }
    EXPECT_NEAR(spin / all, 1.0 / 3, 0.02);
    EXPECT_NEAR(motion(world) / before, 1, 1e-9);
}

// A row of discs that touch is a crowd of 127 contacts, whose bounces are not found at their instants: each is put off
// to the end of a substep, in which gravity changes its speed by g h, here by a hundredth of it: the height by two, and
// where it is then by less than one.
TEST(Crowd, BouncesToTheSquareOfItsRestitution) {
    constexpr double height = 1, e = 0.4;
    World world = floor_world(0);
    for (int i = 0; i < 64; ++i) world.add(disc({1.0 * i, 0.5 + height}, 0.5, 0, e));
    pass(world, 0.6);  // the fall takes 0.45 s, the way up 0.18 s
    for (std::size_t i = 0; i < world.size(); ++i) {
        const Vec2 x = world.positions()[i], v = world.velocities()[i];
        EXPECT_NEAR((x.y - 0.5 + v.y * v.y / (2 * g)) / (e * e * height), 1, 0.03) << i;
        EXPECT_NEAR(x.x, 1.0 * static_cast<double>(i), 1e-9);
    }
}

// ---- Rows -----------------------------------------------------------------------------------------------------------

/// Five discs that touch, of which those with a speed come from two metres away.
void expect_cradle(const std::array<double, 5>& in, const std::array<double, 5>& out) {
    World world({.solver = SoftStep{}});
    for (int i = 0; i < 5; ++i) {
        Body body = disc({i - 2 * in[static_cast<std::size_t>(i)], 0}, 0.5, 0, 1);
        body.velocity.x = in[static_cast<std::size_t>(i)];
        world.add(body);
    }
    pass(world, 4);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(world.velocities()[i].x, out[i], 1e-12) << "disc " << i;
}

TEST(Cradle, LetsOutAsManyAsCameIn) {
    expect_cradle({1, 0, 0, 0, 0}, {0, 0, 0, 0, 1});
    expect_cradle({1, 1, 0, 0, 0}, {0, 0, 0, 1, 1});
    expect_cradle({1, 1, 1, 0, 0}, {0, 0, 1, 1, 1});
    expect_cradle({1, 0, 0, 0, -1}, {-1, 0, 0, 0, 1});
}

// ---- Rods and discs -------------------------------------------------------------------------------------------------

// An elastic blow between a disc of mass m and a rod of 1 kg and 1 m, at a distance d from its middle, gives the
// impulse J = 2 u/(1/m + 1 + d²/I), and the rod J in momentum and J d in angular momentum. At its end: mech.spinrod.
void expect_blow(double m, double d) {
    World world({.solver = SoftStep{}});
    Body rod = box({0, 0}, 1, 0.02, 0);
    rod.moment_of_inertia = 1.0 / 12, rod.restitution = 1;
    const BodyId struck = world.add(rod);
    Body ball = disc({d, 0.6}, 0.1, 0, 1);
    ball.mass = m, ball.velocity = {0, -3};
    const BodyId striker = world.add(ball);
    for (int step = 0; step < 20; ++step) world.step(frame);
    const double impulse = 2 * 3 / (1 / m + 1 + 12 * d * d);
    EXPECT_NEAR(world.velocity(struck).y, -impulse, 1e-12);
    EXPECT_NEAR(world.angular_velocity(struck), -12 * d * impulse, 1e-12);
    EXPECT_NEAR(world.velocity(striker).y, -3 + impulse / m, 1e-12);
    EXPECT_NEAR(motion(world), 0.5 * m * 9, 1e-12);
}

TEST(Rod, TurnsAsItIsStruck) {
    expect_blow(1, 0);
    expect_blow(1, 0.3);
    expect_blow(0.2, -0.4);
    const auto& truth_of_rod = truth("mech.spinrod");
    EXPECT_EQ(12 * 0.5, truth_of_rod[1].get<double>());  // what d = ½ makes of an impulse of 1
}

// What comes next for a body that touches many waits until an instant is over. So a plate that flies from under forty
// discs, and is thrown after them from below, meets them all in the substep in which it is thrown: all of them leave
// it, none is in it, and what is elastic keeps energy and momentum.
TEST(Plate, MeetsAllThatItIsThrownAt) {
    World world({.solver = SoftStep{.substeps = 1}});
    const auto add = [&](Body body, double mass, double speed) {
        body.mass = mass, body.restitution = 1, body.velocity = {0, speed};
        return world.add(body);
    };
    const BodyId plate = add(box({0, 0}, 9, 0.2, 0), 100, 0);
    std::vector<BodyId> discs;
    for (int i = 0; i < 40; ++i) discs.push_back(add(disc({0.22 * i - 4.29, 0.201}, 0.1), 0.01, 1));
    add(disc({0, -0.305}, 0.2), 100, 4);
    const double before = motion(world), momentum = 100 * 4 + 40 * 0.01;
    world.step(1.0 / 240);
    double after = 0;
    for (std::size_t row = 0; row < world.size(); ++row) after += world.masses()[row] * world.velocities()[row].y;
    EXPECT_NEAR(after / momentum, 1, 1e-12);
    EXPECT_NEAR(motion(world) / before, 1, 1e-12);
    const Vec2 up{-std::sin(world.angle(plate)), std::cos(world.angle(plate))};
    for (const BodyId d : discs) {
        const Vec2 from = world.position(d) - world.position(plate);
        EXPECT_GT(dot(from, up) - 0.2, 1e-4) << world.position(d).x;
        EXPECT_GT(dot(world.velocity(d) - world.velocity(plate) - cross(world.angular_velocity(plate), from), up), 1);
    }
}

// ---- Nothing hidden -------------------------------------------------------------------------------------------------

TEST(FreeBody, KeepsItsSpeedAndItsSpinToTheLastBit) {
    World world({.solver = SoftStep{}});
    const BodyId body = world.add(box({0, 0}, 0.3, 0.2, 0.5));
    world.set_velocity(body, {1e6, 1}, 1e4);
    pass(world, 10);
    EXPECT_EQ(world.velocity(body), (Vec2{1e6, 1}));
    EXPECT_EQ(world.angular_velocity(body), 1e4);
    EXPECT_NEAR(world.position(body).x, 1e7, 1e-6);
}

/// A magnet does no work, and a charge that skips along walls keeps its speed. The force of a substep in which it
/// bounced was that of its flight through the wall: it lost a third of its energy in a minute.
TEST(Bounces, UnderAForceThatLooksAtVelocityKeepTheEnergy) {
    for (const Integrator& method : {Integrator(Verlet{}), Integrator(GaussRadau{})}) {
        World world({.integrator = method, .solver = SoftStep{}});
        world.add(Rectangle{.low = {-2, -2}, .high = {2, 2}});
        const BodyId charge = world.add(Body{.position = {0, -1}, .velocity = {3, 0}, .radius = 0.1});
        world.add(ForceField{.name = "magnet", .force = [](Vec2, Vec2 v, double, double) {
                                 return Vec2{2 * v.y, -2 * v.x};
                             }});
        run(world, 60, 1.0 / 60);
        EXPECT_NEAR(length(world.velocity(charge)), 3, 3e-3);
    }
}

// ---- Impacts with friction ------------------------------------------------------------------------------------------

/// A body of 1 kg, struck at a point from its centre, as the impulse of that grows: friction opposes the slip of each
/// moment or holds it, until the approach has ended and e times as much has been given once more (Routh, and Poisson).
struct Struck {
    Vec2 v;
    double w, heat_of_friction = 0, heat_of_impact = 0;

    void strike(Vec2 r, double inertia, double friction, double e) {
        constexpr double dp = 1e-6;
        double most = HUGE_VAL;
        for (double p = 0; p < most; p += dp) {
            const Vec2 u = v + cross(w, r);
            if (most == HUGE_VAL && u.y >= 0) most = (1 + e) * p;
            const double slips = -r.x * r.y / inertia, per_rub = 1 + r.y * r.y / inertia;
            const double holds = std::clamp(-slips / per_rub, -friction, friction);
            const double rub = std::abs(u.x) > 1e-5 ? -std::copysign(friction, u.x) : holds;
            heat_of_friction -= dp * rub * u.x, heat_of_impact -= dp * u.y;
            v += dp * Vec2{rub, 1}, w += dp * (r.x - r.y * rub) / inertia;
        }
    }
};

/// A thin box that lands on a corner. Impulses were found for the slip at their end, and where that had turned friction
/// gave energy: −1.6 J of heat in the first of these.
TEST(Impacts, WithFrictionGoAsRouthFollowsThem) {
    struct Throw {
        double angle, friction, e, vx, w;
    };
    for (const Throw& t : {Throw{0.75, 0.4, 1, 0.2, 4}, Throw{0.75, 0.4, 0, 0.2, 4}, Throw{1.2, 0.8, 0.6, -1, 8},
                           Throw{0.4, 0.2, 0.5, 1, -3}, Throw{2.2, 1.5, 0.7, 3, 1}, Throw{1.0, 0.05, 0.3, -0.1, 0}}) {
        World world({.solver = SoftStep{}});
        world.add(HalfPlane{.side = {.restitution = 1, .friction = t.friction}});
        const Vec2 start{0, 0.5 * std::sin(t.angle) + 0.05 * std::abs(std::cos(t.angle)) + 0.05}, v{t.vx, -3};
        Body thrown = box(start, 1, 0.1, t.friction);
        thrown.angle = t.angle, thrown.velocity = v, thrown.angular_velocity = t.w, thrown.restitution = t.e;
        const BodyId id = world.add(thrown);
        constexpr double dt = 1.0 / 240;
        for (int i = 0; i < 40 && world.events().impacts.empty(); ++i) world.step(dt);
        ASSERT_EQ(world.events().impacts.size(), 1);
        const auto& impact = world.events().impacts[0];
        Struck routh{v, t.w};
        routh.strike(impact.point - (start + impact.time * v), *world.body(id).moment_of_inertia, t.friction, t.e);
        // Routh's way is followed in 1e6 parts a newton second.
        EXPECT_NEAR(world.velocity(id).x, routh.v.x, 1e-4) << t.angle;
        EXPECT_NEAR(world.velocity(id).y, routh.v.y, 1e-4) << t.angle;
        EXPECT_NEAR(world.angular_velocity(id), routh.w, 1e-3) << t.angle;
        EXPECT_NEAR(energy(world).heat.friction, routh.heat_of_friction, 1e-3) << t.angle;
        EXPECT_NEAR(energy(world).heat.impact, routh.heat_of_impact, 1e-3) << t.angle;
    }
}

}  // namespace
}  // namespace carom::test
