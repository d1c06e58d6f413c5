#include "solvers/events/blocks.hpp"

#include <cmath>
#include <numeric>

#include "solvers/events/foresee.hpp"
#include "state/pages.hpp"
#include "threads/parallel.hpp"

namespace carom {

namespace {

constexpr std::int32_t tile_width = GasEdge::width + GasEdge::reach;  // cells; as far the window of a block goes
constexpr Slot fewest_discs = 20000;         // of which a gas has records for more than a cache
constexpr double discs_in_block = 10000;     // whose records and lists fit into one,
constexpr double part_in_block = 1.0 / 20;   // and no more of all, for memory has them twice
constexpr double most_changed = 0.45;        // of all discs, in a stride: memory has these twice
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

/// Room for so many, and one more, as they are of the other kind.
void reserve(GasDiscs& discs, const GasDiscs& like, bool alike, std::size_t count) {
    for_arrays(alike, discs, like, [count](auto& a, const auto&) { a.reserve(count + 1); });
}

/// Puts the entries of an order at the places 0, 1, …
template <class T>
void put_in_order(std::vector<T>& array, const std::vector<std::uint32_t>& order) {
    std::vector<bool> done(order.size());
    for (std::uint32_t start = 0; start < order.size(); ++start) {
        if (done[start]) continue;
        const T first = array[start];
        std::uint32_t to = start;
        for (; done[to] = true, order[to] != start; to = order[to]) array[to] = array[order[to]];
        array[to] = first;
    }
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
    if (count < 2 || (n + count - 1) / count + 2 > n) return {{0, n, 0}};
    std::vector<GasSpan> blocks;
    for (std::int32_t k = 0; k < count; ++k) blocks.push_back({k * n / count, (k + 1) * n / count, 1});
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
    whole.queue = {}, whole.cells = {};  // blocks have their own
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
            const double longer = std::max(1.01 * gas.stride, std::min(1.25 * gas.stride, 0.8 * refused_));
            std::size_t changed = 0;
            for (const Foretold& block : foretold_) changed += block.changed;
            gas.stride = std::min(
                longer, (next - now) * most_changed * static_cast<double>(discs.size()) / static_cast<double>(changed));
        }
        now = next;
    }
    take_out(discs);
    return now;
}

void GasBlocks::plan(const GasData& gas, const GasDiscs& discs) {
    const GasGrid& grid = gas.grid;
    across_ = tiles_of(grid.nx), up_ = tiles_of(grid.ny);
    const double share = static_cast<double>(discs.size()) / static_cast<double>(grid.cells());
    const double inside = std::min(discs_in_block, part_in_block * discs.size());
    const double width = std::max(4.0 * tile_width, std::sqrt(inside / share));
    columns_ = blocks_along(across_, width), rows_ = blocks_along(up_, width);
    foretold_.resize(columns_.size() * rows_.size());
    changed_.resize(discs.size());
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
    for_arrays(alike, discs, discs, [&order](auto& array, const auto&) { put_in_order(array, order); });
}

void GasBlocks::take_out(GasDiscs& discs) {
    std::vector<Slot>& of_row = desks_[0].of_row;
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
            desk.edge.from = from;
            foretold_[b].books = {};
            GasRun(scene, gas, desk.part, foretold_[b].books, &desk.edge).run(until);
            publish_histories(desk, foretold_[b]);
            publish(gas.alike, across, up, desk, foretold_[b]);
        }
    });
    return agree();
}

/// What a cell's own block says of it.
std::uint64_t GasBlocks::history(Cell cell) const {
    const auto place = [](const std::vector<GasSpan>& spans, const GasTiles& tiles, std::uint16_t c) {
        const auto after = std::upper_bound(spans.begin(), spans.end(), std::int32_t{tiles.of[c]},
                                            [](std::int32_t t, const GasSpan& span) { return t < span.last; });
        const std::int32_t first = tiles.first[after->first];
        return std::tuple{static_cast<std::size_t>(after - spans.begin()), c - first, tiles.first[after->last] - first};
    };
    const auto [x, column, columns] = place(columns_, across_, cell.x);
    const auto [y, row, rows] = place(rows_, up_, cell.y);
    return foretold_[y * columns_.size() + x].rim[GasEdge::rim_index(column, row, columns, rows)];
}

bool GasBlocks::agree() const {
    std::size_t changed = 0, found = 0;
    for (const Foretold& block : foretold_) changed += block.changed, found += block.discs.size();
    return changed == found && std::all_of(foretold_.begin(), foretold_.end(), [this](const Foretold& block) {
               return std::all_of(block.claims.begin(), block.claims.end(),
                                  [this](const Claim& claim) { return history(claim.cell) == claim.history; });
           });
}

/// All discs of a block's window, and its edge.
void GasBlocks::gather(const GasData& gas, const GasDiscs& discs, const GasSpan& across, const GasSpan& up,
                       Desk& desk) {
    GasPart<Calendar>& part = desk.part;
    begin_like(part.discs, discs, gas.alike);
    const auto for_window = [&](auto f) {
        const std::int32_t nx = across_.count(), ny = up_.count();
        for (std::int32_t y = up.first - up.margin; y < up.last + up.margin; ++y)
            for (std::int32_t x = across.first - across.margin; x < across.last + across.margin; ++x) {
                const std::size_t tile = static_cast<std::size_t>((y + ny) % ny * nx + (x + nx) % nx);
                f(first_of_tile_[tile], first_of_tile_[tile + 1],
                  x >= across.first && x < across.last && y >= up.first && y < up.last);
            }
    };
    Slot count = 0;
    for_window([&count](Slot first, Slot last, bool) { count += last - first; });
    reserve(part.discs, discs, gas.alike, count);
    desk.inner.clear();
    for_window([&](Slot first, Slot last, bool inner) {
        if (inner) desk.inner.push_back({part.discs.size(), first, last - first});
        append(part.discs, discs, gas.alike, first, last);
    });
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
    edge.history.assign(part.window.cells(), 0);
    edge.changed.assign(n, false);
}

