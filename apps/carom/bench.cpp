// carom bench: what a scene costs, and which part of a step takes it.

#include <fmt/format.h>

#include <algorithm>
#include <carom/output.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "commands.hpp"
#include "report.hpp"

namespace carom::app {

namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::string scene;
    Overrides overrides;
    bool json = false;
};

/// Of the steps that were made.
struct Cost {
    std::vector<double> steps;  ///< [s]
    std::vector<StageTime> stages;
    double simulated = 0;  ///< [s]

    double total() const {
        double sum = 0;
        for (const double s : steps) sum += s;
        return sum;
    }
    double mean() const { return total() / static_cast<double>(steps.size()); }
    double median() const {
        std::vector<double> sorted = steps;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        return *middle;
    }
    double longest() const { return *std::max_element(steps.begin(), steps.end()); }
};

Cost measure(const Scene& scene, World& world) {
    const Plan plan = scene.plan();
    if (plan.duration <= 0) throw Error(fmt::format("bench: the duration must be > 0, got {} s", plan.duration));
    Progress progress(steps_of(plan), std::filesystem::path(scene.file()).stem().string());
    Cost cost;
    world.measure_stages(true);
    auto start = std::chrono::steady_clock::now();
    run(world, plan.duration, plan.step, [&](const World&) {
        cost.steps.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        progress.update(cost.steps.size());
        if (was_interrupted()) throw Error("interrupted", Error::Cause::run);
        start = std::chrono::steady_clock::now();
    });
    progress.finish();
    cost.stages = world.stage_times();
    cost.simulated = world.time();
    return cost;
}

std::string as_time(double seconds) {
    if (seconds >= 1) return fmt::format("{:.3g} s", seconds);
    return seconds >= 1e-3 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} µs", 1e6 * seconds);
}

void print(const Scene& scene, const World& world, const Cost& cost) {
    if (!scene.title().empty()) fmt::print("{}\n", scene.title());
    const auto threads = static_cast<std::uint64_t>(world.settings().threads);
    fmt::print("{}, {} of {:.6g} s, {}\n\n", counted(world.size(), "body", "bodies"),
               counted(cost.steps.size(), "step", "steps"), scene.plan().step, counted(threads, "thread", "threads"));
    fmt::print("  a step      {} on average, {} the median, {} the longest\n", as_time(cost.mean()),
               as_time(cost.median()), as_time(cost.longest()));
    fmt::print("  real time   {:.3g} s simulated in {}: {:.3g} times as fast\n", cost.simulated, as_time(cost.total()),
               cost.simulated / cost.total());
    if (!std::holds_alternative<SoftStep>(world.settings().solver)) return;  // no part has a name there
    fmt::print("\n  {:<18} {:>10} {:>7}\n", "part of a step", "time", "share");
    for (const StageTime& stage : cost.stages) {
        if (stage.seconds < 5e-4 * cost.total()) continue;
        fmt::print("  {:<18} {:>10} {:>6.1f}%\n", stage.stage,
                   as_time(stage.seconds / static_cast<double>(cost.steps.size())), 100 * stage.seconds / cost.total());
    }
}

Json json_of(const Scene& scene, const World& world, const Cost& cost) {
    Json stages = Json::object();
    for (const StageTime& stage : cost.stages)
        stages[std::string(stage.stage)] = stage.seconds / static_cast<double>(cost.steps.size());
    return {{"scene", scene.file()},
            {"bodies", world.size()},
            {"threads", world.settings().threads},
            {"steps", cost.steps.size()},
            {"mean_step", cost.mean()},
            {"median_step", cost.median()},
            {"longest_step", cost.longest()},
            {"simulated", cost.simulated},
            {"wall", cost.total()},
            {"stages", stages}};
}

int bench_scene(const Arguments& a) {
    const Scene scene = load(a.scene, a.overrides);
    World world = scene.world();
    const Cost cost = measure(scene, world);
    if (a.json)
        fmt::print("{}\n", json_of(scene, world, cost).dump(2, ' ', false, Json::error_handler_t::replace));
    else
        print(scene, world, cost);
    return 0;
}

}  // namespace

void add_bench(CLI::App& program, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command =
        program.add_subcommand("bench", "Measure what a scene costs, and which part of a step takes it");
    add_scene(*command, a->scene, a->overrides);
    command->add_flag("--json", a->json, "print one JSON object, in seconds, and nothing else");
    command->footer(
        "Steps alone are timed, with nothing written or drawn. Parts of a step are told under 'softstep'.\n"
        "examples:\n"
        "  carom bench scenes/contacts/pyramid.json\n"
        "  carom bench scenes/gas.json --threads 2 --json");
    command->callback([a, &status] { status = bench_scene(*a); });
}

}  // namespace carom::app
