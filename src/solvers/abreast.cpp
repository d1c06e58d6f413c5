// Mechanisms that are alike are solved side by side, one a lane; and the two solves of a substep of all. Where contacts
// act in between, what is laid out stays on its desk for a half: its rows stay as they are in it, and so does the
// matrix while no row comes to its bounds.

#include "solvers/half.hpp"
#include "solvers/lay.hpp"

namespace carom {

namespace {

using Some = std::span<Mechanism* const>;

/// Mechanisms that are alike, one a lane.
template <int L, int N>
class Abreast {
  public:
    /// `begins`: they have drifted, and what comes then is still to be begun.
    Abreast(Some some, const Asked& asked, bool begins = false)
        : some_(some.begin(), some.end()),
          shape_(shape_for(*some[0], asked)),
          on_(shape_, most_below(*some[0]), true),
          laid_((1U << some.size()) - 1),
          has_begun_(begins) {
        const DeskTask task = task_of(at(0), asked, true);
        const DeskSource source = source_of(of(), L, asked);
        if (begins)
            laid_ &= ~desk_kernel().lay_drifted(shape_, task, on_.memory(), source);
        else
            desk_kernel().lay(shape_, task, on_.memory(), source);
        for (std::size_t i = 0; i < shape_.bounds; ++i) {
            const std::uint32_t line = shape_.bound[i].line;
            for (int lane = 0; lane < L; ++lane)
                on_.lines[line].step.at[lane] = number_of(of()(lane).lines[shape_.line_of[line]].step);
        }
    }

    /// Solves them for the velocities that they have, and takes them up.
    void hold(const Asked& asked) {
        const unsigned tried = tried_of(asked), solved = solve(asked, tried);
        take_up(shape_, on_, asked, count(), solved, of());
        if (has_begun_) take_up_begun(asked, laid_ & ~solved);
        for (int lane = 0; lane < count(); ++lane)
            if (!has(solved, lane)) hold_alone(at(lane), asked, has(tried, lane));
    }
    /// Has those that touch something begin what comes after the drift with these velocities.
    void begin(const Asked& asked, BodyMotion& motion) {
        if (has_begun_) take_up_begun(asked, 0);
        note_seats();
        give_velocities_of_all(motion);
    }
    /// Solves them for the velocities that contacts have left. They are taken up after the last solve of a half, and
    /// who had to be solved alone before that stays so.
    void hold(const Asked& asked, BodyMotion& motion) {
        const bool last = asked.round == Round::last, is_at_hand = asked.drifts && asked.round == Round::first;
        if (!is_at_hand) on_.fetch();
        if (seats_.empty()) note_seats();
        if (last)
            for (const Mechanism* m : some_) fetch(*m);  // they have lain on the desk for long, and are taken up then
        take_velocities_of_all(motion);
        const unsigned tried = tried_of(asked), solved = solve(asked, tried), failed = laid_ & ~solved;
        if (failed != 0) take_up<true>(shape_, on_, asked, count(), failed, of());
        if (last) take_up(shape_, on_, asked, count(), solved, of());
        laid_ = solved;
        for (int lane = 0; lane < count(); ++lane)
            if (!has(solved, lane)) hold_alone(at(lane), asked, has(tried, lane));
        if (!last) give_velocities_of_all(motion);
    }

  private:
    /// A part of a lane among all bodies.
    struct Seat {
        std::uint32_t row;
        bool moves;
        double slow[2];
    };

    static bool has(unsigned lanes, int lane) { return (lanes >> lane & 1U) != 0; }
    static DeskShape shape_for(const Mechanism& m, const Asked& asked) {
        return std::visit([&](const auto& matrix) { return shape_of(m, matrix, asked.rows(m)); }, m.matrix);
    }
    static std::size_t most_below(const Mechanism& m) {
        return std::visit([](const auto& matrix) { return matrix.most_below(); }, m.matrix);
    }
    int count() const { return static_cast<int>(some_.size()); }
    Mechanism& at(int lane) const { return *some_[static_cast<std::size_t>(lane)]; }
    /// Lanes that are left over have the first mechanism too, and what they compute is dropped.
    auto of() const {
        return [this](int lane) -> Mechanism& { return at(lane < count() ? lane : 0); };
    }
    /// Those on the desk for which a solution is sought there.
    unsigned tried_of(const Asked& asked) const {
        unsigned tried = laid_;
        for (int lane = 0; lane < count(); ++lane)
            if (asked.tries_nothing(at(lane))) tried &= ~(1U << lane);
        return tried;
    }
    unsigned solve(const Asked& asked, unsigned tried) {
        // Each is factored here: that is less than to bring the factor of the substep before.
        const DeskTask task = task_of(at(0), asked, begins_);
        unsigned solved = desk_kernel().iterate[N - 2](shape_, task, on_.memory(), tried);
        begins_ = false;
        const unsigned calm = asked.drifts ? desk_kernel().calm(shape_, on_.memory(), most_made) : 0;
        for (int lane = 0; lane < count(); ++lane)
            if (has(solved, lane) && !is_sound(asked, on_, lane, at(lane), has(calm, lane))) solved &= ~(1U << lane);
        return solved;
    }

