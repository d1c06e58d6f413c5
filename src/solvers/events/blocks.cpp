#include "solvers/events/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solvers/events/foresee.hpp"
#include "threads/parallel.hpp"

namespace carom {

namespace {

constexpr std::int32_t tile_width = GasEdge::width + GasBorder::reach;  // cells; as far the window of a block goes
constexpr double discs_in_block = 10000;                                // whose records and lists fit into a cache,
constexpr double part_in_block = 1.0 / 25;                              // and no more of all, for memory has them twice
constexpr double most_changed = 0.41;                                   // of all discs, in a stride: these too
constexpr double shortest_share = 1.0 / 16;  // of a stride that is worth a pass through memory
constexpr Slot few = 4;                      // of so many discs one may lie elsewhere than behind its neighbour

/// Calls f with the arrays of two sets of discs that have an entry for each disc: those that events change, and where
/// discs are not alike the others too.
template <class F>
void for_arrays(bool alike, GasDiscs& to, const GasDiscs& from, F f) {
    f(to.disc, from.disc), f(to.event, from.event), f(to.spin, from.spin), f(to.past, from.past);
    if (!alike) f(to.radius, from.radius), f(to.inverse_mass, from.inverse_mass);
}

/// Room for so many, and not that beside the room for fewer that was there.
template <class T>
void make_room(std::vector<T>& array, std::size_t count) {
    std::vector<T>().swap(array);
    array.reserve(count);
}

/// The discs of some places, with room for one more.
void copy(GasDiscs& to, const GasDiscs& from, bool alike, const std::vector<Slot>& places) {
    for_arrays(alike, to, from, [&places](auto& a, const auto& b) {
        const std::size_t n = b.empty() ? 0 : places.size();
        if (n >= a.capacity()) make_room(a, n + 1);
        a.resize(n);
        for (std::size_t k = 0; k < n; ++k) a[k] = b[places[k]];
    });
}

/// Puts each entry at its place.
template <class T>
void reorder(std::vector<T>& array, const std::vector<Slot>& place) {
    std::vector<bool> done(place.size());
    for (Slot start = 0; start < place.size(); ++start) {
        if (done[start]) continue;
        T entry = array[start];
        for (Slot to = place[start]; to != start; to = place[to]) {
            std::swap(entry, array[to]);
            done[to] = true;
        }
        array[start] = entry;
    }
}

/// Blocks of some width along an axis; one with all tiles if the windows would meet around it.
GasAxis axis_of(std::int32_t cells, double width) {
    GasAxis axis;
    const std::int32_t tiles = std::max(1, cells / tile_width);
    for (std::int32_t k = 0; k <= tiles; ++k)
        axis.first.push_back(static_cast<std::int32_t>(std::int64_t{k} * cells / tiles));
    for (std::int32_t k = 0; k < tiles; ++k)
        axis.tile.insert(axis.tile.end(), static_cast<std::size_t>(axis.first[k + 1] - axis.first[k]),
                         static_cast<std::uint16_t>(k));
    std::int32_t blocks = static_cast<std::int32_t>(std::lround(tiles * tile_width / width));
    std::int32_t margin = 1;
    if (blocks < 2 || (tiles + blocks - 1) / blocks + 2 > tiles) blocks = 1, margin = 0;
    for (std::int32_t k = 0; k < blocks; ++k) {
        axis.span.push_back({k * tiles / blocks, (k + 1) * tiles / blocks, margin});
        axis.block.insert(axis.block.end(), static_cast<std::size_t>(axis.span[k].count()),
                          static_cast<std::uint16_t>(k));
    }
    return axis;
}

/// The first column of a window and how many it has.
struct Reach {
    std::int32_t first, count, before;  ///< before the inner ones
};
Reach reach_of(const GasAxis& axis, const GasSpan& span) {
    const std::int32_t n = axis.tiles(), all = axis.cells();
    if (span.margin == 0) return {0, all, 0};
    const std::int32_t first = axis.first[(span.first + n - span.margin) % n],
                       after = (span.last + span.margin - 1) % n;
    const std::int32_t before = (axis.first[span.first] - first + all) % all;
    return {first,
            before + axis.first[span.last] - axis.first[span.first] +
                (axis.first[after + 1] - axis.first[span.last % n] + all) % all,
            before};
}

}  // namespace

bool GasBlocks::pay(const GasData& gas, const GasDiscs& discs, double time) const {
    return discs.size() >= fewest_discs && time > shortest_share * gas.stride &&
           gas.stride > shortest_share * gas.first_stride;
}

double GasBlocks::run(const GasScene& scene, GasData& gas, GasPart<Calendar>& whole, double from, double until,
                      GasBooks& books) {
    GasDiscs& discs = whole.discs;
    plan(gas, discs, scene.threads);
    if (blocks_.size() < 2) return from;
    whole.queued = false;
    whole.queue = {}, whole.cells = {};  // blocks have their own
    list(discs);
    if (!in_order(discs.size())) put_in_order(discs, gas.alike);
    double now = from;
    while (now < until && pay(gas, discs, until - now)) {
        const double parts = std::ceil((until - now) / gas.stride);
        const double next = parts > 1 ? now + (until - now) / parts : until;
        if (!foretell(scene, gas, discs, now, next)) {
            refused_ = next - now;
            gas.stride = 0.7 * refused_;
            continue;
        }
        for_blocks(scene.threads, [&](Desk& desk, Block& block) { accept(discs, desk, block); });
        for (const Block& block : blocks_) books += block.books;
        choose_stride(gas, next - now, discs.size());
        now = next;
    }
    if (now < until) blocks_.clear(), desks_.clear();  // room for the one queue
    return now;
}

/// Quickly up to what was refused last, then with care, and no farther than memory goes.
void GasBlocks::choose_stride(GasData& gas, double gone, Slot discs) {
    if (gone <= 0.5 * gas.stride) return;
    refused_ *= 1.01;
    const double longer = std::max(1.01 * gas.stride, std::min(1.25 * gas.stride, 0.8 * refused_));
    double changed = 0;
    for (const Block& block : blocks_) changed += block.discs.size();
    gas.stride = std::min(longer, gone * most_changed * discs / changed);
}

void GasBlocks::plan(const GasData& gas, const GasDiscs& discs, int threads) {
    const GasGrid& grid = gas.grid;
    const double all = discs.size(), share = all / static_cast<double>(grid.cells());
    const double width = std::max(4.0 * tile_width, std::sqrt(std::min(discs_in_block, part_in_block * all) / share));
    across_ = axis_of(grid.nx, width), up_ = axis_of(grid.ny, width);
    blocks_.resize(across_.span.size() * up_.span.size());
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        Block& block = blocks_[b];
        block.across = across_.span[b % across_.span.size()], block.up = up_.span[b / across_.span.size()];
        block.border = {across_.first[block.across.first], across_.first[block.across.last], up_.first[block.up.first],
                        up_.first[block.up.last]};
    }
    desks_.resize(static_cast<std::size_t>(std::max(1, threads)));
    for (Desk& desk : desks_) desk.here.resize(discs.size());
}

