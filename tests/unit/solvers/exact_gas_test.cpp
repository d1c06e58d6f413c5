// The solver 'events' against itself: whatever the queue, the lanes, the steps, the same gas.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "error_of.hpp"
#include "restored.hpp"
#include "simd/isa.hpp"
#include "solvers/events/advance.hpp"

using namespace carom;
using carom::test::error_of;

namespace {

/// Discs on a square lattice with random velocities.
std::vector<Body> discs(int side, double pitch, double radius, const Body& like = {}, double spread = 0) {
    Random random(5);
    std::vector<Body> all;
    for (int k = 0; k < side * side; ++k) {
        Body b = like;
        b.position = {(k % side + 0.5) * pitch, (k / side + 0.5) * pitch};
        b.radius = radius * (1 - spread * random.uniform());
        b.mass = 1 + spread * random.uniform();
        b.velocity = {random.normal(), random.normal()};
        all.push_back(b);
    }
    return all;
}

/// The parts of a world, for a queue of one's own.
template <class Queue>
struct Bench {
    Events options;
    Bodies bodies;
    State state;
    Walls walls;
    std::vector<Piece> pieces;
    GasOf<Queue> gas;
    Vec2 gravity{};
    int threads = 1;

    Bench(const std::vector<Body>& all, const Walls& room, Vec2 g) : walls(room), gravity(g) {
        for (const Body& b : all) bodies.add(b, state);
        renew_pieces(bodies, 0, pieces);
    }
    void step(double h) { advance(GasScene{options, walls, bodies, pieces, gravity, threads}, state, h, gas); }
};

Walls room(double side) { return {std::vector{Rectangle{.low = {0, 0}, .high = {side, side}}}, {}, {}, {}}; }
Walls box(double side) { return {{}, {}, {}, Periodic{{0, 0}, {side, side}}}; }

/// Expects equal bits of two gases after each of some steps.
void expect_same(const std::vector<Body>& all, const Walls& walls, Vec2 gravity, double h, int steps) {
    Bench<Calendar> a(all, walls, gravity);
    Bench<SortedQueue> b(all, walls, gravity);
    for (int k = 0; k < steps; ++k) {
        a.step(h), b.step(h);
        ASSERT_EQ(a.gas.data.tally.disc_collisions, b.gas.data.tally.disc_collisions) << k;
        ASSERT_EQ(a.state.x.linear, b.state.x.linear) << k;
        ASSERT_EQ(a.state.v.linear, b.state.v.linear) << k;
        ASSERT_EQ(a.state.v.angular, b.state.v.angular) << k;
    }
    EXPECT_GT(a.gas.data.tally.disc_collisions, 1000u);
}

/// Expects equal bits of a gas in blocks, with one thread and with two, and of one queue.
void expect_same_in_blocks(const std::vector<Body>& all, const Walls& walls, Vec2 gravity, double h) {
    Bench<Calendar> one(all, walls, gravity), two(all, walls, gravity);
    Bench<SortedQueue> queue(all, walls, gravity);
    two.threads = 2;
    one.gas.blocks.fewest_discs = two.gas.blocks.fewest_discs = 80000;  // which shows it as well as more do
    for (int k = 0; k < 3; ++k) {
        one.step(h), two.step(h), queue.step(h);
        ASSERT_EQ(one.state.x.linear, queue.state.x.linear) << k;
        ASSERT_EQ(one.state.v.linear, queue.state.v.linear) << k;
        ASSERT_EQ(one.state.v.angular, queue.state.v.angular) << k;
        ASSERT_EQ(two.state.x.linear, queue.state.x.linear) << k;
        ASSERT_EQ(two.gas.data.tally.virial, one.gas.data.tally.virial) << k;
        if (k > 0) continue;
        EXPECT_GE(one.gas.data.stride, one.gas.data.first_stride) << "all blocks agreed";
        // Now they try more than they can know.
        h *= 4;
        one.gas.data.stride = two.gas.data.stride = 10 * h;
    }
    EXPECT_LT(one.gas.data.stride, h) << "and took it back";
    const GasTally &a = one.gas.data.tally, &b = queue.gas.data.tally;
    EXPECT_GT(a.disc_collisions, all.size() / 2);
    EXPECT_EQ(a.disc_collisions, b.disc_collisions);
    EXPECT_EQ(a.wall_collisions, b.wall_collisions);
    EXPECT_NEAR(a.virial / b.virial, 1, 1e-13);  // sums in another order
    // Some 1e5 numbers added up, rounded each time to 1e-16 of the sum.
    for (std::size_t k = 0; k < one.state.account.power.size(); ++k)
        EXPECT_NEAR(one.state.account.power[k], queue.state.account.power[k],
                    1e-11 * (1 + std::abs(queue.state.account.power[k])))
            << k;
}

World gas(const std::vector<Body>& all, const Settings& settings = {.solver = Events{}}) {
    World world(settings);
    for (const Body& b : all) world.add(b);
    return world;
}

double deepest_overlap(const World& world) {
    double worst = 0;
    for (std::size_t i = 0; i < world.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            Vec2 d = world.positions()[i] - world.positions()[j];
            if (world.periodic()) {
                const Vec2 size = world.periodic()->high - world.periodic()->low;
                d -= {size.x * std::round(d.x / size.x), size.y * std::round(d.y / size.y)};
            }
            const double reach = world.radii()[i] + world.radii()[j];
            worst = std::max(worst, (reach - length(d)) / world.radii()[i]);
        }
    return worst;
}

void turn_back(World& world) {
    for (const BodyId id : world.ids()) world.set_velocity(id, -world.velocity(id), -world.angular_velocity(id));
}

}  // namespace

