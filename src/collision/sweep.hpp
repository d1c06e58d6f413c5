#pragma once
// Broad phase: which boxes overlap.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "collision/convex.hpp"
#include "math/scratch.hpp"

namespace carom {

struct BoxPair {
    std::uint32_t a, b;  ///< a < b
    auto operator<=>(const BoxPair&) const = default;
};

/// What a box is of.
struct BoxName {
    std::uint32_t body, piece;
};

/// Sort and sweep along one axis, rebuilt in every search, with storage that it reuses. Across the axis the boxes are
/// dealt out to strips about twice as wide as they are, so that the cost grows with their number and not with its
/// power of 3/2. Boxes that do not move are swept against those that do, and never against one another.
class Sweep {
  public:
    /// Leaves those that are wanted of some pairs at their beginning, and returns how many; by any thread.
    using Keep = std::function<std::size_t(std::span<BoxPair>)>;

    /// All pairs of overlapping boxes of which at least one moves, or those of them to keep, in ascending order; valid
    /// until the next call. Where boxes have names, a is of the body with the smaller number, and pairs are in the
    /// order of both bodies, and of the pieces of these.
    std::span<const BoxPair> pairs(std::span<const Aabb> boxes, const Scratch<bool>& moves, int threads = 1,
                                   const Keep& keep = {}, std::span<const BoxName> names = {});
    /// The same, where all but these are where they were in the last call of pairs(), and those that moved then are
    /// among these: it costs next to nothing for the others. Who has set off since may seem to be where it was as well.
    std::span<const BoxPair> pairs_again(std::span<const Aabb> boxes, std::span<const std::uint32_t> moving,
                                         int threads = 1, const Keep& keep = {}, std::span<const BoxName> names = {});

  private:
    struct Entry {
        double low, high;  ///< along the axis
        double across_low, across_high;
        std::uint32_t box, strip;  ///< the first of its strips
    };
    /// Boxes by strips, and in each strip by their lower ends; a box is in all strips that it reaches.
    struct Line {
        std::vector<Entry> entries;
        std::vector<std::uint32_t> end;  ///< of each strip
    };
    struct Key {
        std::uint64_t key;
        std::uint32_t box;
    };
    struct Reach {
        std::uint32_t first, count;  ///< strips
    };
    /// Strips lie side by side without end and are numbered in rounds, so that a stray box far away does no harm.
    struct Strips {
        bool along_x = true;
        double per_length = 0;    ///< strips
        std::uint32_t count = 1;  ///< of a round, a power of two

        Strips() = default;
        explicit Strips(std::span<const Aabb> boxes);
        Reach reach(double across_low, double across_high) const;
    };

    void sort();
    void add_key(std::span<const Aabb> boxes, std::uint32_t box);
    void line_up(std::span<const Aabb> boxes, Line& line);
    /// Pairs as they are found, in storage that is used again.
    class alignas(64) Found {
      public:
        void clear() { count_ = 0; }
        std::span<const BoxPair> all() const { return {pairs_.data(), count_}; }
        void keep(const Keep& keep) { count_ = keep({pairs_.data(), count_}); }
        /// Those of a box with those that begin within it, from a start on.
        void sweep(std::uint32_t strip, const Entry& from, std::span<const Entry> over, std::size_t start);
        void sweep_strip(std::uint32_t strip, std::span<const Entry> moving, std::span<const Entry> still);

      private:
        std::vector<BoxPair> pairs_;
        std::size_t count_ = 0;
    };

    void sweep_all(int threads, const Keep& keep);
    template <class KeyOf>
    void sort_by(std::size_t keys, const KeyOf& key_of);
    std::span<BoxPair> sort_found(std::span<const BoxName> names);

    Strips strips_;
    Line moving_, still_;
    std::vector<Key> keys_, spare_;
    std::vector<Reach> reach_;      ///< of each box
    std::vector<bool> lies_still_;  ///< by box: it was one of those that do not move
    std::vector<Found> found_;      ///< in some strips each
    std::vector<BoxPair> sorted_, unsorted_;
    std::vector<std::uint32_t> place_;
};

}  // namespace carom
