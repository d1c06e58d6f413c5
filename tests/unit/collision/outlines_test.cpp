// Pairs of outlines are looked at in lanes: each as if it were alone, whatever the instruction set.
#include "outlines.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "collision/side_by_side.hpp"
#include "simd/isa.hpp"

namespace carom {
namespace {

using test::random_outline;

class OutlineLanes : public testing::Test {
  protected:
    ~OutlineLanes() override { use_isa({}); }
};

struct Pair {
    Convex a, b;
    Frame frame_a, frame_b;
    Vec2 between;
    double margin;

    Manifold alone() const { return manifold(a, frame_a, b, frame_b, between, margin); }
};

/// Boxes in stacks and rows, to the bit and nearly so, and at seams; their corners may touch.
Pair aligned_pair(Random& random) {
    const auto one_of = [&](std::initializer_list<double> some) {
        return some.begin()[static_cast<std::size_t>(random.uniform(0, static_cast<double>(some.size())))];
    };
    const auto box = [&] {
        const double width = one_of({1, 1, 2, 20});
        return pieces_of(Box{width, 1, {}, 0, one_of({0, 0, 0.1})})[0];
    };
    const Convex a = box(), b = box();
    const Frame tilted = frame_at({}, one_of({0, 0, 1.5707963267948966, 0.3}));
    const double x = one_of({0, 0, 0.5, 1, -1, 1.5, 0.3}), y = one_of({0, 1, -1, 1 + 1e-10, 0.995, 1.003, 1.2});
    const Vec2 off = tilted.turn({x + one_of({0, 0, 1e-9, -2e-3}), y});
    const Frame other = random.uniform() < 0.7 ? tilted : frame_at({}, one_of({1e-10, -1e-5, 0.02, 3.14}));
    return {a, b, tilted, other, off, one_of({0, 0.02, 1e300})};
}

/// Polygons and lines of all kinds anywhere.
Pair any_pair(Random& random) {
    Pair pair{random_outline(random, 1),
              random_outline(random, 1),
              test::random_frame(random),
              test::random_frame(random),
              {},
              random.uniform(0, 0.5)};
    const double x = random.uniform(-2, 2);
    pair.between = {x, random.uniform(-2, 2)};
    return pair;
}

/// All numbers of a manifold, with the signs of zeros.
std::string bits_of(const Manifold& m) {
    std::string bits = std::to_string(m.count) + (m.corners ? " corners" : "");
    const auto add = [&](double number) { bits.append(reinterpret_cast<const char*>(&number), sizeof number); };
    add(m.normal.x), add(m.normal.y);
    for (const ManifoldPoint& p : m.point)
        add(p.core_a.x), add(p.core_a.y), add(p.core_b.x), add(p.core_b.y), add(p.gap), add(p.id);
    return bits;
}

/// Looks at some pairs side by side, and says how many of them had to be looked at alone all the same.
std::size_t expect_same_as_alone(const std::vector<Pair>& of) {
    std::vector<Placed> a, b;
    for (const Pair& pair : of)
        a.emplace_back(pair.a, pair.frame_a, Vec2{}), b.emplace_back(pair.b, pair.frame_b, Vec2{});
    std::vector<Manifold> found(of.size());
    SideBySide pairs;
    std::uint32_t together = 0;
    for (std::uint32_t k = 0; k < of.size(); ++k) {
        if (!pairs.takes(a[k], b[k])) continue;
        pairs.add(a[k], b[k], of[k].between, of[k].margin, k, found[k]);
        together |= 1U << k;
    }
    std::size_t left = 0;
    const std::uint32_t touch = pairs.look_at_all([&](std::uint32_t k) { together &= ~(1U << k), ++left; });
    for (std::uint32_t k = 0; k < of.size(); ++k) {
        if ((together >> k & 1U) == 0) continue;
        const Manifold alone = of[k].alone();
        EXPECT_EQ(bits_of(found[k]), bits_of(alone)) << k;
        EXPECT_EQ((touch >> k & 1U) != 0, alone.count > 0) << k;
    }
    return left;
}

template <class Make>
void expect_same_in_lanes(const Make& make) {
    for (const Isa which : available_isas()) {
        use_isa(which);
        Random random(5);
        std::size_t all = 0, left = 0;
        for (std::uint32_t turn = 0; turn < 400; ++turn) {
            std::vector<Pair> pairs;
            for (std::uint32_t k = 0; k <= turn % SideBySide::most; ++k) pairs.push_back(make(random));
            left += expect_same_as_alone(pairs), all += pairs.size();
        }
        EXPECT_LT(left, all / 100);
    }
}

TEST_F(OutlineLanes, BoxesInStacksHaveTheManifoldsThatTheyHaveAlone) { expect_same_in_lanes(aligned_pair); }
TEST_F(OutlineLanes, PolygonsOfAllKindsHaveTheManifoldsThatTheyHaveAlone) { expect_same_in_lanes(any_pair); }

}  // namespace
}  // namespace carom
