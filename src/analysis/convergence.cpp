#include <fmt/format.h>

#include <algorithm>
#include <carom/analysis.hpp>
#include <carom/convergence.hpp>
#include <cmath>
#include <limits>

#include "analysis/growth.hpp"
#include "analysis/magnitude.hpp"
#include "analysis/order.hpp"
#include "analysis/refinement.hpp"
#include "math/elementary.hpp"

namespace carom {

namespace {

constexpr std::size_t most_levels = 10;  // a step is halved at most so often: a thousand times the work
constexpr double stiffest = 16;          // parts of a step; beyond, a reference run would do nothing but follow rods

double* tolerance_of(Integrator& method) {
    if (auto* adaptive = std::get_if<Adaptive>(&method)) return &adaptive->tolerance;
    if (auto* nystrom = std::get_if<Nystrom>(&method)) return &nystrom->tolerance;
    if (auto* radau = std::get_if<GaussRadau>(&method)) return &radau->tolerance;
    return nullptr;
}

/// Gauss-Radau iterates over whole steps, which damping makes slow, and asks of forces that they are smooth to the last
/// digit, which a driven curve's velocity is not, and a user's force need not be.
Integrator reference_method(const World& world) {
    const auto damped = [](const auto& spring) { return spring.damping > 0; };
    const bool smooth = std::none_of(world.springs().begin(), world.springs().end(), damped) &&
                        std::none_of(world.torsion_springs().begin(), world.torsion_springs().end(), damped) &&
                        world.drags().empty() && world.fields().empty() && world.user_forces().empty() &&
                        std::find(world.kinds().begin(), world.kinds().end(), Kind::driven) == world.kinds().end();
    if (smooth && !std::holds_alternative<GaussRadau>(world.settings().integrator)) return GaussRadau{};
    return Adaptive{.pair = Pair::dormand_prince853, .tolerance = 1e-12};
}

/// What an absolute tolerance of coordinates near 1 is to be multiplied by where the largest place [m] and speed [m/s]
/// are smaller: 1e-12 of the smaller one, and yet no less than doubles can give of the larger one.
double smallness(double place, double speed) {
    constexpr double finest = 1e-2;
    const double small = std::min(place, speed), large = std::max(place, speed);
    return large > 0 ? std::min(1.0, std::max(small, finest * std::min(1.0, large))) : 1;
}

bool finds_impacts(const Solver& solver) {
    const auto* impulse = std::get_if<Impulse>(&solver);
    return !impulse || impulse->time_of_impact;
}

/// Whether nothing but gravity acts on anything, and nothing follows a curve.
bool flies_freely(const World& world) {
    const auto ids = world.ids();
    if (std::any_of(ids.begin(), ids.end(), [&](BodyId id) { return world.follows_curve(id); })) return false;
    return world.springs().empty() && world.torsion_springs().empty() && world.drags().empty() &&
           world.attractions().empty() && world.soft_discs().empty() && world.constant_forces().empty() &&
           world.fields().empty() && world.user_forces().empty();
}

/// Whether the solver moved something in a run by parts of its step: then they have an error of their own. What it
/// finds at its instant it finds on parabolas; under other forces, and on curves, on cubics that fit a part of a step.
bool solved_in_steps(const World& world, const Recording& run) {
    const Solver& solver = world.settings().solver;
    const bool at_instants = std::holds_alternative<Impulse>(solver) && finds_impacts(solver) && flies_freely(world);
    return !world.joints().empty() || (run.touched && !at_instants);
}

class Study {
  public:
    Study(const World& start, const std::vector<Probe>& probes, const StudyPlan& plan)
        : start_(start), probes_(probes), plan_(plan), schedule_(start, plan) {
        Settings settings = start.settings();
        refine_by(tolerance_of(settings.integrator) != nullptr);
        ladder_.time = schedule_.time();
        ladder_.smooth_impacts = finds_impacts(settings.solver);
    }

