#include "solvers/islands.hpp"

#include <algorithm>
#include <numeric>

#include "solvers/mechanism.hpp"

namespace carom {

namespace {
constexpr std::uint32_t none = 0xffffffff;

/// Of some rows, which `each_row` calls its argument for, with the contacts and mechanisms among them.
template <class Contacts, class EachRow, class IsOne>
Scratch<std::uint32_t> firsts(const SoftScene& scene, const Contacts& contacts, EachRow each_row, IsOne is_one) {
    Scratch<std::uint32_t> root(scene.bodies.size());
    std::iota(root.begin(), root.end(), 0U);  // of the others too, who may move with these from now on
    const auto find = [&root](std::uint32_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (const auto& c : contacts) {
        if (!moves(scene, c.a) || !moves(scene, c.b)) continue;
        const std::uint32_t a = find(c.a), b = find(c.b);
        root[std::max(a, b)] = std::min(a, b);
    }
    for (const Mechanism& m : scene.mechanisms.all) {
        if (!is_one(m)) continue;
        std::uint32_t first = none;
        for (const Mechanism::Part& p : m.parts) {
            if (!moves(scene, p.row)) continue;
            const std::uint32_t i = find(p.row);
            first = first == none ? i : std::min(first, i);
        }
        for (const Mechanism::Part& p : m.parts)
            if (moves(scene, p.row)) root[find(p.row)] = first;
    }
    each_row([&](std::size_t i) { root[i] = find(static_cast<std::uint32_t>(i)); });
    return root;
}

}  // namespace

std::uint32_t first_moving(const SoftScene& scene, const Mechanism& m) {
    const auto moving =
        std::find_if(m.parts.begin(), m.parts.end(), [&](const auto& p) { return moves(scene, p.row); });
    return moving == m.parts.end() ? no_place : moving->row;
}

Scratch<std::uint32_t> firsts_of_islands(const SoftScene& scene, const SoftContacts& contacts) {
    return firsts(
        scene, contacts.ends, [&](const auto& act) { contacts.rest.each_row_looked_at(act); },
        [&](const Mechanism& m) { return !is_left_out(contacts.rest, m); });
}

Scratch<std::uint32_t> firsts_of_resting(const SoftScene& scene, const SoftContacts& contacts) {
    const auto each_row = [&](const auto& act) {
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) act(i);
    };
    return firsts(scene, contacts.rest.contacts, each_row, [](const Mechanism& m) { return m.is_asleep; });
}

namespace {

/// What precise solves may cost that take long and that nobody asked for, in steps that win it back.
constexpr std::uint16_t patience = 600;
constexpr std::size_t most_bodies = 100, most_unasked = 20, most_deep = 200, very_few = 4;

/// Why an island would be solved precisely.
enum class Reason { no, asked, deep };

/// What an island is like. Only those that are solved precisely are listed body by body: there may be thousands.
struct Census {
    std::size_t bodies = 0;
    bool joined = false;  ///< joints hold some of them
    bool yields = false;  ///< by joints that may give way, or do not hold as masses say
    bool hard = false, uneven = false, deep = false;
    bool jammed[2]{};  ///< while all its contacts were even, and while not

    /// Whether it may be worth it, as far as its bodies tell.
    bool may_be() const { return bodies <= (joined ? most_unasked : most_bodies) && !yields; }
};

void look_at(const SoftContact& c, Census& island) {
    const bool hard = c.is_hard, uneven = hard || c.thickness < thin * c.size;
    island.hard |= hard, island.uneven |= uneven;
    for (int k = 0; k < 2; ++k) island.jammed[k] |= c.jammed[k] > patience;
    // What was solved precisely stays so until its load is half: else it is in one step, and sinks in the next.
    island.deep = island.deep || c.load.presses_deep((c.was_precise ? 0.5e-3 : 1e-3) * c.thickness);
}

/// What speaks for it, where `bodies` touch something in the whole world.
Reason reason_for(const Census& island, std::size_t bodies, const SoftScene& scene) {
    if (!island.may_be()) return Reason::no;
    if (scene.precise == Precise::all) return Reason::asked;
    // Sweeps end short of what a block on a wedge or two blocks and a floor do to one another.
    const bool alone = island.bodies <= (island.joined ? 1 : very_few) && bodies <= most_unasked;
    const bool asked = alone || (island.bodies <= most_unasked && island.hard);
    // A load on what was jammed without it is tried all the same.
    if ((!asked && !island.deep) || island.jammed[island.uneven]) return Reason::no;
    return asked ? Reason::asked : Reason::deep;
}

/// Those that are worth it. Loads that press deep are worth it in a small world: in a large one substeps do.
Scratch<Reason> choose(const Scratch<Census>& islands, const SoftScene& scene) {
    std::size_t bodies = 0, deep = 0;
    for (const Census& island : islands) bodies += island.bodies;
    Scratch<Reason> reasons;
    for (const Census& island : islands) {
        reasons.push_back(reason_for(island, bodies, scene));
        if (reasons.back() == Reason::deep) deep += island.bodies;
    }
    if (deep > most_deep) std::replace(reasons.begin(), reasons.end(), Reason::deep, Reason::no);
    return reasons;
}

/// Which island each body is in, by row: of those that touch something.
struct IslandNumbers {
    const SoftScene& scene;
    const Scratch<std::uint32_t>& root;
    Scratch<std::uint32_t> by_root;

