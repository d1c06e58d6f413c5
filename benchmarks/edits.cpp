// What it costs to change something between two steps, as a game does in most of them: microseconds of a step with the
// edit before it, the median of 200, in a level of fixed tiles with crates that sleep, chains of ten that swing, and a
// car that drives on. Arguments: [TILES] [CRATES] [CHAINS], by default the worlds of docs/performance.md.

#include <algorithm>
#include <carom/carom.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <vector>

using namespace carom;

namespace {

constexpr double dt = 1.0 / 60;

struct Level {
    World world{{.gravity = {0, -10}, .solver = SoftStep{}, .threads = 1}};
    std::vector<BodyId> crates;
    BodyId car, lift;
    JointId wheel;
    ForceId<ConstantForce> thrust;

    Level(int tiles, int count, int chains) {
        for (int i = 0; i < tiles; ++i) {
            const Vec2 at{i % 500 + 0.5, -0.5 - i / 500};
            world.add(Body{.kind = Kind::fixed,
                           .position = at,
                           .shapes = {{.geometry = Box{}}},
                           .restitution = 0,
                           .friction = 0.6});
        }
        for (int i = 0; i < count; ++i) crates.push_back(world.add(part({40.0 + 2 * (i / 2), 0.5 + i % 2}, Box{1, 1})));
        for (int k = 0; k < chains; ++k) add_chain({40.0 * (k % 10), 30.0 + 20 * (k / 10)});
        car = world.add(part({5, 1}, Box{2, 0.5}));
        for (const double x : {4.2, 5.8}) {
            const BodyId rim = world.add(part({x, 0.4}, Disc{{}, 0.4}));
            wheel = world.add(Joint{.a = car,
                                    .b = rim,
                                    .at = Vec2{x, 0.4},
                                    .type = WheelJoint{.spring = JointSpring{.frequency = 4, .damping_ratio = 0.7},
                                                       .motor = JointMotor{.speed = -1, .maximum = 2}}});
        }
        lift = world.add(Body{.kind = Kind::driven, .position = {20, 20}, .shapes = {{.geometry = Box{}}}});
        thrust = world.add(ConstantForce{.body = car, .force = {0.1, 0}});
        run(world, 1, dt);
    }
    void add_chain(Vec2 at) {
        std::optional<BodyId> last;
        for (int i = 0; i < 10; ++i) {
            const BodyId next = world.add(part(at + Vec2{i + 0.5, 0}, Box{0.8, 0.2}));
            world.add(Joint{.a = last, .b = next, .at = at + Vec2{1.0 * i, 0}, .type = RevoluteJoint{}});
            last = next;
        }
    }
    static Body part(Vec2 at, const Geometry& geometry) {
        return {.position = at, .shapes = {{.geometry = geometry, .density = 1}}, .restitution = 0, .friction = 0.6};
    }
};

struct Edit {
    const char* name;
    std::function<void(Level&, int step)> make;
};

const Edit edits[] = {{"nothing", [](Level&, int) {}},
                      {"a ray from the car",
                       [](Level& l, int) {
                           const Vec2 from = l.world.position(l.car) + Vec2{0, 2};
                           if (!l.world.cast_ray(from, {30, -5})) throw Error("the ray meets the ground");
                       }},
                      {"a hundred rays from the car",
                       [](Level& l, int) {
                           const Vec2 from = l.world.position(l.car) + Vec2{0, 2};
                           for (int k = 0; k < 100; ++k)
                               if (!l.world.cast_ray(from, {0.3 * k, -5})) throw Error("the rays meet the ground");
                       }},
                      {"nothing, beside a sensor",
                       [](Level& l, int step) {
                           const Shape gate{.geometry = Box{1, 4}, .sensor = true};
                           if (step == 0) l.world.add(Body{.kind = Kind::fixed, .position = {30, 2}, .shapes = {gate}});
                       }},
                      {"an impulse on the car",
                       [](Level& l, int) {
                           l.world.apply_impulse(l.car, {0, 0.01}, l.world.position(l.car));
                       }},
                      {"the lift's velocity",
                       [](Level& l, int step) {
                           l.world.set_velocity(l.lift, {0, 1e-3 * step}, 0);
                       }},
                      {"a motor's speed",
                       [](Level& l, int step) {
                           Joint joint = l.world.joint(l.wheel);
                           std::get<WheelJoint>(joint.type).motor->speed = -1 - 1e-3 * step;
                           l.world.set(l.wheel, joint);
                       }},
                      {"a thrust",
                       [](Level& l, int step) {
                           l.world.set(l.thrust, ConstantForce{.body = l.car, .force = {1e-3 * step, 0}});
                       }},
                      {"a body added and removed",
                       [last = BodyId{}](Level& l, int step) mutable {
                           if (step > 0) l.world.remove(last);
                           last = l.world.add(Body{.position = {10, 30}, .radius = 0.3});
                       }},
                      {"the car's friction",
                       [](Level& l, int step) {
                           Body car = l.world.body(l.car);
                           car.friction = 0.5 + 1e-3 * step;
                           l.world.set(l.car, car);
                       }},
                      {"a push that wakes a crate", [](Level& l, int step) {
                           if (l.crates.empty()) return;
                           const BodyId crate = l.crates[static_cast<std::size_t>(step) % l.crates.size()];
                           l.world.apply_impulse(crate, {0.1, 0}, l.world.position(crate));
                       }}};

struct Size {
    int tiles, crates, chains;
};

double median_time(const Edit& edit, const Size& size) {
    using Clock = std::chrono::steady_clock;
    constexpr int steps = 200;
    Level level(size.tiles, size.crates, size.chains);
    std::vector<double> times;
    for (int step = 0; step < steps; ++step) {
        const auto start = Clock::now();
        edit.make(level, step);
        level.world.step(dt);
        times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
    std::nth_element(times.begin(), times.begin() + steps / 2, times.end());
    return times[steps / 2];
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<Size> worlds{{200, 50, 0}, {2000, 500, 0}, {10000, 0, 0}, {200, 0, 100}};
    const auto given = [&](int k) { return argc > k ? std::atoi(argv[k]) : 0; };
    if (argc > 1) worlds = {{given(1), given(2), given(3)}};
    std::printf("| changed |");
    for (const auto& [tiles, crates, chains] : worlds)
        std::printf(" %d tiles, %d crates, %d chains |", tiles, crates, chains);
    std::printf("\n|---|");
    for (std::size_t i = 0; i < worlds.size(); ++i) std::printf("---|");
    for (const Edit& edit : edits) {
        std::printf("\n| %s |", edit.name);
        for (const Size& size : worlds) std::printf(" %.0f |", median_time(edit, size));
        std::fflush(stdout);
    }
    std::printf("\n");
}
