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
    look_with_all();
}

template <class Queue>
void GasRun<Queue>::look_with_all() {
    list_near();
    for (Slot i = 0; i < none_; ++i) look_for_company(i);
}

template <class Queue>
void GasRun<Queue>::kink_company() {
    scene_.company->kink();
    look_for_company();
}

/// Who is listed: all whose flights are as they were and can come near, and whoever can when its flight becomes
/// another.
template <class Queue>
void GasRun<Queue>::list_near() {
    GasCompany& company = *scene_.company;
    company.near.clear();
    company.is_near.assign(none_, false);
    double sum = 0;
    for (Slot i = 0; i < none_; ++i) sum += squared_length(discs_.disc[i].v);
    company.faster = 0.25 * std::sqrt(sum / none_);
    for (GasMover& m : company.mover) m.kick = {};
    for (Slot i = 0; i < none_; ++i) note_near(i);
}

template <class Queue>
void GasRun<Queue>::note_near(Slot i) {
    GasCompany& company = *scene_.company;
    if (company.until == gas_never || company.is_near[i]) return;
    for (const GasMover& m : company.mover) {
        const double from = std::max(discs_.disc[i].clock, m.clock), most = company.until - from;
        if (most < 0 || !may_strike(m, flight(i, m, from), most, 2 * company.faster)) continue;
        company.is_near[i] = true;
        company.near.push_back(i);
        return;
    }
}

/// After a hit: all discs that can meet one of the company look whether they do sooner than what they foresaw.
template <class Queue>
void GasRun<Queue>::look_for_company() {
    GasCompany& company = *scene_.company;
    const auto is_kicked = [&](const GasMover& m) { return length(m.kick) > company.faster; };
    if (std::any_of(company.mover.begin(), company.mover.end(), is_kicked)) return look_with_all();
    for (std::size_t k = 0; k < company.near.size(); ++k) look_for_company(company.near[k]);
}

/// Who foresaw such a hit foresees anew, for it is void.
template <class Queue>
void GasRun<Queue>::look_for_company(Slot i) {
    const std::uint32_t partner = discs_.disc[i].partner;
    if (partner != no_slot && partner >= first_obstacle &&
        gas_.obstacle[partner - first_obstacle].mover != GasObstacle::no_row)
        return foresee(i);
    GasMeeting next{discs_.event[i].hit, partner};
    look_for_movers(i, next);
    if (next.partner != partner) settle(i, next);
}

/// False if the two part already, by rounding.
template <class Queue>
bool GasRun<Queue>::hit_mover(Slot i, std::uint32_t part) {
    GasCompany& company = *scene_.company;
    const GasObstacle& o = gas_.obstacle[part];
    GasMover& m = company.mover[o.mover];
    const std::uint32_t row = discs_.event[i].row;
    const double time = discs_.disc[i].clock;
    m.move(time);
    const GasFlight between = flight(i, m, time);
    GasFlight seen = seen_from(m, between);
    seen.x -= o.a;
    const Vec2 own = normal_at(o, seen);
    const Vec2 normal{m.cosine * own.x - m.sine * own.y, m.sine * own.x + m.cosine * own.y};
    const double approach = -dot(seen.v, own);
    const Vec2 gravity = acceleration_seen_from(m, between);
    const double pulled = least_rebound(i, gravity, normal), parting = beyond_rounding(i);
    if (approach <= -std::max(pulled, parting)) return false;
    const GasPast past = discs_.past.empty() ? GasPast{} : discs_.past[i];
    const std::uint64_t made_elastic = books_->tally.made_elastic;
    const Surfaces met =
        meeting({o.restitution, o.friction}, {scene_.bodies.restitution[row], scene_.bodies.friction[row]}, approach, i,
                no_slot, weight_in_bounce(i, gravity, normal, approach));
    turn_up(i);
    // What loses energy comes to lie on it in the end, and there it trembles.
    const bool loses = met.restitution < 1 || met.friction > 0 || met.made_elastic;
    const double least = loses || approach <= 0 ? std::max(pulled, parting) : parting;
    if (!company.strike({o.mover, time, normal, met.restitution, least, met.friction}, party(i), books_->account)) {
        if (!discs_.past.empty()) discs_.past[i] = past;
        books_->tally.made_elastic = made_elastic;
        company.stop(time, i, part);
        return true;
    }
    ++discs_.disc[i].hits;
    ++books_->tally.wall_collisions;
    foresee(i);
    look_for_company();
    return true;
}

/// Where a contact moves bodies out of an overlap that is no velocity of theirs. Who lies on them is struck by it all
/// the same: else he would be foreseen to be so again, for ever.
template <class Queue>
void GasRun<Queue>::make_hit(State& state) {
    GasCompany& company = *scene_.company;
    const Slot i = company.striker;
    if (!hit_mover(i, company.about_to_hit)) {
        company.be_as_planned();
        if (!hit_mover(i, company.about_to_hit)) foresee(i);
    }
    const std::uint32_t row = discs_.event[i].row;
    state.v.linear[row] = discs_.disc[i].v;
    if (!discs_.spin.empty()) state.v.angular[row] = discs_.spin[i].velocity;
}

}  // namespace carom
