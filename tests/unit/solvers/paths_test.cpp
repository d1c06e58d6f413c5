// That a glance at two ways is never wrong, and mostly enough.
#include "solvers/paths.hpp"

#include <gtest/gtest.h>

#include <random>

namespace carom {
namespace {

struct RandomPaths {
    std::mt19937_64 bits{7};
    std::uniform_real_distribution<double> number{-1, 1};

    Vec2 vec() { return {number(bits), number(bits)}; }
    Path path(double way) { return hermite(vec(), way * vec(), vec(), way * vec(), 1); }
};

TEST(StayApart, IsSaidOfNoTwoThatTouch) {
    RandomPaths random;
    const std::optional<Periodic> none, box = Periodic{.low = {-1, -1}, .high = {1, 1}};
    int apart = 0, touching = 0;
    for (int n = 0; n < 20000; ++n) {
        const Path a = random.path(3), b = random.path(3);
        const double end = std::abs(random.number(random.bits)), near = 0.1 * end;
        for (const auto& where : {none, box}) {
            const bool touch = first_touch(a, b, near, 0, end, where).has_value();
            const bool is_apart = stay_apart(a, b, near, 0, end, where);
            EXPECT_FALSE(touch && is_apart) << n;
            touching += touch, apart += is_apart;
        }
        const Wall wall{.normal = {0.6, 0.8}, .offset = -1, .restitution = 1, .friction = 0};
        EXPECT_FALSE(first_touch(a, near, wall, 0, end) && stay_apart(a, near, wall, 0, end)) << n;
    }
    EXPECT_GT(apart, 1000);
    EXPECT_GT(touching, 1000);
}

TEST(StayApart, IsNotSaidOfTwoThatTouchAlready) {
    const Path a = parabola(0, {}, {}, {}), b = parabola(0, {1, 0}, {}, {});
    EXPECT_FALSE(stay_apart(a, b, 1, 0, 1, {}));
    EXPECT_TRUE(stay_apart(a, b, 1 - 1e-13, 0, 1, {}));  // a few roundings apart
}

}  // namespace
}  // namespace carom
