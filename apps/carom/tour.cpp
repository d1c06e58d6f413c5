#include <fmt/format.h>

#include <algorithm>
#include <carom/output.hpp>
#include <cmath>
#include <memory>

#include "commands.hpp"
#include "products.hpp"
#include "report.hpp"

namespace carom::app {

namespace {

namespace fs = std::filesystem;

/// An expectation of one of the scenes, after its run.
struct Row {
    std::string scene;
    Verdict verdict;
};

/// Where the scenes are: here, or where this program was built or installed from.
fs::path scenes_folder(const std::string& given) {
    if (!given.empty() && !fs::exists(fs::path(given) / "gas.json"))
        throw Error(fmt::format("--scenes {}: the tour's scenes are not there, gas.json to begin with", given));
    for (const fs::path& folder : {fs::path(given), fs::path("scenes"), fs::path(CAROM_SCENES)})
        if (!folder.empty() && fs::exists(folder / "gas.json")) return folder;
    throw Error("the tour's scenes are not to be found; name their folder with --scenes");
}

Result tour_scene(const fs::path& file, const fs::path& out, std::vector<Row>& rows) {
    const std::string name = file.stem().string();
    Result result = perform(Scene::load(file), name, {.folder = out / name, .report = true}).result;
    for (const Verdict& v : result.verdicts) rows.push_back({name, v});
    return result;
}

/// The textbook's pendulum without damping, under every integrator: how much energy each creates or loses.
void compare_integrators(const fs::path& scene_file, const fs::path& out) {
    fmt::print("\nThe spring pendulum without damping, {} s under every integrator\n", 60);
    fmt::print("  {:<18}{:>24}{:>14}\n", "integrator", "worst energy error [J]", "time [ms]");
    Csv table(out / "integrators.csv", {{"integrator", ""}, {"worst energy error", "J"}, {"wall time", "s"}});
    const auto names = []<std::size_t... k>(std::index_sequence<k...>) {
        return std::vector<std::string>{std::variant_alternative_t<k, Integrator>::name...};
    }
    (std::make_index_sequence<std::variant_size_v<Integrator>>{});
    for (const std::string& name : names) {
        Scene scene = Scene::load(scene_file);
        scene.set("world.integrator", name);
        scene.set("damping", "0");
        scene.set("run.duration", "60");
        scene.set("expects", "[]");
        double worst = 0;
        const Result result =
            run(scene, scene.world(), name,
                {[&](const World& world) { worst = std::max(worst, std::abs(energy(world).residual)); }});
        fmt::print("  {:<18}{:>24.2e}{:>14.2f}\n", name, worst, 1e3 * result.wall_seconds);
        table.row(name, worst, result.wall_seconds);
    }
    table.commit();
}

/// Returns whether all is as expected.
bool print_table(const std::vector<Row>& rows) {
    std::size_t met = 0;
    std::string scene;
    fmt::print("\n");
    print_verdict_heading();
    for (const Row& r : rows) {
        if (r.scene != scene) fmt::print("{}\n", scene = r.scene);
        print_verdict(r.verdict);
        met += r.verdict.ok;
    }
    fmt::print("\n{} of {} as expected. ", met, rows.size());
    return met == rows.size();
}

int tour(const fs::path& scenes, const fs::path& out) {
    std::vector<Row> rows;
    double kinetic = 0;
    make_folder(out);
    fmt::print("{:<22}{:<18}{:>8}{:>10}{:>12}{:>16}\n", "scene", "integrator", "bodies", "steps", "wall [s]",
               "residual [J]");
    for (const char* name : {"projectiles", "spring-pendulum", "gas", "rope", "cloth", "rotation", "driven"}) {
        const Result result = tour_scene(scenes / fmt::format("{}.json", name), out, rows);
        const Energy e = energy(result.world);
        const auto method = std::visit([](const auto& m) { return m.name; }, result.world.settings().integrator);
        fmt::print("{:<22}{:<18}{:>8}{:>10}{:>12.3f}{:>16.2e}\n", name, method, result.world.size(),
                   result.world.steps(), result.wall_seconds, e.residual);
        if (std::string_view(name) == "gas") kinetic = e.kinetic;
        if (result.interrupted || !result.failure.empty()) return status_of(result);
    }
    fmt::print(
        "residual: what the method made or lost. The textbook's symplectic-euler loses m g² dt²/2 in every step\n"
        "of a free fall: in the first scene 0.0768 J, for 5 discs and 200 steps.\n");
    fmt::print("Final kinetic energy: {:.3f} J, of the gas\n", kinetic);
    compare_integrators(scenes / "spring-pendulum.json", out);
    const bool all = print_table(rows);
    fmt::print("Pictures and data are in {}\n", out.string());
    fmt::print("What sources like mech.catenary.elastic[1] name is told in docs/guide/09-expectations.md\n");
    return all ? 0 : 1;
}

}  // namespace

void add_tour(CLI::App& program, int& status) {
    struct Arguments {
        std::string scenes, out = "out/tour";
    };
    auto a = std::make_shared<Arguments>();
    CLI::App* command = program.add_subcommand(
        "tour", "Run the textbook's scenes; write pictures and data; compare with what is expected");
    command->add_option("--scenes", a->scenes, "folder of the scenes; if absent they are looked for")
        ->type_name("FOLDER");
    command->add_option("--out", a->out, "folder of pictures and data")->type_name("FOLDER")->capture_default_str();
    command->footer("example:\n  carom tour --out out/tour");
    command->callback([a, &status] { status = tour(scenes_folder(a->scenes), a->out); });
}

}  // namespace carom::app
