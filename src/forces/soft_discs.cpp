#include "forces/soft_discs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "forces/parts.hpp"
#include "simd/isa.hpp"

namespace carom {

namespace {

const SoftKernel& kernel() {
#if defined(CAROM_X86_KERNELS)
    if (isa() == Isa::avx512) return avx512_soft_kernel;
    if (isa() == Isa::avx2) return avx2_soft_kernel;
#endif
    return baseline_soft_kernel;
}

const double* flat(const std::vector<Vec2>& v) { return &v.data()->x; }

/// Square cells over the plane or the periodic box, folded into a table of buckets: two cells may share one.
class Cells {
  public:
    Cells(const std::vector<Vec2>& x, std::span<const double> radius, double width, const std::optional<Periodic>& box)
        : x_(x), box_(box), width_{width, width} {
        if (x.empty()) return;
        low_ = x[0];
        for (const Vec2 p : x) low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
        if (box) {
            low_ = box->low;
            const Vec2 size = box->high - box->low;
            count_ = {across(size.x, width), across(size.y, width)};
            width_ = {size.x / static_cast<double>(count_[0]), size.y / static_cast<double>(count_[1])};
        }
        stride_ = static_cast<std::int64_t>(std::sqrt(static_cast<double>(x.size()))) + 1;
        first_.resize(x.size() + 1);
        bucket_.resize(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            bucket_[i] = static_cast<std::uint32_t>(bucket(column(i, 0), column(i, 1)));
            if (radius[i] > 0) ++first_[bucket_[i]];
        }
        std::uint32_t sum = 0;
        for (std::uint32_t& f : first_) f = sum += f;
        discs_.resize(sum);
        for (std::size_t i = x.size(); i-- > 0;)
            if (radius[i] > 0) discs_[--first_[bucket_[i]]] = static_cast<std::uint32_t>(i);
    }

    /// Calls visit(j) for the discs in the cell of i and those around it; for some of them more than once.
    template <class Visit>
    void around(std::size_t i, Visit visit) const {
        const std::int64_t cx = column(i, 0), cy = column(i, 1);
        for (std::int64_t y = cy - 1; y <= cy + 1; ++y)
            for (std::int64_t x = cx - 1; x <= cx + 1; ++x) {
                const std::size_t b = bucket(wrapped(x, 0), wrapped(y, 1));
                for (std::uint32_t k = first_[b]; k < first_[b + 1]; ++k) visit(discs_[k]);
            }
    }

  private:
    static constexpr double most_cells = 1e15;
    static std::int64_t across(double size, double width) {
        return static_cast<std::int64_t>(std::clamp(std::floor(size / width), 1.0, most_cells));
    }
    std::int64_t wrapped(std::int64_t c, int axis) const {
        if (!box_) return c;
        c %= count_[axis];
        return c < 0 ? c + count_[axis] : c;
    }
    std::int64_t column(std::size_t i, int axis) const {
        const double at = axis == 0 ? x_[i].x - low_.x : x_[i].y - low_.y, w = axis == 0 ? width_.x : width_.y;
        const double cell = std::floor(at / w);
        if (!(std::abs(cell) < most_cells)) return 0;  // nan too: the step ends with an Error
        return wrapped(static_cast<std::int64_t>(cell), axis);
    }
    std::size_t bucket(std::int64_t x, std::int64_t y) const {
        return (static_cast<std::uint64_t>(x) + static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(stride_)) %
               x_.size();
    }

