// An arch is put down without forces between its stones, and a precise solve takes several steps to find them all.
// After the third of these, as of any pile of equals, it was left to sweeps, and gave way by 26 mm.
#include "physics/contacts.hpp"

namespace carom::test {
namespace {

/// The right half of "Arch" in Box2D's samples, from the foot to the keystone.
constexpr Vec2 inner[] = {{4, 0},
                          {3.73451, 1.28340},
                          {3.44968, 2.56232},
                          {3.14063, 3.83527},
                          {2.80010, 5.09964},
                          {2.41630, 6.35092},
                          {1.96795, 7.57948},
                          {1.40880, 8.75955},
                          {0.60148, 9.77389}};
constexpr Vec2 outer[] = {{6, 0},
                          {5.58405, 1.50575},
                          {5.13734, 3.00241},
                          {4.65215, 4.48676},
                          {4.11692, 5.95342},
                          {3.51331, 7.39270},
                          {2.80888, 8.78444},
                          {1.93814, 10.07613},
                          {0.75423, 11.07223}};

TEST(Arch, OfSeventeenStonesUnderFourSlabsStandsWhereItWasBuilt) {
    World world = floor_world(0.6, {}, {0, -10});
    const auto add = [&](Vec2 at, const Geometry& geometry) {
        return world.add(
            Body{.position = at, .shapes = {{.geometry = geometry, .density = 1}}, .restitution = 0, .friction = 0.6});
    };
    const auto mirrored = [](Vec2 p) { return Vec2{-p.x, p.y}; };
    for (int i = 0; i < 8; ++i) {
        add({}, Hull{{inner[i], outer[i], outer[i + 1], inner[i + 1]}});
        add({}, Hull{{mirrored(inner[i]), mirrored(outer[i]), mirrored(outer[i + 1]), mirrored(inner[i + 1])}});
    }
    const BodyId key = add({}, Hull{{inner[8], outer[8], mirrored(outer[8]), mirrored(inner[8])}});
    for (int i = 0; i < 4; ++i) add({0, outer[8].y + 0.5 + i}, Box{4, 1});
    const double height = world.position(key).y;
    run(world, 2, 1.0 / 60);
    // Soft contacts would bear the slabs with overlaps of 1e-3 of a stone, a millimetre; solved as a whole it is
    // rounding but for what the first steps give way.
    EXPECT_NEAR(world.position(key).y, height, 1e-4);
}

}  // namespace
}  // namespace carom::test
