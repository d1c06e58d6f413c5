// The solve of a mechanism alone, and what is done where there is no solution.

#include <optional>
#include <utility>

#include "math/secants.hpp"
#include "solvers/own_matrix.hpp"

namespace carom {
namespace {

using Part = Mechanism::Part;

/// What bodies that whirl about may be off for once.
constexpr double acceptable = 1e-6;
/// Of its size: whoever comes back from there has forgotten how he moved before.
constexpr double lost = 1e6;
/// The slack where joints contradict one another, and where that is too much for some of them.
constexpr double much = 1e-4, less = 1e-9;

/// One of the two solves of a substep. It goes on from the impulses so far, whatever else has changed the velocities.
template <int N>
class Hold {
  public:
    Hold(Mechanism& m, BlockMatrix<N>& matrix, const Asked& asked)
        : m_(m),
          asked_(&asked),
          h_(asked.h),
          shape_(shape_of(m, matrix)),
          task_(task_of(m, asked, true)),
          on_(shape_, 0, false),
          matrix_(m, matrix, asked, on_),
          desk_(shape_, task_, on_.memory(), matrix_) {}

    /// `is_tried`: there is no solution that begins with the steps as they are.
    void run(bool is_tried) {
        lay(m_, *asked_, task_, on_);
        desk_.begin();
        find(is_tried);
        take_up(shape_, on_, *asked_, 1, 1, own());
    }
    /// A solve of a half between contacts, for the velocities of now: what is laid out for the first one serves all.
    void run_between_contacts(const Asked& asked) {
        asked_ = &asked;
        task_ = task_of(m_, asked, asked.round == Round::first);
        if (task_.begins)
            lay(m_, asked, task_, on_), desk_.begin();
        else
            each_part([](const Part& part, DeskPart<double>& p) { std::copy(part.v, part.v + 3, p.v); }), desk_.keep();
        find(false);
        if (asked.round == Round::last) return take_up(shape_, on_, asked, 1, 1, own());
        each_part([](Part& part, const DeskPart<double>& p) { std::copy(p.v, p.v + 3, part.v); });
    }

  private:
    auto own() {
        return [this](int) -> Mechanism& { return m_; };
    }
    void find(bool is_tried) {
        bool was_projected = false;
        const auto project_once = [&] {
            return !std::exchange(was_projected, true) && project() && is_sound(*asked_, on_, 0, m_);
        };
        if (asked_->tries_nothing(m_)) {
            if (project_once()) return;
            start_again();
        }
        const bool spans = asked_->is_exact() && m_.is_redundant && !matrix_.is_rounded(desk_);
        if (spans) {
            if (span() || project_once()) return;
            start_again();
        }
        const auto slides = [this](const BoundShape& b) {
            return b.is_paired && !b.is_spring && on_.lines[b.line].step == number_of(Step::pushing);
        };
        // Which way what slides is pushed is first to be found.
        const bool finds_way =
            m_.shape->has_pairs && std::any_of(m_.shape->bounds.begin(), m_.shape->bounds.end(), slides);
        for (const bool trusts : {true, false}) {
            if (spans || (trusts && (!asked_->is_exact() || is_tried || finds_way))) continue;
            if ((trusts || !task_.is_last) && task_.foresees) desk_.foresee(true);
            const bool found = trusts || !task_.is_last ? desk_.attempt(true) : desk_.iterate(true, false);
            if (found && is_sound(*asked_, on_, 0, m_)) return;
            desk_.go_back(true);
        }
        if (asked_->is_exact() && !spans) {
            if (find_by_secants()) return;
            desk_.go_back(true);
        }
        const bool is_least = contradict();
        if (is_least && is_sound(*asked_, on_, 0, m_)) return;
        if (is_least) desk_.go_back(true);
        if (!asked_->is_exact() || project_once()) return;
        m_.is_given_up = true;
        start_again();
        compromise(much);
    }