TEST(ExactGas, DoesNotDependOnTheQueue) {
    expect_same(discs(20, 1.2, 0.5), box(24), {}, 0.5, 12);
    expect_same(discs(20, 1.2, 0.55, {}, 0.6), room(24), {}, 0.5, 12);
    expect_same(discs(12, 1.5, 0.5, {.restitution = 0.95, .friction = 0.3}, 0.3), room(20), {0.2, -1}, 0.1, 60);
    expect_same(discs(20, 1.2, 0.5), Walls{}, {0, -3}, 0.5, 12);
    // Nothing is at random here: very many events are at the same instant.
    std::vector<Body> lattice = discs(16, 1.125, 0.5);
    for (std::size_t k = 0; k < lattice.size(); ++k) lattice[k].velocity = {k % 2 ? 1.0 : -1.0, k % 3 ? 0.5 : -1.0};
    expect_same(lattice, box(18), {}, 0.5, 12);
    // So many that their memory is asked for ahead, for which days begin before those before them are over.
    expect_same(discs(165, 1.2, 0.5), box(198), {}, 0.125, 4);
}

TEST(ExactGas, CalendarThatLooksAheadKeepsTheOrder) {
    constexpr Slot count = 300;
    Random random(3);
    std::vector<GasEvent> a;
    for (std::uint32_t row = 0; row < count; ++row) a.push_back({.due = random.uniform(), .row = row});
    std::vector<GasEvent> b = a;
    Calendar calendar;
    SortedQueue sorted;
    calendar.fill(a, 0), sorted.fill(b, 0);
    calendar.look_ahead(10);
    const auto change = [&](Slot slot, double due) { calendar.change(a, slot, due), sorted.change(b, slot, due); };
    for (int k = 0; k < 100000; ++k) {
        calendar.scout([&](Slot slot) { EXPECT_LT(slot, count); });
        const Slot next = calendar.next(a);
        ASSERT_EQ(next, sorted.next(b)) << k;
        const double now = a[next].due;
        change(next, now + random.uniform() * (k % 5 == 0 ? 1e-3 : 1));
        const auto other = static_cast<Slot>(count * random.uniform());
        if (other != next) change(other, now + 0.7 * random.uniform());
    }
}

