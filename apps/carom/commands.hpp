#pragma once
// The subcommands: each adds its options to the program and, when chosen, leaves its exit status.

#include <CLI/CLI.hpp>

#include "experiment.hpp"

namespace carom::app {

void add_run(CLI::App& program, int& status);
void add_plot(CLI::App& program, int& status);
void add_render(CLI::App& program, int& status);
void add_check(CLI::App& program, int& status);
void add_validate(CLI::App& program, int& status);
void add_schema(CLI::App& program, int& status);
void add_bench(CLI::App& program, int& status);
void add_tour(CLI::App& program, int& status);

/// SCENE, and the options that change it: --set, --integrator, --duration, …
void add_scene(CLI::App& command, std::string& file, Overrides& overrides);
/// The same for one or more scenes; SCENE is returned.
CLI::Option* add_scenes(CLI::App& command, std::vector<std::string>& files, Overrides& overrides);
/// What an option's number may be. (CLI11 writes out the largest double in all of its digits.)
CLI::Validator in_range(const Range& range);
/// --format, of pictures.
CLI::Option* add_format(CLI::App& command, std::string& format);

}  // namespace carom::app
