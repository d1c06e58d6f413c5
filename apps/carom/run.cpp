// carom run and plot: a scene is run, and judged.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "checkpoint.hpp"
#include "commands.hpp"
#include "outputs.hpp"
#include "products.hpp"
#include "report.hpp"
#include "sweep.hpp"

namespace carom::app {

namespace {

struct Arguments {
    std::vector<std::string> scenes;
    Overrides overrides;
    Products products;
    std::vector<std::string> csv, data;
    std::vector<std::string> quantities, sweeps;
    std::string out, checkpoint, resume, picture;
    bool json = false;
};

std::string label_of(const Scene& scene) {
    return scene.file() == "-" ? "stdin" : std::filesystem::path(scene.file()).stem().string();
}

/// The files of motion that the options ask for: with --quantity a --csv is a table of quantities.
std::vector<DataFile> data_files(const Arguments& a) {
    std::vector<DataFile> files;
    for (const std::string& path : a.csv)
        if (a.quantities.empty()) files.push_back({path, DataFormat::csv});
    for (const std::string& path : a.data) files.push_back({path, data_format(path)});
    return files;
}

/// Tells of notes on standard error, of which scene if there are several.
std::function<void(const Note&)> say_notes(const std::string& scene = "") {
    return [scene](const Note& note) {
        std::fflush(stdout);
        fmt::print(stderr, "carom: note: {}{}{}\n", scene, scene.empty() ? "" : ": ", note.text);
    };
}

Performance start(Arguments& a, const Scene& scene) {
    a.products.data = data_files(a);
    a.products.quantities = a.quantities;
    if (!a.quantities.empty()) a.products.tables = a.csv;
    if (!a.quantities.empty() && a.csv.empty())
        a.products.tables = {(std::filesystem::path(a.out) / "quantities.csv").string()};
    a.products.folder = a.out;
    a.products.report = !a.out.empty();
    a.products.note = say_notes();
    a.products.check_pictures = true;
    if (!a.checkpoint.empty()) prepare_checkpoints(a.checkpoint, label_of(scene), a.products);
    check_outputs(scene.file(), a.products);
    return perform(scene, label_of(scene), a.products);
}

/// What changes nothing of a run up to its checkpoint: when it ends, and who shares its work.
constexpr const char* free_to_change[] = {"run.duration", "world.threads"};

/// Whether a run can go on with the one scene as well as with the other.
bool are_alike_before_their_end(Scene a, Scene b) {
    for (Scene* scene : {&a, &b})
        for (const char* place : free_to_change) scene->set(place, "1");
    return a.text() == b.text();
}

/// The scene with which a run goes on: its own, or one that ends at another time or has other threads.
Scene scene_to_go_on(const Arguments& a, const Scene& own) {
    const auto is_free = [](const Override& o) {
        return std::any_of(std::begin(free_to_change), std::end(free_to_change), [&](const std::string& place) {
            return o.place == place || o.value.starts_with(place + "=");
        });
    };
    const auto other = std::find_if_not(a.overrides.begin(), a.overrides.end(), is_free);
    if (a.scenes.empty() && other != a.overrides.end())
        throw Error(fmt::format(
            "--resume {}: goes on with its own scene, which {} cannot change: --duration and --threads alone can",
            a.resume, other->option));
    Scene scene = a.scenes.empty() ? changed(own, a.overrides) : load(a.scenes[0], a.overrides);
    if (a.scenes.empty() || are_alike_before_their_end(scene, own)) return scene;
    throw Error(fmt::format(
        "--resume {}: is a checkpoint of another scene than {} with these options; --duration and --threads "
        "alone may be others",
        a.resume, a.scenes[0]));
}

Performance go_on(const Arguments& a, const Scene& scene, Resumed& run) {
    if (!a.csv.empty() || !a.data.empty() || !a.out.empty() || !a.quantities.empty())
        throw Error(fmt::format(
            "--resume {}: goes on with its own files; leave --csv, --data, --quantity and --out away", a.resume));
    run.products.checkpoints.file = run.products.resumed = a.resume;
    run.products.note = say_notes();
    if (!a.checkpoint.empty()) prepare_checkpoints(a.checkpoint, run.label, run.products);
    check_outputs(run.scene.file(), run.products);
    const bool same = scene.text() == run.scene.text();
    return perform(same ? run.scene : scene, run.label, run.products, run.state, same ? nullptr : &run.scene);
}

/// What a run with checkpoints writes is known by absolute paths, for it may go on elsewhere.
std::filesystem::path as_seen_from_here(const std::filesystem::path& file) {
    std::error_code error;
    const auto here = std::filesystem::current_path(error), near = file.lexically_relative(here);
    return error || file.is_relative() || near.empty() || *near.begin() == ".." ? file : near;
}

int run_scene(Arguments& a) {
    if (a.scenes.empty() && a.resume.empty()) throw CLI::RequiredError("SCENE");
    std::optional<CheckpointClaim> claim;
    std::optional<Resumed> resumed;
    if (!a.resume.empty()) claim.emplace(a.resume), resumed = resume(a.resume);
    const Scene scene = resumed ? scene_to_go_on(a, resumed->scene) : load(a.scenes[0], a.overrides);
    const auto [result, files] = resumed ? go_on(a, scene, *resumed) : start(a, scene);
    if (a.json) {
        fmt::print("{}\n", report_json(scene, result));
    } else {
        print_report(scene, result);
        for (const auto& file : files) fmt::print("wrote {}\n", as_seen_from_here(file).string());
        const Products& left = resumed ? resumed->products : a.products;
        const std::string& checkpoint = left.checkpoints.file;
        if (result.interrupted && !checkpoint.empty())
            fmt::print("carom run --resume {} goes on\n", in_shell(checkpoint));
        else if (result.failure.empty() && left.can_be_longer())
            fmt::print("carom run --resume {} --duration TIME makes it longer\n", in_shell(checkpoint));
    }
    return status_of(result);
}

int plot_scene(Arguments& a) {
    const Scene scene = load(a.scenes[0], a.overrides);
    a.products.folder = a.out;
    a.products.note = say_notes();
    const auto [result, files] = perform(scene, label_of(scene), a.products);
    for (const auto& file : files) fmt::print("{}\n", file.string());
    say_interrupted(result, scene.plan());
    return result.failure.empty() && !result.interrupted ? 0 : status_of(result);
}

/// One line a scene; a wrong one does not keep the others from being run.
int judge_scene(const std::string& file, const Overrides& overrides) {
    try {
        const Scene scene = load(file, overrides);
        const Result result = perform(scene, label_of(scene), {.note = say_notes(file)}).result;
        std::size_t met = 0;
        for (const Verdict& v : result.verdicts) met += v.ok;
        fmt::print("{:<4} {:<40} {:>3} of {:<3} as expected {:>9.3f} s\n", result.ok() ? "ok" : "FAIL", file, met,
                   result.verdicts.size(), result.wall_seconds);
        for (const Verdict& v : result.verdicts)
            if (!v.ok) print_verdict(v);
        std::fflush(stdout);
        return status_of(result, file);
    } catch (const Error& e) {
        fmt::print("FAIL {}\n", file);
        std::fflush(stdout);
        fmt::print(stderr, "carom: {}\n", e.what());
        return e.cause() == Error::Cause::input ? 2 : 1;
    }
}

int sweep_scene(const Arguments& a) {
    if (a.scenes.size() != 1) throw Error("--sweep is of one scene");
    if (!a.data.empty() || !a.out.empty() || !a.checkpoint.empty() || !a.resume.empty() || a.csv.size() > 1)
        throw Error(
            "--sweep makes a table, which --csv writes to one file: --data, --out, --checkpoint and --resume "
            "are of one run");
    Sweep sweep = read_sweep(a.sweeps);
    sweep.quantities = a.quantities;
    if (!a.csv.empty()) sweep.csv = a.csv[0];
    sweep.picture = a.picture;
    sweep.json = a.json;
    Products files{.tables = a.csv};
    if (!a.picture.empty()) files.tables.push_back(a.picture);  // for its name alone
    check_outputs(a.scenes[0], files);
    return run_sweep(a.scenes[0], a.overrides, sweep);
}

int run_scenes(Arguments& a) {
    if (!a.sweeps.empty()) return sweep_scene(a);
    if (!a.quantities.empty() && a.csv.empty() && a.out.empty() && a.resume.empty())
        throw Error(
            "--quantity chooses the columns of a table, and there is none: name a file with --csv or a folder with "
            "--out, or --sweep a parameter");
    if (!a.picture.empty())
        throw Error("--picture draws a --sweep, and there is none; --out FOLDER has the pictures of a run");
    if (a.scenes.size() <= 1) return run_scene(a);
    if (a.json || !a.quantities.empty() || !a.csv.empty() || !a.data.empty() || !a.out.empty() ||
        !a.checkpoint.empty() || !a.resume.empty())
        throw Error("--json, --quantity, --csv, --data, --out, --checkpoint and --resume are of one scene");
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
    add_scenes(*command, a->scenes, a->overrides)->required(false);
    const auto files = [&](const char* option, std::vector<std::string>& to, const char* help) {
        command->add_option(option, to, help)->type_name("FILE")->allow_extra_args(false);
    };
    files("--csv", a->csv, "write every body's motion to this file, as a table; with --quantity those over time");
    files("--data", a->data, "write every body's motion, by the file's ending: .csv, .h5 (H5MD), .xyz (extended XYZ)");
    CLI::Option* const out =
        command->add_option("--out", a->out, "write motion, pictures and report into this folder")->type_name("FOLDER");
    command
        ->add_option("--checkpoint", a->checkpoint,
                     "a file from which the run can go on, at its end too, written every N steps (1000) or so often "
                     "(60s, min, h); keep: with .h5, too")
        ->type_name("every=N[,file=FILE][,keep]");
    command
        ->add_option("--resume", a->resume,
                     "go on from a checkpoint; SCENE is not needed; with --duration to another end, also of a run that "
                     "is done")
        ->type_name("FILE");
    add_format(*command, a->products.format)->needs(out);
    command
        ->add_option("--sweep", a->sweeps,
                     "a run, and a row of a table, for each value of a parameter or place, or pair of two: n=1:7, "
                     "u=0:2:0.25, run.step=0.1,0.01")
        ->type_name("NAME=VALUES")
        ->allow_extra_args(false);
    command
        ->add_option(
            "--quantity", a->quantities,
            "a column of the --csv table: this expression over time; or of a sweep: at the end, instead of what "
            "is expected and measured")
        ->type_name("EXPR")
        ->allow_extra_args(false);
    command
        ->add_option(
            "--picture", a->picture,
            "draw a sweep (png, svg, pdf): curves, one for each of a second parameter's words or up to 7 values; "
            "of more a heat map")
        ->type_name("FILE");
    command->add_flag("--json", a->json, "print one JSON object and nothing else");
    command->footer(
        "examples:\n"
        "  carom run scenes/gas.json --csv gas.csv --every 10\n"
        "  carom run scenes/elastic-pendulum.json --integrator pefrl --step 1/1000 --json\n"
        "  carom run scenes/wind.json --set wy=2 --set bodies.light.radius=0.6 --out out\n"
        "  carom run scenes/joints/pendulum.json --quantity rod.angle --quantity pin.force --csv pin.csv\n"
        "  carom run scenes/*.json\n"
        "  carom run scenes/contacts/silo.json --data silo.h5 --data silo.xyz --checkpoint every=10s\n"
        "  carom run --resume silo.checkpoint    (if that was interrupted)\n"
        "  carom run --resume gas.checkpoint --duration 120    (of a run that is done, too)\n"
        "  carom run scenes/galperin.json --sweep n=1:5 --csv pi.csv\n"
        "  carom run scenes/kepler.json --sweep world.integrator=pefrl,rk4,gauss-radau --quantity energy.residual\n"
        "  carom run scenes/wind.json --sweep wx=0:4:0.5 --sweep wy=0:4:0.5 --quantity light.x --picture light.png");
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
