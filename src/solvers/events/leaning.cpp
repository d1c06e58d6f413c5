// What bodies of the company lean on as the gas strikes them: it holds against the blow at once.

#include <algorithm>

#include "solvers/events/company.hpp"

namespace carom {

namespace {

void add(std::vector<GasYield>& sum, double s, const std::vector<GasYield>& yields) {
    for (const GasYield& y : yields) {
        auto same = std::find_if(sum.begin(), sum.end(), [&](const GasYield& of) { return of.mover == y.mover; });
        if (same == sum.end()) same = sum.insert(sum.end(), {y.mover});
        same->v += s * y.v, same->w += s * y.w;
    }
}

/// How fast the two of a touch come nearer.
double closing(const GasTouch& t, const std::vector<GasYield>& yields) {
    double speed = 0;
    for (const GasYield& y : yields) {
        if (y.mover == t.mover) speed += dot(y.v + cross(y.w, t.lever), t.normal);
        if (y.mover == t.other) speed -= dot(y.v + cross(y.w, t.lever_of_other), t.normal);
    }
    return speed;
}

}  // namespace

double GasCompany::closing_now(const GasTouch& t) const {
    const double own = dot(mover[t.mover].velocity_at(t.lever), t.normal);
    return t.other == GasMover::none ? own : own - dot(mover[t.other].velocity_at(t.lever_of_other), t.normal);
}

/// What bounces is left to its own solver, which looks at it when this hit is over, but where the bounce is no more
/// than what contacts give way by in a substep. What parts already would be given energy, and what comes on lose it.
bool GasCompany::is_pressed(const GasTouch& t, double by) const {
    constexpr double hardly = 1e-3;
    const double now = closing_now(t), slow = slow_for(mover[t.mover]);
    return now > -hardly * by && now <= slow && (t.restitution == 0 || by <= slow);
}

const GasTouch* GasCompany::most_pressed(double push, const std::vector<GasYield>& yields) const {
    constexpr double rounding = 1e-9;
    const GasTouch* most = nullptr;
    double speed = 0;
    for (const GasYield& y : yields) {
        const GasMover& m = mover[y.mover];
        for (std::uint32_t k = m.first_touch; k < m.last_touch; ++k) {
            const GasTouch& t = ways_.touches[k];
            if (t.gap > GasTouch::give * m.reach) continue;
            const double by = -push * closing(t, yields);
            const auto is_same = [&](const HeldTouch& held) { return held.touch.number == t.number; };
            if (!(by > speed && by > rounding * push * m.inverse_mass) || !is_pressed(t, by)) continue;
            if (std::none_of(held_.begin(), held_.end(), is_same)) most = &t, speed = by;
        }
    }
    return most;
}

/// What bounces later is left to its own solver, and so is what lands later, or would be pressed deep before that looks
/// again.
bool GasCompany::leads_astray(double time, double push, const std::vector<GasYield>& yields) const {
    constexpr double hardly = 0.1;
    const double left = until - time;
    if (stopped || left <= ways_.no_stop) return false;
    const auto pushed = [](const GasMover& m, Vec2 lever) { return m.pushed + cross(m.pushed_turn, lever); };
    for (const GasYield& y : yields) {
        const GasMover& m = mover[y.mover];
        if (m.kinks > 0) return true;
        for (std::uint32_t k = m.first_touch; k < m.last_touch; ++k) {
            const GasTouch& t = ways_.touches[k];
            const double gives = GasTouch::give * m.reach;
            if (t.gap <= gives && closing_now(t) > slow_for(m)) return true;
            Vec2 nearer = pushed(m, t.lever);
            if (t.other != GasMover::none) nearer -= pushed(mover[t.other], t.lever_of_other);
            const double room = std::max(t.gap + gives, hardly * gives);  // where it gave way before, to loads too
            if (dot(nearer, t.normal) - left * push * closing(t, yields) > room) return true;
        }
    }
    return false;
}

/// One by one, the one that is pressed most first, and each as those before it let it be.
bool GasCompany::hold_touches(double time, double push, const std::vector<GasYield>& yields) {
    constexpr std::size_t most = 16;
    constexpr double rounding = 1e-9;
    std::vector<GasYield> pushed = yields, of_other;
    std::vector<double> unused;
    while (held_.size() < most) {
        const GasTouch* const touch = most_pressed(push, pushed);
        if (!touch) break;
        HeldTouch held{*touch, {}, {}, 0};
        find_yields(touch->mover, time, touch->lever, touch->normal, held.yields);
        if (touch->other != GasMover::none) {
            find_yields(touch->other, time, touch->lever_of_other, -touch->normal, of_other);
            add(held.yields, 1, of_other);
        }
        const double free = closing(*touch, held.yields);
        keep_touches(held.yields, held.by_others);
        const double ease = closing(*touch, held.yields);
        held.ease = ease > rounding * free ? ease : 0;
        held_.push_back(std::move(held));
        pushed = yields;
        keep_touches(pushed, unused);
    }
    return !held_.empty();
}

/// With the impulse of one go those of the ones before it, which hold meanwhile.
void GasCompany::keep_touches(std::vector<GasYield>& yields, std::vector<double>& held) const {
    held.resize(held_.size());
    for (std::size_t k = 0; k < held_.size(); ++k) {
        const HeldTouch& touch = held_[k];
        if (touch.ease == 0) continue;
        const double impulse = -closing(touch.touch, yields) / touch.ease;
        add(yields, impulse, touch.yields);
        held[k] += impulse;
        for (std::size_t i = 0; i < touch.by_others.size(); ++i) held[i] += impulse * touch.by_others[i];
    }
}

/// What is left is of joints on the ground, and of who keeps a body from turning; else of touches that gape.
void GasCompany::book_held(const std::vector<double>& held, bool others_hold, Wrench rest, Flows& account) const {
    for (std::size_t k = 0; k < held.size(); ++k) {
        const GasTouch& t = held_[k].touch;
        if (t.other != GasMover::none) continue;
        Wrench given;
        given.add_at(mover[t.mover].x + t.lever, held[k] * t.normal);
        account[t.at_wall ? Giver::walls : Giver::held].add(given.force, given.torque);
        rest.add(-given.force, -given.torque);
    }
    account[others_hold ? Giver::held : Giver::method].add(rest.force, rest.torque);
}

}  // namespace carom
