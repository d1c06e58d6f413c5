// How those touch who are near one another.

#include <algorithm>
#include <cmath>
#include <utility>

#include "collision/side_by_side.hpp"
#include "math/made.hpp"
#include "math/scratch.hpp"
#include "simd/isa.hpp"
#include "solvers/covered.hpp"
#include "solvers/impact.hpp"
#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/mover_rows.hpp"
#include "solvers/pivots.hpp"
#include "solvers/shared.hpp"
#include "threads/parallel.hpp"

namespace carom {

const ContactKernel& contact_kernel() {
    return kernel_in_use<baseline_contact_kernel, avx2_contact_kernel, avx512_contact_kernel>();
}

const MoverKernel& mover_kernel() {
    return kernel_in_use<baseline_mover_kernel, avx2_mover_kernel, avx512_mover_kernel>();
}

namespace {

/// Whether one of a contact's bodies is so much heavier than the other that sweeps are not enough.
bool is_hard(const SoftScene& scene, const SoftContact& c) {
    constexpr double ratio = 10;
    if (!moves(scene, c.a) || !moves(scene, c.b)) return false;
    const double a = scene.bodies.mass[c.a], b = scene.bodies.mass[c.b];
    return std::max(a, b) > ratio * std::min(a, b);
}

/// What of a contact stays as long as its pieces are the same.
SoftContact contact_of(const SoftScene& scene, const Candidate& candidate, const PieceTable& pieces) {
    const auto [key, piece_a, piece_b] = candidate;
    const PieceTag& b = pieces.tags[piece_b];
    SoftContact c{.b = b.row, .piece_a = piece_a, .piece_b = piece_b, .at_wall = candidate.is_at_wall(), .key = key};
    c.radius_b = b.radius;
    c.is_single = b.is_single;
    c.least_thickness = thickness(candidate, pieces);
    if (c.at_wall) {
        const Wall& wall = scene.walls.all[piece_a];
        c.a = static_cast<std::uint32_t>(scene.bodies.size());
        c.shape_a = piece_a, c.shape_b = b.shape;
        c.restitution = mixed_restitution(scene.bodies, wall.restitution, b.restitution);
        c.friction = mixed_friction(scene.bodies, wall.friction, b.friction);
        c.surface_speed = b.surface_speed;
        c.rolling = b.rolling_resistance * b.radius;
        return c;
    }
    const PieceTag& a = pieces.tags[piece_a];
    c.a = a.row;
    c.is_hard = is_hard(scene, c);
    c.radius_a = a.radius;
    c.is_single = c.is_single || a.is_single;
    c.shape_a = a.shape, c.shape_b = b.shape;
    c.restitution = mixed_restitution(scene.bodies, a.restitution, b.restitution);
    c.friction = mixed_friction(scene.bodies, a.friction, b.friction);
    c.surface_speed = a.surface_speed + b.surface_speed;
    c.rolling = std::max(a.rolling_resistance, b.rolling_resistance) * std::max(c.radius_a, c.radius_b);
    return c;
}

/// The speed [m/s] at which points of a contact come together that are no farther apart than this [m]; 0 if they do
/// not.
double approach_of(const SoftContact& c, const State& state, double apart = 1e300) {
    double approach = 0;
    for (int k = 0; k < c.manifold.count; ++k) {
        const ManifoldPoint& p = c.manifold.point[k];
        if (p.gap > apart) continue;
        const Vec2 v = velocity_at(state, c.a, p.core_a) - velocity_at(state, c.b, p.core_b);
        approach = std::max(approach, dot(v, c.manifold.normal));
    }
    return approach;
}

/// How much faster [m/s] the points of a contact come together by what either body turned in a step [s], at most, if
/// neither did more than turn and slip, and that by little: what slips at u on what turns at w is pushed aside, by
/// 2 w u a second.
double closing_by_turns(const SoftContact& c, const State& state, double step) {
    constexpr double little_turn = 0.5;  // rad
    const auto squared_rate = [&](std::uint32_t row) {
        const double rate = row < state.size() ? state.v.angular[row] : 0;
        return std::abs(rate) * step < little_turn ? rate * rate : 0;
    };
    const double squared_a = squared_rate(c.a), squared_b = squared_rate(c.b);
    const double rate = std::sqrt(std::max(squared_a, squared_b));  // of the one whose side it is, for all one knows
    double most = 0;
    for (int k = 0; k < c.manifold.count; ++k) {
        const ManifoldPoint& p = c.manifold.point[k];
        const Vec2 inward = squared_b * p.core_b - squared_a * p.core_a;
        const Vec2 v = velocity_at(state, c.b, p.core_b) - velocity_at(state, c.a, p.core_a);
        const double slip = std::abs(cross(c.manifold.normal, v));
        most = std::max(most, step * (dot(inward, c.manifold.normal) + 2 * rate * slip));
    }
    return most;
}

/// Whether a contact only keeps up what it did before: no point comes nearer by more than half of what the force gives
/// the lighter one in a substep of h [s]. What rides in a drum comes nearer by what that turned since contacts were
/// looked for the last time, one `step` ago [s], and nothing else may press it. What does not bounce may land with its
/// other corner: that is foreseen, or sweeps end it.
bool rests(const SoftScene& scene, const State& state, const SoftContact& c, double h, double step) {
    const double close = std::max(least_gap(c.manifold), 0.0) + 1e-6 * c.size;
    const double approach = c.restitution == 0 ? approach_of(c, state, close) : approach_of(c, state);
    const double by_turns = closing_by_turns(c, state, step);
    const auto inverse_mass = [&](std::uint32_t row) { return moves(scene, row) ? scene.bodies.inverse_mass[row] : 0; };
    const double easiness = std::max(inverse_mass(c.a), inverse_mass(c.b));
    double pressed = 0;
    for (int k = 0; k < c.manifold.count; ++k) pressed += h * c.normal_force[k];
    if (pressed > 0) return approach <= 0.5 * pressed * easiness + by_turns;
    return c.touched_before && c.restitution == 0 && approach > 0 && approach <= by_turns;
}

/// Whether bodies were put into one another, deeper than they can have come by themselves: they are pushed apart, and
/// do not strike.
bool is_inside(const SoftContact& c, double margin) {
    return std::any_of(c.manifold.point, c.manifold.point + c.manifold.count,
                       [&](const ManifoldPoint& p) { return p.gap < -margin; });
}

}  // namespace

Vec2 velocity_at(const State& state, std::uint32_t row, Vec2 lever) {
    return row < state.size() ? state.v.linear[row] + cross(state.v.angular[row], lever) : Vec2{};
}

Vec2 point_of(const SoftContact& c, int point, Vec2 b) {
    return b + c.manifold.point[point].core_b - c.radius_b * c.manifold.normal;
}

Manifold look(const SoftScene& scene, const Candidate& c, const Frame& a, const Frame& b, double margin) {
    const Convex& outline = scene.pieces[c.piece_b].outline;
    if (c.is_at_wall()) return manifold(scene.walls.all[c.piece_a], outline, b, margin);
    return manifold(scene.pieces[c.piece_a].outline, a, outline, b, b.position - a.position, margin);
}

Manifold look_beside(const SoftScene& scene, const Candidate& c, const Frame& a, const Frame& b, double margin) {
    const auto alone = [&](std::uint32_t piece) {
        Convex outline = scene.pieces[piece].outline;
        outline.has_previous = outline.has_next = false, outline.previous_reach = outline.next_reach = 0;
        return outline;
    };
    return manifold(alone(c.piece_a), a, alone(c.piece_b), b, b.position - a.position, margin);
}

namespace {

/// Those who lose a contact that bore a force are stirred.
void lose(const SoftScene& scene, const ContactKey& key, Rest& rest) {
    for (const BodyId id : {key.a, key.b})
        if (scene.bodies.contains(id)) rest.stir(scene.bodies.row(id));
}

void take_over(const WarmContact& warm, bool midway, SoftContact& c) {
    c.touched_before = (midway ? warm.touched_before : warm.touched) != 0;
    c.touched = midway && warm.touched != 0;
    c.was_precise = warm.precise != 0, c.precise = false;
    std::copy(warm.jammed, warm.jammed + 2, c.jammed);
    remember(c, warm);
}

/// Gives contacts the forces that they bore before, by their names: of both those from some on, in the same order.
/// Those of who sleeps and is left out of the search are not among the ones before.
class Heirs {
  public:
    Heirs(const SoftScene& scene, const State& state, double h, const SoftContacts& contacts)
        : scene_(scene),
          state_(state),
          h_(h),
          step_(contacts.outlook.ahead),
          midway_(contacts.outlook.midway),
          warm_(contacts.warm),
          taken_(warm_.size()) {}