    /// What was begun here, of those too that are `left` to be solved alone.
    void take_up_begun(const Asked& asked, unsigned left) {
        take_up<true>(shape_, on_, asked, count(), left, of());
        for (int lane = 0; lane < count(); ++lane)
            if (has(laid_, lane))
                take_up_rows(shape_, on_, lane, at(lane));
            else
                begin_relax(asked, at(lane));
    }

    void note_seats() {
        for (std::size_t p = 0; p < shape_.parts; ++p)
            for (const Mechanism* m : some_) {
                const Mechanism::Part& part = m->parts[p];
                seats_.push_back({part.row, part.inverse_mass != 0, {part.slow[0], part.slow[1]}});
            }
    }
    template <class Act>
    void each_seat(Act act) {
        const Seat* seat = seats_.data();
        for (std::size_t p = 0; p < shape_.parts; ++p)
            for (int lane = 0; lane < count(); ++lane) act(*seat++, on_.parts[p], lane);
    }
    void take_velocities_of_all(BodyMotion& motion) {
        each_seat([&](const Seat& seat, DeskPart<Many<L>>& part, int lane) {
            const Mover& from = motion.movers[seat.row];
            part.v[0].at[lane] = seat.slow[0] * from.vx, part.v[1].at[lane] = seat.slow[0] * from.vy;
            part.v[2].at[lane] = seat.slow[1] * from.w;
            if (seat.moves) note_velocity(from, -1, motion.by_joints[seat.row]);
        });
        for (int lane = 0; lane < count(); ++lane)
            if (!has(laid_, lane)) take_velocities(1, at(lane), motion.movers);
    }
    void give_velocities_of_all(BodyMotion& motion) {
        for (int lane = 0; lane < count(); ++lane)
            if (!has(laid_, lane)) give_velocities(1, at(lane), motion.movers);
        each_seat([&](const Seat& seat, const DeskPart<Many<L>>& part, int lane) {
            if (!seat.moves) return;
            Mover& to = motion.movers[seat.row];
            if (has(laid_, lane)) {
                to.vx = part.v[0].at[lane] / seat.slow[0], to.vy = part.v[1].at[lane] / seat.slow[0];
                to.w = part.v[2].at[lane] / seat.slow[1];
            }
            note_velocity(to, 1, motion.by_joints[seat.row]);
        });
    }

