#pragma once
// The text of a mechanism's solve, S λ = wanted − J v with S = J M⁻¹ Jᵀ for all joints of it together: for one, or in
// lanes for several that are alike. What a lane computes does not depend on what else there is.
//
// Without std and in an unnamed namespace, for wide kernels include it (src/simd/lanes.hpp).

#include "solvers/desk_look.hpp"
#include "solvers/desk_steps.hpp"

namespace carom {
namespace {

/// A mechanism on the desk, or those in the lanes; what is done to those `where` is called where there is one. The
/// Keeper has the matrix, and knows joints that are no hinges: fits(), refactor(where), solve(unknowns),
/// look<whole>(joint); and may look ahead in another way: looks_ahead(shape, task, worst).
template <class V, int N, class Keeper>
class Desk {
  public:
    using O = Ops<V>;
    using Mask = typename O::Mask;

    Desk(const DeskShape& shape, const DeskTask& task, const DeskMemory& memory, Keeper& keeper)
        : parts(static_cast<DeskPart<V>*>(memory.parts)),
          lines(static_cast<DeskLine<V>*>(memory.lines)),
          unknowns(static_cast<V*>(memory.unknowns)),
          shape_(shape),
          task_(task),
          anchors_(static_cast<DeskAnchors<V>*>(memory.anchors)),
          bounds_(static_cast<DeskBound<V>*>(memory.bounds)),
          keeper_(keeper),
          h_(task.h),
          per_h_(1 / task.h),
          is_simple_(shape.is_simple) {}

    DeskPart<V>* parts;
    DeskLine<V>* lines;
    V* unknowns;
    bool ahead = false;  ///< rows are looked at where the drift ends

    /// What the layout leaves to be filled in: the same for all hinges, and what a solve that fails goes back to.
    void begin() {
        for (size_t i = 0; i < shape_.joints; ++i) {
            const JointShape& k = shape_.joint[i];
            for (uint32_t r = 0; r < k.lines && k.is_hinge; ++r) {
                DeskLine<V>& line = lines[k.line + r];
                if (r >= 2) line.a[2] = O::all(-1), line.b[2] = O::all(1);
                line.per_size = r < 2 ? anchors_[i].per_size : O::all(1);
            }
        }
        keep();
    }
    void keep() {
        for (size_t p = 0; p < shape_.parts; ++p)
            for (int i = 0; i < 3; ++i) {
                parts[p].first_v[i] = parts[p].v[i];
                parts[p].known[i] = parts[p].first_given[i] = parts[p].given[i];
            }
        for (size_t i = 0; i < shape_.lines; ++i) lines[i].first_impulse = lines[i].impulse;
        for (size_t i = 0; i < shape_.bounds; ++i) {
            DeskLine<V>& line = lines[shape_.bound[i].line];
            line.first_step = line.step;
        }
    }

    /// Newton's method, in which the matrix stays that of the start. Says who found a solution: with the steps as they
    /// are, if those are trusted. Else what is to hold where the drift ends is first kept as if rows stayed as they
    /// are, and then looked at there: those who come to that in the same round go on together.
    Mask iterate(Mask active, bool trusts) {
        Iteration all{trusts, trusts || is_simple_};
        run(all, 0, active, all.is_known);
        if (task_.is_exact() && !all.is_known)
            for (int i = 0; i < most_rounds; ++i)
                if (O::any(all.settled[i])) run(all, i + 1, all.settled[i], true);
        is_late_ = false;
        if (task_.is_exact() && !trusts && O::any(all.solved)) sum_up(all.solved);
        return all.solved;
    }