/// What came into cells that others have a say in, or are others'.
void GasBlocks::publish_histories(const Desk& desk, Foretold& to) const {
    const GasWindow& window = desk.part.window;
    const GasEdge& edge = desk.edge;
    const std::int32_t columns = edge.right - edge.left, rows = edge.top - edge.bottom;
    to.rim.resize(GasEdge::rim_size(columns, rows));
    to.claims.clear();
    to.claims.reserve(GasEdge::rim_size(columns + 2 * GasEdge::reach, rows + 2 * GasEdge::reach));
    for (std::int32_t row = 0; row < window.ny; ++row)
        for (std::int32_t column = 0; column < window.nx; ++column) {
            if (!edge.disputed(column, row)) continue;
            const std::uint64_t history = edge.history[window.index(column, row)];
            if (edge.distance(column, row) == 0)
                to.rim[GasEdge::rim_index(column - edge.left, row - edge.bottom, columns, rows)] = history;
            else
                to.claims.push_back({{static_cast<std::uint16_t>((column + window.x) % window.all_x),
                                      static_cast<std::uint16_t>((row + window.y) % window.all_y)},
                                     history});
        }
}

/// What becomes of the inner cells.
void GasBlocks::publish(bool alike, const GasSpan& across, const GasSpan& up, Desk& desk, Foretold& to) {
    GasDiscs& discs = desk.part.discs;
    const std::vector<std::uint8_t>& changed = desk.edge.changed;
    to.changed = 0;
    for (const Run& run : desk.inner)
        for (Slot k = 0; k < run.count; ++k) to.changed += changed_[run.there + k] = changed[run.here + k];
    const std::int32_t wide = across.last - across.first;
    const auto inner = [&](Slot i) {
        if (!changed[i]) return -1;
        const GasDisc& d = discs.disc[i];
        const std::int32_t x = across_.of[d.cell.x] - across.first, y = up_.of[d.cell.y] - up.first;
        return x >= 0 && x < wide && y >= 0 && y < up.last - up.first ? y * wide + x : -1;
    };
    to.of_tile.assign(static_cast<std::size_t>(wide * (up.last - up.first)), 0);
    for (Slot i = 0; i < discs.size(); ++i)
        if (const std::int32_t tile = inner(i); tile >= 0) ++to.of_tile[static_cast<std::size_t>(tile)];
    std::vector<Slot> place(to.of_tile.size());
    std::exclusive_scan(to.of_tile.begin(), to.of_tile.end(), place.begin(), Slot{0});
    desk.order.resize(place.back() + to.of_tile.back());
    for (Slot i = 0; i < discs.size(); ++i) {
        const std::int32_t tile = inner(i);
        if (tile < 0) continue;
        desk.order[place[static_cast<std::size_t>(tile)]++] = i;
        Slot& partner = discs.disc[i].partner;
        if (partner < first_obstacle) partner = partner == discs.size() ? desk.stranger[i] : discs.event[partner].row;
    }
    begin_like(to.discs, discs, alike);
    reserve(to.discs, discs, alike, desk.order.size());
    append(to.discs, discs, alike, desk.order);
}

/// What all blocks foretold is the gas now: in the place of what changed. Others stay in their tiles, in their order.
void GasBlocks::accept(bool alike, int threads, GasDiscs& discs) {
    const std::size_t nx = static_cast<std::size_t>(across_.count()), tiles = first_of_tile_.size() - 1;
    const auto for_tiles = [&](std::size_t b, auto f) {
        const GasSpan &across = columns_[b % columns_.size()], &up = rows_[b / columns_.size()];
        for (std::int32_t y = up.first; y < up.last; ++y)
            for (std::int32_t x = across.first; x < across.last; ++x)
                f(static_cast<std::size_t>(y) * nx + static_cast<std::size_t>(x));
    };
    std::vector<Slot> kept(tiles), first(tiles + 1);
    for (std::size_t t = 0; t < tiles; ++t)
        kept[t] = static_cast<Slot>(
            std::count(changed_.begin() + first_of_tile_[t], changed_.begin() + first_of_tile_[t + 1], false));
    for (std::size_t b = 0; b < foretold_.size(); ++b) {
        std::size_t k = 0;
        for_tiles(b, [&](std::size_t tile) { first[tile + 1] = kept[tile] + foretold_[b].of_tile[k++]; });
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    for_arrays(alike, discs, discs, [&](auto& all, const auto&) {
        Slot end = 0;
        for (Slot i = 0; i < discs.size(); ++i) {
            all[end] = all[i];
            end += !changed_[i];
        }
        for (std::size_t t = tiles; t-- > 0;) {
            const auto behind = all.begin() + end;
            end -= kept[t];
            if (end != first[t]) std::copy_backward(all.begin() + end, behind, all.begin() + first[t] + kept[t]);
        }
    });
    parallel_for(threads, foretold_.size(), [&](std::size_t b) {
        const Foretold& block = foretold_[b];
        std::size_t k = 0;
        std::ptrdiff_t from = 0;
        for_tiles(b, [&](std::size_t tile) {
            const std::ptrdiff_t count = block.of_tile[k++], to = first[tile] + kept[tile];
            for_arrays(alike, discs, block.discs,
                       [&](auto& all, const auto& own) { std::copy_n(own.begin() + from, count, all.begin() + to); });
            from += count;
        });
    });
    first_of_tile_.swap(first);
}

}  // namespace carom