    Convergence result() {
        measure();
        if (is_bound_by_step()) return by_step();
        look_for_growth();
        judge();
        return std::move(out_);
    }

  private:
    void measure() {
        levels_.push_back(level(0));
        in_steps_ = solved_in_steps(start_, levels_[0]);
        look_at_solver();
        for (const std::size_t k : {1, 2}) levels_.push_back(level(k));
        normalise();
        look_for_impacts();
        run_reference();
        follow_everything();
        look_at_ledger();
    }

    /// By the method's tolerance, or by the step.
    void refine_by(bool tolerance) {
        own_step_ = tolerance;
        ladder_.ratio = own_step_ ? 10 : 2;
        // Rounding adds up like a random walk; a step rounds some dozen times.
        ladder_.rounding = 8 * std::numeric_limits<double>::epsilon() * std::sqrt(schedule_.work(division(2)));
        expected_work_ = 3 * (division(0) + division(1) + division(2)) * schedule_.work(1);
    }
    /// A method that chooses its own step does so between joints and contacts, which are solved in parts of the run's.
    void look_at_solver() {
        if (!own_step_ || !in_steps_) return;
        refine_by(false);
        out_.solved_in_steps = true;
    }
    /// A step of the method's own is no longer than the run's allows. Where that is too long, a finer tolerance may
    /// change nothing at all.
    bool is_bound_by_step() const { return own_step_ && out_.state.apart && !(out_.state.error <= plan_.tolerance); }
    Convergence by_step() const {
        Study again(start_, probes_, plan_);
        again.refine_by(false);
        again.out_.bound_by_step = true;
        again.done_work_ = done_work_;
        again.expected_work_ += done_work_;
        return again.result();
    }
    double division(std::size_t k) const { return own_step_ ? 1 : static_cast<double>(1u << k); }

    Recording record(const World& world, double division) { return record(schedule_, world, division); }
    Recording record(const Schedule& schedule, const World& world, double division) {
        Recording out = schedule.record(world, division, probes_, [this](double steps) {
            done_work_ += steps;
            if (plan_.progress) plan_.progress(std::min(1.0, done_work_ / std::max(expected_work_, done_work_)));
        });
        scale(out);
        return out;
    }

    /// The run whose step is halved k times, or whose tolerance is a tenth k times.
    World level_world(std::size_t k) const {
        World world = start_;
        Settings settings = start_.settings();
        double* const tolerance = tolerance_of(settings.integrator);
        if (!tolerance || k == 0) return world;
        *tolerance *= portable::pow(10, -static_cast<double>(k));
        world.configure(settings);
        return world;
    }
    Recording level(std::size_t k) {
        Recording out = record(level_world(k), division(k));
        Settings settings = level_world(k).settings();
        const double* tolerance = tolerance_of(settings.integrator);
        out.run.step = own_step_ ? plan_.step : plan_.step / division(k) / schedule_.cut();
        out.run.tolerance = tolerance ? *tolerance : 0;
        return out;
    }

    void scale(Recording& recording) const {
        if (place_weight_ == 0 && speed_weight_ == 0) return;
        for (auto& sample : recording.state)
            for (std::size_t i = 0; i < sample.size(); ++i) sample[i] *= i % 6 < 3 ? place_weight_ : speed_weight_;
    }

    /// Distances in phase space are relative to how far the bodies move, and how fast: half for places, half for
    /// speeds.
    void normalise() {
        raw_ = levels_[2].state;
        double farthest = 0, fastest = 0, largest_place = 0;
        for (const auto& sample : raw_) {
            double places = 0, speeds = 0;
            for (std::size_t i = 0; i < sample.size(); ++i) {
                const double d = i % 6 < 3 ? sample[i] - raw_[0][i] : sample[i];
                (i % 6 < 3 ? places : speeds) += d * d;
                if (i % 6 < 3) largest_place = std::max(largest_place, std::abs(sample[i]));
            }
            if (std::isfinite(places + speeds))
                farthest = std::max(farthest, places), fastest = std::max(fastest, speeds);
        }
        place_weight_ = farthest > 0 ? std::sqrt(0.5 / farthest) : 0;
        speed_weight_ = fastest > 0 ? std::sqrt(0.5 / fastest) : 0;
        for (Recording& recording : levels_) scale(recording);
        smallness_ = smallness(largest_place, std::sqrt(fastest));
    }

