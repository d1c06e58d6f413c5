#include "math/elimination.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <optional>
#include <tuple>

#include "simd/shorts.hpp"

namespace carom {

namespace {

using Rows = Scratch<std::uint32_t>;

/// Of each row those that it is coupled with, ascending.
struct Graph {
    Scratch<std::size_t> first{};  ///< of each row, in `near`; and the end of the last
    Rows near{};

    std::size_t size() const { return first.size() - 1; }
    std::span<const std::uint32_t> of(std::size_t row) const {
        return {near.data() + first[row], near.data() + first[row + 1]};
    }
};

Graph graph_of(std::size_t rows, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    Scratch<std::size_t> next(rows + 1, 0);
    for (const auto& [a, b] : couplings) ++next[a], ++next[b];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
    Rows all(2 * couplings.size());
    for (const auto& [a, b] : couplings)
        all[next[a]++] = b, all[next[b]++] = a;  // in the end each is where that of the next one begins
    Graph graph;
    graph.first.assign(1, 0);
    for (std::size_t i = 0, begin = 0; i < rows; begin = next[i++]) {
        const auto from = all.begin() + static_cast<std::ptrdiff_t>(begin),
                   to = all.begin() + static_cast<std::ptrdiff_t>(next[i]);
        std::sort(from, to);
        graph.near.insert(graph.near.end(), from, std::unique(from, to));
        graph.first.push_back(graph.near.size());
    }
    return graph;
}

/// Of blocks, for a row that so many later ones are coupled to when it is taken out.
std::size_t products(std::size_t later) { return later * (later + 1) / 2; }

/// Rows of least degree first.
class ByLeastDegree {
  public:
    /// Goes on until all are taken or it is more than so much work; whether it is not.
    bool run(const Graph& graph, std::size_t most) {
        const std::size_t rows = graph.size();
        if (least_work(graph) > static_cast<double>(most)) return false;
        near_.resize(std::max(near_.size(), rows)), turn_.assign(rows, 0), seen_.assign(rows, 0);
        order_.clear(), left_.clear();
        turns_ = 0, seeing_ = 0;
        for (std::uint32_t i = 0; i < rows; ++i) {
            near_[i].assign(graph.of(i).begin(), graph.of(i).end());
            line_up(i);
        }
        std::size_t work = 0;
        while (!left_.empty() && work <= most) {
            const Left least = left_.front();
            std::pop_heap(left_.begin(), left_.end(), std::greater<>{}), left_.pop_back();
            if (const std::uint32_t row = std::get<2>(least); least == now(row))
                work += products(near_[row].size()), take_out(row);
        }
        return work <= most;
    }
    const Rows& order() const { return order_; }

  private:
    /// In products: each coupling is one of a row when it is taken out, and it is the least where all have as many.
    static double least_work(const Graph& graph) {
        const auto couplings = 0.5 * static_cast<double>(graph.near.size()), rows = static_cast<double>(graph.size());
        return rows > 0 ? 0.5 * couplings * (couplings / rows + 1) : 0;
    }
    // Rows of no more than one neighbour bring no fill, in whatever order: they are taken by turns, as they come to be
    // so, from all ends of a chain or a tree. What one end waits for in a factor or a solve, another uses.
    using Left = std::tuple<std::size_t, std::uint32_t, std::uint32_t>;  // by degree, by turn, by number
    static constexpr std::uint32_t taken = 0xffffffff;                   ///< no turn