TEST(ExactGas, DoesNotDependOnBlocksNorThreads) {
    expect_same_in_blocks(discs(285, 1.25, 0.5), box(356.25), {}, 0.25);
    expect_same_in_blocks(discs(285, 1.25, 0.55, {.restitution = 0.95, .friction = 0.3}, 0.4), room(356.25), {0.2, -1},
                          0.25);
    expect_same_in_blocks(discs(285, 1.25, 0.5), Walls{}, {0, -3}, 0.25);
}

TEST(ExactGas, DoesNotDependOnTheLanes) {
    for (const Vec2 gravity : {Vec2{}, Vec2{0, -1}}) {
        std::optional<std::uint64_t> first;
        for (const Isa isa : available_isas()) {
            use_isa(isa);
            World world = gas(discs(20, 1.3, 0.5, {}, 0.3), {.gravity = gravity, .solver = Events{}});
            world.add(Rectangle{.low = {0, 0}, .high = {26, 26}});
            run(world, 20, 1);
            EXPECT_GT(world.collisions(), 5000u);
            if (!first) first = state_hash(world);
            EXPECT_EQ(state_hash(world), *first);
        }
        use_isa({});
    }
}

TEST(ExactGas, DoesNotDependOnTheStep) {
    World once = gas(discs(10, 1.3, 0.5));
    once.add(Periodic{{0, 0}, {13, 13}});
    World often = once;
    once.step(16);
    for (int k = 0; k < 1024; ++k) often.step(1.0 / 64);
    EXPECT_GT(once.collisions(), 1000u);
    EXPECT_EQ(once.collisions(), often.collisions());
    for (std::size_t i = 0; i < once.size(); ++i) {
        EXPECT_EQ(once.velocities()[i], often.velocities()[i]);  // to the last bit
        EXPECT_EQ(once.positions()[i], often.positions()[i]);
    }
}

TEST(ExactGas, GoesOnWithTheSameBits) {
    World world =
        gas(discs(12, 1.4, 0.5, {.restitution = 0.9, .friction = 0.2}, 0.3), {.gravity = {0, -1}, .solver = Events{}});
    world.add(Rectangle{.low = {0, 0}, .high = {18, 18}, .left = {.temperature = 2}});
    const World start = world;
    run(world, 3, 0.1);
    World copy = world;
    const std::string bytes = test::saved(world);
    run(world, 3, 0.1);
    run(copy, 3, 0.1);
    EXPECT_EQ(state_hash(copy), state_hash(world));
    World restored = start;
    Loader from(bytes);
    restored.restore(from);
    EXPECT_TRUE(from.at_end());
    run(restored, 3, 0.1);
    EXPECT_EQ(state_hash(restored), state_hash(world));
    EXPECT_EQ(restored.collisions(), world.collisions());
    EXPECT_EQ(energy(restored).heat.bath, energy(world).heat.bath);
    EXPECT_NE(energy(world).heat.bath, 0);
}

TEST(ExactGas, NeverOverlaps) {
    // 1e-12 of a radius: places are rounded to 1e-16 of the room, and so is the time of a collision.
    World dense = gas(discs(12, 1.06, 0.5));  // a fraction of 0.70
    dense.add(Periodic{{0, 0}, {12 * 1.06, 12 * 1.06}});
    World mixed = gas(discs(12, 1.06, 0.5, {}, 0.5));
    mixed.add(Rectangle{.low = {0, 0}, .high = {12 * 1.06, 12 * 1.06}});
    for (World* world : {&dense, &mixed}) {
        for (int k = 0; k < 400; ++k) {
            world->step(0.0137);
            ASSERT_LT(deepest_overlap(*world), 1e-12) << k;
        }
        EXPECT_GT(world->collisions(), 2000u);
    }
}