    Scratch<Mechanism*> some_;
    DeskShape shape_;
    DeskLayout<Many<L>, N> on_;
    unsigned laid_;       ///< the lanes that are on the desk
    bool begins_ = true;  ///< nothing of the layout has been solved
    bool has_begun_;      ///< here, and not where they lie in memory
    Scratch<Seat> seats_{};
};

bool are_alike(const Mechanism& a, const Mechanism& b) {
    return a.kind == b.kind && a.is_hinged && !a.is_dear && !a.is_redundant && !b.is_redundant;
}

/// Calls act with what is solved together: those that are alike and beside one another, of whose joints none has more
/// than N rows, or one that is solved alone.
template <class Together, class Alone>
void each_together(Some some, const Asked& asked, Together together, Alone alone) {
    const auto most = static_cast<std::size_t>(desk_kernel().lanes);
    for (std::size_t first = 0, last; first < some.size(); first = last) {
        for (last = first + 1; last < some.size() && last - first < most; ++last)
            if (!are_alike(*some[first], *some[last])) break;
        if (last - first == 1) {
            alone(*some[first]);
            continue;
        }
        const auto run = [&]<int N>() {
            const Some these = some.subspan(first, last - first);
            if (most == 8) together.template operator()<8, N>(these);
            if (most == 4) together.template operator()<4, N>(these);
            if (most == 2) together.template operator()<2, N>(these);
        };
        const std::uint32_t rows = asked.rows(*some[first]).widest;
        if (rows == 2) run.template operator()<2>();
        if (rows == 3) run.template operator()<3>();
        if (rows == 4) run.template operator()<4>();
    }
}

/// Those that touch nothing: after the drift they are begun with, too.
void hold_all(Some some, const Asked& asked) {
    const bool begins = !asked.drifts, in_lanes = begins && asked.gives_halves();
    const auto begin_alone = [&](Mechanism& m) {
        if (begins) begin_relax(asked, m);
    };
    each_together(
        some, asked,
        [&]<int L, int N>(Some these) {
            for (Mechanism* m : these)
                if (!in_lanes) begin_alone(*m);
            Abreast<L, N>(these, asked, in_lanes).hold(asked);
        },
        [&](Mechanism& m) { begin_alone(m), hold_alone(m, asked, false); });
}

/// Lays out those that touch something for the solves of a half: after the drift they begin it so, too.
void lay_touched(Some some, const Asked& asked, Scratch<Desks::Solve>& solves, BodyMotion& motion) {
    const bool begins = !asked.drifts, in_lanes = begins && asked.gives_halves();
    each_together(
        some, asked,
        [&]<int L, int N>(Some these) {
            using On = Abreast<L, N>;
            for (Mechanism* m : these)
                if (begins && !in_lanes) begin_relax(asked, *m);
            const auto run = [](void* on, const Asked& to, BodyMotion& of_bodies) {
                static_cast<On*>(on)->hold(to, of_bodies);
            };
            const auto on = std::allocate_shared<On>(ScratchAllocator<On>(), these, asked, in_lanes);
            if (begins) on->begin(asked, motion);
            solves.push_back({run, on});
        },
        [&](Mechanism& m) {
            if (begins) {
                begin_relax(asked, m);
                give_velocities(asked.threads, m, motion.movers);
                note_touched_velocities(m, 1, motion);
            }
            solves.push_back(hold_between_contacts(m, asked));
        });
}
/// What is laid out for the first solve of a half serves all of them. After the last one they are taken up, and still
/// to give their velocities.
void hold_touched(Some some, const Asked& asked, Scratch<Desks::Solve>& solves, BodyMotion& motion) {
    if (asked.drifts && asked.round == Round::first) lay_touched(some, asked, solves, motion);
    for (const Desks::Solve& solve : solves) solve.run(solve.of.get(), asked, motion);
    if (asked.round == Round::last) solves.clear();
}
Scratch<Desks::Solve>& desks_of(Some some, const Mechanisms& all, Desks& desks) {
    return desks.of_few[static_cast<std::size_t>(some[0] - all.all.data()) / few];
}

/// Has what the joints of a mechanism carry on brought near; and all of one that was not at hand before its last solve.
void fetch_memory(const Mechanisms& mechanisms, const Mechanism& m) {
    if (m.is_touched) fetch(m);
    for (const Member& k : m.members) fetch(std::span(&mechanisms.memory[k.joint], 1));
}

/// All that a mechanism got that touches nothing is the joints'.
void note_given(int threads, Mechanism& m, BodyMotion& motion) {
    each_part(threads, m, [&](const Mechanism::Part& p) {
        if (p.inverse_mass == 0) return;
        const Mover &now = motion.movers[p.row], &before = motion.before[p.row];
        motion.by_joints[p.row] = {{now.vx - before.vx, now.vy - before.vy}, now.w - before.w};
    });
}

/// Solves those of a few mechanisms that touch something, and in the last round of a half the others, which `begin`
/// gives their velocities. Then they have what they are to give.
template <class Begin>
void hold_some(Some some, const Asked& asked, BodyMotion& motion, Desks& desks, Begin begin) {
    Mechanism* parted[few];
    std::size_t touched = 0, all = 0;
    for (const bool is_touched : {true, false}) {
        for (Mechanism* m : some)
            if (m->is_touched == is_touched) parted[all++] = m;
        if (is_touched) touched = all;
    }
    const Some free(parted + touched, all - touched);
    hold_touched({parted, touched}, asked, desks_of(some, asked.all, desks), motion);
    if (asked.round != Round::last) return;
    if (asked.drifts)
        for_each_fetched(asked.all, free, begin);
    else
        std::for_each(free.begin(), free.end(), [&](Mechanism* m) { begin(*m); });  // they are at hand
    hold_all(free, asked);
}

/// The last solve of a substep, and the books of it.
void end_some(const SoftScene& scene, Mechanisms& mechanisms, const Asked& asked, Some some, State& state,
              BodyMotion& motion, Desks& desks, Flows& account) {
    const double h = asked.h;
    hold_some(some, asked, motion, desks, [&](Mechanism& m) { see_drifted(asked.threads, state, motion, m); });
    for (std::size_t i = 0; i < some.size(); ++i) {
        Mechanism* const m = some[i];
        if (i + 1 < some.size()) fetch_memory(mechanisms, *some[i + 1]);
        give_velocities(asked.threads, *m, motion.movers);
        MeanVelocities means(asked.threads, *m, motion.start.v, motion.movers);
        curb(scene, h, {motion.start, motion.proposed, state}, motion.movers, *m, means);
        note_touched_velocities(*m, 1, motion);
        if (!m->is_touched) note_given(asked.threads, *m, motion);
        end_substep(scene, mechanisms, h, means, state, *m, account);
    }
}
/// The rows of bodies that move, as many at a time as follow one another.
Scratch<RowRange> runs_of(Some some) {
    Scratch<RowRange> runs;
    for (const Mechanism* m : some)
        for (const Mechanism::Part& p : m->parts) {
            if (p.inverse_mass == 0) continue;
            if (!runs.empty() && runs.back().last == p.row)
                ++runs.back().last;
            else
                runs.push_back({p.row, p.row + 1U});
        }
    return runs;
}
/// Moves the bodies of mechanisms that are carried, and gives them the rest of their kick: in lanes, as all others.
void carry(const SoftScene& scene, Some some, double h, State& state, SoftContacts& contacts) {
    const MoverRows rows = mover_rows(state, contacts);
    const Scratch<RowRange> runs = runs_of(some);
    const int threads = threads_within(scene);
    const auto each_run = [&](auto act) {
        for (const auto& [first, last] : runs)
            for_each_rows(threads, last - first,
                          [&, start = first](std::size_t from, std::size_t to) { act(start + from, start + to); });
    };
    each_run([&](std::size_t first, std::size_t last) { mover_kernel().drift(rows, h, first, last); });
    for (Mechanism* m : some) {
        if (!m->is_slow) continue;
        each_part(threads, *m, [&](const Mechanism::Part& p) {
            if (is_slow(p) && p.inverse_mass != 0) drift_slowly(p, contacts.motion.start, h, state, contacts.motion);
        });
    }
    each_run(
        [&](std::size_t first, std::size_t last) { mover_kernel().kick(rows, 1 - scene.drift_share, first, last); });
}

/// A mechanism whose drift is only looked at: it becomes again what it was.
class Undone {
  public:
    explicit Undone(Mechanism& m)
        : m_(m),
          parts_(m.parts.begin(), m.parts.end()),
          lines_(m.lines.begin(), m.lines.end()),
          is_slow_(m.is_slow),
          is_projected_(m.is_projected),
          is_least_(m.is_least),
          is_given_up_(m.is_given_up) {}
    void undo() const {
        std::copy(parts_.begin(), parts_.end(), m_.parts.begin());
        std::copy(lines_.begin(), lines_.end(), m_.lines.begin());
        m_.is_slow = is_slow_, m_.is_projected = is_projected_;
        m_.is_least = is_least_, m_.is_given_up = is_given_up_;
    }

