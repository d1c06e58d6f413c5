// What is kept of joints, and the books of what they did.

#include <algorithm>
#include <numeric>
#include <utility>

#include "solvers/parts.hpp"

namespace carom {

namespace {

/// Keeps those of a list that are wanted.
template <class List>
void keep(List& list, const Scratch<bool>& wanted) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < list.size(); ++k)
        if (wanted[k] && kept++ != k) list[kept - 1] = std::move(list[k]);
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(kept), list.end());
}

}  // namespace

double damping_of(const JointLine* lines, std::uint32_t row, double h) {
    const JointLine& line = lines[row];
    const Law& law = *line.law;
    if (law.most == HUGE_VAL) return -law.damping * (line.last.error - line.first.error);
    const auto pull = [&law](const JointLine& l) { return -0.5 * law.stiffness * (l.first.error + l.last.error); };
    const double whole = law.paired ? length(Vec2{pull(lines[0]), pull(lines[1])}) : std::abs(pull(line));
    return line.before + line.after - h * (whole > law.most ? law.most / whole : 1) * pull(line);
}

KeptApart::KeptApart(const std::vector<Joint>& joints, const Bodies& bodies) {
    Scratch<std::array<std::uint32_t, 2>> pairs;
    for (const Joint& joint : joints) {
        if (!joint.a || joint.collide) continue;
        const auto a = static_cast<std::uint32_t>(bodies.row(*joint.a)),
                   b = static_cast<std::uint32_t>(bodies.row(joint.b));
        pairs.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(pairs.begin(), pairs.end());
    end_.assign(pairs.empty() ? 0 : pairs.back()[0] + std::size_t{2}, 0);
    for (const auto& [a, b] : pairs) ++end_[a + 1], others_.push_back(b);
    std::inclusive_scan(end_.begin(), end_.end(), end_.begin());
}

Scratch<std::uint32_t> Holders::of(BodyId id, const std::vector<Joint>& joints) {
    const auto each_end = [&joints](const auto& act) {
        for (std::uint32_t k = 0; k < joints.size(); ++k) {
            if (joints[k].a) act(k, joints[k].a->index);
            act(k, joints[k].b.index);
        }
    };
    Scratch<std::uint32_t> found;
    for (const std::uint32_t k : places_.of(id.index, each_end))
        if (joints[k].a == id || joints[k].b == id) found.push_back(k);
    return found;
}

void add(Mechanisms& mechanisms, JointId id, const Joint& joint) {
    mechanisms.joints.push_back(joint), mechanisms.ids.push_back(id), mechanisms.memory.push_back({.id = id});
    mechanisms.home.push_back(no_mechanism);
    mechanisms.holders.forget();
}

void erase(Mechanisms& mechanisms, std::size_t joint) {
    mechanisms.holders.forget();
    const auto from = [joint](auto& list) { list.erase(list.begin() + static_cast<std::ptrdiff_t>(joint)); };
    from(mechanisms.joints), from(mechanisms.ids), from(mechanisms.memory), from(mechanisms.home);
}

void note_change(Mechanisms& mechanisms, std::size_t joint) {
    mechanisms.home[joint] = no_mechanism;
    mechanisms.holders.forget();
}

bool is_among_holders(Mechanisms& mechanisms, BodyId id) {
    const auto held_by_several = [&](std::uint32_t k) {
        if (mechanisms.home[k] == no_mechanism) return false;
        const std::vector<Member>& members = mechanisms.all[mechanisms.home[k]].members;
        return std::count_if(members.begin(), members.end(), [](const Member& m) { return m.outside; }) > 1;
    };
    const Scratch<std::uint32_t> joints = mechanisms.holders.of(id, mechanisms.joints);
    return std::any_of(joints.begin(), joints.end(), held_by_several);
}

void forget_removed(Mechanisms& mechanisms, const Bodies& bodies) {
    const auto is_held = [&bodies](const Joint& joint) {
        return bodies.contains(joint.b) && (!joint.a || bodies.contains(*joint.a));
    };
    if (std::all_of(mechanisms.joints.begin(), mechanisms.joints.end(), is_held)) return;
    Scratch<bool> wanted;
    for (const Joint& joint : mechanisms.joints) wanted.push_back(is_held(joint));
    mechanisms.holders.forget();
    keep(mechanisms.joints, wanted), keep(mechanisms.ids, wanted), keep(mechanisms.memory, wanted);
    keep(mechanisms.home, wanted);
}

void keep_remembered(Mechanisms& mechanisms, std::vector<NumberedJoint> brought) {
    std::vector<JointId> ids;
    std::vector<Joint> joints;
    auto known = mechanisms.ids.begin();
    auto other = brought.begin();
    for (const JointMemory& own : mechanisms.memory) {
        if (!ids.empty() && !(ids.back() < own.id)) Loader::fail();
        known = std::lower_bound(known, mechanisms.ids.end(), own.id);
        other = std::find_if(other, brought.end(), [&own](const NumberedJoint& one) { return one.first >= own.id; });
        if (known != mechanisms.ids.end() && *known == own.id)
            joints.push_back(std::move(mechanisms.joints[static_cast<std::size_t>(known - mechanisms.ids.begin())]));
        else if (other != brought.end() && other->first == own.id)
            joints.push_back(std::move(other->second));
        else
            throw Error("the state has joints that this world has not: it has to be made as the one that was saved");
        ids.push_back(own.id);
    }
    mechanisms.ids = std::move(ids), mechanisms.joints = std::move(joints);
    mechanisms.home.assign(mechanisms.joints.size(), no_mechanism);  // what they did is another state's
    mechanisms.holders.forget();
}

void note_asleep(const Rest& rest, Mechanisms& mechanisms) {
    for (Mechanism& m : mechanisms.all)
        for (const Mechanism::Part& p : m.parts)
            if (p.inverse_mass != 0) m.is_asleep = p.row < rest.asleep.size() && rest.asleep[p.row] != 0;
}

void note_touched(const SoftScene& scene, const SoftContacts& contacts) {
    if (scene.mechanisms.empty()) return;
    Scratch<bool> touched(contacts.motion.movers.size(), false);
    for (const SoftContact& c : contacts.all) touched[c.a] = touched[c.b] = true;
    note_asleep(contacts.rest, scene.mechanisms);
    order_awake(scene.mechanisms);
    scene.mechanisms.carries.assign(contacts.motion.movers.size(), false);
    for (Mechanism& m : scene.mechanisms.all) {
        m.is_touched = false, m.may_have_moved = true;
        bool is_driven = false;
        for (const Mechanism::Part& p : m.parts) {
            if (p.inverse_mass == 0) {
                is_driven = is_driven || (p.row < scene.bodies.size() && scene.bodies.kind[p.row] != Kind::fixed);
                continue;
            }
            m.is_touched = m.is_touched || touched[p.row];
        }
        // Who sleeps is seen by others, and what rows say in loops depends on what was asked before.
        if (m.is_asleep || m.may_become_redundant()) m.prepared = 0;
        m.is_carried = !m.is_touched && !m.is_asleep && !is_driven;
        for (const Mechanism::Part& p : m.parts)
            if (m.is_carried && p.inverse_mass != 0) scene.mechanisms.carries[p.row] = true;
    }
}

namespace {

/// The books of a mechanism's substep.
class Books {
  public:
    /// What is booked, and how much of the work of all is explained by it.
    struct Booked {
        Flows account{};
        double explained = 0;
        void operator+=(const Booked& more) { account += more.account, explained += more.explained; }
    };

    Books(const Mechanism& m, double h, const MeanVelocities& means, const State& state)
        : m_(m), h_(h), means_(means), state_(state) {}
    void book(const Member& k, Booked& to) const {
        for (std::uint32_t i = k.outside ? 0 : k.rigid; i < k.lines; ++i) book(k, i, m_.lines[k.line + i], to);
    }
    /// After all joints: what no account of theirs explains is the method's.
    void book_rest(int threads, Booked& to) const {
        struct Others {
            double spins = 0, whole = 0;
            void operator+=(Others more) { whole += more.whole, spins += more.spins; }
        };
        const auto add = [&](std::size_t first, std::size_t last, Others& rest) {
            for (std::size_t i = first; i < last; ++i) {
                const Mechanism::Part& p = m_.parts[i];
                if (p.inverse_mass == 0) continue;
                rest.whole += along(p.given, means_.all[i]);
                // Who has nothing that could be turned keeps the spin of such a body.
                if (p.inverse_inertia == 0) rest.spins += p.given[2] * means_.all[i][2];
            }
        };
        Others rest{-to.account[Account::driven]};
        add_over_rows(threads, m_.parts.size(), rest, add);
        to.account[Account::driven] = -rest.spins;
        to.account[Account::method] += rest.whole - to.explained;
    }

  private:
    using Velocity = std::array<double, 3>;

    static double along(const double* j, const Velocity& v) { return j[0] * v[0] + j[1] * v[1] + j[2] * v[2]; }
    bool moves(std::uint32_t part) const { return m_.parts[part].inverse_mass != 0; }
    static void take(Account account, double work, double sign, Booked& to) {
        to.account[account] += sign * work;
        to.explained += work;
    }

    void book(const Member& k, std::uint32_t row, const JointLine& line, Booked& to) const {
        if (k.outside) hold(k, line, to);
        const double impulse = line.before + line.after;
        if (impulse == 0 || row < k.rigid || line.law->kind == Law::Kind::rigid) return;
        const double first = means_.along(k, row, line.first), last = means_.along(k, row, line.last);
        const double work = line.before * first + line.after * last;
        if (line.law->kind == Law::Kind::spring) {
            const double damped = damping_of(&m_.lines[k.line], row, h_) * 0.5 * (first + last);
            take(Account::joint_damping, damped, -1, to);
            take(Account::spring, work - damped, 1, to);
            return;
        }
        const double most = h_ * line.law->most, driven = std::clamp(impulse, -most, most) / impulse;
        const JointLine* const lines = &m_.lines[k.line];
        const bool drives =
            is_of_speed(*line.law) ? lines[0].first.error != 0 || lines[1].first.error != 0 : line.law->speed != 0;
        if (drives)
            take(Account::motor, driven * work, 1, to);
        else
            take(Account::joint_friction, driven * work, -1, to);
        take(Account::limit, (1 - driven) * work, -1, to);
    }

    /// Who holds a body, or the ground, gives momentum, and if it is driven, energy.
    void hold(const Member& k, const JointLine& line, Booked& to) const {
        const auto give = [&](const JointRow& j, double impulse, bool at_start) {
            Wrench w;
            for (const std::uint32_t part : {k.a, k.b}) {
                const double* side = part == k.a ? j.a : j.b;
                if (!moves(part)) {
                    const double work = -impulse * along(side, means_.all[part]);
                    take(Account::driven, work, 1, to);
                    continue;
                }
                const Vec2 x = at_start ? m_.parts[part].start.position : state_.x.linear[m_.parts[part].row],
                           p{impulse * side[0], impulse * side[1]};
                w.add(p, cross(x, p) + impulse * side[2]);
            }
            to.account[Giver::held].add(w.force, w.torque);
            to.account[Giver::method].add(-w.force, -w.torque);
        };
        give(line.first, line.before + line.blow, true);
        give(line.last, line.after, false);
    }

    const Mechanism& m_;
    double h_;
    const MeanVelocities& means_;
    const State& state_;
};

/// With what force a row is to begin the next substep, in one half of it. The mean of both halves is what was asked of
/// it. But where the first half was as expected, the second took back the velocities that were let be in a few
/// substeps, and not what this one made alone: half of the way to the mean needs half as many solves.
double half_of(const Mechanism& m, const JointLine& line, double h, bool halves) {
    if (!halves) return line.before / h;
    constexpr double much = 100;  // times what it was before the drift: at a dead point, where that does not last
    const bool lasts = line.before == 0 || std::abs(line.after) <= much * std::abs(line.before);
    if (!m.is_dear) return (lasts ? line.after : line.before) / h;
    const double mean = 0.5 * (line.before + line.after);
    return (line.before == h * line.half ? 0.5 * (line.before + mean) : mean) / h;
}
/// Keeps the forces of a joint.
void keep(const Mechanism& m, const Member& k, double h, bool halves, JointMemory& memory) {
    for (std::uint32_t i = 0; i < k.lines; ++i) {
        const JointLine& line = m.lines[k.line + i];
        memory.step[i] = line.step;
        const double pull = (line.before + line.after) / h;
        memory.mean[i] = 0.5 * (memory.pull[i] + pull);
        memory.pull[i] = pull, memory.force[i] = pull + line.blow / h;
        memory.half[i] = half_of(m, line, h, halves);
    }
    memory.projections = m.is_projected && !m.is_given_up ? memory.projections + 1 : 0;
    memory.was_slow = m.is_slow;
}

/// What a joint bears; how it lies is asked of the bodies as they are.
Reaction reaction_of(const Mechanism& m, const Member& k, const JointMemory& memory) {
    Vec2 force{};
    double torque = 0;
    for (std::uint32_t i = 0; i < k.lines; ++i) {
        const JointLine& line = m.lines[k.line + i];
        force += memory.force[i] * Vec2{line.last.b[0], line.last.b[1]};
        torque += memory.force[i] * line.last.b[2];
    }
    const Ends ends(k.anchor_a, k.anchor_b, m.parts[k.a].now, m.parts[k.b].now);
    return {.force = force, .torque = torque - cross(ends.lever_b, force)};
}
/// A jerk is over in a substep, and need not be in the last one of a step.
void note_most(const Mechanism& m, const Member& k, JointMemory& memory) {
    const Reaction r = reaction_of(m, k, memory);
    memory.most_force = std::max(memory.most_force, length(r.force));
    memory.most_torque = std::max(memory.most_torque, std::abs(r.torque));
}

}  // namespace

void end_substep(const SoftScene& scene, Mechanisms& mechanisms, double h, const MeanVelocities& means,
                 const State& state, Mechanism& m, Flows& account) {
    const int threads = threads_within(scene);
    struct Done : Books::Booked {
        bool any_gapes = false;
        void operator+=(const Done& more) {
            Booked::operator+=(more);
            any_gapes = any_gapes || more.any_gapes;
        }
    };
    Done done{{account}};
    const Books books(m, h, means, state);
    forget_stiffness(threads, m);
    each_joint(
        threads, m, done,
        [&](const Member& k, Done& sum) {
            books.book(k, sum);
            keep(m, k, h, gives_halves(scene), mechanisms.memory[k.joint]);
            if (k.breaks) note_most(m, k, mechanisms.memory[k.joint]);
            sum.any_gapes = sum.any_gapes || gapes(m, k, &JointLine::last);
            prepare_rows(mechanisms, h, true, k, m);
        },
        [&](const Member& k, auto sides) { stiffen(mechanisms, k, sides, m); });
    books.book_rest(threads, done);
    account = done.account;
    m.prepared = 0;
    if (done.any_gapes) return;
    prepare_parts(threads, h, m);
    m.prepared = h, m.may_have_moved = false;
}

namespace {
void note_reactions(int threads, Mechanisms& all, const Mechanism& m) {
    for_each_rows(threads, m.members.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Member& k = m.members[i];
            JointMemory& memory = all.memory[k.joint];
            memory.reaction = reaction_of(m, k, memory);
        }
    });
}
}  // namespace

