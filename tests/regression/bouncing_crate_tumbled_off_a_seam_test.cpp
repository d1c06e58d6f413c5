// A crate that came down flat on a floor of tiles bounced off the one and then, at the same instant, off the other: it
// left the floor with 3 rad/s and ended on its side, where off a floor of one piece it bounces straight up.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(BouncingCrate, GoesStraightUpFromASeam) {
    const Geometry shapes[] = {Box{0.8, 0.8}, Capsule{{-0.3, 0}, {0.3, 0}, 0.2}, Box{1.8, 0.3}};
    const double heights[] = {0.4, 0.2, 0.15};
    for (int shape = 0; shape < 3; ++shape)
        for (const double e : {0.3, 0.5, 1.0})
            for (const double friction : {0.0, 0.3})
                for (const bool as_bodies : {true, false}) {
                    World world({.gravity = {0, -10}, .solver = SoftStep{}});
                    Body floor{.kind = Kind::fixed, .restitution = e, .friction = friction};
                    for (int i = -5; i < 5; ++i) floor.shapes.push_back({.geometry = Box{1, 1, {1.0 * i, -0.5}}});
                    if (!as_bodies) world.add(floor);
                    for (int i = 0; as_bodies && i < 10; ++i) {
                        Body tile = floor;
                        tile.shapes = {floor.shapes[static_cast<std::size_t>(i)]};
                        world.add(tile);
                    }
                    const BodyId crate = world.add(Body{.position = {0.6, heights[shape] + 1},
                                                        .shapes = {{.geometry = shapes[shape]}},
                                                        .restitution = e,
                                                        .friction = friction});
                    double highest = 0, spin = 0;
                    run(world, 2, 1.0 / 120, [&](const World& now) {
                        if (now.velocity(crate).y > 0)
                            highest = std::max(highest, now.position(crate).y - heights[shape]);
                        spin = std::max(spin, std::abs(now.angular_velocity(crate)));
                    });
                    EXPECT_LT(spin, 1e-9) << shape << ' ' << e << ' ' << friction;
                    EXPECT_NEAR(highest, e * e, 1e-3) << shape << ' ' << e << ' ' << friction;
                    EXPECT_LT(std::abs(energy(world).unaccounted()), 1e-11);
                }
}

}  // namespace
}  // namespace carom
