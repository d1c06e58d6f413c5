// Which joints hang together, and in what order they are solved.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "math/pages.hpp"
#include "solvers/mechanism.hpp"

namespace carom {

namespace {

constexpr std::uint32_t no_index = no_mechanism;

/// Rows of a joint's bodies; the ground is the row after the last.
struct Pair {
    std::uint32_t a, b;
};
Pair rows_of(const Joint& joint, const Bodies& bodies) {
    const auto row = [&](BodyId id) { return static_cast<std::uint32_t>(bodies.row(id)); };
    return {joint.a ? row(*joint.a) : static_cast<std::uint32_t>(bodies.size()), row(joint.b)};
}

bool breaks(const Joint& joint) { return joint.break_force || joint.break_torque; }
/// A length to compare gaps with, whatever the unit: from a centre to an anchor, of a rod or rope, or where all that is
/// 0 a radius of gyration; 0 of two points.
double size_of(const Joint& joint, Pair rows, const Bodies& bodies) {
    double size = std::max(length(joint.anchor_b), joint.a ? length(joint.anchor_a) : 0);
    if (const auto* rod = std::get_if<DistanceJoint>(&joint.type))
        size = std::max({size, rod->length.value_or(0), rod->limits.upper.value_or(0)});
    if (const auto* rope = std::get_if<PulleyJoint>(&joint.type)) size = std::max(size, rope->length.value_or(0));
    if (size > 0) return size;
    for (const std::uint32_t row : {rows.a, rows.b})
        if (row < bodies.size() && bodies.mass[row] > 0)
            size = std::max(size, std::sqrt(bodies.inertia[row] / bodies.mass[row]));
    return size;
}

/// A row of a hinge without levers: along x, along y, and of the angle.
JointRow row_of_hinge(std::uint32_t row) {
    JointRow out{};
    const std::uint32_t way = std::min(row, 2U);
    out.a[way] = -1, out.b[way] = 1;
    return out;
}

void take_order(const Mechanism& from, Mechanism& m) {
    for (std::size_t i = 0; i < m.members.size(); ++i) m.members[i].place = from.members[i].place;
    m.matrix = from.matrix, m.is_ordered = from.is_ordered, m.is_dear = from.is_dear;
    m.unknowns.resize(from.unknowns.size());
}

/// Puts joints into mechanisms, one by one. Whom no edit concerns stays as it was.
class Assembly {
  public:
    Assembly(Mechanisms& mechanisms, const Bodies& bodies, const Motion& places)
        : to_(mechanisms), bodies_(bodies), places_(places), root_(bodies.size()), place_(bodies.size() + 1, no_index) {
        std::iota(root_.begin(), root_.end(), 0U);
    }
    void run() {
        before_ = std::exchange(to_.all, {});
        for (const Joint& joint : to_.joints) unite(rows_of(joint, bodies_));
        std::vector<std::uint32_t> mechanism_of(bodies_.size(), no_index);
        for (std::uint32_t k = 0; k < to_.joints.size(); ++k) {
            Law laws[most_rows];
            if (to_.home[k] == no_index && laws_of(to_.joints[k], laws) == 0) continue;
            const auto [a, b] = rows_of(to_.joints[k], bodies_);
            std::uint32_t& index = mechanism_of[find(moves(b) ? b : a)];
            if (index == no_index) index = static_cast<std::uint32_t>(to_.all.size()), to_.all.emplace_back();
            joints_.resize(to_.all.size());
            joints_[index].push_back(k);
        }
        for (std::uint32_t i = 0; i < to_.all.size(); ++i) {
            if (!keep(to_.all[i], joints_[i])) fill(to_.all[i], joints_[i]);
            share(i);
            for (const std::uint32_t k : joints_[i]) to_.home[k] = i;
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
        m.parts.push_back(part_of(row));
        return place;
    }
    Mechanism::Part part_of(std::uint32_t row) const {
        if (row >= bodies_.size()) return {row, 0, 0};
        return {row, bodies_.inverse_mass[row], bodies_.inverse_inertia[row]};
    }
    /// Takes over one of the last assembly that has these very joints, if they and its bodies are as they were. Whether
    /// a chain between two that are held is taut depends on where these are.
    bool keep(Mechanism& m, const std::vector<std::uint32_t>& joints) {
        const std::uint32_t home = to_.home[joints.front()];
        if (home == no_index) return false;
        Mechanism& old = before_[home];
        const bool takes_order = !old.is_ordered && &m != to_.all.data() && (&m)[-1].is_ordered;
        if (takes_order || old.members.size() != joints.size()) return false;
        const auto ground = static_cast<std::uint32_t>(bodies_.size()),
                   ground_before = static_cast<std::uint32_t>(to_.holds.size());
        const auto now = [&](std::uint32_t part) {
            const std::uint32_t row = old.parts[part].row;
            return row == ground_before ? ground : row;
        };
        std::size_t held = 0;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const Member& member = old.members[i];
            const auto [a, b] = rows_of(to_.joints[joints[i]], bodies_);
            if (to_.home[joints[i]] != home || now(member.a) != a || now(member.b) != b) return false;
            held += member.outside;
        }
        if (held > 1) return false;
        for (std::uint32_t p = 0; p < old.parts.size(); ++p) {
            const Mechanism::Part is = part_of(now(p)), &was = old.parts[p];
            if (was.inverse_mass != is.inverse_mass || was.inverse_inertia != is.inverse_inertia) return false;
        }
        for (std::uint32_t p = 0; p < old.parts.size(); ++p) old.parts[p].row = now(p);
        m = std::move(old);
        for (std::size_t i = 0; i < joints.size(); ++i) m.members[i].joint = joints[i];
        m.is_asleep = m.is_touched = m.is_carried = false, m.may_have_moved = true;
        return true;
    }
    /// What the mechanisms of a crowd have in common is kept once: they are many more than fit into a cache.
    void share(std::uint32_t i) {
        Mechanism& m = to_.all[i];
        const auto with_one_before = [&](auto Mechanism::*common) {
            if (i == 0) return false;
            const auto& other = to_.all[i - 1].*common;
            if (m.*common != other && *(m.*common) != *other) return false;
            m.*common = other;
            return true;
        };
        m.kind = with_one_before(&Mechanism::shape) ? to_.all[i - 1].kind : i;
        if (with_one_before(&Mechanism::laws) || m.lines.front().law != m.laws->data())
            for (std::size_t k = 0; k < m.lines.size(); ++k) m.lines[k].law = &(*m.laws)[k];
    }
    void fill(Mechanism& m, const std::vector<std::uint32_t>& joints) {
        shape_ = {}, laws_.clear();
        std::size_t widest = 1;
        constexpr std::size_t rows_of_most = 2;
        const std::size_t lines = rows_of_most * joints.size();
        reserve_large(m.members, joints.size()), reserve_large(m.lines, lines), reserve_large(laws_, lines);
        reserve_large(shape_.line_of, lines), reserve_large(shape_.bound_of, lines);
        m.parts.reserve(joints.size() + 1);  // of a tree; each loop is a part less
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
            m.members.push_back({shape, k, grounded, breaks(joint), size_of(joint, rows, bodies_), 0, joint.anchor_a,
                                 joint.anchor_b, rest});
            const Member& member = m.members.back();
            m.is_hinged = m.is_hinged && member.is_hinge;
            m.size = std::max(m.size, member.size);
            shape_.spring_of.push_back(no_bound);
            for (std::uint32_t i = 0; i < count; ++i) {
                shape_.line_of.push_back(member.line + i);
                const bool is_bound = laws[i].kind != Law::Kind::rigid;
                shape_.bound_of.push_back(is_bound ? static_cast<std::uint32_t>(shape_.bounds.size()) : no_bound);
                if (is_bound)
                    shape_.bounds.push_back({static_cast<std::uint32_t>(m.members.size() - 1), i, member.line + i,
                                             laws[i].kind == Law::Kind::spring, laws[i].paired});
                shape_.has_pairs = shape_.has_pairs || laws[i].paired;
                const JointRow row = member.is_hinge ? row_of_hinge(i) : JointRow{};
                m.lines.push_back({.first = row, .last = row, .step = to_.memory[k].step[i]});
                laws_.push_back(laws[i]);
                m.is_simple = m.is_simple && laws[i].kind == Law::Kind::rigid;
            }
            widest = std::max(widest, count);
        }
        shape_.widest = static_cast<std::uint32_t>(widest);
        size_points(m);
        couple(m);
        loosen(bodies_, places_, to_.joints, shape_, m);
        if (m.is_hinged) leave_out_springs();
        m.is_redundant = rigid_rows(m) > ways_to_move(m);
        m.has_loops = !m.is_redundant && has_loops(m);
        for (const Mechanism::Part& p : m.parts) place_[p.row] = no_index;
        m.shape = std::make_shared<Mechanism::Shape>(std::move(shape_));
        m.laws = std::make_shared<std::vector<Law>>(std::move(laws_));
    }
    /// Of joints between points, which have no size of their own.
    static void size_points(Mechanism& m) {
        for (Member& member : m.members) {
            if (member.size == 0) member.size = m.size > 0 ? m.size : 1;
            member.per_size = 1 / member.size;
        }
    }
    /// Rows as they are after the drift.
    void leave_out_springs() {
        Mechanism::Rows& rows = shape_.after_drift;
        for (std::uint32_t i = 0; i < shape_.joints.size(); ++i) {
            JointShape k = shape_.joints[i];
            const std::uint32_t first = std::exchange(k.line, static_cast<std::uint32_t>(rows.line_of.size()));
            const std::uint32_t last = first + std::exchange(k.lines, 0U);
            for (std::uint32_t line = first; line < last; ++line) {
                const std::uint32_t bound = shape_.bound_of[line];
                if (bound != no_bound && shape_.bounds[bound].is_spring) {
                    shape_.spring_of[i] = line;
                    continue;
                }
                const bool is_bound = bound != no_bound;
                rows.bound_of.push_back(is_bound ? static_cast<std::uint32_t>(rows.bounds.size()) : no_bound);
                const auto own = static_cast<std::uint32_t>(rows.line_of.size());
                if (is_bound) rows.bounds.push_back({i, k.lines, own, false, shape_.bounds[bound].is_paired});
                rows.line_of.push_back(line), ++k.lines;
            }
            rows.joints.push_back(k), rows.widest = std::max(rows.widest, k.lines);
        }
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
    /// Whether rigid rows lead from a body back to it so that they may say the same wherever it is: those of a tree are
    /// of ways of their own, and those of one loop of hinges but in dead points, as of a bridge that is taut.
    static bool has_loops(const Mechanism& m) {
        std::vector<std::uint32_t> root(m.parts.size());
        std::uint32_t held = no_index;  // those that do not move are one
        for (std::uint32_t p = 0; p < root.size(); ++p)
            root[p] = m.parts[p].inverse_mass == 0 ? held = std::min(held, p) : p;
        const auto find = [&](std::uint32_t p) {
            while (root[p] != p) p = root[p] = root[root[p]];
            return p;
        };
        const auto loops = std::count_if(m.members.begin(), m.members.end(), [&](const Member& k) {
            if (k.rigid == 0) return false;
            const std::uint32_t a = find(k.a), b = find(k.b);
            return std::exchange(root[a], b) == b;
        });
        return loops > (m.is_hinged ? 1 : 0);
    }
    /// Whether the same parts hang together by the same rows, so that their order of elimination is the same: to find
    /// it takes longer than a step.
    static bool have_one_order(const Mechanism& a, const Mechanism& b) {
        const auto both_move = [](const Mechanism::Part& p, const Mechanism::Part& q) {
            return (p.inverse_mass == 0) == (q.inverse_mass == 0);
        };
        const auto are_like = [](const JointShape& j, JointShape k) {
            k.place = j.place;
            return j == k;
        };
        return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), both_move) &&
               std::equal(a.members.begin(), a.members.end(), b.members.begin(), b.members.end(), are_like);
    }
    /// The one before it, or one of the last assembly that comes after those which were found there so far.
    const Mechanism* one_like(const Mechanism& m) {
        if (&m != to_.all.data() && have_one_order((&m)[-1], m)) return &m - 1;
        const auto found = std::find_if(before_.begin() + static_cast<std::ptrdiff_t>(seen_), before_.end(),
                                        [&m](const Mechanism& other) { return have_one_order(other, m); });
        if (found == before_.end()) return nullptr;
        seen_ = static_cast<std::size_t>(found - before_.begin()) + 1;
        return &*found;
    }
    /// Of each part the joints that hold it, in their order.
    void list_holders(const Mechanism& m) {
        auto& first = shape_.first_holder;
        first.assign(m.parts.size() + 1, 0);
        for (const Member& k : m.members) ++first[k.a], ++first[k.b];
        std::exclusive_scan(first.begin(), first.end(), first.begin(), 0U);
        std::vector<std::uint32_t> next = first;
        shape_.holders.resize(2 * m.members.size());
        for (std::uint32_t k = 0; k < m.members.size(); ++k)
            for (const bool is_b : {false, true})
                shape_.holders[next[is_b ? m.members[k].b : m.members[k].a]++] = {k, is_b};
    }
    void couple(Mechanism& m) {
        if (const Mechanism* like = one_like(m)) {
            take_order(*like, m);
            shape_.joints = like->shape->joints, shape_.couplings = like->shape->couplings;
            shape_.holders = like->shape->holders, shape_.first_holder = like->shape->first_holder;
            return;
        }
        list_holders(m);
        const auto& end = shape_.first_holder;
        std::size_t pairs = 0;
        for (std::uint32_t p = 0; p < m.parts.size(); ++p)
            if (const std::size_t holders = end[p + 1] - end[p]; m.parts[p].inverse_mass != 0 && holders > 0)
                pairs += holders * (holders - 1) / 2;
        reserve_large(shape_.couplings, pairs);
        for (std::uint32_t p = 0; p < m.parts.size(); ++p) {
            if (m.parts[p].inverse_mass == 0) continue;
            const auto first = shape_.holders.begin() + end[p], last = shape_.holders.begin() + end[p + 1];
            for (auto i = first; i != last; ++i)
                for (auto j = i + 1; j != last; ++j)
                    shape_.couplings.push_back({i->joint, j->joint, p, i->is_b, j->is_b, 0});
        }
        shape_.joints.assign(m.members.begin(), m.members.end());
    }

