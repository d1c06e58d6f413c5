// A contact saw of what hangs together by joints the one body that it touched: what is heavy, on light legs that were
// welded to it, shook for ever, and was lifted by thousands of joules.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

using namespace carom;

namespace {

constexpr double gravity = 9.81, drop = 1e-3, heavy = 1000;

/// Put down from a millimetre.
struct OnLegs {
    World world{{.gravity = {0, -gravity}, .solver = SoftStep{}}};
    BodyId top;

    explicit OnLegs(bool on_wheels) {
        world.add(HalfPlane{.side = {.friction = 0.5}});
        top = world.add(Body{.position = {0, 1.05 + drop},
                             .mass = heavy,
                             .shapes = {{.geometry = Box{2, 0.1}}},
                             .restitution = 0,
                             .friction = 0.5});
        for (const double x : {-0.9, 0.9}) {
            Body leg{.position = {x, 0.5 + drop}, .mass = 1, .restitution = 0, .friction = 0.5};
            if (on_wheels)
                leg.position.y = 0.3 + drop, leg.radius = 0.3;
            else
                leg.shapes = {{.geometry = Box{0.1, 1}}};
            const BodyId id = world.add(leg);
            const JointType type = on_wheels ? JointType(RevoluteJoint{}) : JointType(WeldJoint{});
            world.add(Joint{.a = top, .b = id, .at = Vec2{x, on_wheels ? 0.3 + drop : 1 + drop}, .type = type});
        }
    }
};

}  // namespace

TEST(HeavyTable, ComesToRestOnLightLegs) {
    for (const bool on_wheels : {false, true}) {
        OnLegs table(on_wheels);
        run(table.world, 10, 1.0 / 60);
        const Energy e = energy(table.world);
        EXPECT_TRUE(table.world.asleep(table.top)) << on_wheels;
        // It lands within a substep, and sinks in by a part of the drop until the contacts push as hard as they must.
        EXPECT_NEAR(table.world.position(table.top).y, 1.05, 0.5 * drop) << on_wheels;
        EXPECT_LT(e.work.overlap, 0.01 * heavy * gravity * drop) << on_wheels;
        // It falls for less than four substeps: of their energy a landing within one is not known better.
        EXPECT_NEAR(e.residual, 0, heavy * gravity * drop) << on_wheels;
    }
}