TEST(ExactGas, KeepsEnergyAndMomentum) {
    World world = gas(discs(20, 1.3, 0.5, {}, 0.5));
    world.add(Periodic{{0, 0}, {26, 26}});
    const Vec2 before = momentum(world);
    const double kinetic = energy(world).kinetic;
    run(world, 400, 100);
    EXPECT_GT(world.collisions(), 200000u);
    // Each collision rounds twice, at random: a drift of 1e-16 of a disc's energy each would be 1e-13 of all.
    EXPECT_NEAR(energy(world).kinetic / kinetic, 1, 2e-14);
    EXPECT_NEAR(length(momentum(world) - before), 0, 1e-12);
}

TEST(ExactGas, AccountsForAllOfIt) {
    for (const double restitution : {1.0, 0.9}) {
        for (const double friction : {0.0, 0.4}) {
            World world = gas(discs(8, 1.5, 0.5, {.restitution = restitution, .friction = friction}, 0.4),
                              {.gravity = {0.3, -1}, .solver = Events{}});
            world.add(Rectangle{.low = {-2, -1}, .high = {12, 14}, .right = {0.8, 0.5}, .top = {.temperature = 3}});
            world.add(Body{.kind = Kind::fixed, .position = {-1, 12}, .radius = 0.7, .friction = friction});
            world.add(Body{
                .kind = Kind::fixed, .position = {6, 12.8}, .shapes = {{.geometry = Segment{{-2, 0.3}, {2, -0.3}}}}});
            world.add(Body{.kind = Kind::driven, .position = {-1.5, 0}, .velocity = {0.1, 0}, .radius = 0.3});
            run(world, 5, 0.05);
            EXPECT_GT(world.collisions(), 200u);
            const Energy e = energy(world);
            const MomentumBalance m = momentum_balance(world);
            EXPECT_NEAR(e.unaccounted(), 0, 1e-11) << restitution << " " << friction;  // of some hundred J that flowed
            EXPECT_NEAR(e.residual, 0, 1e-11);
            EXPECT_NEAR(m.unaccounted().linear.x, 0, 1e-11);
            EXPECT_NEAR(m.unaccounted().linear.y, 0, 1e-11);
            EXPECT_NEAR(m.unaccounted().angular, 0, 1e-9);
            EXPECT_GT(std::abs(e.heat.bath), 0.1);
            EXPECT_GE(e.heat.friction, friction > 0 ? 0.1 : 0.0);
        }
    }
}

TEST(ExactGas, FindsItsWayBack) {
    // An error grows by a factor of about 2 free path / radius a collision, here 30. After 100 collisions there and as
    // many back each of the 100 discs had two each way, some of them twice as many: 1e-15 becomes at most 1e-9.
    World dilute = gas(discs(10, 4, 0.5));
    dilute.add(Rectangle{.low = {0, 0}, .high = {40, 40}});
    const World start = dilute;
    while (dilute.collisions() < 100) dilute.step(0.125);
    const double there = dilute.time();
    const auto hits = dilute.collisions();
    turn_back(dilute);
    run(dilute, there, 0.125);
    EXPECT_NEAR(static_cast<double>(dilute.collisions()), 2.0 * static_cast<double>(hits), 0);
    for (std::size_t i = 0; i < start.size(); ++i)
        EXPECT_LT(length(dilute.positions()[i] - start.positions()[i]), 1e-9);
}

TEST(ExactGas, AgreesWithTheTimesOfImpactOfTheTextbooksSolver) {
    for (const Vec2 gravity : {Vec2{}, Vec2{0.5, -2}}) {
        const auto all = discs(5, 2, 0.6, {.angular_velocity = 2, .restitution = 0.9, .friction = 0.5}, 0.3);
        World exact = gas(all, {.gravity = gravity, .solver = Events{}}), other = gas(all, {.gravity = gravity});
        for (World* world : {&exact, &other}) {
            world->add(Rectangle{.low = {0, 0}, .high = {10, 10}, .bottom = {0.95, 0.2}});
            world->add(Body{.kind = Kind::fixed, .position = {4, 4}, .radius = 0.35, .friction = 1});
            run(*world, 1.2, 0.1);
        }
        EXPECT_GT(exact.collisions(), 20u);
        EXPECT_EQ(exact.collisions(), other.collisions());
        for (std::size_t i = 0; i < exact.size(); ++i) {
            EXPECT_NEAR(length(exact.positions()[i] - other.positions()[i]), 0, 1e-9);
            EXPECT_NEAR(exact.angles()[i], other.angles()[i], 1e-9);
            EXPECT_NEAR(exact.angular_velocities()[i], other.angular_velocities()[i], 1e-9);
        }
    }
}

