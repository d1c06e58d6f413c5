#include "collision/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/random.hpp>
#include <cmath>

#include "collision/walls.hpp"

using namespace carom;

namespace {

struct Discs {
    std::vector<Vec2> centre;
    std::vector<double> radius;
    std::optional<Periodic> box;

    bool overlap(std::size_t i, std::size_t j) const {
        return length(nearest_image(box, centre[j] - centre[i])) < radius[i] + radius[j];
    }
};

/// Radii spread evenly over decades, in a square of this side.
Discs random_discs(std::size_t n, double decades, double side, bool periodic, std::uint64_t seed) {
    Random random(seed);
    Discs d;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = random.uniform(-side / 2, side / 2);
        d.centre.push_back({x, random.uniform(-side / 2, side / 2)});
        d.radius.push_back(std::pow(10, -decades * random.uniform()));
    }
    // In a box a third wider than high, so that the axes cannot be mixed up.
    if (periodic) d.box = Periodic{{-side / 2, -3 * side / 8}, {side / 2, 3 * side / 8}};
    return d;
}

/// Every overlap is found, and nothing twice.
void expect_complete(const Grid& grid, const Discs& d) {
    std::vector<std::uint32_t> near;
    std::size_t overlaps = 0;
    for (std::uint32_t i = 0; i < d.centre.size(); ++i) {
        near.clear();
        grid.near(d.centre[i], d.radius[i], near);
        std::sort(near.begin(), near.end());
        ASSERT_EQ(std::adjacent_find(near.begin(), near.end()), near.end()) << "disc found twice";
        for (std::uint32_t j = 0; j < d.centre.size(); ++j) {
            if (!d.overlap(i, j)) continue;
            ++overlaps;
            ASSERT_TRUE(std::binary_search(near.begin(), near.end(), j)) << i << " misses " << j;
        }
    }
    EXPECT_GT(overlaps, 2 * d.centre.size());  // each itself, and more: or the test would see nothing
}

std::size_t candidates(const Discs& d) {
    Grid grid;
    grid.build(d.centre, d.radius, d.box);
    std::vector<std::uint32_t> near;
    for (std::size_t i = 0; i < d.centre.size(); ++i) grid.near(d.centre[i], d.radius[i], near);
    return near.size();
}

}  // namespace

TEST(Grid, FindsEveryOverlapOfRadiiOverFourDecades) {
    for (const bool periodic : {false, true})
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            const Discs d = random_discs(400, 4, 10, periodic, seed);
            Grid grid;
            grid.build(d.centre, d.radius, d.box);
            expect_complete(grid, d);
        }
}

TEST(Grid, FollowsDiscsThatMoveGrowAndShrink) {
    for (const bool periodic : {false, true}) {
        Discs d = random_discs(300, 4, 10, periodic, 1);
        Grid grid;
        grid.build(d.centre, d.radius, d.box);
        Random random(2);
        for (int n = 0; n < 3000; ++n) {
            const auto i = static_cast<std::uint32_t>(random.uniform() * 300);
            // Out of the box too: positions are not wrapped.
            d.centre[i] += Vec2{random.normal(), random.normal()};
            d.radius[i] *= std::exp(random.normal());
            d.radius[i] = std::clamp(d.radius[i], 1e-7, 10.);
            grid.move(i, d.centre[i], d.radius[i]);
        }
        expect_complete(grid, d);
    }
}

TEST(Grid, FindsDiscsOfVeryDifferentSizesAndPoints) {
    Discs d = random_discs(200, 25, 4, false, 3);
    for (std::size_t i = 0; i < 20; ++i) d.radius[i] = 0;
    d.radius[20] = 1e12;
    Grid grid;
    grid.build(d.centre, d.radius, d.box);
    expect_complete(grid, d);
}

TEST(Grid, FindsDiscsThatShareTheEdgesOfCells) {
    // Touching discs on a lattice as wide as the cells, a rounding closer than touching.
    Discs d;
    for (int x = -6; x < 6; ++x)
        for (int y = -6; y < 6; ++y) d.centre.push_back({0.2 * x, 0.2 * y}), d.radius.push_back(0.1 * (1 + 1e-15));
    for (const bool periodic : {false, true}) {
        if (periodic) d.box = Periodic{{-1.2, -1.2}, {1.2, 1.2}};
        Grid grid;
        grid.build(d.centre, d.radius, d.box);
        expect_complete(grid, d);
    }
}

TEST(Grid, FindsDiscsFarFromTheOrigin) {
    Discs d = random_discs(200, 2, 6, false, 4);
    for (Vec2& x : d.centre) x += {1e9, -1e9};
    Grid grid;
    grid.build(d.centre, d.radius, d.box);
    expect_complete(grid, d);
    for (Vec2& x : d.centre) x *= 1e250;  // all in one column
    grid.build(d.centre, d.radius, d.box);
    std::vector<std::uint32_t> near;
    grid.near(d.centre[7], d.radius[7], near);
    EXPECT_NE(std::find(near.begin(), near.end(), 7u), near.end());
}

TEST(Grid, FindsDiscsInABoxNoWiderThanThey) {
    Discs d = random_discs(60, 1, 2, true, 5);
    Grid grid;
    grid.build(d.centre, d.radius, d.box);
    expect_complete(grid, d);
}

TEST(Grid, CostsAsMuchForEachOfMoreDiscs) {
    for (const double decades : {0., 1.5}) {
        const auto each = [decades](std::size_t n) {
            return double(candidates(random_discs(n, decades, 2 * std::sqrt(double(n)), false, 6))) / double(n);
        };
        const double few = each(1000), many = each(16000);
        // The same density: the same neighbours, but for the rim.
        EXPECT_LT(many, 1.2 * few);
        EXPECT_LT(many, decades == 0 ? 12 : 60);
    }
}

TEST(Grid, FindsDiscsAroundPlacesOfAnySize) {
    for (const bool periodic : {false, true}) {
        Discs d = random_discs(400, 2, 20, periodic, 8);
        d.radius[0] = 300, d.radius[1] = 1e-4;  // with levels between in which there is nobody
        Grid grid;
        grid.build(d.centre, d.radius, d.box);
        std::vector<std::uint32_t> near;
        for (double radius = 1e-5; radius < 1e4; radius *= 1.3) {
            const Vec2 x{std::sin(radius) * 8, std::cos(radius) * 8};
            near.clear();
            grid.near(x, radius, near);
            std::sort(near.begin(), near.end());
            ASSERT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
            for (std::uint32_t j = 0; j < d.centre.size(); ++j) {
                if (length(nearest_image(d.box, d.centre[j] - x)) >= radius + d.radius[j]) continue;
                ASSERT_TRUE(std::binary_search(near.begin(), near.end(), j)) << radius << " misses " << j;
            }
        }
    }
}

TEST(NearestImage, IsTheShortestWay) {
    const Periodic box{{1, 2}, {4, 4}};
    Random random(1);
    for (int n = 0; n < 1000; ++n) {
        const Vec2 d{random.uniform(-20, 20), random.uniform(-20, 20)}, image = nearest_image(box, d);
        EXPECT_LE(std::abs(image.x), 1.5);
        EXPECT_LE(std::abs(image.y), 1);
        EXPECT_NEAR(std::remainder(d.x - image.x, 3), 0, 1e-14);  // 20 rounded
        EXPECT_NEAR(std::remainder(d.y - image.y, 2), 0, 1e-14);
    }
    EXPECT_EQ(nearest_image({}, {7, 8}), (Vec2{7, 8}));
}
