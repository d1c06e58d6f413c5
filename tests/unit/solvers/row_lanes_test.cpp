// Rows of contacts are written in lanes: each as if it were alone, whatever the instruction set.
#include <gtest/gtest.h>

#include <carom/random.hpp>
#include <cstring>

#include "simd/isa.hpp"
#include "solvers/soft_step.hpp"

namespace carom {
namespace {

class RowLanes : public testing::Test {
  protected:
    ~RowLanes() override { use_isa({}); }
};

/// Contacts of all kinds in one block: with walls and without, of one point, of two and of none that is near.
struct Scene {
    Random random;
    Bodies bodies;
    SoftContacts contacts;

    double number() { return random.uniform(-2, 2); }
    Vec2 vector() { return {number(), number()}; }

    explicit Scene(std::uint64_t seed) : random(seed) {
        constexpr std::uint32_t count = 2 * block_rows;
        bodies.id.resize(count), bodies.inverse_inertia.resize(count);
        contacts.motion.movers.resize(count + 1), contacts.motion.frames.resize(count + 1);
        for (std::uint32_t i = 0; i < count; ++i) {
            // Some are fixed, and some do not turn.
            contacts.motion.movers[i] = {0, 0, 0, i % 5 == 0 ? 0 : random.uniform(0.1, 3)};
            bodies.inverse_inertia[i] = i % 5 == 0 || i % 7 == 0 ? 0 : random.uniform(0.1, 3);
            contacts.motion.frames[i] = frame_at(vector(), number());
        }
        contacts.layout.blocks.resize(2);
        for (std::uint32_t k = 0; k < block_rows; ++k) contacts.all.push_back(contact(k, count));
    }
    SoftContact contact(std::uint32_t k, std::uint32_t ground) {
        SoftContact c{.a = k % 3 == 2 ? ground : 2 * k, .b = 2 * k + 1, .row = k, .at_wall = k % 3 == 2};
        c.size = random.uniform(0.1, 1), c.thickness = c.size;
        c.crowded = k % 2 == 0, c.restitution = 0.25;
        c.friction = random.uniform(0, 1), c.surface_speed = number(), c.rolling = random.uniform(0, 1);
        c.radius_a = random.uniform(0, 1), c.radius_b = random.uniform(0, 1);
        c.manifold.normal = frame_at({}, number()).turn({1, 0});
        c.manifold.count = static_cast<int>(k % 4 == 3 ? 0 : 1 + k % 2);
        c.manifold.corners = k % 4 == 0;
        for (int i = 0; i < 2; ++i) {
            c.manifold.point[i] = {vector(), vector(), number(), 0};
            c.normal_force[i] = number(), c.tangent_force[i] = number(), c.rolling_moment[i] = number();
        }
        return c;
    }
};

TEST_F(RowLanes, AreThoseOfEachContactAloneToTheBit) {
    Scene scene(7);
    SoftContacts& contacts = scene.contacts;
    ContactBlock &alone = contacts.layout.blocks[0], &lanes = contacts.layout.blocks[1];
    constexpr BlockContacts in_order{0, 1, 2, 3, 4, 5, 6, 7};
    constexpr std::size_t numbers = sizeof(ContactBlock) - offsetof(ContactBlock, normal_x);
    for (const std::uint32_t points : {1U, 2U})
        for (const Isa which : available_isas()) {
            use_isa(which);
            alone = lanes = ContactBlock{};
            alone.points = lanes.points = points;
            RowKinds kinds;
            for (const SoftContact& c : contacts.all) {
                fill_row(scene.bodies, c, contacts.motion.frames[c.a], contacts.motion.frames[c.b], contacts);
                lanes.a[c.row] = c.a, lanes.b[c.row] = c.b;
                note_row(c, kinds);
            }
            contact_kernel().write_block(row_source(scene.bodies, contacts), in_order.data(), kinds, lanes);
            EXPECT_EQ(0, std::memcmp(alone.normal_x, lanes.normal_x, numbers)) << points;
        }
}

// A contact that lost its points within a step turned both bodies by what these had borne, in each substep that was
// left of it, and nobody booked it: its row kept their forces.
TEST_F(RowLanes, KeepNothingOfPointsThatAreNoMore) {
    Scene scene(7);
    ContactBlock& block = scene.contacts.layout.blocks[0];
    const auto write = [&](int points) {
        block.points = 2;
        for (SoftContact c : scene.contacts.all) {
            c.manifold.count = points;
            if (points == 0) c.manifold = {};
            fill_row(scene.bodies, c, scene.contacts.motion.frames[c.a], scene.contacts.motion.frames[c.b],
                     scene.contacts);
        }
    };
    for (const int left : {0, 1}) {
        block = ContactBlock{}, write(left);
        const ContactBlock blank = block;
        write(2), write(left);
        constexpr std::size_t numbers = sizeof(ContactBlock) - offsetof(ContactBlock, normal_x);
        EXPECT_EQ(0, std::memcmp(block.normal_x, blank.normal_x, numbers)) << left;
    }
}

/// A block of contacts that bear nothing yet, and their movers, after a substep's sweeps.
struct Swept {
    ContactBlock block;
    std::vector<Mover> movers;
    ContactSums sums{};