    /// One round of it, where one is needed, for contacts will act again. Says who is nearly held then; what is out of
    /// its bounds goes to its next step in the round after that, but not a motor that would give far more than it can:
    /// contacts would answer it.
    Mask approach(Mask where) {
        constexpr double enough = 1e-3;  // of what was missing
        feel(where), take_steps(where);
        if (const Mask gave = give_bounded(where); O::any(gave)) feel(gave);
        const V first = miss();
        const Mask active = O::both(where, O::no(first <= little));
        if (!O::any(active)) return where;
        correct(active), feel(active);
        const V left = miss();
        const Mask near = O::both(O::no(overdrives()), O::either(left <= little, left <= enough * first));
        return O::both(where, O::either(O::no(active), near));
    }
    /// Whether a motor that holds its speed gives twice what it can.
    Mask overdrives() const {
        Mask over = O::nowhere();
        for (size_t i = 0; i < shape_.bounds; ++i) {
            const DeskLine<V>& line = lines[shape_.bound[i].line];
            const DeskBound<V>& w = bounds_[i];
            const V all = 0.5 * (w.most - w.least);
            const Mask beyond = O::either(line.impulse > w.most + all, line.impulse < w.least - all);
            over = O::either(over, O::both(O::both(line.step == number_of(Step::held), w.motor > 0.0), beyond));
        }
        return over;
    }
    /// Which rows are at their bounds, as if rows stayed as they are: what contacts have changed, before it is trusted.
    void settle(Mask where) {
        constexpr int most = 10;
        for (int i = 0; i < most && O::any(where); ++i) {
            feel(where);
            const Mask moved = take_steps(where);
            if (const Mask gave = give_bounded(where); O::any(gave)) feel(gave);
            const V missing = miss();
            where = O::both(where, i == 0 ? O::either(moved, O::no(missing <= little)) : moved);
            if (O::any(where)) correct(where);
        }
    }
    /// A solve as the task wants it, that begins with the steps as they are. Says who found a solution.
    Mask attempt(Mask where) {
        if (task_.is_exact() && task_.is_warm) settle(where);
        if (task_.is_last) return iterate_to_end(where);
        const Mask near = approach(where), left = O::both(where, O::no(near));
        if (!O::any(left)) return near;
        go_back(left);
        return O::either(near, iterate(left, false));
    }

    /// Rows that are kept begin with the impulses that the substep before lets expect.
    void foresee(Mask where) {
        where = O::some(where);
        for (size_t i = 0; i < shape_.joints; ++i) {
            const JointShape& k = shape_.joint[i];
            for (uint32_t r = 0; r < k.rigid; ++r) give(k, r, where, h_ * lines[k.line + r].half);
            for (uint32_t r = k.rigid; r < k.lines; ++r) {
                const DeskLine<V>& line = lines[k.line + r];
                const bool begins = task_.is_warm || shape_.bound[shape_.bound_of[k.line + r]].is_spring;
                give(k, r, O::both(where, is_in(line.step)), begins ? h_ * line.half : O::all(0));
            }
        }
        give_bounded(where);
    }
    void feel(Mask where) {
        where = O::some(where);
        for (size_t p = 0; p < shape_.parts; ++p) feel_given<V>(where, parts[p]);
    }
    void go_back(Mask where) {
        where = O::some(where);
        const auto put = [where](V& to, V from) { to = O::select(where, from, to); };
        for (size_t p = 0; p < shape_.parts; ++p)
            for (int i = 0; i < 3; ++i) {
                DeskPart<V>& part = parts[p];
                put(part.v[i], part.first_v[i]);
                put(part.known[i], part.first_given[i]), put(part.given[i], part.first_given[i]);
            }
        for (size_t i = 0; i < shape_.lines; ++i) put(lines[i].impulse, lines[i].first_impulse);
        for (size_t i = 0; i < shape_.bounds; ++i) {
            DeskLine<V>& line = lines[shape_.bound[i].line];
            put(line.step, line.first_step);
        }
    }