TEST(ExactGas, BouncesOffTheSidesAndEndsOfSegments) {
    World world({.solver = Events{}});
    world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Segment{{-1, 0}, {1, 0}}}}});
    const BodyId above = world.add(Body{.position = {0, 3}, .velocity = {0, -1}, .radius = 0.5});
    const BodyId end = world.add(Body{.position = {5, 0}, .velocity = {-1, 0}, .radius = 0.5});
    const BodyId point = world.add(Body{.position = {-0.5, -2}, .velocity = {0, 1}});
    // The centre passes the end at half a radius: it is thrown back by twice the angle whose sine is a half.
    const BodyId edge = world.add(Body{.position = {1.25, -5}, .velocity = {0, 1}, .radius = 0.5});
    world.step(6);
    EXPECT_EQ(world.velocity(above), (Vec2{0, 1}));
    EXPECT_NEAR(world.position(above).y, 0.5 + 3.5, 1e-14);
    EXPECT_EQ(world.velocity(end), (Vec2{1, 0}));
    EXPECT_EQ(world.velocity(point), (Vec2{0, -1}));
    EXPECT_NEAR(world.position(point).y, -4, 1e-14);
    EXPECT_NEAR(world.velocity(edge).x, std::sqrt(0.75), 1e-15);
    EXPECT_NEAR(world.velocity(edge).y, -0.5, 1e-15);
}

TEST(ExactGas, ComesToAnEndWhereInelasticDiscsCollapse) {
    // A ball that bounces down to rest, and a heap: infinitely many impacts in a finite time.
    World world({.gravity = {0, -10}, .solver = Events{}});
    world.add(HalfPlane{.side = {.restitution = 0.5}});
    for (int k = 0; k < 3; ++k) world.add(Body{.position = {3.0 * k, 1.0 + k}, .radius = 0.5, .restitution = 0.5});
    run(world, 3, 0.1);
    EXPECT_GT(world.gas().made_elastic, 0u);
    for (std::size_t i = 0; i < world.size(); ++i) EXPECT_NEAR(world.positions()[i].y, 0.5, 1e-6);
    EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-9);
}

TEST(ExactGas, TremblesWhereItRests) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
        World world({.gravity = {0, -10}, .solver = Events{}});
        world.add(HalfPlane{.side = {.restitution = restitution}});
        const BodyId lies = world.add(Body{.position = {0, 0.5}, .radius = 0.5});
        const BodyId falls = world.add(Body{.position = {3, 0.6}, .radius = 0.5, .restitution = 0});
        const BodyId on_it = world.add(Body{.position = {0, 1.5}, .radius = 0.5, .restitution = 0});
        run(world, 0.5, 0.05);
        EXPECT_NEAR(world.position(lies).y, 0.5, 1e-4 * 0.5);
        EXPECT_NEAR(world.position(falls).y, 0.5, 1e-4 * 0.5);
        EXPECT_NEAR(world.position(on_it).y, 1.5, 1e-4);
        EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-11);
        EXPECT_NEAR(momentum_balance(world).unaccounted().linear.y, 0, 1e-11);
    }
}

TEST(ExactGas, SaysThatItIsJammed) {
    World world = gas(discs(16, 1, 0.5));  // all of them touch
    world.add(Rectangle{.low = {0, 0}, .high = {16, 16}});
    EXPECT_NE(error_of([&] { world.step(1); }).find("jammed"), std::string::npos);
}

