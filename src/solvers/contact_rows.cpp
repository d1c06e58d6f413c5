// A contact as the solver sees it: how stiff it is, and its row in a block.

#include <algorithm>
#include <cstddef>

#include "solvers/soft_step.hpp"
// After what names an `any` of its own.
#include "solvers/row_text.hpp"

namespace carom {

namespace {

constexpr double pi = 3.14159265358979323846;

/// Stiffness is tied to the substep, so that overlap falls with its square: this is ω h. Sweeps that carry on from the
/// forces before make a long chain of contacts a feedback loop, which is stable while (ω h)² is well below the number
/// of sweeps in a substep (docs/theory/softstep.md).
constexpr double frequency = 0.16 * 2 * pi;

/// A contact is a spring down to `shallow_size` and so many times what its load explains. A spring gives velocity, and
/// what sweeps do not take back of that adds up in a crowd: what is deeper is shifted apart, by so much of the excess
/// in a substep.
constexpr double explained = 1.3, shifted = 0.2;

}  // namespace

double stiffness(double h) { return frequency * frequency / (h * h); }

Softness softness(double h, double as_in) {
    const double omega = frequency / as_in, damping_ratio = 10;
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

void book_driven_spin(const SoftScene& scene, const State& state, const SoftContact& c,
                      const std::array<Vec2, 2>& lever, Vec2 impulse, double angular_impulse, Flows& account) {
    const double turns[] = {-cross(lever[0], impulse) - angular_impulse, cross(lever[1], impulse) + angular_impulse};
    if (only_shifts(scene, c.a)) account[Account::driven] -= turns[0] * state.v.angular[c.a];
    if (only_shifts(scene, c.b)) account[Account::driven] -= turns[1] * state.v.angular[c.b];
}

namespace {

/// A contact by itself, for bodies in these frames.
struct RowToWrite {
    using Number = double;

    RowSource from;
    const SoftContact& contact;
    const Frame &at_a, &at_b;
    ContactBlock& block;

    const double* field(size_t which) const { return reinterpret_cast<const double*>(&contact) + which; }
    double number(size_t which) const { return *field(which); }
    Single4 four(size_t which) const { return {field(which)[0], field(which)[1], field(which)[2], field(which)[3]}; }
    static Single4 four_of(const Frame& f) { return {f.position.x, f.position.y, f.cosine, f.sine}; }
    Single4 frame_a() const { return four_of(at_a); }
    Single4 frame_b() const { return four_of(at_b); }
    double inverse_mass() const { return from.movers[contact.a].inverse_mass + from.movers[contact.b].inverse_mass; }
    double inverse_inertia(std::uint32_t row) const { return row < from.bodies ? from.inverse_inertia[row] : 0; }
    double inverse_inertia_a() const { return inverse_inertia(contact.a); }
    double inverse_inertia_b() const { return inverse_inertia(contact.b); }
    bool has_point(std::uint32_t i) const { return static_cast<int>(i) < contact.manifold.count; }
    /// A point that there is no more may have left its forces there.
    static bool is_blank() { return false; }
    bool is_at_wall() const { return contact.at_wall; }
    bool is_let_bounce() const { return carom::is_let_bounce(contact); }
    bool rounds_a_corner() const { return carom::rounds_a_corner(contact); }
    bool follows_corner() const { return carom::follows_corner(contact); }
    void put(double* numbers, double value) const { numbers[contact.row] = value; }
};

constexpr std::size_t in_numbers(std::size_t bytes) { return bytes / sizeof(double); }
constexpr ContactFields contact_fields{
    in_numbers(sizeof(SoftContact)),
    in_numbers(offsetof(SoftContact, size)),
    in_numbers(offsetof(SoftContact, friction)),
    in_numbers(offsetof(SoftContact, radius_b)),
    in_numbers(offsetof(SoftContact, manifold) + offsetof(Manifold, point)),
    in_numbers(sizeof(ManifoldPoint)),
    in_numbers(offsetof(SoftContact, normal_force)),
    in_numbers(offsetof(SoftContact, tangent_force)),
    in_numbers(offsetof(SoftContact, rolling_moment)),
    in_numbers(offsetof(SoftContact, preload)),
};
static_assert(contact_fields.length % 4 == 0 &&
              contact_fields.radius_b + 1 == in_numbers(offsetof(SoftContact, manifold) + offsetof(Manifold, normal)));

}  // namespace

const double* frames(const BodyMotion& motion) {
    static_assert(sizeof(Frame) == 4 * sizeof(double));
    return &motion.frames[0].position.x;
}

RowSource row_source(const Bodies& bodies, const SoftContacts& contacts) {
    return {reinterpret_cast<const double*>(contacts.all.data()),
            contact_fields,
            frames(contacts.motion),
            contacts.motion.movers.data(),
            bodies.inverse_inertia.data(),
            bodies.size()};
}

void note_row(const SoftContact& c, RowKinds& kinds) {
    for (int i = 0; i < 2; ++i) note_bit(kinds.has_point[i], c.row, i < c.manifold.count);
    note_bit(kinds.is_at_wall, c.row, c.at_wall), note_bit(kinds.is_let_bounce, c.row, is_let_bounce(c));
    note_bit(kinds.rounds_a_corner, c.row, rounds_a_corner(c));
    note_bit(kinds.follows_corner, c.row, follows_corner(c));
}

void fill_row(const Bodies& bodies, const SoftContact& c, const Frame& a, const Frame& b, SoftContacts& contacts) {
    ContactBlock& block = contacts.layout.blocks[c.block];
    block.a[c.row] = c.a, block.b[c.row] = c.b;
    write_rows(RowToWrite{row_source(bodies, contacts), c, a, b, block}, block);
}

namespace {

/// Adds what a contact's forces give its two bodies in so much time [s] to what all gave them, if that serves at all.
void add_given(const SoftContact& c, double time, SoftContacts& contacts) {
    if (!contacts.motion.given_fits) return;
    const ContactBlock& block = contacts.layout.blocks[c.block];
    const std::uint32_t k = c.row;
    const Vec2 n{block.normal_x[k], block.normal_y[k]};
    const auto add = [&](std::uint32_t row, double inverse_inertia, Vec2 lever, Vec2 impulse, double turn) {
        Mover& given = contacts.motion.given[row];
        const double inverse_mass = contacts.motion.movers[row].inverse_mass;
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
    contacts.layout.blocks[c.block].is_measured = contacts.layout.blocks[c.block].is_idle = false;
}

double overlap_under_weight(const SoftScene& scene, double h) {
    return length(scene.flight.dynamics.gravity()) / stiffness(h);
}

Load load_of(const SoftScene& scene, const SoftContact& c, const SoftContacts& contacts, double h) {
    constexpr double nowhere = HUGE_VAL;
    const double lighter = std::max(contacts.motion.movers[c.a].inverse_mass, contacts.motion.movers[c.b].inverse_mass);
    const double weight = length(scene.flight.dynamics.gravity()) / lighter;
    if (c.touched_before && !c.rests) return {0, nowhere};  // an impact
    Load load{0, c.touched_before ? -nowhere : least_gap(c.manifold)};
    const ContactBlock& block = contacts.layout.blocks[c.block];
    const double unit_stiffness = stiffness(h * contacts.pace.softer);
    for (int i = 0; i < c.manifold.count; ++i) {
        const double force = c.touched_before ? block.more[i].normal_force[c.row] : weight;
        load.overlap = std::max(load.overlap, force / (unit_stiffness * block.point[i].normal_mass[c.row]));
    }
    return load;
}

double spring_depth(const SoftContact& c) { return shallow_size * c.size; }

bool any_deep(const SoftContacts& contacts, std::size_t first) {
    return std::any_of(contacts.all.begin() + static_cast<std::ptrdiff_t>(first), contacts.all.end(),
                       [](const SoftContact& c) { return c.is_deep; });
}

}  // namespace carom
