#include <fmt/format.h>

#include <algorithm>
#include <carom/world.hpp>
#include <cmath>

#include "collision/periodic.hpp"
#include "state/nearest.hpp"
#include "state/row_name.hpp"
#include "state/validate.hpp"
#include "world/shapes.hpp"
#include "world/state.hpp"

namespace carom {

World::World(const Settings& settings) : state_(std::make_unique<State>()) { configure(settings); }
World::World(const World& other) : state_(std::make_unique<State>(*other.state_)) {}
World::World(World&&) noexcept = default;
World& World::operator=(const World& other) {
    if (this == &other) return *this;
    if (state_) state_->check_idle();
    state_ = std::make_unique<State>(*other.state_);
    return *this;
}
World& World::operator=(World&& other) {
    for (const auto* state : {state_.get(), other.state_.get()})
        if (state) state->check_idle();
    state_ = std::move(other.state_);
    return *this;
}
World::~World() = default;

void World::configure(const Settings& settings) {
    validate(settings, "Settings");
    state_->change_for_all();
    state_->settings = settings;
    state_->forces.gravity = settings.gravity;
    state_->bodies.mixing = {settings.restitution_mixing, settings.friction_mixing};
}
const Settings& World::settings() const { return state_->settings; }

BodyId World::add(const Body& body) {
    State& s = *state_;
    const Body made = body.shapes.empty() ? body : about_its_centre(body);
    s.bodies.check(made, {});
    s.change_bodies(s.bodies.size());
    const BodyId id = s.bodies.add(made, s.motion);
    s.note_put(id);
    return id;
}

void World::remove(BodyId id) {
    const std::size_t row = state_->bodies.row(id);
    state_->change_bodies(row);
    state_->stir_joined(id);
    state_->soft_contacts.rest.remove(row, state_->bodies.size());
    state_->bodies.remove(id, state_->motion);
    state_->holds_removed = true;
}

namespace {

/// Whether two are in one place and move as one does, to more than the rounding of a curve.
bool moves_alike(const Body& a, const Body& b) {
    constexpr double hair = 1e-6;
    const auto near = [](double x, double y) { return std::abs(x - y) <= hair * (1 + std::abs(y)); };
    const auto both_near = [&](Vec2 x, Vec2 y) { return near(x.x, y.x) && near(x.y, y.y); };
    return both_near(a.position, b.position) && near(a.angle, b.angle) && both_near(a.velocity, b.velocity) &&
           near(a.angular_velocity, b.angular_velocity);
}

/// An Error if a curve leads nowhere at a time [s], or has no velocity there.
void check_finite(const OnCurve& on, double time) {
    const auto& [pose, v, w] = on;
    if (!std::isfinite(pose.position.x + pose.position.y + pose.angle))
        throw Error(fmt::format("World::drive: the curve must be finite, got ({}, {}) m and {} rad at t = {} s",
                                pose.position.x, pose.position.y, pose.angle, time));
    if (!std::isfinite(v.x + v.y + w))
        throw Error(
            fmt::format("World::drive: the curve must be finite before and after t = {} s too, where its "
                        "velocity is looked for, got ({}, {}) m/s and {} rad/s",
                        time, v.x, v.y, w));
}

}  // namespace

void World::set(BodyId id, const Body& body) {
    State& s = *state_;
    const std::size_t row = s.bodies.row(id);
    Body made = body.shapes.empty() ? body : about_its_centre(body, s.bodies.mass[row]);
    const Vec2 centre = centre_of_shapes(body);
    s.bodies.check(made, id);
    if (made.kind == Kind::driven && s.follows_curve(id)) s.keep_on_curve(id, made);
    s.check_joints(id, made);
    const bool is_put = made.position != s.motion.x.linear[row] || made.angle != s.motion.x.angular[row];
    s.change_bodies(row);
    s.stir(id);  // as it was, and
    s.bodies.set(id, made, s.motion);
    s.stir(id);  // as it is: who loses what bore him wakes by himself
    if (is_put || s.bodies.inverse_mass[row] == 0) s.note_put(id);  // what nothing moves may reach sleepers now
    if (centre != Vec2{}) s.move_anchors(id, -centre);
    s.holds_removed = true;  // a curve, if it is driven no more
}

void World::drive(BodyId id, std::function<Pose(double)> curve) {
    State& s = *state_;
    const std::size_t row = s.bodies.row(id);
    if (s.bodies.kind[row] != Kind::driven) {
        const auto name = s.bodies.name.find(id.index);
        throw Error(fmt::format("World::drive: the body{} must be of kind driven",
                                name == s.bodies.name.end() ? "" : fmt::format(" '{}'", name->second)));
    }
    std::optional<OnCurve> now;  // of a curve that throws, or leads nowhere, nothing is taken
    if (curve) {
        const State::Working working(s.at_work);
        check_finite(now.emplace(on_curve(curve, time())), time());
    }
    s.change_for_all();
    std::erase_if(s.forces.drives, [&](const Drive& d) { return d.body == id; });
    if (!now) return;
    put(*now, row, s.motion);  // it is on its curve from now on, and not only from the next step on
    s.forces.drives.push_back({id, std::move(curve)});
}

void World::State::keep_on_curve(BodyId id, Body& made) {
    const Body now = bodies.body(bodies.row(id), motion);
    if (!moves_alike(made, now)) check_off_curve(id, "World::set");
    made.position = now.position, made.angle = now.angle;
    made.velocity = now.velocity, made.angular_velocity = now.angular_velocity;
}

bool World::State::follows_curve(BodyId id) {
    const auto& drives = current_forces().drives;
    return std::any_of(drives.begin(), drives.end(), [id](const Drive& d) { return d.body == id; });
}
void World::State::check_off_curve(BodyId id, const char* who) {
    if (!follows_curve(id)) return;
    throw Error(
        fmt::format("{}: body {} must not follow a curve, which says where it is and how fast; World::drive with no "
                    "curve ends it",
                    who, name_of_row(bodies, bodies.row(id))));
}
bool World::follows_curve(BodyId id) const { return state_->follows_curve(id); }

double World::time() const { return state_->motion.time; }
std::uint64_t World::steps() const { return state_->steps; }
std::uint64_t World::collisions() const {
    const GasTally gas = this->gas();
    return state_->contacts.collisions + state_->soft_contacts.strikes + gas.disc_collisions + gas.wall_collisions;
}
void World::measure_stages(bool on) {
    state_->profile = {};
    state_->profile.on = on;
}

std::vector<StageTime> World::stage_times() const {
    std::vector<StageTime> times;
    for (std::size_t k = 0; k < names_of_work.size(); ++k)
        times.push_back({names_of_work[k], state_->profile.seconds[k]});
    return times;
}

GasTally World::gas() const { return state_->gas.data.tally; }

bool World::in_steps(BodyId id) const {
    state_->settle();
    return !state_->together.empty() && state_->together.is_stepped(state_->bodies.row(id));
}

void World::check() const {
    State& s = *state_;
    s.settle();
    s.check_solver();
    if (!std::holds_alternative<carom::Events>(s.settings.solver)) return;
    carom::State as_it_is = s.motion;
    check_gas(s.gas_scene(), as_it_is);
}

std::size_t World::size() const { return state_->bodies.size(); }
std::span<const BodyId> World::ids() const { return state_->bodies.id; }
std::span<const Vec2> World::positions() const { return state_->motion.x.linear; }
std::span<const double> World::angles() const { return state_->motion.x.angular; }
std::span<const Vec2> World::velocities() const { return state_->motion.v.linear; }
std::span<const double> World::angular_velocities() const { return state_->motion.v.angular; }
std::span<const Kind> World::kinds() const { return state_->bodies.kind; }
std::span<const double> World::moments_of_inertia() const { return state_->bodies.inertia; }
std::span<const double> World::masses() const { return state_->bodies.mass; }
std::span<const double> World::radii() const { return state_->bodies.radius; }
std::span<const std::vector<Shape>> World::shapes() const { return state_->bodies.shapes; }

bool World::contains(BodyId id) const { return state_->bodies.contains(id); }
BodyId World::find(std::string_view name) const {
    const auto& names = state_->bodies.by_name;
    if (const auto found = names.find(name); found != names.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& [other, id] : names) known.push_back(other);
    throw Error(fmt::format("there is no body '{}'{}", name, did_you_mean(name, known)));
}
bool World::asleep(BodyId id) const {
    const std::size_t row = state_->bodies.row(id);
    const SoftContacts& contacts = state_->soft_contacts;
    return row < contacts.rest.still.size() && contacts.rest.still[row] > 0 && contacts.rest.told[row] != 0;
}
void World::wake(BodyId id) {
    state_->check_idle();
    state_->stir(id);
    state_->soft_contacts.rest.keep_awake(state_->bodies.row(id));
}
Vec2 World::position(BodyId id) const { return state_->motion.x.linear[state_->bodies.row(id)]; }
Pose World::pose(BodyId id) const { return {position(id), angle(id)}; }
double World::angle(BodyId id) const { return state_->motion.x.angular[state_->bodies.row(id)]; }
Vec2 World::velocity(BodyId id) const { return state_->motion.v.linear[state_->bodies.row(id)]; }
double World::angular_velocity(BodyId id) const { return state_->motion.v.angular[state_->bodies.row(id)]; }
Body World::body(BodyId id) const { return state_->bodies.body(state_->bodies.row(id), state_->motion); }

void World::set_position(BodyId id, Vec2 position, double angle) {
    const std::size_t row = state_->bodies.row(id);
    validate_field(position, "World::set_position: position", "m", any);
    validate_field(angle, "World::set_position: angle", "rad", any);
    state_->check_off_curve(id, "World::set_position");
    state_->edit();
    // Whether a chain is taut depends on where it ends.
    if (state_->bodies.inverse_mass[row] == 0 && is_among_holders(state_->mechanisms, id)) state_->change();
    state_->stir(id);
    state_->soft_contacts.forget_search();
    state_->motion.x.linear[row] = position;
    state_->motion.x.angular[row] = angle;
    state_->note_put(id);
}
void World::set_velocity(BodyId id, Vec2 velocity, double angular_velocity) {
    const std::size_t row = state_->bodies.row(id);
    validate_field(velocity, "World::set_velocity: velocity", "m/s", any);
    validate_field(angular_velocity, "World::set_velocity: angular_velocity", "rad/s", any);
    if (state_->bodies.kind[row] == Kind::fixed)
        throw Error(
            fmt::format("World::set_velocity: body {} is fixed and does not move", name_of_row(state_->bodies, row)));
    state_->check_off_curve(id, "World::set_velocity");
    state_->check_idle();
    Vec2& v = state_->motion.v.linear[row];
    double& w = state_->motion.v.angular[row];
    if (v == velocity && w == angular_velocity) return;
    state_->edit();
    state_->stir(id);
    v = velocity, w = angular_velocity;
}

void World::State::push(std::size_t row, Vec2 impulse, double turn) {
    const double inverse_inertia = bodies.inverse_inertia[row];
    Vec2& v = motion.v.linear[row];
    double& w = motion.v.angular[row];
    const Vec2 dv = bodies.inverse_mass[row] * impulse;
    const double dw = inverse_inertia * turn;
    const double work = dot(impulse, v + 0.5 * dv), turning = turn * (w + 0.5 * dw);
    if (!std::isfinite(work + turning) || !std::isfinite(v.x + dv.x + v.y + dv.y + w + dw))
        throw Error(
            fmt::format("an impulse on the body must do work that a number can hold [J], got {}", work + turning));
    check_idle();
    if (impulse == Vec2{} && turn == 0) return;
    disturb();
    soft_contacts.stir(row);
    const Momentum given_now{impulse, cross(motion.x.linear[row], impulse) + turn};
    motion.account[Account::user] += work + turning;
    motion.account[Giver::user].add(given_now.linear, given_now.angular);
    // What has no inertia holds against a torque, as under forces.
    const double taken = inverse_inertia == 0 ? turn : 0;
    motion.account[Account::driven] -= taken * w;
    motion.account[Giver::held].add({}, -taken);
    v += dv, w += dw;
    // Of edits under way it is none.
    before_edit.energy += work + turning - taken * w;
    before_edit.momentum.linear += given_now.linear;
    before_edit.momentum.angular += given_now.angular - taken;
}

namespace {

void check_dynamic(std::size_t row, const Bodies& bodies, const char* who) {
    if (bodies.inverse_mass[row] == 0)
        throw Error(fmt::format("{}: body {} must be dynamic", who, name_of_row(bodies, row)));
}

}  // namespace

void World::apply_impulse(BodyId id, Vec2 impulse, Vec2 point) {
    const std::size_t row = state_->bodies.row(id);
    validate_field(impulse, "World::apply_impulse: impulse", "N s", any);
    validate_field(point, "World::apply_impulse: point", "m", any);
    check_dynamic(row, state_->bodies, "World::apply_impulse");
    state_->push(row, impulse, cross(point - state_->motion.x.linear[row], impulse));
}
void World::apply_angular_impulse(BodyId id, double impulse) {
    const std::size_t row = state_->bodies.row(id);
    validate_field(impulse, "World::apply_angular_impulse: impulse", "N m s", any);
    check_dynamic(row, state_->bodies, "World::apply_angular_impulse");
    state_->push(row, {}, impulse);
}

Vec2 World::wrapped(Vec2 position) const {
    validate_field(position, "World::wrapped: position", "m", any);
    if (!state_->periodic) return position;
    const auto [low, high] = *state_->periodic;
    return {place_in_box(position.x, low.x, high.x).place, place_in_box(position.y, low.y, high.y).place};
}

}  // namespace carom
