#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "state/row_name.hpp"
#include "state/validate.hpp"
#include "world/shapes.hpp"
#include "world/sleep.hpp"
#include "world/state.hpp"
#include "world/steps.hpp"

namespace carom {

void World::State::check_idle() const {
    if (at_work.now)
        throw Error(
            "a force, field or curve changes the world while a step asks it: it may look at it, and no more; change it "
            "between steps");
}

void World::State::disturb() {
    check_idle();
    memory.continues = false;
    gas.data.fits = false;
    places.forget();
}

void World::State::edit() {
    check_idle();  // an edit that is refused is none
    if (!edited) {
        const Working working(at_work);
        before_edit = has();
    }
    edited = true;
    disturb();
}

void World::State::change() {
    edit();
    changed = std::max(changed, Changed::actions);
}

void World::State::change_bodies(std::size_t first) {
    edit();
    soft_contacts.forget_search();
    changed = Changed::all;
    fitting_rows = std::min(fitting_rows, first);
}

void World::State::change_for_all() {
    change_bodies(bodies.size());
    soft_contacts.rest.stir_all();
}

void World::State::fit_pieces() {
    renew_pieces(bodies, fitting_rows, pieces);
    places.forget_from(fitting_rows);
    fitting_rows = bodies.size();
}

void World::State::stir(BodyId id) {
    const std::size_t row = bodies.row(id);
    soft_contacts.stir(row);
    if (bodies.inverse_mass[row] != 0) return;
    soft_contacts.stir_around(id, bodies);
    stir_joined(id);
}

const Forces& World::State::current_forces() {
    if (holds_removed) {
        forces.forget_removed(bodies);
        forget_removed(mechanisms, bodies);
        std::erase_if(let_go, [&](BodyId id) { return !bodies.contains(id); });
    }
    holds_removed = false;
    return forces;
}

namespace {

/// What errors call a force that may have a name.
std::string called_by_number(const char* type, const std::string& name, std::uint32_t number) {
    return name.empty() ? fmt::format("{} {}", type, number) : fmt::format("{} '{}'", type, name);
}

/// What the method 'nystrom' cannot integrate, its own words for it; none: nothing.
std::string beyond_places(const Forces& forces) {
    const auto damped = [](const auto& list, const char* kind) {
        for (std::size_t k = 0; k < list.size(); ++k)
            if (list[k].damping != 0)
                return fmt::format("{} {} has a damping of {}", kind, list.number(k), list[k].damping);
        return std::string();
    };
    for (std::string found : {damped(forces.springs, "Spring"), damped(forces.torsion_springs, "TorsionSpring"),
                              damped(forces.soft_discs, "SoftDiscs")})
        if (!found.empty()) return found;
    if (!forces.drags.empty()) return fmt::format("Drag {} depends on velocity", forces.drags.number(0));
    for (std::size_t k = 0; k < forces.constant_forces.size(); ++k)
        if (forces.constant_forces[k].torque != 0)
            return fmt::format("the work of ConstantForce {}, which has a torque, does not",
                               forces.constant_forces.number(k));
    for (std::size_t k = 0; k < forces.fields.size(); ++k) {
        const ForceField& field = forces.fields[k];
        const std::string called = called_by_number("ForceField", field.name, forces.fields.number(k));
        if (field.sees_velocity) return fmt::format("{} depends on velocity", called);
        if (!field.potential) return fmt::format("the work of {}, which has no potential, does not", called);
    }
    if (!forces.user_forces.empty())
        return fmt::format("{} is a function of velocity too",
                           called_by_number("UserForce", forces.user_forces[0].name, forces.user_forces.number(0)));
    return {};
}

}  // namespace

void World::State::derive() {
    if (std::holds_alternative<Nystrom>(settings.integrator)) {
        const std::string beyond = beyond_places(current_forces());
        if (!beyond.empty())
            throw Error(
                fmt::format("the integrator 'nystrom' needs forces that depend on places and time alone: {}; use "
                            "'adaptive' or 'gauss-radau'",
                            beyond));
    }
    const auto* impulse = std::get_if<Impulse>(&settings.solver);
    if (!forces.soft_discs.empty() &&
        (std::holds_alternative<SoftStep>(settings.solver) || (impulse && impulse->disc_collisions)))
        throw Error(
            "SoftDiscs: the solver lets discs collide too; use the solver 'none', or 'impulse' with "
            "disc_collisions false");
    const auto* soft = std::get_if<SoftStep>(&settings.solver);
    if (soft && soft->keep_energy && drift_share(settings.integrator) != 0.5)
        throw Error(
            fmt::format("SoftStep.keep_energy needs a method of second order: what '{}' keeps is another energy; use "
                        "'verlet'",
                        name_of(settings.integrator)));
    const auto apart = mechanisms.apart;
    const auto rests = may_rest;
    const auto in_steps = together.company.of_rows();
    dynamics = Dynamics(current_forces(), bodies, settings.threads, periodic);
    walls = Walls(rectangles, half_planes, stadiums, periodic);
    assemble(mechanisms, bodies, motion.x);
    if (std::holds_alternative<SoftStep>(settings.solver) || std::holds_alternative<Events>(settings.solver))
        fit_pieces();
    places.forget();
    together = std::holds_alternative<Events>(settings.solver)
                   ? Together(forces, mechanisms, let_go, bodies, pieces, settings.threads)
                   : Together{};
    any_sensor = has_sensor(bodies);
    beyond_solver = row_beyond(settings.solver, bodies, walls);
    may_rest = soft && (soft->sleep || soft->statics) ? only_weighed(forces, bodies) : std::vector<bool>(bodies.size());
    const bool same = mechanisms.apart == apart && may_rest == rests && together.company.of_rows() == in_steps;
    if (changed == Changed::all || !same)  // of pieces that are not those of now, too, if others are moved in steps
        soft_contacts.forget_search();
    else
        note_asleep(soft_contacts.rest, mechanisms);
    changed = Changed::nothing;
}

void World::State::settle() {
    if (changed == Changed::nothing) return;
    const Working working(at_work);
    derive();
}

void World::State::close_edits() {
    settle();
    if (!edited) return;
    const Working working(at_work);
    stir_touched();
    given = given_so_far();
    edited = false;
}

namespace {

/// What a step can be too long for, as the subject of a sentence.
std::string stiff_forces(const Forces& forces) {
    std::vector<const char*> there;
    if (!forces.springs.empty() || !forces.torsion_springs.empty()) there.push_back("springs");
    if (!forces.drags.empty()) there.push_back("drag");
    if (!forces.soft_discs.empty()) there.push_back("soft discs");
    if (there.size() == 1) return fmt::format("the {}", there[0]);
    if (there.size() == 2) return fmt::format("{} and {}", there[0], there[1]);
    return "springs, drag and soft discs";
}

/// What is no number has no sign that says anything.
double unsigned_nan(double number) { return std::isnan(number) ? std::abs(number) : number; }

/// Where and when a field was no finite number; empty if none was.
std::string words_of(const std::optional<FieldDoubt>& doubt, const Forces& forces, const Bodies& bodies) {
    if (!doubt) return "";
    const auto& [field, row, force, x, v, mass, time] = *doubt;
    const bool grows = std::isinf(force.x) || std::isinf(force.y);
    return fmt::format(
        "{} is ({}, {}) N for body {} at ({:.6g}, {:.6g}) m with velocity ({:.6g}, {:.6g}) m/s and mass {:.6g} kg at "
        "t = {:.6g} s{}",
        called_by_number("the force field", forces.fields[field].name, forces.fields.number(field)),
        unsigned_nan(force.x), unsigned_nan(force.y), name_of_row(bodies, row), x.x, x.y, v.x, v.y, mass, time,
        grows ? "; a shorter step may help" : ": it must be a number wherever the body comes");
}

/// Of two bodies in one place an attraction is 0/0, which no step mends; nor does any mend a function of the user's
/// that is no number.
std::string what_may_help(Vec2 velocity, std::size_t row, const Dynamics& dynamics, const Forces& forces,
                          const Bodies& bodies) {
    const auto is_driven = [&](const Drive& drive) { return drive.body == bodies.id[row]; };
    if (std::any_of(forces.drives.begin(), forces.drives.end(), is_driven))
        return "the curve that drives it is no finite number there";
    if (std::string field = words_of(dynamics.field_doubt(), forces, bodies); !field.empty()) return field;
    const bool unbounded = std::any_of(forces.attractions.begin(), forces.attractions.end(),
                                       [](const Attraction& a) { return a.softening == 0; });
    if (unbounded && std::isnan(velocity.x) && std::isnan(velocity.y))
        return "an attraction without softening has no bound where two bodies are in one place";
    return "a shorter step may help";
}

void check_finite(const carom::State& motion, const Bodies& bodies, const Dynamics& dynamics, const Forces& forces) {
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const Vec2 x = motion.x.linear[i], v = motion.v.linear[i];
        const auto finite = [](double number) { return number - number == 0; };
        if (finite(x.x) && finite(x.y) && finite(v.x) && finite(v.y) && finite(motion.x.angular[i]) &&
            finite(motion.v.angular[i]))
            continue;
        const double angle = unsigned_nan(motion.x.angular[i]), spin = unsigned_nan(motion.v.angular[i]);
        const std::string turned =
            finite(angle) && finite(spin) ? "" : fmt::format(", turned by {} rad and turning at {} rad/s", angle, spin);
        throw Error(
            fmt::format("the run went wrong at t = {:.6g} s: body {} is at ({}, {}) m with velocity ({}, {}) m/s{}; {}",
                        motion.time, name_of_row(bodies, i), unsigned_nan(x.x), unsigned_nan(x.y), unsigned_nan(v.x),
                        unsigned_nan(v.y), turned, what_may_help(v, i, dynamics, forces, bodies)),
            Error::Cause::run);
    }
}

}  // namespace