    Left now(std::uint32_t row) const { return {near_[row].size(), turn_[row], row}; }
    /// What it was lined up as before stays in the line, and is passed over.
    void line_up(std::uint32_t row) {
        if (near_[row].size() <= 1) turn_[row] = ++turns_;
        left_.push_back(now(row)), std::push_heap(left_.begin(), left_.end(), std::greater<>{});
    }
    /// Its neighbours become neighbours of one another.
    void take_out(std::uint32_t row) {
        Rows& others = near_[row];
        std::sort(others.begin(), others.end());
        order_.push_back(row);
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

    Scratch<Rows> near_{};
    Scratch<Left> left_{};  ///< a heap
    Rows turn_{}, order_{};
    Scratch<std::uint64_t> seen_{};  ///< by whom a row was last seen as a neighbour
    std::uint64_t seeing_ = 0;
    std::uint32_t turns_ = 0;
};

/// Nested dissection (A. George, SIAM J. Numer. Anal. 10, 345, 1973): a few rows part the graph in two, and go after
/// either part. Where to cut is found by distances from four rows that lie far apart. That from one corner of a sheet
/// grows across it, but the difference of those from two corners grows along one side, and cuts of that are short.
class Dissection {
  public:
    /// How many rows the first cut takes; 0 if none does.
    std::size_t width(const Graph& graph) {
        first_ = look_at(graph);
        return first_->best.fewer;
    }
    const Rows& order(const Graph& graph) {
        Piece all{graph, Rows(graph.size()), {}, graph.size()};
        std::iota(all.row.begin(), all.row.end(), 0U);
        cut(std::move(all), first_ ? std::move(*first_) : look_at(graph));
        return order_;
    }

  private:
    static constexpr std::size_t few = 8;  ///< rows that are not cut further
    static constexpr std::size_t corners = 4, ways = corners * (corners + 1) / 2;
    /// Of a row: its distance from each corner, and differences of two; in steps, or in more than one if some are far.
    using Values = Shorts;
    static_assert(ways * sizeof(std::int16_t) <= sizeof(Values));
    enum Side : std::uint8_t { below, above, taken };

    /// Rows that are numbered anew, and what they were; with their values among those with which they were looked at.
    struct Piece {
        Graph graph{};
        Rows row{};
        Scratch<Values> values{};
        std::size_t looked_at = 0;  ///< so many
    };
    /// Between the rows whose value is less than `at` and the others.
    struct Cut {
        std::size_t cost = SIZE_MAX, fewer = 0, way = 0;
        std::int32_t at = 0;
    };

    /// What is known of a piece: values of its rows, or who is reached by the first; and the best of its cuts.
    struct Look {
        Scratch<Values> values{};
        bool is_one = false;
        Cut best{};
    };

    static Look look_at(const Graph& graph) {
        Look look;
        look.is_one = has_one_part(graph, look.values);
        if (look.is_one) look.best = best_cut(graph, look.values);
        return look;
    }
    /// By the values that are known, for a while: a sheet is cut by the same corners again, but an arm of what is bent
    /// has corners of its own.
    void cut(Piece piece) {
        constexpr std::size_t a_while = 16;
        const std::size_t rows = piece.row.size();
        if (rows <= few) return take_few(piece);
        Look look{std::move(piece.values), true, {}};
        if (a_while * rows >= piece.looked_at) look.best = best_cut(piece.graph, look.values);
        if (look.best.cost == SIZE_MAX) look = look_at(piece.graph), piece.looked_at = rows;
        cut(std::move(piece), std::move(look));
    }
    void cut(Piece piece, Look look) {
        const Graph& graph = piece.graph;
        if (look.is_one && look.best.cost == SIZE_MAX) return take_few(piece);
        Scratch<Side> side(graph.size(), below);
        if (look.is_one)
            part_along(graph, look.values, look.best, side);
        else
            for (std::size_t i = 0; i < graph.size(); ++i) side[i] = look.values[i][0] < 0 ? above : below;
        Rows last;
        for (std::size_t i = 0; i < graph.size(); ++i)
            if (side[i] == taken) last.push_back(piece.row[i]);
        auto [first, second] = parted(piece, look, side);
        piece = {}, side = {}, look = {};
        cut(std::move(first));
        cut(std::move(second));
        order_.insert(order_.end(), last.begin(), last.end());
    }

