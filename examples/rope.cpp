// A rope between two walls comes to rest as a catenary, y = a cosh(x/a).
#include <carom/carom.hpp>
#include <cmath>
#include <cstdio>

int main() {
    using namespace carom;
    constexpr double half_span = 1, half_length = 1.25;
    World world({.gravity = {0, -9.81}});
    // It starts taut, so that no spring is pressed; a driven body then brings its end nearer.
    const BodyId hand = world.add(Body{.kind = Kind::driven, .position = {half_length, 0}, .velocity = {-0.1, 0}});
    const Built rope =
        build(world, Rope{.b = hand, .anchor_a = {-half_length, 0}, .segments = 40, .mass = 0.5, .stiffness = 5000});
    world.add(Drag{.linear = 0.05});  // so that it comes to rest
    run(world, 2 * (half_length - half_span) / 0.1, 0.01);
    world.set_velocity(hand, {0, 0}, 0);
    run(world, 20, 0.01);

    // a sinh(half_span/a) = half_length, by Newton's method; the sag follows.
    double a = 1;
    for (int i = 0; i < 20; ++i) {
        const double s = half_span / a;
        a -= (a * std::sinh(s) - half_length) / (std::sinh(s) - s * std::cosh(s));
    }
    const double sag = a * (std::cosh(half_span / a) - 1);
    const double lowest = -world.position(rope.bodies[20]).y;
    const Energy e = energy(world);
    std::printf("sag %.4f m, catenary %.4f m\n", lowest, sag);
    std::printf("fell by %.6f J, the hand took %.6f J, heat %.6f J, residual %.1e J\n", -e.gravity, -e.work.driven,
                e.heat.total(), e.residual);
    const bool right = std::abs(lowest - sag) < 0.002 * sag && e.kinetic < 1e-6 && std::abs(e.residual) < 1e-3;
    return right ? 0 : 1;
}
