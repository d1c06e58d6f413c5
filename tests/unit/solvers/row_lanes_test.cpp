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
    Random random{7};
    Bodies bodies;
    SoftContacts contacts;

    double number() { return random.uniform(-2, 2); }
    Vec2 vector() { return {number(), number()}; }

    Scene() {
        constexpr std::uint32_t count = 2 * block_rows;
        bodies.id.resize(count), bodies.inverse_inertia.resize(count);
        contacts.movers.resize(count + 1), contacts.frames.resize(count + 1);
        for (std::uint32_t i = 0; i < count; ++i) {
            // Some are fixed, and some do not turn.
            contacts.movers[i] = {0, 0, 0, i % 5 == 0 ? 0 : random.uniform(0.1, 3)};
            bodies.inverse_inertia[i] = i % 5 == 0 || i % 7 == 0 ? 0 : random.uniform(0.1, 3);
            contacts.frames[i] = frame_at(vector(), number());
        }
        contacts.blocks.resize(2);
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
    Scene scene;
    SoftContacts& contacts = scene.contacts;
    ContactBlock &alone = contacts.blocks[0], &lanes = contacts.blocks[1];
    constexpr BlockContacts in_order{0, 1, 2, 3, 4, 5, 6, 7};
    constexpr std::size_t numbers = sizeof(ContactBlock) - offsetof(ContactBlock, normal_x);
    for (const std::uint32_t points : {1U, 2U})
        for (const Isa which : available_isas()) {
            use_isa(which);
            alone = lanes = ContactBlock{};
            alone.points = lanes.points = points;
            RowKinds kinds;
            for (const SoftContact& c : contacts.all) {
                fill_row(scene.bodies, c, contacts.frames[c.a], contacts.frames[c.b], contacts);
                lanes.a[c.row] = c.a, lanes.b[c.row] = c.b;
                note_row(c, kinds);
            }
            contact_kernel().write_block(row_source(scene.bodies, contacts), in_order.data(), kinds, lanes);
            EXPECT_EQ(0, std::memcmp(alone.normal_x, lanes.normal_x, numbers)) << points;
        }
}

}  // namespace
}  // namespace carom
