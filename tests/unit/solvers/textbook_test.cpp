// The textbook's collisions, which find their pairs by a grid, against two nested loops: bit for bit.
#include <gtest/gtest.h>

#include <carom/random.hpp>

#include "math/bits.hpp"
#include "solvers/impulse.hpp"

using namespace carom;

namespace {

struct Discs {
    Bodies bodies;
    State state;
    Walls walls;
};

/// Discs of mixed radii, some of them fixed, so dense that most overlap: in a room or a periodic box.
Discs random_gas(std::uint64_t seed, bool periodic) {
    Random random(seed);
    const auto n = static_cast<int>(random.uniform(2, 40));
    const double side = random.uniform(1, 6), most = random.uniform(0.05, 1);
    Discs gas;
    for (int i = 0; i < n; ++i) {
        Body disc{.kind = random.uniform() < 0.1 ? Kind::fixed : Kind::dynamic};
        disc.position.x = random.uniform(0, side);
        disc.position.y = random.uniform(0, side);
        if (disc.kind == Kind::dynamic) disc.velocity = {random.normal(), random.normal()};
        disc.mass = random.uniform(0.5, 2);
        disc.radius = most * (random.uniform() < 0.2 ? 1 : random.uniform(0.02, 0.3));
        disc.restitution = random.uniform() < 0.5 ? 1 : random.uniform();
        disc.friction = random.uniform() < 0.5 ? 0 : random.uniform();
        gas.bodies.add(disc, gas.state);
    }
    const Rectangle room{{0, 0}, {side, side}};
    if (periodic)
        gas.walls = Walls({}, {}, {}, Periodic{room.low, room.high});
    else
        gas.walls = Walls({&room, 1}, {}, {}, {});
    return gas;
}

/// What the notebook does, written down once more: walls for each disc, then all pairs in index order.
void brute_force(Discs& gas, Vec2 gravity, Contacts& contacts) {
    const Bodies& b = gas.bodies;
    auto& x = gas.state.x.linear;
    const auto push = [&](std::size_t i, Vec2 by) { shift(i, by, b, gravity, gas.state); };
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (b.kind[i] == Kind::fixed) continue;
        for (const Wall& wall : gas.walls.all) {
            const double depth = wall.offset + b.radius[i] - dot(wall.normal, x[i]);
            if (depth <= 0) continue;
            push(i, depth * wall.normal);
            if (dot(gas.state.v.linear[i], wall.normal) < 0)
                contacts.collisions += collide(i,
                                               {-wall.normal, mixed_restitution(b, wall.restitution, b.restitution[i]),
                                                mixed_friction(b, wall.friction, b.friction[i])},
                                               b, gas.state);
        }
    }
    for (std::size_t i = 0; i < b.size(); ++i)
        for (std::size_t j = i + 1; j < b.size(); ++j) {
            if (b.kind[i] == Kind::fixed && b.kind[j] == Kind::fixed) continue;
            const Vec2 d = nearest_image(gas.walls.periodic, x[j] - x[i]);
            const double distance = length(d), overlap = b.radius[i] + b.radius[j] - distance;
            if (overlap <= 0) continue;
            const Vec2 n = distance > 0 ? d / distance : Vec2{1, 0};
            const double share = b.kind[i] == Kind::fixed || b.kind[j] == Kind::fixed ? 1 : 0.5;
            if (b.kind[i] == Kind::dynamic) push(i, -share * overlap * n);
            if (b.kind[j] == Kind::dynamic) push(j, share * overlap * n);
            contacts.collisions += collide(i, j,
                                           {n, mixed_restitution(b, b.restitution[i], b.restitution[j]),
                                            mixed_friction(b, b.friction[i], b.friction[j])},
                                           b, gas.state);
        }
}

bool same_bits(Vec2 a, Vec2 b) { return to_bits(a.x) == to_bits(b.x) && to_bits(a.y) == to_bits(b.y); }

}  // namespace

TEST(Textbook, CollidesAsTwoNestedLoopsDo) {
    std::uint64_t collisions = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Discs gas = random_gas(seed, seed % 3 == 0), reference = gas;
        Contacts contacts, expected;
        for (int pass = 0; pass < 3; ++pass) {
            collide_overlapping(Impulse{}, gas.walls, gas.bodies, {0, -1}, gas.state, contacts);
            brute_force(reference, {0, -1}, expected);
        }
        for (std::size_t i = 0; i < gas.bodies.size(); ++i) {
            ASSERT_TRUE(same_bits(gas.state.x.linear[i], reference.state.x.linear[i])) << "seed " << seed;
            ASSERT_TRUE(same_bits(gas.state.v.linear[i], reference.state.v.linear[i])) << "seed " << seed;
            ASSERT_EQ(gas.state.v.angular[i], reference.state.v.angular[i]) << "seed " << seed;
        }
        ASSERT_EQ(contacts.collisions, expected.collisions);
        for (const Account account : {Account::impact, Account::overlap})
            ASSERT_EQ(gas.state.account[account], reference.state.account[account]);
        collisions += contacts.collisions;
    }
    EXPECT_GT(collisions, 30000u);
}