int World::State::least_parts() const {
    if (const auto* soft = std::get_if<SoftStep>(&settings.solver)) return soft->substeps;
    const auto* exact = std::get_if<Events>(&settings.solver);
    return exact && !together.empty() ? exact->substeps : 1;
}

double World::State::stable_step(const Stiffness& stiffness) const {
    const double limit = stability_limit(settings.integrator);
    return std::isfinite(limit) ? least_parts() * longest_stable_step(stiffness, limit) : limit;
}

int World::State::parts(double dt) const {
    if (dt <= stable_step(dynamics.stiffness_at_most())) return 1;  // whatever the state
    const double longest = stable_step(dynamics.stiffness(motion));
    if (dt <= longest) return 1;
    if (settings.long_step == LongStep::refuse)
        throw Error(fmt::format("World::step: dt must be at most {:.6g} s for {} to be stable under {}, got {} s",
                                longest, stiff_forces(forces), name_of(settings.integrator), dt),
                    Error::Cause::run);
    const double count = std::ceil(dt / longest);
    if (count > 1e6)
        throw Error(fmt::format("World::step: a step of {} s would have to be cut into {:.3g} parts for {} to be "
                                "stable; use a shorter step or the integrator 'implicit'",
                                dt, count, stiff_forces(forces)),
                    Error::Cause::run);
    return static_cast<int>(count);
}

