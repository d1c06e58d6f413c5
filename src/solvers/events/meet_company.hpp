#pragma once
// The third part of GasRun: discs and the bodies that are moved in steps.

#include <algorithm>
#include <cmath>

#include "solvers/events/run.hpp"

namespace carom {

template <class Queue>
void GasRun<Queue>::meet_company() {
    if (!part_.queued) queue_all();
    auto& outline = scene_.company->outline;
    outline.clear();
    for (std::uint32_t k = 0; k < gas_.obstacle.size(); ++k)
        if (gas_.obstacle[k].mover != GasObstacle::no_row) outline.push_back(k);
    look_for_company();
}

/// All discs look whether they meet one of the company sooner than what they foresaw. Who foresaw such a hit foresees
/// anew, for it is void.
template <class Queue>
void GasRun<Queue>::look_for_company() {
    for (Slot i = 0; i < none_; ++i) {
        const std::uint32_t partner = discs_.disc[i].partner;
        if (partner != no_slot && partner >= first_obstacle &&
            gas_.obstacle[partner - first_obstacle].mover != GasObstacle::no_row) {
            foresee(i);
            continue;
        }
        const double foreseen = discs_.event[i].hit;
        GasMeeting next{foreseen, partner};
        look_for_movers(i, next);
        if (next.partner != partner) settle(i, next);
    }
}

/// False if the two part already, by rounding.
template <class Queue>
bool GasRun<Queue>::hit_mover(Slot i, const GasObstacle& o) {
    GasCompany& company = *scene_.company;
    GasMover& m = company.mover[o.mover];
    const std::uint32_t row = discs_.event[i].row;
    const double time = discs_.disc[i].clock;
    m.move(time);
    const GasFlight between = flight(i, m, time);
    GasFlight seen = seen_from(m, between);
    seen.x -= o.a;
    const Vec2 own = normal_at(o, seen);
    const Vec2 normal{m.cosine * own.x - m.sine * own.y, m.sine * own.x + m.cosine * own.y};
    const double approach = -dot(seen.v, own), least = least_rebound(i, between.g, normal);
    if (approach <= 0 && approach <= -least) return false;
    const double e = restitution(o.restitution, scene_.bodies.restitution[row], approach, i, no_slot);
    turn_up(i);
    company.strike({o.mover, time, normal, e, e < 1 || approach <= 0 ? least : 0,
                    mixed_friction(o.friction, scene_.bodies.friction[row])},
                   party(i), books_->account);
    ++discs_.disc[i].hits;
    ++books_->tally.wall_collisions;
    foresee(i);
    look_for_company();
    return true;
}

}  // namespace carom
