// How the cost of a body grows with their number, from 1e3 to 1e6: discs that fall, boxes that fall, and a pile of
// discs at rest that nothing puts to sleep, in columns of a hundred. `growth 1e5` up to that number.

#include <malloc.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace carom;

namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What is in use of it [bytes].
double memory() {
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

World empty(int threads) {
    SoftStep soft;
    soft.sleep = false;
    World world({.gravity = {0, -10}, .solver = soft, .threads = threads});
    world.add(HalfPlane{.side = {1, 0.5}});
    return world;
}

/// Bodies of 1 m in columns of up to a hundred.
void fill(World& world, int count, Vec2 pitch, double height, const Shape& shape, bool staggered) {
    constexpr int rows = 100;
    for (int k = 0; k < count; ++k) {
        const int row = k % rows, column = k / rows;
        const double aside = staggered && row % 2 ? 0.5 * pitch.x : 0;
        world.add(
            Body{.position = {column * pitch.x + aside, height + row * pitch.y}, .shapes = {shape}, .restitution = 0});
    }
}

struct Growing {
    const char* name;
    Shape shape;
    Vec2 pitch;
    double height;
    bool staggered;
};

void measure(const Growing& kind, int count, int threads) {
    const double before = memory();
    World world = empty(threads);
    auto start = Clock::now();
    fill(world, count, kind.pitch, kind.height, kind.shape, kind.staggered);
    const double created = since(start);
    constexpr double dt = 1.0 / 60;
    for (int k = 0; k < 4; ++k) world.step(dt);
    const int steps = std::clamp(3000000 / count, 3, 30);  // what falls does not land in that time
    start = Clock::now();
    for (int k = 0; k < steps; ++k) world.step(dt);
    const double step = since(start) / steps;
    std::printf("| %s | %.0e | %d | %.3f | %.3f | %.2f | %zu | %.0f |\n", kind.name, double(count), threads,
                created * 1e3, step * 1e3, step * 1e6 / count, world.contacts().size(), (memory() - before) / count);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const double most = argc > 1 ? std::atof(argv[1]) : 1e6;
    const Shape disc{.geometry = Disc{{}, 0.5}, .density = 1}, box{.geometry = Box{0.9, 0.9}, .density = 1};
    const Growing kinds[] = {
        {"discs fall", disc, {1.1, 1.1}, 5, true},
        {"boxes fall", box, {1.1, 1.1}, 5, true},
        {"pile of discs", disc, {1, std::sqrt(0.75)}, 0.5, true},
    };
    std::printf(
        "| scene | bodies | threads | created [ms] | step [ms] | a body [µs] | contact points | memory [B a body] |\n");
    std::printf("|---|---|---|---|---|---|---|---|\n");
    for (const Growing& kind : kinds)
        for (double count = 1e3; count <= most; count *= 10)
            for (const int threads : {1, 2}) measure(kind, static_cast<int>(count), threads);
}
