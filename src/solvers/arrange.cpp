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
}

void list_contacts(const SoftScene& scene, std::size_t first, SoftContacts& contacts) {
    if (first == 0) {
        for (auto* list : {&contacts.driven, &contacts.unturned, &contacts.changing, &contacts.strikers}) list->clear();
        contacts.untouched.clear(), contacts.any_bounce = false;
    }
    contacts.untouched.resize(contacts.blocks.size());
    for (std::size_t k = first; k < contacts.all.size(); ++k) {
        const auto i = static_cast<std::uint32_t>(k);
        const SoftContact& c = contacts.all[i];
        if (is_driven(scene, c.a) || is_driven(scene, c.b)) contacts.driven.push_back(i);
        if (only_shifts(scene, c.a) || only_shifts(scene, c.b)) contacts.unturned.push_back(i);
        if (is_looked_at_anew(c)) contacts.changing.push_back(i);
        if (may_strike(c)) contacts.strikers.push_back(i);
        contacts.any_bounce |= is_let_bounce(c);
        if (c.touched) continue;
        auto& [now, before] = contacts.untouched[c.block];
        const auto bit = static_cast<std::uint8_t>(1U << c.row);
        now |= bit;
        if (!c.touched_before) before |= bit;
    }
    if (first == 0) contacts.latecomers = contacts.all.size(), contacts.given_fits = false, contacts.after.clear();
}

constexpr BlockContacts no_contacts = [] {
    BlockContacts none{};
    none.fill(SoftContacts::no_contact);
    return none;
}();
constexpr std::size_t most_colours = 64;
/// Of each colour one list of those of one point, and one of the others; and those that found no colour.
constexpr std::size_t lists = 2 * most_colours + 1;
constexpr bool is_coloured(std::size_t list) { return list < 2 * most_colours; }

/// Gives contacts colours: the list of each one, with c.row its place in it. Returns how long the lists are.
std::array<std::uint32_t, lists> colour_contacts(const SoftScene& scene, std::size_t from, SoftContacts& contacts) {
    std::array<std::uint32_t, lists> length{};
    Scratch<std::uint64_t> taken(scene.bodies.size() + 1, 0);
    for (std::size_t i = from; i < contacts.all.size(); ++i) {
        SoftContact& c = contacts.all[i];
        const bool a_moves = moves(scene, c.a), b_moves = moves(scene, c.b);
        const std::uint64_t used = (a_moves ? taken[c.a] : 0) | (b_moves ? taken[c.b] : 0);
        const auto free = static_cast<std::size_t>(std::countr_one(used));
        const bool found = free < most_colours;
        c.block = static_cast<std::uint32_t>(2 * free + (found && !c.is_single));
        c.row = length[c.block]++;
        if (!found) continue;
        if (a_moves) taken[c.a] |= std::uint64_t{1} << free;
        if (b_moves) taken[c.b] |= std::uint64_t{1} << free;
    }
    return length;
}

/// Lays contacts out in blocks that are yet to be filled, behind those that there are unless all are laid out.
void lay_out(const SoftScene& scene, std::size_t from, SoftContacts& contacts) {
    const auto length = colour_contacts(scene, from, contacts);
    if (from == 0) contacts.colours.clear(), contacts.solved_in.clear();
    std::size_t end = from == 0 ? 0 : contacts.blocks.size();
    std::array<std::uint32_t, lists> first{};  // blocks
    for (std::size_t list = 0; list < lists; ++list) {
        // Those that found no colour are solved one by one.
        const std::size_t width = is_coloured(list) ? block_rows : 1, count = (length[list] + width - 1) / width;
        first[list] = static_cast<std::uint32_t>(end), end += count;
        if (count == 0) continue;
        contacts.colours.push_back({first[list], count, width == 1});
        if (contacts.blocks.size() < end) contacts.blocks.resize(end);
        for (std::size_t k = first[list]; k < end; ++k)
            contacts.blocks[k].points = is_coloured(list) && list % 2 == 0 ? 1 : 2;
    }
    contacts.blocks.resize(end), contacts.solved_in.resize(end, no_contacts);
    for (std::size_t i = from; i < contacts.all.size(); ++i) {
        SoftContact& c = contacts.all[i];
        const std::uint32_t list = c.block, place = c.row;
        const std::uint32_t width = is_coloured(list) ? block_rows : 1;
        c.block = first[list] + place / width, c.row = place % width;
        contacts.solved_in[c.block][c.row] = static_cast<std::uint32_t>(i);
    }
}

