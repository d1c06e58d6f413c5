// The bounds of friction followed the normal impulses of a precise solve for ten moves, and were taken as they were
// then: a light wedge that was pulled out from under a block was held by 1.5 to 30 times what Coulomb's law lets
// friction bear.
#include <carom/random.hpp>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

struct Wedge {
    double ratio, friction, angle, excess;  ///< of the masses; and of the pull beyond what sets it in motion
};

class LightWedge : public testing::TestWithParam<Wedge> {};

/// A block that only goes up and down, on a wedge that is pulled with `excess` times what starts it:
/// W (tan(α + φ) + µ) + µ m g. Block and wedge move together by (f − 1) F / (M tan α (tan(α + φ) + µ) + m).
TEST_P(LightWedge, SlidesAsCoulombsLawHasIt) {
    const auto [ratio, friction, angle, excess] = GetParam();
    const double heavy = 10, light = heavy / ratio, rise = std::tan(angle), weight = heavy * g;
    const double along = std::tan(angle + std::atan(friction)) + friction,
                 least = weight * along + friction * light * g;
    World world = floor_world(friction);
    const BodyId wedge = world.add(Body{.mass = light,
                                        .shapes = {{.geometry = Polygon{{{-1, 0}, {1, 0}, {1, 2 * rise}}}}},
                                        .restitution = 0,
                                        .friction = friction});
    const Polygon on_it{{{-0.3, 0.7 * rise}, {0.3, 1.3 * rise}, {0.3, rise + 1}, {-0.3, rise + 1}}};
    const BodyId block =
        world.add(Body{.mass = heavy, .shapes = {{.geometry = on_it}}, .restitution = 0, .friction = friction});
    world.add(Joint{.b = block, .at = world.position(block), .type = PrismaticJoint{.axis = {0, 1}}});
    world.add(ConstantForce{.body = wedge, .force = {-excess * least, 0}});
    const double acceleration = (excess - 1) * least / (heavy * rise * along + light);
    for (int step = 0; step < 12; ++step) {
        world.step(frame);
        for (const auto& c : world.contacts())
            EXPECT_LE(std::abs(c.tangent_force), (1 + 1e-6) * friction * c.normal_force + 1e-6 * weight) << step;
    }
    // The first step begins without the forces that contacts bear, and joints hold to 1e-6 of the heaviest.
    EXPECT_NEAR(world.velocity(wedge).x, -acceleration * 12 * frame, 1e-4 * acceleration * 12 * frame);
}

INSTANTIATE_TEST_SUITE_P(Masses, LightWedge,
                         testing::Values(Wedge{8, 0.4, 0.3, 1.3}, Wedge{11, 0.4, 0.2, 1.1}, Wedge{30, 0.2, 0.2, 1.1},
                                         Wedge{30, 0.2, 0.2, 1.3}, Wedge{100, 0.2, 0.2, 1.1}));

/// A few bodies of masses up to 50 : 1 that fall into a room, of which many had such contacts while they came to rest.
TEST(Friction, OfFewBodiesThatComeToRestIsWithinCoulombsLaw) {
    for (int seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const double friction = random.uniform(0.1, 1), ratio = random.uniform(1, 50);
        World world({.gravity = {0, -g}, .solver = SoftStep{}});
        const Side side{.restitution = 0, .friction = friction};
        world.add(Rectangle{.low = {-1.5, 0}, .high = {1.5, 30}, .left = side, .right = side, .bottom = side});
        for (int i = 0; i < 2 + seed % 6; ++i) {
            Body body = box({random.uniform(-0.9, 0.9), 0.5 + 1.1 * i}, random.uniform(0.4, 1),
                            random.uniform(0.3, 0.8), friction, std::pow(ratio, random.uniform(0, 1)));
            body.angle = random.uniform(-3, 3);
            world.add(body);
        }
        for (int step = 0; step < 240; ++step) {
            world.step(frame);
            for (const auto& c : world.contacts())
                ASSERT_LE(std::abs(c.tangent_force), friction * c.normal_force * (1 + 1e-6) + 1e-6 * ratio * g)
                    << "seed " << seed << ", step " << step;
        }
    }
}

}  // namespace
}  // namespace carom::test
