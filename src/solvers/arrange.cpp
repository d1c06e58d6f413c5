// In which lane of which block a contact is solved, and which stages have a part for it.

#include <algorithm>
#include <array>
#include <bit>

#include "math/scratch.hpp"
#include "simd/prefetch.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/soft_step.hpp"
#include "threads/parallel.hpp"

namespace carom {

namespace {

/// How contacts are solved by the flags of their block.
void note_kinds(const SoftScene& scene, const SoftContact& c, ContactBlock& block) {
    block.any_held |= !moves(scene, c.a) || !moves(scene, c.b);
    block.any_rolling |= c.rolling > 0;
    block.any_bounce |= is_let_bounce(c);
    block.any_belt |= c.surface_speed != 0;
    block.any_corners |= rounds_a_corner(c);
    block.any_pivots |= c.pivots;
    block.any_preload |= c.preload[0] > 0 || c.preload[1] > 0;
    const auto is_none = [](const double(&of_points)[2]) { return of_points[0] == 0 && of_points[1] == 0; };
    block.is_idle &= is_none(c.normal_force) && is_none(c.tangent_force) && is_none(c.rolling_moment);
}

std::uint8_t role_of(const SoftScene& scene, const SoftContact& c) {
    const auto bit = [](bool is, std::uint8_t role) { return is ? role : std::uint8_t{0}; };
    return bit(is_driven(scene, c.a) || is_driven(scene, c.b), Role::driven) |
           bit(only_shifts(scene, c.a) || only_shifts(scene, c.b), Role::unturned) |
           bit(is_looked_at_anew(c), Role::changing) | bit(may_strike(c), Role::strikes) |
           bit(is_let_bounce(c), Role::bounces) | bit(rounds_a_corner(c), Role::corners);
}

void list_contacts(std::size_t first, SoftContacts& contacts) {
    StageLists& lists = contacts.lists;
    if (first == 0) {
        for (auto* list : {&lists.driven, &lists.unturned, &lists.changing, &lists.strikers}) list->clear();
        lists.any_bounce = lists.any_corners = false;
        contacts.layout.latecomers = contacts.all.size(), contacts.motion.given_fits = false, contacts.by_body.clear();
    }
    for (std::size_t k = first; k < contacts.all.size(); ++k) {
        const std::uint8_t role = lists.roles[k];
        if (role == 0) continue;
        const auto i = static_cast<std::uint32_t>(k);
        if (role & Role::driven) lists.driven.push_back(i);
        if (role & Role::unturned) lists.unturned.push_back(i);
        if (role & Role::changing) lists.changing.push_back(i);
        if (role & Role::strikes) lists.strikers.push_back(i);
        lists.any_bounce |= (role & Role::bounces) != 0;
        lists.any_corners |= (role & Role::corners) != 0;
    }
}

constexpr BlockContacts no_contacts = [] {
    BlockContacts none{};
    none.fill(no_contact);
    return none;
}();
constexpr std::size_t most_colours = 64;
/// Of each colour one list of those of one point, and one of the others; and those that found no colour.
constexpr std::size_t lists = 2 * most_colours + 1;
constexpr bool is_coloured(std::size_t list) { return list < 2 * most_colours; }

/// How many contacts are in a list: those that pressed begin it, and the others end it, so that whole blocks are idle.
struct ListLength {
    std::uint32_t pressed = 0, others = 0;
    std::uint32_t all() const { return pressed + others; }
    std::uint32_t add(bool has_pressed) { return has_pressed ? pressed++ : others++; }
    std::uint32_t place(bool has_pressed, std::uint32_t number) const {
        return has_pressed ? number : all() - 1 - number;
    }
};

/// Gives contacts colours: the list of each one, with c.row its number among those of it that pressed or did not.
std::array<ListLength, lists> colour_contacts(const SoftScene& scene, std::size_t from, SoftContacts& contacts) {
    std::array<ListLength, lists> length{};
    Scratch<std::uint64_t> taken(scene.bodies.size() + 1, 0);
    for (std::size_t i = from; i < contacts.all.size(); ++i) {
        SoftContact& c = contacts.all[i];
        const bool a_moves = moves(scene, c.a), b_moves = moves(scene, c.b);
        const std::uint64_t used = (a_moves ? taken[c.a] : 0) | (b_moves ? taken[c.b] : 0);
        const auto free = static_cast<std::size_t>(std::countr_one(used));
        const bool found = free < most_colours;
        c.block = static_cast<std::uint32_t>(2 * free + (found && !c.is_single));
        c.row = length[c.block].add(c.pressed());
        if (!found) continue;
        if (a_moves) taken[c.a] |= std::uint64_t{1} << free;
        if (b_moves) taken[c.b] |= std::uint64_t{1} << free;
    }
    return length;
}

/// Lays contacts out in blocks that are yet to be filled, behind those that there are unless all are laid out.
void lay_out(const SoftScene& scene, std::size_t from, SoftContacts& contacts) {
    ContactLayout& layout = contacts.layout;
    const auto length = colour_contacts(scene, from, contacts);
    if (from == 0) layout.colours.clear(), layout.solved_in.clear();
    std::size_t end = from == 0 ? 0 : layout.blocks.size();
    std::array<std::uint32_t, lists> first{};  // blocks
    for (std::size_t list = 0; list < lists; ++list) {
        // Those that found no colour are solved one by one.
        const std::size_t width = is_coloured(list) ? block_rows : 1, count = (length[list].all() + width - 1) / width;
        first[list] = static_cast<std::uint32_t>(end), end += count;
        if (count == 0) continue;
        layout.colours.push_back({first[list], count, width == 1});
        if (layout.blocks.size() < end) layout.blocks.resize(end);
        for (std::size_t k = first[list]; k < end; ++k)
            layout.blocks[k].points = is_coloured(list) && list % 2 == 0 ? 1 : 2;
    }
    layout.blocks.resize(end), layout.solved_in.resize(end, no_contacts);
    for (std::size_t i = from; i < contacts.all.size(); ++i) {
        SoftContact& c = contacts.all[i];
        const std::uint32_t list = c.block, place = length[list].place(c.pressed(), c.row);
        const std::uint32_t width = is_coloured(list) ? block_rows : 1;
        c.block = first[list] + place / width, c.row = place % width;
        layout.solved_in[c.block][c.row] = static_cast<std::uint32_t>(i);
    }
}

/// Lays contacts out as those of the search before, if they are of the same bodies and pressed alike.
bool lay_out_again(const LargeArray<ContactEnds>& ends, ContactLayout& layout) {
    const auto& [laid, blocks, colours] = layout.last;
    if (ends != laid) return false;
    layout.blocks.resize(blocks), layout.colours.resize(colours), layout.solved_in.resize(blocks);
    return true;
}

void keep_layout(const LargeArray<ContactEnds>& ends, ContactLayout& layout) {
    auto& [laid, blocks, colours] = layout.last;
    laid = ends, blocks = layout.blocks.size(), colours = layout.colours.size();
}

/// Asks for the contacts of a block: they lie all over.
void fetch_block(std::size_t number, const SoftContacts& contacts) {
    constexpr std::size_t line = 64;
    if (number == contacts.layout.solved_in.size()) return;
    for (const std::uint32_t i : contacts.layout.solved_in[number]) {
        if (i == no_contact) continue;
        const char* const contact = reinterpret_cast<const char*>(&contacts.all[i]);
        for (std::size_t k = 0; k < sizeof(SoftContact); k += line) prefetch(contact + k);
    }
}

/// What of a contact is for the block that it is solved in.
void note_contact(const SoftScene& scene, const SoftContact& c, ContactBlock& block, RowKinds& kinds,
                  ContactLayout::Untouched& untouched) {
    block.a[c.row] = c.a, block.b[c.row] = c.b;
    note_kinds(scene, c, block);
    note_row(c, kinds);
    note_bit(untouched.now, c.row, !c.touched);
    note_bit(untouched.before, c.row, !c.touched && !c.touched_before);
}

/// Writes a block that is laid out: all rows at once if none is left over.
void fill_block(const SoftScene& scene, double h, std::uint32_t number, SoftContacts& contacts) {
    fetch_block(number + 1, contacts);
    ContactBlock& block = contacts.layout.blocks[number];
    const BlockContacts& indices = contacts.layout.solved_in[number];
    const auto each = [&](const auto& act) {
        for (std::uint32_t k = 0; k < block_rows; ++k)
            if (indices[k] != no_contact) act(contacts.all[indices[k]], k);
    };
    const std::uint32_t points = block.points;
    block = ContactBlock{};
    block.points = points, block.is_idle = true;
    std::fill_n(block.a, block_rows, static_cast<std::uint32_t>(scene.bodies.size()));
    std::fill_n(block.b, block_rows, static_cast<std::uint32_t>(scene.bodies.size()));
    auto& untouched = contacts.layout.untouched[number] = {};
    RowKinds kinds;
    each([&](SoftContact& c, std::uint32_t k) {
        c.block = number, c.row = k;
        note_contact(scene, c, block, kinds, untouched);
        contacts.lists.roles[indices[k]] = role_of(scene, c);
    });
    if (indices[block_rows - 1] != no_contact)
        contact_kernel().write_block(row_source(scene.bodies, contacts), indices.data(), kinds, block);
    else
        each([&](SoftContact& c, std::uint32_t) {
            fill_row(scene.bodies, c, contacts.motion.frames[c.a], contacts.motion.frames[c.b], contacts);
        });
    each([&](SoftContact& c, std::uint32_t) { c.load = load_of(scene, c, contacts, h); });
}

}  // namespace

void ContactsOfBodies::list(std::span<const SoftContact> all, std::size_t bodies) {
    if (after_.empty()) of_body_.assign(bodies, {no_contact, no_contact, 0});
    for (auto side = static_cast<std::uint32_t>(after_.size()); side < 2 * all.size(); ++side) {
        after_.push_back(no_contact);
        const SoftContact& c = all[side / 2];
        auto& [first, last, count] = of_body_[side % 2 == 0 ? c.a : c.b];
        (last == no_contact ? first : after_[last]) = side;
        last = side, ++count;
    }
}

void arrange(const SoftScene& scene, double h, std::size_t first, SoftContacts& contacts) {
    ContactLayout& layout = contacts.layout;
    const std::size_t before = first == 0 ? 0 : layout.blocks.size();
    if (first > 0 || !lay_out_again(contacts.ends, layout)) {
        lay_out(scene, first, contacts);
        if (first == 0) keep_layout(contacts.ends, layout);
    }
    layout.untouched.resize(layout.blocks.size()), contacts.lists.roles.resize(contacts.all.size());
    constexpr std::size_t some = 32;
    parallel_ranges(scene.threads, layout.blocks.size() - before, some, [&](std::size_t from, std::size_t to) {
        for (std::size_t k = before + from; k < before + to; ++k)
            fill_block(scene, h, static_cast<std::uint32_t>(k), contacts);
    });
    list_contacts(first, contacts);
    note_touched(scene, contacts);
}

}  // namespace carom
