#include "drift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <carom/analysis.hpp>
#include <cmath>

namespace carom::app {

namespace {

constexpr std::uint64_t looks = 250;  // while a run doubles, about: all accounts are a sum over the bodies
constexpr double much = 0.05;         // of the energies at play: the ten parts of a period that a picture needs

}  // namespace

void Drift::observe(const World& world) {
    if (world.steps() < next_) return;
    // Whatever the end of the run will be: one that is made longer saw what a long one sees.
    next_ = world.steps() + std::max<std::uint64_t>(1, world.steps() / looks);
    const Energy e = energy(world);
    if (!first_) first_ = e;
    const auto grow = [](double& most, double joules) {
        if (std::isfinite(joules)) most = std::max(most, std::abs(joules));
    };
    grow(lost_, e.residual - first_->residual);
    for (const double joules : {e.kinetic + e.rotational, e.gravity - first_->gravity, e.spring - first_->spring,
                                e.field - first_->field, e.work.total() - e.work.overlap})
        grow(moved_, joules);
    for (const double joules : {moved_, e.heat.total(), e.work.total()}) grow(at_play_, joules);
    held_ = held_ || !world.joints().empty() || !world.contacts().empty();
    for (const Vec2& place : world.positions()) grow(extent_, length(place));
}

Note Drift::doubt(const World& end) const {
    const std::string residual = doubt_residual(end);
    return residual.empty() ? Note{"piles", doubt_piles(end)} : Note{"residual", residual};
}

/// Discs that rest on discs sink in by a hair in each step of 'impulse', and are put apart.
std::string Drift::doubt_piles(const World& end) const {
    constexpr double very_much = 0.1;
    const auto* const impulse = std::get_if<Impulse>(&end.settings().solver);
    const double put_apart = energy(end).work.overlap;
    if (!first_ || !impulse || !impulse->time_of_impact || !(put_apart > very_much * moved_)) return "";
    return fmt::format(
        "bodies that rest on one another strike one another in every step of 'impulse', so that work against overlap "
        "and heat of impacts grow with time, to {:.2g} J here, and cancel. --solver softstep carries them",
        put_apart);
}

namespace {

/// A force field whose potential says another force on some body at rest where it is; empty if none does.
std::string wrong_potential(const World& world) {
    constexpr double unlike = 1e-3, part = 1e-5, rounding = 1e-12;
    for (const ForceField& field : world.fields()) {
        for (std::size_t i = 0; field.potential && i < world.size(); ++i) {
            if (world.kinds()[i] != Kind::dynamic || (field.body && *field.body != world.ids()[i])) continue;
            const Vec2 x = world.positions()[i];
            const double m = world.masses()[i], t = world.time(), h = part * std::max(length(x), part);
            const auto slope = [&](Vec2 by) {
                return (field.potential(x - by, m, t) - field.potential(x + by, m, t)) / (2 * h);
            };
            const Vec2 said{slope({h, 0}), slope({0, h})}, force = field.force(x, {}, m, t);
            const double noise = rounding * std::abs(field.potential(x, m, t)) / h;
            if (!(length(said - force) > unlike * std::max(length(said), length(force)) + noise)) continue;
            return fmt::format(
                "the potential of a force field{} says ({:.3g}, {:.3g}) N at ({:.3g}, {:.3g}) m, where its force on a "
                "body at rest is ({:.3g}, {:.3g}) N: it must be minus the slope of the potential",
                field.name.empty() ? "" : fmt::format(" '{}'", field.name), said.x, said.y, x.x, x.y, force.x, force.y);
        }
    }
    return "";
}

}  // namespace

std::string Drift::doubt_residual(const World& end) const {
    if (!first_ || !(lost_ > much * at_play_)) return "";
    // Of what rests nothing moves but rounding: it would take a million runs to get anywhere.
    constexpr double rounding = 1e-9, slow = 1e-6;
    const Energy& e = *first_;
    double mass = 0;
    for (std::size_t i = 0; i < end.size(); ++i) mass += end.kinds()[i] == Kind::dynamic ? end.masses()[i] : 0;
    const double speed = slow * extent_ / plan_.duration;
    if (!(lost_ > rounding * (std::abs(e.gravity) + std::abs(e.spring) + std::abs(e.field)))) return "";
    if (!(at_play_ > mass * speed * speed)) return "";
    if (const std::string wrong = wrong_potential(end); !wrong.empty())
        return fmt::format("up to {:.2g} J are in no account but the residual, and no step keeps them: {}", lost_,
                           wrong);
    const std::string method = std::visit([](const auto& m) { return std::string(m.name); }, end.settings().integrator);
    return fmt::format(
        "in steps of {:.3g} s '{}' made or lost up to {:.2g} J, where the largest energy that moved is {:.2g} J. A "
        "shorter step (--step) {}; carom check finds out how far the numbers are right",
        plan_.step, method, lost_, at_play_,
        held_ ? "keeps it; another integrator does not, where joints or contacts made it"
              : "or another integrator keeps it");
}

}  // namespace carom::app
