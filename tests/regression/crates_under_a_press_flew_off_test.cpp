// Two crates on one another under a press that comes down on them were asked to keep what nothing can: the precise
// solve pressed as hard as its contacts are stiff, 1e6 N s a substep, and the least tilt of a crate made 670 m/s of
// that under a press of 0.5 m/s, and threw crates of six columns through the walls, a kilometre far.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

/// What came of crates that a press came down on, and went up again.
struct Pressed {
    double fastest = 0;     ///< [m/s]
    bool is_inside = true;  ///< of the room
    double unaccounted = 0;
};

Pressed press(int columns, int rows, double speed) {
    constexpr double dt = 1.0 / 60;
    World world({.gravity = {0, -10}, .solver = SoftStep{}});
    const Side side{.restitution = 0};
    world.add(Rectangle{.low = {-4, 0}, .high = {4, 30}, .left = side, .right = side, .bottom = side});
    const double top = 1.1 * rows + 1, gap = 0.9 * rows;
    const BodyId plate = world.add(Body{.kind = Kind::driven,
                                        .position = {0, top + 0.5},
                                        .velocity = {0, -speed},
                                        .shapes = {{.geometry = Box{7.9, 1}}},
                                        .restitution = 0});
    std::vector<BodyId> crates;
    for (int i = 0; i < columns; ++i)
        for (int k = 0; k < rows; ++k)
            crates.push_back(world.add(Body{.position = {-3 + 1.1 * i + 0.01 * ((3 * i + k) % 3), 0.5 + 1.1 * k},
                                            .mass = 1 + 0.2 * ((i + k) % 3),
                                            .shapes = {{.geometry = Box{1, 1}}},
                                            .restitution = 0}));
    const int way = static_cast<int>((top - gap) / (speed * dt));
    Pressed out;
    for (int i = 0; i < 2 * way + 60; ++i) {
        if (i == way) world.set_velocity(plate, {0, speed}, 0);
        if (i == 2 * way) world.set_velocity(plate, {}, 0);
        world.step(dt);
        for (const BodyId id : crates) {
            const Vec2 x = world.position(id);
            out.fastest = std::max(out.fastest, length(world.velocity(id)));
            out.is_inside = out.is_inside && std::abs(x.x) < 4 && x.y > 0;
        }
    }
    out.unaccounted = energy(world).unaccounted();
    return out;
}

// Sweeps let crates sink into one another instead, as far as the press goes, and what then slips out is as fast as some
// tens of times the press.
TEST(CratesUnderAPress, StayInTheRoom) {
    for (const int columns : {1, 2, 6})
        for (const int rows : {1, 2, 3, 4})
            for (const double speed : {0.5, 1.0, 2.0, 4.0}) {
                const Pressed out = press(columns, rows, speed);
                const std::string where = std::to_string(columns) + " × " + std::to_string(rows) +
                                          " crates, press at " + std::to_string(speed) + " m/s";
                EXPECT_LT(out.fastest, 100) << where;
                EXPECT_TRUE(out.is_inside) << where;
                EXPECT_NEAR(out.unaccounted, 0, 1e-6) << where;
            }
}

}  // namespace
}  // namespace carom
