// A load just above what is worth a precise solve was solved so in one step, and swept in the next two, in which it
// sank until it was enough again: a stack of ten trembled for ever and made 1 J a second.
#include "physics/contacts.hpp"

namespace carom::test {
namespace {

class StackAtTheEdge : public testing::TestWithParam<std::pair<int, int>> {};  // boxes, substeps
INSTANTIATE_TEST_SUITE_P(Loads, StackAtTheEdge,
                         testing::Values(std::pair{10, 8}, std::pair{8, 7}, std::pair{12, 9}, std::pair{14, 10}));

TEST_P(StackAtTheEdge, Rests) {
    const auto [count, substeps] = GetParam();
    World world = floor_world(0.6, {.substeps = substeps});
    for (int i = 0; i < count; ++i) world.add(box({0, 0.5 + i + 1e-4 * (i + 1)}, 1, 1, 0.6));
    run(world, 4, frame);
    const double heat = energy(world).heat.total();
    run(world, 4, frame);
    EXPECT_TRUE(world.asleep(world.ids()[0]));
    EXPECT_EQ(energy(world).heat.total(), heat);
}

}  // namespace
}  // namespace carom::test
