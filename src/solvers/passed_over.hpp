#pragma once
// Pairs of pieces that may meet, and those of them that are no contacts as long as they go on as they do.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "math/scratch.hpp"
#include "state/pages.hpp"

namespace carom {

/// How near a candidate has to be to be a contact.
struct Near {
    std::uint32_t candidate;  ///< its place among all
    std::uint32_t a, b;       ///< rows of the movers
    double margin;            ///< how far apart [m] the two may be and still be a contact
    double spare;             ///< if they are none, how much nearer [m] than foreseen they may come; without end if all
                              ///< in reach are contacts
    bool is_far = false;      ///< they are none: their boxes are farther apart
    double span = 0;          ///< [m] no point of the smaller one is farther from the other one's position

    bool is_watched() const { return spare < HUGE_VAL; }
};

/// Pairs that are no contacts. There are many, and what is mostly asked of them is whether they are of some bodies.
class PassedOver {
  public:
    /// For bodies in so many rows.
    void clear(std::size_t rows) { pairs_.clear(), rows_.clear(), nobody_ = static_cast<std::uint32_t>(rows); }
    bool empty() const { return pairs_.empty(); }
    void add(const Near& near) { pairs_.push_back(near), rows_.push_back({near.a, near.b}); }
    /// Takes out those for which goes(pair) is true, of the pairs of which either row is among some, where a row more
    /// than there are is not. Looks without a branch first: one would be foreseen badly.
    template <class Goes>
    void take_out(const Scratch<std::uint8_t>& among, const Goes& goes) {
        constexpr std::size_t some = 256;
        std::array<std::uint32_t, some> found;
        for (std::size_t first = 0; first < rows_.size(); first += some) {
            std::size_t count = 0;
            for (std::size_t k = first; k < std::min(rows_.size(), first + some); ++k) {
                found[count] = static_cast<std::uint32_t>(k);
                count += std::size_t{among[rows_[k][0]]} | std::size_t{among[rows_[k][1]]};
            }
            for (const std::uint32_t k : std::span(found).first(count))
                if (goes(pairs_[k])) rows_[k] = {nobody_, nobody_};
        }
    }

  private:
    std::uint32_t nobody_ = 0;
    LargeArray<Near> pairs_;
    LargeArray<std::array<std::uint32_t, 2>> rows_;  ///< theirs, or nobody's if they were taken out
};

}  // namespace carom
