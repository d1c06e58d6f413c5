#pragma once
// How far can a run be trusted? It is compared with the same motion at shorter steps, with a reference run, and with a
// twin that starts a hair's breadth away: docs/guide/13-trust.md, docs/theory/convergence.md.

#include <array>
#include <carom/world.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// A number of a world that a study follows.
struct Probe {
    std::string name{};
    std::function<double(const World&)> value{};
    double period = 0;             ///< if the number is an angle: values that differ by this are the same; else 0
    double size = 0;               ///< what its error is small against, if its range is not larger
    bool is_total_energy = false;  ///< its error is small against the energies at play: its range may be error alone,
                                   ///< and its value depends on where potentials are zero
    bool is_account = false;       ///< joules that add up over the run, as a heat: what the method made or lost may be
                                   ///< missing in them
};

struct StudyPlan {
    double duration = 10;     ///< [s]
    double step = 1.0 / 60;   ///< [s], of the run that is checked
    double tolerance = 1e-3;  ///< error allowed, relative to the size of what it is an error of
    bool judge_state = true;  ///< positions and velocities of all bodies count; else only the probes, each of which
                              ///< must be one that can be judged
    std::function<void(double done)> progress{};  ///< called with the fraction done; what it throws ends the study
};

/// Where the estimate of an error comes from.
enum class ErrorBy : std::uint8_t {
    rounding,   ///< the runs agree to the last digits
    reference,  ///< the distance from the reference run: the runs converge to it, or agree on something else (apart)
    order,      ///< Richardson's extrapolation: differences of the runs, and the order measured
    difference  ///< the distance from the finest run alone, and as much more as its like has shrunk: there is no order
};

/// What a study found out about a number, or about the state as a whole.
struct Followed {
    std::string name{};
    double value = 0;      ///< at the end of the run that is checked
    double error = 0;      ///< of that run: the largest at any time
    double end_error = 0;  ///< at its end
    double size = 0;       ///< what the error is small against: the range; 0 if the number is only error
    ErrorBy by = ErrorBy::difference;
    std::optional<double> order{};  ///< measured; absent where the differences have none
    double order_until = 0;         ///< [s] the order holds from the start until then
    double shrink = 0;              ///< without an order: by what the difference of runs is less that are twice as fine
    bool apart = false;             ///< the runs agree, but not with the reference, to which the error is the distance
    /// Why it does not count in the finding, as a part of a sentence; empty if it counts.
    std::string left_out{};
    double relative() const { return size > 0 ? error / size : 0; }
};

/// One of the runs.
struct StudyRun {
    double step = 0;              ///< [s]; of a method that steps on its own, the scene's
    double tolerance = 0;         ///< of a method that chooses its own step, else 0
    std::vector<double> error{};  ///< of the whole state at Convergence::time, relative to its size
    // The largest that the method made or lost: the residuals of the ledgers.
    double energy_drift = 0;                ///< [J]
    double momentum_drift = 0;              ///< [kg m/s]
    std::optional<double> angular_drift{};  ///< [kg m²/s]; absent in a periodic box, where physics does not keep it
    std::uint64_t collisions = 0;
    std::string failure{};  ///< why it could not go on; empty if it could
};

enum class Trust : std::uint8_t {
    trust,
    refine,
    chaotic,
    unjudged  ///< some of what alone was asked for cannot be judged, and nothing that can be is wrong
};

/// How errors of this motion grow.
struct Growth {
    double rate = 0;     ///< Lyapunov exponent of this stretch of the orbit [1/s]
    double horizon = 0;  ///< [s]: by then rounding alone has grown to the tolerance, and no shorter step can help
};

struct Convergence {
    Trust trust = Trust::refine;
    double tolerance = 0;
    double duration = 0;
    std::string reference{};       ///< the method of the reference run; empty if there is none
    double parts = 1;              ///< into which the world cuts a step to keep it stable
    bool own_step = false;         ///< the method chooses its step: tolerance is what is refined
    bool solved_in_steps = false;  ///< it does, but joints or contacts are solved in parts of the run's step: both are
                                   ///< refined, and it is the step that matters
    bool bound_by_step = false;    ///< it does, but its steps are bounded by the run's step, which matters more for the
                                   ///< error than the tolerance: the step is refined
    Followed state{};              ///< all bodies: distance in phase space, relative to the size of the motion
    std::vector<Followed> quantities{};
    std::vector<double> time{};      ///< of the samples [s]
    std::array<StudyRun, 3> runs{};  ///< at step, step/2, step/4, or tolerance, /10, /100
    double made_or_lost = 0;  ///< of the energy by the method: the most, as a part of the energies at play. Without a
                              ///< reference what all runs share of it counts as an error
    bool by_ledger = false;   ///< and is the only one that is too large
    std::optional<double> first_impact{};  ///< [s], of a sample: from there on the forces are not smooth
    std::optional<Growth> growth{};        ///< if it is exponential
    std::optional<double> refined{};       ///< the step [s], or tolerance, that is fine enough
    bool refined_was_run = false;          ///< and not computed from the order alone
    int tried = 0;                         ///< steps, or tolerances, that were run to find it
    double good_until = 0;  ///< [s]: up to then the error is within the tolerance, interpolated between samples
    double horizon = 0;     ///< [s]: of chaotic motion: beyond it no step that was considered helps

    /// The finding in one plain sentence.
    std::string sentence() const;
};

/// Runs a world at its step, half and a quarter of it (a method with its own step: at its tolerance, a tenth and a
/// hundredth; where joints or contacts are solved in parts of the step: at both), against a reference of high order
/// (Gauss-Radau under smooth conservative forces, else Dormand-Prince 8(5,3) at 1e-12), and beside a perturbed twin. An
/// Error if the duration is shorter than a step.
Convergence study(const World& start, const std::vector<Probe>& probes, const StudyPlan& plan);

}  // namespace carom