    /// The drift of what has more rows than ways to move. S of its start and rows of its end are redundant in other
    /// ways, by as much as rows turn in between, and what of a gap is no sum of columns of S would be divided by slack.
    /// So what is missing is found as a displacement along the rows of the end, where gaps are sums of what they can
    /// do to second order, and of that what the rows of the start can give. What is left falls by the square of the
    /// turn.
    bool span() {
        m_.is_least = span_from_here();
        if (!m_.is_least && m_.is_slow) {
            desk_.go_back(true);
            begin_anew();
            matrix_.refactor(desk_, true);
            m_.is_least = span_from_here();
        }
        if (!m_.is_least) desk_.go_back(true);
        return m_.is_least;
    }
    bool span_from_here() {
        constexpr int most = 40;
        constexpr double slowest = 0.9;  // a round leaves of what was missing
        settle_and_look_ahead();
        const BlockMatrix<N>* end = nullptr;
        double before = HUGE_VAL;
        for (int i = 0; i < most; ++i) {
            const Look now = look_there();
            if (!now.moved && now.worst <= tiny) return is_sound(*asked_, on_, 0, m_);
            if (!now.moved && !(now.worst < slowest * before)) return false;
            before = now.moved ? HUGE_VAL : now.worst;
            if (!matrix_.fits(desk_)) matrix_.refactor(desk_, true), end = nullptr;
            if (end == nullptr) end = &matrix_.factor_of_end();
            give_along_start(*end);
        }
        return false;
    }
    void settle_and_look_ahead() {
        desk_.ahead = false;
        if (!m_.is_simple) desk_.settle(true);
        desk_.ahead = true;
    }
    struct Look {
        double worst;  ///< that a row misses where the drift ends, of its size
        bool moved;    ///< rows went to their next steps, where all were kept
        bool changed;  ///< that, or they were given what their bounds say
    };
    Look look_there() {
        desk_.template look_ahead<false>(true);
        double worst = desk_.miss();
        const bool moved = worst <= 50 * tiny && desk_.take_steps(true);
        const bool gave = desk_.give_bounded(true);
        if (gave) desk_.template look_ahead<false>(true);
        if (gave || moved) worst = desk_.miss();
        return {worst, moved, gave || moved};
    }
    /// A round of that, for what is missing of every row.
    void give_along_start(const BlockMatrix<N>& end) {
        const int threads = asked_->threads;
        std::copy(on_.unknowns, on_.unknowns + N * shape_.joints, m_.unknowns.begin());
        end.solve_in_order(m_.unknowns.data());
        carom::each_part(threads, m_, [](Part& p) { p.given[0] = p.given[1] = p.given[2] = 0; });
        const auto push_at_end = [this](const Member& k, auto sides) {
            push_all(m_, k, &JointLine::last, sides, [&](std::uint32_t r) { return m_.unknowns[N * k.place + r]; });
        };
        each_joint(
            threads, m_, [](const Member&) {}, push_at_end);
        carom::each_part(threads, m_, [](Part& p) {
            for (std::size_t i = 0; i < 3; ++i) p.v[i] = p.ease[i] * p.given[i];
        });
        const auto note_missing = [this](const Member& k) {
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                const bool is_rigid = r < k.rigid;
                if (!is_rigid && !is_in(on_.lines[k.line + r].step)) continue;
                const double softness = is_rigid ? 0 : on_.bounds[m_.shape->bound_of[k.line + r]].softness;
                const std::size_t place = N * k.place + r;
                on_.unknowns[place] = speed(m_, k, r, m_.lines[k.line + r].first) + softness * m_.unknowns[place];
            }
        };
        each_joint(threads, m_, note_missing, [](const Member&, auto) {});
        desk_.solve(true);
    }