    std::uint32_t& of(std::uint32_t row) { return by_root[root[row]]; }
    template <class Contact>
    std::uint32_t& of(const Contact& c) {
        return by_root[first_of(scene, root, c)];
    }
};

/// Whether nothing but rigid joints holds a mechanism, and in the substep before did by impulses: what zig-zags too
/// fast, or is taut across its pull, moves otherwise.
bool is_kept(const Mechanisms& all, const Mechanism& m) {
    const JointMemory& memory = all.memory[m.members[0].joint];
    return m.is_simple && !memory.was_slow && memory.projections == 0;
}

Scratch<Census> count(IslandNumbers& number, const SoftContacts& contacts) {
    const SoftScene& scene = number.scene;
    Scratch<Census> islands;
    for (const ContactEnds& c : contacts.ends) {
        std::uint32_t& island = number.of(c);
        if (island != none) continue;
        island = static_cast<std::uint32_t>(islands.size());
        islands.emplace_back();
    }
    contacts.rest.moving.each_row([&](std::size_t row) {
        const auto i = static_cast<std::uint32_t>(row);
        if (!moves(scene, i) || number.of(i) == none) return;
        Census& island = islands[number.of(i)];
        ++island.bodies, island.joined |= scene.mechanisms.holds[i];
    });
    for (const Mechanism& m : scene.mechanisms.all) {
        const std::uint32_t first = first_moving(scene, m);
        if (is_kept(scene.mechanisms, m) || first == no_place || number.of(first) == none) continue;
        islands[number.of(first)].yields = true;
    }
    const bool any = std::any_of(islands.begin(), islands.end(), [](const Census& island) { return island.may_be(); });
    if (!any || scene.precise == Precise::all) return islands;
    for (std::size_t i = 0; i < contacts.all.size(); ++i)
        if (Census& island = islands[number.of(contacts.ends[i])]; island.may_be()) look_at(contacts.all[i], island);
    return islands;
}

/// Of islands whose numbers are their places now.
void list_mechanisms(IslandNumbers& number, PreciseIslands& found) {
    const SoftScene& scene = number.scene;
    for (std::uint32_t k = 0; k < scene.mechanisms.all.size(); ++k) {
        const std::uint32_t first = first_moving(scene, scene.mechanisms.all[k]);
        const std::uint32_t place = first == no_place ? no_place : number.of(first);
        if (place != no_place) found.all[place].mechanisms.push_back(k);
    }
}

/// Prepares the matrix of an island for the bodies that are coupled.
void analyse(const SoftScene& scene, const SoftContacts& contacts, const PreciseIslands& islands, Island& island) {
    Scratch<std::pair<std::uint32_t, std::uint32_t>> couplings;
    const auto couple = [&](std::uint32_t a, std::uint32_t b) {
        if (moves(scene, a) && moves(scene, b)) couplings.emplace_back(islands.place[a], islands.place[b]);
    };
    for (const std::uint32_t index : island.contacts) couple(contacts.all[index].a, contacts.all[index].b);
    for (const std::uint32_t k : island.mechanisms) {
        const Mechanism& m = scene.mechanisms.all[k];
        for (const Member& joint : m.members) couple(m.parts[joint.a].row, m.parts[joint.b].row);
    }
    island.matrix.analyse(island.bodies.size(), couplings);
}

}  // namespace

PreciseIslands find_precise_islands(const SoftScene& scene, const Scratch<std::uint32_t>& root,
                                    const SoftContacts& contacts) {
    if (scene.precise == Precise::never) return {};
    IslandNumbers number{scene, root, Scratch<std::uint32_t>(root.size(), none)};
    const Scratch<Census> islands = count(number, contacts);
    const Scratch<Reason> reasons = choose(islands, scene);
    Scratch<std::uint32_t> place(islands.size(), none);
    PreciseIslands found;
    for (std::size_t k = 0; k < islands.size(); ++k) {
        if (reasons[k] == Reason::no) continue;
        place[k] = static_cast<std::uint32_t>(found.all.size());
        Island& island = found.all.emplace_back();
        island.asked = reasons[k] == Reason::asked, island.uneven = islands[k].uneven;
    }
    if (found.all.empty()) return found;
    for (std::uint32_t& k : number.by_root) k = k == none ? no_place : place[k];
    found.place.assign(root.size(), no_place);
    const auto each_row = [&](const auto& act) { contacts.rest.moving.each_row(act); };
    list_islands(scene, root, number.by_root, contacts, each_row, found.all, found.place);
    list_mechanisms(number, found);
    for (Island& island : found.all) analyse(scene, contacts, found, island);
    return found;
}

Island* PreciseIslands::one_for(const SoftScene& scene, const SoftContact& c) {
    const auto island_of = [&](std::uint32_t row) {
        return std::find_if(all.begin(), all.end(), [&](const Island& island) {
            return place_of(row) < island.bodies.size() && island.bodies[place_of(row)] == row;
        });
    };
    const auto first = island_of(moves(scene, c.a) ? c.a : c.b);
    if (first == all.end() || (moves(scene, c.a) && moves(scene, c.b) && island_of(c.b) != first)) return nullptr;
    return &*first;
}

Scratch<double> velocities_at_rest(const Island& island, const PreciseIslands& islands, const SoftContacts& contacts) {
    Scratch<double> v(3 * island.bodies.size(), 0.0);
    std::uint32_t holder = no_place;
    const auto& movers = contacts.motion.movers;
    const auto moves_with_others = [&](std::uint32_t row) {
        if (holder == no_place) holder = row;
        const Mover &m = movers[row], &other = movers[holder];
        return row == holder || (m.vx == other.vx && m.vy == other.vy && m.w == 0 && other.w == 0);
    };
    for (const std::uint32_t index : island.contacts)
        for (const std::uint32_t row : {contacts.all[index].a, contacts.all[index].b})
            if (islands.place_of(row) == no_place && !moves_with_others(row)) return v;
    if (holder == no_place) return v;
    const Mover& m = movers[holder];
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
        const Vec2 from = contacts.motion.frames[island.bodies[i]].position - contacts.motion.frames[holder].position;
        const Vec2 along = Vec2{m.vx, m.vy} + cross(m.w, from);
        v[3 * i] = along.x, v[3 * i + 1] = along.y, v[3 * i + 2] = m.w;
    }
    return v;
}