  private:
    Mechanism& m_;
    Scratch<Mechanism::Part> parts_;
    Scratch<JointLine> lines_;
    bool is_slow_, is_projected_, is_least_, is_given_up_;
};

}  // namespace

void foresee_drifts(const SoftScene& scene, Mechanisms& mechanisms, double h, const State& state, const Motion& kick,
                    const std::function<bool(const Mechanism&)>& is_wanted, Scratch<Twist>& gains) {
    const Dynamics& dynamics = scene.flight.dynamics;
    State end;  // of those who are driven
    if (dynamics.places()) {
        end = state, end.time += h;
        each([h](double& x, double v) { x += h * v; }, end.x, state.v);
        dynamics.place_driven(end);
    }
    const auto proposed = [&](const Mechanism::Part& p) -> Twist {
        if (p.row >= state.size()) return {};  // the ground
        const std::uint32_t i = p.row;
        if (p.inverse_mass != 0) return {state.v.linear[i] + kick.linear[i], state.v.angular[i] + kick.angular[i]};
        if (!dynamics.places()) return {state.v.linear[i], state.v.angular[i]};
        return {(1 / h) * (end.x.linear[i] - state.x.linear[i]), (end.x.angular[i] - state.x.angular[i]) / h};
    };
    const Asked asked{mechanisms, h, scene.drift_share, true, Round::last, threads_within(scene)};
    Flows none;
    each_awake_some(scene, mechanisms, none, is_wanted, [&](Some some, Flows&) {
        Scratch<Mechanism*> parted;
        std::size_t touched = 0;
        for (const bool is_touched : {true, false}) {
            for (Mechanism* m : some)
                if (m->is_touched == is_touched) parted.push_back(m);
            if (is_touched) touched = parted.size();
        }
        Scratch<Undone> before;
        for (Mechanism* m : parted) {
            before.emplace_back(*m);
            each_part(asked.threads, *m, [&](Mechanism::Part& p) {
                const Twist v = proposed(p);
                p.v[0] = p.slow[0] * v.velocity.x, p.v[1] = p.slow[0] * v.velocity.y;
                p.v[2] = p.slow[1] * v.angular_velocity;
            });
        }
        hold_all({parted.data(), touched}, asked);
        hold_all({parted.data() + touched, parted.size() - touched}, asked);
        for (Mechanism* m : parted)
            for (const Mechanism::Part& p : m->parts) {
                if (p.inverse_mass == 0) continue;
                const Twist v = proposed(p);
                gains[p.row] = {Vec2{p.v[0], p.v[1]} - v.velocity, p.v[2] - v.angular_velocity};
            }
        for (const Undone& m : before) m.undo();
    });
}

void hold_drift(const SoftScene& scene, Mechanisms& mechanisms, double h, Round round, State& state,
                SoftContacts& contacts, Desks& desks) {
    BodyMotion& motion = contacts.motion;
    const bool last = round == Round::last;
    const auto acts = [last](const Mechanism& m) { return last || m.is_touched; };
    const int threads = threads_within(scene);
    const Asked asked{mechanisms, h, scene.drift_share, true, round, threads},
        end{mechanisms, h, scene.drift_share, false, Round::last, threads};
    desks.of_few.resize(mechanisms.all.size());
    each_awake_some(scene, mechanisms, state.account, acts, [&](Some some, Flows& account) {
        hold_some(some, asked, motion, desks, [&](Mechanism& m) { take_velocities(asked.threads, m, motion.movers); });
        if (!last) return;
        Mechanism* carried[few];
        std::size_t count = 0;
        for (Mechanism* m : some) {
            give_velocities(asked.threads, *m, motion.movers);
            note_touched_velocities(*m, 1, motion);
            if (m->is_carried) carried[count++] = m;
        }
        if (count == 0) return;
        carry(scene, {carried, count}, h, state, contacts);
        end_some(scene, mechanisms, end, {carried, count}, state, motion, desks, account);
    });
}

void begin_relax(const SoftScene& scene, Mechanisms& mechanisms, double h, const State& state, BodyMotion& motion,
                 Desks& desks) {
    const Asked asked{mechanisms, h, scene.drift_share, false, Round::first, threads_within(scene)};
    const auto is_touched = [](const Mechanism& m) { return m.is_touched; };
    Flows none;
    desks.of_few.resize(mechanisms.all.size());
    each_awake_some(scene, mechanisms, none, is_touched, [&](Some some, Flows&) {
        for_each_fetched(mechanisms, some, [&](Mechanism& m) {
            note_touched_velocities(m, -1, motion);
            see_drifted(asked.threads, state, motion, m);
        });
        lay_touched(some, asked, desks_of(some, mechanisms, desks), motion);
    });
}

void hold_relax(const SoftScene& scene, Mechanisms& mechanisms, double h, Round round, State& state, BodyMotion& motion,
                Desks& desks) {
    const bool last = round == Round::last;
    const auto acts = [last](const Mechanism& m) { return (last || m.is_touched) && !m.is_carried; };
    const Asked asked{mechanisms, h, scene.drift_share, false, round, threads_within(scene)};
    desks.of_few.resize(mechanisms.all.size());
    each_awake_some(scene, mechanisms, state.account, acts, [&](Some some, Flows& account) {
        if (last)
            end_some(scene, mechanisms, asked, some, state, motion, desks, account);
        else
            hold_some(some, asked, motion, desks, [](Mechanism&) {});
    });
}

}  // namespace carom