    void look_for_impacts() {
        for (std::size_t i = 0; i < ladder_.time.size() && !ladder_.impact; ++i)
            for (const Recording& r : levels_)
                if (r.collisions[i] > 0) ladder_.impact = ladder_.time[i];
        out_.first_impact = ladder_.impact;
    }

    /// Where joints or contacts are solved in parts of the step there is none: its parts would be no shorter.
    void run_reference() {
        if (in_steps_ || (own_step_ && levels_[0].run.tolerance <= 1e-12)) return;
        const bool kinked = ladder_.impact && !ladder_.smooth_impacts;
        if (schedule_.cut() > stiffest || kinked) return;
        reference_ = record(reference_world(), reference_division());
        out_.reference = std::visit([](const auto& m) { return std::string(m.name); }, reference_method(start_));
    }
    World reference_world() const {
        World world = start_;
        Settings settings = world.settings();
        settings.integrator = reference_method(start_);
        // Absolute below 1: of a small or slow motion it would be all.
        if (auto* adaptive = std::get_if<Adaptive>(&settings.integrator)) adaptive->tolerance *= smallness_;
        world.configure(settings);
        return world;
    }
    /// Impacts are found on the parabola of a step; between them the reference chooses its own.
    double reference_division() const { return ladder_.impact ? division(2) : 0; }

    std::array<const Track*, 3> tracks(std::size_t probe) const {
        return {&levels_[0].probes[probe], &levels_[1].probes[probe], &levels_[2].probes[probe]};
    }
    std::array<const Track*, 3> states() const { return {&levels_[0].state, &levels_[1].state, &levels_[2].state}; }
    const Track* reference_state() const { return reference_ ? &reference_->state : nullptr; }

    void follow_everything() {
        out_.state = follow(states(), reference_state(), ladder_, 1);
        out_.state.name = "state";
        const std::vector<double> magnitude = magnitudes(start_, raw_, probes_), scale = scales(start_, raw_, probes_);
        for (std::size_t k = 0; k < probes_.size(); ++k) {
            out_.quantities.push_back(follow(tracks(k), reference_ ? &reference_->probes[k] : nullptr, ladder_, 0,
                                             probes_[k].period, magnitude[k]));
            double& size = out_.quantities.back().size;
            // What moves by less than the tolerance's part of the whole motion is held against that part: of a length
            // that is kept the range is nothing but error.
            if (size > 0) size = std::max(size, plan_.tolerance * scale[k]);
            size = std::max({size, probes_[k].size, probes_[k].is_total_energy ? levels_[2].energies : 0});
            out_.quantities.back().name = probes_[k].name;
            out_.quantities.back().left_out = reason_to_leave_out(out_.quantities.back(), k);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            out_.runs[k] = levels_[k].run;
            if (k < 2) out_.runs[k].error = errors_of(k, out_.state, states(), reference_state(), ladder_);
        }
        if (out_.state.by == ErrorBy::reference) out_.runs[2].error = distances(*states()[2], *reference_state());
        out_.time = ladder_.time;
        out_.own_step = own_step_;
        out_.parts = schedule_.cut();
        out_.tolerance = plan_.tolerance;
        out_.duration = ladder_.time.back();
    }