    /// Goes to the next step of their staircase with all rows that are out of the bounds of theirs.
    Mask take_steps(Mask where) {
        where = O::some(where);
        Mask moved = take_steps_of_pairs();
        for (size_t i = 0; i < shape_.bounds; ++i) {
            const BoundShape& b = shape_.bound[i];
            if (b.is_paired) continue;
            DeskLine<V>& line = lines[b.line];
            const V next = step_of(b.is_spring, task_.drifts, speed_of(b, line), bounds_[i], line);
            const Mask moves = O::both(where, next != line.step);
            moved = O::either(moved, moves);
            line.step = O::select(moves, next, line.step);
        }
        return moved;
    }
    /// Rows at their bounds get what those say.
    Mask give_bounded(Mask where) {
        where = O::some(where);
        Mask gave = O::nowhere();
        for (size_t i = 0; i < shape_.bounds; ++i) {
            const BoundShape& b = shape_.bound[i];
            if (b.is_spring && !task_.drifts) continue;
            const DeskLine<V>& line = lines[b.line];
            const V none = O::all(0);
            const V impulse = O::select(line.step == number_of(Step::pushing), bounds_[i].push,
                                        O::select(line.step == number_of(Step::pulling), bounds_[i].least, none));
            const Mask gives = O::both(where, O::both(O::no(is_in(line.step)), impulse != line.impulse));
            if (!O::any(gives)) continue;
            give(shape_.joint[b.joint], b.row, gives, impulse - line.impulse);
            gave = O::either(gave, gives);
        }
        return gave;
    }
    /// Writes what is missing of every row's speed; returns the largest, as a part of its size in a substep.
    V miss() {
        V worst = ahead ? worst_there_ : miss_here();
        const V none = O::all(0);
        creeps_ = O::nowhere();
        for (size_t i = 0; i < shape_.bounds; ++i) {
            const BoundShape& b = shape_.bound[i];
            const DeskLine<V>& line = lines[b.line];
            const DeskBound<V>& w = bounds_[i];
            const V aim = O::select(line.step == number_of(Step::lower), w.low,
                                    O::select(line.step == number_of(Step::upper), w.high, w.speed));
            const V soft = O::select(w.softness > 0.0, w.softness * line.impulse, none);
            const V missing = O::select(is_in(line.step), aim - speed_of(b, line) - soft, none);
            unknowns[N * shape_.joint[b.joint].place + b.row] = missing;
            note_worst(missing, line, worst);
            const Mask is_dry = O::both(O::both(w.motor > 0.0, aim == none), line.step == number_of(Step::held));
            creeps_ = O::either(creeps_, O::both(is_dry, missing != none));
        }
        return worst * h_;
    }
    /// Takes what a row misses for the worst, if it is, as a part of its size; what is no number is worse than any.
    static void note_worst(V missing, const DeskLine<V>& line, V& worst) {
        worst = O::larger(magnitude(missing) * line.per_size, worst);
    }
    /// A round with the matrix for the steps of now.
    void correct(Mask where) {
        const Mask unfit = O::both(where, O::no(keeper_.fits(*this)));
        if (O::any(unfit)) keeper_.refactor(*this, unfit);
        solve(where);
    }
    void solve(Mask where) {
        keeper_.solve(unknowns);
        give_unknowns(where);
    }
    /// Gives the impulses that a solve has found.
    void give_unknowns(Mask where) {
        where = O::some(where);
        for (size_t i = 0; i < shape_.joints; ++i) {
            const JointShape& k = shape_.joint[i];
            const V* const impulse = &unknowns[N * k.place];
            if (k.is_hinge) give_point(k, where, impulse);
            for (uint32_t r = k.is_hinge ? points : 0; r < N && r < k.rigid; ++r) give(k, r, where, impulse[r]);
            for (uint32_t r = k.rigid; r < N && r < k.lines; ++r)
                give(k, r, O::both(where, is_in(lines[k.line + r].step)), impulse[r]);
        }
    }

