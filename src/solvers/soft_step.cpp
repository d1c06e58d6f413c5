#include "solvers/soft_step.hpp"

#include <algorithm>
#include <cmath>

#include "forces/parts.hpp"
#include "solvers/half.hpp"
#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/pivots.hpp"
#include "solvers/shared.hpp"
#include "threads/parallel.hpp"

namespace carom {

namespace {

/// Puts all that are looked at where they are, without velocities.
void place_movers(int threads, State& state, const Bodies& bodies, SoftContacts& contacts) {
    BodyMotion& motion = contacts.motion;
    const Rest& rest = contacts.rest;
    motion.movers.resize(state.size() + 1), motion.frames.resize(state.size() + 1);
    const MoverRows rows = mover_rows(state, contacts);
    const auto place = [&](std::size_t first, std::size_t last) {
        mover_kernel().place(rows, bodies.inverse_mass.data(), first, last);
    };
    if (!rest.is_known) for_each_rows(threads, state.size(), place);
    for (const auto& [first, last] : rest.moving)
        if (rest.is_known) place(first, last);
    motion.frames.back() = {}, motion.movers.back() = {};  // the ground
}

/// A substep under way.
struct Substep {
    const SoftScene& scene;
    State& state;
    SoftContacts& contacts;
    PreciseIslands& islands;
    double h;
    double as_soft_as;   ///< a substep of which length contacts give way [s]: that of a whole one, also in its parts
    double lasting = h;  ///< for so long its forces begin as those before: in a longer part a blow would be more of one
    BodyMotion& motion = contacts.motion;

    bool any_deep = false;  ///< in the step
    bool any_held = false;  ///< by joints, and awake
    Desks desks{};          ///< of what joints hold
    MoverRows rows{};       ///< since the impacts

