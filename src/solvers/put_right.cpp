// What comes before and between the two solves of a mechanism's substep.

#include <cstring>

#include "forces/gains.hpp"
#include "solvers/lay.hpp"

namespace carom {

namespace {

using Part = Mechanism::Part;

/// To eleven bits, so that the matrix of what lies as good as still is always the same.
double coarse(double x) {
    const double split = ((1LL << 42) + 1) * x;
    return split - (split - x);
}

/// The zig-zag of a rope under the tension T has the angular frequency ω = √(12 T / (m ℓ)), and impulses along where
/// its rods are when the substep begins are stable up to ω h = 2. Those that are faster drift as if they were heavier,
/// with I + h² K / 4 for a stiffness K: then the zig-zag goes as under the implicit midpoint rule, which keeps its
/// energy at any step (docs/theory/joints.md).
void slow_down(double h, const Mechanism& m, Part& p) {
    constexpr double limit = 1;
    const double inverse[2] = {p.inverse_mass, p.inverse_inertia};
    for (std::size_t i = 0; i < 2; ++i) {
        const double square = h * h * p.stiffness[i] * inverse[i];  // (ω h)²
        p.slow[i] = square > limit ? 1 / (1 + 0.25 * square) : 1;
        if (m.is_dear) p.slow[i] = coarse(p.slow[i]);
    }
}

/// Whether the rows of a substep's start are those on which the last one ended.
bool is_where_it_was(const Mechanism& m) {
    return std::all_of(m.lines.begin(), m.lines.end(), [](const JointLine& l) {
        return std::equal(l.first.a, l.first.a + 3, l.last.a) && std::equal(l.first.b, l.first.b + 3, l.last.b);
    });
}

/// Whether its bodies are no longer where it last saw them, to the last bit.
bool has_moved(const Mechanism& m, const State& state, const std::vector<Frame>& frames) {
    return std::any_of(m.parts.begin(), m.parts.end(), [&](const Part& p) {
        const End now = end_of(p.row, state, frames);
        return std::memcmp(&now, &p.now, sizeof now) != 0;
    });
}

/// Moves bodies to where their joints hold. What cannot hold at once is out by as little as can be.
class Repair {
  public:
    Repair(const SoftScene& scene, double h, Mechanism& m, State& state, std::vector<Frame>& frames, Flows& account)
        : scene_(scene),
          h_(h),
          m_(m),
          joints_(scene.mechanisms.joints),
          state_(state),
          frames_(frames),
          account_(account) {}

    void run() {
        constexpr int most = 4;
        const auto any_gapes = [this] {
            return std::any_of(m_.members.begin(), m_.members.end(),
                               [this](const Member& k) { return gapes(m_, k, &JointLine::first); });
        };
        for (int i = 0; i < most && any_gapes(); ++i) {
            if (i == 0) begin();
            if (!std::visit([this](auto& matrix) { return correct(matrix); }, m_.matrix)) break;
        }
        if (!moved_) return;
        for (std::size_t i = 0; i < m_.lines.size(); ++i) m_.lines[i].step = steps_[i];
        finish();
    }