void take_precisely(const SoftScene& scene, std::size_t from, PreciseIslands& islands, SoftContacts& contacts) {
    bool takes = false;
    for (std::size_t i = from; i < contacts.all.size(); ++i)
        if (Island* const island = islands.one_for(scene, contacts.all[i])) {
            takes = true;
            island->contacts.push_back(static_cast<std::uint32_t>(i));
            analyse(scene, contacts, islands, *island);
        }
    if (takes) note_precise(islands, contacts);
}

void note_precise(const PreciseIslands& islands, SoftContacts& contacts) {
    if (islands.all.empty()) return;  // blocks are filled as those that sweeps solve
    for (ContactBlock& block : contacts.layout.blocks) block.is_precise = true;
    for (SoftContact& c : contacts.all) {
        c.precise = islands.hold(c);
        ContactBlock& block = contacts.layout.blocks[c.block];
        block.is_precise &= c.precise, block.any_precise |= c.precise, block.is_idle &= !c.precise;
    }
}

namespace {

/// What a step costs in which an interior point was needed for what moves on. Sweeps cope with even ones, and where
/// something is so fast that it crashes they spread that.
std::uint16_t cost_of(const Island& island, const SoftContacts& contacts) {
    constexpr double a_little = 0.02;  // of the thinnest in a substep
    const auto is_slow_for = [&](std::uint32_t index) {
        return contacts.pace.lasted * island.fastest <= a_little * contacts.all[index].thickness;
    };
    const bool is_slow = std::all_of(island.contacts.begin(), island.contacts.end(), is_slow_for);
    const auto bodies = static_cast<int>(island.bodies.size());
    const int of_uneven = std::max(5, bodies / 10) * (is_slow ? 1 : 4);
    const int of_even = is_slow ? std::max(5, 2 * bodies) : patience / 2;
    return static_cast<std::uint16_t>(island.uneven ? of_uneven : of_even);
}

/// Steps for which sweeps have what no solution was found for, or is dear.
constexpr std::uint16_t a_while = 600;

}  // namespace

void leave_given_up(const PreciseIslands& islands, SoftContacts& contacts) {
    for (const Island& island : islands.all) {
        if (!island.gave_up) continue;
        for (const std::uint32_t index : island.contacts)
            contacts.all[index].jammed[island.uneven] = patience + a_while;
    }
}

void rest_jammed(const PreciseIslands& islands, SoftContacts& contacts) {
    constexpr std::uint16_t long_after = 6000;  // steps, of what sweeps do too
    for (const Island& island : islands.all) {
        const std::uint16_t cost = !island.asked && island.took_long ? cost_of(island, contacts) : 0;
        const bool sweeps_do = !island.uneven;
        for (const std::uint32_t index : island.contacts) {
            std::uint16_t& jammed = contacts.all[index].jammed[island.uneven];
            jammed += cost;
            if (jammed > patience) jammed = patience + (sweeps_do ? long_after : a_while);
        }
    }
    leave_given_up(islands, contacts);
}

}  // namespace carom