    Swept(const Scene& scene, bool is_idle)
        : block(scene.contacts.layout.blocks[0]), movers(scene.contacts.motion.movers) {
        constexpr double h = 1.0 / 240;
        const ContactKernel& kernel = contact_kernel();
        const Softness soft = softness(h, h);
        const HalfBegin half{h, frames(scene.contacts.motion), h, 0, nullptr, false};
        block.is_idle = is_idle;
        for (const HalfBegin* begin : {&half, static_cast<const HalfBegin*>(nullptr)})
            kernel.solve(&block, 1, movers.data(), soft, begin);
        for (const HalfBegin* begin : {&half, static_cast<const HalfBegin*>(nullptr)})
            kernel.relax(&block, 1, movers.data(), soft, begin);
        sums = kernel.settle(&block, 1, movers.data(), h);
    }
};

// Of a block in which nothing presses a sweep only asks whether anything comes near: that is to change nothing.
TEST_F(RowLanes, ThatAreIdleAreSolvedLikeOthersWhereTheyAreStruck) {
    int idle = 0, struck = 0;
    for (int trial = 0; trial < 200; ++trial) {
        Scene scene(static_cast<std::uint64_t>(trial));
        ContactBlock& block = scene.contacts.layout.blocks[0];
        block.points = 1 + trial % 2;
        for (SoftContact& c : scene.contacts.all) {
            for (int i = 0; i < 2; ++i) c.normal_force[i] = c.tangent_force[i] = c.rolling_moment[i] = 0;
            fill_row(scene.bodies, c, scene.contacts.motion.frames[c.a], scene.contacts.motion.frames[c.b],
                     scene.contacts);
        }
        block.any_rolling = block.any_belt = true;
        for (auto& more : block.more)  // all of them, or all but a few, touch nothing in this substep
            for (double& open : more.open)
                if (scene.random.uniform(0, 1) < 0.9) open = 1;
        for (Mover& m : scene.contacts.motion.movers)
            if (m.inverse_mass > 0) m.vx = scene.number(), m.vy = scene.number(), m.w = scene.number();
        for (const Isa which : available_isas()) {
            use_isa(which);
            const Swept as_idle(scene, true), as_others(scene, false);
            for (std::size_t i = 0; i < as_idle.movers.size(); ++i) {
                EXPECT_EQ(as_idle.movers[i].vx, as_others.movers[i].vx);
                EXPECT_EQ(as_idle.movers[i].vy, as_others.movers[i].vy);
                EXPECT_EQ(as_idle.movers[i].w, as_others.movers[i].w);
            }
            for (std::uint32_t i = 0; i < block.points; ++i)
                for (std::size_t k = 0; k < block_rows; ++k) {
                    EXPECT_EQ(as_idle.block.more[i].normal_force[k], as_others.block.more[i].normal_force[k]);
                    EXPECT_EQ(as_idle.block.more[i].tangent_force[k], as_others.block.more[i].tangent_force[k]);
                }
            EXPECT_EQ(as_idle.sums.slip_work, as_others.sums.slip_work);
            EXPECT_EQ(as_idle.sums.landing_work, as_others.sums.landing_work);
            EXPECT_EQ(as_idle.block.is_idle, as_others.block.is_idle);  // both know in the end
            ++(as_idle.block.is_idle ? idle : struck);
        }
    }
    EXPECT_GT(idle, 50);
    EXPECT_GT(struck, 50);
}

}  // namespace
}  // namespace carom