    std::size_t first_from(const ContactKey& key) const {
        return static_cast<std::size_t>(
            std::lower_bound(warm_.begin(), warm_.end(), key,
                             [](const WarmContact& w, const ContactKey& k) { return w.key < k; }) -
            warm_.begin());
    }
    /// `warm` is the first that is not before the contact, and then behind it.
    void give(SoftContact& c, std::size_t& warm) {
        while (warm < warm_.size() && warm_[warm].key != c.key && warm_[warm].key < c.key) ++warm;
        if (warm == warm_.size() || warm_[warm].key != c.key) return;
        take_over(warm_[warm], midway_, c);
        c.rests = c.rests || rests(scene_, state_, c, h_, step_);
        taken_[warm++] = 1;
    }
    void lose_others(Rest& rest) const {
        for (std::size_t warm = 0; warm < taken_.size(); ++warm)
            if (taken_[warm] == 0) lose(scene_, warm_[warm].key, rest);
    }

  private:
    const SoftScene& scene_;
    const State& state_;
    double h_, step_;
    bool midway_;
    const std::vector<WarmContact>& warm_;
    Scratch<std::uint8_t> taken_;
};

Manifold look_at(const SoftScene& scene, const Near& near, const SoftContacts& contacts) {
    return look(scene, contacts.search.candidates[near.candidate], contacts.motion.frames[near.a],
                contacts.motion.frames[near.b], near.margin);
}
/// The same when all are looked for: pieces are placed then.
Manifold look_at_placed(const SoftScene& scene, const Near& near, const SoftContacts& contacts) {
    const Candidate& c = contacts.search.candidates[near.candidate];
    if (c.is_at_wall()) return look_at(scene, near, contacts);
    const Frame &a = contacts.motion.frames[near.a], &b = contacts.motion.frames[near.b];
    const Vec2 between = b.position - a.position;
    const Placed there = contacts.pieces.placed[c.piece_b].moved(between);
    return manifold({scene.pieces[c.piece_a].outline, a, contacts.pieces.placed[c.piece_a]},
                    {scene.pieces[c.piece_b].outline, b, there}, between, near.margin);
}

/// Whether the pair can be looked at beside others: then its manifold is written when all of them are.
bool put_beside(const Near& near, std::uint32_t number, const SoftContacts& contacts, Manifold& manifold,
                SideBySide& others) {
    const Candidate& c = contacts.search.candidates[near.candidate];
    if (c.is_at_wall()) return false;
    const Placed &a = contacts.pieces.placed[c.piece_a], &b = contacts.pieces.placed[c.piece_b];
    if (!others.takes(a, b)) return false;
    const Vec2 between = contacts.motion.frames[near.b].position - contacts.motion.frames[near.a].position;
    others.add(a, b, between, near.margin, number, manifold);
    return true;
}

bool is_of(const SoftContact& c, const Candidate& candidate) {
    return c.key == candidate.key && c.piece_a == candidate.piece_a && c.piece_b == candidate.piece_b;
}

/// Notes how the two of a contact are, without what went before.
void begin(const State& state, const Manifold& manifold, double h, const SoftContacts& contacts, SoftContact& c) {
    c.manifold = manifold;
    c.touched_before = c.touched = c.pivots = c.lands = c.gentle = c.crowded = c.was_precise = c.precise = false;
    c.jammed[0] = c.jammed[1] = 0;
    for (int k = 0; k < 2; ++k) c.normal_force[k] = c.tangent_force[k] = c.rolling_moment[k] = c.preload[k] = 0;
    c.size = size_of(c.candidate(), contacts.pieces);
    const auto angle = [&](std::uint32_t row) { return row < state.size() ? state.x.angular[row] : 0; };
    const Vec2 between = contacts.motion.frames[c.b].position - contacts.motion.frames[c.a].position;
    c.seen = {least_gap(c.manifold), between, angle(c.a), angle(c.b)};
    c.thickness = std::min(c.size, c.least_thickness);
    c.fast = manifold.past_neighbours || is_fast(state, h, c.a, c.b, c.least_thickness, contacts);
    const auto is_disc = [&](std::uint32_t piece) { return contacts.pieces.tags[piece].is_single; };
    const bool are_discs = !c.at_wall && is_disc(c.piece_a) && is_disc(c.piece_b);  // with no other corner to come
    c.turns = !are_discs && turns(Encounter(c), state, contacts.outlook.ahead);
    c.is_deep = least_gap(c.manifold) < -spring_depth(c);
    c.rests = is_inside(c, contacts.outlook.reach[c.a] + contacts.outlook.reach[c.b] + speculation * c.size);
}

/// One that has no contact, to be passed over; of a piece of a chain, too, where a neighbour has it or has to have it.
Near without_contact(Near near, const SoftContacts& contacts) {
    constexpr double in_each_substep = -1;
    if (is_at_chain(contacts.search.candidates[near.candidate], contacts.pieces)) near.spare = in_each_substep;
    return near;
}

/// Of a piece of a chain that has no contact, for a neighbour has it: with who may strike it in the same substep, as if
/// there were no neighbour. Whose it is where he comes down is told there.
void look_past_neighbours(const SoftScene& scene, const State& state, double h, const Near& near,
                          const SoftContacts& contacts, Manifold& manifold) {
    const Candidate& c = contacts.search.candidates[near.candidate];
    manifold.count = 0;
    if (!is_at_chain(c, contacts.pieces) || !may_land_on(scene, state, h, near, contacts)) return;
    const auto& frames = contacts.motion.frames;
    make_at(manifold, [&] { return look_beside(scene, c, frames[near.a], frames[near.b], near.margin); });
    manifold.past_neighbours = true;
    if (least_gap(manifold) < 0) manifold.count = 0;
}

/// Which of those who are near touch; the others are passed over.
Scratch<std::uint32_t> find_touching(const SoftScene& scene, const State& state, double h, std::span<const Near> near,
                                     SoftContacts& contacts) {
    auto& manifolds = contacts.search.manifolds;
    if (manifolds.size() < near.size()) manifolds.resize(near.size());
    constexpr std::size_t at_once = SideBySide::most, some = 8;
    const auto look = [&](std::size_t number) {
        std::uint32_t found = 0;
        const std::size_t first = at_once * number;
        const auto look_alone = [&](std::uint32_t place) {
            Manifold& manifold = manifolds[first + place];
            make_at(manifold, [&] { return look_at_placed(scene, near[first + place], contacts); });
            if (manifold.count > 0 && may_come(scene, state, h, near[first + place], manifold, contacts))
                found |= 1U << place;
        };
        SideBySide side_by_side;
        for (std::uint32_t place = 0; place < std::min(at_once, near.size() - first); ++place)
            if (!put_beside(near[first + place], place, contacts, manifolds[first + place], side_by_side))
                look_alone(place);
        found |= side_by_side.look_at_all(look_alone);
        for (std::uint32_t place = 0; place < std::min(at_once, near.size() - first); ++place) {
            if ((found >> place & 1U) != 0) continue;
            look_past_neighbours(scene, state, h, near[first + place], contacts, manifolds[first + place]);
            if (manifolds[first + place].count > 0) found |= 1U << place;
        }
        return found;
    };
    Scratch<std::uint32_t> touching;
    touching.reserve(near.size());
    std::size_t next = 0;
    const auto pass_over_until = [&](std::size_t k) {
        for (; next < k; ++next) pass_over(without_contact(near[next], contacts), contacts.outlook);
    };
    const auto note = [&](std::size_t number, std::uint32_t place) {
        const std::size_t k = at_once * number + place;
        pass_over_until(k), ++next;
        touching.push_back(static_cast<std::uint32_t>(k));
    };
    each_row_where(scene.threads, (near.size() + at_once - 1) / at_once, look, note, some);
    pass_over_until(near.size());
    return touching;
}

/// Takes out of those who touch, by their places among the near, who passes a chain from behind.
void let_pass_from_behind(const SoftScene& scene, const State& state, std::span<const Near> near,
                          SoftContacts& contacts, Scratch<std::uint32_t>& touching) {
    std::vector<ContactKey> passing;
    std::erase_if(touching, [&](std::uint32_t k) {
        const FromBehind passes = comes_from_behind(scene, state, near[k], contacts.search.manifolds[k], contacts);
        if (passes == FromBehind::until_out) passing.push_back(contacts.search.candidates[near[k].candidate].key);
        return passes != FromBehind::no;
    });
    std::sort(passing.begin(), passing.end());
    contacts.passing = std::move(passing);
}

}  // namespace

void find_contacts(const SoftScene& scene, const State& state, double dt, double h, SoftContacts& contacts) {
    const std::span near = find_candidates(scene, state, dt, h, contacts);
    const Timed timed(scene.profile, Work::narrow);
    auto& all = contacts.all;
    const auto& manifolds = contacts.search.manifolds;
    Scratch<std::uint32_t> touching = find_touching(scene, state, h, near, contacts);
    drop_covered(scene, state, h, contacts, touching);
    let_pass_from_behind(scene, state, near, contacts, touching);
    constexpr std::size_t some = 256;
    const std::size_t known = contacts.rest.is_known ? all.size() : 0;  // from the search before, with the same pieces
    all.resize(touching.size()), contacts.ends.resize(touching.size());
    Heirs heirs(scene, state, h, contacts);
    parallel_ranges(scene.threads, all.size(), some, [&](std::size_t first, std::size_t last) {
        std::size_t warm = heirs.first_from(contacts.search.candidates[near[touching[first]].candidate].key);
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t k = touching[i];
            const Candidate& candidate = contacts.search.candidates[near[k].candidate];
            if (i >= known || !is_of(all[i], candidate))
                make_at(all[i], [&] { return contact_of(scene, candidate, contacts.pieces); });
            begin(state, manifolds[k], h, contacts, all[i]);
            heirs.give(all[i], warm);
            contacts.ends[i] = {all[i].a, all[i].b, all[i].is_single, all[i].pressed()};
        }
    });
    heirs.lose_others(contacts.rest);
}