    /// What the method made or lost of the energy beside the energies at play. Where nothing tells whether the runs
    /// converge to the truth, what all runs share of it counts as an error: three runs that agree may have lost the
    /// same. What a finer run has less of shows in what is judged, as far as that feels it.
    void look_at_ledger() {
        const Energy e = energy(start_);
        const double rounded =
            10 * ladder_.rounding *
            (e.kinetic + e.rotational + std::abs(e.gravity) + std::abs(e.spring) + std::abs(e.field));
        double at_play = std::max(levels_[2].energies, energy_of_rest());
        for (std::size_t k = 0; k < probes_.size(); ++k)
            if (const Followed& f = out_.quantities[k]; probes_[k].is_account && f.left_out.empty() && f.size > 0)
                at_play = std::min(at_play, f.size);
        const auto beside = [&](double joules) { return joules > rounded ? joules / at_play : 0; };
        for (std::size_t i = 0; i < ladder_.time.size(); ++i) {
            out_.made_or_lost = std::max(out_.made_or_lost, beside(levels_[0].made_or_lost[i]));
            // Of two finer runs, the one beyond as far as they are apart: where a loss at first order would end.
            const double end = 2 * levels_[2].made_or_lost[i] - levels_[1].made_or_lost[i];
            ledger_.push_back(beside(std::min(levels_[0].made_or_lost[i], std::max(end, 0.0))));
        }
        if (reference_) ledger_.assign(ledger_.size(), 0);
    }
    /// What lifting all bodies by about their own size takes. Where nothing moves, nothing else is at play.
    double energy_of_rest() const {
        double joules = 0;
        for (std::size_t i = 0; i < start_.size(); ++i)
            if (start_.kinds()[i] == Kind::dynamic)
                joules += std::sqrt(start_.masses()[i] * start_.moments_of_inertia()[i]);
        return joules * length(start_.settings().gravity);
    }

    std::string reason_to_leave_out(const Followed& f, std::size_t probe) const {
        const auto defined = [](const std::vector<double>& sample) { return !std::isnan(sample[0]); };
        const Track& run = levels_[0].probes[probe];
        if (std::none_of(run.begin(), run.end(), defined)) return "is never a number";
        if (!std::all_of(run.begin(), run.end(), defined)) return "is no number at times";
        if (f.by == ErrorBy::rounding) return "";
        if (f.size == 0)
            return fmt::format(
                "is all error, up to {:.2g}, with no size of its own that this would be small against (an expectation "
                "of 0 within a tolerance gives it one)",
                f.error);
        // Where the state is exact, what differs is a number that jumps, or divides by nothing.
        const bool exact = out_.state.by == ErrorBy::rounding;
        return exact && !(f.relative() <= plan_.tolerance) ? "jumps, or divides by nothing, in an exact motion" : "";
    }

    /// The reference beside its twin; where there is none, the finest run beside one.
    void look_for_growth() {
        World world = level_world(2);
        const Track* base = &levels_[2].state;
        double parts = division(2);
        if (out_.state.by == ErrorBy::reference) {
            world = reference_world();
            base = reference_state();
            parts = reference_division();
        }
        const Recording twin = record(perturbed(world, raw_), parts);
        out_.growth = growth_of(ladder_.time, distances(twin.state, *base), plan_.tolerance);
        feels_ = plan_.judge_state;
        const Recording& original = out_.state.by == ErrorBy::reference ? *reference_ : levels_[2];
        for (std::size_t k = 0; k < probes_.size() && !feels_; ++k) {
            const auto apart = distances(twin.probes[k], original.probes[k], probes_[k].period);
            feels_ = *std::max_element(apart.begin(), apart.end()) > plan_.tolerance * out_.quantities[k].size;
        }
    }

