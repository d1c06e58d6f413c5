#include "experiment.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>

namespace carom::app {

namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

void handle_interrupts() {
    std::signal(SIGINT, [](int) {
        interrupted = true;
        std::signal(SIGINT, SIG_DFL);
    });
}

Scene load(const std::filesystem::path& file, const Overrides& o) {
    Scene scene = Scene::load(file);
    for (const std::string& assignment : o.set) {
        const auto equals = assignment.find('=');
        if (equals == std::string::npos || equals == 0)
            throw Error(fmt::format("--set {}: must be name=value", assignment));
        scene.set(assignment.substr(0, equals), assignment.substr(equals + 1));
    }
    if (!o.integrator.empty()) scene.set("world.integrator", o.integrator);
    if (!o.solver.empty()) scene.set("world.solver", o.solver);
    if (o.duration) scene.set("run.duration", fmt::format("{}", *o.duration));
    if (o.step) scene.set("run.step", fmt::format("{}", *o.step));
    if (o.every) scene.set("run.every", fmt::format("{}", *o.every));
    if (o.threads) scene.set("world.threads", fmt::format("{}", *o.threads));
    return scene;
}

bool Result::ok() const {
    for (const Verdict& v : verdicts)
        if (!v.ok) return false;
    return true;
}

Result run(const Scene& scene, const std::string& label, const std::vector<Observer>& observers) {
    Result result{scene.world(), scene.plan(), {}};
    const Plan& plan = result.plan;
    Judge judge(scene, result.world);
    for (const Observer& observe : observers) observe(result.world);

    const auto steps = static_cast<std::uint64_t>(std::ceil(plan.duration / plan.step * (1 - 1e-12)));
    Progress progress(steps, label);
    std::uint64_t done = 0;
    const auto start = std::chrono::steady_clock::now();
    struct Stop {};
    try {
        carom::run(result.world, plan.duration, plan.step, [&](const World& world) {
            ++done;
            judge.observe(world);
            if (done % static_cast<std::uint64_t>(plan.every) == 0 || done == steps)
                for (const Observer& observe : observers) observe(world);
            progress.update(done);
            if (interrupted) throw Stop{};
        });
    } catch (Stop) {
        result.interrupted = true;
    }
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.verdicts = judge.verdicts();
    return result;
}

}  // namespace carom::app
