#include "forces/network.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "simd/isa.hpp"
#include "state/pages.hpp"

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
        : net_(net), links_(links), ends_(links, net.rows_) {}

    void build() {
        net_.first_column_.reserve(net_.chunks() + 1);
        for (std::size_t row = 0; row < net_.rows_; row += chunk_rows) {
            net_.first_column_.push_back(static_cast<std::uint32_t>(net_.columns_.size()));
            lay_chunk(row);
        }
        net_.first_column_.push_back(static_cast<std::uint32_t>(net_.columns_.size()));
        net_.columns_.shrink_to_fit();
        net_.partners_.shrink_to_fit();
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
        Column c{};
        c.consecutive = consecutive;
        if (consecutive) {
            c.partners = ends[0]->partner;
        } else {
            c.partners = static_cast<std::uint32_t>(net_.partners_.size() / chunk_rows);
            for (std::size_t k = 0; k < chunk_rows; ++k)
                net_.partners_.push_back(ends[k] ? ends[k]->partner
                                                 : static_cast<Row>(std::min(row + k, net_.rows_ - 1)));
        }
        const Link* some = nullptr;
        bool uniform = true;
        for (const End* end : ends) {
            if (!end) continue;
            const Link& link = links_[end->link];
            if (link.damping != 0) c.damped = true;
            if (some) uniform &= parameters(link) == parameters(*some);
            some = &link;
        }
        c.uniform = uniform;
        const std::uint32_t number = uniform ? shared_group(parameters(*some)) : own_groups(ends, c.damped);
        c.parameters = number & 0x1fffffff;  // 2²⁹ groups are 34 GB
        net_.columns_.push_back(c);
    }

    using Parameters = std::array<double, 3>;
    static Parameters parameters(const Link& l) { return {l.stiffness, l.rest_length, l.damping}; }

    std::uint32_t shared_group(const Parameters& p) {
        const auto [found, fresh] = shared_.try_emplace(p, groups());
        if (fresh) {
            net_.parameters_.insert(net_.parameters_.end(), p.begin(), p.end());
            net_.parameters_.resize(chunk_rows * (found->second + 1));
        }
        return found->second;
    }
    std::uint32_t own_groups(const Ends8& ends, bool damped) {
        const std::uint32_t number = groups();
        for (std::size_t which = 0; which < (damped ? 3 : 2); ++which)
            for (const End* end : ends) net_.parameters_.push_back(end ? parameters(links_[end->link])[which] : 0);
        return number;
    }
    std::uint32_t groups() const { return static_cast<std::uint32_t>(net_.parameters_.size() / chunk_rows); }

    SpringNetwork& net_;
    std::span<const Link> links_;
    Ends ends_;
    std::array<std::vector<End>, chunk_rows> left_;  ///< a chunk's ends that are in no column of neighbours
    std::map<Parameters, std::uint32_t> shared_;     ///< numbers of groups that columns share
};

SpringNetwork::SpringNetwork(std::span<const Link> links, std::size_t rows) : rows_(rows) {
    if (links.empty()) return;
    damped_ = std::any_of(links.begin(), links.end(), [](const Link& l) { return l.damping != 0; });
    NetworkBuilder(*this, links).build();
}

NetworkLayout SpringNetwork::layout() const {
    return {rows_, first_column_.data(), columns_.data(), partners_.data(), parameters_.data()};
}

namespace {

const NetworkKernel& network_kernel() {
#if defined(CAROM_X86_KERNELS)
    if (isa() == Isa::avx512) return avx512_network_kernel;
    if (isa() == Isa::avx2) return avx2_network_kernel;
#endif
    return baseline_network_kernel;
}

}  // namespace

NetworkPowers SpringNetwork::write_forces(const State& state, std::size_t first, std::size_t last,
                                          std::span<Vec2> force) const {
    return network_kernel().forces(layout(), &state.x.linear.data()->x, &state.v.linear.data()->x, &force.data()->x,
                                   first, last);
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
                const Column& column = columns_[c];
                const std::size_t k = row % chunk_rows;
                const std::size_t partner =
                    column.consecutive ? column.partners + k : partners_[chunk_rows * column.partners + k];
                const double* p = &parameters_[chunk_rows * column.parameters + (column.uniform ? 0 : k)];
                const std::size_t next = column.uniform ? 1 : chunk_rows;
                if (partner > row)
                    out.push_back({static_cast<Row>(row), static_cast<Row>(partner), p[0], p[next],
                                   column.damped ? p[2 * next] : 0});
            }
    return out;
}

std::size_t SpringNetwork::bytes() const {
    return sizeof(*this) + sizeof(Column) * columns_.capacity() + sizeof(double) * parameters_.capacity() +
           sizeof(Row) * (first_column_.capacity() + partners_.capacity());
}

}  // namespace carom
