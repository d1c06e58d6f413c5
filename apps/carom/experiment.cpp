#include "experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <carom/output.hpp>
#include <chrono>
#include <cmath>
#include <csignal>

namespace carom::app {

namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void apply(Scene& scene, const Override& o) {
    if (!o.place.empty()) return scene.set(o.place, o.value);
    const auto equals = o.value.find('=');
    if (equals == std::string::npos || equals == 0) throw Error("must be NAME=VALUE");
    scene.set(o.value.substr(0, equals), o.value.substr(equals + 1));
}

}  // namespace

void handle_interrupts() {
    std::signal(SIGINT, [](int) {
        interrupted = true;
        std::signal(SIGINT, SIG_DFL);
    });
}

bool was_interrupted() { return interrupted; }

Scene load(const std::string& file, const Overrides& overrides) {
    Scene scene = Scene::load(file == "-" ? "/dev/stdin" : file);
    for (const Override& o : overrides) {
        try {
            apply(scene, o);
        } catch (const Error& e) {
            throw Error(fmt::format("{} {}: {}", o.option, o.value, e.what()));
        }
    }
    return scene;
}

bool Result::ok() const {
    return !interrupted && failure.empty() &&
           std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.ok; });
}

int status_of(const Result& result) {
    if (!result.failure.empty()) fmt::print(stderr, "carom: {}\n", result.failure);
    return result.ok() ? 0 : 1;
}

Result run(const Scene& scene, World start, const std::string& label, const std::vector<Observer>& observers) {
    const Plan plan = scene.plan();
    Result result{std::move(start)};
    Judge judge(scene, result.world);
    Twins twins(scene, result.world);
    for (const Observer& observe : observers) observe(result.world);

    const auto steps = static_cast<std::uint64_t>(std::ceil(plan.duration / plan.step * (1 - 1e-12)));
    Progress progress(steps, label);
    std::uint64_t done = 0;
    bool stepping = true;  // and not observing
    struct Stop {};
    const auto clock = std::chrono::steady_clock::now();
    try {
        carom::run(result.world, plan.duration, plan.step, [&](const World& world) {
            stepping = false;
            ++done;
            judge.observe(world);
            twins.observe(world);
            if (done % static_cast<std::uint64_t>(plan.every) == 0 || done == steps)
                for (const Observer& observe : observers) observe(world);
            progress.update(done);
            if (interrupted) throw Stop{};
            stepping = true;
        });
    } catch (Stop) {
        result.interrupted = true;
    } catch (const Error& e) {
        if (!stepping || e.cause() == Error::Cause::input) throw;
        result.failure = e.what();
    }
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    result.verdicts = judge.verdicts();
    result.twins = twins.errors();
    return result;
}

}  // namespace carom::app
