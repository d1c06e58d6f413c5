// Between an edit that puts a body elsewhere and the next step contacts() told contacts at places where there had been
// none: those of the last step, at the body as it is now.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(ContactToldWhereNoneHadBeen, IsWhereTheLastStepLeftIt) {
    for (const bool asleep : {false, true})
        for (const Solver& solver : {Solver(SoftStep{}), Solver(Events{})}) {
            World world({.gravity = {0, -10}, .solver = solver});
            world.add(HalfPlane{});
            world.add(Body{.position = {9, 9}, .radius = 0.1});
            const BodyId crate =
                world.add(Body{.position = {0, 0.5}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0});
            const BodyId lid =
                world.add(Body{.position = {0, 1.5}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0});
            run(world, asleep ? 2 : 0.1, 1.0 / 60);
            const auto before = world.contacts();
            ASSERT_EQ(before.size(), 4u);
            world.set_position(lid, {5, 3}, 0);
            world.set_position(crate, {-5, 3}, 1);
            EXPECT_EQ(world.contacts(), before);
            EXPECT_EQ(world.contacts(lid).size(), 2u);
            world.step(1.0 / 60);
            EXPECT_TRUE(world.contacts().empty());
        }
}

TEST(ContactToldWhereNoneHadBeen, OfAShapeThatIsGoneIsNotTold) {
    World world({.gravity = {0, -10}, .solver = SoftStep{}});
    world.add(HalfPlane{});
    const BodyId crates = world.add(Body{
        .position = {0, 0.5}, .shapes = {{.geometry = Box{1, 1}}, {.geometry = Box{1, 1, {1, 0}}}}, .restitution = 0});
    run(world, 0.1, 1.0 / 60);
    ASSERT_EQ(world.contacts(crates).back().shapes.b.shape, 1u);
    Body one = world.body(crates);
    one.shapes.resize(1);
    world.set(crates, one);
    ASSERT_FALSE(world.contacts(crates).empty());
    for (const ContactPoint& c : world.contacts(crates)) EXPECT_EQ(c.shapes.b.shape, 0u);
}

TEST(ContactToldWhereNoneHadBeen, AtAWallThatIsGoneIsNotTold) {
    World world({.gravity = {0, -10}, .solver = SoftStep{}});
    const Body crate{.position = {0, 0.5}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0};
    const auto step = world.add(HalfPlane{.point = {0, -5}});
    world.add(HalfPlane{});
    world.add(crate);
    run(world, 0.1, 1.0 / 60);
    ASSERT_EQ(world.contacts().size(), 2u);
    ASSERT_EQ(world.contacts()[0].shapes.a.shape, 1u);
    world.remove(step);
    ASSERT_EQ(world.contacts().size(), 2u);
    EXPECT_EQ(world.contacts()[0].shapes.a.shape, 0u) << "the other one has its number now";
}

}  // namespace
}  // namespace carom
