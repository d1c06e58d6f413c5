#include "linked.hpp"

#include <unordered_map>

namespace carom::app {

std::unordered_set<BodyId> linked(const World& world, std::vector<BodyId> with) {
    std::unordered_multimap<BodyId, BodyId> neighbours;
    const auto link = [&neighbours](BodyId a, BodyId b) { neighbours.emplace(a, b), neighbours.emplace(b, a); };
    for (const Joint& joint : world.joints())
        if (joint.a && !std::holds_alternative<FilterJoint>(joint.type)) link(*joint.a, joint.b);
    for (const Spring& spring : world.springs()) link(spring.a, spring.b);
    std::unordered_set<BodyId> found(with.begin(), with.end());
    while (!with.empty()) {
        const auto [first, last] = neighbours.equal_range(with.back());
        with.pop_back();
        for (auto next = first; next != last; ++next)
            if (found.insert(next->second).second && world.body(next->second).kind == Kind::dynamic)
                with.push_back(next->second);
    }
    return found;
}

}  // namespace carom::app
