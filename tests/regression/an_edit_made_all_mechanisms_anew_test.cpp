// A body thrown into a world of a thousand ragdolls made a step twice as long, as did a force, or a joint that keeps
// two from colliding: all mechanisms were made anew, though none of them had changed.

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "solvers/mechanism.hpp"

namespace carom {
namespace {

/// Ten chains of three bodies each.
class Chains : public testing::Test {
  protected:
    Chains() {
        for (int chain = 0; chain < 10; ++chain) {
            std::optional<BodyId> last;
            for (int i = 0; i < 3; ++i) {
                const BodyId next = add_body(5.0 * chain + i);
                if (last) join(*last, next);
                last = next;
            }
        }
        made();
    }
    BodyId add_body(double x) { return bodies.add({.position = {x, 0}, .moment_of_inertia = 1}, state); }
    void join(BodyId a, BodyId b) {
        add(mechanisms, JointId{++joints}, {.a = a, .b = b, .anchor_a = {1, 0}, .type = RevoluteJoint{}});
    }
    /// How many of the chains lie where they lay in memory, after the next assembly.
    std::ptrdiff_t made() {
        const std::vector<Mechanism>& all = mechanisms.all;
        const auto place = [](const Mechanism& m) { return m.parts.data(); };
        std::vector<const Mechanism::Part*> before;
        std::transform(all.begin(), all.end(), std::back_inserter(before), place);
        assemble(mechanisms, bodies, state.x);
        order_awake(mechanisms);
        return std::count_if(all.begin(), all.end(), [&](const Mechanism& m) {
            return std::find(before.begin(), before.end(), place(m)) != before.end();
        });
    }

    Bodies bodies;
    State state;
    Mechanisms mechanisms;
    std::uint32_t joints = 0;
};

TEST_F(Chains, StayAsTheyAreWhenABodyComes) {
    add_body(-10);
    EXPECT_EQ(made(), 10);
}
TEST_F(Chains, AreMadeAnewWhereTheyChange) {
    join(bodies.id[0], bodies.id[3]);  // two become one
    EXPECT_EQ(made(), 8);
    erase(mechanisms, 3);  // of the third one
    EXPECT_EQ(made(), 8);
    note_change(mechanisms, mechanisms.joints.size() - 2);  // of the last
    EXPECT_EQ(made(), 8);
}

}  // namespace
}  // namespace carom