void World::step(double dt) {
    validate_field(dt, "World::step: dt", "s", positive);
    State& s = *state_;
    s.check_idle();
    const Timed timed(s.profile, Work::all);
    s.close_edits();
    s.places.forget();
    s.check_solver();
    if (dt > 1e300) throw Error(fmt::format("World::step: dt must be at most 1e300 s, got {} s", dt));
    if (s.is_soft() && dt < 1e-300)
        throw Error(
            fmt::format("World::step: dt must be at least 1e-300 s where contacts ask for its reciprocal, got "
                        "{} s",
                        dt));
    s.dynamics.forget_doubt_before(s.motion.time);
    try {
        const State::Working working(s.at_work);
        s.move(dt);
    } catch (const Error& e) {  // of methods that look for a step that is short enough
        const std::string field = words_of(s.dynamics.field_doubt(), s.forces, s.bodies);
        if (field.empty() || e.cause() != Error::Cause::run) throw;
        throw Error(fmt::format("{}; {}", e.what(), field), e.cause());
    }
    s.finish_step(dt);
}

void World::State::move(double dt) {
    const auto* soft = std::get_if<SoftStep>(&settings.solver);
    const auto* exact = std::get_if<Events>(&settings.solver);
    if (exact && together.empty()) return advance(gas_scene(), motion, dt, gas);
    const int cuts = parts(dt);
    soft_contacts.begin_step();
    if (exact) return step_together(dt, cuts);
    const bool leaves_out = soft && takes_rows_apart(settings.integrator) && dynamics.may_leave_out();
    const Flight flight{dynamics, memory, [this, leaves_out](carom::State& at, double h) {
                            const Attention attention(dynamics, leaves_out ? &soft_contacts.rest.moving : nullptr);
                            propose(settings.integrator, dynamics, at, h, memory);
                        }};
    const SoftScene scene{flight,
                          walls,
                          bodies,
                          pieces,
                          cuts * least_parts(),
                          cuts,
                          drift_share(settings.integrator),
                          ramp_share(settings.integrator),
                          soft ? soft->precise : Precise::never,
                          soft && soft->keep_energy,
                          soft && soft->sleep,
                          soft && soft->sleep ? soft->sleep_speed : std::nullopt,
                          soft && soft->statics,
                          settings.threads,
                          may_rest,
                          mechanisms,
                          profile,
                          leaves_out};
    if (soft) advance(scene, motion, dt, soft_contacts);
    const auto* impulse = std::get_if<Impulse>(&settings.solver);
    const bool collides = impulse && anything_collides(*impulse, bodies, walls);
    for (int i = 0; i < cuts && !soft; ++i) {
        const double h = dt / cuts;
        if (collides)
            advance(*impulse, flight, walls, bodies, motion, h, contacts);
        else
            flight.propose(motion, h);
    }
    if (soft || collides) memory.finite = false;  // what the method left is not what the solver left
}

