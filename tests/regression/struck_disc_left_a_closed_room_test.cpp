// Few fast discs in a closed room of thin walls: who was struck in a substep flew on in it by more than it could reach
// by itself, past walls that nobody had looked at.
#include <cmath>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

TEST(FewFastDiscs, StayInAClosedRoomOfThinWalls) {
    constexpr double half = 4, thin = 0.02, speed = 400;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        World world({.solver = SoftStep{}});
        for (const double side : {-half, half}) {
            const Shape across{.geometry = Box{.width = 2 * half + thin, .height = thin}};
            const Shape upright{.geometry = Box{.width = thin, .height = 2 * half + thin}};
            world.add(Body{.kind = Kind::fixed, .position = {0, side}, .shapes = {across}});
            world.add(Body{.kind = Kind::fixed, .position = {side, 0}, .shapes = {upright}});
        }
        Random random(seed);
        for (int k = 0; k < 25; ++k)
            world.add(Body{.position = {-3 + 1.4 * (k % 5), -3 + 1.4 * (k / 5)},
                           .velocity = {random.uniform(-speed, speed), random.uniform(-speed, speed)},
                           .radius = 0.2});
        for (int step = 0; step < 30; ++step) {
            world.step(1.0 / 60);
            for (const Vec2 x : world.positions())
                ASSERT_TRUE(std::abs(x.x) <= half && std::abs(x.y) <= half) << seed << ' ' << step;
        }
    }
}

}  // namespace
}  // namespace carom::test
