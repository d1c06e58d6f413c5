#include "forces/soft_discs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <carom/error.hpp>
#include <cmath>
#include <limits>

#include "forces/parts.hpp"
#include "math/elementary.hpp"
#include "simd/isa.hpp"

namespace carom {

namespace {

const SoftKernel& soft_kernel() { return kernel_in_use<baseline_soft_kernel, avx2_soft_kernel, avx512_soft_kernel>(); }

/// The number nearest to a, for |a| < 2⁵¹.
double rounded(double a) {
    constexpr double shift = 6755399441055744;  // 1.5 · 2⁵²: beyond it there are no fractions
    return (a + shift) - shift;
}

/// Square cells over the plane or the periodic box, folded into a table of buckets: two cells may share one. Discs lie
/// bucket by bucket, and so those of cells side by side lie one after the other.
class Cells {
  public:
    Cells(const std::vector<Vec2>& x, std::span<const double> radius, double width, const std::optional<Periodic>& box,
          int threads)
        : box_(box), width_{width, width} {
        if (x.empty()) return;
        low_ = x[0];
        double right = x[0].x;
        for (const Vec2 p : x) low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)}, right = std::max(right, p.x);
        if (box) {
            low_ = box->low;
            size_ = box->high - box->low;
            count_ = {across(size_.x, width), across(size_.y, width)};
            width_ = {size_.x / static_cast<double>(count_[0]), size_.y / static_cast<double>(count_[1])};
        }
        fold_ = std::bit_ceil(x.size()) - 1;
        // Row after row of cells, unless there are far more cells than discs.
        const double columns = box ? static_cast<double>(count_[0]) : std::floor((right - low_.x) / width) + 1;
        stride_ = static_cast<std::size_t>(std::min(static_cast<double>(fold_ + 1), columns));
        first_.resize(fold_ + 2);
        std::vector<std::uint32_t> bucket(x.size());
        for_each_rows(threads, x.size(), [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const Cell c = cell_of(x[i]);
                bucket[i] = static_cast<std::uint32_t>(bucket_of(c.x, c.y));
            }
        });
        for (std::size_t i = 0; i < x.size(); ++i)
            if (radius[i] > 0) ++first_[bucket[i]];
        std::uint32_t sum = 0;
        for (std::uint32_t& f : first_) f = sum += f;
        discs_.resize(sum);
        for (std::size_t i = x.size(); i-- > 0;)
            if (radius[i] > 0) discs_[--first_[bucket[i]]] = {x[i], static_cast<std::uint32_t>(i)};
    }

    /// Calls visit(j, from p to the nearest image of j) for the discs in the cell of p and those around it; for some of
    /// them more than once.
    template <class Visit>
    void around(Vec2 p, Visit visit) const {
        const Cell c = cell_of(p);
        const Vec2 inverse = box_ ? Vec2{1 / size_.x, 1 / size_.y} : Vec2{};
        const auto look = [&](std::size_t from, std::size_t to) {
            for (std::uint32_t k = first_[from]; k < first_[to]; ++k) {
                const Vec2 d = discs_[k].x - p;
                visit(discs_[k].row, d - Vec2{size_.x * rounded(d.x * inverse.x), size_.y * rounded(d.y * inverse.y)});
            }
        };
        for (std::int64_t y = c.y - 1; y <= c.y + 1; ++y) {
            const std::size_t left = bucket_of(wrapped(c.x - 1, 0), wrapped(y, 1));
            if (left + 2 <= fold_ && (!box_ || (c.x > 0 && c.x + 1 < count_[0]))) {
                look(left, left + 3);
                continue;
            }
            for (std::int64_t x = c.x - 1; x <= c.x + 1; ++x) {
                const std::size_t b = bucket_of(wrapped(x, 0), wrapped(y, 1));
                look(b, b + 1);
            }
        }
    }

  private:
    struct Cell {
        std::int64_t x, y;
    };
    struct Disc {
        Vec2 x;
        std::uint32_t row;
    };
    static constexpr double most_cells = 1e15;
    static std::int64_t across(double size, double width) {
        return static_cast<std::int64_t>(std::clamp(std::floor(size / width), 1.0, most_cells));
    }
    std::int64_t wrapped(std::int64_t c, int axis) const {
        if (!box_ || (c >= 0 && c < count_[axis])) return c;
        c %= count_[axis];
        return c < 0 ? c + count_[axis] : c;
    }
    Cell cell_of(Vec2 p) const {
        const auto column = [this](double at, int axis) -> std::int64_t {
            if (!(std::abs(at) < most_cells)) return 0;  // nan too: the step ends with an Error
            const auto whole = static_cast<std::int64_t>(at);
            return wrapped(static_cast<double>(whole) > at ? whole - 1 : whole, axis);
        };
        return {column((p.x - low_.x) / width_.x, 0), column((p.y - low_.y) / width_.y, 1)};
    }
    std::size_t bucket_of(std::int64_t x, std::int64_t y) const {
        return (static_cast<std::size_t>(x) + static_cast<std::size_t>(y) * stride_) & fold_;
    }

    std::optional<Periodic> box_;
    Vec2 low_{}, width_, size_{};
    std::array<std::int64_t, 2> count_{};
    std::size_t stride_ = 1, fold_ = 0;
    std::vector<std::uint32_t> first_;
    std::vector<Disc> discs_;
};

