#include "collision/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <carom/random.hpp>

using namespace carom;

namespace {

std::vector<Aabb> random_boxes(Random& random, std::size_t n, Vec2 room) {
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 low{random.uniform(-room.x, room.x), random.uniform(-room.y, room.y)};
        const double size = random.uniform() < 0.02 ? room.x : 1;
        boxes.push_back({low, low + Vec2{random.uniform(0, size), random.uniform(0, size)}});
    }
    return boxes;
}

std::vector<BoxPair> brute_pairs(const std::vector<Aabb>& boxes, const Scratch<bool>& moves) {
    std::vector<BoxPair> pairs;
    for (std::uint32_t a = 0; a < boxes.size(); ++a)
        for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
            if ((moves[a] || moves[b]) && boxes[a].low.x <= boxes[b].high.x && boxes[b].low.x <= boxes[a].high.x &&
                boxes[a].low.y <= boxes[b].high.y && boxes[b].low.y <= boxes[a].high.y)
                pairs.push_back({a, b});
    return pairs;
}

void expect_all(Sweep& sweep, const std::vector<Aabb>& boxes, const Scratch<bool>& moves) {
    const auto found = sweep.pairs(boxes, moves);
    EXPECT_EQ(std::vector<BoxPair>(found.begin(), found.end()), brute_pairs(boxes, moves));
}

}  // namespace

TEST(Sweep, FindsThePairsOfBruteForce) {
    Random random(1);
    Sweep sweep;  // with what it remembers of other numbers of boxes
    for (const std::size_t n : {0, 1, 2, 30, 127, 128, 1000, 50})
        for (const Vec2 room : {Vec2{10, 10}, Vec2{100, 2}, Vec2{2, 100}})
            for (const double still : {0., 0.5, 1.}) {
                const std::vector<Aabb> boxes = random_boxes(random, n, room);
                Scratch<bool> moves;
                for (std::size_t i = 0; i < n; ++i) moves.push_back(random.uniform() >= still);
                expect_all(sweep, boxes, moves);
            }
}

TEST(Sweep, CountsTouchingBoxesAndEqualEnds) {
    std::vector<Aabb> boxes;
    for (int x = -10; x < 10; ++x)
        for (int y = -10; y < 10; ++y) boxes.push_back({{0.5 * x, 0.5 * y}, {0.5 * x + 0.5, 0.5 * y + 0.5}});
    boxes.push_back({{-0.0, -0.0}, {0.0, 0.0}});
    boxes.push_back({{1e-310, -1e-310}, {1e300, 1e300}});
    Scratch<bool> moves(boxes.size(), true);
    Sweep sweep;
    expect_all(sweep, boxes, moves);
    for (std::size_t i = 0; i < moves.size(); i += 3) moves[i] = false;
    expect_all(sweep, boxes, moves);
}

TEST(Sweep, FindsTheSameByAnyNumberOfThreads) {
    Random random(3);
    const std::vector<Aabb> boxes = random_boxes(random, 3000, {40, 40});
    Scratch<bool> moves;
    std::vector<std::uint32_t> moving;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        moves.push_back(random.uniform() < 0.7);
        if (moves.back()) moving.push_back(i);
    }
    const std::vector<BoxPair> pairs = brute_pairs(boxes, moves);
    for (const int threads : {1, 2, 3, 8}) {
        Sweep sweep;
        const auto found = sweep.pairs(boxes, moves, threads);
        EXPECT_EQ(std::vector<BoxPair>(found.begin(), found.end()), pairs);
        const auto again = sweep.pairs_again(boxes, moving, threads);
        EXPECT_EQ(std::vector<BoxPair>(again.begin(), again.end()), pairs);
    }
}

