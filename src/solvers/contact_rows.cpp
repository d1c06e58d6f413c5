// A contact as the solver sees it: how stiff it is, and its row in a block.

#include <algorithm>

#include "solvers/soft_step.hpp"

namespace carom {

namespace {

constexpr double pi = 3.14159265358979323846;

/// Stiffness is tied to the substep, so that overlap falls with its square: this is ω h. Sweeps that carry on from the
/// forces before make a long chain of contacts a feedback loop, which is stable while (ω h)² is well below the number
/// of sweeps in a substep (docs/theory/softstep.md).
constexpr double frequency = 0.16 * 2 * pi;

/// Sizes in a second by which overlap is undone at most.
constexpr double recovery = 0.5;
/// A contact is a spring down to an overlap of so many sizes and so many times what its load explains. A spring gives
/// velocity, and what sweeps do not take back of that adds up in a crowd: what is deeper is shifted apart, by so much
/// of the excess in a substep.
constexpr double shallow = 0.01, explained = 1.3, shifted = 0.2;

}  // namespace

Softness softness(double h) {
    const double omega = frequency / h, damping_ratio = 10;
    const double a1 = 2 * damping_ratio + h * omega, a2 = h * omega * a1, a3 = 1 / (1 + a2);
    return {1 / h, omega / a1, a2 * a3, a3, explained / (omega * omega), shifted / h};
}

void book_held(const Wrench& from_walls, const Wrench& from_bodies, Flows& account) {
    account[Giver::walls].add(from_walls.force, from_walls.torque);
    account[Giver::held].add(from_bodies.force, from_bodies.torque);
    account[Giver::method].add(-(from_walls.force + from_bodies.force), -(from_walls.torque + from_bodies.torque));
}

void book_held(const SoftScene& scene, const SoftContact& c, Vec2 point, Vec2 impulse, double angular_impulse,
               const Twist& a, const Twist& b, Flows& account) {
    Wrench from_walls{}, from_bodies{};
    const auto give = [&](std::uint32_t row, double sign) {
        if (moves(scene, row)) return;
        const Vec2 J = sign * impulse;
        (c.at_wall ? from_walls : from_bodies).add(J, cross(point, J) + sign * angular_impulse);
    };
    give(c.a, 1), give(c.b, -1);
    book_held(from_walls, from_bodies, account);
    account[Account::driven] += work_of_driven(scene, c, impulse, angular_impulse, a, b);
}

bool only_shifts(const SoftScene& scene, std::uint32_t row) {
    return moves(scene, row) && scene.bodies.inverse_inertia[row] == 0;
}

void book_driven_spin(const SoftScene& scene, const State& state, const SoftContact& c,
                      const std::array<Vec2, 2>& lever, Vec2 impulse, double angular_impulse, Flows& account) {
    const double turns[] = {-cross(lever[0], impulse) - angular_impulse, cross(lever[1], impulse) + angular_impulse};
    if (only_shifts(scene, c.a)) account[Account::driven] -= turns[0] * state.v.angular[c.a];
    if (only_shifts(scene, c.b)) account[Account::driven] -= turns[1] * state.v.angular[c.b];
}

void fill_row(const SoftScene& scene, const SoftContact& c, const Frame& frame_a, const Frame& frame_b,
              SoftContacts& contacts) {
    ContactBlock& block = contacts.blocks[c.block];
    const std::uint32_t k = c.row;
    const auto inverse_inertia = [&](std::uint32_t row) {
        return row < scene.bodies.size() ? scene.bodies.inverse_inertia[row] : 0;
    };
    const Vec2 n = c.manifold.normal, t = perpendicular(n);
    block.a[k] = c.a, block.b[k] = c.b;
    block.normal_x[k] = n.x, block.normal_y[k] = n.y;
    const double ima = contacts.movers[c.a].inverse_mass, imb = contacts.movers[c.b].inverse_mass;
    const double iia = block.inverse_inertia_a[k] = inverse_inertia(c.a);
    const double iib = block.inverse_inertia_b[k] = inverse_inertia(c.b);
    block.friction[k] = c.friction, block.surface_speed[k] = c.surface_speed;
    block.restitution[k] = c.crowded && !c.rests ? c.restitution : 0;
    block.rolling[k] = c.rolling, block.rolling_mass[k] = iia + iib > 0 ? 1 / (iia + iib) : 0;
    block.recovery[k] = recovery * c.size, block.shallow[k] = shallow * c.size;
    block.radii[k] = c.radius_a + c.radius_b;
    block.corners[k] = rounds_a_corner(c) ? 1 : 0;
    const Vec2 between = frame_b.position - frame_a.position;
    const double along = block.between_along[k] = dot(between, n);
    const double across = block.between_across[k] = dot(between, t);
    for (int i = 0; i < static_cast<int>(block.points); ++i) {
        auto& p = block.point[i];
        auto& more = block.more[i];
        more.open[k] = i < c.manifold.count ? 0 : 1;
        if (i >= c.manifold.count) continue;
        const ManifoldPoint& m = c.manifold.point[i];
        const Vec2 core_a = core_a_of(c.at_wall, c.manifold, i, between);
        const Vec2 lever_a = levers(c, c.manifold, i, between)[0];
        const Vec2 local_a = frame_a.turn_back(core_a), local_b = frame_b.turn_back(m.core_b);
        more.core_a_x[k] = local_a.x, more.core_a_y[k] = local_a.y;
        more.core_b_x[k] = local_b.x, more.core_b_y[k] = local_b.y;
        const double a_along = p.lever_a_along[k] = dot(lever_a, n);
        const double a_across = p.lever_a_across[k] = dot(lever_a, t);
        const auto mass = [&](double arm_a, double arm_b) {
            return 1 / (ima + imb + iia * arm_a * arm_a + iib * arm_b * arm_b);
        };
        p.normal_mass[k] = mass(a_across, a_across - across), p.tangent_mass[k] = mass(a_along, a_along - along);
        more.normal_force[k] = c.normal_force[i], more.tangent_force[k] = c.tangent_force[i];
        more.rolling_moment[k] = c.rolling_moment[i];
        more.turned_normal[k] = more.turned_tangent[k] = 0;
    }
}

namespace {

/// Adds what a contact's forces give its two bodies in so much time [s] to what all gave them, if that serves at all.
void add_given(const SoftContact& c, double time, SoftContacts& contacts) {
    if (!contacts.given_fits) return;
    const ContactBlock& block = contacts.blocks[c.block];
    const std::uint32_t k = c.row;
    const Vec2 n{block.normal_x[k], block.normal_y[k]};
    const auto add = [&](std::uint32_t row, double inverse_inertia, Vec2 lever, Vec2 impulse, double turn) {
        Mover& given = contacts.given[row];
        const double inverse_mass = contacts.movers[row].inverse_mass;
        given.vx += inverse_mass * impulse.x, given.vy += inverse_mass * impulse.y;
        given.w += inverse_inertia * (cross(lever, impulse) + turn);
    };
    for (int i = 0; i < static_cast<int>(block.points); ++i) {
        const auto& p = block.more[i];
        const Vec2 impulse = time * (p.normal_force[k] * n + p.tangent_force[k] * perpendicular(n));
        const double turn = time * p.rolling_moment[k];
        add(c.a, block.inverse_inertia_a[k], lever_a_of(block, i, k), -impulse, -turn);
        add(c.b, block.inverse_inertia_b[k], lever_b_of(block, i, k), impulse, turn);
    }
}

}  // namespace

void take_out(const SoftContact& c, double h, SoftContacts& contacts) { add_given(c, -h, contacts); }

void put_in(const SoftContact& c, double h, SoftContacts& contacts) {
    add_given(c, h, contacts);
    contacts.blocks[c.block].is_measured = false;
}

double overlap_under_weight(const SoftScene& scene, double h) {
    return length(scene.flight.dynamics.gravity()) * h * h / (frequency * frequency);
}

Load load_of(const SoftScene& scene, const SoftContact& c, const SoftContacts& contacts, double h) {
    constexpr double nowhere = HUGE_VAL;
    const double stiffness = frequency * frequency / (h * h);  // of a unit of effective mass
    const double lighter = std::max(contacts.movers[c.a].inverse_mass, contacts.movers[c.b].inverse_mass);
    const double weight = length(scene.flight.dynamics.gravity()) / lighter;
    if (c.touched_before && !c.rests) return {0, nowhere};  // an impact
    Load load{0, c.touched_before ? -nowhere : least_gap(c.manifold)};
    const ContactBlock& block = contacts.blocks[c.block];
    for (int i = 0; i < c.manifold.count; ++i) {
        const double force = c.touched_before ? block.more[i].normal_force[c.row] : weight;
        load.overlap = std::max(load.overlap, force / (stiffness * block.point[i].normal_mass[c.row]));
    }
    return load;
}

bool is_deep(const SoftContact& c) { return least_gap(c.manifold) < -shallow * c.size; }

bool any_deep(const SoftContacts& contacts, std::size_t first) {
    return std::any_of(contacts.all.begin() + static_cast<std::ptrdiff_t>(first), contacts.all.end(),
                       [](const SoftContact& c) { return c.is_deep; });
}

}  // namespace carom
