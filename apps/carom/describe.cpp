#include "commands.hpp"

#include <fmt/format.h>

#include <memory>

#include "pictures.hpp"
#include "report.hpp"

namespace carom::app {

namespace {

template <class V>
std::string names_of() {
    return []<std::size_t... k>(std::index_sequence<k...>) {
        std::string all;
        ((all += std::string(k ? ", " : "") + std::variant_alternative_t<k, V>::name), ...);
        return all;
    }(std::make_index_sequence<std::variant_size_v<V>>{});
}

/// The text of a field, with its unit, as the option's help.
template <class S, class M>
std::string help_of(const char* name, M S::*) {
    std::string text;
    std::apply([&](const auto&... f) { ((f.name == std::string(name) ? void(text = fmt::format("{}{}", f.text, *f.unit ? fmt::format(" [{}]", f.unit) : "")) : void()), ...); },
               fields(static_cast<const S*>(nullptr)));
    return text;
}

struct RunArguments {
    std::string scene;
    Overrides overrides;
    std::string csv, out, format = "png";
    bool json = false;
};

int run_scene(const RunArguments& a) {
    const Scene scene = load(a.scene, a.overrides);
    const World start = scene.world();
    std::vector<Observer> observers;
    std::optional<TrajectoryCsv> csv;
    std::optional<Pictures> pictures;
    const std::filesystem::path out = a.out;
    if (!a.out.empty()) make_folder(out);
    const std::string csv_file = !a.csv.empty() ? a.csv : a.out.empty() ? "" : (out / "trajectory.csv").string();
    if (!csv_file.empty()) {
        csv.emplace(csv_file, start);
        observers.push_back([&](const World& world) { csv->add(world); });
    }
    if (!a.out.empty()) {
        pictures.emplace(scene, start);
        observers.push_back([&, first = true](const World& world) mutable {
            if (!first) pictures->observe(world);
            first = false;
        });
    }
    const Result result = run(scene, std::filesystem::path(a.scene).stem().string(), observers);
    if (csv) csv->commit();
    if (pictures) {
        pictures->draw(out, a.format);
        File report(out / "report.json");
        report.write(report_json(a.scene, scene, result) + "\n");
        report.commit();
        File copy(out / "scene.json");
        copy.write(scene.text());
        copy.commit();
    }
    if (a.json)
        fmt::print("{}\n", report_json(a.scene, scene, result));
    else
        print_report(scene, result);
    return result.ok() && !result.interrupted ? 0 : 1;
}

}  // namespace

void make_folder(const std::filesystem::path& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) throw Error(fmt::format("{}: cannot be made: {}", folder.string(), failed.message()), Error::Cause::run);
}

void add_overrides(CLI::App& command, Overrides& o) {
    command.add_option("--set", o.set, "name=value: another value for a parameter or a place of the scene, such as world.gravity=[0,-1.6]")
        ->type_name("NAME=VALUE");
    command.add_option("--duration", o.duration, help_of("duration", &Plan::duration));
    command.add_option("--step", o.step, help_of("step", &Plan::step));
    command.add_option("--every", o.every, help_of("every", &Plan::every));
    command.add_option("--integrator", o.integrator, help_of("integrator", &Settings::integrator) + ": " + names_of<Integrator>());
    command.add_option("--solver", o.solver, help_of("solver", &Settings::solver) + ": " + names_of<Solver>());
    command.add_option("--threads", o.threads, help_of("threads", &Settings::threads));
}

void add_run(CLI::App& program, int& status) {
    auto a = std::make_shared<RunArguments>();
    CLI::App* command = program.add_subcommand("run", "Run a scene; print energies and what it expected");
    command->add_option("SCENE", a->scene, "scene file")->required();
    add_overrides(*command, a->overrides);
    command->add_option("--csv", a->csv, "write every body's motion to this file");
    command->add_option("--out", a->out, "write data, pictures and report into this folder");
    command->add_option("--format", a->format, "of the pictures")->check(CLI::IsMember({"png", "svg", "pdf"}));
    command->add_flag("--json", a->json, "print one JSON object and nothing else");
    command->footer("example: carom run scenes/gas.json --duration 20 --csv gas.csv --every 10");
    command->callback([a, &status] { status = run_scene(*a); });
}

