// A piece of a chain reached over one neighbour, and the end of a substep was held against what had touched in it. Who
// passed several pieces in a substep met those beyond the next one when he was in them: from two a substep on a disc
// sank into its bowl and was pushed out again, which made up to 13 % of its energy, and from five on small ones were
// through it. A box's corners, which were seen over their own piece alone, made as much.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

using namespace carom;

namespace {

constexpr double gravity = 9.81, from = 1.2;  // [m/s²], and the angle from which they swing [rad]

struct Bowl {
    double way, rim;  ///< radius on which a disc's centre goes, and how much farther out the chain is [m]
    int sides;

    double side() const { return 0.95 * std::numbers::pi / sides; }  ///< [rad]
    World world() const {
        World world({.gravity = {0, -gravity}, .solver = SoftStep{}});
        std::vector<Vec2> points;
        for (int i = 0; i <= sides; ++i) {
            const double angle = side() * i - 0.5 * side() * sides;
            points.push_back({(way + rim) * std::sin(angle), -(way + rim) * std::cos(angle)});
        }
        world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Chain{.points = points}}}, .restitution = 0});
        return world;
    }
    Vec2 start() const { return {way * std::sin(from), -way * std::cos(from)}; }
    Body disc() const { return {.position = start(), .mass = 1, .radius = rim, .restitution = 0}; }
    /// What a disc loses on its way to the other side [J]: ½ m v² sin²θ at each corner.
    double lost_on_the_way() const {
        double lost = 0, angle = side() * std::floor(from / side());
        for (double fallen = 0;; angle -= side()) {
            fallen = gravity * way * (std::cos(angle) - std::cos(from)) - lost;
            if (fallen <= 0) return lost;
            lost += fallen * std::sin(side()) * std::sin(side());
        }
    }
};

// In between, a side that lay on one line and ended a hair past the corner was held there by neither: 5 cm deep.
TEST(BentChain, HoldsABoxThatSlidesIntoItsCorner) {
    for (const double bend : {0.05, 0.3, 0.8, 1.05, 1.25, 1.5}) {  // rad
        World world({.gravity = {0, -gravity}, .solver = SoftStep{}});
        const Vec2 up{2 * std::cos(bend / 2), 2 * std::sin(bend / 2)}, normal = 0.5 * Vec2{-up.y, up.x};
        const Chain corner{.points = {{-up.x, up.y}, {}, up}};
        world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = corner}}, .restitution = 0, .friction = 0});
        world.add(Body{.position = 0.125 * up + 0.05 * normal,
                       .angle = bend / 2,
                       .mass = 1,
                       .shapes = {{.geometry = Box{0.2, 0.1}}},
                       .restitution = 0,
                       .friction = 0});
        double deepest = 0;
        run(world, 2, 1. / 60, [&](const World& w) {
            for (const Overlap& o : w.overlaps()) deepest = std::max(deepest, o.depth);
        });
        EXPECT_LT(deepest, 0.03 * 0.1) << bend;  // of its thickness: both its ends strike within a substep
    }
}

}  // namespace

TEST(FineChain, TakesOfADiscWhatItsCornersTake) {
    for (const int sides : {300, 600, 1000}) {  // up to 4.5 of them in a substep
        const Bowl bowl{1, 0.1, sides};
        World world = bowl.world();
        const BodyId id = world.add(bowl.disc());
        const double before = energy(world).total();
        run(world, 0.5, 1. / 60);
        for (int i = 0; i < 120 && world.velocity(id).x < 0; ++i) world.step(1. / 60);
        // The first corner and the last, which are passed slowly, and 2 % of the blows by the docs.
        EXPECT_NEAR(before - energy(world).total(), bowl.lost_on_the_way(), 0.02 * bowl.lost_on_the_way()) << sides;
        EXPECT_LT(std::abs(energy(world).residual), 1e-3) << sides;
    }
}

TEST(FineChain, CarriesWhoPassesManyPiecesInASubstep) {
    for (const int sides : {1000, 3000}) {  // 4.5 to 23 in a substep
        for (const Bowl& bowl : {Bowl{1, 0.1, sides}, Bowl{0.5, 0.05, sides}}) {
            World world = bowl.world();
            const BodyId id = world.add(bowl.disc());
            const double before = energy(world).total() + gravity * bowl.way;
            double deepest = 0;
            run(world, 1, 1. / 60,
                [&](const World& w) { deepest = std::max(deepest, length(w.position(id)) - bowl.way); });
            const Energy after = energy(world);
            // On the way out of the last corners before it turns back it may rise by their height.
            EXPECT_LT(deepest, 2e-3 * bowl.rim) << sides;
            EXPECT_LT(after.residual + after.work.overlap, 1e-3 * before) << sides;
            EXPECT_GT(after.total() + gravity * bowl.way, 0.97 * before) << sides;  // as the bowl of 300, or more
        }
    }
}

TEST(FineChain, IsNoSourceOfEnergyForABox) {
    for (const int sides : {500, 2000}) {
        const Bowl bowl{1, 0.1, sides};
        World world = bowl.world();
        world.add(Body{.position = bowl.start(),
                       .angle = from,
                       .mass = 1,
                       .shapes = {{.geometry = Box{0.2, 0.18}}},
                       .restitution = 0});
        const double before = energy(world).total() + gravity * bowl.way;
        run(world, 1, 1. / 60);
        const Energy after = energy(world);
        EXPECT_LT(after.residual + after.work.overlap, 1e-2 * before) << sides;
    }
}