    /// The largest error of a run that is judged, relative to sizes, at every sample.
    std::vector<double> worst(const Recording& run, const Recording& truth) const {
        std::vector<double> out(run.state.size(), 0.0);
        const auto take = [&](const std::vector<double>& error, double size) {
            for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::max(out[i], error[i] / size);
        };
        if (plan_.judge_state) take(distances(run.state, truth.state), 1);
        for (std::size_t k = 0; k < probes_.size(); ++k)
            if (out_.quantities[k].left_out.empty() && out_.quantities[k].size > 0)
                take(distances(run.probes[k], truth.probes[k], probes_[k].period), out_.quantities[k].size);
        return out;
    }
    std::vector<double> worst_of_checked() const {
        std::vector<double> out = errors_seen();
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::max(out[i], ledger_[i]);
        return out;
    }
    std::vector<double> errors_seen() const {
        std::vector<double> out(ladder_.time.size(), 0.0);
        if (out_.state.by == ErrorBy::rounding) return out;
        const auto take = [&](const Followed& f, const std::vector<double>& error) {
            for (std::size_t i = 0; i < out.size() && f.left_out.empty() && f.by != ErrorBy::rounding; ++i)
                out[i] = std::max(out[i], error[i] / f.size);
        };
        if (plan_.judge_state) take(out_.state, out_.runs[0].error);
        for (std::size_t k = 0; k < probes_.size(); ++k)
            take(out_.quantities[k],
                 errors_of(0, out_.quantities[k], tracks(k), reference_ ? &reference_->probes[k] : nullptr, ladder_,
                           probes_[k].period));
        return out;
    }

    /// Of what is judged, or else of the state.
    double order() const {
        if (plan_.judge_state && out_.state.order) return *out_.state.order;
        for (const Followed& f : out_.quantities)
            if (f.order && f.left_out.empty()) return *f.order;
        return out_.state.order.value_or(1);
    }

    void judge() {
        const std::vector<double> error = worst_of_checked();
        const auto bad = std::find_if(error.begin(), error.end(), [&](double e) { return !(e <= plan_.tolerance); });
        const double end = out_.duration;
        out_.good_until = bad == error.end() ? end : when_passed(error, static_cast<std::size_t>(bad - error.begin()));
        out_.horizon = out_.growth ? out_.growth->horizon : std::numeric_limits<double>::infinity();
        out_.horizon = std::max(out_.horizon, out_.good_until);
        out_.trust = bad == error.end() ? Trust::trust : Trust::refine;
        out_.by_ledger = out_.trust == Trust::refine && largest(errors_seen()) <= plan_.tolerance;
        // Runs that do the same operations round alike, as a gas by events does at every step: that they agree says
        // nothing of what rounding has made of all of them.
        if (out_.trust == Trust::trust && out_.state.by == ErrorBy::rounding && feels_ && out_.growth &&
            out_.growth->horizon < end) {
            out_.trust = Trust::chaotic;
            out_.good_until = out_.horizon = out_.growth->horizon;
        }
        const auto counts = [](const Followed& f) { return f.left_out.empty(); };
        if (out_.trust == Trust::trust && !plan_.judge_state &&
            !std::all_of(out_.quantities.begin(), out_.quantities.end(), counts))
            out_.trust = Trust::unjudged;
        if (out_.trust != Trust::refine) return;
        if (out_.growth) {
            // A level shrinks the error by ratio^order, and exponential growth makes that up in so many seconds.
            const double gain = order() * portable::log(ladder_.ratio) / out_.growth->rate;
            out_.horizon = std::min(out_.horizon, out_.good_until + static_cast<double>(most_levels) * gain);
        }
        if (out_.horizon < end)
            out_.trust = Trust::chaotic;
        else
            refine(largest(error));
    }

    /// When the error passed the tolerance, as if it grew evenly to the first sample that is beyond.
    double when_passed(const std::vector<double>& error, std::size_t beyond) const {
        if (beyond == 0) return 0;
        const double before = error[beyond - 1], part = (plan_.tolerance - before) / (error[beyond] - before);
        return std::lerp(ladder_.time[beyond - 1], ladder_.time[beyond], std::isfinite(part) ? part : 0);
    }