bool is_in_crowd(const SoftContact& c, const SoftContacts& contacts) {
    return contacts.in_crowd[c.a] || contacts.in_crowd[c.b];
}

namespace {

/// Notes whether a contact needs no blow: in a crowd, whatever strikes it from behind, or because the two come together
/// no faster than gravity makes them in a substep of h [s].
void note_gentle(const SoftScene& scene, const State& state, double h, SoftContact& c, const SoftContacts& contacts) {
    const auto is_slow = [&] { return approach_of(c, state) <= gentle * h * length(scene.flight.dynamics.gravity()); };
    const bool may_be = c.restitution <= bounces_little && !c.fast && !c.is_hard;
    c.crowded = may_be && is_in_crowd(c, contacts);
    c.gentle = c.crowded || (may_be && c.restitution == 0 && is_slow());
}

}  // namespace

void note_gentle(const SoftScene& scene, const State& state, double h, const Scratch<std::uint32_t>& first,
                 SoftContacts& contacts) {
    Scratch<std::uint32_t> number(first.size(), 0);  // of contacts in an island
    for (const ContactEnds& c : contacts.ends) ++number[first[moves(scene, c.a) ? c.a : c.b]];
    contacts.in_crowd.assign(first.size() + 1, 0);
    contacts.rest.moving.each_row([&](std::size_t i) { contacts.in_crowd[i] = number[first[i]] > crowd; });
    act_on_all(scene.threads, contacts.all, [&](SoftContact& c) { note_gentle(scene, state, h, c, contacts); });
}

