// Whether a body comes to a chain from behind was told by its way out of it: who had sunk in by a hair, and left it
// slowly, pressing on nothing, met nothing when a neighbour pushed him back in. Of a closed arena of chains shaken
// bodies walked out through the front, 1 in 100 at 2 m/s and 1 in 15 at 60 m/s; through four segments nobody did.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <carom/random.hpp>
#include <cmath>
#include <vector>

namespace carom {
namespace {

constexpr double half = 2.5, r = 0.12;

Body one_of_three_kinds(Random& random) {
    const double kind = random.uniform(0, 3);
    Body body{.mass = 0.2, .restitution = 0.3, .friction = 0.4};
    if (kind < 1)
        body.radius = r;
    else if (kind < 2)
        body.shapes = {{.geometry = Box{2 * r, r}}};
    else
        body.shapes = {{.geometry = Capsule{{-r, 0}, {r, 0}, r / 3}}};
    return body;
}

/// An arena of one closed chain, with bodies that do not overlap.
World arena(int count, Random& random, std::vector<BodyId>& bodies) {
    World world({.solver = SoftStep{}});
    const Chain chain{
        {{-half, -half}, {0, -half}, {half, -half}, {half, 0}, {half, half}, {0, half}, {-half, half}, {-half, 0}},
        true};
    world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = chain}}, .restitution = 0.3, .friction = 0.4});
    while (static_cast<int>(bodies.size()) < count) {
        Body body = one_of_three_kinds(random);
        body.position = {random.uniform(0.2 - half, half - 0.2), random.uniform(0.2 - half, half - 0.2)};
        body.angle = random.uniform(-3, 3);
        if (world.shapes_touching(Disc{{0, 0}, 1.4 * r}, {body.position, 0}).empty()) bodies.push_back(world.add(body));
    }
    return world;
}

TEST(ChainFromTheFront, KeepsInWhomItsNeighboursPushBackIntoIt) {
    constexpr double kick = 20, dt = 1.0 / 60;
    constexpr int rounds = 10, steps = 30;
    for (std::uint64_t seed = 9; seed <= 13; ++seed) {
        Random random(seed);
        std::vector<BodyId> bodies;
        World world = arena(60, random, bodies);
        for (int round = 0; round < rounds; ++round) {
            const Vec2 centre{random.uniform(-2, 2), random.uniform(-2, 2)};
            for (const BodyId id : bodies) {
                const Vec2 away = world.position(id) - centre;
                const double distance = length(away), blow = 0.2 * kick * std::exp(-distance);
                world.apply_impulse(
                    id, away * (blow / std::max(distance, 0.05)),
                    world.position(id) + Vec2{random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03)});
            }
            run(world, steps * dt, dt);
        }
        for (const BodyId id : bodies) {
            EXPECT_LT(std::abs(world.position(id).x), half) << seed;
            EXPECT_LT(std::abs(world.position(id).y), half) << seed;
        }
    }
}

}  // namespace
}  // namespace carom
