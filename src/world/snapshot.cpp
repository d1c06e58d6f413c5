// A world's state as bytes.

#include <fmt/format.h>

#include <array>

#include "world/shapes.hpp"
#include "world/state.hpp"

namespace carom {

namespace {

static_assert(std::is_trivially_copyable_v<Flows>);

/// Raised where other lists are stored than before, or other members of the same size.
constexpr std::uint64_t version = 11;
/// Bytes of another version, whose accounts are others, are told by their sizes.
constexpr std::uint64_t layout =
    version + sizeof(Flows) + 1000000 * sizeof(Momentum) + 1000 * sizeof(ShapePair) + 1000000000 * sizeof(JointMemory);

/// Of the joints those that may break, for in a world that goes on from the state, or goes back to it, they may have.
std::vector<NumberedJoint> breakable_joints(const Mechanisms& mechanisms) {
    std::vector<NumberedJoint> joints;
    for (const std::uint32_t k : mechanisms.breakable) joints.emplace_back(mechanisms.ids[k], mechanisms.joints[k]);
    return joints;
}

constexpr const char* kinds_of_forces[] = {"springs",      "torsion springs", "drags",
                                           "force fields", "constant forces", "curves"};
/// How many there are of those that go with their bodies.
std::array<std::uint64_t, std::size(kinds_of_forces)> counts_of(const Forces& f) {
    return {f.springs.size(), f.torsion_springs.size(), f.drags.size(),
            f.fields.size(),  f.constant_forces.size(), f.drives.size()};
}
void check_there(const std::array<std::uint64_t, std::size(kinds_of_forces)>& saved, const Forces& forces) {
    const auto there = counts_of(forces);
    for (std::size_t k = 0; k < there.size(); ++k)
        if (there[k] < saved[k])
            throw Error(
                fmt::format("the state has {} {}, and this world {}: it has to be made as the one that was saved",
                            saved[k], kinds_of_forces[k], there[k]));
}

/// The grid and the candidates are made anew in every step.
auto members(Maybe_const<Contacts> auto& contacts) {
    auto& [collisions, grid, candidates] = contacts;
    return std::tie(collisions);
}

}  // namespace

/// The forces are what the next step starts from; all else is made anew.
auto members(Maybe_const<SoftContacts> auto& contacts) {
    return std::tie(contacts.warm, contacts.passing, contacts.rest.warm, contacts.strikes, contacts.rest.still,
                    contacts.rest.calm, contacts.rest.asleep, contacts.rest.told, contacts.rest.owed,
                    contacts.pace.lasted, contacts.pace.slow);
}

/// The queue follows from the events.
auto members(Maybe_const<EventGas> auto& gas) { return std::tie(gas.data, gas.whole.discs); }

/// What changes while a world moves. What the scene or the user gave, and what is derived from it, stays out.
template <class S>
auto World::State::stored(S& world) {
    auto& [settings, bodies, motion, forces, rectangles, half_planes, stadiums, periodic, time, steps, contacts,
           soft_contacts, mechanisms, joints_given, let_go, gas, memory, touching, sensed, touching_at_rest, events,
           profile, at_work, put, holds_removed, edited, changed, dynamics, walls, pieces, fitting_rows, places,
           together, any_sensor, sensor_sweep, beyond_solver, may_rest, given, before_edit] = world;
    return std::tuple_cat(std::tie(bodies, motion, time, steps, memory, given, touching, sensed, touching_at_rest,
                                   joints_given, let_go, mechanisms.memory, mechanisms.cuts),
                          members(contacts), members(soft_contacts), members(gas));
}

void World::save(Saver& to) const {
    state_->close_edits();
    to(layout);
    std::apply(to, State::stored(std::as_const(*state_)));
    to(breakable_joints(state_->mechanisms), counts_of(state_->forces));
}

void World::restore(Loader& from) {
    state_->check_idle();
    auto next = std::make_unique<State>(*state_);
    next->close_edits();
    std::uint64_t saved = 0;
    from(saved);
    if (saved != layout) throw Error("the state is that of another version of Carom");
    next->soft_contacts = {};  // what is not stored of them is of another state
    std::apply(from, State::stored(*next));
    std::vector<NumberedJoint> brought;
    auto forces = counts_of({});
    from(brought, forces);
    next->bodies.check_members(next->motion);
    for (const auto& [id, joint] : brought) completed(joint, next->bodies, next->motion);  // or an Error
    keep_remembered(next->mechanisms, std::move(brought));
    for (const auto& shapes : next->bodies.shapes) check_shapes(shapes, "a body");
    // The rest follows. Driven bodies are where they were, to the last bit, and not put there anew.
    next->gas.whole.queued = false;
    next->holds_removed = true;
    check_there(forces, next->current_forces());
    next->fitting_rows = 0;
    next->events = {};
    next->derive();
    state_ = std::move(next);
}

}  // namespace carom
