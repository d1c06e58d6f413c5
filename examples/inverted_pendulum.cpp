// Kapitza's pendulum: a pivot that shakes fast enough holds a pendulum upside down. The pivot is driven along a curve,
// the rod is a stiff spring, and the air is a force of our own.
#include <carom/carom.hpp>
#include <cmath>
#include <cstdio>

/// How far from upright [rad] the pendulum is after ten seconds, and its energy.
std::pair<double, carom::Energy> swing(double shaking) {
    using namespace carom;
    constexpr double rod = 0.2, amplitude = 0.02, tilt = 0.2;
    World world({.gravity = {0, -9.81}, .integrator = Pefrl{}, .solver = NoContact{}});
    const BodyId pivot = world.add(Body{.kind = Kind::driven});
    const BodyId bob = world.add(Body{.position = {rod * std::sin(tilt), amplitude + rod * std::cos(tilt)}});
    world.drive(pivot, [=](double t) { return Pose{{0, amplitude * std::cos(shaking * t)}}; });
    world.add(Spring{.a = pivot, .b = bob, .stiffness = 1e6, .rest_length = rod});
    world.add(UserForce{"air", [](const Snapshot& now, std::span<Vec2> force, std::span<double>) {
                            for (std::size_t i = 0; i < force.size(); ++i) force[i] -= 0.5 * now.velocity[i];
                        }});
    run(world, 10, 1e-3);
    const Vec2 d = world.position(bob) - world.position(pivot);
    return {std::abs(std::atan2(d.x, d.y)), energy(world)};
}

int main() {
    // It stands if amplitude × shaking > √(2 g rod), here from 99 rad/s on.
    for (const double shaking : {60.0, 180.0}) {
        const auto [angle, e] = swing(shaking);
        std::printf("%3.0f rad/s: %.3f rad from upright; the pivot's work %.3f J, the air's %.3f J, residual %.1e J\n",
                    shaking, angle, e.work.driven, e.work.user, e.residual);
        if ((angle < 0.05) != (shaking > 99) || std::abs(e.residual) > 1e-3 * e.work.driven) return 1;
    }
    return 0;
}
