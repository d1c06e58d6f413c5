#include <fmt/format.h>

#include <algorithm>
#include <carom/world.hpp>

#include "state/nearest.hpp"
#include "state/validate.hpp"
#include "world/shapes.hpp"
#include "world/state.hpp"

namespace carom {

namespace {

void check_room(Vec2 low, Vec2 high, const char* name) {
    if (!(low.x < high.x && low.y < high.y))
        throw Error(fmt::format("{}.high must lie above and right of low ({}, {}) [m], got ({}, {})", name, low.x,
                                low.y, high.x, high.y));
}

template <class T>
void check_ends(const T& spring, const Bodies& bodies, const char* name) {
    validate(spring, name);
    bodies.row(spring.a);
    bodies.row(spring.b);
    if (spring.a == spring.b) throw Error(fmt::format("{}.b must be another body than a", name));
}

}  // namespace

World::World(const Settings& settings) : state_(std::make_unique<State>()) { configure(settings); }
World::World(const World& other) : state_(std::make_unique<State>(*other.state_)) {}
World::World(World&&) noexcept = default;
World& World::operator=(const World& other) {
    if (this != &other) state_ = std::make_unique<State>(*other.state_);
    return *this;
}
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

void World::configure(const Settings& settings) {
    validate(settings, "Settings");
    state_->change();
    state_->settings = settings;
    state_->forces.gravity = settings.gravity;
    state_->bodies.mixing = {settings.restitution_mixing, settings.friction_mixing};
}
const Settings& World::settings() const { return state_->settings; }

BodyId World::add(const Body& body) {
    state_->change_bodies();
    if (body.shapes.empty()) return state_->bodies.add(body, state_->motion);
    return state_->bodies.add(about_its_centre(body), state_->motion);
}

void World::remove(BodyId id) {
    const std::size_t row = state_->bodies.row(id);
    state_->change_bodies();
    state_->soft_contacts.remove(row, state_->bodies.size());
    state_->bodies.remove(id, state_->motion);
    state_->holds_removed = true;
}

void World::add(const Spring& spring) {
    check_ends(spring, state_->bodies, "Spring");
    state_->change();
    state_->forces.springs.push_back(spring);
}
void World::add(const TorsionSpring& spring) {
    check_ends(spring, state_->bodies, "TorsionSpring");
    state_->change();
    state_->forces.torsion_springs.push_back(spring);
}
void World::add(const Drag& drag) {
    validate(drag, "Drag");
    if (drag.body) state_->bodies.row(*drag.body);
    state_->change();
    state_->forces.drags.push_back(drag);
}
void World::add(const Attraction& attraction) {
    validate(attraction, "Attraction");
    state_->change();
    state_->forces.attractions.push_back(attraction);
}
void World::add(const SoftDiscs& discs) {
    validate(discs, "SoftDiscs");
    state_->change();
    state_->forces.soft_discs.push_back(discs);
}
void World::add(const ConstantForce& force) {
    validate(force, "ConstantForce");
    state_->bodies.row(force.body);
    state_->change();
    state_->forces.constant_forces.push_back(force);
}
void World::add(ForceField field) {
    if (!field.force) throw Error(fmt::format("ForceField '{}'.force must be a function, got none", field.name));
    if (field.body) state_->bodies.row(*field.body);
    state_->change();
    state_->forces.fields.push_back(std::move(field));
}
void World::add(UserForce force) {
    if (!force.add) throw Error(fmt::format("UserForce '{}'.add must be a function, got none", force.name));
    state_->change();
    state_->forces.user_forces.push_back(std::move(force));
}

void World::add(const Rectangle& walls) {
    validate(walls, "Rectangle");
    check_room(walls.low, walls.high, "Rectangle");
    if (state_->periodic) throw Error("Rectangle: a world with a periodic box has no walls");
    state_->change();
    state_->rectangles.push_back(walls);
}
void World::add(const HalfPlane& wall) {
    validate(wall, "HalfPlane");
    if (wall.normal == Vec2{}) throw Error("HalfPlane.normal must not be (0, 0)");
    if (state_->periodic) throw Error("HalfPlane: a world with a periodic box has no walls");
    state_->change();
    state_->half_planes.push_back(wall);
}
void World::add(const Stadium& walls) {
    validate(walls, "Stadium");
    if (state_->periodic) throw Error("Stadium: a world with a periodic box has no walls");
    state_->change();
    state_->stadiums.push_back(walls);
}
void World::add(const Periodic& box) {
    validate(box, "Periodic");
    check_room(box.low, box.high, "Periodic");
    if (state_->periodic) throw Error("Periodic: a world has at most one periodic box");
    if (!state_->rectangles.empty() || !state_->half_planes.empty() || !state_->stadiums.empty())
        throw Error("Periodic: a world with walls has no periodic box");
    state_->change();
    state_->periodic = box;
}

void World::drive(BodyId id, std::function<Pose(double)> curve) {
    const std::size_t row = state_->bodies.row(id);
    if (state_->bodies.kind[row] != Kind::driven) throw Error("World::drive: the body must be of kind driven");
    if (!curve) throw Error("World::drive: the curve must be a function of time, got none");
    state_->change();
    std::erase_if(state_->forces.drives, [&](const Drive& d) { return d.body == id; });
    state_->forces.drives.push_back({id, std::move(curve)});
    state_->settle();  // it is on its curve from now on, and not only from the next step on
}

bool World::follows_curve(BodyId id) const {
    const auto& drives = state_->forces.drives;
    return std::any_of(drives.begin(), drives.end(), [id](const Drive& d) { return d.body == id; });
}

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
    return row < contacts.still.size() && contacts.still[row] > 0 && contacts.asleep[row] != 0;
}
Vec2 World::position(BodyId id) const { return state_->motion.x.linear[state_->bodies.row(id)]; }
double World::angle(BodyId id) const { return state_->motion.x.angular[state_->bodies.row(id)]; }
Vec2 World::velocity(BodyId id) const { return state_->motion.v.linear[state_->bodies.row(id)]; }
double World::angular_velocity(BodyId id) const { return state_->motion.v.angular[state_->bodies.row(id)]; }
Body World::body(BodyId id) const { return state_->bodies.body(state_->bodies.row(id), state_->motion); }

