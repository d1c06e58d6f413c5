#include "math/elimination.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <queue>
#include <tuple>

namespace carom {

namespace {

using Rows = Scratch<std::uint32_t>;

Neighbours neighbours(std::size_t rows, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    Neighbours near(rows);
    for (const auto& [a, b] : couplings) near[a].push_back(b), near[b].push_back(a);
    for (auto& list : near) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return near;
}

/// Of blocks, for a row that so many later ones are coupled to when it is taken out.
std::size_t products(std::size_t later) { return later * (later + 1) / 2; }

/// Rows of least degree first.
class ByLeastDegree {
  public:
    explicit ByLeastDegree(Neighbours near) : near_(std::move(near)), turn_(near_.size(), 0), seen_(near_.size(), 0) {
        for (std::uint32_t i = 0; i < near_.size(); ++i) line_up(i);
    }
    /// Goes on until all are taken or it is more than so much work; whether it is not.
    bool run(std::size_t most) {
        while (!left_.empty() && work_ <= most) {
            const Left least = left_.top();
            left_.pop();
            if (const std::uint32_t row = std::get<2>(least); least == now(row)) take_out(row);
        }
        return work_ <= most;
    }
    Elimination found() { return {std::move(order_), std::move(near_)}; }

  private:
    // Rows of no more than one neighbour bring no fill, in whatever order: they are taken by turns, as they come to be
    // so, from all ends of a chain or a tree. What one end waits for in a factor or a solve, another uses.
    using Left = std::tuple<std::size_t, std::uint32_t, std::uint32_t>;  // by degree, by turn, by number
    static constexpr std::uint32_t taken = 0xffffffff;                   ///< no turn

    Left now(std::uint32_t row) const { return {near_[row].size(), turn_[row], row}; }
    /// What it was lined up as before stays in the line, and is passed over.
    void line_up(std::uint32_t row) {
        if (near_[row].size() <= 1) turn_[row] = ++turns_;
        left_.push(now(row));
    }
    /// Its neighbours become neighbours of one another. What is left in its own list are those eliminated later.
    void take_out(std::uint32_t row) {
        Rows& others = near_[row];
        std::sort(others.begin(), others.end());
        order_.push_back(row), work_ += products(others.size());
        turn_[row] = taken;
        for (const std::uint32_t i : others) {
            Rows& own = near_[i];
            own.erase(std::find(own.begin(), own.end(), row));
            seen_[i] = ++seeing_;
            for (const std::uint32_t j : own) seen_[j] = seeing_;
            for (const std::uint32_t j : others)
                if (seen_[j] != seeing_) own.push_back(j);
            line_up(i);
        }
    }

    Neighbours near_;
    std::priority_queue<Left, Scratch<Left>, std::greater<>> left_{};
    Rows turn_, order_{};
    Scratch<std::uint64_t> seen_;  ///< by whom a row was last seen as a neighbour
    std::uint64_t seeing_ = 0;
    std::uint32_t turns_ = 0;
    std::size_t work_ = 0;
};

/// What is left of a row's neighbours when it is taken out are those that come later, and those of the rows to which it
/// was the first of these: its children in the elimination tree (J. W. H. Liu, SIAM J. Matrix Anal. Appl. 11, 134,
/// 1990).
Elimination in_order(Rows order, const Neighbours& near) {
    Rows place(order.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) place[order[k]] = k;
    Neighbours later(near.size());
    Rows joined;
    const auto join = [&joined](Rows& to, const Rows& more) {
        joined.clear();
        std::set_union(to.begin(), to.end(), more.begin(), more.end(), std::back_inserter(joined));
        to.swap(joined);
    };
    const auto is_sooner = [&](std::uint32_t i, std::uint32_t j) { return place[i] < place[j]; };
    for (const std::uint32_t row : order) {
        Rows& own = later[row];
        join(own, near[row]);
        std::erase_if(own, [&](std::uint32_t i) { return !is_sooner(row, i); });
        if (!own.empty()) join(later[*std::min_element(own.begin(), own.end(), is_sooner)], own);
    }
    return {std::move(order), std::move(later)};
}

/// Nested dissection (A. George, SIAM J. Numer. Anal. 10, 345, 1973): a few rows part the graph in two, and go after
/// either part. Where to cut is found by distances from four rows that lie far apart. That from one corner of a sheet
/// grows across it, but the difference of those from two corners grows along one side, and cuts of that are short.
class Dissection {
  public:
    explicit Dissection(const Neighbours& near) : near_(near), piece_(near.size(), 0), value_(near.size()) {
        for (Distances& away : away_) away.resize(near.size());
        Rows all(near.size());
        std::iota(all.begin(), all.end(), 0U);
        cut(std::move(all));
    }
    Rows order() { return std::move(order_); }

