// carom validate and schema: about scene files, without running them.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "notes.hpp"
#include "pictures.hpp"
#include "products.hpp"
#include "report.hpp"

namespace carom::app {

namespace {

/// Walls and what acts on bodies, as far as there are any.
std::string what_else(const World& world) {
    const std::size_t forces = world.torsion_springs().size() + world.drags().size() + world.attractions().size() +
                               world.soft_discs().size() + world.constant_forces().size() + world.fields().size() +
                               world.user_forces().size();
    const std::size_t walls = world.rectangles().size() + world.half_planes().size() + world.stadiums().size();
    std::string text = world.periodic() ? ", a periodic box" : "";
    const auto add = [&](std::size_t number, const char* one, const char* many) {
        if (number > 0) text += ", " + counted(number, one, many);
    };
    add(walls, "wall", "walls");
    add(world.joints().size(), "joint", "joints");
    add(world.springs().size(), "spring", "springs");
    add(forces, world.springs().empty() ? "force" : "other force", world.springs().empty() ? "forces" : "other forces");
    return text;
}

int validate(const std::string& file, const Overrides& overrides) {
    try {
        const Scene scene = load(file, overrides);
        const World world = scene.world();
        const Course course(scene, world);
        const Pictures pictures(scene, world);
        fmt::print("{}: ok, {}{}, {}\n", file, counted(world.size(), "body", "bodies"), what_else(world),
                   counted(course.judge.verdicts().size(), "expectation", "expectations"));
        for (const Note& note : notes_at_start(scene, world)) fmt::print("  note: {}\n", note.text);
        return 0;
    } catch (const Error& e) {
        fmt::print(stderr, "carom: {}\n", e.what());
        return 2;
    }
}

void write_schema(const std::string& folder) {
    if (folder.empty()) return fmt::print("{}", scene_schema());
    make_folder(folder);
    for (const auto& [name, text] : reference_pages()) write_file(std::filesystem::path(folder) / name, text);
}

}  // namespace

void add_validate(CLI::App& program, int& status) {
    struct Arguments {
        std::vector<std::string> files;
        Overrides overrides;
    };
    auto a = std::make_shared<Arguments>();
    CLI::App* command = program.add_subcommand("validate", "Check scene files without running them");
    add_scenes(*command, a->files, a->overrides);
    command->footer(
        "examples:\n"
        "  carom validate scenes/*.json\n"
        "  carom validate scenes/wind.json --set bodies.light.radius=0.6");
    command->callback([a, &status] {
        for (const std::string& file : a->files) status = std::max(status, validate(file, a->overrides));
    });
}

void add_schema(CLI::App& program, int&) {
    auto folder = std::make_shared<std::string>();
    CLI::App* command = program.add_subcommand("schema", "Print the JSON Schema of scene files");
    command->add_option("--reference", *folder, "instead write the reference pages (Markdown) into this folder")
        ->type_name("FOLDER");
    command->footer("examples:\n  carom schema > scene.schema.json\n  carom schema --reference docs/reference");
    command->callback([folder] { write_schema(*folder); });
}

}  // namespace carom::app