    /// Whether all rows can be reached from one another. Finds their values then, or else who is reached by the first.
    static bool has_one_part(const Graph& graph, Scratch<Values>& values) {
        const std::size_t rows = graph.size();
        std::array<Scratch<std::int32_t>, corners> away;
        Rows reached;
        values.resize(rows);
        measure(graph, 0, away[0], reached);
        if (reached.size() < rows) {
            for (std::size_t i = 0; i < rows; ++i) values[i][0] = away[0][i] < 0 ? -1 : 0;
            return false;
        }
        Scratch<std::int32_t> nearest(rows, INT32_MAX);
        std::uint32_t corner = reached.back();
        std::int32_t longest = 0;
        for (Scratch<std::int32_t>& own : away) {
            measure(graph, corner, own, reached);
            longest = std::max(longest, own[reached.back()]);
            for (std::size_t i = 0; i < rows; ++i) nearest[i] = std::min(nearest[i], own[i]);
            const auto farthest = std::max_element(nearest.begin(), nearest.end());
            corner = static_cast<std::uint32_t>(farthest - nearest.begin());
        }
        int bits = 0;
        while (longest >> bits > INT16_MAX / 2) ++bits;
        for (std::size_t i = 0; i < rows; ++i)
            for (std::size_t from = 0, way = 0; from < corners; ++from)
                for (std::size_t to = from; to < corners; ++to)
                    values[i][way++] =
                        static_cast<std::int16_t>((away[from][i] >> bits) - (from == to ? 0 : away[to][i] >> bits));
        return true;
    }
    /// The distances from a row, −1 where there is no way; and who was reached, the farthest last.
    static void measure(const Graph& graph, std::uint32_t from, Scratch<std::int32_t>& away, Rows& reached) {
        away.assign(graph.size(), -1);
        away[from] = 0;
        reached.resize(graph.size());
        reached[0] = from;
        std::size_t count = 1;
        for (std::size_t k = 0; k < count; ++k) {
            const std::int32_t next = away[reached[k]] + 1;
            for (const std::uint32_t i : graph.of(reached[k]))
                if (away[i] < 0) away[i] = next, reached[count++] = i;
        }
        reached.resize(count);
    }

    /// How many rows have a value, and how many have no neighbour of less, or of more.
    struct Count {
        std::int32_t own = 0, least = 0, most = 0;
    };
    /// The cut along one of the ways that takes fewest rows and leaves parts that are nearly equal.
    static Cut best_cut(const Graph& graph, const Scratch<Values>& values) {
        Values low = values[0], high = values[0];
        for (const Values& own : values) take_in(own, low, high);
        std::array<Scratch<Count>, ways> counts;
        for (std::size_t way = 0; way < ways; ++way)
            counts[way].resize(static_cast<std::size_t>(high[way] - low[way]) + 1);
        for (std::size_t i = 0; i < graph.size(); ++i) {
            Values least = values[i], most = values[i];
            for (const std::uint32_t j : graph.of(i)) take_in(values[j], least, most);
            const Values own = values[i] - low;
            least -= low, most -= low;
            for (std::size_t way = 0; way < ways; ++way)
                ++counts[way][own[way]].own, ++counts[way][least[way]].least, ++counts[way][most[way]].most;
        }
        Cut best;
        for (std::size_t way = 0; way < ways; ++way) look_for_cut(graph.size(), way, low[way], counts[way], best);
        return best;
    }
    static void look_for_cut(std::size_t rows, std::size_t way, std::int32_t low, const Scratch<Count>& counts,
                             Cut& best) {
        Count sum;  // of all whose value is below the cut
        for (std::size_t k = 0; k < counts.size(); ++k) {
            const auto count_below = static_cast<std::size_t>(sum.own),
                       larger = std::max(count_below, rows - count_below);
            if (count_below > 0 && 8 * larger <= 5 * rows) {
                // Those on either side that have a neighbour on the other.
                const std::int32_t at_below = sum.own - sum.most, at_above = sum.least - sum.own;
                const auto fewer = static_cast<std::size_t>(std::min(at_below, at_above));
                const std::size_t cost = fewer * (rows + 2 * larger);
                if (cost < best.cost) best = {cost, fewer, way, low + static_cast<std::int32_t>(k)};
            }
            sum.own += counts[k].own, sum.least += counts[k].least, sum.most += counts[k].most;
        }
    }
    /// The rows at the cut are taken on the side where they are fewer.
    static void part_along(const Graph& graph, const Scratch<Values>& values, const Cut& cut, Scratch<Side>& side) {
        const auto is_below = [&](std::size_t i) { return values[i][cut.way] < cut.at; };
        Rows edge[2];
        for (std::uint32_t i = 0; i < graph.size(); ++i) {
            side[i] = is_below(i) ? below : above;
            const auto near = graph.of(i);
            if (std::any_of(near.begin(), near.end(), [&](std::uint32_t j) { return is_below(j) != is_below(i); }))
                edge[side[i]].push_back(i);
        }
        for (const std::uint32_t i : edge[edge[below].size() <= edge[above].size() ? below : above]) side[i] = taken;
    }
    static std::array<Piece, 2> parted(const Piece& from, const Look& look, const Scratch<Side>& side) {
        std::array<Piece, 2> parts;
        Rows number(side.size());
        for (std::size_t i = 0; i < side.size(); ++i) {
            if (side[i] == taken) continue;
            Piece& part = parts[side[i]];
            number[i] = static_cast<std::uint32_t>(part.row.size());
            part.row.push_back(from.row[i]);
            if (look.is_one) part.values.push_back(look.values[i]);
        }
        for (Piece& part : parts) {
            part.graph.first.assign(1, 0);
            part.looked_at = look.is_one ? from.looked_at : SIZE_MAX;
        }
        for (std::size_t i = 0; i < side.size(); ++i) {
            if (side[i] == taken) continue;
            Graph& graph = parts[side[i]].graph;
            for (const std::uint32_t j : from.graph.of(i))
                if (side[j] == side[i]) graph.near.push_back(number[j]);
            graph.first.push_back(graph.near.size());
        }
        return parts;
    }
    /// By least degree, as if there were no others.
    void take_few(const Piece& piece) {
        by_degree_.run(piece.graph, SIZE_MAX);
        for (const std::uint32_t k : by_degree_.order()) order_.push_back(piece.row[k]);
    }

