// The direct solve of a mechanism: S λ = wanted − J v with S = J M⁻¹ Jᵀ, for all joints of it together.

#include "solvers/factor.hpp"

namespace carom {

namespace {

using Part = Mechanism::Part;

/// What bodies that whirl about may be off for once.
constexpr double acceptable = 1e-6;
/// Bodies that were slowed down for a force that is no more get so much energy.
constexpr double made = 2;
/// The slack where joints contradict one another.
constexpr double much = 1e-4;

/// What a row is to be at, and within which bounds.
struct Wanted {
    double speed, softness;  ///< J v + softness · impulse = speed
    double low, high;        ///< speeds at which it meets its limits
    double least, most;      ///< impulses at the largest force of its motor or spring
};

/// One of the two solves of a substep. It goes on from the impulses so far, whatever else has changed the velocities.
template <int N>
class Hold {
  public:
    Hold(Mechanism& m, BlockMatrix<N>& matrix, const Mechanisms& all, double h, double share, bool drifts)
        : m_(m),
          matrix_(matrix),
          joints_(all.joints),
          memory_(all.memory),
          h_(h),
          share_(share),
          drifts_(drifts),
          which_(drifts ? &Line::first : &Line::last),
          impulse_(drifts ? &Line::before : &Line::after) {}

    void run(bool exact) {
        keep(), set_wanted();
        const bool slow = drifts_ && m_.is_slow;
        const double before = slow || !m_.is_simple ? energy() : 0;
        for (const bool trusts : {true, false}) {
            if (trusts && !exact) continue;
            if (trusts && !m_.is_touched) foresee();
            if (iterate(exact, trusts) && (!slow || energy() <= made * before) &&
                (!exact || given_to_springs(m_) <= made * before))
                return;
            go_back();
        }
        if (contradict() || !exact || project()) return;
        start_again();
        solve_once(much);
    }

  private:
    void keep() {
        kept_.resize(6 * m_.parts.size() + m_.lines.size());
        kept_steps_.resize(m_.lines.size());
        double* to = kept_.data();
        for (const Part& p : m_.parts)
            for (int i = 0; i < 3; ++i) *to++ = p.v[i], *to++ = p.given[i];
        for (const Line& line : m_.lines) *to++ = line.*impulse_;
        for (std::size_t i = 0; i < m_.lines.size(); ++i) kept_steps_[i] = m_.lines[i].step;
    }
    /// Velocities as the impulses of now make them: rows that contradicted one another may have pushed a million times
    /// as hard on the way to these, which leaves its rounding behind.
    void sum_up() {
        const double* from = kept_.data();
        for (Part& p : m_.parts)
            for (int i = 0; i < 3; ++i) p.v[i] = *from++, p.known[i] = p.given[i] = *from++;
        for (const Member& k : m_.members)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                const Line& line = m_.lines[k.line + r];
                push(m_, k, r, line.*which_, line.*impulse_ - *from++);
            }
        feel(m_);
    }
    void go_back() {
        const double* from = kept_.data();
        for (Part& p : m_.parts)
            for (int i = 0; i < 3; ++i) p.v[i] = *from++, p.known[i] = p.given[i] = *from++;
        for (Line& line : m_.lines) line.*impulse_ = *from++;
        for (std::size_t i = 0; i < m_.lines.size(); ++i) m_.lines[i].step = kept_steps_[i];
    }

    /// Rows that are kept begin with the impulses that the substep before lets expect.
    void foresee() {
        for (const Member& k : m_.members)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                Line& line = m_.lines[k.line + r];
                if (is_in(line.step) && line.law.kind != Law::Kind::stop)
                    give(k, r, line, h_ * memory_[k.joint].half[r]);
            }
        give_bounded();
    }