  private:
    static constexpr std::size_t few = 8;  ///< rows that are not cut further
    static constexpr std::size_t corners = 4;
    using Distances = Scratch<std::int32_t>;  ///< −1 of what is not reached

    /// Between the rows whose value is less than `at` and the others.
    struct Cut {
        std::size_t cost = SIZE_MAX, from = 0, to = 0;
        std::int32_t at = 0;
    };
    bool is_in(std::uint32_t row, std::uint32_t piece) const { return piece_[row] == piece; }

    void cut(Rows rows) {
        if (rows.size() <= few) return take_few(rows);
        const std::uint32_t piece = ++pieces_;
        for (const std::uint32_t i : rows) piece_[i] = piece;
        std::uint32_t corner = measure(rows, rows[0], piece, away_[0]);
        if (std::any_of(rows.begin(), rows.end(), [&](std::uint32_t i) { return away_[0][i] < 0; }))
            return part(rows, [&](std::uint32_t i) { return away_[0][i] >= 0; });
        for (std::size_t k = 0; k < corners; ++k) {
            measure(rows, corner, piece, away_[k]);
            corner = *std::max_element(rows.begin(), rows.end(), [&](std::uint32_t i, std::uint32_t j) {
                return nearest(k + 1, i) < nearest(k + 1, j);
            });
        }
        Cut best;
        for (std::size_t from = 0; from < corners; ++from)
            for (std::size_t to = from; to < corners; ++to) look_for_cut(rows, piece, from, to, best);
        if (best.cost == SIZE_MAX) return take_few(rows);
        set_values(rows, best.from, best.to);
        part_along(rows, piece, best.at);
    }
    std::int32_t nearest(std::size_t count, std::uint32_t row) const {
        std::int32_t least = away_[0][row];
        for (std::size_t k = 1; k < count; ++k) least = std::min(least, away_[k][row]);
        return least;
    }
    /// The distances of a piece's rows from one of them; returns the farthest.
    std::uint32_t measure(const Rows& rows, std::uint32_t from, std::uint32_t piece, Distances& away) {
        for (const std::uint32_t i : rows) away[i] = -1;
        Rows reached(1, from);
        away[from] = 0;
        for (std::size_t k = 0; k < reached.size(); ++k)
            for (const std::uint32_t i : near_[reached[k]])
                if (is_in(i, piece) && away[i] < 0) away[i] = away[reached[k]] + 1, reached.push_back(i);
        return reached.back();
    }
    void set_values(const Rows& rows, std::size_t from, std::size_t to) {
        for (const std::uint32_t i : rows) value_[i] = away_[from][i] - (from == to ? 0 : away_[to][i]);
    }
    /// The cut of all along one pair of corners that takes fewest rows and leaves parts that are nearly equal.
    void look_for_cut(const Rows& rows, std::uint32_t piece, std::size_t from, std::size_t to, Cut& best) {
        set_values(rows, from, to);
        const auto [low, high] = std::minmax_element(
            rows.begin(), rows.end(), [&](std::uint32_t i, std::uint32_t j) { return value_[i] < value_[j]; });
        const std::int32_t first = value_[*low], last = value_[*high];
        // By how much there are more than at the cut before: rows below it, and on either side of it those at it.
        struct Change {
            std::ptrdiff_t below = 0, at_below = 0, at_above = 0;
        };
        Scratch<Change> change(static_cast<std::size_t>(last - first) + 2);
        const auto at = [&](std::int32_t value) -> Change& { return change[static_cast<std::size_t>(value - first)]; };
        for (const std::uint32_t i : rows) {
            const std::int32_t own = value_[i];
            std::int32_t least = own, most = own;
            for (const std::uint32_t j : near_[i])
                if (is_in(j, piece)) least = std::min(least, value_[j]), most = std::max(most, value_[j]);
            ++at(own + 1).below;
            ++at(own + 1).at_below, --at(most + 1).at_below;
            ++at(least + 1).at_above, --at(own + 1).at_above;
        }
        Change sum;
        for (std::int32_t value = first; value <= last; ++value) {
            sum.below += at(value).below, sum.at_below += at(value).at_below, sum.at_above += at(value).at_above;
            const auto below = static_cast<std::size_t>(sum.below), larger = std::max(below, rows.size() - below);
            if (below == 0 || 8 * larger > 5 * rows.size()) continue;
            const auto taken = static_cast<std::size_t>(std::min(sum.at_below, sum.at_above));
            const std::size_t cost = taken * (rows.size() + 2 * larger);
            if (cost < best.cost) best = {cost, from, to, value};
        }
    }
    /// The rows at the cut on the side where they are fewer go after all others.
    void part_along(const Rows& rows, std::uint32_t piece, std::int32_t at) {
        const auto is_below = [&](std::uint32_t i) { return value_[i] < at; };
        Rows edge[2];
        for (const std::uint32_t i : rows)
            if (std::any_of(near_[i].begin(), near_[i].end(),
                            [&](std::uint32_t j) { return is_in(j, piece) && is_below(j) != is_below(i); }))
                edge[is_below(i) ? 0 : 1].push_back(i);
        const Rows& taken = edge[edge[0].size() <= edge[1].size() ? 0 : 1];
        for (const std::uint32_t i : taken) piece_[i] = 0;
        Rows left;
        std::copy_if(rows.begin(), rows.end(), std::back_inserter(left),
                     [&](std::uint32_t i) { return is_in(i, piece); });
        part(left, is_below);
        order_.insert(order_.end(), taken.begin(), taken.end());
    }
    template <class IsFirst>
    void part(const Rows& rows, IsFirst is_first) {
        Rows first, second;
        for (const std::uint32_t i : rows) (is_first(i) ? first : second).push_back(i);
        cut(std::move(first));
        cut(std::move(second));
    }
    /// By least degree, as if there were no others.
    void take_few(const Rows& rows) {
        Neighbours near(rows.size());
        for (std::size_t k = 0; k < rows.size(); ++k)
            for (const std::uint32_t i : near_[rows[k]])
                if (const auto at = std::lower_bound(rows.begin(), rows.end(), i); at != rows.end() && *at == i)
                    near[k].push_back(static_cast<std::uint32_t>(at - rows.begin()));
        ByLeastDegree own(std::move(near));
        own.run(SIZE_MAX);
        for (const std::uint32_t k : own.found().rows) order_.push_back(rows[k]);
    }

    const Neighbours& near_;
    Rows piece_;  ///< in which a row is; 0 if it has its place
    std::uint32_t pieces_ = 0;
    Distances away_[corners];  ///< of a piece's rows from its corners
    Distances value_;
    Rows order_{};
};

}  // namespace

std::size_t Elimination::work() const {
    std::size_t sum = 0;
    for (const auto& list : later) sum += products(list.size());
    return sum;
}

Elimination eliminate(std::size_t rows, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    constexpr std::size_t much = 100;  // products a row
    const Neighbours near = neighbours(rows, couplings);
    ByLeastDegree by_degree(near);
    return by_degree.run(much * rows) ? by_degree.found() : in_order(Dissection(near).order(), near);
}

}  // namespace carom
