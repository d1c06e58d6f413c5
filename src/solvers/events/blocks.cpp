#include "solvers/events/blocks.hpp"

#include <cmath>
#include <numeric>

#include "solvers/events/foresee.hpp"
#include "state/pages.hpp"
#include "threads/parallel.hpp"

namespace carom {

namespace {

constexpr std::int32_t tile_width = 8;       // cells
constexpr std::int32_t tiles_around = 2;     // of a block are in its window
constexpr Slot fewest_discs = 20000;         // of which a gas has records for more than a cache
constexpr double discs_in_block = 10000;     // whose records and lists fit into one
constexpr double shortest_share = 1.0 / 16;  // of a stride that is worth a pass through memory

/// Calls f with the arrays of two sets of discs that have an entry for each disc.
template <class F>
void for_arrays(bool alike, GasDiscs& to, const GasDiscs& from, F f) {
    f(to.disc, from.disc), f(to.event, from.event);
    if (!alike) f(to.radius, from.radius), f(to.inverse_mass, from.inverse_mass);
    if (!from.spin.empty()) f(to.spin, from.spin);
    if (!from.past.empty()) f(to.past, from.past);
}

/// No discs yet, of the same kind.
void begin_like(GasDiscs& discs, const GasDiscs& like, bool alike) {
    std::apply([](auto&... array) { (array.clear(), ...); }, members(discs));
    if (alike) discs.radius = like.radius, discs.inverse_mass = like.inverse_mass;
}

/// Appends the discs of an order, or of a range.
void append(GasDiscs& to, const GasDiscs& from, bool alike, const std::vector<std::uint32_t>& order) {
    for_arrays(alike, to, from, [&order](auto& a, const auto& b) {
        for (const std::uint32_t k : order) a.push_back(b[k]);
    });
}
void append(GasDiscs& to, const GasDiscs& from, bool alike, Slot first, Slot last) {
    for_arrays(alike, to, from,
               [first, last](auto& a, const auto& b) { a.insert(a.end(), b.begin() + first, b.begin() + last); });
}

void add_nobody(GasDiscs& discs, bool alike) {
    discs.disc.push_back(nobody);
    if (!alike) discs.radius.push_back(0);
}

GasTiles tiles_of(std::int32_t cells) {
    GasTiles tiles;
    const std::int32_t count = std::max(1, cells / tile_width);
    for (std::int32_t k = 0; k <= count; ++k)
        tiles.first.push_back(static_cast<std::int32_t>(std::int64_t{k} * cells / count));
    for (std::int32_t k = 0; k < count; ++k)
        for (std::int32_t c = tiles.first[k]; c < tiles.first[k + 1]; ++c)
            tiles.of.push_back(static_cast<std::uint16_t>(k));
    return tiles;
}

/// Blocks of some width along an axis; one with all tiles if the windows would meet around it.
std::vector<GasSpan> blocks_along(const GasTiles& tiles, double width) {
    const std::int32_t n = tiles.count();
    std::int32_t count = static_cast<std::int32_t>(std::lround(n * tile_width / width));
    if (count < 2 || (n + count - 1) / count + 2 * tiles_around > n) return {{0, n, 0}};
    std::vector<GasSpan> blocks;
    for (std::int32_t k = 0; k < count; ++k) blocks.push_back({k * n / count, (k + 1) * n / count, tiles_around});
    return blocks;
}

/// The first column of a window and how many it has.
struct Reach {
    std::int32_t first, count, before;  ///< before the inner ones
};
Reach reach_of(const GasTiles& tiles, const GasSpan& span) {
    const std::int32_t n = tiles.count(), all = tiles.first[n];
    if (span.margin == 0) return {0, all, 0};
    const std::int32_t first = tiles.first[(span.first + n - span.margin) % n],
                       after = (span.last + span.margin - 1) % n;
    const std::int32_t before = (tiles.first[span.first] - first + all) % all;
    return {first,
            before + tiles.first[span.last] - tiles.first[span.first] +
                (tiles.first[after + 1] - tiles.first[span.last % n] + all) % all,
            before};
}

}  // namespace

bool GasBlocks::pay(const GasData& gas, const GasDiscs& discs, double time) {
    return discs.size() >= fewest_discs && time > shortest_share * gas.stride &&
           gas.stride > shortest_share * gas.first_stride;
}

double GasBlocks::run(const GasScene& scene, GasData& gas, GasPart<Calendar>& whole, double from, double until,
                      GasBooks& books) {
    GasDiscs& discs = whole.discs;
    plan(gas, discs);
    if (foretold_.size() < 2) return from;
    whole.queued = false;
    store(discs, gas.alike);
    double now = from;
    while (now < until && pay(gas, discs, until - now)) {
        const double parts = std::ceil((until - now) / gas.stride);
        const double next = parts > 1 ? now + (until - now) / parts : until;
        if (!foretell(scene, gas, discs, now, next)) {
            refused_ = next - now;
            gas.stride = 0.7 * refused_;
            continue;
        }
        accept(gas.alike, scene.threads, discs);
        for (const Foretold& block : foretold_) books += block.books;
        if (next - now > 0.5 * gas.stride) {  // quickly up to what was refused last, then with care
            refused_ *= 1.01;
            gas.stride = std::max(1.01 * gas.stride, std::min(1.25 * gas.stride, 0.8 * refused_));
        }
        now = next;
    }
    take_out(discs, scene.bodies.size());
    return now;
}

void GasBlocks::plan(const GasData& gas, const GasDiscs& discs) {
    const GasGrid& grid = gas.grid;
    across_ = tiles_of(grid.nx), up_ = tiles_of(grid.ny);
    const double share = static_cast<double>(discs.size()) / static_cast<double>(grid.cells());
    const double width = std::max(4.0 * tile_width, std::sqrt(discs_in_block / share));
    columns_ = blocks_along(across_, width), rows_ = blocks_along(up_, width);
    foretold_.resize(columns_.size() * rows_.size());
    history_.resize(grid.cells());
}

/// By tiles, with partners by their rows: blocks number discs anew.
void GasBlocks::store(GasDiscs& discs, bool alike) {
    const Slot n = discs.size();
    first_of_tile_.assign(static_cast<std::size_t>(across_.count()) * static_cast<std::size_t>(up_.count()) + 1, 0);
    bool sorted = true;
    for (Slot i = 0; i < n; ++i) {
        ++first_of_tile_[tile(discs.disc[i]) + 1];
        sorted = sorted && (i == 0 || tile(discs.disc[i - 1]) <= tile(discs.disc[i]));
        Slot& partner = discs.disc[i].partner;
        if (partner < n) partner = discs.event[partner].row;
    }
    std::partial_sum(first_of_tile_.begin(), first_of_tile_.end(), first_of_tile_.begin());
    if (sorted) return;
    std::vector<Slot> place(first_of_tile_.begin(), first_of_tile_.end() - 1);
    std::vector<std::uint32_t> order(n);
    for (Slot i = 0; i < n; ++i) order[place[tile(discs.disc[i])]++] = i;
    GasDiscs all;
    begin_like(all, discs, alike);
    reserve_large(all.disc, n + 1);
    reserve_large(all.event, n);
    append(all, discs, alike, order);
    add_nobody(all, alike);
    discs = std::move(all);
}

void GasBlocks::take_out(GasDiscs& discs, std::size_t bodies) {
    std::vector<Slot> of_row(bodies, no_slot);
    const Slot n = discs.size();
    for (Slot i = 0; i < n; ++i) of_row[discs.event[i].row] = i;
    for (Slot i = 0; i < n; ++i) {
        Slot& partner = discs.disc[i].partner;
        if (partner < first_obstacle) partner = of_row[partner];
    }
}

/// Whether all blocks agree.
bool GasBlocks::foretell(const GasScene& scene, const GasData& gas, const GasDiscs& discs, double from, double until) {
    const std::size_t desks = static_cast<std::size_t>(std::max(1, scene.threads));
    desks_.resize(desks);
    parallel_for(scene.threads, desks, [&](std::size_t k) {
        Desk& desk = desks_[k];
        for (std::size_t b = k; b < foretold_.size(); b += desks) {
            const GasSpan &across = columns_[b % columns_.size()], &up = rows_[b / columns_.size()];
            desk.of_row.resize(scene.bodies.size());
            gather(gas, discs, across, up, desk);
            desk.edge.from = from, desk.edge.until = until;
            foretold_[b].books = {};
            GasRun(scene, gas, desk.part, foretold_[b].books, &desk.edge).run(until);
            publish(gas, across, up, desk, foretold_[b]);
        }
    });
    return agree(discs.size());
}

bool GasBlocks::agree(Slot discs) const {
    Slot found = 0;
    for (const Foretold& block : foretold_) found += block.discs.size();
    if (found != discs) return false;
    for (const Foretold& block : foretold_)
        for (const auto& [cell, history] : block.claims)
            if (history_[cell] != history) return false;
    return true;
}

/// All discs of a block's window, and its edge.
void GasBlocks::gather(const GasData& gas, const GasDiscs& discs, const GasSpan& across, const GasSpan& up,
                       Desk& desk) {
    GasPart<Calendar>& part = desk.part;
    begin_like(part.discs, discs, gas.alike);
    const std::int32_t nx = across_.count(), ny = up_.count();
    for (std::int32_t y = up.first - up.margin; y < up.last + up.margin; ++y)
        for (std::int32_t x = across.first - across.margin; x < across.last + across.margin; ++x) {
            const std::size_t tile = static_cast<std::size_t>((y + ny) % ny * nx + (x + nx) % nx);
            append(part.discs, discs, gas.alike, first_of_tile_[tile], first_of_tile_[tile + 1]);
        }
    const Slot n = part.discs.size();
    add_nobody(part.discs, gas.alike);
    for (Slot i = 0; i < n; ++i) desk.of_row[part.discs.event[i].row] = i;
    desk.stranger.assign(n, no_slot);
    for (Slot i = 0; i < n; ++i) {
        Slot& partner = part.discs.disc[i].partner;
        if (partner >= first_obstacle) continue;
        const Slot there = desk.of_row[partner];
        if (there < n && part.discs.event[there].row == partner)
            partner = there;
        else
            desk.stranger[i] = partner, partner = n;
    }
    const Reach x = reach_of(across_, across), y = reach_of(up_, up);
    part.window = {x.first, y.first, x.count, y.count, gas.grid.nx, gas.grid.ny};
    part.queued = false;
    GasEdge& edge = desk.edge;
    edge.left = x.before, edge.right = x.before + across_.first[across.last] - across_.first[across.first];
    edge.bottom = y.before, edge.top = y.before + up_.first[up.last] - up_.first[up.first];
    edge.width = tiles_around * tile_width - GasEdge::reach;
    edge.history.assign(part.window.cells(), 0);
}

/// What becomes of the inner cells, and what the block says of those around them.
void GasBlocks::publish(const GasData& gas, const GasSpan& across, const GasSpan& up, Desk& desk, Foretold& to) {
    const GasWindow& window = desk.part.window;
    GasDiscs& discs = desk.part.discs;
    to.claims.clear();
    for (std::int32_t row = 0; row < window.ny; ++row)
        for (std::int32_t column = 0; column < window.nx; ++column) {
            const std::int32_t distance = desk.edge.distance(column, row);
            if (distance > GasEdge::reach) continue;
            const std::size_t cell = gas.grid.index({static_cast<std::uint16_t>((column + window.x) % window.all_x),
                                                     static_cast<std::uint16_t>((row + window.y) % window.all_y)});
            const std::uint64_t history = desk.edge.history[window.index(column, row)];
            if (distance == 0)
                history_[cell] = history;
            else
                to.claims.push_back({cell, history});
        }
    const std::int32_t wide = across.last - across.first;
    const auto inner = [&](const GasDisc& d) {
        const std::int32_t x = across_.of[d.cell.x] - across.first, y = up_.of[d.cell.y] - up.first;
        return x >= 0 && x < wide && y >= 0 && y < up.last - up.first ? y * wide + x : -1;
    };
    to.of_tile.assign(static_cast<std::size_t>(wide * (up.last - up.first)), 0);
    for (Slot i = 0; i < discs.size(); ++i)
        if (const std::int32_t tile = inner(discs.disc[i]); tile >= 0) ++to.of_tile[static_cast<std::size_t>(tile)];
    std::vector<Slot> place(to.of_tile.size());
    std::exclusive_scan(to.of_tile.begin(), to.of_tile.end(), place.begin(), Slot{0});
    desk.order.resize(place.back() + to.of_tile.back());
    for (Slot i = 0; i < discs.size(); ++i) {
        const std::int32_t tile = inner(discs.disc[i]);
        if (tile < 0) continue;
        desk.order[place[static_cast<std::size_t>(tile)]++] = i;
        Slot& partner = discs.disc[i].partner;
        if (partner < first_obstacle) partner = partner == discs.size() ? desk.stranger[i] : discs.event[partner].row;
    }
    begin_like(to.discs, discs, gas.alike);
    append(to.discs, discs, gas.alike, desk.order);
}

/// What all blocks foretold is the gas now.
void GasBlocks::accept(bool alike, int threads, GasDiscs& discs) {
    const std::size_t nx = static_cast<std::size_t>(across_.count());
    const auto for_tiles = [&](std::size_t b, auto f) {
        const GasSpan &across = columns_[b % columns_.size()], &up = rows_[b / columns_.size()];
        for (std::int32_t y = up.first; y < up.last; ++y)
            for (std::int32_t x = across.first; x < across.last; ++x)
                f(static_cast<std::size_t>(y) * nx + static_cast<std::size_t>(x));
    };
    first_of_tile_[0] = 0;
    for (std::size_t b = 0; b < foretold_.size(); ++b) {
        std::size_t k = 0;
        for_tiles(b, [&](std::size_t tile) { first_of_tile_[tile + 1] = foretold_[b].of_tile[k++]; });
    }
    std::partial_sum(first_of_tile_.begin(), first_of_tile_.end(), first_of_tile_.begin());
    parallel_for(threads, foretold_.size(), [&](std::size_t b) {
        const Foretold& block = foretold_[b];
        std::size_t k = 0;
        std::ptrdiff_t first = 0;
        for_tiles(b, [&](std::size_t tile) {
            const std::ptrdiff_t count = block.of_tile[k++], to = first_of_tile_[tile];
            for_arrays(alike, discs, block.discs,
                       [&](auto& all, const auto& own) { std::copy_n(own.begin() + first, count, all.begin() + to); });
            first += count;
        });
    });
}

}  // namespace carom