void look_again(const SoftScene& scene, const State& state, double h, SoftContact& c, SoftContacts& contacts) {
    const double ahead = c.pivots ? 0.5 * h : 0;
    const Frame a = frame_ahead(state, contacts.motion, c.a, ahead),
                b = frame_ahead(state, contacts.motion, c.b, ahead);
    take_forces(contacts.layout, c);
    const WarmContact kept = warm_of(c);
    constexpr double anywhere = 1e300;
    c.manifold = look(scene, c.candidate(), a, b, anywhere);
    remember(c, kept);
    fill_row(scene.bodies, c, a, b, contacts);
}

void note_corner(const SoftContact& c, SoftContacts& contacts) {
    if (rounds_a_corner(c)) contacts.layout.blocks[c.block].any_corners = contacts.lists.any_corners = true;
}

namespace {

/// Has sweeps let one bounce that is in a crowd since its row was written.
void let_bounce(const SoftContact& c, SoftContacts& contacts) {
    ContactBlock& block = contacts.layout.blocks[c.block];
    const bool bounces = is_let_bounce(c);
    block.restitution[c.row] = bounces ? c.restitution : 0;
    block.any_bounce = block.any_bounce || bounces, contacts.lists.any_bounce = contacts.lists.any_bounce || bounces;
}

/// Has the contacts of bodies that got further than was thought looked at: some strike now, and others do no more.
void note_astray(const SoftScene& scene, const State& state, double h, const Scratch<bool>& outruns,
                 SoftContacts& contacts) {
    for (std::uint32_t i = 0; i < contacts.all.size(); ++i) {
        SoftContact& c = contacts.all[i];
        if (!outruns[c.a] && !outruns[c.b]) continue;
        take_out(c, h, contacts);
        look_again(scene, state, h, c, contacts);
        put_in(c, h, contacts);
        note_corner(c, contacts);
        const bool was_changing = is_looked_at_anew(c), did_strike = may_strike(c);
        c.fast = (c.fast && is_at_chain(c.candidate(), contacts.pieces)) ||  // he may have been past its neighbours
                 is_fast(state, h, c.a, c.b, c.least_thickness, contacts);
        c.rests = c.rests || rests(scene, state, c, h, contacts.outlook.ahead);
        note_gentle(scene, state, h, c, contacts);
        let_bounce(c, contacts);
        if (!was_changing && is_looked_at_anew(c)) contacts.lists.changing.push_back(i);
        if (!did_strike && may_strike(c)) contacts.lists.strikers.push_back(i);
    }
    std::erase_if(contacts.lists.changing, [&](std::uint32_t i) { return !is_looked_at_anew(contacts.all[i]); });
    std::erase_if(contacts.lists.strikers, [&](std::uint32_t i) { return !may_strike(contacts.all[i]); });
}

}  // namespace