    /// Where the joints are at the end of the drift with the velocities of now; `whole` with their rows.
    template <bool whole>
    void look_ahead(Mask where) {
        if (!whole && keeper_.looks_ahead(shape_, task_, worst_there_)) return;
        where = O::some(where);
        for (size_t i = 0; i < shape_.parts; ++i) {
            if (!whole) feel_given<V>(where, parts[i]);
            drift_part(task_, parts[i]);
        }
        look<whole>(where);
    }
    /// What rigid rows miss there is written down for `miss`.
    template <bool whole>
    void look(Mask where) {
        where = O::some(where);
        V worst = O::all(0);
        for (size_t i = 0; i < shape_.joints; ++i) {
            const JointShape& k = shape_.joint[i];
            if (k.is_hinge)
                look_at_hinge<whole>(where, k, anchors_[i], worst);
            else
                keeper_.template look<whole>(*this, i);
            for (uint32_t r = k.is_hinge ? points : 0; r < N; ++r)
                if (r < k.rigid)
                    miss_there(k, r, lines[k.line + r].last_error, worst);
                else
                    unknowns[N * k.place + r] = O::all(0);
        }
        worst_there_ = worst;
    }
    /// Gives momentum along a joint's row, which `feel` turns into velocity; along those of a hinge by a short way.
    void push(const JointShape& k, uint32_t row, V impulse) {
        const DeskLine<V>& j = lines[k.line + row];
        V *const a = parts[k.a].given, *const b = parts[k.b].given;
        if (!k.is_hinge)
            for (int i = 0; i < 2; ++i) a[i] += j.a[i] * impulse, b[i] += j.b[i] * impulse;
        else if (row < 2)
            a[row] -= impulse, b[row] += impulse;
        a[2] += j.a[2] * impulse, b[2] += j.b[2] * impulse;
    }

  private:
    static constexpr double huge = __builtin_huge_val();
    static constexpr uint32_t points = N < 2 ? N : 2;  ///< rows of a hinge that make two points one
    static constexpr double little = 1e2 * tiny;       ///< what contacts may change again

    static constexpr int most_rounds = 20;
    /// Newton's method under way.
    struct Iteration {
        const bool trusts, is_known;  ///< the steps, and at which bounds rows are
        V worst = O::all(huge), first = O::all(0);
        Mask solved = O::nowhere();
        Mask had_others = O::nowhere();  ///< steps, a round ago
        Mask settled[most_rounds]{};     ///< who is to be looked at ahead from the round after that on
    };
    /// Its rounds from the i-th on. Which rows are at their bounds is found as if rows stayed as they are, before the
    /// bodies are sent anywhere: those that have `settled` it have their rows looked at ahead, if that is asked for.
    void run(Iteration& all, int i, Mask active, bool settled) {
        const bool exact = task_.is_exact();
        const auto end = [&](Mask where, Mask well) {
            all.solved = O::either(all.solved, O::both(where, well)), active = O::both(active, O::no(where));
        };
        all.worst = O::all(huge);
        for (; i < most_rounds && O::any(active); ++i) {
            ahead = exact && settled;
            if (ahead)
                look_ahead<false>(active);
            else
                feel(active);
            const Mask moved = begin_round(all, i, active);
            const V before = all.worst;
            all.worst = miss();
            if (i == 0) all.first = all.worst;
            active = O::both(active, all.worst < huge);
            // What is left of a speed adds up to a gap.
            const double enough = i > 0 || all.trusts || task_.is_warm ? tiny : -1;
            const Mask is_kept = O::both(all.worst <= enough, i > 0 ? active : O::no(creeps_));
            if (exact && !settled) {
                const Mask settles = O::both(O::both(active, O::no(moved)), i > 0 ? active : is_kept);
                all.settled[i] = settles, active = O::both(active, O::no(settles));
            }
            const Mask there = O::both(active, O::both(O::no(moved), is_kept));
            if (O::any(there)) end(there, all.trusts ? O::no(take_steps(there)) : there);
            if (i > 1) {
                const Mask is_as_before = O::no(O::either(moved, all.had_others));
                const Mask stuck = O::both(active, O::both(is_as_before, all.worst > 0.8 * before));
                if (O::any(stuck)) end(stuck, is_near(all.worst, all.first, all.trusts));
            }
            all.had_others = O::either(O::both(active, moved), O::both(O::no(active), all.had_others));
            if (!O::any(active)) break;
            correct(active);
            // What is missing falls by about as much again, and what a limit is passed by then is no gap yet.
            if (i == 0 || !all.is_known) continue;
            const Mask done = O::both(active, O::both(all.worst <= 50 * tiny, all.worst <= 0.05 * before));
            if (O::any(done)) feel(done), end(done, O::no(take_steps(done)));
        }
        if (O::any(active)) feel(active), end(active, is_near(all.worst, all.first, all.trusts));
    }
    /// Rows go to other steps, and those at their bounds get what these say. Says where some went.
    Mask begin_round(const Iteration& all, int i, Mask active) {
        Mask moved = O::nowhere();
        is_late_ = i >= most_rounds / 2;
        if (!all.trusts && (i > 0 || task_.is_warm)) moved = is_late_ ? take_steps_of_pairs() : take_steps(active);
        if (const Mask gave = give_bounded(active); O::any(gave)) feel(gave);
        if (O::any(moved)) sum_up(moved);
        return moved;
    }
    /// The last solve of a half. In lanes those who find no solution with the steps as they are begin again, and do not
    /// trust them; of one that is alone others decide what is tried then.
    Mask iterate_to_end(Mask where) {
        const bool exact = task_.is_exact();
        const Mask found = iterate(where, exact), left = O::both(where, O::no(found));
        if (O::lanes == 1 || !exact || !O::any(left)) return found;
        go_back(left);
        return O::either(found, iterate(left, false));
    }