void note_reactions(const SoftScene& scene, Mechanisms& mechanisms) {
    const auto is_one = [](const Mechanism&) { return true; };
    each_awake(scene, mechanisms, is_one, [&](Mechanism& m) { note_reactions(threads_within(scene), mechanisms, m); });
}

namespace {
/// Sees a mechanism that sleeps where it is.
void see_at_rest(int threads, Mechanisms& all, const State& state, const std::vector<Frame>& frames, Mechanism& m) {
    const auto see_joint = [&](const Member& k) {
        look(m, k, all.joints, &JointLine::last);
        for (std::uint32_t r = 0; r < k.lines; ++r) m.lines[k.line + r].step = all.memory[k.joint].step[r];
    };
    each_part(threads, m, [&](Mechanism::Part& p) { see(p, state, frames); });
    each_joint(threads, m, see_joint, [](const Member&, auto) {});
    note_reactions(threads, all, m);
}
}  // namespace

void book_resting(const SoftScene& scene, Mechanisms& mechanisms, const State& state, double dt,
                  const SoftContacts& contacts, Flows& account) {
    const int threads = threads_within(scene);
    const auto sleeps = [&](const Mechanism::Part& p) {
        return moves(scene, p.row) && contacts.rest.asleep[p.row] != 0;
    };
    for (Mechanism& m : mechanisms.all) {
        if (std::none_of(m.parts.begin(), m.parts.end(), sleeps)) continue;
        see_at_rest(threads, mechanisms, state, contacts.motion.frames, m);
        Wrench all;
        for (const Member& k : m.members)
            for (std::uint32_t i = 0; k.outside && i < k.lines; ++i) {
                const JointRow& j = m.lines[k.line + i].last;
                const double impulse = dt * mechanisms.memory[k.joint].force[i];
                for (const std::uint32_t part : {k.a, k.b}) {
                    const double* side = part == k.a ? j.a : j.b;
                    if (m.parts[part].inverse_mass == 0) continue;
                    const Vec2 p{impulse * side[0], impulse * side[1]};
                    all.add(p, cross(m.parts[part].now.position, p) + impulse * side[2]);
                }
            }
        account[Giver::held].add(all.force, all.torque);
        account[Giver::method].add(-all.force, -all.torque);
    }
}

}  // namespace carom
