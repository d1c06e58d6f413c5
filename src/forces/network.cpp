#include "forces/network.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <carom/error.hpp>
#include <map>

#include "forces/network_text.hpp"
#include "math/pages.hpp"
#include "simd/isa.hpp"

namespace carom {

namespace {

/// One end of a link, in the list of the body that is there.
struct End {
    Row partner;
    std::uint32_t link;
};

/// The ends of all links, body by body, each body's in the order of its partners' rows.
struct Ends {
    std::vector<std::uint32_t> first;  ///< of each body, and the end
    std::vector<End> list;

    Ends(std::span<const Link> links, std::size_t rows) : first(rows + 1), list(2 * links.size()) {
        for (const Link& l : links) ++first[l.a], ++first[l.b];
        std::uint32_t sum = 0;
        for (std::uint32_t& f : first) f = sum += f;
        for (std::size_t k = links.size(); k-- > 0;) {
            const auto number = static_cast<std::uint32_t>(k);
            list[--first[links[k].a]] = {links[k].b, number};
            list[--first[links[k].b]] = {links[k].a, number};
        }
        const auto by_partner = [](End e, End f) {
            return e.partner != f.partner ? e.partner < f.partner : e.link < f.link;
        };
        for (std::size_t i = 0; i < rows; ++i)
            std::sort(list.begin() + first[i], list.begin() + first[i + 1], by_partner);
    }
};

}  // namespace

/// Fills a network's arrays, chunk by chunk.
class NetworkBuilder {
  public:
    NetworkBuilder(SpringNetwork& net, std::span<const Link> links)
        : net_(net), links_(links), ends_(links, net.rows_), band_of_(links.size()), place_of_(links.size()) {}

    void build() {
        net_.first_column_.reserve(net_.chunks() + 1);
        for (std::size_t row = 0; row < net_.rows_; row += chunk_rows) {
            net_.first_column_.push_back(static_cast<std::uint32_t>(net_.columns_.size()));
            pulls_in_line_ = true;
            lay_chunk(row);
        }
        net_.first_column_.push_back(static_cast<std::uint32_t>(net_.columns_.size()));
        look_below();
        settle_large(net_.columns_);
        settle_large(net_.partners_);
        settle_large(net_.parameters_);
    }

  private:
    using Ends8 = std::array<const End*, chunk_rows>;  ///< null: none at this body

    /// Columns of neighbours first; what is left over goes side by side as it comes.
    void lay_chunk(std::size_t row) {
        std::array<std::vector<End>, chunk_rows>& left = left_;
        const std::size_t count = std::min(chunk_rows, net_.rows_ - row);
        Ends8 next{}, last{};
        for (std::size_t k = 0; k < chunk_rows; ++k) {
            left[k].clear();
            if (k >= count) continue;
            next[k] = ends_.list.data() + ends_.first[row + k];
            last[k] = ends_.list.data() + ends_.first[row + k + 1];
        }
        for (; count == chunk_rows && next[0] != last[0];) {
            bool all = true;
            for (std::size_t k = 1; k < chunk_rows; ++k) {
                for (; next[k] != last[k] && next[k]->partner < next[0]->partner + k; ++next[k])
                    left[k].push_back(*next[k]);
                all &= next[k] != last[k] && next[k]->partner == next[0]->partner + k;
            }
            if (all) {
                add_column(row, next, true);
                for (const End*& end : next) ++end;
            } else {
                left[0].push_back(*next[0]++);
            }
        }
        std::size_t most = 0;
        for (std::size_t k = 0; k < count; ++k) {
            left[k].insert(left[k].end(), next[k], last[k]);
            most = std::max(most, left[k].size());
        }
        for (std::size_t j = 0; j < most; ++j) {
            Ends8 column{};
            for (std::size_t k = 0; k < count; ++k)
                if (j < left[k].size()) column[k] = &left[k][j];
            add_column(row, column, false);
        }
    }

    void add_column(std::size_t row, const Ends8& ends, bool consecutive) {
        NetworkColumn c{};
        c.consecutive = consecutive;
        if (consecutive) {
            c.partners = fitting(ends[0]->partner, most_partners) & most_partners;
        } else {
            c.partners = fitting(net_.partners_.size() / chunk_rows, most_partners) & most_partners;
            for (std::size_t k = 0; k < chunk_rows; ++k)
                net_.partners_.push_back(ends[k] ? ends[k]->partner
                                                 : static_cast<Row>(std::min(row + k, net_.rows_ - 1)));
        }
        const Link* some = nullptr;
        bool uniform = true;
        Springs8 springs;
        springs.fill(none);
        for (std::size_t k = 0; k < chunk_rows; ++k) {
            if (!ends[k]) continue;
            const Link& link = links_[springs[k] = ends[k]->link];
            if (link.damping != 0) c.damped = true;
            if (some) uniform &= parameters(link) == parameters(*some);
            some = &link;
        }
        c.uniform = uniform;
        pulls_in_line_ &= consecutive && !c.damped;
        if (pulls_in_line_) c.band = (ends[0]->partner > row ? band_from(row, springs) : band_to(springs)) & most_bands;
        if (uniform)
            c.parameters = fitting(shared_group(parameters(*some)), most_groups) & most_groups;
        else if (consecutive && ends[0]->partner < row)
            below_.push_back({static_cast<std::uint32_t>(net_.columns_.size()), springs});
        else
            c.parameters = fitting(own_groups(springs, c.damped), most_groups) & most_groups;
        net_.columns_.push_back(c);
    }

