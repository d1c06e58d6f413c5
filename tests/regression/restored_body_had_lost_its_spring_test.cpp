// A body that was removed was there again in a state from before, but its spring was not, without a word: forces are
// not saved. Of joints that was an Error.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "error_of.hpp"
#include "restored.hpp"

namespace carom::test {
namespace {

TEST(RestoredBody, IsAnErrorWithoutTheForcesThatItHad) {
    World world;
    const BodyId post = world.add(Body{.kind = Kind::fixed});
    const BodyId ball = world.add(Body{.position = {2, 0}, .radius = 0.1});
    world.add(Spring{.a = post, .b = ball, .stiffness = 10, .rest_length = 1});
    const std::string before = saved(world);
    world.remove(ball);
    const auto hash = state_hash(world);
    const auto restore = [&] {
        Loader from(before);
        world.restore(from);
    };
    EXPECT_EQ(error_of(restore),
              "the state has 1 springs, and this world 0: it has to be made as the one that was saved");
    EXPECT_EQ(state_hash(world), hash);
    EXPECT_FALSE(world.contains(ball));
}

TEST(RestoredBody, GoesWithTheForcesOfOneThatCameLater) {
    World world;
    const BodyId post = world.add(Body{.kind = Kind::fixed});
    const std::string before = saved(world);
    world.add(Spring{.a = post, .b = world.add(Body{}), .stiffness = 10, .rest_length = 1});
    Loader from(before);
    world.restore(from);
    EXPECT_TRUE(world.springs().empty());
}

}  // namespace
}  // namespace carom::test