TEST(ExactGas, LosesMoreTheHarderItStrikesIfRestitutionDependsOnSpeed) {
    World world({.solver = Events{.restitution_speed = 2}});
    world.add(HalfPlane{.normal = {1, 0}});
    const BodyId ball = world.add(Body{.position = {1, 0}, .velocity = {-64, 0}, .restitution = 0.9});
    world.step(1);
    EXPECT_NEAR(world.velocity(ball).x, 64 * (1 - 0.1 * 2), 1e-12);  // 32 times the speed: twice the loss
}

TEST(ExactGas, MovesApartWhatOverlapsIfAsked) {
    // At random in the room, in a box, and beyond the walls, on one another, on a fixed disc and under gravity.
    for (const bool periodic : {false, true})
        for (const double filled : {0.3, 0.7, 0.8}) {
            World world({.gravity = {0, periodic ? 0.0 : -1.0}, .solver = Events{.relax = true}});
            Random random(5);
            const int n = 300;
            const double side = std::sqrt(n * 0.25 * M_PI * 0.83 / filled);  // radii from 0.4 to 0.5
            if (periodic) world.add(Periodic{{0, 0}, {side, side}});
            if (!periodic) world.add(Rectangle{.low = {0, 0}, .high = {side, side}});
            world.add(Body{.kind = Kind::fixed, .position = {2, 2}, .radius = 0.3});
            for (int k = 0; k < n; ++k)
                world.add(Body{.position = {random.uniform(-0.1, 1.1) * side, random.uniform(0, 1.1) * side},
                               .velocity = {random.normal(), random.normal()},
                               .radius = random.uniform(0.4, 0.5)});
            const BodyId twin = world.add(world.body(world.ids()[7]));  // the same place
            world.set_velocity(twin, {0, 1}, 0);
            world.check();
            const World start = world;
            const double before = energy(world).total();
            world.step(1e-9);
            EXPECT_EQ(deepest_overlap(world), 0) << filled;
            double farthest = 0;
            for (std::size_t i = 0; i < world.size(); ++i)
                farthest = std::max(farthest, length(world.positions()[i] - start.positions()[i]));
            EXPECT_NEAR(world.gas().moved_apart, farthest, 1e-7);
            EXPECT_GT(farthest, 0.4);
            EXPECT_LT(farthest, 10);
            run(world, 2, 0.25);
            EXPECT_GT(world.gas().disc_collisions, 300u);
            EXPECT_LT(deepest_overlap(world), 1e-12);
            EXPECT_EQ(energy(world).initial_total, before);
            EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-10);
            EXPECT_EQ(energy(world).work.overlap != 0, !periodic);
            EXPECT_NEAR(length(momentum_balance(world).unaccounted().linear), 0, 1e-10);
            EXPECT_NEAR(momentum_balance(world).unaccounted().angular, 0, 1e-8);
        }
}

TEST(ExactGas, MovesApartWhatOverlapsInARow) {
    // Columns of 22 discs in 21.4 diameters: along their line there is no room, and beside it there is.
    World world({.solver = Events{.relax = true}});
    world.add(Periodic{{0, 0}, {22.4, 21.4}});
    for (int k = 0; k < 440; ++k)
        world.add(Body{
            .position = {1.12 * (k % 20), 21.4 / 22 * (k / 20)}, .velocity = {k % 2 ? 1.0 : -1.0, 0}, .radius = 0.5});
    world.step(1e-9);
    EXPECT_EQ(deepest_overlap(world), 0);
    EXPECT_LT(world.gas().moved_apart, 1);
}

TEST(ExactGas, LeavesWhatDoesNotOverlapWhereItIs) {
    World relaxed = gas(discs(8, 1, 0.5), {.solver = Events{.relax = true}});  // some touch
    World other = gas(discs(8, 1, 0.5));
    for (World* world : {&relaxed, &other}) {
        world->add(Rectangle{.low = {0, 0}, .high = {9, 9}});
        run(*world, 1, 0.25);
    }
    EXPECT_EQ(relaxed.gas().moved_apart, 0);
    EXPECT_EQ(state_hash(relaxed), state_hash(other));
}

