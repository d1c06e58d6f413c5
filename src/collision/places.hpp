#pragma once
// Where bodies and their pieces are, for one question after another.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/convex.hpp"
#include "state/motion.hpp"

namespace carom {

/// Frames of bodies and bounds of their pieces. What is where it was is not placed anew, and what is far from a place
/// that is asked for is passed over in blocks: pieces that were made one after the other tend to lie together.
class Places {
  public:
    bool fit() const { return fit_; }
    /// Call when bodies may have moved, or when those from a row on are others now.
    void forget() { fit_ = false; }
    void forget_from(std::size_t row) { fit_ = false, known_rows_ = std::min(known_rows_, row); }
    /// Makes all fit again. The pieces are in the order of the rows, and of each row there is one.
    void follow(std::span<const Piece> pieces, const Motion& bodies);

    const Frame& frame(std::size_t row) const { return frames_[row]; }
    std::span<const Aabb> bounds() const { return blocks_[0]; }          ///< by piece
    std::span<const std::uint32_t> sensors() const { return sensors_; }  ///< which pieces are

    /// Calls act(k) for each piece whose bounds pass, in order. What does not pass has nothing in it that would.
    template <class Passes, class Act>
    void each(const Passes& passes, const Act& act) const {
        each_in(blocks_.size() - 1, 0, blocks_.back().size(), passes, act);
    }

  private:
    static constexpr std::size_t block = 8;  ///< pieces, or blocks of them

    template <class Passes, class Act>
    void each_in(std::size_t level, std::size_t first, std::size_t last, const Passes& passes, const Act& act) const {
        for (std::size_t i = first; i < last; ++i) {
            if (!passes(blocks_[level][i])) continue;
            if (level == 0)
                act(i);
            else
                each_in(level - 1, block * i, std::min(block * (i + 1), blocks_[level - 1].size()), passes, act);
        }
    }
    void number(std::span<const Piece> pieces, std::size_t rows);
    void bound(std::size_t level, std::size_t i);
    void bound_all();
    void bound_moved();

    bool fit_ = false;
    std::size_t known_rows_ = 0;                ///< of so many rows pieces are the same as they were
    std::vector<Frame> frames_;                 ///< by row
    std::vector<double> angles_;                ///< that they are for
    std::vector<std::uint32_t> first_{0};       ///< piece, by row, and their end
    std::vector<std::uint32_t> sensors_;        ///< pieces
    std::vector<std::uint32_t> moved_;          ///< pieces, and storage
    std::vector<std::vector<Aabb>> blocks_{1};  ///< of pieces, of blocks of them, of blocks of these
};

}  // namespace carom
