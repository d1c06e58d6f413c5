#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "math/block_factor.hpp"
#include "math/scratch.hpp"
#include "math/supernode_rows.hpp"

namespace carom {

/// A symmetric positive definite matrix of N × N blocks, and its factor L D Lᵀ (George and Liu, Computer Solution of
/// Large Sparse Positive Definite Systems, 1981), for rows of blocks in the order of math/elimination.hpp. N is 1 to 4.
template <int N>
class BlockMatrix {
  public:
    static constexpr int size = N;
    using Block = BlockOf<double, N>;
    /// Where the block of a coupled pair is kept, and whether as its mirror image.
    struct Place {
        std::uint32_t index;
        bool mirrored;
    };
    /// Makes room for n rows, coupled as the pairs say, and for their fill. All numbers are 0 then.
    void analyse(std::size_t n, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings);
    void clear();
    Block& diagonal(std::uint32_t row) { return diagonal_[place_[row]]; }
    /// Adds weight · left rightᵀ to the block in row a and column b of a coupled pair, and to its mirror image; or to
    /// the one of a row on the diagonal.
    void add(Place, double weight, const double* left, const double* right);
    void add(std::uint32_t row, double weight, const double* left, const double* right);
    Place place_of(std::uint32_t a, std::uint32_t b) const;
    Block& block(Place place) { return blocks_[place.index]; }
    /// Products of blocks in factor(), about, for each row: 1 without fill.
    std::size_t work_per_row() const { return work_ / (diagonal_.empty() ? 1 : diagonal_.size()); }
    /// Replaces the matrix by its factor: column by column, or as dense columns where some have the same rows below
    /// them (J. Liu, E. Ng, B. Peyton, SIAM J. Matrix Anal. Appl. 14, 242, 1993), to the same bits.
    void factor();
    /// x = A⁻¹ x, N numbers a row; after factor().
    void solve(std::span<double> x);
    /// The same of a vector in the order of elimination, in which a row has the place `place()[row]`.
    void solve_in_order(double* y) const;
    const Scratch<std::uint32_t>& place() const { return place_; }
    BlockOrder order() const { return {diagonal_.size(), column_.data(), below_.data()}; }
    Block* diagonals() { return diagonal_.data(); }
    Block* below_diagonals() { return blocks_.data(); }
    std::size_t below_count() const { return blocks_.size(); }
    std::size_t most_below() const { return given_.size(); }

  private:
    /// Columns side by side of which each has all rows below it that the next one has, and that one's own: a supernode.
    struct Columns {
        std::size_t first, count;
        std::size_t rows;     ///< from the first one's own on
        std::size_t targets;  ///< the first of its own
        bool is_dense;        ///< they are laid out as dense columns
    };
    void find_supernodes();
    void factor_supernode(const Columns&);
    /// Takes from all columns behind them what these have for them.
    void subtract_from_later(const Columns&, const Supernode&);

    Scratch<std::uint32_t> place_, row_at_;  ///< of a row in the order of elimination, and back
    Scratch<std::size_t> column_;            ///< where the blocks below the diagonal begin
    Scratch<std::uint32_t> below_;           ///< their places, ascending in each column
    Scratch<Block> diagonal_, blocks_, given_;
    Scratch<double> ordered_;
    Scratch<Columns> supernodes_;
    Scratch<std::uint32_t> targets_;  ///< blocks behind those that are dense, in the order in which these change them
    Scratch<double> panel_;           ///< room for one
    std::size_t work_ = 0;
};

}  // namespace carom
