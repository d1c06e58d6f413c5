// What began and ended in a step: what touches now, held against what touched in the step before.

#include <algorithm>
#include <iterator>
#include <tuple>

#include "math/scratch.hpp"
#include "world/state.hpp"

namespace carom {

namespace {

bool before(const ShapePair& p, const ShapePair& q) {
    const auto order = [](const ShapeId& s) {
        return std::tuple(s.body.generation != 0, s.body.index, s.body.generation, s.shape);
    };
    return std::tuple(order(p.a), order(p.b)) < std::tuple(order(q.a), order(q.b));
}

/// Takes what touches now, in any order and some of it twice, in place of what did.
void follow(std::vector<ShapePair>& touching, Scratch<ShapePair> now, std::vector<ShapePair>& begins,
            std::vector<ShapePair>& ends) {
    begins.clear(), ends.clear();
    if (std::equal(now.begin(), now.end(), touching.begin(), touching.end())) return;  // as in most steps of what rests
    if (!std::is_sorted(now.begin(), now.end(), before)) std::sort(now.begin(), now.end(), before);
    now.erase(std::unique(now.begin(), now.end()), now.end());
    std::set_difference(now.begin(), now.end(), touching.begin(), touching.end(), std::back_inserter(begins), before);
    std::set_difference(touching.begin(), touching.end(), now.begin(), now.end(), std::back_inserter(ends), before);
    touching.assign(now.begin(), now.end());
}

/// What sensors overlap. They see fixed bodies too, whether they move themselves or not, but no other sensors.
Scratch<ShapePair> seen(const PlacedPieces& all, Sweep& sweep) {
    Scratch<ShapePair> pairs;
    Scratch<bool> sensor(all.pieces.size());
    for (std::size_t k = 0; k < sensor.size(); ++k) sensor[k] = all[k].sensor;
    for (const BoxPair pair : sweep.pairs(all.places.bounds, sensor)) {
        const std::uint32_t s = sensor[pair.a] ? pair.a : pair.b, other = sensor[pair.a] ? pair.b : pair.a;
        if (sensor[other] || all[s].row == all[other].row || !may_meet(all[s].filter, all[other].filter)) continue;
        if (closest_points(all[s].outline, all.frame(s), all[other].outline, all.frame(other)).distance <= 0)
            pairs.push_back({all.shape(s), all.shape(other)});
    }
    return pairs;
}

}  // namespace

void World::State::note_events() {
    events.impacts.clear();
    events.sleeps.clear(), events.wakes.clear();
    Scratch<ShapePair> now;
    if (is_soft()) {
        events.sleeps = soft_contacts.sleeps, events.wakes = soft_contacts.wakes;
        events.impacts = soft_contacts.bounces;
        for (const Impact& impact : soft_contacts.landings)
            if (!std::binary_search(touching.begin(), touching.end(), impact.shapes, before))
                events.impacts.push_back(impact);
        std::sort(events.impacts.begin(), events.impacts.end(), [](const Impact& a, const Impact& b) {
            return a.time < b.time || (a.time == b.time && before(a.shapes, b.shapes));
        });
        for (const SoftContact& c : soft_contacts.all)
            if (c.touched) now.push_back(c.shapes);
        for (const SoftContact& c : soft_contacts.resting)
            if (c.touched) now.push_back(c.shapes);
    }
    follow(touching, std::move(now), events.begins, events.ends);
    follow(sensed, any_sensor ? seen(placed_pieces(), sensor_sweep) : Scratch<ShapePair>{}, events.sensor_begins,
           events.sensor_ends);
}

std::vector<ContactPoint> World::contacts() const {
    const State& s = *state_;
    std::vector<ContactPoint> points;
    if (!s.is_soft()) return points;
    for (const auto* contacts : {&s.soft_contacts.all, &s.soft_contacts.resting})
        for (const SoftContact& c : *contacts) {
            if (!s.bodies.contains(c.key.b)) continue;
            const Vec2 b = s.motion.x.linear[s.bodies.row(c.key.b)];
            for (int i = 0; i < c.manifold.count; ++i)
                if (c.normal_force[i] > 0)
                    points.push_back(
                        {c.shapes, point_of(c, i, b), c.manifold.normal, c.normal_force[i], c.tangent_force[i]});
        }
    return points;
}

const StepEvents& World::events() const { return state_->events; }

}  // namespace carom