    const std::vector<Vec2>& x_;
    std::optional<Periodic> box_;
    Vec2 low_{}, width_;
    std::array<std::int64_t, 2> count_{};
    std::int64_t stride_ = 1;
    std::vector<std::uint32_t> first_, bucket_, discs_;
};

}  // namespace

SoftDiscRows::SoftDiscRows(const SoftDiscs& force, std::span<const double> radius, std::span<const double> inverse_mass,
                           std::vector<bool> moves, const std::optional<Periodic>& box)
    : stiffness_(force.stiffness),
      damping_(force.damping),
      radius_(radius.begin(), radius.end()),
      inverse_mass_(inverse_mass.begin(), inverse_mass.end()),
      moves_(std::move(moves)),
      box_(box) {
    for (const double r : radius_) largest_radius_ = std::max(largest_radius_, r);
}

Vec2 SoftDiscRows::apart(Vec2 d) const {
    if (!box_) return d;
    const Vec2 size = box_->high - box_->low;
    return {d.x - size.x * std::floor(d.x / size.x + 0.5), d.y - size.y * std::floor(d.y / size.y + 0.5)};
}

bool SoftDiscRows::are_good(const Neighbours& neighbours, const State& state) const {
    const double half = 0.5 * neighbours.skin;
    return neighbours.skin > 0 &&
           kernel().farthest(flat(state.x.linear), flat(neighbours.was), state.size()) < half * half;
}

void SoftDiscRows::look_around(const State& state, int threads) {
    if (state.size() > 0 && !are_good(neighbours_, state)) neighbours_ = find(state, threads);
}

Neighbours SoftDiscRows::find(const State& state, int threads) const {
    constexpr double skin_of_radius = 0.3;
    const std::vector<Vec2>& x = state.x.linear;
    Neighbours found{skin_of_radius * largest_radius_, x, {}, {}};
    const std::size_t n = x.size(), chunks = (n + chunk_rows - 1) / chunk_rows;
    found.first_column.resize(chunks + 1);
    if (largest_radius_ == 0) return found;
    const Cells cells(x, radius_, 2 * largest_radius_ + found.skin, box_);
    // Every block of rows on its own, then one after the other into the list.
    std::vector<std::vector<std::uint32_t>> blocks((chunks + rows_at_once - 1) / rows_at_once);
    parallel_for(threads, blocks.size(), [&](std::size_t block) {
        std::array<std::vector<std::uint32_t>, chunk_rows> near;
        const std::size_t end = std::min(chunks, (block + 1) * rows_at_once);
        for (std::size_t chunk = block * rows_at_once; chunk < end; ++chunk) {
            std::size_t most = 0;
            for (std::size_t k = 0; k < chunk_rows; ++k) {
                near[k].clear();
                const std::size_t i = chunk * chunk_rows + k;
                if (i >= n || radius_[i] == 0) continue;
                cells.around(i, [&](std::uint32_t j) {
                    const double reach = radius_[i] + radius_[j] + found.skin;
                    if (j != i && (moves_[i] || moves_[j]) && squared_length(apart(x[j] - x[i])) < reach * reach)
                        near[k].push_back(j);
                });
                std::sort(near[k].begin(), near[k].end());
                near[k].erase(std::unique(near[k].begin(), near[k].end()), near[k].end());
                most = std::max(most, near[k].size());
            }
            for (std::size_t c = 0; c < most; ++c)
                for (std::size_t k = 0; k < chunk_rows; ++k)
                    blocks[block].push_back(
                        c < near[k].size() ? near[k][c] : static_cast<Row>(std::min(chunk * chunk_rows + k, n - 1)));
            found.first_column[chunk + 1] = static_cast<std::uint32_t>(most);
        }
    });
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) found.first_column[chunk + 1] += found.first_column[chunk];
    for (const auto& block : blocks) found.rows.insert(found.rows.end(), block.begin(), block.end());
    return found;
}

SoftLayout SoftDiscRows::layout(const Neighbours& neighbours) const {
    const Vec2 size = box_ ? box_->high - box_->low : Vec2{};
    return {radius_.size(),
            neighbours.first_column.data(),
            neighbours.rows.data(),
            radius_.data(),
            inverse_mass_.data(),
            stiffness_,
            damping_,
            size.x,
            size.y,
            box_ ? 1 / size.x : 0,
            box_ ? 1 / size.y : 0};
}

SoftPowers SoftDiscRows::add_forces(const State& state, std::size_t first, std::size_t last,
                                    std::span<Vec2> force) const {
    return kernel().forces(layout(neighbours_), flat(state.x.linear), flat(state.v.linear), &force.data()->x, first,
                           last);
}

double SoftDiscRows::potential(const State& state) const {
    if (state.size() == 0) return 0;
    const bool good = are_good(neighbours_, state);
    const Neighbours fresh = good ? Neighbours{} : find(state, 1);
    return kernel().energy(layout(good ? neighbours_ : fresh), flat(state.x.linear), 0, state.size());
}

double SoftDiscRows::squared_frequency() const {
    double lightest = 0;  // its inverse mass
    for (std::size_t i = 0; i < radius_.size(); ++i)
        if (radius_[i] > 0) lightest = std::max(lightest, inverse_mass_[i]);
    return 6 * stiffness_ * lightest;
}

}  // namespace carom
