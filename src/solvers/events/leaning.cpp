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

/// What bounces is left to its own solver, which looks at it when this hit is over, but where the bounce is no more
/// than what contacts give way by in a substep. What parts already would be given energy, and what comes on lose it.
bool GasCompany::is_pressed(const GasTouch& t, double by) const {
    constexpr double hardly = 1e-3;
    const GasMover& m = mover[t.mover];
    double now = dot(m.velocity_at(t.lever), t.normal);
    if (t.other != GasMover::none) now -= dot(mover[t.other].velocity_at(t.lever_of_other), t.normal);
    const double slow = GasTouch::give * m.reach / ways_.substep;
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

/// One by one, the one that is pressed most first, and each as those before it let it be.
bool GasCompany::hold_touches(double time, double push, const std::vector<GasYield>& yields) {
    constexpr std::size_t most = 16;
    constexpr double rounding = 1e-9;
    std::vector<GasYield> pushed = yields, of_other;
    while (held_.size() < most) {
        const GasTouch* const touch = most_pressed(push, pushed);
        if (!touch) break;
        HeldTouch held{*touch, {}, 0};
        find_yields(touch->mover, time, touch->lever, touch->normal, held.yields);
        if (touch->other != GasMover::none) {
            find_yields(touch->other, time, touch->lever_of_other, -touch->normal, of_other);
            add(held.yields, 1, of_other);
        }
        const double free = closing(*touch, held.yields);
        keep_touches(held.yields);
        const double ease = closing(*touch, held.yields);
        held.ease = ease > rounding * free ? ease : 0;
        held_.push_back(std::move(held));
        pushed = yields;
        keep_touches(pushed);
    }
    return !held_.empty();
}

void GasCompany::keep_touches(std::vector<GasYield>& yields) const {
    for (const HeldTouch& held : held_)
        if (held.ease > 0) add(yields, -closing(held.touch, yields) / held.ease, held.yields);
}

Giver GasCompany::holder() const {
    const auto is_held = [](const HeldTouch& held) { return held.touch.other == GasMover::none; };
    const auto first = std::find_if(held_.begin(), held_.end(), is_held);
    return first == held_.end() ? Giver::method : first->touch.at_wall ? Giver::walls : Giver::held;
}

}  // namespace carom
