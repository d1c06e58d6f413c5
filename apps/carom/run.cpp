// carom run and plot: a scene is run, and judged.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "products.hpp"
#include "report.hpp"

namespace carom::app {

namespace {

struct Arguments {
    std::vector<std::string> scenes;
    Overrides overrides;
    Products products;
    std::string csv, out;
    bool json = false;
};

std::string label_of(const Scene& scene) { return std::filesystem::path(scene.file()).stem().string(); }

int run_scene(Arguments& a) {
    const Scene scene = load(a.scenes[0], a.overrides);
    a.products.csv = a.csv;
    a.products.folder = a.out;
    a.products.report = !a.out.empty();
    const auto [result, files] = perform(scene, label_of(scene), a.products);
    if (a.json) {
        fmt::print("{}\n", report_json(scene, result));
    } else {
        print_report(scene, result);
        for (const auto& file : files) fmt::print("wrote {}\n", file.string());
    }
    return status_of(result);
}

int plot_scene(Arguments& a) {
    const Scene scene = load(a.scenes[0], a.overrides);
    a.products.folder = a.out;
    const auto [result, files] = perform(scene, label_of(scene), a.products);
    for (const auto& file : files) fmt::print("{}\n", file.string());
    return result.failure.empty() && !result.interrupted ? 0 : status_of(result);
}

/// One line a scene; a wrong one does not keep the others from being run.
int judge_scene(const std::string& file, const Overrides& overrides) {
    try {
        const Scene scene = load(file, overrides);
        const Result result = run(scene, scene.world(), label_of(scene), {});
        std::size_t met = 0;
        for (const Verdict& v : result.verdicts) met += v.ok;
        fmt::print("{:<4} {:<40} {:>3} of {:<3} as expected {:>9.3f} s\n", result.ok() ? "ok" : "FAIL", file, met,
                   result.verdicts.size(), result.wall_seconds);
        for (const Verdict& v : result.verdicts)
            if (!v.ok) print_verdict(v);
        return status_of(result);
    } catch (const Error& e) {
        fmt::print("FAIL {}\n", file);
        std::fflush(stdout);
        fmt::print(stderr, "carom: {}\n", e.what());
        return e.cause() == Error::Cause::input ? 2 : 1;
    }
}

int run_scenes(Arguments& a) {
    if (a.scenes.size() == 1) return run_scene(a);
    if (a.json || !a.csv.empty() || !a.out.empty()) throw Error("--json, --csv and --out are of one scene");
    int status = 0;
    for (const std::string& file : a.scenes) {
        status = std::max(status, judge_scene(file, a.overrides));
        if (was_interrupted()) break;
    }
    return status;
}

}  // namespace

void add_run(CLI::App& program, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command =
        program.add_subcommand("run", "Run a scene; print its energies and what it expected. Of several: a line each");
    add_scenes(*command, a->scenes, a->overrides);
    command->add_option("--csv", a->csv, "write every body's motion to this file")->type_name("FILE");
    command->add_option("--out", a->out, "write motion, pictures and report into this folder")->type_name("FOLDER");
    add_format(*command, a->products.format);
    command->add_flag("--json", a->json, "print one JSON object and nothing else");
    command->footer(
        "examples:\n"
        "  carom run scenes/gas.json --duration 20 --csv gas.csv --every 10\n"
        "  carom run scenes/spring-pendulum.json --integrator pefrl --step 1/100 --json\n"
        "  carom run scenes/projectiles.json --set speed=15 --set bodies.p30.mass=2 --out out\n"
        "  carom run scenes/*.json");
    command->callback([a, &status] { status = run_scenes(*a); });
}

void add_plot(CLI::App& program, int& status) {
    auto a = std::make_shared<Arguments>();
    a->out = "out";
    CLI::App* command = program.add_subcommand("plot", "Run a scene and draw its pictures; print the files made");
    add_scene(*command, a->scenes.emplace_back(), a->overrides);
    command->add_option("--out", a->out, "folder of the pictures")->type_name("FOLDER")->capture_default_str();
    add_format(*command, a->products.format);
    command->footer("example:\n  carom plot scenes/spring-pendulum.json --out out --format pdf");
    command->callback([a, &status] { status = plot_scene(*a); });
}

}  // namespace carom::app