    ContactBlock* blocks(std::size_t first) const { return &contacts.layout.blocks[first]; }
    /// Of the forces of the substep before, in the first half: that of the kick which is in the integrator's
    /// displacement.
    double first_share() const { return scene.drift_share * lasting; }
    double rest_share() const { return (1 - scene.drift_share) * lasting; }
    /// By which 1 N that lasts presses 1 kg in [s²]: the push bears its share of it.
    double preload_way() const { return scene.drift_share / stiffness(as_soft_as); }
    Softness soft() const { return softness(h, as_soft_as); }
};

void close_joints(Substep& s) {
    s.motion.by_joints.resize(s.motion.movers.size());
    for_each_moving(s.scene.threads, s.contacts.rest.moving, s.state.size(), [&](std::size_t first, std::size_t last) {
        std::fill(s.motion.by_joints.begin() + static_cast<std::ptrdiff_t>(first),
                  s.motion.by_joints.begin() + static_cast<std::ptrdiff_t>(last), Twist{});
    });
    s.any_held = !s.scene.mechanisms.all_sleep();
    if (!s.any_held) return;
    put_right(s.scene, s.scene.mechanisms, s.h, s.state, s.motion);
    s.motion.gaps_fit = false;  // who was put right is elsewhere
}

void propose(Substep& s) {
    take_moving(s.scene.threads, s.contacts.rest.moving, s.state, s.motion.start);
    if (s.contacts.rest.moving.empty())
        s.state.time += s.h;
    else
        propose_held(s.scene, s.scene.mechanisms, s.h, s.state, s.contacts.rest.moving, s.motion.rates);
}

void strike_all(Substep& s) {
    strike(s.scene, s.motion.start, s.state, s.h, s.contacts);
    take_moving(s.scene.threads, s.contacts.rest.moving, s.state, s.motion.proposed);
    for (auto* of_bodies : {&s.motion.before, &s.motion.means, &s.motion.leads}) {
        of_bodies->resize(s.motion.movers.size());
        of_bodies->back() = s.motion.movers.back();  // the ground, where a body may have been that was removed
    }
    s.rows = mover_rows(s.state, s.contacts);
    if (!s.scene.mechanisms.empty()) s.rows.carried = s.scene.mechanisms.carries.data();
}

void take_drift(Substep& s, std::size_t first, std::size_t last) {
    mover_kernel().take_drift(s.rows, s.h, s.scene.drift_share, first, last);
}

void foresee_bounces(Substep& s, std::size_t first, std::size_t last) {
    // Who comes down again before the substep ends would bounce in each, and sink meanwhile.
    const double least = 0.5 * s.h * length(s.scene.flight.dynamics.gravity());
    contact_kernel().foresee_bounces(s.blocks(first), last - first, s.motion.before.data(), least);
}

void start_parting(Substep& s, std::size_t, std::size_t) {
    s.motion.shifts = s.motion.movers;
    for (Mover& m : s.motion.shifts) m.vx = m.vy = m.w = 0;
}
void part(Substep& s, std::size_t first, std::size_t last) {
    contact_kernel().part(s.blocks(first), last - first, s.motion.shifts.data(), s.soft());
}
/// Moves a body without giving it velocity. To lift it is work.
void shift(Substep& s, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
        if (!moves(s.scene, static_cast<std::uint32_t>(i))) continue;
        s.state.x.linear[i] += s.h * Vec2{s.motion.shifts[i].vx, s.motion.shifts[i].vy};
        s.state.x.angular[i] += s.h * s.motion.shifts[i].w;
    }
}

void drift(Substep& s, std::size_t first, std::size_t last) { mover_kernel().drift(s.rows, s.h, first, last); }
void drift_slow_joints(Substep& s) { drift_slowly(s.scene.mechanisms, s.motion.start, s.h, s.state, s.motion); }
void kick(Substep& s, std::size_t first, std::size_t last) {
    mover_kernel().kick(s.rows, 1 - s.scene.drift_share, first, last);
}

/// Takes the velocities of the bodies that can be moved. What joints gave is not of the contacts.
void take_velocities(Substep& s, std::size_t first, std::size_t last) {
    mover_kernel().take_velocities(s.rows, first, last);
    if (s.scene.mechanisms.empty()) return;
    for (std::size_t i = first; i < last; ++i) {
        if (!s.scene.mechanisms.holds[i]) continue;
        Mover& given = s.motion.given[i];
        const Twist& by_joints = s.motion.by_joints[i];
        given.vx -= by_joints.velocity.x, given.vy -= by_joints.velocity.y, given.w -= by_joints.angular_velocity;
    }
}

void warm_first(Substep& s, std::size_t first, std::size_t last) {
    contact_kernel().warm_start(s.blocks(first), last - first, s.motion.movers.data(), s.first_share());
}
void warm_rest(Substep& s, std::size_t first, std::size_t last) {
    contact_kernel().warm_start(s.blocks(first), last - first, s.motion.movers.data(), s.rest_share());
}
template <bool begins>
void push(Substep& s, std::size_t first, std::size_t last) {
    const HalfBegin half{s.first_share(), frames(s.motion), s.h, s.preload_way(), nullptr, s.motion.gaps_fit};
    contact_kernel().solve(s.blocks(first), last - first, s.motion.movers.data(), s.soft(), begins ? &half : nullptr);
}
template <bool begins>
void relax(Substep& s, std::size_t first, std::size_t last) {
    const HalfBegin half{s.rest_share(), frames(s.motion), s.h, s.preload_way(), s.motion.leads.data(), false};
    contact_kernel().relax(s.blocks(first), last - first, s.motion.movers.data(), s.soft(), begins ? &half : nullptr);
}

template <Round round>
void hold(Substep& s) {
    hold_drift(s.scene, s.scene.mechanisms, s.h, round, s.state, s.contacts, s.desks);
}
template <Round round>
void hold_still(Substep& s) {
    hold_relax(s.scene, s.scene.mechanisms, s.h, round, s.state, s.motion, s.desks);
}
void begin_relax_joints(Substep& s) { begin_relax(s.scene, s.scene.mechanisms, s.h, s.state, s.motion, s.desks); }
/// A precise solve corrects what it begins with if that is not too far off, and is the more exact for it.
void solve_islands(Substep& s, std::size_t first, std::size_t last, bool recovers) {
    constexpr double far = 1000;
    // Where bodies are jammed not every overlap can be undone at once, and rigid contacts that ask for it throw light
    // ones about. Joints keep these together, and they give way to a load again and again.
    constexpr double slowly = 0.05, at_once = 1;
    for (std::size_t i = first; i < last; ++i) {
        Island& island = s.islands.all[i];
        const Aim aim{s.h, recovers, recovers ? s.scene.drift_share : 1, std::min(s.h, far * s.lasting),
                      island.mechanisms.empty() ? slowly : at_once};
        solve_precisely(island, s.islands, s.scene, s.motion.before, aim, s.contacts);
    }
}
void push_precisely(Substep& s, std::size_t first, std::size_t last) { solve_islands(s, first, last, true); }
void relax_precisely(Substep& s, std::size_t first, std::size_t last) { solve_islands(s, first, last, false); }

/// Books what the contacts did between two sets of velocities, with the bodies' own side of it on the method's account:
/// their work is impulse times mean velocity from the start, and the forces' kick came in between.
void book_bodies(Substep& s) {
    const Dynamics& dynamics = s.scene.flight.dynamics;
    const auto book = [&](std::size_t first, std::size_t last, Flows& account) {
        const MoverSums sums =
            mover_kernel().sum(s.rows, dynamics.mass().data(), dynamics.inertia().data(), first, last);
        account[Account::method] += sums.work;
        account[Giver::method].add({sums.momentum_x, sums.momentum_y}, sums.angular);
        for (std::size_t i = first; i < last && s.any_deep; ++i) {
            if (!moves(s.scene, static_cast<std::uint32_t>(i))) continue;
            const Vec2 lift = s.h * Vec2{s.motion.shifts[i].vx, s.motion.shifts[i].vy};
            account[Account::overlap] -= dynamics.mass()[i] * dot(dynamics.gravity(), lift);
        }
    };
    add_over_rows(sharing(s.scene.threads, s.contacts.rest.moving), s.state.size(), s.state.account,
                  [&](std::size_t from, std::size_t to, Flows& account) {
                      s.contacts.rest.moving.within(
                          from, to, [&](std::size_t first, std::size_t last) { book(first, last, account); });
                  });
    s.state.account.add(s.h, s.contacts.rest.flow);
}

/// What b got from a at a point in this substep.
Vec2 impulse_of(const ContactBlock& block, int point, std::uint32_t k) {
    const Vec2 n{block.normal_x[k], block.normal_y[k]};
    const auto& p = block.point[point];
    return p.normal_impulse[k] * n + p.tangent_impulse[k] * perpendicular(n);
}

/// What those who are driven did at a contact.
void book_driven(Substep& s, const SoftContact& c) {
    const ContactBlock& block = s.contacts.layout.blocks[c.block];
    const Mover &a = s.motion.means[c.a], &b = s.motion.means[c.b];
    const auto work = [&](Vec2 impulse, double turning, Vec2 on_a, Vec2 on_b) {
        const Twist at_a{Vec2{a.vx, a.vy} + cross(a.w, on_a), a.w}, at_b{Vec2{b.vx, b.vy} + cross(b.w, on_b), b.w};
        s.state.account[Account::driven] += work_of_driven(s.scene, c, impulse, turning, at_a, at_b);
    };
    for (int i = 0; i < c.manifold.count; ++i) {
        const Vec2 on_a = lever_a_of(block, i, c.row), on_b = lever_b_of(block, i, c.row);
        work(impulse_of(block, i, c.row), block.more[i].rolling_impulse[c.row], on_a, on_b);
    }
    const double turn = is_driven(s.scene, c.a) ? block.lag_turn_a[c.row] : block.lag_turn_b[c.row];
    work(-in_the_world(block, c.row, block.lag_along[c.row], block.lag_across[c.row]), -turn, {}, {});
}

void book_held_contacts(Substep& s) {
    struct Held {
        Wrench walls{}, all{};
        void operator+=(const Held& more) {
            walls.add(more.walls.force, more.walls.torque), all.add(more.all.force, more.all.torque);
        }
    };
    const SoftContacts& contacts = s.contacts;
    const auto ground = static_cast<std::uint32_t>(s.state.size());
    const auto [walls, all] = sum_over_rows<Held>(
        s.scene.threads, contacts.layout.blocks.size() * block_rows,
        [&](std::size_t first, std::size_t last, Held& held) {
            const HeldSums sums =
                contact_kernel().sum_held(&contacts.layout.blocks[first / block_rows], (last - first) / block_rows,
                                          contacts.motion.movers.data(), frames(contacts.motion), ground);
            const auto wrench = [](const HeldSums::Given& g) { return Wrench{{g.x, g.y}, g.moment}; };
            held += {wrench(sums.walls), wrench(sums.all)};
        });
    book_held(walls, {all.force - walls.force, all.torque - walls.torque}, s.state.account);
}

void book_contacts(Substep& s) {
    SoftContacts& contacts = s.contacts;
    const std::vector<Mover>& means = contacts.motion.means;
    Flows& account = s.state.account;
    static_assert(chunk_rows % block_rows == 0);
    const auto sums =
        sum_over_rows<ContactSums>(s.scene.threads, contacts.layout.blocks.size() * block_rows,
                                   [&](std::size_t first, std::size_t last, auto& sum) {
                                       sum += contact_kernel().settle(&contacts.layout.blocks[first / block_rows],
                                                                      (last - first) / block_rows, means.data(), s.h);
                                   });
    account[Account::impact] -= sums.landing_work;
    account[Account::parting] += sums.parting_work;
    account[Account::friction] -= sums.slip_work;
    account[Account::driven] += sums.belt_work;
    book_held_contacts(s);
    for (const std::uint32_t index : contacts.lists.driven) book_driven(s, contacts.all[index]);
    for (const std::uint32_t index : contacts.lists.unturned) {
        const SoftContact& c = contacts.all[index];
        const ContactBlock& block = contacts.layout.blocks[c.block];
        for (int i = 0; i < c.manifold.count; ++i)
            book_driven_spin(s.scene, s.state, c, {lever_a_of(block, i, c.row), lever_b_of(block, i, c.row)},
                             impulse_of(block, i, c.row), block.more[i].rolling_impulse[c.row], account);
        if (only_shifts(s.scene, c.a)) account[Account::driven] -= block.lag_turn_a[c.row] * s.state.v.angular[c.a];
        if (only_shifts(s.scene, c.b)) account[Account::driven] += block.lag_turn_b[c.row] * s.state.v.angular[c.b];
    }
}

void look_at_changing(Substep& s) {
    SoftContacts& contacts = s.contacts;
    constexpr std::size_t some = 16, few = 8;  // of so many contacts one: else what all gave is summed up anew
    const std::size_t count = contacts.lists.changing.size();
    if (few * count > contacts.all.size()) contacts.motion.given_fits = false;
    const auto contact = [&](std::size_t k) -> SoftContact& { return contacts.all[contacts.lists.changing[k]]; };
    const auto look = [&](std::size_t number) {
        std::uint32_t found = 0;
        for (std::size_t k = some * number; k < std::min(some * (number + 1), count); ++k) {
            look_again(s.scene, s.state, s.h, contact(k), contacts);
            if (rounds_a_corner(contact(k))) found |= 1U << k % some;
        }
        return found;
    };
    for (std::size_t k = 0; k < count; ++k) take_out(contact(k), s.h, contacts);
    const auto note = [&](std::size_t number, std::uint32_t k) { note_corner(contact(some * number + k), contacts); };
    each_row_where(s.scene.threads, (count + some - 1) / some, look, note, 1);
    for (std::size_t k = 0; k < count; ++k) put_in(contact(k), s.h, contacts);
}

void turn(Substep& s) { turn_levers(s.h, s.contacts); }
void note(Substep& s) { note_pressed(s.scene, s.contacts); }

void finish(Substep& s) {
    book_bodies(s);
    book_contacts(s);
    note_landings(s.scene, s.motion.proposed, s.contacts);
    s.scene.flight.memory.continues = false;
    s.motion.given_fits = s.motion.gaps_fit = true;
}

/// What a stage goes over: threads share it.
enum class Over { once, bodies, colours, islands };
struct Stage {
    Over over;
    Work work;
    void (*run)(Substep&, std::size_t first, std::size_t last);
    bool (*is_idle)(const Substep&) = [](const Substep&) { return false; };  ///< nothing is to be done in this substep
};

bool joins_nothing(const Substep& s) { return s.scene.mechanisms.empty(); }
bool holds_nobody(const Substep& s) { return !s.any_held; }
bool is_shallow(const Substep& s) { return !s.any_deep; }
bool is_given(const Substep& s) { return s.motion.given_fits; }
bool bounces_nothing(const Substep& s) { return !s.contacts.lists.any_bounce; }

template <Work work, void (*function)(Substep&)>
constexpr Stage once{Over::once, work, [](Substep& s, std::size_t, std::size_t) { function(s); }};
template <void (*function)(Substep&), bool (*is_idle)(const Substep&) = holds_nobody>
constexpr Stage for_joints{Over::once, Work::joints, [](Substep& s, std::size_t, std::size_t) { function(s); },
                           is_idle};

/// A substep. Either half: a share of the last impulses, sweeps over all joints and contacts, and precise solves where
/// they are worth it.
constexpr Stage stages[] = {
    once<Work::narrow, look_at_changing>,
    for_joints<close_joints, joins_nothing>,
    once<Work::motion, propose>,
    once<Work::impacts, strike_all>,
    {Over::bodies, Work::motion, take_drift},
    {Over::colours, Work::contacts, foresee_bounces, bounces_nothing},
    {Over::colours, Work::contacts, warm_first, is_given},
    for_joints<hold<Round::first>>,
    {Over::colours, Work::contacts, push<true>},
    for_joints<hold<Round::next>>,
    {Over::colours, Work::contacts, push<false>},
    {Over::islands, Work::precise, push_precisely},
    for_joints<hold<Round::last>>,
    once<Work::books, note>,
    {Over::once, Work::parting, start_parting, is_shallow},
    {Over::colours, Work::parting, part, is_shallow},
    {Over::colours, Work::parting, part, is_shallow},
    {Over::bodies, Work::parting, shift, is_shallow},
    {Over::bodies, Work::motion, drift},
    for_joints<drift_slow_joints>,
    {Over::bodies, Work::motion, kick},
    once<Work::narrow, turn>,
    for_joints<begin_relax_joints>,
    {Over::colours, Work::contacts, warm_rest, is_given},
    for_joints<hold_still<Round::first>>,
    {Over::colours, Work::contacts, relax<true>},
    for_joints<hold_still<Round::next>>,
    {Over::colours, Work::contacts, relax<false>},
    {Over::islands, Work::precise, relax_precisely},
    for_joints<hold_still<Round::last>>,
    {Over::bodies, Work::motion, take_velocities},
    once<Work::books, finish>,
};

void run_stage(const Stage& stage, Substep& s) {
    const auto share = [&](std::size_t count, std::size_t grain, std::size_t from = 0) {
        parallel_ranges(s.scene.threads, count, grain,
                        [&](std::size_t first, std::size_t last) { stage.run(s, from + first, from + last); });
    };
    constexpr std::size_t some_bodies = 256, some_blocks = 16;
    switch (stage.over) {
        case Over::once:
            return stage.run(s, 0, 1);
        case Over::bodies:
            return for_each_moving(
                s.scene.threads, s.contacts.rest.moving, s.state.size(),
                [&](std::size_t first, std::size_t last) { stage.run(s, first, last); }, some_bodies);
        case Over::islands:
            return share(s.islands.all.size(), 1);
        case Over::colours:
            for (const auto& colour : s.contacts.layout.colours) {
                if (!colour.alone) share(colour.count, some_blocks, colour.first);
                for (std::size_t k = 0; k < colour.count && colour.alone; ++k)
                    stage.run(s, colour.first + k, colour.first + k + 1);
            }
    }
}

/// Who meets in the next dt [s], and how that is solved.
PreciseIslands meet(const SoftScene& scene, State& state, double dt, double h, SoftContacts& contacts) {
    Scratch<std::uint32_t> first_of_island;
    find_contacts(scene, state, dt, h, contacts);
    while (contacts.rest.is_known && reach_sleepers(contacts)) {
        rouse(scene, state, contacts);
        find_contacts(scene, state, dt, h, contacts);
    }
    if (contacts.rest.is_known && contacts.rest.moving.empty()) return {};  // all sleep on
    {
        const Timed timed(scene.profile, Work::sleep);
        first_of_island = firsts_of_islands(scene, contacts);
        find_standing(scene, first_of_island, dt, h, state, contacts);
        let_sleep(scene, first_of_island, state, contacts);
    }
    const Timed timed(scene.profile, Work::order);
    note_gentle(scene, state, h, first_of_island, contacts);
    note_pivots(scene, state, contacts);
    arrange(scene, h, 0, contacts);
    const PreciseIslands islands = find_precise_islands(scene, first_of_island, contacts);
    note_precise(islands, contacts);
    return islands;
}

/// Contacts give way as in the longest substep of late: in a short one among long ones they would be stiff at once, and
/// throw apart what leans on one another as deep as the long ones let it.
void note_pace(double h, double dt, Pace& pace) {
    constexpr double forgotten = 0.05;  // s
    pace.slow = std::max(h, pace.slow / (1 + dt / forgotten));
    pace.softer = pace.slow / h;
}

/// For how long forces may begin as in the substep before, if this is a new step: the rest of a velocity that was
/// stopped in a short one is a great force there, and would be a blow for as long as a long one lasts.
double longest_share(const Pace& pace) { return pace.lasted > 0 ? 2 * pace.lasted : HUGE_VAL; }

}  // namespace

