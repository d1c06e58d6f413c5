#include "solvers/islands.hpp"

#include <algorithm>
#include <numeric>

#include "solvers/mechanism.hpp"

namespace carom {

namespace {
constexpr std::uint32_t none = 0xffffffff;

/// Of some rows, which `each_row` calls its argument for, with the contacts and mechanisms among them.
template <class EachRow, class IsOne>
Scratch<std::uint32_t> firsts(const SoftScene& scene, const std::vector<SoftContact>& contacts, EachRow each_row,
                              IsOne is_one) {
    Scratch<std::uint32_t> root(scene.bodies.size());
    std::iota(root.begin(), root.end(), 0U);  // of the others too, who may move with these from now on
    const auto find = [&root](std::uint32_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (const SoftContact& c : contacts) {
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

Scratch<std::uint32_t> firsts_of_islands(const SoftScene& scene, const SoftContacts& contacts) {
    return firsts(
        scene, contacts.all, [&](const auto& act) { each_row_looked_at(contacts, act); },
        [&](const Mechanism& m) { return !is_left_out(contacts, m); });
}

Scratch<std::uint32_t> firsts_of_resting(const SoftScene& scene, const SoftContacts& contacts) {
    const auto each_row = [&](const auto& act) {
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) act(i);
    };
    return firsts(scene, contacts.resting, each_row, [](const Mechanism& m) { return m.is_asleep; });
}

namespace {

constexpr std::size_t most_bodies = 100, most_unasked = 20, most_deep = 200;

/// Why an island would be solved precisely.
enum class Reason { no, asked, deep };

/// What speaks for it, where `bodies` touch something in the whole world.
Reason reason_for(Island& island, std::size_t bodies, const SoftScene& scene, double h, const SoftContacts& contacts) {
    const auto is_joined = [&](std::uint32_t row) { return scene.mechanisms.holds[row]; };
    if (island.bodies.size() > most_bodies || std::any_of(island.bodies.begin(), island.bodies.end(), is_joined))
        return Reason::no;
    if (scene.precise) return Reason::asked;
    const auto any = [&](auto is) {
        return std::any_of(island.contacts.begin(), island.contacts.end(),
                           [&](std::uint32_t index) { return is(contacts.all[index]); });
    };
    const auto is_uneven = [&](const SoftContact& c) { return is_hard(scene, c) || c.thickness < thin * c.size; };
    const bool alone = island.bodies.size() == 1 && bodies <= most_unasked;
    const bool few = island.bodies.size() <= most_unasked;
    const bool asked = alone || (few && any([&](const SoftContact& c) { return is_hard(scene, c); }));
    if (!asked && !any([&](const SoftContact& c) { return presses_deep(scene, c, contacts, h, 1e-3 * c.thickness); }))
        return Reason::no;
    island.uneven = any(is_uneven);
    // A load on what was jammed before is tried all the same.
    const auto is_left = [&](const SoftContact& c) { return c.jammed > patience && is_uneven(c) == island.uneven; };
    return any(is_left) ? Reason::no : asked ? Reason::asked : Reason::deep;
}

/// Leaves those that are worth it. Loads that press deep are worth it in a small world: in a large one substeps do.
void choose(Scratch<Island>& islands, const SoftScene& scene, double h, const SoftContacts& contacts) {
    std::size_t bodies = 0, deep = 0;
    for (const Island& island : islands) bodies += island.bodies.size();
    Scratch<Reason> reasons;
    for (Island& island : islands) {
        reasons.push_back(reason_for(island, bodies, scene, h, contacts));
        if (reasons.back() == Reason::deep) deep += island.bodies.size();
    }
    auto reason = reasons.begin();
    std::erase_if(islands, [&](Island& island) {
        const Reason its = *reason++;
        island.asked = its == Reason::asked;
        return its == Reason::no || (its == Reason::deep && deep > most_deep);
    });
}

}  // namespace

PreciseIslands find_precise_islands(const SoftScene& scene, double h, const Scratch<std::uint32_t>& root,
                                    const SoftContacts& contacts) {
    Scratch<std::uint32_t> island_of(root.size(), none);
    PreciseIslands found;
    for (std::uint32_t i = 0; i < contacts.all.size(); ++i) {
        const SoftContact& c = contacts.all[i];
        std::uint32_t& island = island_of[root[moves(scene, c.a) ? c.a : c.b]];
        if (island == none) {
            island = static_cast<std::uint32_t>(found.all.size());
            found.all.emplace_back();
        }
        found.all[island].contacts.push_back(i);
    }
    contacts.moving.each_row([&](std::size_t row) {
        const auto i = static_cast<std::uint32_t>(row);
        if (moves(scene, i) && island_of[root[i]] != none) found.all[island_of[root[i]]].bodies.push_back(i);
    });
    choose(found.all, scene, h, contacts);
    found.place.assign(root.size(), no_place);
    for (Island& island : found.all) {
        for (std::uint32_t i = 0; i < island.bodies.size(); ++i) found.place[island.bodies[i]] = i;
        Scratch<std::pair<std::uint32_t, std::uint32_t>> couplings;
        for (const std::uint32_t index : island.contacts) {
            const SoftContact& c = contacts.all[index];
            if (moves(scene, c.a) && moves(scene, c.b)) couplings.emplace_back(found.place[c.a], found.place[c.b]);
        }
        island.matrix.analyse(island.bodies.size(), couplings);
    }
    return found;
}

void note_precise(const PreciseIslands& islands, SoftContacts& contacts) {
    for (ContactBlock& block : contacts.blocks) block.is_precise = !islands.all.empty();
    for (const SoftContact& c : contacts.all) contacts.blocks[c.block].is_precise &= islands.hold(c);
}

void rest_jammed(const PreciseIslands& islands, SoftContacts& contacts) {
    constexpr std::uint16_t a_while = 600;
    for (SoftContact& c : contacts.all)
        if (c.jammed > 0) --c.jammed;
    for (const Island& island : islands.all) {
        const std::uint16_t cost = island.asked || !island.took_long ? 0 : island.uneven ? dear : too_dear;
        for (const std::uint32_t index : island.contacts) {
            std::uint16_t& jammed = contacts.all[index].jammed;
            jammed += cost;
            if (island.gave_up || jammed > patience) jammed = patience + a_while;
        }
    }
}

}  // namespace carom