    Mask is_near(V worst, V first, bool trusts) const {
        constexpr double enough = 1e-3;  // of what was missing
        if (trusts) return O::nowhere();
        if (task_.is_exact()) return worst <= 1e2 * tiny;
        return O::either(worst <= 1e2 * tiny, worst <= enough * first);
    }
    void give(const JointShape& k, uint32_t row, Mask where, V impulse) {
        DeskLine<V>& line = lines[k.line + row];
        const V given = O::select(where, impulse, O::all(0));
        line.impulse += given;
        push(k, row, given);
    }
    /// The same along both rows in which a hinge's points are one.
    void give_point(const JointShape& k, Mask where, const V* impulse) {
        V *const a = parts[k.a].given, *const b = parts[k.b].given;
        V turn_a = a[2], turn_b = b[2];
        for (uint32_t r = 0; r < points; ++r) {
            DeskLine<V>& line = lines[k.line + r];
            const V given = O::select(where, impulse[r], O::all(0));
            line.impulse += given;
            a[r] -= given, b[r] += given;
            turn_a += line.a[2] * given, turn_b += line.b[2] * given;
        }
        a[2] = turn_a, b[2] = turn_b;
    }
    /// Velocities as the impulses of now make them: rows that contradicted one another may have pushed a million times
    /// as hard on the way to these, which leaves its rounding behind.
    void sum_up(Mask where) {
        where = O::some(where);
        for (size_t p = 0; p < shape_.parts; ++p)
            for (int i = 0; i < 3; ++i) {
                DeskPart<V>& part = parts[p];
                part.v[i] = O::select(where, part.first_v[i], part.v[i]);
                part.given[i] = O::select(where, part.first_given[i], part.given[i]);
                part.known[i] = O::select(where, part.given[i], part.known[i]);
            }
        for (size_t i = 0; i < shape_.joints; ++i) {
            const JointShape& k = shape_.joint[i];
            for (uint32_t r = 0; r < k.lines; ++r) {
                const DeskLine<V>& line = lines[k.line + r];
                push(k, r, O::select(where, line.impulse - line.first_impulse, O::all(0)));
            }
        }
        feel(where);
    }

