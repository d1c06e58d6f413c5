// A body that touches so many others that its contacts find no colours: they are solved one by one.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "simd/isa.hpp"

namespace carom {
namespace {

class Hub : public testing::Test {
  protected:
    ~Hub() override { use_isa({}); }
};

constexpr int spokes = 100;

/// A disc that attracts smaller ones all around it, which strike it on one side harder than on the other.
World hub() {
    World world({.solver = SoftStep{.sleep = false}});
    world.add(Attraction{.strength = 1});
    world.add(Body{.mass = 10, .radius = 1, .restitution = 0, .friction = 0.5});
    for (int i = 0; i < spokes; ++i) {
        const double angle = 2 * 3.14159265358979 * i / spokes;
        const Vec2 out{std::cos(angle), std::sin(angle)};
        world.add(Body{.position = 1.0299 * out,
                       .velocity = -(0.1 + 0.001 * i) * out,
                       .mass = 1,
                       .radius = 0.03,
                       .restitution = 0,
                       .friction = 0.5});
    }
    return world;
}

// With eight lanes two blocks are solved at once; of those of this list that shared a body one lost its push.
TEST_F(Hub, FeelsTheBlowOfEveryOneThatTouchesIt) {
    std::optional<std::uint64_t> hash;
    for (const Isa isa : available_isas()) {
        use_isa(isa);
        World world = hub();
        const Vec2 before = momentum(world);
        for (int k = 0; k < 30; ++k) world.step(1.0 / 60);
        ASSERT_GT(world.contacts().size(), 64U);  // more than there are colours
        // Rounding, of some 30 kg m/s that each body and its neighbours pass to one another in a step.
        EXPECT_NEAR(length(momentum(world) - before), 0, 1e-15 * 30 * spokes);
        EXPECT_EQ(hash.value_or(state_hash(world)), state_hash(world)) << "the same bits in all lanes";
        hash = state_hash(world);
    }
}

}  // namespace
}  // namespace carom