/// Twice the most that Σ (n·e)² over the neighbours of a disc can be in a direction e: six equal ones or, around a
/// large disc, as many of the smallest as have room, of which none counts more than 1.
double most_around(double radius, double smallest, double others) {
    constexpr double pi = 0x1.921fb54442d18p1;
    const double fit = pi / portable::asin(smallest / (radius + smallest));
    return std::max(6.0, std::min(fit, 2 * others));
}

}  // namespace

SoftDiscRows::SoftDiscRows(const SoftDiscs& force, std::span<const double> radius, std::span<const double> inverse_mass,
                           std::vector<bool> moves, const std::optional<Periodic>& box)
    : stiffness_(force.stiffness),
      damping_(force.damping),
      radius_(radius.begin(), radius.end()),
      inverse_mass_(inverse_mass.begin(), inverse_mass.end()),
      moves_(std::move(moves)),
      box_(box) {
    check_box();
    double smallest_radius = std::numeric_limits<double>::infinity(), others = -1;
    for (const double r : radius_) {
        if (r == 0) continue;
        largest_radius_ = std::max(largest_radius_, r), smallest_radius = std::min(smallest_radius, r);
        ++others;
    }
    for (std::size_t i = 0; i < radius_.size(); ++i) {
        if (radius_[i] == 0 || inverse_mass_[i] == 0) continue;
        const double around = most_around(radius_[i], smallest_radius, others);
        squared_frequency_ = std::max(squared_frequency_, around * stiffness_ * inverse_mass_[i]);
        damping_rate_ = std::max(damping_rate_, around / 2 * damping_);
    }
}

// Beyond half the box the nearest image is another one, and the force would jump if it were not 0 there.
void SoftDiscRows::check_box() const {
    if (!box_) return;
    double held = 0, moving = 0, next = 0;  // the largest radius of those that are held; of the others the two largest
    for (std::size_t i = 0; i < radius_.size(); ++i) {
        if (!moves_[i])
            held = std::max(held, radius_[i]);
        else if (radius_[i] > moving)
            next = moving, moving = radius_[i];
        else
            next = std::max(next, radius_[i]);
    }
    const double other = std::max(held, next), wide = 2 * (moving + other);
    const Vec2 size = box_->high - box_->low;
    if (moving > 0 && other > 0 && wide > std::min(size.x, size.y))
        throw Error(
            fmt::format("SoftDiscs: the periodic box must be as wide as its two largest discs side by side, {} m, for "
                        "each pair to meet once, and is {} x {} m",
                        wide, size.x, size.y));
}

bool SoftDiscRows::are_good(const Neighbours& neighbours, const State& state, int threads) const {
    struct Largest {
        double value = 0;
        void operator+=(Largest other) { value = std::max(value, other.value); }
    };
    if (neighbours.skin == 0) return false;
    const double half = 0.5 * neighbours.skin, *x = &state.x.linear.data()->x, *was = &neighbours.was.data()->x;
    const auto look = [&](std::size_t first, std::size_t last, Largest& far) {
        far += {soft_kernel().farthest(x + 2 * first, was + 2 * first, last - first)};
    };
    return sum_over_rows<Largest>(threads, state.size(), look).value < half * half;
}

void SoftDiscRows::look_around(const State& state, int threads) {
    if (state.size() > 0 && !are_good(neighbours_, state, threads)) neighbours_ = find(state, threads);
}

Neighbours SoftDiscRows::find(const State& state, int threads) const {
    constexpr double skin_of_radius = 0.4;  // thinner: looked for more often; thicker: more pairs that do not touch
    const std::vector<Vec2>& x = state.x.linear;
    Neighbours found{skin_of_radius * largest_radius_, x, {}, {}};
    const std::size_t n = x.size(), chunks = (n + chunk_rows - 1) / chunk_rows;
    found.first_column.resize(chunks + 1);
    if (largest_radius_ == 0) return found;
    const Cells cells(x, radius_, 2 * largest_radius_ + found.skin, box_, threads);
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
                cells.around(x[i], [&](std::uint32_t j, Vec2 d) {
                    const double reach = radius_[i] + radius_[j] + found.skin;
                    if (squared_length(d) < reach * reach && j != i && (moves_[i] || moves_[j])) near[k].push_back(j);
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
    return soft_kernel().forces(layout(neighbours_), &state.x.linear.data()->x, &state.v.linear.data()->x,
                                &force.data()->x, first, last);
}

double SoftDiscRows::potential(const State& state) const {
    if (state.size() == 0) return 0;
    const bool good = are_good(neighbours_, state, 1);
    const Neighbours fresh = good ? Neighbours{} : find(state, 1);
    return soft_kernel().energy(layout(good ? neighbours_ : fresh), &state.x.linear.data()->x, 0, state.size());
}

}  // namespace carom