void World::set_position(BodyId id, Vec2 position, double angle) {
    const std::size_t row = state_->bodies.row(id);
    validate_field(position, "World::set_position: position", "m", any);
    validate_field(angle, "World::set_position: angle", "rad", any);
    state_->edit();
    state_->soft_contacts.stir(row);
    state_->motion.x.linear[row] = position;
    state_->motion.x.angular[row] = angle;
}
void World::set_velocity(BodyId id, Vec2 velocity, double angular_velocity) {
    const std::size_t row = state_->bodies.row(id);
    validate_field(velocity, "World::set_velocity: velocity", "m/s", any);
    validate_field(angular_velocity, "World::set_velocity: angular_velocity", "rad/s", any);
    if (state_->bodies.kind[row] == Kind::fixed) throw Error("World::set_velocity: a fixed body does not move");
    state_->edit();
    state_->soft_contacts.stir(row);
    state_->motion.v.linear[row] = velocity;
    state_->motion.v.angular[row] = angular_velocity;
}

Vec2 World::wrapped(Vec2 position) const {
    if (!state_->periodic) return position;
    const auto [low, high] = *state_->periodic;
    const auto wrap = [](double x, double a, double b) { return x - (b - a) * std::floor((x - a) / (b - a)); };
    return {wrap(position.x, low.x, high.x), wrap(position.y, low.y, high.y)};
}

// A removed body takes its forces with it: at the latest when somebody looks.
std::span<const Spring> World::springs() const { return state_->current_forces().springs; }
std::span<const TorsionSpring> World::torsion_springs() const { return state_->current_forces().torsion_springs; }
std::span<const Drag> World::drags() const { return state_->current_forces().drags; }
std::span<const Attraction> World::attractions() const { return state_->current_forces().attractions; }
std::span<const SoftDiscs> World::soft_discs() const { return state_->current_forces().soft_discs; }
std::span<const ConstantForce> World::constant_forces() const { return state_->current_forces().constant_forces; }
std::span<const ForceField> World::fields() const { return state_->current_forces().fields; }
std::span<const UserForce> World::user_forces() const { return state_->current_forces().user_forces; }
std::span<const Rectangle> World::rectangles() const { return state_->rectangles; }
std::span<const HalfPlane> World::half_planes() const { return state_->half_planes; }
std::span<const Stadium> World::stadiums() const { return state_->stadiums; }
std::optional<Periodic> World::periodic() const { return state_->periodic; }

}  // namespace carom
