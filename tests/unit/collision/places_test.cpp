// Where pieces are, which is followed and not found anew, beside a search among all of them.
#include "collision/places.hpp"

#include <gtest/gtest.h>

#include "collision/queries.hpp"
#include "outlines.hpp"

using namespace carom;
using namespace carom::test;

namespace {

std::size_t below(Random& random, std::size_t n) {
    return static_cast<std::size_t>(random.uniform(0, static_cast<double>(n)));
}

/// Bodies of up to three pieces, strewn about a point.
struct Strewn {
    Vec2 middle{};
    std::vector<Piece> pieces;
    std::vector<BodyId> ids;
    Motion motion;

    void put(std::size_t row, Random& random) {
        const double what = random.uniform();
        if (what < 0.7) motion.linear[row] = middle + Vec2{random.uniform(-20, 20), random.uniform(-20, 20)};
        if (what > 0.3) motion.angular[row] = random.uniform(-4, 4);
    }
    /// From a row on others, up to so many.
    void renew(std::size_t first, std::size_t rows, Random& random) {
        std::erase_if(pieces, [first](const Piece& p) { return p.row >= first; });
        motion.resize(rows), ids.resize(rows);
        for (auto row = static_cast<std::uint32_t>(first); row < rows; ++row) {
            ids[row] = {row, 1};
            put(row, random);
            for (std::uint32_t k = 0; k < 1 + below(random, 3); ++k)
                pieces.push_back(
                    {.outline = random_outline(random, 1), .row = row, .shape = k, .sensor = random.uniform() < 0.1});
        }
    }
};

std::vector<std::size_t> found_in(const Places& places, const Aabb& box) {
    std::vector<std::size_t> found;
    places.each([&](const Aabb& bounds) { return overlap(bounds, box); }, [&](std::size_t k) { found.push_back(k); });
    return found;
}

void expect_same(const Places& followed, const Places& anew, std::size_t rows) {
    for (std::size_t row = 0; row < rows; ++row) {
        EXPECT_EQ(followed.frame(row).position, anew.frame(row).position);
        EXPECT_EQ(followed.frame(row).turn({1, 2}), anew.frame(row).turn({1, 2}));
    }
    ASSERT_TRUE(
        std::equal(followed.sensors().begin(), followed.sensors().end(), anew.sensors().begin(), anew.sensors().end()));
    ASSERT_EQ(followed.bounds().size(), anew.bounds().size());
    for (std::size_t k = 0; k < anew.bounds().size(); ++k) {
        EXPECT_EQ(followed.bounds()[k].low, anew.bounds()[k].low);
        EXPECT_EQ(followed.bounds()[k].high, anew.bounds()[k].high);
    }
}

}  // namespace

TEST(Places, FollowedAreThoseFoundAnew) {
    Random random(3);
    Strewn strewn;
    Places places;
    for (int round = 0; round < 300; ++round) {
        const std::size_t rows = strewn.ids.size();
        const double what = random.uniform();
        if (what < 0.3) {
            const std::size_t first = below(random, rows + 1);
            strewn.renew(first, first + below(random, 200), random);
            places.forget_from(first);
        } else {
            for (std::size_t k = 0; k < rows && what < 0.9; k += 1 + below(random, what < 0.4 ? 1 : 50))
                strewn.put(k, random);
            places.forget();
        }
        places.follow(strewn.pieces, strewn.motion);
        Places anew;
        anew.follow(strewn.pieces, strewn.motion);
        expect_same(places, anew, strewn.ids.size());
        const Vec2 low{random.uniform(-20, 20), random.uniform(-20, 20)};
        const Aabb box{low, low + Vec2{random.uniform(0, 9), random.uniform(0, 9)}};
        std::vector<std::size_t> all;
        for (std::size_t k = 0; k < places.bounds().size(); ++k)
            if (overlap(places.bounds()[k], box)) all.push_back(k);
        EXPECT_EQ(found_in(places, box), all);
    }
}

TEST(Places, ARayMissesNothingThatItMeets) {
    for (const double far : {0., 1e3, 1e9}) {
        Random random(5);
        Strewn strewn;
        strewn.middle = {far, -0.3 * far};
        strewn.renew(0, 300, random);
        // Squares whose corners and sides rays along the diagonals and axes touch without a hair between.
        for (std::size_t row = 0; row < 100; ++row) {
            strewn.motion.linear[row] =
                strewn.middle + Vec2{static_cast<double>(row % 10), static_cast<double>(row / 10)};
            strewn.motion.angular[row] = 0;
        }
        for (Piece& piece : strewn.pieces)
            if (piece.row < 100) piece.outline = pieces_of(Box{})[0], piece.sensor = false;
        Places places;
        places.follow(strewn.pieces, strewn.motion);
        const PlacedPieces all{strewn.pieces, strewn.ids, places};
        std::size_t hits = 0;
        for (int n = 0; n < 400; ++n) {
            const Vec2 whole{static_cast<double>(below(random, 12)), static_cast<double>(below(random, 12))};
            const Vec2 from = strewn.middle + (n % 2 == 0 ? whole - Vec2{1.5, 1.5} : random.uniform(-9, 9) * whole);
            const Vec2 ways[] = {{9, 9}, {9, -9}, {12, 0}, {0, 12}, {random.uniform(-30, 30), random.uniform(-30, 30)}};
            const Vec2 way = ways[below(random, 5)];
            std::vector<ShapeId> met;
            for (std::size_t k = 0; k < all.pieces.size(); ++k)
                if (ray_meets(all[k].outline, all.frame(k), from, way)) met.push_back(all.shape(k));
            std::vector<ShapeId> found;
            for (const Hit& hit : all_hits(all, from, way, {.sensors = true})) found.push_back({hit.body, hit.shape});
            const auto before = [](const ShapeId& a, const ShapeId& b) {
                return std::pair(a.body.index, a.shape) < std::pair(b.body.index, b.shape);
            };
            std::sort(found.begin(), found.end(), before);
            EXPECT_EQ(found, met) << far << ", ray " << n;
            hits += met.size();
        }
        EXPECT_GT(hits, 1000u);
    }
}