    /// Newton's method, in which the matrix stays that of the start. Says whether it found a solution: with the steps
    /// as they are, if those are trusted.
    bool iterate(bool exact, bool trusts) {
        constexpr int most = 20;
        constexpr double enough = 1e-3;  // of what was missing
        double worst = HUGE_VAL, first = 0;
        // Which rows are at their bounds is found as if rows stayed as they are, before the bodies are sent anywhere.
        bool settled = trusts || m_.is_simple;
        for (int i = 0; i < most; ++i) {
            ahead_ = exact && settled;  // rows as they are at the end
            if (ahead_)
                look_ahead<false>();
            else
                feel(m_);
            const bool moved = !trusts && i > 0 && i < most / 2 && take_steps();
            if (give_bounded()) feel(m_);
            if (moved) sum_up();
            const double before = worst;
            worst = miss();
            if (i == 0) first = worst;
            if (!(worst < HUGE_VAL)) return false;
            if (i > 0 && !moved && !settled) {
                settled = true;
                if (exact) worst = HUGE_VAL;
                if (exact) continue;
            }
            // What is left of a speed adds up to a gap.
            const bool found = i > 0 || trusts ? worst <= tiny : m_.is_dear && m_.is_simple && worst <= 0.1 * tiny;
            if (found && !moved) return !trusts || !take_steps();
            if (i > 1 && !moved && worst > 0.8 * before) break;
            if (!fits()) refactor();
            solve();
            // What is missing falls by about as much again, and what a limit is passed by then is no gap yet.
            const bool is_known = trusts || m_.is_simple;
            if (i > 0 && is_known && worst <= 50 * tiny && worst <= 0.05 * before) return feel(m_), !take_steps();
        }
        feel(m_);
        if (trusts) return false;
        return worst <= (exact ? 1e2 * tiny : std::max(1e2 * tiny, enough * first));
    }

