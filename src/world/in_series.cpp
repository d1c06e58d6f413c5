// Which joints are in series. Each joint beside a spanning tree closes a ring, and has a number by chance; the number
// of a joint of the tree is the exclusive or of those whose rings it is in. Two cuts part what a pair of the same
// number holds together, and one cut where the number is 0 (D. Pritchard, R. Thurimella, ACM Trans. Algorithms 7, 46
// (2011)).

#include "world/in_series.hpp"

#include <carom/random.hpp>
#include <variant>

namespace carom {

JointsInSeries::JointsInSeries(const std::vector<Joint>& joints, const Bodies& bodies) : below_(joints.size(), none) {
    const auto ground = static_cast<std::uint32_t>(bodies.size());
    const auto vertex = [&](const std::optional<BodyId>& id) {
        const std::size_t row = id ? bodies.row(*id) : ground;
        return row < ground && bodies.inverse_mass[row] != 0 ? static_cast<std::uint32_t>(row) : ground;
    };
    std::vector<std::vector<Edge>> edges(bodies.size() + 1);
    for (std::uint32_t k = 0; k < joints.size(); ++k) {
        const std::uint32_t a = vertex(joints[k].a), b = vertex(joints[k].b);
        if (a == b || std::holds_alternative<FilterJoint>(joints[k].type)) continue;
        edges[a].push_back({k, b}), edges[b].push_back({k, a});
    }
    before_.assign(edges.size(), none), by_.assign(edges.size(), none);
    grounded_.assign(edges.size(), false);
    walk(ground, edges);
    for (const std::uint32_t v : order_) grounded_[v] = true;
    for (std::uint32_t v = 0; v < ground; ++v)
        if (before_[v] == none) walk(v, edges);
    ring_.assign(joints.size(), 0);
    std::vector<std::uint64_t> around(edges.size());
    Random random(1);
    for (std::uint32_t v = 0; v < edges.size(); ++v)
        for (const Edge& edge : edges[v])
            if (below_[edge.joint] == none) {
                if (ring_[edge.joint] == 0) ring_[edge.joint] = random.bits();
                around[v] ^= ring_[edge.joint];
            }
    for (std::size_t i = order_.size(); i-- > 0;) {
        const std::uint32_t v = order_[i];
        if (by_[v] == none) continue;
        ring_[by_[v]] = around[v];
        around[before_[v]] ^= around[v];
    }
}

void JointsInSeries::walk(std::uint32_t from, const std::vector<std::vector<Edge>>& edges) {
    std::size_t next = order_.size();
    order_.push_back(from), before_[from] = from;
    for (; next < order_.size(); ++next)
        for (const Edge& edge : edges[order_[next]]) {
            if (before_[edge.to] != none) continue;
            before_[edge.to] = order_[next], by_[edge.to] = edge.joint, below_[edge.joint] = edge.to;
            order_.push_back(edge.to);
        }
}

bool JointsInSeries::hangs_on(std::uint32_t joint, std::uint32_t other) const {
    for (std::uint32_t v = below_[joint]; by_[v] != none; v = before_[v])
        if (by_[v] == other) return true;
    return false;
}

bool JointsInSeries::holds(std::uint32_t joint, std::uint32_t other) const {
    if (ring_[joint] != ring_[other]) return false;
    if (ring_[joint] != 0) return true;
    const bool hang = below_[joint] != none && below_[other] != none && grounded_[below_[joint]];
    return hang && (hangs_on(joint, other) || hangs_on(other, joint));
}

}  // namespace carom