/// Whom a block has.
void GasBlocks::list(const GasDiscs& discs) {
    const auto tile = [this](Block& block, Cell c) -> Slot& {
        return block.first[static_cast<std::size_t>(tile_of(c, block))];
    };
    for (Block& block : blocks_)
        block.first.assign(static_cast<std::size_t>(block.across.count() * block.up.count()) + 1, 0);
    for (Slot i = 0; i < discs.size(); ++i) {
        const Cell c = discs.disc[i].cell;
        ++tile(blocks_[block_of(c)], c);
    }
    for (Block& block : blocks_) {
        std::partial_sum(block.first.begin(), block.first.end(), block.first.begin());
        block.slot.resize(block.first.back());
    }
    for (Slot i = discs.size(); i-- > 0;) {
        const Cell c = discs.disc[i].cell;
        Block& block = blocks_[block_of(c)];
        block.slot[--tile(block, c)] = i;
    }
}

/// Whether most discs of the lists lie behind one another.
bool GasBlocks::in_order(Slot discs) const {
    Slot astray = 0, before = no_slot;
    for (const Block& block : blocks_)
        for (const Slot s : block.slot) astray += s != before + 1, before = s;
    return astray <= discs / few;
}

void GasBlocks::put_in_order(GasDiscs& discs, bool alike) {
    std::vector<Slot>& place = desks_[0].here;
    Slot next = 0;
    for (Block& block : blocks_)
        for (Slot& slot : block.slot) {
            place[slot] = next;
            slot = next++;
        }
    for (GasDisc& d : discs.disc)
        if (d.partner < first_obstacle) d.partner = place[d.partner];
    for_arrays(alike, discs, discs, [&place](auto& array, const auto&) {
        if (!array.empty()) reorder(array, place);
    });
}