void World::State::finish_step(double dt) {
    places.forget();
    time.add(dt);
    motion.time = time.value();
    ++steps;
    const bool in_contact = std::holds_alternative<SoftStep>(settings.solver);  // then sleepers are as they were
    const RowRanges* const moved = in_contact ? &soft_contacts.rest.moving : nullptr;
    if (!std::exchange(memory.finite, false) && !dynamics.is_finite(motion, moved))
        check_finite(motion, bodies, dynamics, forces);
    note_events();
    break_joints();
}

void World::State::check_solver() {
    if (beyond_solver)
        throw Error(
            fmt::format("body {} has shapes, and the solver 'impulse' collides discs alone; use "
                        "'softstep'",
                        name_of_row(bodies, *beyond_solver)));
    if (std::holds_alternative<SoftStep>(settings.solver) && periodic)
        throw Error("the solver 'softstep' knows no periodic box; use 'impulse', or walls");
    if (!is_soft() && !mechanisms.empty()) throw Error("joints need the solver 'softstep'");
    if (!std::holds_alternative<Events>(settings.solver)) {
        for (const Wall& wall : walls.all)
            if (wall.temperature)
                throw Error(
                    fmt::format("a wall of temperature {} J is thermal, which the solver 'events' "
                                "alone can do",
                                *wall.temperature));
        if (!walls.round.empty()) throw Error("a stadium is round, which the solver 'events' alone can do");
        return;
    }
    check_gas_alone();
}

void World::State::check_gas_alone() {
    if (!together.empty() && together.everybody())
        throw Error(
            "the solver 'events' moves discs in free flight, and no disc here is free: all have shapes, springs, "
            "joints or forces of their own, which are moved in steps; use 'softstep'");
    if (!together.empty() && periodic)
        throw Error(fmt::format("the solver 'events' moves body {} in steps, which knows no periodic box; use walls",
                                name_of_row(bodies, together.first())));
    if (!together.empty() && !walls.round.empty())
        throw Error(fmt::format("the solver 'events' moves body {} in steps, which knows no stadium; use a rectangle",
                                name_of_row(bodies, together.first())));
    const auto on_all = [](const auto& list) {
        return std::any_of(list.begin(), list.end(), [](const auto& f) { return !f.body; });
    };
    const std::pair<const char*, bool> beyond[] = {
        {"drag on all bodies", on_all(forces.drags)},          {"attractions", !forces.attractions.empty()},
        {"force fields on all bodies", on_all(forces.fields)}, {"soft discs", !forces.soft_discs.empty()},
        {"user's forces", !forces.user_forces.empty()},        {"bodies driven along curves", !forces.drives.empty()},
    };
    for (const auto& [what, there] : beyond)
        if (there)
            throw Error(
                fmt::format("the solver 'events' moves discs in free flight, under gravity at most: it cannot "
                            "do {}; use 'impulse' or 'softstep'",
                            what));
}

double World::stable_step() const {
    State& s = *state_;
    s.settle();
    return s.stable_step(s.dynamics.stiffness(s.motion));
}

Steps::Steps(double duration, double step) {
    validate_field(duration, "run: duration", "s", non_negative);
    validate_field(step, "run: step", "s", positive);
    constexpr double most_steps = 1e15;  // beyond, counting is not exact, nor does anybody wait for it
    const double steps = duration / step, nearest = std::round(steps);
    if (steps > most_steps)
        throw Error(
            fmt::format("run: duration must be at most {:.0e} steps of {} s, got {} s", most_steps, step, duration));
    // What 1e-9 of a step is missing or left over is nobody's wish; and the quotient, and what it is of, are rounded.
    const double rounding = std::max(1e-9, 4 * std::numeric_limits<double>::epsilon() * steps);
    const bool fits = nearest > 0 && std::abs(steps - nearest) <= rounding;
    whole = static_cast<std::uint64_t>(fits ? nearest : std::floor(steps));
    if (!fits) rest = duration - static_cast<double>(whole) * step;
}

void run(World& world, double duration, double step, const std::function<void(const World&)>& observe,
         std::uint64_t done) {
    const Steps steps(duration, step);
    for (std::uint64_t n = done; n < steps.count(); ++n) {
        world.step(n < steps.whole ? step : steps.rest);
        if (observe) observe(world);
    }
}

std::uint64_t steps_of(double duration, double step) { return Steps(duration, step).count(); }

}  // namespace carom
