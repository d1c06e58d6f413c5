#pragma once
// One run of a scene.

#include <algorithm>
#include <carom/carom.hpp>
#include <carom/gas.hpp>
#include <carom/scene.hpp>
#include <functional>
#include <string>
#include <vector>

namespace carom::app {

/// What an option of the command line changes in a scene.
struct Override {
    std::string option;  ///< --step, …
    std::string place;   ///< in the document; if empty the value is name=value
    std::string value;
};
using Overrides = std::vector<Override>;
Scene load(const std::string& file, const Overrides& overrides);
/// The scene with these changes.
Scene changed(Scene scene, const Overrides& overrides);

/// Something that watches a run, frame by frame: at the start, then after every `every` steps, and at the end, or where
/// it is interrupted.
using Observer = std::function<void(const World&)>;

/// A run at some moment: what a checkpoint keeps of it, beside its files.
struct Course {
    World world;
    Judge judge;
    Twins twins;
    std::uint64_t done = 0;   ///< steps
    double wall_seconds = 0;  ///< up to there, of all processes
    bool resumed = false;     ///< the observers know what was before

    Course(const Scene& scene, World start);
    void save(Saver& to) const;
    void restore(Loader& from);
};
/// Called after every step but the last; and with `edge` where the run begins, before its last step, and where it is
/// cut short.
using Bystander = std::function<void(const Course&, bool edge)>;

/// What a person had better know of a run, most likely a mistake.
struct Note {
    std::string kind;  ///< what is noted; of a sweep each once
    std::string text;
};

struct Result {
    World world;
    std::vector<Verdict> verdicts{};
    std::vector<TwinError> twins{};
    double wall_seconds = 0;
    bool interrupted = false;           ///< by Ctrl-C: what there is, is whole
    std::string failure{};              ///< why the physics could not go on; empty if it could
    std::vector<GasNumber> measures{};  ///< of a gas under 'events'
    std::vector<GasAbsence> left_out{};
    std::vector<Note> notes{};

    bool ok() const;
};
/// Runs a scene from its world, with a progress bar on a terminal if that has a label. What goes wrong with the physics
/// is in the result, so that nothing that was observed is lost.
Result run(const Scene& scene, World start, const std::string& label, const std::vector<Observer>& observers);
Result run(const Scene& scene, Course course, const std::string& label, const std::vector<Observer>& observers,
           const Bystander& bystander);
/// Says on standard error that a run was interrupted, where what it drew does not.
void say_interrupted(const Result& result, const Plan& plan);
/// Says on standard error why a run failed, if it did, and which of several; the exit status.
int status_of(const Result& result, const std::string& which = "");

/// Whether a run has come to a time [s]. Of a step a thousandth is missing at most by rounding, of however many.
inline bool has_come_to(double time, const World& now, const Plan& plan) {
    return now.time() >= time - 1e-3 * std::min(plan.step, plan.duration);
}

/// Ctrl-C, a polite kill, or a terminal that closes, asks the run to end after the step it is in; the second one kills.
void handle_interrupts();
/// Whether Ctrl-C was pressed.
bool was_interrupted();
/// Asks all runs that are going on to end, as Ctrl-C does.
void interrupt_runs();

}  // namespace carom::app
