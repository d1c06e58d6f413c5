// Carom's part of benchmarks/web/run.mjs, for node: the scenes of scenes.mjs, a line of JSON for each.

#include <algorithm>
#include <carom/carom.hpp>
#include <chrono>
#include <cstdio>
#include <vector>

using namespace carom;

namespace {

World empty(bool statics = true) {
    SoftStep soft;
    soft.sleep = false, soft.statics = statics;
    return World({.gravity = {0, -10}, .solver = soft});
}

World pyramid(bool statics) {
    World world = empty(statics);
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
    for (int row = 0; row < 20; ++row)
        for (int k = 0; k < 20 - row; ++k)
            world.add(Body{.position = {k + 0.5 * row - 9.5, row + 0.5},
                           .shapes = {{.geometry = Box{1, 1}, .density = 1}},
                           .restitution = 0,
                           .friction = 0.5});
    return world;
}

World rain() {
    World world = empty();
    for (const Segment& wall : {Segment{{-10, 0}, {10, 0}}, Segment{{-10, 0}, {-10, 60}}, Segment{{10, 0}, {10, 60}}})
        world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = wall}}, .restitution = 0, .friction = 0.5});
    for (int k = 0; k < 2000; ++k) {
        const int row = k / 36;
        world.add(Body{.position = {k % 36 * 0.55 - 9.7 + 0.1 * (row % 2), 0.5 + 0.55 * row},
                       .shapes = {{.geometry = Disc{{}, 0.25}, .density = 1}},
                       .restitution = 0,
                       .friction = 0.5});
    }
    return world;
}

void measure(const char* name, World world, std::size_t steps) {
    using Clock = std::chrono::steady_clock;
    std::vector<double> times;
    double sum = 0;
    for (std::size_t k = 0; k < steps; ++k) {
        const auto start = Clock::now();
        world.step(1.0 / 60);
        times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        sum += times.back();
    }
    std::sort(times.begin(), times.end());
    double top = 0;
    for (const Vec2 x : world.positions()) top = std::max(top, x.y);
    std::printf("{\"scene\": \"%s\", \"median\": %g, \"mean\": %g, \"top\": %g}\n", name, times[steps / 2],
                sum / static_cast<double>(steps), top);
}

}  // namespace

int main() {
    measure("pyramid", pyramid(true), 300);
    measure("pyramid without statics", pyramid(false), 300);
    measure("rain", rain(), 600);
}
