#include "solvers/soft_step.hpp"

#include <algorithm>

#include "forces/gains.hpp"
#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"

namespace carom {

namespace {

constexpr double pi = 3.14159265358979323846;

/// Stiffness is tied to the substep, so that overlap falls with its square: this is ω h. Sweeps that carry on from the
/// forces before make a long chain of contacts a feedback loop, which is stable while (ω h)² is well below the number
/// of sweeps in a substep (docs/theory/softstep.md).
constexpr double frequency = 0.16 * 2 * pi;
constexpr int sweeps = 2;  ///< in either half of a substep

Softness softness(double h) {
    const double omega = frequency / h, damping_ratio = 10;
    const double a1 = 2 * damping_ratio + h * omega, a2 = h * omega * a1, a3 = 1 / (1 + a2);
    return {1 / h, omega / a1, a2 * a3, a3};
}

void place_movers(const State& state, const Bodies& bodies, std::vector<Mover>& movers) {
    movers.assign(state.size() + 1, {});
    for (std::size_t i = 0; i < state.size(); ++i) {
        place(movers[i], state.x.linear[i], state.x.angular[i]);
        movers[i].inverse_mass = bodies.inverse_mass[i];
    }
    place(movers.back(), {}, 0);  // the ground
}

}  // namespace

Frame frame_of(const Mover& m) { return {{m.x, m.y}, m.cosine, m.sine}; }

void place(Mover& m, Vec2 x, double angle) {
    const Frame frame = frame_at(x, angle);
    m.x = x.x, m.y = x.y, m.cosine = frame.cosine, m.sine = frame.sine;
}

bool moves(const SoftScene& scene, std::uint32_t row) {
    return row < scene.bodies.size() && scene.bodies.inverse_mass[row] != 0;
}

void book_held(const SoftScene& scene, const SoftContact& c, Vec2 point, Vec2 impulse, double angular_impulse,
               const Twist& a, const Twist& b, Flows& account) {
    const Giver giver = c.at_wall ? Giver::walls : Giver::held;
    const auto give = [&](double sign, const Twist& twist) {
        const Vec2 J = sign * impulse;
        const double L = cross(point, J) + sign * angular_impulse;
        account[giver].add(J, L);
        account[Giver::method].add(-J, -L);
        account[Account::driven] += dot(J, twist.velocity) + sign * angular_impulse * twist.angular_velocity;
    };
    if (!moves(scene, c.a)) give(1, a);
    if (!moves(scene, c.b)) give(-1, b);
}

void fill_row(const SoftScene& scene, const SoftContact& c, SoftContacts& contacts) {
    ContactBlock& block = contacts.blocks[c.block];
    const std::uint32_t k = c.row;
    const Mover &a = contacts.movers[c.a], &b = contacts.movers[c.b];
    const Frame frame_a = frame_of(a), frame_b = frame_of(b);
    const auto inverse_inertia = [&](std::uint32_t row) {
        return row < scene.bodies.size() ? scene.bodies.inverse_inertia[row] : 0;
    };
    const Vec2 n = c.manifold.normal, t = perpendicular(n);
    block.a[k] = c.a, block.b[k] = c.b;
    block.normal_x[k] = n.x, block.normal_y[k] = n.y;
    const double ima = block.inverse_mass_a[k] = a.inverse_mass, imb = block.inverse_mass_b[k] = b.inverse_mass;
    const double iia = block.inverse_inertia_a[k] = inverse_inertia(c.a);
    const double iib = block.inverse_inertia_b[k] = inverse_inertia(c.b);
    block.friction[k] = c.friction, block.surface_speed[k] = c.surface_speed;
    block.rolling[k] = c.rolling, block.rolling_mass[k] = iia + iib > 0 ? 1 / (iia + iib) : 0;
    block.any_rolling |= c.rolling > 0;
    block.recovery[k] = 0.5 * c.size;  // in a second
    block.radii[k] = c.radius_a + c.radius_b;
    const Vec2 between = frame_b.position - frame_a.position;
    for (int i = 0; i < 2; ++i) {
        auto& p = block.point[i];
        p.open[k] = i < c.manifold.count ? 0 : 1;
        if (i >= c.manifold.count) continue;
        const ManifoldPoint& m = c.manifold.point[i];
        const Vec2 core_a = core_a_of(c, c.manifold, i, between);
        const auto [lever_a, lever_b] = levers(c, c.manifold, i, between);
        const Vec2 local_a = frame_a.turn_back(core_a), local_b = frame_b.turn_back(m.core_b);
        p.core_a_x[k] = local_a.x, p.core_a_y[k] = local_a.y;
        p.core_b_x[k] = local_b.x, p.core_b_y[k] = local_b.y;
        p.lever_a_x[k] = lever_a.x, p.lever_a_y[k] = lever_a.y;
        p.lever_b_x[k] = lever_b.x, p.lever_b_y[k] = lever_b.y;
        const auto mass = [&, a = lever_a, b = lever_b](Vec2 along) {  // clang 14 captures no binding
            const double ra = cross(a, along), rb = cross(b, along);
            return 1 / (ima + imb + iia * ra * ra + iib * rb * rb);
        };
        p.normal_mass[k] = mass(n), p.tangent_mass[k] = mass(t);
        p.normal_force[k] = c.normal_force[i], p.tangent_force[k] = c.tangent_force[i];
        p.rolling_moment[k] = c.rolling_moment[i];
    }
}

double gap_of(const ContactBlock& block, const ContactBlock::Point& p, std::uint32_t k, const Mover& a,
              const Mover& b) {
    const Frame frame_a = frame_of(a), frame_b = frame_of(b);
    const Vec2 between = (frame_b.position - frame_a.position) + frame_b.turn({p.core_b_x[k], p.core_b_y[k]}) -
                         frame_a.turn({p.core_a_x[k], p.core_a_y[k]});
    return dot(between, {block.normal_x[k], block.normal_y[k]}) - block.radii[k];
}

bool presses_deep(const SoftContact& c, const SoftContacts& contacts, double h, double part) {
    const double stiffness = frequency * frequency / (h * h);  // of a unit of effective mass
    const ContactBlock& block = contacts.blocks[c.block];
    const bool bears = c.rests && c.touched_before;  // no impact
    return bears && std::any_of(block.point, block.point + c.manifold.count, [&](const auto& p) {
               return p.normal_force[c.row] > part * c.size * stiffness * p.normal_mass[c.row];
           });
}

namespace {

/// Velocities that carry the bodies from x to where the integrator put them, in `movers`.
void take_drift(const State& start, const State& end, double h, std::vector<Mover>& movers) {
    for (std::size_t i = 0; i < start.size(); ++i) {
        Mover& m = movers[i];
        const Vec2 v = (1 / h) * (end.x.linear[i] - start.x.linear[i]);
        m.vx = v.x, m.vy = v.y;
        m.w = (1 / h) * (end.x.angular[i] - start.x.angular[i]);
    }
}

/// Moves on those whose velocities the solver changed; the others are where the integrator put them.
void drift(double h, const std::vector<Mover>& before, State& end, std::vector<Mover>& movers) {
    for (std::size_t i = 0; i < end.size(); ++i) {
        const Vec2 dv{movers[i].vx - before[i].vx, movers[i].vy - before[i].vy};
        end.x.linear[i] += h * dv;
        end.x.angular[i] += h * (movers[i].w - before[i].w);
        place(movers[i], end.x.linear[i], end.x.angular[i]);
    }
}

/// The rest of the kick: the velocities at the end, with what the solver changed. Those of free bodies stay as they
/// are.
void kick(const std::vector<Mover>& before, const State& end, std::vector<Mover>& movers) {
    for (std::size_t i = 0; i < end.size(); ++i) {
        Mover& m = movers[i];
        m.vx = end.v.linear[i].x + (m.vx - before[i].vx), m.vy = end.v.linear[i].y + (m.vy - before[i].vy);
        m.w = end.v.angular[i] + (m.w - before[i].w);
    }
}

void take_velocities(const Motion& v, std::vector<Mover>& movers) {
    for (std::size_t i = 0; i < v.size(); ++i)
        movers[i].vx = v.linear[i].x, movers[i].vy = v.linear[i].y, movers[i].w = v.angular[i];
}

template <class Sweep>
void each_colour(SoftContacts& contacts, Sweep sweep) {
    for (const auto& colour : contacts.colours) sweep(contacts.blocks.data() + colour.first, colour.count);
}

void clear_impulses(SoftContacts& contacts) {
    for (ContactBlock& block : contacts.blocks)
        for (auto& p : block.point)
            for (std::size_t k = 0; k < block_rows; ++k)
                p.normal_impulse[k] = p.tangent_impulse[k] = p.rolling_impulse[k] = 0;
}
void keep_forces(double h, SoftContacts& contacts) {
    for (ContactBlock& block : contacts.blocks)
        for (auto& p : block.point)
            for (std::size_t k = 0; k < block_rows; ++k) {
                p.normal_force[k] = p.normal_impulse[k] / h, p.tangent_force[k] = p.tangent_impulse[k] / h;
                p.rolling_moment[k] = p.rolling_impulse[k] / h;
            }
}

/// Books what the contacts did between two sets of velocities, with the bodies' own side of it on the method's account.
void book(const SoftScene& scene, const State& start, const State& proposed, const State& end,
          const std::vector<Mover>& before, SoftContacts& contacts, Flows& account) {
    const Bodies& bodies = scene.bodies;
    Gains gains(scene.flight.dynamics);
    for (std::size_t i = 0; i < end.size(); ++i) {
        if (bodies.inverse_mass[i] == 0) continue;
        const Vec2 v = proposed.v.linear[i], dv = end.v.linear[i] - v;
        const double w = proposed.v.angular[i], dw = end.v.angular[i] - w;
        // The contacts' work is impulse times mean velocity from the start; the forces' kick came in between.
        account[Account::method] += 0.5 * bodies.mass[i] * dot(dv, v - start.v.linear[i]) +
                                    0.5 * bodies.inertia[i] * dw * (w - start.v.angular[i]);
        gains.add(i, proposed.x.linear[i], v, w, end.x.linear[i] - proposed.x.linear[i], dv, dw);
    }
    account[Giver::method].add(gains.momentum().force, gains.momentum().torque);
    const auto& movers = contacts.movers;
    const ContactSums sums =
        contact_kernel().work(contacts.blocks.data(), contacts.blocks.size(), before.data(), movers.data());
    account[Account::impact] -= sums.normal_work;
    account[Account::friction] -= sums.slip_work;
    account[Account::driven] += sums.belt_work;
    for (const SoftContact& c : contacts.all) {
        const ContactBlock& block = contacts.blocks[c.block];
        const std::uint32_t k = c.row;
        if (block.inverse_mass_a[k] != 0 && block.inverse_mass_b[k] != 0) continue;
        for (int i = 0; i < c.manifold.count; ++i) {
            const auto& p = block.point[i];
            const Vec2 n{block.normal_x[k], block.normal_y[k]};
            const Vec2 lever_a{p.lever_a_x[k], p.lever_a_y[k]}, lever_b{p.lever_b_x[k], p.lever_b_y[k]};
            const auto mean = [&](std::uint32_t row, Vec2 lever) {
                const Mover &first = before[row], &last = movers[row];
                const double w = 0.5 * (first.w + last.w);
                return Twist{0.5 * Vec2{first.vx + last.vx, first.vy + last.vy} + cross(w, lever), w};
            };
            const bool a_is_held = block.inverse_mass_a[k] == 0;
            const Vec2 point =
                a_is_held ? Vec2{movers[c.b].x, movers[c.b].y} + lever_b : Vec2{movers[c.a].x, movers[c.a].y} + lever_a;
            book_held(scene, c, point, p.normal_impulse[k] * n + p.tangent_impulse[k] * perpendicular(n),
                      p.rolling_impulse[k], mean(c.a, lever_a), mean(c.b, lever_b), account);
        }
    }
}

/// Takes the velocities of the bodies that can be moved.
void take_velocities(const Bodies& bodies, const std::vector<Mover>& movers, State& state) {
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (bodies.inverse_mass[i] == 0) continue;
        state.v.linear[i] = {movers[i].vx, movers[i].vy};
        state.v.angular[i] = movers[i].w;
    }
}

void hold_joints(const SoftScene& scene, const Aim& aim, bool last, SoftContacts& contacts) {
    if (aim.recovers)
        hold_drift(scene, scene.mechanisms, aim.h, last, contacts);
    else
        hold_relax(scene, scene.mechanisms, aim.h, last, contacts);
}

/// A share of the last substep's impulses and sweeps over all contacts, and precise solves where they are worth it.
void solve_contacts(const SoftScene& scene, const std::vector<Mover>& free, const Aim& aim, PreciseIslands& islands,
                    SoftContacts& contacts) {
    const ContactKernel& kernel = contact_kernel();
    const Softness soft = softness(aim.h);
    Mover* movers = contacts.movers.data();
    each_colour(contacts,
                [&](auto* blocks, std::size_t n) { kernel.warm_start(blocks, n, movers, aim.share * aim.h); });
    for (int i = 0; i < sweeps; ++i) {
        hold_joints(scene, aim, false, contacts);
        each_colour(contacts, [&](auto* blocks, std::size_t n) {
            (aim.recovers ? kernel.solve : kernel.relax)(blocks, n, movers, soft);
        });
    }
    for (Island& island : islands.all)
        solve_precisely(island, islands, scene, free, {aim.h, aim.recovers, aim.recovers ? aim.share : 1}, contacts);
    hold_joints(scene, aim, true, contacts);
}

/// Takes a contact's forces from where it was solved.
void take_forces(const SoftContacts& contacts, SoftContact& c) {
    for (int i = 0; i < c.manifold.count; ++i) {
        const auto& p = contacts.blocks[c.block].point[i];
        c.normal_force[i] = p.normal_force[c.row], c.tangent_force[i] = p.tangent_force[c.row];
        c.rolling_moment[i] = p.rolling_moment[c.row];
    }
}

WarmContact warm_of(const SoftContact& c) {
    WarmContact warm{.key = c.key, .touched = c.touched, .touched_before = c.touched_before, .jammed = c.jammed};
    for (int i = 0; i < c.manifold.count; ++i) {
        if (c.normal_force[i] == 0) continue;
        warm.id[warm.count] = c.manifold.point[i].id;
        warm.normal_force[warm.count] = c.normal_force[i];
        warm.tangent_force[warm.count] = c.tangent_force[i];
        warm.rolling_moment[warm.count] = c.rolling_moment[i];
        ++warm.count;
    }
    return warm;
}

/// The manifolds of those that move far in a substep, for the movers as they are.
void look_again(const SoftScene& scene, SoftContacts& contacts) {
    for (SoftContact& c : contacts.all) {
        if (!c.fast) continue;
        take_forces(contacts, c);
        const WarmContact kept = warm_of(c);
        constexpr double anywhere = 1e300;
        c.manifold = look(scene, c, frame_of(contacts.movers[c.a]), frame_of(contacts.movers[c.b]), anywhere);
        remember(c, kept);
        fill_row(scene, c, contacts);
    }
}

void substep(const SoftScene& scene, State& state, double h, PreciseIslands& islands, SoftContacts& contacts) {
    auto& movers = contacts.movers;
    look_again(scene, contacts);
    put_right(scene, scene.mechanisms, h, state, contacts);
    State start = state;
    scene.flight.propose(state, h);
    strike(scene, start, state, h, contacts);
    const State proposed = state;
    hold_sleepers(contacts, start, state);
    take_drift(start, state, h, movers);
    std::vector<Mover> before = movers;
    clear_impulses(contacts);
    solve_contacts(scene, before, {h, true, scene.drift_share}, islands, contacts);
    note_pressed(contacts);
    drift(h, before, state, movers);
    drift_slowly(scene, scene.mechanisms, start, h, state, contacts);
    kick(before, state, movers);
    take_velocities(proposed.v, before);
    begin_relax(scene, scene.mechanisms, state, contacts);
    solve_contacts(scene, before, {h, false, 1 - scene.drift_share}, islands, contacts);
    take_velocities(scene.bodies, movers, state);
    take_velocities(start.v, before);
    book(scene, start, proposed, state, before, contacts, state.account);
    book_joints(scene, scene.mechanisms, h, before, state, state.account, contacts);
    note_landings(scene, proposed, contacts);
    keep_forces(h, contacts);
    scene.flight.memory.continues = false;
}

/// Islands that were not solved are left to sweeps for a while: to change between the two in every step would shake
/// them.
void rest_jammed(const PreciseIslands& islands, SoftContacts& contacts) {
    constexpr std::uint16_t steps = 600;
    for (SoftContact& c : contacts.all)
        if (c.jammed > 0) --c.jammed;
    for (const Island& island : islands.all)
        for (const std::uint32_t index : island.contacts)
            if (island.gave_up) contacts.all[index].jammed = steps;
}

void keep_warm(SoftContacts& contacts) {
    contacts.warm.clear();
    const auto keep = [&](const SoftContact& c) {
        if (const WarmContact warm = warm_of(c); warm.count > 0 || c.touched) contacts.warm.push_back(warm);
    };
    auto resting = contacts.resting.begin();
    for (SoftContact& c : contacts.all) {
        for (; resting != contacts.resting.end() && resting->key < c.key; ++resting) keep(*resting);
        take_forces(contacts, c);
        keep(c);
    }
    std::for_each(resting, contacts.resting.end(), keep);
}

/// Who meets in the next dt [s], and how that is solved.
PreciseIslands meet(const SoftScene& scene, State& state, double dt, double h, SoftContacts& contacts) {
    find_contacts(scene, state, dt, contacts);
    let_sleep(scene, state, contacts);
    colour_contacts(scene, contacts);
    for (const SoftContact& c : contacts.all) fill_row(scene, c, contacts);
    note_touched(contacts, scene.mechanisms);
    return find_precise_islands(scene, h, contacts);
}

/// By what the number of substeps is multiplied, so that loads do not press deep in substeps of h [s].
int more_substeps(double h, const PreciseIslands& islands, const SoftContacts& contacts) {
    const auto any_deeper = [&](double part, int times) {
        return std::any_of(contacts.all.begin(), contacts.all.end(), [&](const SoftContact& c) {
            return !islands.hold(c) && presses_deep(c, contacts, h / times, part);
        });
    };
    if (!any_deeper(1e-3, 1)) return 1;
    constexpr double bearable = 1e-2;  // to avoid a thousandth would cost a high pile eight times the time
    return !any_deeper(bearable, 2) ? 2 : !any_deeper(bearable, 4) ? 4 : 8;
}

}  // namespace

void advance(const SoftScene& scene, State& state, double dt, SoftContacts& contacts) {
    contacts.bounces.clear(), contacts.landings.clear(), contacts.sleeps.clear(), contacts.wakes.clear();
    contacts.still.resize(state.size()), contacts.asleep.resize(state.size());
    place_movers(state, scene.bodies, contacts.movers);
    contacts.midway = false;
    double h = dt / scene.substeps;
    PreciseIslands islands = meet(scene, state, dt, h, contacts);
    const int substeps = scene.substeps * more_substeps(h, islands, contacts);
    h = dt / substeps;
    for (int i = 0; i < substeps; ++i) {
        if (i > 0 && any_outruns(scene, state, h, contacts)) {
            keep_warm(contacts);
            contacts.midway = true;
            islands = meet(scene, state, dt - i * h, h, contacts);
        }
        substep(scene, state, h, islands, contacts);
    }
    book_resting(scene, state, dt, contacts, state.account);
    book_resting(scene, scene.mechanisms, dt, contacts, state.account);
    rest_jammed(islands, contacts);
    keep_warm(contacts);
    note_rest(scene, state, dt, contacts);
}

}  // namespace carom