    /// Looks for the coarsest step that is fine enough, first at the one that the order promises.
    void refine(double error) {
        const double value = own_step_ ? out_.runs[0].tolerance : out_.runs[0].step;
        Refinement search({value, error / plan_.tolerance}, order(),
                          value * portable::pow(ladder_.ratio, -static_cast<double>(most_levels)));
        for (std::size_t k = 1; k < 3 && out_.state.by == ErrorBy::reference; ++k)
            search.know({own_step_ ? out_.runs[k].tolerance : out_.runs[k].step,
                         largest(worst(levels_[k], *reference_)) / plan_.tolerance});
        while (const auto next = search.next()) {
            if (too_much_work(*next)) {
                if (!search.found() && out_.state.order && out_.state.by != ErrorBy::difference) out_.refined = next;
                break;
            }
            search.learn({*next, error_at(*next) / plan_.tolerance});
            ++out_.tried;
        }
        if (!search.found()) return;
        out_.refined = search.found();
        out_.refined_was_run = true;
    }

    /// Steps in contact, or on joints, take ten times as long as others, and that their errors shrink is no law.
    bool too_much_work(double value) {
        constexpr double little = 5e6, little_in_all = 1.5e6;
        const double bodies = static_cast<double>(start_.size()), work = schedule_.work(1) * schedule_.cut() * bodies;
        const double runs = division(0) + division(1) + division(2), now = out_.runs[0].step / value * work;
        if (own_step_) return false;
        if (!in_steps_) return now > std::max(little, 32 * work);
        return (spent_ += runs * now) > std::max(little_in_all, 32 * work);
    }

    /// The largest error of a run with this step, or tolerance, relative to sizes. Without a reference it is what a
    /// study with that would say.
    double error_at(double value) {
        StudyPlan plan = plan_;
        if (!own_step_) plan.step = value;
        World world = start_;
        Settings settings = start_.settings();
        if (double* own = tolerance_of(settings.integrator); own && own_step_) {
            *own = value;
            world.configure(settings);
        }
        if (out_.state.by == ErrorBy::reference) {
            const Schedule schedule(start_, plan);
            return largest(worst(record(schedule, world, 1),
                                 own_step_ ? *reference_ : record(schedule, reference_world(), reference_division())));
        }
        Study there(world, probes_, plan);
        there.refine_by(own_step_);
        there.done_work_ = done_work_, there.expected_work_ = expected_work_;
        there.measure();
        done_work_ = there.done_work_;
        for (std::size_t k = 0; k < probes_.size(); ++k)  // what is not judged there is not known to be right
            if (out_.quantities[k].left_out.empty() && !there.out_.quantities[k].left_out.empty())
                return std::numeric_limits<double>::infinity();
        return largest(there.worst_of_checked());
    }

    const World& start_;
    const std::vector<Probe>& probes_;
    const StudyPlan& plan_;
    Schedule schedule_;
    Ladder ladder_{};
    bool own_step_ = false;
    bool in_steps_ = false;  // joints or contacts are solved in parts of the step, whatever the method
    std::vector<Recording> levels_{};
    std::optional<Recording> reference_{};
    Track raw_{};  // of the finest level, in m and m/s
    double place_weight_ = 0, speed_weight_ = 0;
    double smallness_ = 1;          // of the motion beside 1 m and 1 m/s
    std::vector<double> ledger_{};  // an error at every sample, where it counts
    double expected_work_ = 0, done_work_ = 0;
    double spent_ = 0;    // on looking for a finer step: steps times bodies
    bool feels_ = false;  // what is judged changes with a perturbation as small as one may be
    Convergence out_{};
};

}  // namespace

Convergence study(const World& start, const std::vector<Probe>& probes, const StudyPlan& plan) {
    for (const Probe& probe : probes)
        if (!probe.value) throw Error(fmt::format("study: probe '{}' must have a function for its value", probe.name));
    return Study(start, probes, plan).result();
}

}  // namespace carom
