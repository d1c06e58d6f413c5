#include "world/sleep.hpp"

namespace carom {

std::vector<bool> only_weighed(const Forces& forces, const Bodies& bodies) {
    const bool far_reaching = !forces.attractions.empty() || !forces.soft_discs.empty() || !forces.user_forces.empty();
    std::vector<bool> only(bodies.size(), !far_reaching);
    const auto acts_on = [&](const std::optional<BodyId>& id) {
        if (id)
            only[bodies.row(*id)] = false;
        else
            only.assign(bodies.size(), false);
    };
    const auto joins = [&](const auto& springs) {
        for (const auto& s : springs) acts_on(s.a), acts_on(s.b);
    };
    joins(forces.springs), joins(forces.torsion_springs);
    for (const Drive& d : forces.drives) acts_on(d.body);
    for (const ForceField& f : forces.fields) acts_on(f.body);
    for (const Drag& d : forces.drags)
        if (d.wind != Vec2{}) acts_on(d.body);
    return only;
}

}  // namespace carom