    static constexpr std::uint32_t most_partners = (1u << 29) - 1, most_groups = (1u << 28) - 1;
    static std::uint32_t fitting(std::size_t number, std::uint32_t most) {
        if (number > most) throw Error("springs: there are more than fit into a network");
        return static_cast<std::uint32_t>(number);
    }

    static constexpr std::uint32_t none = ~std::uint32_t{0};
    using Springs8 = std::array<std::uint32_t, chunk_rows>;  ///< their numbers; none: none at this body

    /// The band of springs to the higher rows so far from here. Not of those within a chunk or to the next: the lower
    /// rows' sums come before they are computed.
    std::uint32_t band_from(std::size_t row, const Springs8& springs) {
        const std::size_t distance = other_end(springs[0], row) - row;
        if (distance < chunk_rows) return 0;
        const auto [found, fresh] = bands_.try_emplace(distance, static_cast<std::uint32_t>(bands_.size()) + 1);
        if (found->second > most_bands) return 0;
        if (fresh) {
            net_.bands_.push_back({net_.kept_, std::bit_ceil(distance + 2 * chunk_rows) - 1});
            net_.kept_ = net_.bands_.back().end();
        }
        for (const std::uint32_t spring : springs) band_of_[spring] = found->second & most_bands;
        return found->second;
    }
    std::size_t other_end(std::uint32_t spring, std::size_t row) const {
        return links_[spring].a == row ? links_[spring].b : links_[spring].a;
    }
    /// That in which all of them are.
    std::uint32_t band_to(const Springs8& springs) const {
        const std::uint32_t band = band_of_[springs[0]];
        for (const std::uint32_t spring : springs)
            if (band_of_[spring] != band) return 0;
        return band;
    }

    using Parameters = std::array<double, 3>;
    static Parameters parameters(const Link& l) { return {l.stiffness, l.rest_length, l.damping}; }

    std::size_t shared_group(const Parameters& p) {
        const auto [found, fresh] = shared_.try_emplace(p, groups());
        if (fresh) {
            net_.parameters_.insert(net_.parameters_.end(), p.begin(), p.end());
            net_.parameters_.resize(chunk_rows * (found->second + 1));
        }
        return found->second;
    }
    std::size_t own_groups(const Springs8& springs, bool damped) {
        const std::size_t number = groups();
        for (std::size_t k = 0; k < chunk_rows; ++k)
            if (springs[k] != none) place_of_[springs[k]] = {chunk_rows * number + k, damped};
        for (std::size_t which = 0; which < (damped ? 3 : 2); ++which)
            for (const std::uint32_t spring : springs)
                net_.parameters_.push_back(spring == none ? 0 : parameters(links_[spring])[which]);
        return number;
    }
    std::size_t groups() const { return net_.parameters_.size() / chunk_rows; }

    /// Where a spring's own parameters are.
    struct Place {
        std::size_t stiffness = nowhere;
        bool damping = false;  ///< whether its damping is there too

        std::size_t group() const { return stiffness / chunk_rows; }
    };
    static constexpr std::size_t nowhere = ~std::size_t{0};
    /// A column of neighbours in lower rows.
    struct Below {
        std::uint32_t column;
        Springs8 springs;
    };
    /// Their parameters lie with the partners, or else at the end.
    void look_below() {
        std::map<std::size_t, std::size_t> votes;
        for (const Below& below : below_) ++votes[next_chunk(below)];
        std::size_t most = 0;
        for (const auto& [distance, number] : votes)
            if (distance != nowhere && number > most) net_.next_chunk_ = distance, most = number;
        for (const Below& below : below_) {
            NetworkColumn& c = net_.columns_[below.column];
            c.with_partners = lie_with_partners(below.springs, c);
            const std::size_t group =
                c.with_partners ? place_of_[below.springs[0]].group() : own_groups(below.springs, c.damped);
            c.parameters = fitting(group, most_groups) & most_groups;
        }
    }
    /// What next_chunk_ would have to be; nowhere: anything or nothing will do.
    std::size_t next_chunk(const Below& below) const {
        const Place &first = place_of_[below.springs.front()], &last = place_of_[below.springs.back()];
        if (first.stiffness == nowhere || last.stiffness == nowhere || last.group() <= first.group()) return nowhere;
        return (last.group() - first.group()) * chunk_rows;
    }
    bool lie_with_partners(const Springs8& springs, const NetworkColumn& c) const {
        const std::size_t first = c.partners % chunk_rows, group = place_of_[springs[0]].group() * chunk_rows;
        for (std::size_t k = 0; k < chunk_rows; ++k) {
            const Place& place = place_of_[springs[k]];
            const std::size_t of_next = first + k < chunk_rows ? 0 : net_.next_chunk_;
            if (place.stiffness == nowhere || (c.damped && !place.damping) ||
                place.stiffness != group + of_next + (first + k) % chunk_rows)
                return false;
        }
        return true;
    }

