// Which joints hang together, and the books of what they did.

#include <algorithm>
#include <numeric>

#include "forces/gains.hpp"
#include "solvers/parts.hpp"

namespace carom {

namespace {

constexpr std::uint32_t no_index = 0xffffffff;

/// Rows of a joint's bodies; the ground is the row after the last.
struct Pair {
    std::uint32_t a, b;
};
Pair rows_of(const Joint& joint, const Bodies& bodies) {
    const auto row = [&](BodyId id) { return static_cast<std::uint32_t>(bodies.row(id)); };
    return {joint.a ? row(*joint.a) : static_cast<std::uint32_t>(bodies.size()), row(joint.b)};
}

/// A length to compare gaps with.
double size_of(const Joint& joint) {
    double size = std::max(length(joint.anchor_b), joint.a ? length(joint.anchor_a) : 0);
    if (const auto* rod = std::get_if<DistanceJoint>(&joint.type)) size = std::max(size, rod->length.value_or(0));
    if (const auto* rope = std::get_if<PulleyJoint>(&joint.type)) size = std::max(size, rope->length.value_or(0));
    return size > 0 ? size : 1;
}

/// Puts joints into mechanisms, one by one.
class Assembly {
  public:
    Assembly(Mechanisms& mechanisms, const Bodies& bodies)
        : to_(mechanisms), bodies_(bodies), root_(bodies.size()), place_(bodies.size() + 1, no_index) {
        std::iota(root_.begin(), root_.end(), 0U);
    }
    void run() {
        to_.all.clear();
        for (const Joint& joint : to_.joints) unite(rows_of(joint, bodies_));
        std::vector<std::uint32_t> mechanism_of(bodies_.size(), no_index);
        for (std::uint32_t k = 0; k < to_.joints.size(); ++k) {
            Law laws[most_rows];
            if (laws_of(to_.joints[k], laws) == 0) continue;
            const auto [a, b] = rows_of(to_.joints[k], bodies_);
            std::uint32_t& index = mechanism_of[find(moves(b) ? b : a)];
            if (index == no_index) index = static_cast<std::uint32_t>(to_.all.size()), to_.all.emplace_back();
            joints_.resize(to_.all.size());
            joints_[index].push_back(k);
        }
        for (std::uint32_t i = 0; i < to_.all.size(); ++i) {
            fill(to_.all[i], joints_[i]);
            share(i);
        }
    }