TEST(ExactGas, SaysThatDiscsAreTooMany) {
    const auto refusal = [](double filled, double smallest, bool relax) {
        World world({.solver = Events{.relax = relax}});
        const double side = std::sqrt(50 * M_PI * (0.25 + smallest * smallest) / filled);
        world.add(Periodic{{0, 0}, {side, side}});
        Random random(5);
        for (int k = 0; k < 100; ++k)
            world.add(Body{.position = {random.uniform(0, side), random.uniform(0, side)},
                           .velocity = {1, 0},
                           .radius = k % 2 ? smallest : 0.5});
        return error_of([&] { world.step(1); });
    };
    const auto has = [](const std::string& text, const char* words) {
        EXPECT_NE(text.find(words), std::string::npos) << text;
    };
    const double closest = 0.9068996821171089;  // gas.closepacking
    for (const bool relax : {false, true}) {
        has(refusal(1.001 * closest, 0.5, relax), "they fill 0.9078 of the room, and no packing of equal discs");
        // Florian's bound for a ratio of 0.2 is 0.9448.
        has(refusal(0.944, 0.1, relax), relax ? "could not relax" : "must not overlap");
        has(refusal(0.945, 0.1, relax), "no packing of discs of these radii fills more than 0.9448");
    }
    has(refusal(0.88, 0.5, false), "let the solver's option 'relax' do that");
    has(refusal(0.88, 0.5, true), "after 5000 rounds of moving them apart the deepest overlap is still");
    has(refusal(0.88, 0.5, true), "they fill 0.88 of the room");
}

TEST(ExactGas, SaysWhatItCannotDo) {
    const auto refusal = [](const auto& spoil) {
        World world({.solver = Events{}});
        const BodyId a = world.add(Body{.position = {0, 0}, .velocity = {1, 0}, .radius = 0.5, .name = "a"});
        const BodyId b = world.add(Body{.position = {3, 0}, .radius = 0.5, .name = "b"});
        spoil(world, a, b);
        const std::string at_once = error_of([&] { world.check(); });
        EXPECT_EQ(at_once, error_of([&] { world.step(1); }));
        return at_once;
    };
    const auto expect = [&](const char* words, const auto& spoil) {
        EXPECT_NE(refusal(spoil).find(words), std::string::npos) << refusal(spoil);
    };
    EXPECT_EQ(refusal([](World&, BodyId, BodyId) {}), "no error");
    expect("no disc here is free", [](World& w, BodyId a, BodyId b) { w.add(Spring{.a = a, .b = b}); });
    expect("drag", [](World& w, BodyId, BodyId) { w.add(Drag{.linear = 1}); });
    expect("'a' and 'b' by 0.6 m", [](World& w, BodyId, BodyId b) { w.set_position(b, {0.4, 0}, 0); });
    expect("'b' is outside the room by", [](World& w, BodyId, BodyId) { w.add(Rectangle{{-1, -1}, {2, 1}}); });
    expect("chain", [](World& w, BodyId, BodyId) {
        w.add(Body{.kind = Kind::fixed, .position = {9, 9}, .shapes = {{.geometry = Chain{{{0, 0}, {1, 0}}}}}});
    });
    expect("'a' moves at (1e+200, 0) m/s", [](World& w, BodyId a, BodyId) { w.set_velocity(a, {1e200, 0}, 0); });
    expect("at rest", [](World& w, BodyId a, BodyId) { w.set_velocity(a, {}, 0); });
    expect("wider than the widest disc", [](World& w, BodyId, BodyId b) {
        w.remove(b);
        w.add(Periodic{{0, 0}, {0.9, 5}});
    });
    World thermal;
    thermal.add(HalfPlane{.side = {.temperature = 1}});
    thermal.add(Body{.position = {0, 1}});
    EXPECT_NE(error_of([&] { thermal.step(1); }).find("thermal"), std::string::npos);
}
