#pragma once
// One run of a scene: the world, what it expects, the data it writes and what the pictures need.

#include <carom/carom.hpp>
#include <carom/output.hpp>
#include <carom/scene.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carom::app {

/// What the command line changes in a scene.
struct Overrides {
    std::vector<std::string> set;  ///< name=value
    std::string integrator, solver;
    std::optional<double> duration, step;
    std::optional<int> every, threads;
};
Scene load(const std::filesystem::path& file, const Overrides& overrides);

/// Something that watches a run, frame by frame: at the start, then after every `every` steps.
using Observer = std::function<void(const World&)>;

struct Result {
    World world;
    Plan plan;
    std::vector<Verdict> verdicts;
    double wall_seconds = 0;
    bool interrupted = false;  ///< by Ctrl-C: what there is, is whole

    bool ok() const;
};
/// Runs the scene with a progress bar on a terminal.
Result run(const Scene& scene, const std::string& label, const std::vector<Observer>& observers);

/// Ctrl-C asks the run to end after the step it is in; the second Ctrl-C kills.
void handle_interrupts();

}  // namespace carom::app