  private:
    bool moves(std::uint32_t row) const { return row < bodies_.size() && bodies_.inverse_mass[row] != 0; }
    std::uint32_t find(std::uint32_t i) {
        while (root_[i] != i) i = root_[i] = root_[root_[i]];
        return i;
    }
    void unite(const Pair& rows) {
        if (!moves(rows.a) || !moves(rows.b)) return;
        const std::uint32_t a = find(rows.a), b = find(rows.b);
        root_[std::max(a, b)] = std::min(a, b);
    }
    std::uint32_t part(std::uint32_t row, Mechanism& m) {
        std::uint32_t& place = place_[row];
        if (place != no_index) return place;
        place = static_cast<std::uint32_t>(m.parts.size());
        m.parts.push_back({row, 0, 0});
        if (row < bodies_.size())
            m.parts.back().inverse_mass = bodies_.inverse_mass[row],
            m.parts.back().inverse_inertia = bodies_.inverse_inertia[row];
        return place;
    }
    /// What the mechanisms of a crowd have in common is kept once: they are many more than fit into a cache.
    void share(std::uint32_t i) {
        Mechanism& m = to_.all[i];
        const auto of_one_before = [&](auto own, auto Mechanism::*common) {
            const bool is_equal = i > 0 && own == *(to_.all[i - 1].*common);
            m.*common = is_equal ? to_.all[i - 1].*common : std::make_shared<decltype(own)>(std::move(own));
            return is_equal;
        };
        m.kind = of_one_before(std::move(shape_), &Mechanism::shape) ? to_.all[i - 1].kind : i;
        of_one_before(std::move(laws_), &Mechanism::laws);
        for (std::size_t k = 0; k < m.lines.size(); ++k) m.lines[k].law = &(*m.laws)[k];
    }
    void fill(Mechanism& m, const std::vector<std::uint32_t>& joints) {
        shape_ = {}, laws_.clear();
        std::size_t widest = 1;
        for (const std::uint32_t k : joints) {
            const Joint& joint = to_.joints[k];
            const Pair rows = rows_of(joint, bodies_);
            Law laws[most_rows];
            const std::size_t count = laws_of(joint, laws);
            const bool grounded = std::holds_alternative<GearJoint>(joint.type) ||
                                  std::holds_alternative<PulleyJoint>(joint.type) || !moves(rows.a) || !moves(rows.b);
            const auto* hinge = std::get_if<RevoluteJoint>(&joint.type);
            const auto* weld = std::get_if<WeldJoint>(&joint.type);
            const double rest = hinge ? hinge->rest_angle.value_or(0) : weld ? weld->rest_angle.value_or(0) : 0;
            std::uint32_t rigid = 0;
            while (rigid < count && laws[rigid].kind == Law::Kind::rigid) ++rigid;
            const JointShape shape{part(rows.a, m),
                                   part(rows.b, m),
                                   static_cast<std::uint32_t>(m.lines.size()),
                                   static_cast<std::uint32_t>(count),
                                   rigid,
                                   0,
                                   hinge || weld};
            m.members.push_back(
                {shape, k, grounded, size_of(joint), 1 / size_of(joint), joint.anchor_a, joint.anchor_b, rest});
            const Member& member = m.members.back();
            m.is_hinged = m.is_hinged && member.is_hinge;
            m.size = std::max(m.size, member.size);
            for (std::uint32_t i = 0; i < count; ++i) {
                const bool is_bound = laws[i].kind != Law::Kind::rigid;
                shape_.bound_of.push_back(is_bound ? static_cast<std::uint32_t>(shape_.bounds.size()) : no_bound);
                if (is_bound)
                    shape_.bounds.push_back({static_cast<std::uint32_t>(m.members.size() - 1), i, member.line + i,
                                             laws[i].kind == Law::Kind::spring, laws[i].straight});
                m.lines.push_back({.step = to_.memory[k].step[i]});
                laws_.push_back(laws[i]);
                m.is_simple = m.is_simple && laws[i].kind == Law::Kind::rigid;
                m.looks_at_speed = m.looks_at_speed || laws[i].straight;
            }
            widest = std::max(widest, count);
        }
        couple(m, widest);
        m.is_redundant = rigid_rows(m) > ways_to_move(m);
        for (const Mechanism::Part& p : m.parts) place_[p.row] = no_index;
    }
    static std::size_t rigid_rows(const Mechanism& m) {
        std::size_t rows = 0;
        for (const Member& k : m.members) rows += k.rigid;
        return rows;
    }
    /// Those of its bodies in one another, or on what holds them.
    static std::size_t ways_to_move(const Mechanism& m) {
        std::size_t ways = 0;
        bool is_held = false;
        for (const Mechanism::Part& p : m.parts) {
            ways += (p.inverse_mass > 0 ? 2U : 0U) + (p.inverse_inertia > 0 ? 1U : 0U);
            is_held = is_held || p.inverse_mass == 0;
        }
        constexpr std::size_t of_all = 3;
        return is_held || ways < of_all ? ways : ways - of_all;
    }
    void couple(Mechanism& m, std::size_t widest) {
        std::vector<std::vector<std::pair<std::uint32_t, bool>>> at(m.parts.size());
        for (std::uint32_t k = 0; k < m.members.size(); ++k)
            at[m.members[k].a].emplace_back(k, false), at[m.members[k].b].emplace_back(k, true);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
        shape_.first_holder.assign(1, 0);
        for (std::uint32_t p = 0; p < at.size(); ++p) {
            for (const auto& [joint, is_b] : at[p]) shape_.holders.push_back({joint, is_b});
            shape_.first_holder.push_back(static_cast<std::uint32_t>(shape_.holders.size()));
            if (m.parts[p].inverse_mass == 0) continue;
            for (std::size_t i = 0; i < at[p].size(); ++i)
                for (std::size_t j = i + 1; j < at[p].size(); ++j) {
                    shape_.couplings.push_back(
                        {at[p][i].first, at[p][j].first, p, at[p][i].second, at[p][j].second, 0});
                    pairs.emplace_back(at[p][i].first, at[p][j].first);
                }
        }
        const auto analyse = [&]<int N>(BlockMatrix<N>& matrix) {
            matrix.analyse(m.members.size(), pairs);
            for (Coupling& c : shape_.couplings) {
                const auto place = matrix.place_of(c.k, c.l);
                if (place.mirrored) std::swap(c.k, c.l), std::swap(c.k_is_b, c.l_is_b);
                c.index = place.index;
            }
            for (std::size_t i = 0; i < m.members.size(); ++i) m.members[i].place = matrix.place()[i];
            shape_.joints.assign(m.members.begin(), m.members.end());
            constexpr std::size_t much_work = 32;
            m.is_dear = matrix.work_per_row() > much_work;
            m.unknowns.resize(N * m.members.size());
        };
        if (widest == 1) analyse(m.matrix.emplace<0>());
        if (widest == 2) analyse(m.matrix.emplace<1>());
        if (widest == 3) analyse(m.matrix.emplace<2>());
        if (widest == 4) analyse(m.matrix.emplace<3>());
    }