    /// J v of a joint's row.
    V speed(const JointShape& k, uint32_t row) const {
        const DeskLine<V>& j = lines[k.line + row];
        const V *const a = parts[k.a].v, *const b = parts[k.b].v;
        if (!k.is_hinge)
            return (j.a[0] * a[0] + j.a[1] * a[1] + j.a[2] * a[2]) + (j.b[0] * b[0] + j.b[1] * b[1] + j.b[2] * b[2]);
        return row < 2 ? speed_of_point(k, row) : b[2] - a[2];
    }
    V speed_of_point(const JointShape& k, uint32_t row) const {
        const DeskLine<V>& j = lines[k.line + row];
        const V *const a = parts[k.a].v, *const b = parts[k.b].v;
        return (j.a[2] * a[2] - a[row]) + (j.b[2] * b[2] + b[row]);
    }
    /// Of a row that is not rigid; on the whole way if the end is known.
    V speed_of(const BoundShape& b, const DeskLine<V>& line) const {
        if (ahead && (b.is_spring || !b.is_paired)) return (line.last_error - line.error) / h_;
        return speed(shape_.joint[b.joint], b.row);
    }
    /// Writes what a rigid row misses that has this gap where the drift ends.
    [[gnu::always_inline]] void miss_there(const JointShape& k, uint32_t row, V error, V& worst) {
        const DeskLine<V>& line = lines[k.line + row];
        const V missing = (line.aim - error) * per_h_;
        unknowns[N * k.place + row] = missing;
        note_worst(missing, line, worst);
    }
    /// Writes what rigid rows miss of their speeds; those that are not there miss nothing.
    V miss_here() {
        V worst = O::all(0);
        for (size_t i = 0; i < shape_.joints; ++i) {
            const JointShape& k = shape_.joint[i];
            V* const missing = &unknowns[N * k.place];
            const auto note = [&](uint32_t r, V speed) {
                const DeskLine<V>& line = lines[k.line + r];
                missing[r] = (task_.drifts ? (line.aim - line.error) * per_h_ : O::all(0)) - speed;
                note_worst(missing[r], line, worst);
            };
            if (k.is_hinge)
                for (uint32_t r = 0; r < points; ++r) note(r, speed_of_point(k, r));
            for (uint32_t r = k.is_hinge ? points : 0; r < N; ++r)
                if (r < k.rigid)
                    note(r, speed(k, r));
                else
                    missing[r] = O::all(0);
        }
        return worst;
    }

    /// Of hinges, and so in lanes, there are none.
    Mask take_steps_of_pairs() {
        Mask moved = O::nowhere();
        if constexpr (O::lanes == 1)
            for (size_t i = 0; i < shape_.bounds && shape_.has_pairs; ++i)
                if (shape_.bound[i].is_paired) moved = take_step_of_pair(i++) || moved;
        return moved;
    }
    bool take_step_of_pair(size_t i) {
        const BoundShape* const b = &shape_.bound[i];
        const JointShape& k = shape_.joint[b->joint];
        DeskLine<double>* const pair = &lines[b->line];
        const double u[2] = {speed_of(b[0], pair[0]), speed_of(b[1], pair[1])};
        const PairTask task{b->is_spring, task_.drifts, !ahead && !is_late_, !is_late_};
        return step_of_pair(task, u, parts[k.a].ease, parts[k.b].ease, pair, &bounds_[i]);
    }

    /// Rows of a hinge. Its angle's never change.
    template <bool whole>
    void look_at_hinge(Mask where, const JointShape& k, const DeskAnchors<V>& at, V& worst) {
        const DeskPlace<V>&a = parts[k.a].now, &b = parts[k.b].now;
        const HingeEnds<V> ends(a, b, at);
        miss_there(k, 0, ends.x, worst), miss_there(k, 1, ends.y, worst);
        if (whole) ends.put_levers(&lines[k.line]);
        if (k.lines == 2) return;
        const V angle = b.angle - a.angle - at.rest;
        for (uint32_t i = 2; i < k.lines; ++i) {
            DeskLine<V>& line = lines[k.line + i];
            line.last_error = O::select(where, angle, line.last_error);
        }
    }

    const DeskShape& shape_;
    const DeskTask& task_;
    DeskAnchors<V>* anchors_;
    DeskBound<V>* bounds_;
    Keeper& keeper_;
    double h_, per_h_;
    V worst_there_ = O::all(0);  ///< that a rigid row misses where the drift ends, of its size
    bool is_simple_;
    bool is_late_ = false;        ///< what slides is not held any more in this solve
    Mask creeps_ = O::nowhere();  ///< dry friction holds a row that still moves
};

}  // namespace
}  // namespace carom