    /// The drift of what turns far in a substep: impulses act along the rows of the start and are to close gaps along
    /// those of the end, of which the matrix knows the less the farther these have turned. What rounds show of it is
    /// enough.
    bool find_by_secants() {
        constexpr int most = 30;
        Secants secants;
        Scratch<double> missing(N * shape_.joints);
        settle_and_look_ahead();
        for (int i = 0; i < most; ++i) {
            const Look now = look_there();
            if (now.changed) secants.forget();
            if (!now.moved && now.worst <= tiny) return is_sound(*asked_, on_, 0, m_);
            if (!(now.worst < lost)) return false;
            if (!matrix_.fits(desk_)) matrix_.refactor(desk_, true), secants.forget();
            std::copy(on_.unknowns, on_.unknowns + missing.size(), missing.begin());
            matrix_.solve(on_.unknowns);
            secants.improve(missing.data(), on_.unknowns, missing.size());
            desk_.give_unknowns(true);
        }
        return false;
    }

    /// Newton's method for the nearest velocities with which the joints hold at the end of the drift, the least
    /// ½ |v − v'|²_M: impulses act along the rows of the end, and that these turn with the bodies is in the matrix
    /// (`stiffen`). A chain or tree begins with the impulses of two projections just before; what is redundant has any
    /// of many, and begins with the velocities that the joints allow where they are, as does who was not projected.
    bool project() {
        constexpr int most = 40, soon = 5;
        m_.is_projected = task_.is_projected = true;
        begin_anew();
        const bool goes_on = !m_.is_dear && !m_.is_redundant && asked_->projections(m_) > 1;
        if (goes_on) go_on();
        double last = HUGE_VAL;
        for (int i = 0; i < most; ++i) {
            desk_.ahead = goes_on || i > 0;
            if (desk_.ahead) desk_.template look_ahead<true>(true), note_rows();
            // Rows go to other steps from where all are kept, or where motors that are held let rounds lead nowhere.
            double worst = miss();
            const bool asks = i == 0 || worst <= 50 * tiny || (i > soon && worst > 0.9 * last);
            const bool moved = asks && desk_.take_steps(true);
            last = moved ? HUGE_VAL : worst;
            if (desk_.give_bounded(true) || moved) worst = miss();
            if (!(worst < lost)) return false;
            const bool kept = desk_.ahead && asks && !moved && worst <= 50 * tiny;
            if (kept || (i == most - 1 && worst <= acceptable && !desk_.overdrives())) {
                m_.is_given_up = !kept;
                m_.is_least = m_.is_redundant;
                each_part([](const Part&, DeskPart<double>& p) { std::copy(p.known, p.known + 3, p.given); });
                return true;
            }
            if (desk_.ahead) stiffen();
            turn_impulses();
            matrix_.refactor(slack_of(m_));
            desk_.solve(true);
            go();
        }
        return false;
    }
    /// What is missing of every row, and the largest part of a size. Rigid rows yield by their slack: a chain that is
    /// as long as its way is held by no finite force, and by one that is known to rounding if it gives way by rounding,
    /// and no more.
    double miss() {
        desk_.miss();
        double worst = 0;
        for (const JointShape& k : m_.shape->joints)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                const DeskLine<double>& line = on_.lines[k.line + r];
                double& missing = on_.unknowns[N * k.place + r];
                const double way = slack_of(m_) * (yield(line.a, k.a) + yield(line.b, k.b)) * line.impulse;
                const double most = tiny / (h_ * line.per_size);
                if (r < k.rigid) missing -= std::clamp(way, -most, most);
                desk_.note_worst(missing, line, worst);
            }
        return worst * h_;
    }
    double yield(const double* j, std::uint32_t part) const { return yield_of(on_.parts[part].ease, j); }
    template <class Act>
    void each_part(Act act) {
        for (std::size_t p = 0; p < m_.parts.size(); ++p) act(m_.parts[p], on_.parts[p]);
    }
    /// From the velocities that were proposed, of no impulse, and without slowing anything down.
    void begin_anew() {
        for (std::size_t i = 0; i < m_.lines.size(); ++i) {
            const JointRow& row = m_.lines[i].first;
            std::copy(row.a, row.a + 3, on_.lines[i].a), std::copy(row.b, row.b + 3, on_.lines[i].b);
        }
        each_part([](Part& part, DeskPart<double>& p) {
            for (std::size_t i = 0; i < 3; ++i) {
                p.v[i] = (p.v[i] - p.ease[i] * p.known[i]) / part.slow[i / 2];
                p.given[i] = 0;
            }
            part.slow[0] = part.slow[1] = 1;
        });
        m_.is_slow = false;
        for (std::size_t i = 0; i < m_.lines.size(); ++i) on_.lines[i].impulse = 0;
        desk_.keep();
        take_ease();
        lay_bounds(m_, *asked_, task_, on_);
    }
    /// Begins with what the substep before, which was projected, lets expect.
    void go_on() {
        for (const JointShape& k : m_.shape->joints)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                DeskLine<double>& line = on_.lines[k.line + r];
                if (r < k.rigid || is_in(line.step)) line.impulse = asked_->expected(m_.lines[k.line + r]);
            }
        stand();
        stiffen();
        turn_impulses();
        desk_.ahead = false;
        go();
    }
    /// Sees the bodies where the substep began.
    void stand() {
        each_part([](const Part&, DeskPart<double>& p) { p.now = p.start; });
    }
    void take_ease() {
        set_ease(m_);
        each_part([](const Part& part, DeskPart<double>& p) { std::copy(part.ease, part.ease + 3, p.ease); });
    }
    /// From here on impulses act along the rows as they are now; the gaps of the start remain.
    void note_rows() {
        for (std::size_t i = 0; i < m_.lines.size(); ++i) {
            JointRow& row = m_.lines[i].first;
            const DeskLine<double>& line = on_.lines[i];
            std::copy(line.a, line.a + 3, row.a), std::copy(line.b, line.b + 3, row.b);
        }
    }
    /// M + h² K is what a body resists with, where the force on it turns with it.
    void stiffen() {
        for (std::uint32_t p = 0; p < m_.parts.size(); ++p) m_.parts[p].now = matrix_.end_of(p);
        forget_stiffness(1, m_);
        for (const Member& k : m_.members)
            add_stiffness(m_, asked_->all.joints, k, BothSides(),
                          [&](std::uint32_t row) { return on_.lines[k.line + row].impulse / h_; });
        each_part([this](Part& part, DeskPart<double>& p) {
            for (std::size_t i = 0; i < 3; ++i) {
                const double inverse = i < 2 ? part.inverse_mass : part.inverse_inertia;
                part.ease[i] = p.ease[i] = inverse / (1 + h_ * h_ * std::max(0.0, part.stiffness[i / 2]) * inverse);
            }
        });
    }
    /// The impulses so far give momentum along the rows as they are now. What the velocities lack of it they will get.
    void turn_impulses() {
        each_part([](const Part&, DeskPart<double>& p) { p.given[0] = p.given[1] = p.given[2] = 0; });
        for (const JointShape& k : m_.shape->joints)
            for (std::uint32_t r = 0; r < k.lines; ++r) desk_.push(k, r, on_.lines[k.line + r].impulse);
        const auto gain = [](const double* j, const DeskPart<double>& p) {
            double sum = 0;
            for (int i = 0; i < 3; ++i) sum += j[i] * p.ease[i] * (p.given[i] - p.known[i]);
            return sum;
        };
        for (const JointShape& k : m_.shape->joints)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                const DeskLine<double>& line = on_.lines[k.line + r];
                if (r >= k.rigid && !is_in(line.step)) continue;
                on_.unknowns[N * k.place + r] -= gain(line.a, on_.parts[k.a]) + gain(line.b, on_.parts[k.b]);
            }
    }
    /// A step of the projection, no longer than rows can be foreseen.
    void go() {
        constexpr double far = 1;  // [rad]
        double most = 0;
        each_part([&](const Part&, const DeskPart<double>& p) {
            most = std::max(most, h_ * std::abs(p.ease[2] * (p.given[2] - p.known[2])));
        });
        const double part = desk_.ahead && most > far ? far / most : 1;
        each_part([part](const Part& of, DeskPart<double>& p) {
            for (int i = 0; i < 3; ++i) {
                const double gain = part * p.ease[i] * (p.given[i] - p.known[i]);
                const double inverse = i < 2 ? of.inverse_mass : of.inverse_inertia;
                p.v[i] += gain;
                if (inverse > 0) p.known[i] += gain / inverse;
            }
        });
        if (part == 1) return;
        for (const JointShape& k : m_.shape->joints)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                DeskLine<double>& line = on_.lines[k.line + r];
                if (r < k.rigid || is_in(line.step)) line.impulse -= (1 - part) * on_.unknowns[N * k.place + r];
            }
    }

    /// Joints that contradict one another are kept as nearly as they can be, in the sense of least squares. One solve
    /// tells them from others: it does not do what it was to do, which after the drift is all of it.
    bool contradict() {
        const double before = solve_once(slack), left = desk_.miss(), enough = asked_->drifts ? 0.5 : 1e-6;
        if (left <= std::max(enough * before, 1e2 * tiny)) {
            if (asked_->drifts) desk_.go_back(true);
            return !asked_->drifts;
        }
        desk_.go_back(true);
        compromise(much);
        if (desk_.miss() <= 2 * left) return true;
        desk_.go_back(true);
        compromise(less);
        return true;
    }
    void start_again() {
        desk_.go_back(true);
        take_ease();
        stand();
        desk_.template look<true>(true);
        note_rows();
        desk_.ahead = false;
    }
    /// With a slack alone rows that contradict one another would pull with 1 / slack of what they miss, and move bodies
    /// wherever they are not quite in line. So what was of no help is taken back.
    void compromise(double slack) {
        solve_once(slack);
        desk_.miss();
        for (std::size_t k = 0; k < N * shape_.joints; ++k) on_.unknowns[k] = -on_.unknowns[k];
        desk_.solve(true);
        desk_.feel(true);
    }
    double solve_once(double more) {
        desk_.ahead = false;
        desk_.take_steps(true);
        if (desk_.give_bounded(true)) desk_.feel(true);
        const double missing = desk_.miss();
        matrix_.refactor(more);
        desk_.solve(true);
        desk_.feel(true);
        return missing;
    }

    Mechanism& m_;
    const Asked* asked_;
    double h_;
    DeskShape shape_;
    DeskTask task_;
    DeskLayout<double, N> on_;
    OwnMatrix<N> matrix_;
    Desk<double, N, OwnMatrix<N>> desk_;
};