    Mechanisms& to_;
    const Bodies& bodies_;
    const Motion& places_;
    std::vector<std::uint32_t> root_, place_;
    std::vector<Mechanism> before_{};  ///< those of the last assembly
    std::size_t seen_ = 0;             ///< so many of these were passed
    std::vector<std::vector<std::uint32_t>> joints_{};
    Mechanism::Shape shape_{};
    std::vector<Law> laws_{};
};

/// Finds the order in which its joints are solved.
template <int N>
void order(Mechanism& m, BlockMatrix<N>& matrix) {
    constexpr std::size_t much_work = 32;
    Mechanism::Shape shape = *m.shape;
    Scratch<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const Coupling& c : shape.couplings) pairs.emplace_back(c.k, c.l);
    matrix.analyse(m.members.size(), pairs);
    for (Coupling& c : shape.couplings) {
        const auto place = matrix.place_of(c.k, c.l);
        if (place.mirrored) std::swap(c.k, c.l), std::swap(c.k_is_b, c.l_is_b);
        c.index = place.index;
    }
    std::stable_sort(shape.couplings.begin(), shape.couplings.end(),
                     [](const Coupling& a, const Coupling& b) { return a.index < b.index; });
    for (std::size_t i = 0; i < m.members.size(); ++i) m.members[i].place = matrix.place()[i];
    for (auto* joints : {&shape.joints, &shape.after_drift.joints})
        for (std::size_t i = 0; i < joints->size(); ++i) (*joints)[i].place = matrix.place()[i];
    m.shape = std::make_shared<Mechanism::Shape>(std::move(shape));
    m.is_ordered = true, m.is_dear = matrix.work_per_row() > much_work;
    m.unknowns.resize(N * m.members.size());
}
void order(Mechanism& m) {
    const std::uint32_t widest = m.shape->widest;
    if (widest == 1) order(m, m.matrix.emplace<0>());
    if (widest == 2) order(m, m.matrix.emplace<1>());
    if (widest == 3) order(m, m.matrix.emplace<2>());
    if (widest == 4) order(m, m.matrix.emplace<3>());
}

}  // namespace

void order_awake(Mechanisms& mechanisms) {
    for (Mechanism& m : mechanisms.all) {
        if (m.is_ordered || m.is_asleep) continue;
        Mechanism& first = mechanisms.all[m.kind];
        if (!first.is_ordered) order(first);
        if (&m == &first) continue;
        m.shape = first.shape;
        take_order(first, m);
    }
}

void assemble(Mechanisms& mechanisms, const Bodies& bodies, const Motion& places) {
    Assembly(mechanisms, bodies, places).run();
    mechanisms.holds.assign(bodies.size(), false);
    mechanisms.carries.assign(bodies.size() + 1, false);
    for (const Mechanism& m : mechanisms.all)
        for (const Mechanism::Part& p : m.parts)
            if (p.inverse_mass != 0) mechanisms.holds[p.row] = true;
    mechanisms.breakable.clear();
    for (std::uint32_t k = 0; k < mechanisms.joints.size(); ++k)
        if (breaks(mechanisms.joints[k])) mechanisms.breakable.push_back(k);
    mechanisms.apart = KeptApart(mechanisms.joints, bodies);
}

}  // namespace carom
