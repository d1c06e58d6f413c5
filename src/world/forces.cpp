// The forces and walls of a world: what may be added, changed and removed.

#include <fmt/format.h>

#include "state/validate.hpp"
#include "world/state.hpp"

namespace carom {

namespace {

void check_room(Vec2 low, Vec2 high, const char* name) {
    if (!(low.x < high.x && low.y < high.y))
        throw Error(fmt::format("{}.high must lie above and right of low ({}, {}) [m], got ({}, {})", name, low.x,
                                low.y, high.x, high.y));
}

constexpr const char* called(const Spring*) { return "Spring"; }
constexpr const char* called(const TorsionSpring*) { return "TorsionSpring"; }
constexpr const char* called(const Drag*) { return "Drag"; }
constexpr const char* called(const Attraction*) { return "Attraction"; }
constexpr const char* called(const SoftDiscs*) { return "SoftDiscs"; }
constexpr const char* called(const ConstantForce*) { return "ConstantForce"; }
constexpr const char* called(const ForceField*) { return "ForceField"; }
constexpr const char* called(const UserForce*) { return "UserForce"; }
constexpr const char* called(const Rectangle*) { return "Rectangle"; }
constexpr const char* called(const HalfPlane*) { return "HalfPlane"; }
constexpr const char* called(const Stadium*) { return "Stadium"; }

void check_given(const ForceField& field) {
    if (!field.force) throw Error(fmt::format("ForceField '{}'.force must be a function, got none", field.name));
}
void check_given(const UserForce& force) {
    if (!force.add) throw Error(fmt::format("UserForce '{}'.add must be a function, got none", force.name));
}
void check_given(const Rectangle& walls) {
    validate(walls, "Rectangle");
    check_room(walls.low, walls.high, "Rectangle");
}
void check_given(const HalfPlane& wall) {
    validate(wall, "HalfPlane");
    if (wall.normal == Vec2{}) throw Error("HalfPlane.normal must not be (0, 0)");
    const double squared = squared_length(wall.normal);
    if (!(squared > 1e-300 && squared < 1e300))
        throw Error(fmt::format("HalfPlane.normal must have a length between 1e-150 and 1e150, got ({}, {})",
                                wall.normal.x, wall.normal.y));
}
template <class T>
void check_given(const T& one) {
    validate(one, called(&one));
}

template <class Force>
void check_given(const Force& force, const Bodies& bodies) {
    check_given(force);
    if constexpr (requires { force.a; }) {
        bodies.row(force.a, called(&force), "a"), bodies.row(force.b, called(&force), "b");
        if (force.a == force.b) throw Error(fmt::format("{}.b must be another body than a", called(&force)));
    } else if constexpr (Holding<Force>) {
        each_body_of(force, [&](BodyId id) { bodies.row(id, called(&force), "body"); });
    }
}

}  // namespace

template <class T>
Numbered<T>& World::State::list() {
    return std::get<Numbered<T>&>(std::tie(forces.springs, forces.torsion_springs, forces.drags, forces.attractions,
                                           forces.soft_discs, forces.constant_forces, forces.fields, forces.user_forces,
                                           rectangles, half_planes, stadiums));
}

template <class T>
std::optional<std::size_t> World::State::find(std::uint32_t number) {
    const Numbered<T>& all = list<T>();
    const std::optional<std::size_t> place = all.place(number);
    if constexpr (Holding<T>)
        if (place && is_left(all[*place], bodies)) return {};
    return place;
}

template <class T>
std::size_t World::State::place_of(std::uint32_t number, const char* id) {
    if (const auto place = find<T>(number)) return *place;
    const char* const kind = called(static_cast<const T*>(nullptr));
    if (number == 0 || number > list<T>().given())
        throw Error(fmt::format("{} must come from World::add of this world, got one that no {} ever had", id, kind));
    throw Error(fmt::format("{} is stale: {} {} was removed from this world{}", id, kind, number,
                            Holding<T> ? ", or a body of it" : ""));
}

template <class T>
std::uint32_t World::State::number_at(std::size_t place) {
    current_forces();
    const Numbered<T>& all = list<T>();
    if (place >= all.size())
        throw Error(fmt::format("place must be below {}, the number of {}s, got {}", all.size(),
                                called(static_cast<const T*>(nullptr)), place));
    return all.number(place);
}

template <class Force>
void World::State::change_force(const Force& force) {
    change();
    if (soft_contacts.rest.still.empty()) return;
    bool on_all = true;
    if constexpr (Holding<Force>)
        each_body_of(force, [&](BodyId id) {
            on_all = false;
            soft_contacts.stir(bodies.row(id));
        });
    if (on_all) change_for_all();
}

template <class Force>
auto World::State::take(Force&& force) {
    using Plain = std::remove_cvref_t<Force>;
    check_given(force, bodies);
    change_force(force);
    return ForceId<Plain>{list<Plain>().push_back(std::forward<Force>(force))};
}

template <class Walls>
WallId<Walls> World::State::take_walls(const Walls& walls_to_add) {
    check_given(walls_to_add);
    if (periodic) throw Error(fmt::format("{}: a world with a periodic box has no walls", called(&walls_to_add)));
    change_for_all();
    if constexpr (std::is_same_v<Walls, Rectangle>) renumber_walls(4 * rectangles.size(), 0, 4);
    return {list<Walls>().push_back(walls_to_add)};
}

ForceId<Spring> World::add(const Spring& spring) { return state_->take(spring); }
ForceId<TorsionSpring> World::add(const TorsionSpring& spring) { return state_->take(spring); }
ForceId<Drag> World::add(const Drag& drag) { return state_->take(drag); }
ForceId<Attraction> World::add(const Attraction& attraction) { return state_->take(attraction); }
ForceId<SoftDiscs> World::add(const SoftDiscs& discs) { return state_->take(discs); }
ForceId<ConstantForce> World::add(const ConstantForce& force) { return state_->take(force); }
ForceId<ForceField> World::add(ForceField field) { return state_->take(std::move(field)); }
ForceId<UserForce> World::add(UserForce force) { return state_->take(std::move(force)); }

WallId<Rectangle> World::add(const Rectangle& walls) { return state_->take_walls(walls); }
WallId<HalfPlane> World::add(const HalfPlane& wall) { return state_->take_walls(wall); }
WallId<Stadium> World::add(const Stadium& walls) { return state_->take_walls(walls); }

void World::add(const Periodic& box) {
    State& s = *state_;
    validate(box, "Periodic");
    check_room(box.low, box.high, "Periodic");
    if (s.periodic) throw Error("Periodic: a world has at most one periodic box");
    if (!s.rectangles.empty() || !s.half_planes.empty() || !s.stadiums.empty())
        throw Error("Periodic: a world with walls has no periodic box");
    s.change_for_all();
    s.periodic = box;
}

// Of millions of springs many may be removed one after the other: one that is removed is dropped with those whose
// bodies are gone, all at once.
template <class Force>
void World::remove(ForceId<Force> id) {
    State& s = *state_;
    const std::size_t place = s.place_of<Force>(id.number, "ForceId");
    Force& force = s.list<Force>()[place];
    s.change_force(force);
    if constexpr (Holding<Force>) {
        leave(force);
        s.holds_removed = true;
    } else {
        s.list<Force>().erase(place);
    }
}

template <class Force>
void World::set(ForceId<Force> id, const std::type_identity_t<Force>& force) {
    State& s = *state_;
    Force& now = s.list<Force>()[s.place_of<Force>(id.number, "ForceId")];
    check_given(force, s.bodies);
    s.change_force(now);
    s.change_force(force);
    now = force;
}

template <class Force>
bool World::contains(ForceId<Force> id) const {
    return state_->find<Force>(id.number).has_value();
}
template <class Force>
Force World::force(ForceId<Force> id) const {
    return state_->list<Force>()[state_->place_of<Force>(id.number, "ForceId")];
}
template <class Force>
ForceId<Force> World::force_id(std::size_t place) const {
    return {state_->number_at<Force>(place)};
}

template <class Walls>
void World::remove(WallId<Walls> id) {
    State& s = *state_;
    const std::size_t place = s.place_of<Walls>(id.number, "WallId");
    s.change_for_all();
    if constexpr (std::is_same_v<Walls, Rectangle>) s.renumber_walls(4 * place, 4, 0);
    if constexpr (std::is_same_v<Walls, HalfPlane>) s.renumber_walls(4 * s.rectangles.size() + place, 1, 0);
    s.list<Walls>().erase(place);
}

template <class Walls>
void World::set(WallId<Walls> id, const std::type_identity_t<Walls>& walls) {
    State& s = *state_;
    const std::size_t place = s.place_of<Walls>(id.number, "WallId");
    check_given(walls);
    s.change_for_all();
    s.list<Walls>()[place] = walls;
}

template <class Walls>
bool World::contains(WallId<Walls> id) const {
    return state_->find<Walls>(id.number).has_value();
}
template <class Walls>
Walls World::wall(WallId<Walls> id) const {
    return state_->list<Walls>()[state_->place_of<Walls>(id.number, "WallId")];
}
template <class Walls>
WallId<Walls> World::wall_id(std::size_t place) const {
    return {state_->number_at<Walls>(place)};
}

#define CAROM_WITH_ID(T, Id, get, get_id)                            \
    template void World::remove(Id<T>);                              \
    template void World::set(Id<T>, const std::type_identity_t<T>&); \
    template bool World::contains(Id<T>) const;                      \
    template T World::get(Id<T>) const;                              \
    template Id<T> World::get_id<T>(std::size_t) const;
#define CAROM_FORCE(T) CAROM_WITH_ID(T, ForceId, force, force_id)
#define CAROM_WALLS(T) CAROM_WITH_ID(T, WallId, wall, wall_id)
CAROM_FORCE(Spring)
CAROM_FORCE(TorsionSpring)
CAROM_FORCE(Drag)
CAROM_FORCE(Attraction)
CAROM_FORCE(SoftDiscs)
CAROM_FORCE(ConstantForce)
CAROM_FORCE(ForceField)
CAROM_FORCE(UserForce)
CAROM_WALLS(Rectangle)
CAROM_WALLS(HalfPlane)
CAROM_WALLS(Stadium)
#undef CAROM_WALLS
#undef CAROM_FORCE
#undef CAROM_WITH_ID

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
