// Which islands are asked whether they can stand as they are: those in which nothing moves, or hardly.

#include <algorithm>

#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/statics.hpp"
#include "threads/parallel.hpp"

namespace carom {

namespace {

/// An island that leans on something, and of which nobody moves, or hardly.
struct Still {
    Scratch<std::uint32_t> bodies, contacts;
    Scratch<Mechanism*> mechanisms;
    bool stands = false;
    std::size_t work = 0;
};

/// What is known of an island.
struct Sight {
    bool stirs = false;   ///< something may move it at any time
    bool moves = false;   ///< somebody does, however slowly
    bool is_new = false;  ///< some were put there, and did not come to rest by themselves
    bool is_calm = true;  ///< all have been slow for a while
    bool is_still = true;
    bool stands = true;  ///< it was found to, and nothing has changed since

    /// Whether it is worth looking at: bodies that are to stay where they were put, or that hardly move any more. Where
    /// they sleep they do so without being asked once they are still; else that is when to ask.
    bool is_worth(bool sleeps) const {
        const bool has_settled = sleeps ? moves : !is_new;
        return !stirs && !stands && (has_settled ? is_calm && is_still != sleeps : is_new && !moves);
    }
};

/// Whether any body is new or calm: where all move nothing else is looked at.
bool any_may_stand(const SoftScene& scene, const Rest& rest) {
    bool any = false;
    rest.each_row_looked_at([&](std::size_t i) {
        const bool may = rest.is_edited(i) || rest.calm[i] >= time_to_sleep;
        any = any || (may && moves(scene, static_cast<std::uint32_t>(i)));
    });
    return any;
}

/// For how long [s] bodies that were calm before have to be at rest: longer than springs of contacts need to turn back.
double time_at_rest(const SoftScene& scene) {
    constexpr double of_calm = 0.2;
    return scene.sleeps ? time_to_sleep : of_calm * time_to_sleep;
}

/// By the first body of an island.
Scratch<Sight> look_at_islands(const SoftScene& scene, const Scratch<std::uint32_t>& first, const State& state,
                               const Rest& rest) {
    Scratch<Sight> islands(first.size());
    const double time = time_at_rest(scene);
    rest.each_row_looked_at([&](std::size_t row) {
        const auto i = static_cast<std::uint32_t>(row);
        if (!moves(scene, i)) return;
        Sight& island = islands[first[i]];
        island.stirs = island.stirs || !scene.may_rest[i];
        island.moves = island.moves || state.v.linear[i] != Vec2{} || state.v.angular[i] != 0;
        island.is_new = island.is_new || rest.is_edited(i);
        island.is_calm = island.is_calm && rest.calm[i] >= time_to_sleep;
        island.is_still = island.is_still && rest.still[i] >= time;
        island.stands = island.stands && rest.still[i] == carom::stands;
    });
    return islands;
}

/// Calls act(mechanism, first body of its island) for those that are awake.
template <class Act>
void each_mechanism(const SoftScene& scene, const Scratch<std::uint32_t>& first, const Rest& rest, const Act& act) {
    for (Mechanism& m : scene.mechanisms.all) {
        if (is_left_out(rest, m)) continue;
        if (const std::uint32_t row = first_moving(scene, m); row != no_place) act(m, first[row]);
    }
}

/// Those that are worth looking at and lean on something or hang on it, by the first body of each.
Scratch<std::uint32_t> number_still(const SoftScene& scene, const Scratch<std::uint32_t>& first, Scratch<Sight> sights,
                                    const Motion& velocity, const SoftContacts& contacts, Scratch<Still>& islands) {
    const auto is_worth = [&](const Sight& s) { return s.is_worth(scene.sleeps); };
    Scratch<std::uint32_t> number(first.size(), no_place);
    if (std::none_of(sights.begin(), sights.end(), is_worth)) return number;
    for (std::size_t i = 0; i < contacts.all.size(); ++i)
        if (Sight& sight = sights[first_of(scene, first, contacts.ends[i])]; is_worth(sight))
            sight.stirs = keeps_awake(scene, velocity, contacts.all[i]);
    each_mechanism(scene, first, contacts.rest, [&](const Mechanism& m, std::uint32_t f) {
        sights[f].stirs = sights[f].stirs || keeps_awake(scene, velocity, m);
    });
    const auto add = [&](std::uint32_t f) {
        if (!is_worth(sights[f]) || number[f] != no_place) return;
        number[f] = static_cast<std::uint32_t>(islands.size());
        islands.emplace_back();
    };
    for (const ContactEnds& c : contacts.ends)
        if (!moves(scene, c.a) || !moves(scene, c.b)) add(first_of(scene, first, c));
    each_mechanism(scene, first, contacts.rest, [&](const Mechanism& m, std::uint32_t f) {
        if (std::any_of(m.members.begin(), m.members.end(), [](const Member& k) { return k.outside; })) add(f);
    });
    return number;
}

/// Those islands with their bodies, contacts and mechanisms; and the place of each body in its own.
Scratch<Still> find_still(const SoftScene& scene, const Scratch<std::uint32_t>& first, const State& state,
                          const SoftContacts& contacts, Scratch<std::uint32_t>& place) {
    Scratch<Still> islands;
    const Scratch<std::uint32_t> number =
        number_still(scene, first, look_at_islands(scene, first, state, contacts.rest), state.v, contacts, islands);
    if (islands.empty()) return islands;
    const auto each_row = [&](const auto& act) { contacts.rest.each_row_looked_at(act); };
    list_islands(scene, first, number, contacts, each_row, islands, place);
    each_mechanism(scene, first, contacts.rest, [&](Mechanism& m, std::uint32_t f) {
        if (number[f] != no_place) islands[number[f]].mechanisms.push_back(&m);
    });
    // What a large one costs is to be earned back before the next is looked at.
    constexpr std::size_t small = 500, most = 10000;  // bodies
    std::erase_if(islands,
                  [&](const Still& island) { return island.bodies.size() > (contacts.rest.owed > 0 ? small : most); });
    return islands;
}

Scratch<double> velocities(const Still& island, const State& state) {
    Scratch<double> v;
    for (const std::uint32_t row : island.bodies)
        for (const double speed : {state.v.linear[row].x, state.v.linear[row].y, state.v.angular[row]})
            v.push_back(speed);
    return v;
}

/// How fast [m/s] what moves freely may be where an island stands: not faster than what sleeps, and where nobody does
/// hardly at all.
double fastest_free(const SoftScene& scene, const Statics& statics, const Scratch<double>& velocities, double dt) {
    constexpr double hardly = 0.01;  // of the velocities that there are
    return scene.sleeps ? speed_at_rest(scene, dt) : hardly * statics.fastest(velocities);
}

}  // namespace

void earn(const SoftScene& scene, SoftContacts& contacts) {
    constexpr double earned = 30;  // products of blocks a contact or joint
    const auto all =
        static_cast<double>(contacts.warm.size() + contacts.rest.warm.size() + scene.mechanisms.joints.size());
    contacts.rest.owed = std::max(contacts.rest.owed - earned * all, 0.0);
}

void find_standing(const SoftScene& scene, const Scratch<std::uint32_t>& first, double dt, double h, const State& state,
                   SoftContacts& contacts) {
    if (!scene.statics || contacts.outlook.midway || !any_may_stand(scene, contacts.rest)) return;
    Scratch<std::uint32_t> place(contacts.motion.movers.size(), no_place);
    Scratch<Still> islands = find_still(scene, first, state, contacts, place);
    if (islands.empty()) return;
    State& at_rest = contacts.motion.proposed;  // storage, of which every substep writes what moves
    at_rest = state;
    std::fill(at_rest.v.linear.begin(), at_rest.v.linear.end(), Vec2{});
    std::fill(at_rest.v.angular.begin(), at_rest.v.angular.end(), 0.0);
    scene.flight.dynamics.evaluate(at_rest, contacts.motion.rates, nullptr);
    parallel_ranges(scene.threads, islands.size(), 1, [&](std::size_t from, std::size_t to) {
        Statics::Springs springs;
        for (std::size_t k = from; k < to; ++k) {
            Still& island = islands[k];
            Statics statics(scene, contacts, island.bodies, island.contacts.size(), springs);
            for (const std::uint32_t i : island.contacts) {
                SoftContact& c = contacts.all[i];
                statics.add(c, place[c.a], place[c.b]);
            }
            const bool hold = std::all_of(island.mechanisms.begin(), island.mechanisms.end(),
                                          [&](const Mechanism* m) { return statics.add(*m, state, place); });
            const bool is_new = std::any_of(island.bodies.begin(), island.bodies.end(),
                                            [&](std::uint32_t row) { return contacts.rest.is_edited(row); });
            const Scratch<double> v = velocities(island, state);
            island.stands = hold && statics.find_forces() && (!is_new || statics.explains_overlaps(h)) &&
                            statics.can_stop(v, fastest_free(scene, statics, v, dt), dt);
            island.work = statics.work();
            if (island.stands) statics.write_forces();
        }
    });
    for (const Still& island : islands) {
        contacts.rest.owed += static_cast<double>(island.work);
        for (const std::uint32_t row : island.bodies)
            island.stands ? contacts.rest.still[row] = stands : contacts.rest.calm[row] = 0;
        for (Mechanism* m : island.mechanisms)
            if (island.stands) m->prepared = 0;  // its joints bear other forces now
    }
}

}  // namespace carom