    SpringNetwork& net_;
    std::span<const Link> links_;
    Ends ends_;
    std::array<std::vector<End>, chunk_rows> left_;  ///< a chunk's ends that are in no column of neighbours
    std::map<Parameters, std::size_t> shared_;       ///< numbers of groups that columns share
    bool pulls_in_line_ = true;                      ///< all of a chunk's columns yet: only then pulls are kept
    std::map<std::size_t, std::uint32_t> bands_;     ///< numbers of bands, by distance
    std::vector<std::uint8_t> band_of_;              ///< of each spring; 0: none
    std::vector<Place> place_of_;                    ///< of each spring
    std::vector<Below> below_;
};

SpringNetwork::SpringNetwork(std::span<const Link> links, std::size_t rows) : rows_(rows) {
    if (links.empty()) return;
    damped_ = std::any_of(links.begin(), links.end(), [](const Link& l) { return l.damping != 0; });
    NetworkBuilder(*this, links).build();
    if (!are_few(rows)) return;
    few_ = this->links();
}

NetworkLayout SpringNetwork::layout() const {
    return {rows_,       first_column_.data(), columns_.data(), partners_.data(), parameters_.data(),
            next_chunk_, bands_.data()};
}

namespace {

const NetworkKernel& network_kernel() {
    return kernel_in_use<baseline_network_kernel, avx2_network_kernel, avx512_network_kernel>();
}

}  // namespace

NetworkPowers SpringNetwork::write_forces(const State& state, std::size_t first, std::size_t last,
                                          std::span<Vec2> force, Pass* pass) const {
    if (!few_.empty())
        return forces_on_few<SingleSum>(few(), &state.x.linear.data()->x, &state.v.linear.data()->x, &force.data()->x);
    const KeptPulls kept = pass ? pass->kept() : KeptPulls{nullptr, ~std::size_t{0}};
    return network_kernel().forces(layout(), kept, &state.x.linear.data()->x, &state.v.linear.data()->x,
                                   &force.data()->x, first, last);
}

double SpringNetwork::potential(const State& state, std::size_t first, std::size_t last) const {
    return network_kernel().energy(layout(), &state.x.linear.data()->x, first, last);
}

void SpringNetwork::write_stiffness(const State& state, std::size_t first, std::size_t last,
                                    const std::vector<double>& inverse_mass, std::span<NodeStiffness> node) const {
    network_kernel().stiffness(layout(), &state.x.linear.data()->x, inverse_mass.data(), node.data(), first, last);
}

std::vector<Link> SpringNetwork::links() const {
    std::vector<Link> out;
    for (std::size_t chunk = 0; chunk < chunks() && !empty(); ++chunk)
        for (std::size_t row = chunk * chunk_rows; row < std::min(rows_, (chunk + 1) * chunk_rows); ++row)
            for (std::size_t c = first_column_[chunk]; c < first_column_[chunk + 1]; ++c) {
                const NetworkColumn& column = columns_[c];
                const std::size_t k = row % chunk_rows;
                const std::size_t partner =
                    column.consecutive ? column.partners + k : partners_[chunk_rows * column.partners + k];
                if (partner <= row) continue;
                const double* p = &parameters_[chunk_rows * column.parameters + (column.uniform ? 0 : k)];
                const std::size_t next = column.uniform ? 1 : chunk_rows;
                out.push_back(
                    {static_cast<Row>(row), static_cast<Row>(partner), p[0], p[next], column.damped ? p[2 * next] : 0});
            }
    return out;
}

std::size_t SpringNetwork::bytes() const {
    return sizeof(*this) + sizeof(NetworkColumn) * columns_.capacity() + sizeof(double) * parameters_.capacity() +
           sizeof(Row) * (first_column_.capacity() + partners_.capacity());
}

}  // namespace carom