  private:
    void begin() {
        moved_ = true;
        for (const JointLine& line : m_.lines) steps_.push_back(line.step);
        m_.factored.h = 0;
        for (Part& p : m_.parts) p.ease[0] = p.ease[1] = p.inverse_mass, p.ease[2] = p.inverse_inertia;
        if (m_.may_become_redundant()) note_redundancy(h_, m_);  // not as it was where the last substep began
        before_ = in_springs();
        if (m_.taut.empty()) return;
        bend(scene_.flight.dynamics.gravity(), m_);
        look(1, m_, joints_, &JointLine::first);
    }
    double in_springs() const {
        double sum = 0;
        for (const Member& k : m_.members)
            if (has_spring(joints_[k.joint]))
                sum += spring_energy(joints_[k.joint], {k.anchor_a, k.anchor_b, m_.parts[k.a].now, m_.parts[k.b].now});
        return sum;
    }
    /// Goes to where gaps are smaller, if that can be found.
    template <int N>
    bool correct(BlockMatrix<N>& matrix) {
        constexpr double slack_for_gaps = 1e-9;
        for (JointLine& line : m_.lines) {
            const bool kept = line.law->kind == Law::Kind::rigid || out_of(*line.law, line.first.error) != 0;
            line.step = kept ? Step::held : Step::free;
        }
        factor(m_, matrix, rows_at(&JointLine::first), slack_for_gaps, [](const JointLine&) { return 0.0; });
        std::fill(m_.unknowns.begin(), m_.unknowns.end(), 0.0);
        for (std::uint32_t i = 0; i < m_.members.size(); ++i)
            for (std::uint32_t r = 0; r < m_.members[i].lines; ++r) {
                const JointLine& line = m_.lines[m_.members[i].line + r];
                m_.unknowns[N * i + r] = -out_of(*line.law, line.first.error);
            }
        matrix.solve(m_.unknowns);
        std::vector<std::array<double, 3>> way(m_.parts.size());
        for (std::uint32_t i = 0; i < m_.members.size(); ++i)
            for (std::uint32_t r = 0; r < m_.members[i].lines; ++r) {
                const Member& k = m_.members[i];
                const JointRow& j = m_.lines[k.line + r].first;
                for (std::size_t d = 0; d < 3; ++d) {
                    way[k.a][d] += m_.unknowns[N * i + r] * j.a[d];
                    way[k.b][d] += m_.unknowns[N * i + r] * j.b[d];
                }
            }
        Scratch<End> from;
        for (const Part& p : m_.parts) from.push_back(p.now);
        const double before = squared_gaps();
        constexpr double least = 1.0 / 32;
        for (double part = 1; part >= least; part /= 2) {
            for (std::size_t p = 0; p < m_.parts.size(); ++p) move(from[p], part, way[p], m_.parts[p]);
            look(1, m_, joints_, &JointLine::first);
            if (squared_gaps() < before) return true;
        }
        for (std::size_t p = 0; p < m_.parts.size(); ++p) m_.parts[p].now = from[p];
        look(1, m_, joints_, &JointLine::first);
        return false;
    }
    static void move(const End& from, double part, const std::array<double, 3>& way, Part& p) {
        constexpr double most = 0.5;  // rad: further the rows say nothing
        p.now = from;
        p.now.position += part * p.inverse_mass * Vec2{way[0], way[1]};
        turn_on(p.now, std::clamp(part * p.inverse_inertia * way[2], -most, most));
    }
    /// Of all joints together, as parts of their sizes.
    double squared_gaps() const {
        double sum = 0;
        for (const Member& k : m_.members)
            for (std::uint32_t i = k.line; i < k.line + k.lines; ++i) {
                const JointLine& line = m_.lines[i];
                const double gap = out_of(*line.law, line.first.error) / size_of(k, line);
                sum += gap * gap;
            }
        return sum;
    }
    /// What gravity lost and joints' springs store is work of whoever puts right; the bodies take their momentum along.
    void finish() {
        account_[Account::correction] += in_springs() - before_;
        Gains gains(scene_.flight.dynamics);
        for (const Part& p : m_.parts) {
            if (p.inverse_mass == 0) continue;
            Vec2& x = state_.x.linear[p.row];
            const Vec2 way = p.now.position - x;
            gains.add(p.row, x, state_.v.linear[p.row], state_.v.angular[p.row], way, {}, 0);
            account_[Account::correction] -= scene_.bodies.mass[p.row] * dot(scene_.flight.dynamics.gravity(), way);
            x = p.now.position;
            state_.x.angular[p.row] = p.now.angle;
            frames_[p.row] = frame_at(x, p.now.angle);
        }
        account_[Giver::method].add(gains.momentum().force, gains.momentum().torque);
    }

