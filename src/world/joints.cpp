// The joints of a world.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/elementary.hpp"
#include "state/nearest.hpp"
#include "world/in_series.hpp"
#include "world/state.hpp"

namespace carom {

namespace {

void check_name(const Joint& joint, const std::vector<Joint>& others, const Joint* self = nullptr) {
    if (joint.name.empty()) return;
    for (const Joint& other : others)
        if (&other != self && other.name == joint.name)
            throw Error(
                fmt::format("{}.name must be unique, and there is a joint '{}' already", called(joint), joint.name));
}

/// Joints wake those they hold.
void stir_held(const Joint& joint, const Bodies& bodies, SoftContacts& contacts) {
    if (joint.a && bodies.contains(*joint.a)) contacts.stir(bodies.row(*joint.a));
    if (bodies.contains(joint.b)) contacts.stir(bodies.row(joint.b));
}

/// One end of a joint, as far as it matters whether its body turns.
struct HeldEnd {
    bool dynamic = false, turns = false;
    bool off_centre = false;
};

/// A point has no moment of inertia and does not turn: where it cannot follow otherwise, a joint away from its centre
/// holds it where it is, and hangs it on nothing.
void check_turning(const Joint& joint, const HeldEnd& a, const HeldEnd& b, const Bodies& bodies) {
    const auto refuse = [&](const std::optional<BodyId>& point, const char* end, const std::string& why) {
        const auto name = bodies.name.find(point->index);
        throw Error(
            fmt::format("{}.{} must be a body that turns, and {} has no moment of inertia: {}. Give it a radius, "
                        "shapes or a moment_of_inertia, or hold it by a distance joint",
                        called(joint), end, name == bodies.name.end() ? "this" : "'" + name->second + "'", why));
    };
    const auto is_point = [](const HeldEnd& end) { return end.dynamic && !end.turns; };
    const auto* const weld = std::get_if<WeldJoint>(&joint.type);
    if (weld) {
        const std::string why = "a weld to it keeps the other body from turning";
        if (is_point(b) && a.dynamic && a.turns) refuse(joint.b, "b", why);
        if (is_point(a) && b.dynamic && b.turns) refuse(joint.a, "a", why);
    }
    const std::string why = fmt::format("a {} away from its centre holds it still",
                                        std::visit([](const auto& type) { return type.name; }, joint.type));
    if (std::holds_alternative<WheelJoint>(joint.type) && is_point(b) && b.off_centre) refuse(joint.b, "b", why);
    if (!std::holds_alternative<RevoluteJoint>(joint.type) && !(weld && weld->spring)) return;
    // One that turns about a point other than its centre carries the other along.
    if ((a.turns && a.off_centre) || (b.turns && b.off_centre)) return;
    if (is_point(b) && b.off_centre) refuse(joint.b, "b", why);
    if (is_point(a) && a.off_centre) refuse(joint.a, "a", why);
}

/// Whether an anchor lies elsewhere than in the centre, whatever rounding has put between them.
bool is_off_centre(Vec2 anchor, Vec2 position) { return length(anchor) > 1e-9 * length(position) + 1e-15; }

}  // namespace

void World::State::check_turning(const Joint& joint, std::optional<BodyId> point) const {
    const auto hold = [&](const std::optional<BodyId>& id, Vec2 anchor) -> HeldEnd {
        if (!id) return {};
        const std::size_t row = bodies.row(*id);
        const bool off_centre = is_off_centre(anchor, motion.x.linear[row]);
        if (id == point) return {.dynamic = true, .turns = false, .off_centre = off_centre};
        // One without inertia keeps the spin that it has.
        const bool keeps_turning = bodies.kind[row] == Kind::driven || motion.v.angular[row] != 0;
        const bool dynamic = bodies.inverse_mass[row] != 0;
        // A joint may well hold one of fixed rotation off its centre: that is what was asked for.
        const bool turns = keeps_turning || (dynamic && bodies.inertia[row] != 0);
        return {.dynamic = dynamic, .turns = turns, .off_centre = off_centre};
    };
    carom::check_turning(joint, hold(joint.a, joint.anchor_a), hold(joint.b, joint.anchor_b), bodies);
}

void World::State::stir_joined(BodyId id) {
    for (const std::uint32_t k : mechanisms.holders.of(id, mechanisms.joints))
        stir_held(mechanisms.joints[k], bodies, soft_contacts);
}

void World::State::check_joints(BodyId id, const Body& made) {
    const bool turns = made.moment_of_inertia.value_or(made.radius) > 0 || made.angular_velocity != 0;
    if (made.kind == Kind::dynamic && turns) return;
    const std::vector<Joint>& joints = current_joints();
    const auto is_dynamic = [&](BodyId other) { return other != id && bodies.inverse_mass[bodies.row(other)] != 0; };
    for (const std::uint32_t k : mechanisms.holders.of(id, joints)) {
        if (made.kind == Kind::dynamic)
            check_turning(joints[k], id);
        else if (!is_dynamic(joints[k].b) && !(joints[k].a && is_dynamic(*joints[k].a)))
            throw Error(fmt::format("Body.kind must be dynamic: {} holds the body and no other dynamic one",
                                    called(joints[k])));
    }
}

void World::State::move_anchors(BodyId id, Vec2 by) {
    const auto follow = [&](auto& held) {
        if (held.a == id) held.anchor_a += by;
        if (held.b == id) held.anchor_b += by;
    };
    for (const std::uint32_t k : mechanisms.holders.of(id, mechanisms.joints))
        follow(mechanisms.joints[k]), note_change(mechanisms, k);
    for (std::size_t i = 0; i < forces.springs.size(); ++i) follow(forces.springs[i]);
    for (std::size_t i = 0; i < forces.constant_forces.size(); ++i)
        if (forces.constant_forces[i].body == id) forces.constant_forces[i].point += by;
}

const std::vector<Joint>& World::State::current_joints() {
    current_forces();
    return mechanisms.joints;
}

std::size_t World::State::place_of(JointId id) {
    current_joints();
    const auto& ids = mechanisms.ids;
    const auto found =
        std::lower_bound(ids.begin(), ids.end(), id, [](JointId a, JointId b) { return a.number < b.number; });
    if (found != ids.end() && *found == id) return static_cast<std::size_t>(found - ids.begin());
    if (id.number == 0 || id.number > joints_given)
        throw Error("JointId must come from World::add of this world, got one that no joint ever had");
    throw Error(fmt::format("JointId is stale: joint {} was removed from this world, or broke", id.number));
}

namespace {

/// How much more a joint bore in a step than it can, as a ratio; of what sleeps there is no other reaction.
double overload(const Joint& joint, JointMemory& own) {
    const double force = std::max(std::exchange(own.most_force, 0), length(own.reaction.force)),
                 torque = std::max(std::exchange(own.most_torque, 0), std::abs(own.reaction.torque));
    return std::max(joint.break_force ? force / *joint.break_force : 0,
                    joint.break_torque ? torque / *joint.break_torque : 0);
}

/// The places of the joints that break now, ascending: who bears too much, but of those in series the worst alone. What
/// the others bear without it the next step tells.
std::vector<std::uint32_t> breaking(Mechanisms& mechanisms, const Bodies& bodies) {
    std::vector<std::pair<double, std::uint32_t>> over;
    for (const std::uint32_t k : mechanisms.breakable)
        if (const double load = overload(mechanisms.joints[k], mechanisms.memory[k]); load > 1)
            over.emplace_back(-load, k);
    if (over.empty()) return {};
    if (over.size() == 1) return {over[0].second};
    std::sort(over.begin(), over.end());
    const JointsInSeries series(mechanisms.joints, bodies);
    std::vector<std::uint32_t> chosen;
    for (const auto& [load, k] : over)
        if (std::none_of(chosen.begin(), chosen.end(),
                         [&, k = k](std::uint32_t worse) { return series.holds(k, worse); }))
            chosen.push_back(k);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

}  // namespace

void World::State::break_joints() {
    std::vector<JointId>& broken = events.broken;
    broken.clear();
    const std::vector<std::uint32_t> breaks = breaking(mechanisms, bodies);
    for (std::size_t i = breaks.size(); i-- > 0;) {
        const std::uint32_t k = breaks[i];
        const Joint& joint = mechanisms.joints[k];
        broken.push_back(mechanisms.ids[k]);
        // What its springs held becomes heat.
        const double held =
            spring_energy(joint, {joint, end_of(joint.a, bodies, motion), end_of(joint.b, bodies, motion)});
        motion.account[Account::joint_damping] += held, motion.account[Account::spring] += held;
        stir_held(joint, bodies, soft_contacts);
        if (!together.empty()) {
            if (joint.a) let_go.push_back(*joint.a);
            let_go.push_back(joint.b);
        }
        erase(mechanisms, k);
    }
    std::reverse(broken.begin(), broken.end());
    if (broken.empty()) return;
    assemble(mechanisms, bodies, motion.x);
    soft_contacts.forget_search();
}

JointId World::add(const Joint& joint) {
    State& s = *state_;
    const Joint made = completed(joint, s.bodies, s.motion);
    s.check_turning(made);
    check_name(made, s.mechanisms.joints);
    s.change();
    stir_held(made, s.bodies, s.soft_contacts);
    const JointId id{++s.joints_given};
    carom::add(s.mechanisms, id, made);
    return id;
}

void World::remove(JointId id) {
    State& s = *state_;
    const std::size_t k = s.place_of(id);
    s.change();
    stir_held(s.mechanisms.joints[k], s.bodies, s.soft_contacts);
    erase(s.mechanisms, k);
}

namespace {

/// Whether what is remembered of the rows of one joint, such as at which limit they are, makes sense for another.
bool have_like_rows(const Joint& a, const Joint& b) {
    Law of_a[most_rows], of_b[most_rows];
    const std::size_t rows = laws_of(a, of_a);
    const auto are_alike = [](const Law& law, const Law& other) {
        return law.kind == other.kind && law.turns == other.turns && (law.most > 0) == (other.most > 0) &&
               std::isfinite(law.lower) == std::isfinite(other.lower) &&
               std::isfinite(law.upper) == std::isfinite(other.upper);
    };
    return a.type.index() == b.type.index() && laws_of(b, of_b) == rows &&
           std::equal(of_a, of_a + rows, of_b, are_alike);
}

}  // namespace

void World::set(JointId id, const Joint& joint) {
    State& s = *state_;
    const std::size_t k = s.place_of(id);
    Joint& now = s.mechanisms.joints[k];
    Joint given = joint;
    // Anchors that it has are those that joint() told, and no other place for it.
    if (given.at && given.anchor_a == now.anchor_a && given.anchor_b == now.anchor_b)
        given.anchor_a = given.anchor_b = {};
    const Joint made = completed(given, s.bodies, s.motion);
    s.check_turning(made);
    check_name(made, s.mechanisms.joints, &now);
    s.change();
    stir_held(now, s.bodies, s.soft_contacts), stir_held(made, s.bodies, s.soft_contacts);
    if (!have_like_rows(now, made)) s.mechanisms.memory[k] = {.id = id};
    now = made;
    note_change(s.mechanisms, k);
}

std::span<const Joint> World::joints() const { return state_->current_joints(); }
std::span<const JointId> World::joint_ids() const {
    state_->current_joints();
    return state_->mechanisms.ids;
}
std::vector<JointId> World::joints(BodyId id) const {
    state_->bodies.row(id);
    Mechanisms& mechanisms = state_->mechanisms;
    std::vector<JointId> held;
    for (const std::uint32_t k : mechanisms.holders.of(id, state_->current_joints())) held.push_back(mechanisms.ids[k]);
    return held;
}
bool World::contains(JointId id) const {
    const auto ids = joint_ids();
    return std::binary_search(ids.begin(), ids.end(), id);
}
JointId World::find_joint(std::string_view name) const {
    std::vector<std::string> known;
    for (std::size_t k = 0; k < joints().size(); ++k) {
        const std::string& own = joints()[k].name;
        if (!own.empty() && own == name) return state_->mechanisms.ids[k];
        if (!own.empty()) known.push_back(own);
    }
    throw Error(fmt::format("there is no joint '{}'{}", name, did_you_mean(name, known)));
}
Joint World::joint(JointId id) const { return state_->mechanisms.joints[state_->place_of(id)]; }
// What it bears is that of the last substep, and how it lies that of the bodies as they are.
Reaction World::reaction(JointId id) const {
    State& s = *state_;
    const std::size_t k = s.place_of(id);
    const Joint& joint = s.mechanisms.joints[k];
    Reaction out = s.mechanisms.memory[k].reaction;
    Law laws[most_rows];
    JointRow rows[most_rows];
    const std::size_t count = laws_of(joint, laws);
    out.coordinate =
        rows_of(joint, {joint, end_of(joint.a, s.bodies, s.motion), end_of(joint.b, s.bodies, s.motion)}, rows);
    double gap = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double error = laws[i].turns ? 0 : out_of(laws[i], rows[i].error);
        gap += error * error;
    }
    out.gap = std::sqrt(gap);
    return out;
}

Breach World::breach(JointId id) const {
    State& s = *state_;
    const Joint& joint = s.mechanisms.joints[s.place_of(id)];
    const auto rate = [&s](const double* row, const std::optional<BodyId>& body) {
        if (!body) return 0.0;
        const std::size_t i = s.bodies.row(*body);
        return dot({row[0], row[1]}, s.motion.v.linear[i]) + row[2] * s.motion.v.angular[i];
    };
    Law laws[most_rows];
    JointRow rows[most_rows];
    const std::size_t count = laws_of(joint, laws);
    rows_of(joint, {joint, end_of(joint.a, s.bodies, s.motion), end_of(joint.b, s.bodies, s.motion)}, rows);
    Breach out;
    for (std::size_t i = 0; i < count; ++i) {
        if (laws[i].kind != Law::Kind::rigid) continue;
        double& sum = laws[i].turns ? out.spin : out.speed;
        sum = portable::hypot(sum, rate(rows[i].a, joint.a) + rate(rows[i].b, joint.b));
    }
    return out;
}

}  // namespace carom
