#include "experiment.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <carom/output.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <string_view>

namespace carom::app {

namespace {

std::atomic<bool> interrupted = false;
std::atomic<int> runs = 0;  // that are between their first step and their last
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

struct Running {
    Running() { ++runs; }
    ~Running() { --runs; }
};

void apply(Scene& scene, const Override& o) {
    if (!o.place.empty()) return scene.set(o.place, o.value);
    const auto equals = o.value.find('=');
    if (equals == std::string::npos || equals == 0) throw Error("must be NAME=VALUE");
    scene.set(o.value.substr(0, equals), o.value.substr(equals + 1));
}

}  // namespace

// Between steps a run ends with what there is; a figure is given up. So is a step that takes too long, and whatever it
// is when somebody asks again.
void handle_interrupts() {
    constexpr unsigned patience = 5;  // s
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const auto before = std::signal(signal, [](int which) {
            if (interrupted && which == SIGHUP) return;  // of one terminal the shell and the system tell
            if (interrupted) {
                remove_unfinished();
                std::signal(which, SIG_DFL);
                ::raise(which);
            }
            interrupted = true;
            interrupt_figures();
            ::alarm(patience);
        });
        if (signal == SIGHUP && before == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup: the run is to outlive it
    }
    std::signal(SIGALRM, [](int) {
        remove_unfinished();
        constexpr std::string_view step = "carom: interrupted within a step, whose end would have taken too long\n",
                                   other =
                                       "carom: interrupted; the end of what was under way would have taken too long\n";
        const std::string_view words = runs > 0 ? step : other;
        const auto written = ::write(STDERR_FILENO, words.data(), words.size());
        ::_exit(written > 0 ? 1 : 2);
    });
}

bool was_interrupted() { return interrupted; }
void interrupt_runs() { interrupted = true; }

namespace {

/// A scene that is run as a person wrote it: of one in a data file the run may have been made shorter.
struct Source {
    Scene scene;
    bool is_written;
};

Source read(const std::string& file) {
    if (file == "-") {
        static const Scene from_pipe = Scene::read("/dev/stdin", "-");  // it can be read once, and a sweep asks often
        return {from_pipe, true};
    }
    const auto inside = provenance_of(file);
    return inside ? Source{Scene::parse(inside->scene, file), false} : Source{Scene::read(file), true};
}

}  // namespace

Scene changed(Scene scene, const Overrides& overrides) {
    for (const Override& o : overrides) {
        try {
            apply(scene, o);
        } catch (const Error& e) {
            throw Error(fmt::format("{} {}: {}", o.option, o.value, e.what()));
        }
    }
    return scene;
}

Scene load(const std::string& file, const Overrides& overrides) {
    const auto [written, is_written] = read(file);
    const double end = written.plan().duration;
    Scene scene = changed(written, overrides);
    if (is_written) scene.check_times(end);  // a run made shorter by an option leaves out what comes later
    return scene;
}

bool Result::ok() const {
    return !interrupted && failure.empty() &&
           std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.ok; });
}

int status_of(const Result& result, const std::string& which) {
    if (!result.failure.empty())
        fmt::print(stderr, "carom: {}{}{}\n", which, which.empty() ? "" : ": ", result.failure);
    return result.ok() ? 0 : 1;
}

void say_interrupted(const Result& result, const Plan& plan) {
    if (result.interrupted)
        fmt::print(stderr, "carom: interrupted at t = {:.4g} s of {:.4g} s, where what is drawn ends\n",
                   result.world.time(), plan.duration);
}