    const SoftScene& scene_;
    double h_;
    Mechanism& m_;
    const std::vector<Joint>& joints_;
    State& state_;
    std::vector<Frame>& frames_;
    Flows& account_;
    std::vector<Step> steps_{};
    double before_ = 0;  ///< in the joints' springs [J]
    bool moved_ = false;
};

}  // namespace

void prepare_rows(const Mechanisms& all, double h, bool ended, const Member& k, Mechanism& m) {
    const JointMemory& memory = all.memory[k.joint];
    for (std::uint32_t r = 0; r < k.lines; ++r) {
        JointLine& line = m.lines[k.line + r];
        if (ended) take_row(k, line.last, line.first);
        line.before = line.after = line.blow = 0, line.half = memory.half[r];
        // What is rounding of a gap is closed. A larger one was put right, or can not be.
        const double error = line.first.error;
        line.aim = std::abs(error) <= 100 * tiny * size_of(k, r, line) ? 0 : error;
        if (!k.joins_points(r) && line.law->kind == Law::Kind::spring)
            line.step = 0.5 * h * line.law->stiffness + line.law->damping > 0 ? Step::held : Step::free;
    }
}

void prepare_parts(int threads, double h, Mechanism& m) {
    each_part(threads, m, [&](Part& p) {
        slow_down(h, m, p);
        p.start = p.now;
        for (int i = 0; i < 3; ++i) p.given[i] = p.known[i] = 0;
        set_ease(p);
    });
    m.is_projected = m.is_given_up = m.is_least = false;
    m.is_slow = is_any(threads, m.parts.size(), [&](std::size_t i) { return is_slow(m.parts[i]); });
    if (m.is_slow && !m.factored.is_rounded) m.factored.h = 0;
    if (m.may_become_redundant()) note_redundancy(h, m);
}

void put_right(const SoftScene& scene, Mechanisms& mechanisms, double h, State& state, BodyMotion& motion) {
    const auto is_unready = [&](const Mechanism& m) {
        return m.prepared != h || (m.may_have_moved && has_moved(m, state, motion.frames));
    };
    const int threads = threads_within(scene);
    each_awake(scene, mechanisms, state.account, is_unready, [&](Mechanism& m, Flows& account) {
        each_part(threads, m, [&](Part& p) { see(p, state, motion.frames); });
        look(threads, m, mechanisms.joints, &JointLine::first);
        if (!m.factored.is_rounded && !is_where_it_was(m)) m.factored.h = 0;
        Repair(scene, h, m, state, motion.frames, account).run();
        forget_stiffness(threads, m);
        each_joint(
            threads, m, [&](const Member& k) { prepare_rows(mechanisms, h, false, k, m); },
            [&](const Member& k, auto sides) { stiffen(mechanisms, k, sides, m); });
        prepare_parts(threads, h, m);
    });
}

void drift_slowly(const Part& p, const State& start, double h, State& state, BodyMotion& motion) {
    const Mover& mover = motion.movers[p.row];
    state.x.linear[p.row] = start.x.linear[p.row] + p.slow[0] * h * Vec2{mover.vx, mover.vy};
    state.x.angular[p.row] = start.x.angular[p.row] + p.slow[1] * h * mover.w;
    motion.frames[p.row] = frame_at(state.x.linear[p.row], state.x.angular[p.row]);
}

void drift_slowly(Mechanisms& mechanisms, const State& start, double h, State& state, BodyMotion& motion) {
    for (const Mechanism& m : mechanisms.all) {
        if (m.is_asleep || m.is_carried || !m.is_slow) continue;
        for (const Part& p : m.parts)
            if (is_slow(p)) drift_slowly(p, start, h, state, motion);
    }
}

/// Whether what its parts were given makes so much of their velocities that no digit of these is left: near a dead end
/// forces are without bound, and turn with the rows.
bool is_lost(const Mechanism& m) {
    double before = 0, after = 0;
    for (const Part& p : m.parts)
        for (std::size_t i = 0; i < 2; ++i)
            before = std::max(before, std::abs(p.v[i])), after = std::max(after, std::abs(felt(p, i)));
    return after > digits_of_speed * before;
}

void see_drifted(int threads, const State& state, const BodyMotion& motion, Mechanism& m) {
    each_part(threads, m, [&](Part& p) {
        see(p, state, motion.frames);
        p.slow[0] = p.slow[1] = 1;
        set_ease(p), take_velocity(p, motion.movers);
    });
    if (!m.factored.is_rounded) m.factored.h = 0;
}

void begin_relax(const Asked& asked, Mechanism& m) {
    const int threads = asked.threads;
    const bool halves = asked.gives_halves();
    const auto begin = [&, half = asked.half_expected(m), halves](const Member& k) {
        look(m, k, asked.all.joints, &JointLine::last);
        JointLine* const lines = &m.lines[k.line];
        std::uint32_t r = 0;
        if (k.is_hinge) {
            lines[0].after = half * lines[0].half, lines[1].after = half * lines[1].half;
            r = 2;
        }
        for (; r < k.lines; ++r) {
            JointLine& line = lines[r];
            const bool springs = line.law->kind == Law::Kind::spring;
            if (springs) line.step = Step::free;
            const bool expected = halves && (m.is_touched || line.law->kind == Law::Kind::rigid);
            line.after = springs ? (m.is_projected ? 0 : line.before) : expected ? half * line.half : 0;
        }
    };
    const auto push = [&](const Member& k, auto sides) {
        push_all(m, k, &JointLine::last, sides, [&](std::uint32_t r) { return m.lines[k.line + r].after; });
    };
    each_joint(threads, m, begin, push);
    if (is_lost(m)) {
        for (JointLine& line : m.lines)
            if (line.law->kind != Law::Kind::spring) line.after = 0;
        each_part(threads, m, [](Part& p) { std::copy(p.known, p.known + 3, p.given); });
        each_joint(
            threads, m, [](const Member&) {}, push);
    }
    feel(threads, m);
}

}  // namespace carom