/// Lays contacts out as those of the search before, if they are of the same bodies: colours ask for no more.
bool lay_out_again(SoftContacts& contacts) {
    const auto is_like = [](const SoftContact& c, const LaidContact& laid) {
        return c.a == laid.a && c.b == laid.b && c.is_single == laid.is_single;
    };
    auto& [laid, blocks, colours] = contacts.layout;
    auto& all = contacts.all;
    if (!std::equal(all.begin(), all.end(), laid.begin(), laid.end(), is_like)) return false;
    for (std::size_t i = 0; i < all.size(); ++i) all[i].block = laid[i].block, all[i].row = laid[i].row;
    contacts.blocks.resize(blocks), contacts.colours.resize(colours), contacts.solved_in.resize(blocks);
    return true;
}

void keep_layout(SoftContacts& contacts) {
    auto& [laid, blocks, colours] = contacts.layout;
    laid.resize(contacts.all.size());
    for (std::size_t i = 0; i < laid.size(); ++i) {
        const SoftContact& c = contacts.all[i];
        laid[i] = {c.a, c.b, c.block, c.row, c.is_single};
    }
    blocks = contacts.blocks.size(), colours = contacts.colours.size();
}

/// Asks for the contacts of a block: they lie all over.
void fetch_block(std::size_t number, const SoftContacts& contacts) {
    constexpr std::size_t line = 64;
    if (number == contacts.solved_in.size()) return;
    for (const std::uint32_t i : contacts.solved_in[number]) {
        if (i == SoftContacts::no_contact) continue;
        const char* const contact = reinterpret_cast<const char*>(&contacts.all[i]);
        for (std::size_t k = 0; k < sizeof(SoftContact); k += line) prefetch(contact + k);
    }
}

/// Writes a block that is laid out: all rows at once if none is left over.
void fill_block(const SoftScene& scene, double h, std::size_t number, SoftContacts& contacts) {
    fetch_block(number + 1, contacts);
    ContactBlock& block = contacts.blocks[number];
    const BlockContacts& indices = contacts.solved_in[number];
    const std::uint32_t points = block.points;
    block = ContactBlock{};
    block.points = points;
    RowKinds kinds;
    const bool is_full = indices[block_rows - 1] != SoftContacts::no_contact;
    for (std::uint32_t k = 0; k < block_rows; ++k) {
        block.a[k] = block.b[k] = static_cast<std::uint32_t>(scene.bodies.size());
        if (indices[k] == SoftContacts::no_contact) continue;
        const SoftContact& c = contacts.all[indices[k]];
        note_kinds(scene, c, block);
        if (!is_full) {
            fill_row(scene, c, contacts.frames[c.a], contacts.frames[c.b], contacts);
            continue;
        }
        block.a[k] = c.a, block.b[k] = c.b;
        for (int i = 0; i < c.manifold.count; ++i) kinds.has_point[i] |= 1U << k;
        kinds.is_at_wall |= std::uint32_t{c.at_wall} << k;
        kinds.is_let_bounce |= std::uint32_t{is_let_bounce(c)} << k;
        kinds.rounds_a_corner |= std::uint32_t{rounds_a_corner(c)} << k;
    }
    if (is_full) contact_kernel().write_block(row_source(scene, contacts), indices.data(), kinds, block);
    for (const std::uint32_t i : indices)
        if (i != SoftContacts::no_contact) contacts.all[i].load = load_of(scene, contacts.all[i], contacts, h);
}

}  // namespace

void arrange(const SoftScene& scene, double h, std::size_t first, SoftContacts& contacts) {
    const std::size_t before = first == 0 ? 0 : contacts.blocks.size();
    if (first > 0 || !lay_out_again(contacts)) {
        lay_out(scene, first, contacts);
        if (first == 0) keep_layout(contacts);
    }
    constexpr std::size_t some = 32;
    parallel_ranges(scene.threads, contacts.blocks.size() - before, some, [&](std::size_t from, std::size_t to) {
        for (std::size_t k = from; k < to; ++k) fill_block(scene, h, before + k, contacts);
    });
    list_contacts(scene, first, contacts);
    note_touched(scene, contacts);
}

}  // namespace carom