namespace {

/// What is no number has no sign that says anything.
double unsigned_nan(double number) { return std::isnan(number) ? std::abs(number) : number; }

/// A potential that is no finite number where some body is; empty if there is none.
std::string doubt_potential(const World& world) {
    for (std::size_t k = 0; k < world.fields().size(); ++k) {
        const ForceField& field = world.fields()[k];
        for (std::size_t i = 0; field.potential && i < world.size(); ++i) {
            if (world.kinds()[i] != Kind::dynamic || (field.body && *field.body != world.ids()[i])) continue;
            const Vec2 x = world.positions()[i];
            const double joules = field.potential(x, world.masses()[i], world.time());
            if (std::isfinite(joules)) continue;
            const std::string body = world.body(world.ids()[i]).name;
            return fmt::format("the potential of the force field {} is {} J for body {} at ({:.6g}, {:.6g}) m",
                               field.name.empty() ? fmt::format("{}", k + 1) : fmt::format("'{}'", field.name),
                               unsigned_nan(joules),
                               body.empty() ? fmt::format("number {}", i) : fmt::format("'{}'", body), x.x, x.y);
        }
    }
    return "";
}

/// What is wrong with a world whose energies are beyond all numbers: its books are void. Empty if they are finite.
std::string doubt_energy(const World& world) {
    const Energy e = energy(world);
    if (std::isfinite(e.total() + e.initial_total + e.residual + e.unaccounted())) return "";
    const std::string potential = doubt_potential(world);
    return fmt::format(
        "the run went wrong at t = {:.6g} s: its energy is {} J, at the start {} J, and its books are no finite "
        "numbers; {}",
        world.time(), unsigned_nan(e.total()), unsigned_nan(e.initial_total),
        potential.empty() ? "are masses, velocities or forces too large, or has a potential a pole?" : potential);
}

/// An Error if two that attract one another are at one place: no step leads away.
void require_apart(const Scene& scene, const World& world, const Attraction& pole) {
    const auto source = [&](const Body& body) { return pole.couples == Couples::mass ? body.mass : body.charge; };
    std::map<std::pair<double, double>, std::string> at;  // who attracts, by place
    for (std::size_t i = 0; i < world.size(); ++i) {
        const Body body = world.body(world.ids()[i]);
        if (source(body) == 0) continue;
        const std::string name = body.name.empty() ? fmt::format("body {}", i) : fmt::format("'{}'", body.name);
        const Vec2 x = world.positions()[i];
        const auto [other, is_first] = at.try_emplace({x.x, x.y}, name);
        if (is_first) continue;
        throw Error(fmt::format(
            "{}: at the start {} and {} are both at ({:.6g}, {:.6g}) m, where an attraction between them has no finite "
            "energy: put them apart, or give the attraction a softening",
            scene.file(), other->second, name, x.x, x.y));
    }
}
void require_apart(const Scene& scene, const World& world) {
    if (std::isfinite(energy(world).field)) return;
    for (const Attraction& attraction : world.attractions())
        if (attraction.softening == 0 && attraction.strength != 0) require_apart(scene, world, attraction);
}

}  // namespace

Course::Course(const Scene& scene, World start) : world(std::move(start)), judge(scene, world), twins(scene, world) {
    require_apart(scene, world);
}

void Course::save(Saver& to) const {
    to(done, wall_seconds);
    world.save(to);
    judge.save(to);
    twins.save(to);
}
void Course::restore(Loader& from) {
    from(done, wall_seconds);
    world.restore(from);
    judge.restore(from);
    twins.restore(from);
    resumed = true;
}

Result run(const Scene& scene, World start, const std::string& label, const std::vector<Observer>& observers) {
    return run(scene, Course(scene, std::move(start)), label, observers, {});
}

Result run(const Scene& scene, Course course, const std::string& label, const std::vector<Observer>& observers,
           const Bystander& bystander) {
    const Plan plan = scene.plan();
    const std::uint64_t steps = steps_of(plan);
    if (!course.resumed)
        for (const Observer& observe : observers) observe(course.world);
    if (bystander) bystander(course, true);

    const std::uint64_t before = course.done;
    Progress progress(steps - std::min(before, steps), label, label.empty() ? -1 : STDERR_FILENO);
    bool stepping = true;  // and not observing
    struct Stop {};
    const auto clock = std::chrono::steady_clock::now();
    const double wall_before = course.wall_seconds;
    const auto look_at_clock = [&] {
        course.wall_seconds =
            wall_before + std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    };
    bool stopped = false;
    std::string failure;
    const auto after_step = [&](const World& world) {
        stepping = false;
        ++course.done;
        course.judge.observe(world);
        course.twins.observe(world);
        if (course.done % static_cast<std::uint64_t>(plan.every) == 0 || course.done == steps)
            for (const Observer& observe : observers) observe(world);
        progress.update(course.done - before);
        // Nothing of the last step is in a checkpoint: it may be shorter, it is shown whatever `every` says, and it is
        // no last one any more when the run is made longer.
        if (bystander && course.done < steps) look_at_clock(), bystander(course, course.done + 1 == steps);
        if (interrupted) throw Stop{};
        stepping = true;
    };
    try {
        const Running running;
        carom::run(course.world, plan.duration, plan.step, after_step, before);
    } catch (Stop) {
        stopped = true;
    } catch (const Error& e) {
        if (!stepping || e.cause() == Error::Cause::input) throw;
        failure = e.what();
    }
    if (runs == 0) ::alarm(0);  // what is left is to write it all down
    look_at_clock();
    if (bystander && failure.empty() && course.done < steps) bystander(course, true);
    // Data reach to where the run was interrupted. Not in the checkpoint: one that goes on has no frame there.
    if (stopped && course.done < steps && course.done % static_cast<std::uint64_t>(plan.every) != 0)
        for (const Observer& observe : observers) observe(course.world);
    const auto verdicts = course.judge.verdicts(stopped || !failure.empty());
    if (failure.empty()) failure = doubt_energy(course.world);
    return {std::move(course.world), verdicts, course.twins.errors(), course.wall_seconds, stopped, failure, {}};
}

}  // namespace carom::app
