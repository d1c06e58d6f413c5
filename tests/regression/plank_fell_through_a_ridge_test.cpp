// Of two pieces of a chain that meet in a convex corner the first one has the normals between theirs, but nothing of
// whom it has behind it: a plank that lay on a ridge a little to the right of its top was the first one's and behind
// it, and fell through the roof. Of sticks that were shot at a jagged chain three in a hundred went through, at any
// speed.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(PlankOnARidge, StaysOnItOnBothSides) {
    for (const double slope : {0.1, 0.3, 0.6})
        for (const double right : {0.05, 0.1, 0.2, 0.3}) {
            Vec2 end[2];
            double turned[2];
            for (const int side : {-1, 1}) {
                World world({.gravity = {0, -10}, .solver = SoftStep{}});
                world.add(Body{.kind = Kind::fixed,
                               .shapes = {{.geometry = Chain{{{-10, -10 * slope}, {0, 0}, {10, -10 * slope}}}}},
                               .restitution = 0,
                               .friction = 1});
                const BodyId plank = world.add(Body{.position = {side * right, 0.3},
                                                    .shapes = {{.geometry = Box{1, 0.1}}},
                                                    .restitution = 0,
                                                    .friction = 1});
                run(world, 2, 1.0 / 60);
                end[side > 0] = world.position(plank), turned[side > 0] = world.angle(plank);
                EXPECT_GT(end[side > 0].y, -slope * std::abs(end[side > 0].x)) << side << ' ' << slope << ' ' << right;
            }
            constexpr double sweeps = 1e-2;
            EXPECT_NEAR(end[0].x, -end[1].x, sweeps) << slope << ' ' << right;
            EXPECT_NEAR(end[0].y, end[1].y, sweeps) << slope << ' ' << right;
            EXPECT_NEAR(turned[0], -turned[1], sweeps) << slope << ' ' << right;
        }
}

TEST(StickAtAJaggedChain, DoesNotPassItsTips) {
    Chain jagged;
    for (int i = 0; i <= 8; ++i) jagged.points.push_back({i % 2 == 0 ? -0.2 : 0.2, -5 + 1.25 * i});
    Random random(1);
    int through = 0;
    for (int k = 0; k < 300; ++k) {
        World world({.solver = SoftStep{}});
        world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = jagged}}, .restitution = 0});
        const double way = random.uniform(-1, 1);
        const BodyId id = world.add(Body{.position = {-2, -2 * std::tan(way) + random.uniform(-0.5, 0.5)},
                                         .angle = random.uniform(-3, 3),
                                         .velocity = {5 * std::cos(way), 5 * std::sin(way)},
                                         .angular_velocity = random.uniform(-20, 20),
                                         .shapes = {{.geometry = Box{0.5, 0.1}}},
                                         .restitution = k % 2 == 0 ? 0 : 0.3});
        Vec2 x = world.position(id);
        for (int i = 0; i < 120 && std::abs(x.y) < 4; ++i) world.step(1.0 / 60), x = world.position(id);
        through += std::abs(x.y) < 4 && x.x > 0.6;
    }
    EXPECT_EQ(through, 0);
}

}  // namespace
}  // namespace carom