    std::optional<Look> first_{};
    ByLeastDegree by_degree_{};
    Rows order_{};
};

/// Below a row are those of its neighbours that come later, and who is below those that it is the first one below of:
/// its children in the elimination tree (J. W. H. Liu, SIAM J. Matrix Anal. Appl. 11, 134, 1990).
Elimination in_order(const Rows& order, const Graph& graph) {
    constexpr std::uint32_t none = 0xffffffff;
    const auto rows = static_cast<std::uint32_t>(order.size());
    Rows place(rows), seen(rows, none), first_child(rows, none), next_child(rows, none);
    for (std::uint32_t k = 0; k < rows; ++k) place[order[k]] = k;
    Elimination out{order, {}, {}};
    out.column.assign(1, 0);
    for (std::uint32_t k = 0; k < rows; ++k) {
        const auto begin = static_cast<std::ptrdiff_t>(out.below.size());
        const auto add = [&](std::uint32_t p) {
            if (p > k && std::exchange(seen[p], k) != k) out.below.push_back(p);
        };
        for (std::uint32_t c = first_child[k]; c != none; c = next_child[c])
            for (std::size_t q = out.column[c]; q < out.column[c + 1]; ++q) add(out.below[q]);
        for (const std::uint32_t i : graph.of(order[k])) add(place[i]);
        const auto from = out.below.begin() + begin;
        if (!std::is_sorted(from, out.below.end())) std::sort(from, out.below.end());
        out.column.push_back(out.below.size());
        if (from == out.below.end()) continue;
        next_child[k] = std::exchange(first_child[*from], k);
    }
    return out;
}

}  // namespace

std::size_t Elimination::work() const {
    std::size_t sum = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) sum += products(count_below(k));
    return sum;
}

Elimination eliminate(std::size_t rows, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    constexpr std::size_t much = 100, little = 2;  // products a row
    constexpr std::size_t wide = 32;               // a sheet that no cut of fewer rows parts takes much
    const Graph graph = graph_of(rows, couplings);
    Dissection dissection;
    const bool is_wide = rows > wide * wide && dissection.width(graph) > wide;
    ByLeastDegree by_degree;  // of what is wide only trees
    if (by_degree.run(graph, (is_wide ? little : much) * rows)) return in_order(by_degree.order(), graph);
    return in_order(dissection.order(graph), graph);
}

}  // namespace carom
