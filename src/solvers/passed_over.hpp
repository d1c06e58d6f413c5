#pragma once
// Pairs of pieces that may meet, and those of them that are no contacts as long as they go on as they do.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "math/pages.hpp"
#include "math/scratch.hpp"
#include "solvers/shared.hpp"

namespace carom {

/// How near a candidate has to be to be a contact.
struct Near {
    std::uint32_t candidate;  ///< its place among all
    std::uint32_t a, b;       ///< rows of the movers
    bool is_far;              ///< they are none: their boxes are farther apart
    double margin;            ///< how far apart [m] the two may be and still be a contact
    double spare;             ///< if they are none, how much nearer [m] than foreseen they may come; without end if all
                              ///< in reach are contacts
    double span = 0;          ///< [m] no point of the smaller one is farther from the other one's position

    bool is_watched() const { return spare < HUGE_VAL; }
};

/// A pair that is no contact: what is asked of it later.
struct Passed {
    std::uint32_t candidate, a, b;
    double spare;
};

/// Pairs that are no contacts. There are many, and what is mostly asked of them is whether they are of some bodies, and
/// then what they have to spare: each lies by itself.
class PassedOver {
  public:
    /// For bodies in so many rows.
    void clear(std::size_t rows) {
        rows_.clear(), spare_.clear(), candidates_.clear();
        nobody_ = static_cast<std::uint32_t>(rows);
    }
    bool empty() const { return rows_.empty(); }
    void add(const Near& near) {
        rows_.push_back({near.a, near.b}), spare_.push_back(near.spare), candidates_.push_back(near.candidate);
    }
    /// Takes out those for which goes(pair) is true, of the pairs of which either row is among some, where a row more
    /// than there are is not, and calls act(pair) for them, in order. Threads look.
    template <class Goes, class Act>
    void take_out(int threads, const Scratch<std::uint8_t>& among, const Goes& goes, const Act& act) {
        constexpr std::size_t some = 32;
        const auto look = [&](std::size_t block) {
            std::uint32_t going = 0;
            for (std::uint32_t left = those_of(among, some * block); left != 0; left &= left - 1) {
                const int k = std::countr_zero(left);
                going |= std::uint32_t{goes(pair(some * block + static_cast<std::size_t>(k)))} << k;
            }
            return going;
        };
        each_row_where(threads, (rows_.size() + some - 1) / some, look, [&](std::size_t block, std::uint32_t k) {
            act(pair(some * block + k));
            rows_[some * block + k] = {nobody_, nobody_};
        });
    }

  private:
    Passed pair(std::size_t k) const { return {candidates_[k], rows_[k][0], rows_[k][1], spare_[k]}; }
    /// Of the pairs from this one on those of which either row is among some, as bits. Looks without a branch: one
    /// would be foreseen badly.
    std::uint32_t those_of(const Scratch<std::uint8_t>& among, std::size_t first) const {
        std::uint32_t found = 0;
        const std::size_t count = std::min<std::size_t>(32, rows_.size() - first);
        for (std::size_t k = 0; k < count; ++k)
            found |= std::uint32_t{static_cast<std::uint8_t>(among[rows_[first + k][0]] | among[rows_[first + k][1]])}
                     << k;
        return found;
    }

    std::uint32_t nobody_ = 0;
    LargeArray<std::array<std::uint32_t, 2>> rows_;  ///< theirs, or nobody's if they were taken out
    LargeArray<double> spare_;
    LargeArray<std::uint32_t> candidates_;
};

}  // namespace carom