template <class F>
void GasBlocks::for_blocks(int threads, F f) {
    parallel_for(threads, desks_.size(), [&](std::size_t k) {
        for (std::size_t b = k; b < blocks_.size(); b += desks_.size()) f(desks_[k], blocks_[b]);
    });
}

/// Whether all blocks agree.
bool GasBlocks::foretell(const GasScene& scene, const GasData& gas, const GasDiscs& discs, double from, double until) {
    for_blocks(scene.threads, [&](Desk& desk, Block& block) {
        gather(gas, discs, block, desk);
        desk.edge.from = from;
        desk.edge.history.swap(block.history);
        desk.edge.history.assign(block.border.size(), 0);
        block.books = {};
        GasRun(scene, gas, desk.part, block.books, &desk.edge).run(until);
        desk.edge.history.swap(block.history);
        publish(desk, block);
    });
    return agree();
}

/// What a cell's own block says of it.
std::uint64_t GasBlocks::history(Cell c) const {
    const Block& block = blocks_[block_of(c)];
    return block.history[block.border.index(c.x, c.y)];
}

bool GasBlocks::agree() const {
    std::size_t left = 0, arrived = 0;
    for (const Block& block : blocks_) left += block.left.size(), arrived += block.arrived.size();
    const auto around = [](const GasAxis& axis, std::int32_t c) {
        return static_cast<std::uint16_t>((c + axis.cells()) % axis.cells());
    };
    return left == arrived && std::all_of(blocks_.begin(), blocks_.end(), [&](const Block& block) {
               return block.border.all_beyond([&](std::int32_t column, std::int32_t row) {
                   const Cell cell{around(across_, column), around(up_, row)};
                   if ((block.across.margin == 0 && cell.x != column) || (block.up.margin == 0 && cell.y != row))
                       return true;  // its own
                   return block.history[block.border.index(column, row)] == history(cell);
               });
           });
}

/// Who is in a block's window.
void GasBlocks::find(const Block& block, Desk& desk) const {
    desk.runs.clear(), desk.slot.clear();
    const std::int32_t nx = across_.tiles(), ny = up_.tiles();
    const GasSpan &across = block.across, &up = block.up;
    for (std::int32_t row = up.first - up.margin; row < up.last + up.margin; ++row)
        for (std::int32_t column = across.first - across.margin; column < across.last + across.margin; ++column) {
            const std::int32_t x = (column + nx) % nx, y = (row + ny) % ny;
            const Block& owner = blocks_[up_.block[y] * across_.span.size() + across_.block[x]];
            const auto first = owner.first.begin() + owner.tile(x, y);
            const Slot begin = static_cast<Slot>(desk.slot.size());
            desk.slot.insert(desk.slot.end(), owner.slot.begin() + first[0], owner.slot.begin() + first[1]);
            desk.runs.push_back({begin, static_cast<Slot>(desk.slot.size()), block.tile(x, y)});
        }
}

