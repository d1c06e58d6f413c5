#include <carom/analysis.hpp>
#include <fmt/format.h>

#include <cmath>

#include "commands.hpp"
#include "pictures.hpp"
#include "report.hpp"

namespace carom::app {

namespace {

namespace fs = std::filesystem;

struct Row {
    std::string scene, quantity;
    double expected, value, tolerance;
    bool ok;
};

/// Where the scenes are: here, or where this program was built or installed from.
fs::path scenes_folder(const std::string& given) {
    for (const fs::path& folder : {fs::path(given), fs::path("scenes"), fs::path(CAROM_SCENES)})
        if (!folder.empty() && fs::exists(folder / "gas.json")) return folder;
    throw Error("the tour's scenes are not to be found; name their folder with --scenes");
}

Result tour_scene(const fs::path& file, const fs::path& out, std::vector<Row>& rows) {
    const std::string name = file.stem().string();
    const Scene scene = Scene::load(file);
    const fs::path folder = out / name;
    make_folder(folder);
    const World start = scene.world();
    TrajectoryCsv csv(folder / "trajectory.csv", start);
    Pictures pictures(scene, start);
    Result result = run(scene, name, {[&, first = true](const World& world) mutable {
                                          csv.add(world);
                                          if (!first) pictures.observe(world);
                                          first = false;
                                      }});
    csv.commit();
    pictures.draw(folder, "png");
    draw(result.world, fit(join(bounds(start), bounds(result.world))), folder / "end.png");
    File report(folder / "report.json");
    report.write(report_json(file.string(), scene, result) + "\n");
    report.commit();
    for (const Verdict& v : result.verdicts) {
        const Expectation& x = v.expectation;
        rows.push_back({name, x.text.empty() ? x.quantity : x.text, x.value, v.value,
                        x.relative ? x.tolerance * std::abs(x.value) : x.tolerance, v.ok});
    }
    return result;
}

/// The textbook's pendulum without damping, under every integrator: how much energy each creates or loses.
void compare_integrators(const fs::path& scene_file, const fs::path& out) {
    fmt::print("\nThe spring pendulum without damping, {} s under every integrator\n", 60);
    fmt::print("  {:<18}{:>24}{:>14}\n", "integrator", "worst energy error [J]", "time [ms]");
    Csv table(out / "integrators.csv", {{"integrator", ""}, {"worst energy error", "J"}, {"wall time", "s"}});
    const auto names = []<std::size_t... k>(std::index_sequence<k...>) {
        return std::vector<std::string>{std::variant_alternative_t<k, Integrator>::name...};
    }(std::make_index_sequence<std::variant_size_v<Integrator>>{});
    for (const std::string& name : names) {
        Scene scene = Scene::load(scene_file);
        scene.set("world.integrator", name);
        scene.set("damping", "0");
        scene.set("run.duration", "60");
        scene.set("expects", "[]");
        double worst = 0;
        const Result result = run(scene, name, {[&](const World& world) { worst = std::max(worst, std::abs(energy(world).residual())); }});
        fmt::print("  {:<18}{:>24.2e}{:>14.2f}\n", name, worst, 1e3 * result.wall_seconds);
        table.row(name, worst, result.wall_seconds);
    }
    table.commit();
}

bool print_table(const std::vector<Row>& rows) {
    bool all = true;
    fmt::print("\n  {:<18}{:<46}{:>16}{:>20}{:>10}{:>10}\n", "scene", "quantity", "expected", "came out", "off by", "allowed");
    for (const Row& r : rows) {
        fmt::print("{} {:<18}{:<46}{:>16.9g}{:>20.12g}{:>10.1e}{:>10.1e}\n", r.ok ? " " : "!", r.scene, r.quantity.substr(0, 45), r.expected,
                   r.value, std::abs(r.value - r.expected), r.tolerance);
        all = all && r.ok;
    }
    return all;
}

}  // namespace

void add_tour(CLI::App& program, int& status) {
    struct Arguments {
        std::string scenes, out = "out/tour";
    };
    auto a = std::make_shared<Arguments>();
    CLI::App* command = program.add_subcommand("tour", "Run the textbook's scenes; write pictures and data; compare with what is expected");
    command->add_option("--scenes", a->scenes, "folder of the scenes; if absent they are looked for");
    command->add_option("--out", a->out, "folder of pictures and data")->capture_default_str();
    command->callback([a, &status] {
        const fs::path scenes = scenes_folder(a->scenes), out = a->out;
        std::vector<Row> rows;
        fmt::print("{:<22}{:>8}{:>10}{:>12}{:>16}\n", "scene", "bodies", "steps", "wall [s]", "residual [J]");
        for (const char* name : {"projectiles", "spring-pendulum", "gas", "rope", "cloth", "rotation", "driven"}) {
            const Result result = tour_scene(scenes / fmt::format("{}.json", name), out, rows);
            fmt::print("{:<22}{:>8}{:>10}{:>12.3f}{:>16.2e}\n", name, result.world.size(), result.world.steps(), result.wall_seconds,
                       energy(result.world).residual());
            if (std::string_view(name) == "gas") fmt::print("Final kinetic energy: {:.3f}\n", energy(result.world).kinetic);
        }
        compare_integrators(scenes / "spring-pendulum.json", out);
        const bool all = print_table(rows);
        fmt::print("\n{} of {} as expected. Pictures and data are in {}\n", std::count_if(rows.begin(), rows.end(), [](const Row& r) { return r.ok; }),
                   rows.size(), out.string());
        status = all ? 0 : 1;
    });
}

}  // namespace carom::app
