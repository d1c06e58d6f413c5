// How the cost of a body grows with their number, from 1e3 to 1e6: discs that fall, boxes that fall, and a pile of
// discs at rest that nothing puts to sleep, in columns of a hundred; and up to 1e5 boxes that sleep, alone, with a disc
// that rolls beside them, and with one that runs into them. `growth 1e5` up to that number, `growth 1e5 sleepers` of
// these alone.

#include <malloc.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

using namespace carom;

namespace {

using Clock = std::chrono::steady_clock;
constexpr double dt = 1.0 / 60;
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
    for (int k = 0; k < 4; ++k) world.step(dt);
    const int steps = std::clamp(3000000 / count, 3, 30);  // what falls does not land in that time
    start = Clock::now();
    for (int k = 0; k < steps; ++k) world.step(dt);
    const double step = since(start) / steps;
    std::printf("| %s | %.0e | %d | %.3f | %.3f | %.2f | %zu | %.0f |\n", kind.name, double(count), threads,
                created * 1e3, step * 1e3, step * 1e6 / count, world.contacts().size(), (memory() - before) / count);
    std::fflush(stdout);
}

/// Boxes of 1 m in stacks of two, on floors above one another, when all sleep.
World sleeping(int count, int threads) {
    constexpr int stacks = 200;  // on a floor
    World world({.gravity = {0, -10}, .solver = SoftStep{}, .threads = threads});
    std::vector<Shape> floors;
    for (int k = 0; 2 * stacks * k < count; ++k) floors.push_back({.geometry = Box{400, 1, {150, 4.0 * k - 0.5}}});
    world.add(Body{.kind = Kind::fixed, .shapes = floors, .friction = 0.6});
    for (int k = 0; k < count; ++k)
        world.add(Body{.position = {1.5 * (k / 2 % stacks), 4.0 * (k / 2 / stacks) + 0.5 + k % 2},
                       .shapes = {{.geometry = Box{1, 1}, .density = 1}},
                       .restitution = 0,
                       .friction = 0.6});
    const auto is_awake = [&](BodyId id) { return !world.asleep(id); };
    const auto ids = world.ids().subspan(1);
    for (int k = 0; k < 600 && std::any_of(ids.begin(), ids.end(), is_awake); ++k) world.step(dt);
    return world;
}

void measure_sleepers(int count, int threads) {
    const double before = memory();
    const World start = sleeping(count, threads);
    const double taken = (memory() - before) / count;
    struct {
        const char* name;
        bool is_there;
        double from;  ///< the first stack begins at -0.5 m
    } const discs[] = {{"all sleep", false, 0}, {"and a disc rolls beside them", true, -30}, {"into them", true, -1.6}};
    for (const auto& [name, is_there, from] : discs) {
        World world = start;
        if (is_there)
            world.add(Body{.position = {from, 0.5},
                           .velocity = {5, 0},
                           .angular_velocity = -10,
                           .radius = 0.5,
                           .restitution = 0,
                           .friction = 0.6});
        for (int k = 0; k < 4; ++k) world.step(dt);
        constexpr int steps = 60;
        const auto begin = Clock::now();
        for (int k = 0; k < steps; ++k) world.step(dt);
        const double step = since(begin) / steps;
        std::printf("| %s | %.0e | %d | | %.4f | %.4f | %zu | %.0f |\n", name, double(count), threads, step * 1e3,
                    step * 1e6 / count, world.contacts().size(), taken);
        std::fflush(stdout);
    }
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
    const bool sleepers_alone = argc > 2 && std::strcmp(argv[2], "sleepers") == 0;
    for (double count = 1e3; count <= std::min(most, 1e5); count *= 10)
        for (const int threads : {1, 2}) measure_sleepers(static_cast<int>(count), threads);
    if (sleepers_alone) return 0;
    for (const Growing& kind : kinds)
        for (double count = 1e3; count <= most; count *= 10)
            for (const int threads : {1, 2}) measure(kind, static_cast<int>(count), threads);
}