    /// Newton's method for the nearest velocities with which the joints hold at the end of the drift, the least
    /// ½ |v − v'|²_M: impulses act along the rows of the end, and that these turn with the bodies is in the matrix
    /// (`stiffen`). It begins with the velocities that the joints allow where they are.
    bool project() {
        constexpr int most = 40;
        begin_projection();
        for (int i = 0; i < most; ++i) {
            ahead_ = i > 0;
            if (ahead_) look_ahead<true>(), turn_rows();
            // Rows go to other steps only from where all are kept.
            double worst = miss();
            const bool moved = (i == 0 || worst <= 50 * tiny) && take_steps();
            if (give_bounded() || moved) worst = miss();
            if (!(worst < HUGE_VAL)) return false;
            if ((ahead_ && !moved && worst <= 50 * tiny) || (i == most - 1 && worst <= acceptable)) {
                for (Part& p : m_.parts) std::copy(p.known, p.known + 3, p.given);
                return true;
            }
            if (ahead_) stiffen();
            turn_impulses();
            refactor(slack);
            solve();
            go();
        }
        return false;
    }
    /// From the velocities that were proposed, of no impulse, and without slowing anything down.
    void begin_projection() {
        for (Part& p : m_.parts) {
            for (std::size_t i = 0; i < 3; ++i) {
                p.v[i] = (p.v[i] - p.ease[i] * p.known[i]) / p.slow[i / 2];
                p.given[i] = p.known[i] = 0;
            }
            p.slow[0] = p.slow[1] = 1;
        }
        m_.is_projected = true;
        for (Line& line : m_.lines) line.before = 0;
        set_ease(m_);
        keep(), set_wanted();
    }
    /// M + h² K is what a body resists with, where the force on it turns with it.
    void stiffen() {
        find_stiffness(m_, joints_,
                       [this](const Member& k, std::uint32_t row) { return m_.lines[k.line + row].before / h_; });
        for (Part& p : m_.parts)
            for (std::size_t i = 0; i < 3; ++i) {
                const double inverse = i < 2 ? p.inverse_mass : p.inverse_inertia;
                p.ease[i] = inverse / (1 + h_ * h_ * std::max(0.0, p.stiffness[i / 2]) * inverse);
            }
    }
    /// The impulses so far give momentum along the rows as they are now. What the velocities lack of it they will get.
    void turn_impulses() {
        for (Part& p : m_.parts) p.given[0] = p.given[1] = p.given[2] = 0;
        for (const Member& k : m_.members)
            for (std::uint32_t r = 0; r < k.lines; ++r)
                push(m_, k, r, m_.lines[k.line + r].first, m_.lines[k.line + r].before);
        const auto gain = [](const double* j, const Part& p) {
            double sum = 0;
            for (int i = 0; i < 3; ++i) sum += j[i] * p.ease[i] * (p.given[i] - p.known[i]);
            return sum;
        };
        for (std::uint32_t i = 0; i < m_.members.size(); ++i) {
            const Member& k = m_.members[i];
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                const Line& line = m_.lines[k.line + r];
                if (!is_in(line.step)) continue;
                m_.unknowns[N * i + r] -= gain(line.first.a, m_.parts[k.a]) + gain(line.first.b, m_.parts[k.b]);
            }
        }
    }
    /// A step of the projection, no longer than rows can be foreseen.
    void go() {
        constexpr double far = 1;  // [rad]
        double most = 0;
        for (const Part& p : m_.parts) most = std::max(most, h_ * std::abs(p.ease[2] * (p.given[2] - p.known[2])));
        const double part = ahead_ && most > far ? far / most : 1;
        for (Part& p : m_.parts)
            for (int i = 0; i < 3; ++i) {
                const double gain = part * p.ease[i] * (p.given[i] - p.known[i]);
                const double inverse = i < 2 ? p.inverse_mass : p.inverse_inertia;
                p.v[i] += gain;
                if (inverse > 0) p.known[i] += gain / inverse;
            }
        for (std::uint32_t i = 0; i < m_.members.size() && part < 1; ++i)
            for (std::uint32_t r = 0; r < m_.members[i].lines; ++r) {
                Line& line = m_.lines[m_.members[i].line + r];
                if (is_in(line.step)) line.before -= (1 - part) * m_.unknowns[N * i + r];
            }
    }

    /// Joints that contradict one another are kept as nearly as they can be, in the sense of least squares. One solve
    /// tells them from others: it does not do what it was to do.
    bool contradict() {
        const double before = solve_once(slack), left = miss();
        if (left <= std::max(0.5 * before, 1e2 * tiny)) {
            if (drifts_) go_back();
            return !drifts_;
        }
        go_back();
        solve_once(much);
        if (miss() <= 2 * left) return true;
        go_back();
        solve_once(slack);
        return true;
    }
    /// Twice the kinetic energy, of the velocities before they were slowed down.
    double energy() const {
        double sum = 0;
        for (const Part& p : m_.parts)
            for (std::size_t i = 0; i < 3; ++i) {
                const double inverse = i < 2 ? p.inverse_mass : p.inverse_inertia, v = p.v[i] / p.slow[i / 2];
                if (inverse > 0) sum += v * v / inverse;
            }
        return sum;
    }
    void start_again() {
        go_back();
        set_ease(m_);
        for (Part& p : m_.parts) p.now = p.start;
        look(m_, joints_, &Line::last);
        turn_rows();
    }
    double solve_once(double more) {
        ahead_ = false;
        take_steps();
        if (give_bounded()) feel(m_);
        const double missing = miss();
        refactor(more);
        solve();
        feel(m_);
        return missing;
    }
    void solve() {
        matrix_.solve(m_.unknowns);
        const double* impulse = m_.unknowns.data();
        for (const Member& k : m_.members) {
            Line* const lines = &m_.lines[k.line];
            for (std::uint32_t r = 0; r < k.lines; ++r)
                if (is_in(lines[r].step)) give(k, r, lines[r], impulse[r]);
            impulse += N;
        }
    }

    void give(const Member& k, std::uint32_t row, Line& line, double impulse) {
        line.*impulse_ += impulse;
        push(m_, k, row, line.*which_, impulse);
    }
    /// Of a row that is not rigid.
    Wanted wanted(const Line& line, double size) const {
        const Law& law = line.law;
        Wanted w{0, 0, -HUGE_VAL, HUGE_VAL, 0, 0};
        const double error = line.first.error, at = line.last.error;
        if (law.kind == Law::Kind::spring) {
            const double part = m_.is_projected ? 1 : 0.5;
            const double stiffness = part * h_ * law.stiffness + law.damping;
            w.softness = 1 / (part * h_ * stiffness), w.speed = -law.stiffness * error / stiffness;
            w.most = part * h_ * law.most, w.least = -w.most;
        } else {
            if (drifts_) {
                w.low = std::min(0.0, (law.lower - error) / h_), w.high = std::max(0.0, (law.upper - error) / h_);
            } else {
                if (at <= law.lower + 1e3 * tiny * size) w.low = 0;
                if (at >= law.upper - 1e3 * tiny * size) w.high = 0;
            }
            w.speed = std::clamp(law.straight ? error : law.speed, w.low, w.high);
            const double so_far = drifts_ ? 0 : line.before, most = (drifts_ ? share_ : 1) * h_ * law.most;
            w.most = most - so_far, w.least = -most - so_far;
        }
        return w;
    }
    /// They stay the same in a solve, but where it becomes a projection.
    void set_wanted() {
        if (m_.is_simple) return;
        wanted_.resize(m_.lines.size());
        for (const Member& k : m_.members)
            for (std::uint32_t i = k.line; i < k.line + k.lines; ++i)
                if (m_.lines[i].law.kind != Law::Kind::rigid) wanted_[i] = wanted(m_.lines[i], size_of(k, m_.lines[i]));
    }
    const Wanted& wanted(const Line& line) const { return wanted_[static_cast<std::size_t>(&line - m_.lines.data())]; }

    /// The speed of a row: on the whole way if the end is known.
    double speed_of(const Member& k, std::uint32_t row, const Line& line) const {
        if (ahead_ && drifts_ && !line.law.straight) return (line.last.error - line.first.error) / h_;
        return speed(m_, k, row, line.*which_);
    }

    /// Goes to the next step of their staircase with all rows that are out of the bounds of theirs.
    bool take_steps() {
        if (m_.is_simple) return false;
        bool moved = false;
        for (const Member& k : m_.members)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                Line& line = m_.lines[k.line + r];
                if (line.law.kind == Law::Kind::rigid) continue;
                const Step next = step_of(k, r, line);
                moved |= next != line.step;
                line.step = next;
            }
        return moved;
    }
    Step step_of(const Member& k, std::uint32_t row, const Line& line) const {
        const Wanted& w = wanted(line);
        const double impulse = line.*impulse_, u = speed_of(k, row, line), hair = tiny * size_of(k, line) / h_;
        if (line.law.kind == Law::Kind::spring) {
            if (!drifts_ || !(w.softness < HUGE_VAL)) return Step::free;
            const double pull = is_in(line.step) ? impulse : (w.speed - u) / w.softness;
            return pull > w.most ? Step::pushing : pull < w.least ? Step::pulling : Step::held;
        }
        const bool motor = line.law.most > 0;
        if (line.law.most == HUGE_VAL) return Step::held;
        switch (line.step) {
            case Step::lower:
                return impulse >= w.most && w.low > -HUGE_VAL ? Step::lower : motor ? Step::pushing : Step::free;
            case Step::upper:
                return impulse <= w.least && w.high < HUGE_VAL ? Step::upper : motor ? Step::pulling : Step::free;
            case Step::held:
                if (!motor) return Step::free;
                return impulse > w.most ? Step::pushing : impulse < w.least ? Step::pulling : Step::held;
            case Step::pushing:
                return u < w.low - hair ? Step::lower : u > w.speed + hair ? Step::held : Step::pushing;
            case Step::pulling:
                return u > w.high + hair ? Step::upper : u < w.speed - hair ? Step::held : Step::pulling;
            default:
                return u < w.low - hair ? Step::lower : u > w.high + hair ? Step::upper : Step::free;
        }
    }
    /// Rows at their bounds get what those say.
    bool give_bounded() {
        if (m_.is_simple) return false;
        bool gave = false;
        for (const Member& k : m_.members)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                Line& line = m_.lines[k.line + r];
                if (is_in(line.step) || (line.law.kind == Law::Kind::spring && !drifts_)) continue;
                const Wanted& w = wanted(line);
                const double impulse = line.step == Step::pushing ? w.most : line.step == Step::pulling ? w.least : 0;
                if (impulse == line.*impulse_) continue;
                give(k, r, line, impulse - line.*impulse_);
                gave = true;
            }
        return gave;
    }

    /// Writes what is missing of every row's speed; returns the largest, as a part of its size in a substep.
    double miss() {
        double worst = 0;
        double* missing = m_.unknowns.data();
        for (const Member& k : m_.members) {
            const Line* const lines = &m_.lines[k.line];
            for (std::uint32_t r = 0; r < N; ++r) {
                missing[r] = r < k.lines && is_in(lines[r].step) ? missing_of(k, r, lines[r]) : 0;
                const double part = std::abs(missing[r]) * (r < k.lines && lines[r].law.turns ? 1 : k.per_size);
                worst = part > worst || part != part ? part : worst;
            }
            missing += N;
        }
        return worst * h_;
    }
    double missing_of(const Member& k, std::uint32_t row, const Line& line) const {
        if (line.law.kind == Law::Kind::rigid) {  // the most common, by a short way
            if (ahead_ && drifts_) return (line.aim - line.last.error) * per_h_;
            return (drifts_ ? (line.aim - line.first.error) * per_h_ : 0) - speed(m_, k, row, line.*which_);
        }
        const Wanted& w = wanted(line);
        const double aim = line.step == Step::lower ? w.low : line.step == Step::upper ? w.high : w.speed;
        return aim - speed_of(k, row, line) - (w.softness > 0 ? w.softness * line.*impulse_ : 0);
    }

    /// Where the joints are at the end of the drift with the velocities of now.
    template <bool whole>
    void look_ahead() {
        for (Part& p : m_.parts) {
            if (!whole) feel(p);
            p.now = p.start;
            p.now.position += h_ * Vec2{p.v[0], p.v[1]};
            turn_on(p.now, h_ * p.v[2]);
        }
        look<whole>(m_, joints_, &Line::last);
    }
    /// From here on impulses act along the rows as they are now; the gaps of the start remain.
    void turn_rows() {
        for (Line& line : m_.lines) {
            const double error = line.first.error;
            if (!line.law.straight) line.first = line.last, line.first.error = error;
        }
    }

    /// Whether the factor is that of the rows as they are now.
    bool fits() {
        if (!knows_rows_) {
            rounds_ = m_.is_dear && is_still(m_, h_);
            has_rows_ = has_factor_of_rows(m_, which_, h_, rounds_), knows_rows_ = true;
        }
        return has_rows_ && (m_.is_simple || has_factor_of_steps(m_));
    }
    /// What serves the rounds of iterations.
    void refactor() {
        factor_to_keep(m_, matrix_, which_, h_, rounds_, [this](const Line& line) { return softness_of(line); });
        knows_rows_ = has_rows_ = true;
    }
    void refactor(double more) {
        m_.factored.h = 0;
        factor(m_, matrix_, rows_at(which_), more, [this](const Line& line) { return softness_of(line); });
    }
    double softness_of(const Line& line) const {
        return line.law.kind == Law::Kind::spring ? wanted(line).softness : 0;
    }

    Mechanism& m_;
    BlockMatrix<N>& matrix_;
    const std::vector<Joint>& joints_;
    const std::vector<JointMemory>& memory_;
    double h_, per_h_ = 1 / h_, share_;
    bool drifts_;
    JointRow Line::*which_;
    double Line::*impulse_;
    Scratch<double> kept_{};
    Scratch<Step> kept_steps_{};
    Scratch<Wanted> wanted_{};  ///< of each line that is not rigid
    bool ahead_ = false;
    bool knows_rows_ = false, has_rows_ = false;  ///< that the factor is of the rows as they are
    bool rounds_ = false;                         ///< rows are rounded for it
};

}  // namespace