/// All discs of a block's window, and its edge.
void GasBlocks::gather(const GasData& gas, const GasDiscs& discs, const Block& block, Desk& desk) const {
    find(block, desk);
    GasPart<Calendar>& part = desk.part;
    copy(part.discs, discs, gas.alike, desk.slot);
    part.discs.disc.push_back(nobody);
    if (gas.alike)
        part.discs.radius = discs.radius, part.discs.inverse_mass = discs.inverse_mass;
    else
        part.discs.radius.push_back(0);
    const Slot n = part.discs.size();
    for (Slot i = 0; i < n; ++i) desk.here[desk.slot[i]] = i;
    for (Slot i = 0; i < n; ++i) {
        Slot& partner = part.discs.disc[i].partner;
        if (partner >= first_obstacle) continue;
        const Slot here = desk.here[partner];
        partner = here < n && desk.slot[here] == partner ? here : n;
    }
    const GasBorder& border = block.border;
    const Reach x = reach_of(across_, block.across), y = reach_of(up_, block.up);
    part.window = {x.first, y.first, x.count, y.count, gas.grid.nx, gas.grid.ny};
    part.queued = false;
    desk.edge.border = {x.before, x.before + border.right - border.left, y.before,
                        y.before + border.top - border.bottom};
    desk.edge.changed.assign(n, false);
}

/// What becomes of the inner cells. No partner is beyond the window: whoever had such a one has looked around since.
void GasBlocks::publish(Desk& desk, Block& block) const {
    desk.chosen.clear();
    block.left.clear(), block.arrived.clear();
    for (const Run& run : desk.runs)
        for (Slot i = run.begin; i < run.end; ++i) {
            if (!desk.edge.changed[i]) continue;
            const std::int32_t tile = tile_of(desk.part.discs.disc[i].cell, block);
            if (tile != no_tile) desk.chosen.push_back(i);
            if (tile == run.tile) continue;
            if (run.tile != no_tile) block.left.push_back(block.first[run.tile] + (i - run.begin));
            if (tile != no_tile) block.arrived.push_back({tile, desk.slot[i]});
        }
    std::sort(block.arrived.begin(), block.arrived.end());
    copy(block.discs, desk.part.discs, true, desk.chosen);
    for (Slot k = 0; k < desk.chosen.size(); ++k) {
        GasDisc& d = block.discs.disc[k];
        d.next_in_cell = desk.slot[desk.chosen[k]];
        if (d.partner < first_obstacle) d.partner = desk.slot[d.partner];
    }
}

/// What a block foretold is the gas now.
void GasBlocks::accept(GasDiscs& discs, Desk& desk, Block& block) const {
    for_arrays(true, discs, block.discs, [&block](auto& all, const auto& own) {
        for (std::size_t k = 0; k < own.size(); ++k) all[block.discs.disc[k].next_in_cell] = own[k];
    });
    desk.slot.clear();
    auto left = block.left.begin();
    auto arrived = block.arrived.begin();
    for (std::size_t tile = 0; tile + 1 < block.first.size(); ++tile) {
        const Slot first = block.first[tile];
        block.first[tile] = static_cast<Slot>(desk.slot.size());
        for (Slot k = first; k < block.first[tile + 1]; ++k)
            if (left != block.left.end() && *left == k)
                ++left;
            else
                desk.slot.push_back(block.slot[k]);
        for (; arrived != block.arrived.end() && arrived->tile == static_cast<std::int32_t>(tile); ++arrived)
            desk.slot.push_back(arrived->slot);
    }
    block.first.back() = static_cast<Slot>(desk.slot.size());
    block.slot = desk.slot;
}

}  // namespace carom
