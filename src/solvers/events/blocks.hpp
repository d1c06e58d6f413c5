#pragma once
// A large gas in blocks of cells that fit into the cache, and that threads can share.
//
// Every block foretells a while of its own cells as if it were alone: from a window that reaches some cells farther,
// without what is beyond. Two blocks that foretell the same cell of their border may disagree, for what comes from
// beyond a window arrives there in the end. Blocks that agree on all that came into the cells within an event's reach
// of their borders are right, to the last bit: the first event that departed from the true course would have read
// something that is another block's, and on which they disagreed. If any two disagree, the while is taken back and a
// shorter one tried. So the bits are those of one queue, whatever the blocks.

#include "solvers/events/edge.hpp"
#include "solvers/events/gas.hpp"

namespace carom {

/// Columns, or rows, in tiles of some eight: discs are stored by tiles.
struct GasTiles {
    std::vector<std::int32_t> first;  ///< of each; and one beyond the last
    std::vector<std::uint16_t> of;    ///< which tile a column is in

    std::int32_t count() const { return static_cast<std::int32_t>(first.size()) - 1; }
};

/// Tiles from the first to before the last; those beside them are the window's, if it has any.
struct GasSpan {
    std::int32_t first, last, margin;
};

class GasBlocks {
  public:
    /// Whether a gas is large enough, and the time in question long enough, for blocks to be worth it.
    static bool pay(const GasData& gas, const GasDiscs& discs, double time);
    /// All events from a time of the gas's clock to another; the time up to which it went. Before that time it ends
    /// only where blocks come to no agreement.
    double run(const GasScene& scene, GasData& gas, GasPart<Calendar>& whole, double from, double until,
               GasBooks& books);

  private:
    /// What another block's cell saw.
    struct Claim {
        Cell cell;
        std::uint64_t history;
    };
    /// What a block foretold.
    struct Foretold {
        GasDiscs discs;                  ///< of its inner cells, but for those that are as they were; partners by rows
        std::vector<Slot> of_tile;       ///< how many
        std::vector<std::uint64_t> rim;  ///< histories of its own cells that others have a say in
        std::vector<Claim> claims;       ///< and of those that are others'
        Slot changed = 0;                ///< discs that were in its inner cells
        GasBooks books;
    };
    /// Discs that lie behind one another here and there.
    struct Run {
        Slot here, there, count;
    };
    /// What a thread works with.
    struct Desk {
        GasPart<Calendar> part;
        GasEdge edge;
        std::vector<Run> inner;               ///< of the inner cells
        std::vector<Slot> of_row;             ///< the disc of a body, if it is here
        std::vector<std::uint32_t> stranger;  ///< the body that a disc expects to hit, if it is not here
        std::vector<std::uint32_t> order;
    };

    void plan(const GasData& gas, const GasDiscs& discs);
    void store(GasDiscs& discs, bool alike);
    void take_out(GasDiscs& discs);
    bool foretell(const GasScene& scene, const GasData& gas, const GasDiscs& discs, double from, double until);
    void gather(const GasData& gas, const GasDiscs& discs, const GasSpan& across, const GasSpan& up, Desk& desk);
    void publish(bool alike, const GasSpan& across, const GasSpan& up, Desk& desk, Foretold& to);
    void publish_histories(const Desk& desk, Foretold& to) const;
    void accept(bool alike, int threads, GasDiscs& discs);
    bool agree() const;
    std::uint64_t history(Cell cell) const;
    std::size_t tile(const GasDisc& d) const {
        return static_cast<std::size_t>(up_.of[d.cell.y]) * static_cast<std::size_t>(across_.count()) +
               across_.of[d.cell.x];
    }

    GasTiles across_, up_;
    std::vector<GasSpan> columns_, rows_;  ///< of blocks
    std::vector<Slot> first_of_tile_;
    std::vector<std::uint8_t> changed_;  ///< of each disc: whether anything happens to it in the while
    std::vector<Foretold> foretold_;
    std::vector<Desk> desks_;
    double refused_ = gas_never;  ///< a while that was too long, not long ago [s]
};

}  // namespace carom