TEST(Sweep, KeepsThoseThatAreWanted) {
    Random random(5);
    const std::vector<Aabb> boxes = random_boxes(random, 2000, {40, 40});
    const Scratch<bool> moves(boxes.size(), true);
    const auto is_unwanted = [](BoxPair p) { return (p.a + p.b) % 3 != 0; };
    std::vector<BoxPair> wanted = brute_pairs(boxes, moves);
    const std::size_t all = wanted.size();
    std::erase_if(wanted, is_unwanted);
    ASSERT_TRUE(!wanted.empty() && wanted.size() < all);
    const auto keep = [&](std::span<BoxPair> pairs) {
        return static_cast<std::size_t>(std::remove_if(pairs.begin(), pairs.end(), is_unwanted) - pairs.begin());
    };
    for (const int threads : {1, 3}) {
        Sweep sweep;
        const auto found = sweep.pairs(boxes, moves, threads, keep);
        EXPECT_EQ(std::vector<BoxPair>(found.begin(), found.end()), wanted);
    }
}

TEST(Sweep, FindsThemAgainWhereTheOthersStayed) {
    Random random(2);
    Sweep sweep;
    for (const std::size_t n : {1, 30, 1000})
        for (const double share : {0., 0.01, 0.3, 1.}) {
            std::vector<Aabb> boxes = random_boxes(random, n, {20, 20});
            Scratch<bool> moves;
            std::vector<std::uint32_t> moving;
            for (std::uint32_t i = 0; i < n; ++i) {
                moves.push_back(random.uniform() < share);
                if (moves.back()) moving.push_back(i);
            }
            sweep.pairs(boxes, moves);
            for (int again = 0; again < 3; ++again) {
                for (const std::uint32_t i : moving) {
                    const Vec2 way{random.uniform(-30, 30), random.uniform(-30, 30)};
                    boxes[i] = {boxes[i].low + way, boxes[i].high + way};
                }
                const auto found = sweep.pairs_again(boxes, moving);
                EXPECT_EQ(std::vector<BoxPair>(found.begin(), found.end()), brute_pairs(boxes, moves));
            }
            // Some that lay still may move from now on: each pair of theirs is met twice, and named once.
            moving.clear();
            for (std::uint32_t i = 0; i < n; ++i) {
                moves[i] = moves[i] || i % 7 == 0;
                if (moves[i]) moving.push_back(i);
            }
            const auto found = sweep.pairs_again(boxes, moving);
            EXPECT_EQ(std::vector<BoxPair>(found.begin(), found.end()), brute_pairs(boxes, moves));
        }
}

TEST(Sweep, PutsThemInTheOrderOfNames) {
    Random random(7);
    const std::vector<Aabb> boxes = random_boxes(random, 1000, {30, 30});
    const Scratch<bool> moves(boxes.size(), true);
    std::vector<BoxName> names;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) names.push_back({i / 3, i % 3});
    std::reverse(names.begin(), names.end());
    const auto key = [&](BoxPair p) {
        return std::array{names[p.a].body, names[p.b].body, names[p.a].piece, names[p.b].piece};
    };
    // All of them, and so few that they are not worth counting.
    for (const std::uint32_t one_in : {1, 200}) {
        const auto is_unwanted = [=](BoxPair p) { return (p.a + p.b) % one_in != 0; };
        const auto keep = [&](std::span<BoxPair> pairs) {
            return static_cast<std::size_t>(std::remove_if(pairs.begin(), pairs.end(), is_unwanted) - pairs.begin());
        };
        std::vector<BoxPair> expected = brute_pairs(boxes, moves);
        std::erase_if(expected, is_unwanted);
        ASSERT_FALSE(expected.empty());
        for (BoxPair& p : expected)
            if (names[p.b].body < names[p.a].body) std::swap(p.a, p.b);
        const auto by_key = [&](BoxPair p, BoxPair q) { return key(p) < key(q); };
        std::sort(expected.begin(), expected.end(), by_key);
        // Of two pieces of one body either goes first; no solver asks for them.
        const auto is_one = [&](BoxPair p) { return names[p.a].body == names[p.b].body; };
        std::erase_if(expected, is_one);
        Sweep sweep;
        const auto found = sweep.pairs(boxes, moves, 1, keep, names);
        std::vector<BoxPair> others(found.begin(), found.end());
        std::erase_if(others, is_one);
        EXPECT_EQ(others, expected);
    }
}