    Mechanisms& to_;
    const Bodies& bodies_;
    std::vector<std::uint32_t> root_, place_;
    std::vector<std::vector<std::uint32_t>> joints_{};
    Mechanism::Shape shape_{};
    std::vector<Law> laws_{};
};

}  // namespace

void assemble(Mechanisms& mechanisms, const Bodies& bodies) {
    Assembly(mechanisms, bodies).run();
    mechanisms.holds.assign(bodies.size(), false);
    mechanisms.carries.assign(bodies.size() + 1, false);
    for (const Mechanism& m : mechanisms.all)
        for (const Mechanism::Part& p : m.parts)
            if (p.inverse_mass != 0) mechanisms.holds[p.row] = true;
    auto& pairs = mechanisms.apart;
    pairs.clear(), mechanisms.breakable.clear();
    for (std::uint32_t k = 0; k < mechanisms.joints.size(); ++k) {
        const Joint& joint = mechanisms.joints[k];
        if (joint.break_force || joint.break_torque) mechanisms.breakable.push_back(k);
        if (joint.collide) continue;
        const auto [a, b] = rows_of(joint, bodies);
        pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

namespace {

template <class Gone>
void drop(Mechanisms& mechanisms, Gone gone) {
    for (std::size_t k = mechanisms.joints.size(); k-- > 0;)
        if (gone(k)) erase(mechanisms, k);
}

}  // namespace

void erase(Mechanisms& mechanisms, std::size_t joint) {
    const auto from = [joint](auto& list) { list.erase(list.begin() + static_cast<std::ptrdiff_t>(joint)); };
    from(mechanisms.joints), from(mechanisms.ids), from(mechanisms.memory);
}

void forget_removed(Mechanisms& mechanisms, const Bodies& bodies) {
    drop(mechanisms, [&](std::size_t k) {
        const Joint& joint = mechanisms.joints[k];
        return !bodies.contains(joint.b) || (joint.a && !bodies.contains(*joint.a));
    });
}

void keep_remembered(Mechanisms& mechanisms) {
    const std::vector<JointMemory> memory = std::move(mechanisms.memory);
    mechanisms.memory.resize(mechanisms.joints.size());
    drop(mechanisms, [&](std::size_t k) {
        return std::none_of(memory.begin(), memory.end(),
                            [&](const JointMemory& m) { return m.id == mechanisms.ids[k]; });
    });
    if (mechanisms.joints.size() != memory.size()) Loader::fail();
    mechanisms.memory = memory;
}

void note_touched(const SoftScene& scene, const SoftContacts& contacts) {
    if (scene.mechanisms.empty()) return;
    Scratch<bool> touched(contacts.movers.size(), false);
    for (const SoftContact& c : contacts.all) touched[c.a] = touched[c.b] = true;
    scene.mechanisms.carries.assign(contacts.movers.size(), false);
    for (Mechanism& m : scene.mechanisms.all) {
        m.is_touched = m.is_asleep = false, m.prepared = 0;
        bool is_driven = false;
        for (const Mechanism::Part& p : m.parts) {
            if (p.inverse_mass == 0) {
                is_driven = is_driven || (p.row < scene.bodies.size() && scene.bodies.kind[p.row] != Kind::fixed);
                continue;
            }
            m.is_touched = m.is_touched || touched[p.row];
            m.is_asleep = contacts.asleep[p.row] != 0;
        }
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

    Books(int threads, const Mechanism& m, double h, const Motion& before, const std::vector<Mover>& movers,
          const State& state)
        : m_(m), h_(h), means_(threads, m, before, movers), state_(state) {}
    void book(const Member& k, Booked& to) const {
        for (std::uint32_t i = k.outside ? 0 : k.rigid; i < k.lines; ++i) book(k, i, m_.lines[k.line + i], to);
    }
    /// After all joints: what no account of theirs explains is the method's.
    void book_rest(int threads, Booked& to) const {
        struct Rest {
            double spins = 0, whole = 0;
            void operator+=(Rest more) { whole += more.whole, spins += more.spins; }
        };
        const auto add = [&](std::size_t first, std::size_t last, Rest& rest) {
            for (std::size_t i = first; i < last; ++i) {
                const Mechanism::Part& p = m_.parts[i];
                if (p.inverse_mass == 0) continue;
                rest.whole += along(p.given, means_.all[i]);
                // Who has nothing that could be turned keeps the spin of such a body.
                if (p.inverse_inertia == 0) rest.spins += p.given[2] * means_.all[i][2];
            }
        };
        Rest rest{-to.account[Account::driven]};
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
            const double damped = damping_of(line) * 0.5 * (first + last);
            take(Account::joint_damping, damped, -1, to);
            take(Account::spring, work - damped, 1, to);
            return;
        }
        const double most = h_ * line.law->most, driven = std::clamp(impulse, -most, most) / impulse;
        const bool drives = line.law->straight ? line.first.error != 0 : line.law->speed != 0;
        if (drives)
            take(Account::motor, driven * work, 1, to);
        else
            take(Account::joint_friction, driven * work, -1, to);
        take(Account::limit, (1 - driven) * work, -1, to);
    }

    /// The part of a spring's impulse that damps; of one at its largest force as much as fits.
    double damping_of(const JointLine& line) const {
        const double from = line.first.error, to = line.last.error, damps = -line.law->damping * (to - from);
        if (line.step == Step::free) return damps;
        const double whole = damps - 0.5 * h_ * line.law->stiffness * (from + to);
        return whole == 0 ? 0 : damps * (line.before + line.after) / whole;
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
    MeanVelocities means_;
    const State& state_;
};

/// With what force a row is to begin the next substep, in one half of it. The mean of both halves is what was asked of
/// it. But where the first half was as expected, the second took back the velocities that were let be in a few
/// substeps, and not what this one made alone: half of the way to the mean needs half as many solves.
double half_of(const Mechanism& m, const JointLine& line, double h, bool halves) {
    if (!halves) return line.before / h;
    if (!m.is_dear) return line.after / h;
    const double mean = 0.5 * (line.before + line.after);
    return (line.before == h * line.half ? 0.5 * (line.before + mean) : mean) / h;
}
/// Keeps the forces of a joint.
void keep(const Mechanism& m, const Member& k, double h, bool halves, JointMemory& memory) {
    for (std::uint32_t i = 0; i < k.lines; ++i) {
        const JointLine& line = m.lines[k.line + i];
        memory.step[i] = line.step;
        const double force = (line.before + line.after + line.blow) / h;
        memory.mean[i] = 0.5 * (memory.force[i] + force);
        memory.force[i] = force;
        memory.half[i] = half_of(m, line, h, halves);
    }
    memory.projections = m.is_projected && !m.is_given_up ? memory.projections + 1 : 0;
}

Reaction reaction_of(const Mechanism& m, const Member& k, const Joint& joint, const JointMemory& memory) {
    const Mechanism::Part& b = m.parts[k.b];
    Vec2 force{};
    double torque = 0, gap = 0;
    for (std::uint32_t i = 0; i < k.lines; ++i) {
        const JointLine& line = m.lines[k.line + i];
        force += memory.force[i] * Vec2{line.last.b[0], line.last.b[1]};
        torque += memory.force[i] * line.last.b[2];
        if (k.joins_points(i) || (line.law->kind == Law::Kind::rigid && !line.law->turns))
            gap += line.last.error * line.last.error;
    }
    JointRow rows[most_rows];
    const Ends ends(k.anchor_a, k.anchor_b, m.parts[k.a].now, b.now);
    const double coordinate = k.is_hinge ? ends.angle() - k.rest : rows_of(joint, ends, rows);
    return {force, torque - cross(ends.lever_b, force), coordinate, std::sqrt(gap)};
}

}  // namespace

void end_substep(const SoftScene& scene, Mechanisms& mechanisms, double h, const Motion& before,
                 const std::vector<Mover>& movers, const State& state, Mechanism& m, Flows& account) {
    const int threads = threads_within(scene);
    struct Done : Books::Booked {
        bool any_gapes = false;
        void operator+=(const Done& more) {
            Booked::operator+=(more);
            any_gapes = any_gapes || more.any_gapes;
        }
    };
    Done done{{account}};
    const Books books(threads, m, h, before, movers, state);
    forget_stiffness(threads, m);
    each_joint(
        threads, m, done,
        [&](const Member& k, Done& sum) {
            books.book(k, sum);
            keep(m, k, h, gives_halves(scene), mechanisms.memory[k.joint]);
            sum.any_gapes = sum.any_gapes || gapes(m, k, &JointLine::last);
            prepare_rows(mechanisms, h, true, k, m);
        },
        [&](const Member& k, auto sides) { stiffen(mechanisms, k, sides, m); });
    books.book_rest(threads, done);
    account = done.account;
    m.prepared = 0;
    if (m.looks_at_speed || done.any_gapes) return;
    prepare_parts(threads, h, m);
    m.prepared = h;
}

namespace {
void note_reactions(int threads, Mechanisms& all, const Mechanism& m) {
    for_each_rows(threads, m.members.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Member& k = m.members[i];
            JointMemory& memory = all.memory[k.joint];
            memory.reaction = reaction_of(m, k, all.joints[k.joint], memory);
        }
    });
}
}  // namespace

void note_reactions(const SoftScene& scene, Mechanisms& mechanisms) {
    const auto is_one = [](const Mechanism&) { return true; };
    each_awake(scene, mechanisms, is_one, [&](Mechanism& m) { note_reactions(threads_within(scene), mechanisms, m); });
}

void book_resting(const SoftScene& scene, Mechanisms& mechanisms, const State& state, double dt,
                  const SoftContacts& contacts, Flows& account) {
    const int threads = threads_within(scene);
    const auto sleeps = [&](const Mechanism::Part& p) { return moves(scene, p.row) && contacts.asleep[p.row] != 0; };
    for (Mechanism& m : mechanisms.all) {
        if (std::none_of(m.parts.begin(), m.parts.end(), sleeps)) continue;
        each_part(threads, m, [&](Mechanism::Part& p) { see(p, state, contacts.frames); });
        look(threads, m, mechanisms.joints, &JointLine::last);
        note_reactions(threads, mechanisms, m);
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