void hold_drift(const SoftScene& scene, Mechanisms& mechanisms, double h, bool exact, SoftContacts& contacts) {
    const auto acts = [exact](const Mechanism& m) { return exact || m.is_touched; };
    each_awake(scene, mechanisms, acts, [&](Mechanism& m) {
        take_velocities(m, contacts.movers);
        const auto run = [&]<int N>(BlockMatrix<N>& matrix) {
            Hold<N>(m, matrix, mechanisms, h, scene.drift_share, true).run(exact);
        };
        std::visit(run, m.matrix);
        give_velocities(m, contacts.movers);
    });
}

void hold_relax(const SoftScene& scene, Mechanisms& mechanisms, double h, bool last, State& state,
                SoftContacts& contacts) {
    const auto acts = [last](const Mechanism& m) { return last || m.is_touched; };
    each_awake(scene, mechanisms, state.account, acts, [&](Mechanism& m, Flows& account) {
        if (m.is_touched)
            take_velocities(m, contacts.movers);
        else
            begin_relax(scene, mechanisms, h, state, contacts, m);
        const auto run = [&]<int N>(BlockMatrix<N>& matrix) {
            Hold<N>(m, matrix, mechanisms, h, scene.drift_share, false).run(false);
        };
        std::visit(run, m.matrix);
        give_velocities(m, contacts.movers);
        if (!last) return;
        curb(scene, h, {contacts.start, contacts.proposed, state}, contacts.movers, m);
        end_substep(scene, mechanisms, h, contacts.start.v, contacts.movers, state, m, account);
    });
}

}  // namespace carom