void add_plot(CLI::App& program, int& status) {
    auto a = std::make_shared<RunArguments>();
    CLI::App* command = program.add_subcommand("plot", "Run a scene and draw its pictures");
    command->add_option("SCENE", a->scene, "scene file")->required();
    add_overrides(*command, a->overrides);
    a->out = "out";
    command->add_option("--out", a->out, "folder of the pictures")->capture_default_str();
    command->add_option("--format", a->format, "png, svg or pdf")->check(CLI::IsMember({"png", "svg", "pdf"}))->capture_default_str();
    command->footer("example: carom plot scenes/spring-pendulum.json --out out --format pdf");
    command->callback([a, &status] {
        const Scene scene = load(a->scene, a->overrides);
        make_folder(a->out);
        Pictures pictures(scene, scene.world());
        const Result result = run(scene, "plot", {[&, first = true](const World& world) mutable {
                                      if (!first) pictures.observe(world);
                                      first = false;
                                  }});
        for (const auto& file : pictures.draw(a->out, a->format)) fmt::print("{}\n", file.string());
        status = result.interrupted ? 1 : 0;
    });
}

void add_render(CLI::App& program, int& status) {
    struct Arguments {
        std::string scene, file = "out.mp4";
        Overrides overrides;
        double fps = 30, speed = 1, trail = 0;
        std::optional<double> at;
        int width = 800;
    };
    auto a = std::make_shared<Arguments>();
    CLI::App* command = program.add_subcommand("render", "Run a scene and draw it: a picture (png, svg, pdf) or a film (mp4, webm, gif)");
    command->add_option("SCENE", a->scene, "scene file")->required();
    command->add_option("--file", a->file, "picture or film, by its ending")->capture_default_str();
    add_overrides(*command, a->overrides);
    command->add_option("--at", a->at, "a picture's time [s]; if absent the end");
    command->add_option("--fps", a->fps, "frames per second of film")->check(CLI::Range(1.0, 240.0))->capture_default_str();
    command->add_option("--speed", a->speed, "seconds simulated per second of film")->check(CLI::PositiveNumber)->capture_default_str();
    command->add_option("--trail", a->trail, "seconds of path drawn behind each body")->check(CLI::NonNegativeNumber);
    command->footer("example: carom render scenes/gas.json --file gas.gif --speed 0.5\n         carom render scenes/gas.json --file gas.svg --at 3");
    command->callback([a, &status] {
        Scene scene = load(a->scene, a->overrides);
        const std::string ending = std::filesystem::path(a->file).extension().string();
        const World start = scene.world();
        View view = fit(start);
        view.trail = a->trail;
        if (ending == ".png" || ending == ".svg" || ending == ".pdf") {
            if (a->at) scene.set("run.duration", fmt::format("{}", *a->at));
            const Result result = run(scene, "render", {});
            draw(result.world, fit(join(bounds(start), bounds(result.world))), a->file);
            status = result.interrupted ? 1 : 0;
        } else {
            Movie movie(a->file, view, a->fps);
            double next = 0;
            scene.set("run.every", "1");
            const Result result = run(scene, "render", {[&](const World& world) {
                                          for (; world.time() >= next - 1e-9; next += a->speed / a->fps) movie.add(world);
                                      }});
            movie.commit();
            status = result.interrupted ? 1 : 0;
        }
        fmt::print("{}\n", a->file);
    });
}

void add_validate(CLI::App& program, int&) {
    auto files = std::make_shared<std::vector<std::string>>();
    CLI::App* command = program.add_subcommand("validate", "Check scene files without running them");
    command->add_option("SCENE", *files, "scene files")->required();
    command->footer("example: carom validate scenes/*.json");
    command->callback([files] {
        for (const std::string& file : *files) {
            const Scene scene = Scene::load(file);
            const World world = scene.world();
            Judge(scene, world);
            fmt::print("{}: ok, {} bodies, {} springs, {} expectations\n", file, world.size(), world.springs().size(),
                       scene.expectations().size());
        }
    });
}

void add_schema(CLI::App& program, int&) {
    auto folder = std::make_shared<std::string>();
    CLI::App* command = program.add_subcommand("schema", "Print the JSON Schema of scene files");
    command->add_option("--reference", *folder, "instead write the reference pages (Markdown) into this folder");
    command->callback([folder] {
        if (folder->empty()) {
            fmt::print("{}", scene_schema());
            return;
        }
        make_folder(*folder);
        for (const auto& [name, text] : reference_pages()) {
            File page(std::filesystem::path(*folder) / name);
            page.write(text);
            page.commit();
        }
    });
}

}  // namespace carom::app
