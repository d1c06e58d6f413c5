#pragma once
// A large gas in blocks of cells that fit into the cache, and that threads can share.
//
// Every block foretells a while of its own cells as if it were alone: from a window that reaches some cells farther,
// without what is beyond. Two blocks that foretell the same cell of their border may disagree, for what comes from
// beyond a window arrives there in the end. Blocks that agree on all that came into the cells within an event's reach
// of their borders are right, to the last bit: the first event that departed from the true course would have read
// something that is another block's, and on which they disagreed. If any two disagree, the while is taken back and a
// shorter one tried. So the bits are those of one queue, whatever the blocks.
//
// A disc keeps its place in memory; lists say which are in a block. What is foretold is kept beside the gas until all
// agree, but only of the discs to which something happens. So whiles are short enough that these are less than half.

#include "solvers/events/edge.hpp"
#include "solvers/events/gas.hpp"

namespace carom {

/// Tiles from the first to before the last; those beside them are the window's, if it has any.
struct GasSpan {
    std::int32_t first = 0, last = 0, margin = 0;

    bool has(std::int32_t tile) const { return tile >= first && tile < last; }
    std::int32_t count() const { return last - first; }
};

/// The columns of the grid, or its rows, in tiles of some eight, and these in blocks.
struct GasAxis {
    std::vector<std::int32_t> first;   ///< column of a tile; and one beyond the last
    std::vector<std::uint16_t> tile;   ///< of a column
    std::vector<GasSpan> span;         ///< of a block
    std::vector<std::uint16_t> block;  ///< of a tile

    std::int32_t cells() const { return first.back(); }
    std::int32_t tiles() const { return static_cast<std::int32_t>(first.size()) - 1; }
};

class GasBlocks {
  public:
    Slot fewest_discs = 350000;  ///< of fewer one queue is faster (docs/performance-notes.md)

    /// Whether a gas is large enough, and the time in question long enough, for blocks to be worth it.
    bool pay(const GasData& gas, const GasDiscs& discs, double time) const;
    /// All events from a time of the gas's clock to another; the time up to which it went. Before that time it ends
    /// only where blocks come to no agreement.
    double run(const GasScene& scene, GasData& gas, GasPart<Calendar>& whole, double from, double until,
               GasBooks& books);

  private:
    struct Arrival {
        std::int32_t tile;
        Slot slot;
        auto operator<=>(const Arrival&) const = default;
    };
    struct Block {
        GasSpan across, up;
        GasBorder border;         ///< in the grid
        std::vector<Slot> slot;   ///< of the discs in its cells, by tiles
        std::vector<Slot> first;  ///< of each tile; and one beyond the last

        // What it foretells.
        GasDiscs discs;  ///< to which something happens, and in its cells after it; `next_in_cell` says where they are
        std::vector<Slot> left;              ///< which of `slot` leave their tile
        std::vector<Arrival> arrived;        ///< in a tile, by tiles
        std::vector<std::uint64_t> history;  ///< of the cells at its border, its own and others'
        GasBooks books;

        std::int32_t tile(std::int32_t x, std::int32_t y) const {
            return across.has(x) && up.has(y) ? (y - up.first) * across.count() + x - across.first : no_tile;
        }
    };
    static constexpr std::int32_t no_tile = -1;
    /// The discs of a tile in a window.
    struct Run {
        Slot begin, end;
        std::int32_t tile;  ///< of the block; none if it is another's
    };
    /// What a thread works with.
    struct Desk {
        GasPart<Calendar> part;
        GasEdge edge;
        std::vector<Run> runs;
        std::vector<Slot> slot;    ///< in the gas, of each disc here
        std::vector<Slot> here;    ///< of each slot of the gas: which disc that is, if it is here
        std::vector<Slot> chosen;  ///< some of those here
    };

    void plan(const GasData& gas, const GasDiscs& discs, int threads);
    void list(const GasDiscs& discs);
    bool in_order(Slot discs) const;
    void put_in_order(GasDiscs& discs, bool alike);
    template <class F>
    void for_blocks(int threads, F f);
    bool foretell(const GasScene& scene, const GasData& gas, const GasDiscs& discs, double from, double until);
    void find(const Block& block, Desk& desk) const;
    void gather(const GasData& gas, const GasDiscs& discs, const Block& block, Desk& desk) const;
    void publish(Desk& desk, Block& block) const;
    void accept(GasDiscs& discs, Desk& desk, Block& block) const;
    bool agree() const;
    void choose_stride(GasData& gas, double gone, Slot discs);
    std::size_t block_of(Cell c) const {
        return up_.block[up_.tile[c.y]] * across_.span.size() + across_.block[across_.tile[c.x]];
    }
    std::int32_t tile_of(Cell c, const Block& block) const { return block.tile(across_.tile[c.x], up_.tile[c.y]); }
    std::uint64_t history(Cell c) const;

    GasAxis across_, up_;
    std::vector<Block> blocks_;
    std::vector<Desk> desks_;
    double refused_ = gas_never;  ///< a while that was too long, not long ago [s]
};

}  // namespace carom
