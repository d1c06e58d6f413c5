// What contacts leave to the next step: the forces that they bore.

#include <algorithm>
#include <cmath>

#include "math/made.hpp"
#include "math/pages.hpp"
#include "math/scratch.hpp"
#include "simd/prefetch.hpp"
#include "solvers/covered.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/soft_step.hpp"
#include "threads/parallel.hpp"

namespace carom {

void take_forces(const ContactLayout& layout, SoftContact& c) {
    for (int i = 0; i < c.manifold.count; ++i) {
        const auto& p = layout.blocks[c.block].more[i];
        c.normal_force[i] = p.normal_force[c.row], c.tangent_force[i] = p.tangent_force[c.row];
        c.rolling_moment[i] = p.rolling_moment[c.row];
    }
}

WarmContact warm_of(const SoftContact& c) {
    WarmContact warm{.key = c.key,
                     .precise = c.precise,
                     .touched = c.touched,
                     .touched_before = c.touched_before,
                     .jammed = {c.jammed[0], c.jammed[1]}};
    for (int i = 0; i < c.manifold.count; ++i) {
        if (c.normal_force[i] == 0) continue;
        warm.id[warm.count] = c.manifold.point[i].id;
        warm.normal_force[warm.count] = c.normal_force[i];
        warm.tangent_force[warm.count] = c.tangent_force[i];
        warm.rolling_moment[warm.count] = c.rolling_moment[i];
        warm.preload[warm.count] = c.preload[i];
        ++warm.count;
    }
    return warm;
}

namespace {

bool same_features(std::uint32_t a, std::uint32_t b) { return ((a ^ b) & ManifoldPoint::features) == 0; }

/// Which of the points before was a point of now: that of its features; or, where it is a corner of the other one now
/// that is over an edge, as where two boxes of one width rest on one another, that on its side which no other is.
std::uint32_t place_before(const Manifold& now, int point, const WarmContact& warm) {
    const std::uint32_t id = now.point[point].id, side = id & ~ManifoldPoint::features;
    for (std::uint32_t l = 0; l < warm.count; ++l)
        if (same_features(id, warm.id[l])) return l;
    for (std::uint32_t l = 0; l < warm.count && side != 0; ++l)
        if ((warm.id[l] & ~ManifoldPoint::features) == side && !same_features(now.point[1 - point].id, warm.id[l]))
            return l;
    return warm.count;
}

}  // namespace

void remember(SoftContact& c, const WarmContact& warm) {
    for (int k = 0; k < c.manifold.count; ++k) {
        const std::uint32_t l = place_before(c.manifold, k, warm);
        const bool is_known = l < warm.count;
        c.normal_force[k] = is_known ? warm.normal_force[l] : 0;
        c.tangent_force[k] = is_known ? warm.tangent_force[l] : 0;
        c.rolling_moment[k] = is_known && c.rolling > 0 ? warm.rolling_moment[l] : 0;
        c.preload[k] = is_known ? warm.preload[l] : 0;
    }
}

namespace {

/// Who lies in a chain and presses on nothing, as he leaves it, has not come from behind either when he is pushed back.
bool lies_in_chain(const SoftContact& c, const PieceTable& pieces) {
    return least_gap(c.manifold) < 0 && is_at_chain(c.candidate(), pieces);
}
bool is_kept(const WarmContact& warm, const SoftContact& c, const PieceTable& pieces) {
    return warm.count > 0 || c.touched || lies_in_chain(c, pieces);
}

/// Of one that sleeps. Whether its only point is the left or the right one depends on how near the other had to be to
/// count when it was looked at: it is told by its features.
void keep(const SoftContact& c, const PieceTable& pieces, std::vector<WarmContact>& warm) {
    WarmContact kept = warm_of(c);
    if (kept.count == 1) kept.id[0] &= ManifoldPoint::features;
    if (is_kept(kept, c, pieces)) warm.push_back(kept);
}

bool is_before(const WarmContact& a, const WarmContact& b) { return a.key < b.key; }

/// Puts those from this one on, which are in order, among those before.
void merge(std::vector<WarmContact>& warm, std::ptrdiff_t from) {
    std::inplace_merge(warm.begin(), warm.begin() + from, warm.end(), is_before);
}

/// Asks for a contact's forces where it was solved: they lie all over.
void fetch_forces(const ContactLayout& layout, const SoftContact& c) {
    for (int i = 0; i < c.manifold.count; ++i) {
        const auto& p = layout.blocks[c.block].more[i];
        prefetch(&p.normal_force[c.row]), prefetch(&p.tangent_force[c.row]), prefetch(&p.rolling_moment[c.row]);
    }
}

/// The most that what lies on a contact presses it by its weight [N/kg of effective mass], which is half of that of one
/// of two; without end where there is none, or something else may press.
double hardest_weight(const SoftScene& scene) {
    constexpr double weights = 200;
    const Dynamics& dynamics = scene.flight.dynamics;
    const double g = length(dynamics.gravity());
    return g > 0 && dynamics.is_free_flight() && scene.mechanisms.empty() ? weights * g : HUGE_VAL;
}

/// How preloads are eased in a step.
struct Easing {
    double part;     ///< of what is too much, or too little, that goes
    double hardest;  ///< load on 1 kg that they follow [N]
};

/// Takes its part away of what the preloads of a contact are more than it bears. Where a crowd is stirred they follow
/// what it bears: overlaps vanish under a load that lasts. What comes to rest keeps its own, as sweeps spread it; and
/// none grows beyond a load that would crush the two, as it would without end in a crowd that has no room, or, where
/// nothing but weight presses, beyond that of a hundred on top of it: a blow of somebody heavy is heat, and preloads
/// would give it back.
void ease_preload(const SoftScene& scene, const State& state, const Easing& easing, SoftContact& c,
                  const SoftContacts& contacts) {
    const auto [part, hardest] = easing;
    constexpr double crushed = 0.08;  // of the size
    const bool follows =
        part > 0 && c.crowded && c.touched_before && !c.precise && is_stirred(scene, state, c, contacts);
    const double most =  // on 1 kg
        follows ? std::min(stiffness(contacts.pace.slow) * crushed * c.size, hardest) : 0;
    const ContactBlock& block = contacts.layout.blocks[c.block];
    for (int k = 0; k < c.manifold.count; ++k) {
        const double borne = c.normal_force[k];
        const double aim = follows ? std::min(borne, most * block.point[k].normal_mass[c.row]) : borne;
        if (follows || c.preload[k] > borne) c.preload[k] += part * (aim - c.preload[k]);
    }
}

/// Keeps what is kept of some contacts, in order, from the place on that the first of them has among all: where it
/// ends.
std::size_t take_and_keep(const SoftScene& scene, const State& state, std::size_t first, std::size_t last,
                          const Easing& easing, SoftContacts& contacts) {
    constexpr std::size_t ahead = 8;
    std::size_t end = first;
    for (std::size_t i = first; i < last; ++i) {
        if (i + ahead < last) fetch_forces(contacts.layout, contacts.all[i + ahead]);
        SoftContact& c = contacts.all[i];
        take_forces(contacts.layout, c);
        ease_preload(scene, state, easing, c, contacts);
        for (std::uint16_t& cost : c.jammed) cost -= easing.part > 0 && cost > 0;  // it is a step older
        c.touched = c.touched || (contacts.layout.untouched[c.block].now >> c.row & 1) == 0;
        make_at(contacts.warm[end], [&] { return warm_of(c); });
        end += is_kept(contacts.warm[end], c, contacts.pieces);
    }
    return end;
}

}  // namespace

bool is_stirred(const SoftScene& scene, const State& state, const SoftContact& c, const SoftContacts& contacts) {
    const auto squared_speed = [&](std::uint32_t row) {
        if (row >= state.size() || !(scene.bodies.inverse_mass[row] > 0)) return 0.0;
        const Vec2 v = state.v.linear[row];
        const double rim = state.v.angular[row] * contacts.pieces.extent[row];
        return dot(v, v) + rim * rim;
    };
    const double fallen = 0.01 * length(scene.flight.dynamics.gravity()) * c.size;
    return std::max(squared_speed(c.a), squared_speed(c.b)) > fallen;
}

void keep_warm(const SoftScene& scene, const State& state, double time, SoftContacts& contacts) {
    constexpr double gone = 0.05;  // s: a load that is gone holds nobody up for much longer
    const Easing easing{time / (gone + time), hardest_weight(scene)};
    auto& warm = contacts.warm;
    warm.resize(contacts.all.size());
    constexpr std::size_t some = 512;
    struct Run {
        std::size_t first = 0, last = 0;
    };
    Scratch<Run> runs(contacts.all.size() / some + 1);
    parallel_ranges(scene.threads, contacts.layout.latecomers, some, [&](std::size_t first, std::size_t last) {
        runs[first / some] = {first, take_and_keep(scene, state, first, last, easing, contacts)};
    });
    std::size_t kept = 0;
    const auto close_up = [&](const Run& run) {
        const auto from = warm.begin() + static_cast<std::ptrdiff_t>(run.first);
        const auto to = warm.begin() + static_cast<std::ptrdiff_t>(kept);
        const std::size_t length = run.last - run.first;
        if (from != to) std::copy(from, from + static_cast<std::ptrdiff_t>(length), to);
        kept += length;
    };
    for (const Run& run : runs) close_up(run);
    const auto in_order = static_cast<std::ptrdiff_t>(kept);
    close_up({contacts.layout.latecomers,
              take_and_keep(scene, state, contacts.layout.latecomers, contacts.all.size(), easing, contacts)});
    warm.resize(kept);
    std::sort(warm.begin() + in_order, warm.end(), is_before);
    merge(warm, in_order);
}

void keep_resting_warm(SoftContacts& contacts) {
    Rest& rest = contacts.rest;
    rest.warm.clear();
    reserve_large(rest.warm, rest.contacts.size());
    for (const SoftContact& c : rest.contacts) keep(c, contacts.pieces, rest.warm);
}

void recall_roused(const SoftScene& scene, SoftContacts& contacts) {
    const auto awake = static_cast<std::ptrdiff_t>(contacts.warm.size());
    std::erase_if(contacts.rest.contacts, [&](const SoftContact& c) {
        const bool is_roused = contacts.rest.asleep[moves(scene, c.a) ? c.a : c.b] == 2;
        if (is_roused) keep(c, contacts.pieces, contacts.warm);
        return is_roused;
    });
    merge(contacts.warm, awake);
    keep_resting_warm(contacts);
    contacts.rest.is_new = true;
}

void recall_resting(SoftContacts& contacts) {
    const auto awake = static_cast<std::ptrdiff_t>(contacts.warm.size());
    contacts.warm.insert(contacts.warm.end(), contacts.rest.warm.begin(), contacts.rest.warm.end());
    merge(contacts.warm, awake);
    contacts.rest.warm.clear(), contacts.rest.contacts.clear(), contacts.rest.roused.clear(), contacts.layout.last = {};
    contacts.rest.is_new = true;
}

}  // namespace carom
