// What began and ended in a step: what touches now, held against what touched in the step before.

#include <algorithm>
#include <iterator>

#include "math/scratch.hpp"
#include "world/state.hpp"

namespace carom {

namespace {

bool before(const ShapePair& p, const ShapePair& q) {
    const auto both = [](std::uint64_t first, std::uint32_t second) { return first << 32 | second; };
    const auto body = [&](const ShapeId& s) { return both(s.body.generation != 0, s.body.index); };
    const auto rest = [&](const ShapeId& s) { return both(s.body.generation, s.shape); };
    if (p.a != q.a) return body(p.a) != body(q.a) ? body(p.a) < body(q.a) : rest(p.a) < rest(q.a);
    return body(p.b) != body(q.b) ? body(p.b) < body(q.b) : rest(p.b) < rest(q.b);
}

/// Puts pairs in order, each once. Most are in order, but for those of contacts that came late.
void order(Scratch<ShapePair>& pairs) {
    const auto late = std::is_sorted_until(pairs.begin(), pairs.end(), before);
    if (late != pairs.end()) {
        std::sort(late, pairs.end(), before);
        Scratch<ShapePair> merged(pairs.size());
        std::merge(pairs.begin(), late, late, pairs.end(), merged.begin(), before);
        pairs.swap(merged);
    }
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// Takes what touches now, in any order and some of it twice, in place of what did.
template <class Pairs>
void follow(Pairs& touching, Scratch<ShapePair> now, std::vector<ShapePair>& begins, std::vector<ShapePair>& ends) {
    begins.clear(), ends.clear();
    if (std::equal(now.begin(), now.end(), touching.begin(), touching.end())) return;  // as in most steps of what rests
    order(now);
    auto n = now.begin();
    auto t = touching.begin();
    while (n != now.end() || t != touching.end())
        if (n != now.end() && t != touching.end() && *n == *t)
            ++n, ++t;
        else if (t == touching.end() || (n != now.end() && before(*n, *t)))
            begins.push_back(*n++);
        else
            ends.push_back(*t++);
    touching.assign(now.begin(), now.end());
}

/// Some are pressed only by what relaxes a substep at its end.
Scratch<ShapePair> touched(const LargeArray<SoftContact>& contacts) {
    Scratch<ShapePair> pairs;
    pairs.reserve(contacts.size());
    for (const SoftContact& c : contacts)
        if (c.touched || c.normal_force[0] > 0 || c.normal_force[1] > 0) pairs.push_back(c.shapes());
    return pairs;
}

/// The same, where it is not known of those of sleepers either.
void follow_all(std::vector<ShapePair>& touching, std::vector<ShapePair>& at_rest, Scratch<ShapePair> now,
                Scratch<ShapePair> now_at_rest, StepEvents& events) {
    const auto joined = [](const auto& some, const auto& others) {
        Scratch<ShapePair> all;
        all.reserve(some.size() + others.size());
        std::merge(some.begin(), some.end(), others.begin(), others.end(), std::back_inserter(all), before);
        return all;
    };
    order(now), order(now_at_rest);
    Scratch<ShapePair> all = joined(touching, at_rest);
    follow(all, joined(now, now_at_rest), events.begins, events.ends);
    touching.assign(now.begin(), now.end()), at_rest.assign(now_at_rest.begin(), now_at_rest.end());
}

bool is_among(const std::vector<ShapePair>& pairs, const ShapePair& pair) {
    return std::binary_search(pairs.begin(), pairs.end(), pair, before);
}

/// What sensors overlap. They see fixed bodies too, whether they move themselves or not, but no other sensors.
Scratch<ShapePair> seen(const PlacedPieces& all, Sweep& sweep) {
    constexpr std::size_t few = 128;  // where all is strewn about one asks an eighth of all boxes, a sweep sorts all
    const auto sensors = all.places.sensors();
    Scratch<ShapePair> pairs;
    const auto look = [&](std::size_t s, std::size_t other) {
        if (all[other].sensor || all[s].row == all[other].row || !may_meet(all[s].filter, all[other].filter)) return;
        if (closest_points(all[s].outline, all.frame(s), all[other].outline, all.frame(other)).distance <= 0)
            pairs.push_back({all.shape(s), all.shape(other)});
    };
    if (sensors.size() <= few) {
        for (const std::size_t s : sensors)
            all.places.each([&](const Aabb& box) { return overlap(box, all.bounds(s)); },
                            [&](std::size_t other) { look(s, other); });
        return pairs;
    }
    Scratch<bool> is_sensor(all.pieces.size());
    for (const std::size_t s : sensors) is_sensor[s] = true;
    for (const BoxPair pair : sweep.pairs(all.places.bounds(), is_sensor))
        is_sensor[pair.a] ? look(pair.a, pair.b) : look(pair.b, pair.a);
    return pairs;
}

/// Whether neither the body is gone nor, where it is another one now, the shape.
bool is_there(const ShapeId& id, const Bodies& bodies) {
    return bodies.contains(id.body) && id.shape < std::max<std::size_t>(1, bodies.shapes[bodies.row(id.body)].size());
}

}  // namespace

/// Pairs at removed walls keep their numbers, and so end.
void World::State::renumber_walls(std::size_t first, std::size_t removed, std::size_t added) {
    const auto number = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
    soft_contacts.renumber_walls(number(first), number(removed), number(added));
    for (auto* pairs : {&touching, &touching_at_rest}) {
        for (ShapePair& pair : *pairs)
            if (pair.at_wall() && pair.a.shape >= first + removed)
                pair.a.shape = number(pair.a.shape - removed + added);
        std::sort(pairs->begin(), pairs->end(), before);
    }
}

void World::State::note_events() {
    events.impacts.clear();
    events.sleeps.clear(), events.wakes.clear();
    const bool soft = is_soft();
    if (soft) {
        events.sleeps = soft_contacts.events.sleeps, events.wakes = soft_contacts.events.wakes;
        events.impacts = soft_contacts.events.bounces;
        for (const Impact& impact : soft_contacts.events.landings)
            if (!is_among(touching, impact.shapes) && !is_among(touching_at_rest, impact.shapes))
                events.impacts.push_back(impact);
        std::sort(events.impacts.begin(), events.impacts.end(), [](const Impact& a, const Impact& b) {
            return a.time < b.time || (a.time == b.time && before(a.shapes, b.shapes));
        });
    }
    Scratch<ShapePair> now = soft ? touched(soft_contacts.all) : Scratch<ShapePair>{};
    const bool rest_is_new = !soft || soft_contacts.rest.is_new;
    if (rest_is_new)
        follow_all(touching, touching_at_rest, now, soft ? touched(soft_contacts.rest.contacts) : Scratch<ShapePair>{},
                   events);
    else
        follow(touching, std::move(now), events.begins, events.ends);
    events.sensor_begins.clear(), events.sensor_ends.clear();
    if (!rest_is_new && soft_contacts.rest.moving.empty()) return;  // sensors see what they saw
    follow(sensed, any_sensor ? seen(placed_pieces(), sensor_sweep) : Scratch<ShapePair>{}, events.sensor_begins,
           events.sensor_ends);
}

void World::State::add_points(const SoftContact& c, std::vector<ContactPoint>& points) const {
    const ShapePair shapes = c.shapes();
    const bool a_is_there = c.at_wall ? c.shape_a != SoftContact::no_shape : is_there(shapes.a, bodies);
    if (!a_is_there || !is_there(shapes.b, bodies)) return;
    const Vec2 b = soft_contacts.motion.frames[c.b].position;  // as the step left it
    for (int i = 0; i < c.manifold.count; ++i)
        if (c.normal_force[i] > 0)
            points.push_back({shapes, point_of(c, i, b), c.manifold.normal, c.normal_force[i], c.tangent_force[i]});
}

std::vector<ContactPoint> World::State::contact_points() const {
    std::vector<ContactPoint> points;
    if (!is_soft()) return points;
    for (const auto* list : {&soft_contacts.all, &soft_contacts.rest.contacts})
        for (const SoftContact& c : *list) add_points(c, points);
    return points;
}

std::vector<ContactPoint> World::State::contact_points(BodyId of) {
    std::vector<ContactPoint> points;
    if (!is_soft()) return points;
    const auto &all = soft_contacts.all, &at_rest = soft_contacts.rest.contacts;
    const auto each_end = [&](const auto& act) {
        std::uint32_t place = 0;
        for (const auto* list : {&all, &at_rest})
            for (const SoftContact& c : *list) {
                if (!c.at_wall) act(place, c.key.a.index);
                act(place++, c.key.b.index);
            }
    };
    for (const std::uint32_t k : soft_contacts.places.of(of.index, each_end)) {
        const SoftContact& c = k < all.size() ? all[k] : at_rest[k - all.size()];
        if ((!c.at_wall && c.key.a == of) || c.key.b == of) add_points(c, points);
    }
    if (at_work.now)
        soft_contacts.places.forget();  // in a step they change, from one question of a force's to the next
    return points;
}

std::vector<ContactPoint> World::contacts() const { return state_->contact_points(); }
std::vector<ContactPoint> World::contacts(BodyId id) const {
    state_->bodies.row(id);
    return state_->contact_points(id);
}

const StepEvents& World::events() const { return state_->events; }

}  // namespace carom