bool take_in(const SoftScene& scene, const State& state, double h, PreciseIslands& islands, SoftContacts& contacts) {
    // Of so many bodies one gets farther than foreseen: to look around for more is no less than to look for all. And of
    // so many one has a contact outside crowds.
    constexpr std::size_t some = 16, few = 64;
    const std::size_t before = contacts.all.size();
    std::size_t lone = 0;  // contacts outside crowds: where they are many, each is to be as in a new step
    const auto may_join = [&](const SoftContact& c) {
        const auto is_asleep = [&](std::uint32_t row) { return row < state.size() && contacts.rest.asleep[row]; };
        lone += !is_in_crowd(c, contacts);
        if (before == 0) return false;  // the first one is laid out by a search, which those after it join
        const bool may_be_swept = !islands.hold(c) && (!c.is_hard || is_in_crowd(c, contacts));
        return few * lone <= contacts.rest.moving.count() && !is_asleep(c.a) && !is_asleep(c.b) &&
               (may_be_swept || islands.one_for(scene, c));
    };
    Scratch<Near> joining;
    if (const auto outrunners = find_outrunners(scene, state, h, contacts); !outrunners.empty()) {
        Scratch<bool> outruns(state.size() + 1);
        for (const std::uint32_t row : outrunners) outruns[row] = true;
        if (some * outrunners.size() > contacts.rest.moving.count() ||
            std::any_of(contacts.all.begin(), contacts.all.end(),
                        [&](const SoftContact& c) { return (outruns[c.a] || outruns[c.b]) && !may_join(c); }))
            return false;
        note_astray(scene, state, h, outruns, contacts);
        joining = look_around(scene, state, h, outrunners, contacts);
    }
    take_astray(scene, state, h, contacts, joining);
    // Not in the order in which they were found: that depends on who else is a candidate.
    const auto key_of = [&](const Near& near) { return contacts.search.candidates[near.candidate].key; };
    std::sort(joining.begin(), joining.end(), [&](const Near& a, const Near& b) { return key_of(a) < key_of(b); });
    for (const Near& near : joining) {
        Manifold manifold = look_at(scene, near, contacts);
        if (manifold.count == 0 || !may_come(scene, state, h, near, manifold, contacts))
            look_past_neighbours(scene, state, h, near, contacts, manifold);
        if (manifold.count == 0 || comes_from_behind(scene, state, near, manifold, contacts) != FromBehind::no) {
            pass_over_later(without_contact(near, contacts), contacts.outlook);
            continue;
        }
        SoftContact c = contact_of(scene, contacts.search.candidates[near.candidate], contacts.pieces);
        begin(state, manifold, h, contacts, c);
        if (!may_join(c)) {
            contacts.all.resize(before);
            return false;
        }
        const auto warm = std::lower_bound(contacts.warm.begin(), contacts.warm.end(), c.key,
                                           [](const WarmContact& w, const ContactKey& key) { return w.key < key; });
        if (warm != contacts.warm.end() && warm->key == c.key) take_over(*warm, contacts.outlook.midway, c);
        note_gentle(scene, state, h, c, contacts);
        contacts.all.push_back(c);
    }
    if (contacts.all.size() > before) {
        arrange(scene, h, before, contacts);
        take_precisely(scene, before, islands, contacts);
    }
    for (std::size_t i = before; i < contacts.all.size(); ++i) put_in(contacts.all[i], h, contacts);
    return true;
}

}  // namespace carom
