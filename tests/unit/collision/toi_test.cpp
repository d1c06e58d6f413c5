#include "collision/toi.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "collision/nearest.hpp"
#include "outlines.hpp"

using namespace carom;
using namespace carom::test;

namespace {

const Convex unit_disc = pieces_of(Disc{})[0], unit_box = pieces_of(Box{})[0];

double gap_at(const Convex& a, const Sweeping& ma, const Convex& b, const Sweeping& mb, Vec2 between, double time) {
    const Placed p(a, frame_at({}, ma.angle + time * ma.turn), {});
    const Placed q(b, frame_at({}, mb.angle + time * mb.turn), between + time * (mb.displacement - ma.displacement));
    return core_distance(p, q).distance - a.radius - b.radius;
}

}  // namespace

TEST(TimeOfImpact, OfStraightFlightIsDistanceOverSpeed) {
    EXPECT_NEAR(*time_of_impact(unit_disc, {{10, 0}}, unit_disc, {}, {5, 0}, 0), 0.4, 1e-9);
    EXPECT_NEAR(*time_of_impact(unit_disc, {{10, 0}}, unit_disc, {}, {5, 0.6}, 0), 0.42, 1e-9);
    EXPECT_NEAR(*time_of_impact(unit_box, {{4, 0}}, unit_box, {{-4, 0}}, {5, 0.5}, 0), 0.5, 1e-9);
    EXPECT_NEAR(*time_of_impact(unit_box, {{4, 0}}, unit_box, {{-4, 0}}, {5, 0.5}, 0.8), 0.4, 1e-9);
    EXPECT_NEAR(*time_of_impact(unit_box, {{4, 0}}, unit_box, {{-4, 0}}, {5, 0.5}, -0.4), 0.55, 1e-9);
    EXPECT_FALSE(time_of_impact(unit_disc, {{3.9, 0}}, unit_disc, {}, {5, 0}, 0));
    EXPECT_FALSE(time_of_impact(unit_disc, {{10, 0}}, unit_disc, {}, {5, 1.01}, 0));
    EXPECT_FALSE(time_of_impact(unit_disc, {{-10, 0}}, unit_disc, {}, {5, 0}, 0));
    EXPECT_EQ(time_of_impact(unit_disc, {{-10, 0}}, unit_disc, {}, {0.9, 0}, 0), 0);
    // Through a thin wall.
    const Convex wall = pieces_of(Segment{{0, -1}, {0, 1}})[0];
    EXPECT_NEAR(*time_of_impact(unit_disc, {{1000, 0}}, wall, {}, {100, 0.3}, 0), 0.0995, 1e-9);
}

TEST(TimeOfImpact, OfATurningBoxIsTheAngleAtWhichItsCornerComes) {
    // The corner of a square is √½ from its centre; it reaches a wall at 0.6 when cos φ = 0.6/√½.
    const Convex wall = pieces_of(Box{1, 10})[0];
    const double quarter = std::acos(-1.) / 4, angle = quarter - std::acos(0.6 / std::sqrt(0.5));
    EXPECT_NEAR(*time_of_impact(unit_box, {{}, 0, 1}, wall, {}, {1.1, 0}, 0), angle, 1e-7);
    EXPECT_NEAR(*time_of_impact(unit_box, {{}, 0, -20}, wall, {}, {1.1, 0}, 0), angle / 20, 1e-7);
    EXPECT_FALSE(time_of_impact(unit_box, {{}, 0, 100}, wall, {}, {1.21, 0}, 0));
    // Just missed, or just not.
    EXPECT_FALSE(time_of_impact(unit_box, {{}, 0, 1}, wall, {}, {0.5 + std::sqrt(0.5) + 1e-6, 0}, 0));
    EXPECT_NEAR(*time_of_impact(unit_box, {{}, 0, 1}, wall, {}, {0.5 + std::sqrt(0.5) - 1e-6, 0}, 0), quarter, 2e-3);
}

TEST(TimeOfImpact, IsTheFirstOfAllTimes) {
    Random random(1);
    int impacts = 0, misses = 0;
    for (int n = 0; n < 3000; ++n) {
        const Convex a = random_outline(random, 1), b = random_outline(random, n % 3 ? 1 : 0.1);
        const auto motion = [&] {
            const Vec2 displacement{random.uniform(-3, 3), random.uniform(-3, 3)};
            const double angle = random.uniform(-4, 4);
            return Sweeping{displacement, angle, random.uniform() < 0.3 ? 0 : random.uniform(-6, 6)};
        };
        const Sweeping ma = motion(), mb = motion();
        const Vec2 between = random.uniform(2, 5) * random_frame(random).turn({1, 0});
        const double target = n % 2 ? 0 : 0.01;
        if (gap_at(a, ma, b, mb, between, 0) <= target) continue;
        const auto time = time_of_impact(a, ma, b, mb, between, target);
        const int samples = 2000;
        int first = 0;
        while (first <= samples && gap_at(a, ma, b, mb, between, double(first) / samples) > target) ++first;
        if (!time) {
            ++misses;
            EXPECT_GT(first, samples) << n;
            continue;
        }
        ++impacts;
        EXPECT_NEAR(gap_at(a, ma, b, mb, between, *time), target, 1e-8) << n;
        EXPECT_LE(*time, double(first) / samples) << n;
    }
    EXPECT_GT(impacts, 250);
    EXPECT_GT(misses, 500);
}

TEST(TimeOfImpact, ScalesWithAllLengths) {
    Random random(2);
    for (int n = 0; n < 1000; ++n) {
        const Convex a = random_outline(random, 1), b = random_outline(random, 1);
        const Sweeping ma{{random.uniform(-3, 3), 1}, 0, random.uniform(-3, 3)}, mb{{}, 0, random.uniform(-3, 3)};
        const Vec2 between = random.uniform(2, 5) * random_frame(random).turn({1, 0});
        const double f = 1. / 1024;
        const auto scaled = [&](Convex c) {
            for (Vec2& corner : c.corner) corner *= f;
            c.centre *= f, c.radius *= f, c.width *= f;
            return c;
        };
        const Sweeping sa{f * ma.displacement, ma.angle, ma.turn}, sb{f * mb.displacement, mb.angle, mb.turn};
        EXPECT_EQ(time_of_impact(a, ma, b, mb, between, 0.01),
                  time_of_impact(scaled(a), sa, scaled(b), sb, f * between, f * 0.01));
    }
}

TEST(TimeOfImpact, OfAChainIsFromItsLeft) {
    const Convex ground = pieces_of(Chain{{{-1, 0}, {1, 0}}})[0];
    EXPECT_NEAR(*time_of_impact(ground, {}, unit_disc, {{0, -10}}, {0, 5}, 0), 0.45, 1e-9);
    EXPECT_FALSE(time_of_impact(ground, {}, unit_disc, {{0, 10}}, {0, -5}, 0));
    EXPECT_FALSE(time_of_impact(unit_disc, {{0, 10}}, ground, {}, {0, 5}, 0));
}

TEST(TimeOfImpact, OfADiscDoesNotDependOnItsSpin) {
    const auto still = time_of_impact(unit_disc, {{10, 0}}, unit_disc, {}, {5, 0.3}, 0);
    EXPECT_NEAR(*time_of_impact(unit_disc, {{10, 0}, 0, 1e6}, unit_disc, {{}, 0, -1e6}, {5, 0.3}, 0), *still, 1e-9);
}
