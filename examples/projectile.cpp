// A ball thrown at 45° comes down 2 vx vy / g away, and rises to vy² / 2g. Verlet is exact under gravity alone.
#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <cstdio>

int main() {
    using namespace carom;
    constexpr double g = 9.81, v = 10;
    World world({.gravity = {0, -g}});
    const BodyId ball = world.add(Body{.velocity = {v, v}});

    double highest = 0;
    const auto watch = [&](const World& now) { highest = std::max(highest, now.position(ball).y); };
    run(world, 2 * v / g, 0.01, watch);  // the last step is shortened, to end on time

    const Vec2 end = world.position(ball);
    std::printf("range  %.12f m, expected %.12f m\n", end.x, 2 * v * v / g);
    std::printf("height %.12f m, expected %.12f m\n", highest, v * v / (2 * g));
    // The highest point falls between two steps: it is missed by less than g h² / 8.
    const bool right = std::abs(end.x - 2 * v * v / g) < 1e-12 && std::abs(end.y) < 1e-12 &&
                       std::abs(highest - v * v / (2 * g)) < g * 1e-4 / 8;
    return right ? 0 : 1;
}
