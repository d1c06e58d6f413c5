#include "world/sleep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "collision/sweep.hpp"
#include "math/scratch.hpp"
#include "world/state.hpp"

namespace carom {

std::vector<bool> only_weighed(const Forces& forces, const Bodies& bodies) {
    const bool far_reaching = !forces.attractions.empty() || !forces.soft_discs.empty() || !forces.user_forces.empty();
    std::vector<bool> only(bodies.size(), !far_reaching);
    const auto acts_on = [&](const std::optional<BodyId>& id) {
        if (id)
            only[bodies.row(*id)] = false;
        else
            only.assign(bodies.size(), false);
    };
    const auto joins = [&](const auto& springs) {
        for (const auto& s : springs) acts_on(s.a), acts_on(s.b);
    };
    joins(forces.springs), joins(forces.torsion_springs);
    for (const Drive& d : forces.drives) acts_on(d.body);
    for (const ForceField& f : forces.fields) acts_on(f.body);
    for (const Drag& d : forces.drags)
        if (d.wind != Vec2{}) acts_on(d.body);
    return only;
}

void World::State::note_put(BodyId id) {
    Rest& rest = soft_contacts.rest;
    const std::size_t row = bodies.row(id);
    rest.put(row);
    if (rest.still.empty() || bodies.inverse_mass[row] != 0) return;
    put.push_back(id);
    if (row < rest.asleep.size()) rest.asleep[row] = 0;  // who slept and is nailed down now
}

namespace {

/// Whether two pieces touch, or would but for rounding.
bool touch(const PlacedPieces& all, std::size_t k, std::size_t l) {
    return closest_points(all[k].outline, all.frame(k), all[l].outline, all.frame(l)).distance <=
           touch_hair * std::min(size_of(all[k].outline), size_of(all[l].outline));
}

/// Calls act(k) for the pieces of sleepers that touch one of those that were put somewhere; by row.
template <class Act>
void each_touched(const PlacedPieces& all, const Scratch<bool>& is_put, const Scratch<bool>& sleeps, const Act& act) {
    Aabb room{{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};  // around all that was put
    for (std::size_t k = 0; k < all.pieces.size(); ++k)
        if (is_put[all[k].row]) room = hull(room, all.bounds(k));
    Scratch<std::size_t> near;
    for (std::size_t k = 0; k < all.pieces.size(); ++k)
        if (is_put[all[k].row] || (sleeps[all[k].row] && overlap(room, all.bounds(k)))) near.push_back(k);
    std::vector<Aabb> boxes;
    Scratch<bool> seeks;
    for (const std::size_t k : near) boxes.push_back(all.bounds(k)), seeks.push_back(is_put[all[k].row]);
    Sweep sweep;
    for (const BoxPair pair : sweep.pairs(boxes, seeks)) {
        const std::size_t a = near[pair.a], b = near[pair.b];
        if (seeks[pair.a] == seeks[pair.b] || !may_meet(all[a], all[b]) || !touch(all, a, b)) continue;
        act(seeks[pair.a] ? b : a);
    }
}

}  // namespace

// What nothing moves looks for no sleepers, and they for nobody.
void World::State::stir_touched() {
    const std::vector<BodyId> ids = std::exchange(put, {});
    if (ids.empty() || soft_contacts.rest.still.empty()) return;
    Scratch<bool> is_put(bodies.size()), sleeps(bodies.size());
    for (const BodyId id : ids)
        if (bodies.contains(id)) is_put[bodies.row(id)] = bodies.inverse_mass[bodies.row(id)] == 0;
    for (std::size_t row = 0; row < std::min(bodies.size(), soft_contacts.rest.asleep.size()); ++row)
        sleeps[row] = soft_contacts.rest.asleep[row] != 0 && bodies.inverse_mass[row] != 0;
    if (std::none_of(sleeps.begin(), sleeps.end(), [](bool one) { return one; })) return;
    const PlacedPieces all = placed_pieces();
    each_touched(all, is_put, sleeps, [&](std::size_t k) { soft_contacts.rest.stir(all[k].row); });
}

}  // namespace carom