/// The solves of a half of one that touches something. After the last one it is taken up, and still to give its
/// velocities.
template <int N>
class BetweenContacts {
  public:
    BetweenContacts(Mechanism& m, BlockMatrix<N>& matrix, const Asked& asked) : m_(m) {
        if (!m.is_dear) desk_.emplace(m, matrix, asked);  // what is dear may need none
    }

    void run(const Asked& asked, BodyMotion& motion) {
        note_touched_velocities(m_, -1, motion);
        take_velocities(asked.threads, m_, motion.movers);
        desk_ ? desk_->run_between_contacts(asked) : hold_alone(m_, asked, false);
        if (asked.round == Round::last) return;
        give_velocities(asked.threads, m_, motion.movers);
        note_touched_velocities(m_, 1, motion);
    }

  private:
    Mechanism& m_;
    std::optional<Hold<N>> desk_;
};

}  // namespace

void hold_alone(Mechanism& m, const Asked& asked, bool is_tried) {
    if (m.is_dear && m.is_simple && hold_as_foreseen(m, asked)) return;
    std::visit([&]<int N>(BlockMatrix<N>& matrix) { Hold<N>(m, matrix, asked).run(is_tried); }, m.matrix);
}

Desks::Solve hold_between_contacts(Mechanism& m, const Asked& asked) {
    const auto lay_out = [&]<int N>(BlockMatrix<N>& matrix) -> Desks::Solve {
        using One = BetweenContacts<N>;
        const auto run = [](void* one, const Asked& to, BodyMotion& motion) {
            static_cast<One*>(one)->run(to, motion);
        };
        return {run, std::allocate_shared<One>(ScratchAllocator<One>(), m, matrix, asked)};
    };
    return std::visit(lay_out, m.matrix);
}

}  // namespace carom