void advance(const SoftScene& scene, State& state, double dt, SoftContacts& contacts) {
    contacts.rest.resize(state.size());
    earn(scene, contacts);
    contacts.motion.given.resize(state.size() + 1);
    place_movers(scene.threads, state, scene.bodies, contacts);
    contacts.outlook.midway = false;
    double h = dt / scene.substeps;
    note_pace(h, dt, contacts.pace);
    PreciseIslands islands = meet(scene, state, dt, h, contacts);
    const int substeps = scene.substeps * more_substeps(scene, state, h, islands, contacts);
    h = dt / substeps;
    Substep substep{scene, state, contacts, islands, h, h * contacts.pace.softer};
    substep.any_deep = any_deep(contacts);
    for (int i = 0; i < substeps; ++i) {
        if (i > 0) {
            const Timed timed(scene.profile, Work::pairs);
            const std::size_t before = contacts.all.size();
            const bool is_new =
                is_time_over(state, h, contacts.outlook) || !take_in(scene, state, h, islands, contacts);
            if (is_new) {
                leave_given_up(islands, contacts), keep_warm(scene, state, 0, contacts);
                contacts.outlook.midway = true;
                islands = meet(scene, state, dt - i * h, h, contacts);
            }
            substep.any_deep = is_new ? any_deep(contacts) : substep.any_deep || any_deep(contacts, before);
        }
        constexpr int most_cuts = 15;
        double left = h;
        for (int cuts = 0; left > 0; left -= substep.h) {
            double next = cut_by_turns(scene, state, left, h);
            if (cuts < most_cuts) {
                const double cut =
                    std::min(until_strike(scene, state, contacts, next),
                             await_change(islands, scene, state, contacts, next, left / (most_cuts - cuts)));
                cuts += cut < next, next = cut;
            }
            if (next != substep.h) contacts.motion.given_fits = false;  // that is of a substep as long
            substep.lasting = std::min(next, i == 0 && left == h ? longest_share(contacts.pace) : substep.h);
            substep.h = contacts.pace.lasted = next;
            for (const Stage& stage : stages) {
                if (stage.is_idle(substep)) continue;
                const Timed timed(scene.profile, stage.work);
                run_stage(stage, substep);
            }
        }
    }
    const Timed timed(scene.profile, Work::sleep);
    note_reactions(scene, scene.mechanisms);
    rest_jammed(islands, contacts);
    keep_warm(scene, state, dt, contacts);
    note_rest(scene, state, dt, contacts.rest);
    stir_parted(scene, h, contacts);
}

}  // namespace carom
