#pragma once
// Some rows of all.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "simd/chunks.hpp"

namespace carom {

struct RowRange {
    std::size_t first, last;  ///< and before that one
};

/// Ranges of whole chunks, in order, none of them empty or next to another.
class RowRanges {
  public:
    RowRanges() = default;
    static RowRanges all(std::size_t rows) {
        RowRanges ranges;
        if (rows > 0) ranges.add(0, rows);
        return ranges;
    }

    /// Rows behind all others.
    void add(std::size_t first, std::size_t last) {
        if (!ranges_.empty() && ranges_.back().last == first)
            ranges_.back().last = last;
        else
            ranges_.push_back({first, last});
        count_ += last - first;
    }
    void clear() { ranges_.clear(), count_ = 0; }
    std::size_t count() const { return count_; }  ///< of rows
    bool empty() const { return ranges_.empty(); }
    auto begin() const { return ranges_.begin(); }
    auto end() const { return ranges_.end(); }
    bool contains(std::size_t row) const {
        const auto range = std::partition_point(begin(), end(), [row](const RowRange& r) { return r.last <= row; });
        return range != end() && range->first <= row;
    }

    /// Calls act(first, last) for those of the rows in a range that are among these.
    template <class Act>
    void within(std::size_t first, std::size_t last, const Act& act) const {
        auto range = std::partition_point(begin(), end(), [first](const RowRange& r) { return r.last <= first; });
        for (; range != end() && range->first < last; ++range)
            act(std::max(range->first, first), std::min(range->last, last));
    }
    template <class Act>
    void each_row(const Act& act) const {
        for (const auto& [first, last] : ranges_)
            for (std::size_t i = first; i < last; ++i) act(i);
    }

  private:
    std::vector<RowRange> ranges_;
    std::size_t count_ = 0;
};

}  // namespace carom
