#pragma once
// The subcommands: each adds its options to the program and, when chosen, leaves its exit status.

#include <CLI/CLI.hpp>

#include "experiment.hpp"

namespace carom::app {

void add_run(CLI::App& program, int& status);
void add_plot(CLI::App& program, int& status);
void add_render(CLI::App& program, int& status);
void add_validate(CLI::App& program, int& status);
void add_schema(CLI::App& program, int& status);
void add_tour(CLI::App& program, int& status);

/// The options that change a scene: --set, --integrator, --duration, …
void add_overrides(CLI::App& command, Overrides& overrides);
/// Makes the folder; an Error with the reason if that cannot be.
void make_folder(const std::filesystem::path& folder);

}  // namespace carom::app
