#include "solvers/blow.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

void Blow::clear() {
    for (const Partner& body : before) place_[body.row] = nowhere;
    before.clear(), now.clear(), struck.clear(), yields.clear();
}

std::uint32_t Blow::side(const Partner& body) {
    std::uint32_t& place = place_[body.row];
    if (place == nowhere) {
        place = static_cast<std::uint32_t>(before.size());
        before.push_back(body), now.push_back(body);
    }
    return place;
}

void Blow::add(std::uint32_t index, const SoftContact& c, const Manifold& m, const Partner& a, const Partner& b,
               double close) {
    Struck s{.index = index, .manifold = m, .a = side(a), .b = side(b)};
    for (int k = 0; k < m.count; ++k) {
        s.lever[k] = levers(c, m, k, b.x - a.x);
        s.active[k] = m.point[k].gap <= close;
        s.easiness[k] = easiness(s, k, m.normal);
        s.slippiness[k] = easiness(s, k, perpendicular(m.normal));
    }
    s.approach = approach(s);
    struck.push_back(s);
}

Vec2 Blow::velocity(const Struck& s, int k) const {
    return now[s.b].velocity_at(s.lever[k][1]) - now[s.a].velocity_at(s.lever[k][0]);
}

double Blow::easiness(const Struck& s, int k, Vec2 along) const {
    const Partner &a = now[s.a], &b = now[s.b];
    const double ra = cross(s.lever[k][0], along), rb = cross(s.lever[k][1], along);
    return a.inverse_mass + b.inverse_mass + a.inverse_inertia * ra * ra + b.inverse_inertia * rb * rb;
}

double Blow::approach(const Struck& s) const {
    double most = 0;
    for (int k = 0; k < s.manifold.count; ++k)
        if (s.active[k]) most = std::max(most, -dot(velocity(s, k), s.manifold.normal));
    return most;
}

double Blow::most_change(std::uint32_t side, double extent) const {
    return length(now[side].v - before[side].v) + std::abs(now[side].w - before[side].w) * extent;
}

void Blow::apply(const Struck& s, int k, Way way, double impulse) {
    const Vec2 n = s.manifold.normal, given = impulse * (way == pressing ? n : perpendicular(n));
    const Struck::Range yielding = s.yields[k][way];
    if (yielding.first == yielding.last) now[s.a].push(s.lever[k][0], -given), now[s.b].push(s.lever[k][1], given);
    for (std::uint32_t i = yielding.first; i < yielding.last; ++i)
        now[yields[i].side].v += impulse * yields[i].v, now[yields[i].side].w += impulse * yields[i].w;
}

void Blow::push(Struck& s, int k, double impulse) {
    s.normal[k] += impulse;
    apply(s, k, pressing, impulse);
}

void Blow::rub(const SoftContact& c, Struck& s, int k) {
    const Vec2 t = perpendicular(s.manifold.normal);
    const double most = c.friction * s.normal[k], so_far = s.tangent[k];
    const double slip = dot(velocity(s, k), t) - c.surface_speed;
    s.tangent[k] = std::clamp(so_far - slip / s.slippiness[k], -most, most);
    apply(s, k, rubbing, s.tangent[k] - so_far);
}

double Blow::compress(const SoftContact& c, Struck& s, int sweeps) {
    const Vec2 n = s.manifold.normal;
    double most = 0;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        double change = 0;
        for (int k = 0; k < s.manifold.count; ++k) {
            if (!s.active[k]) continue;
            const double pressed = s.normal[k], rubbed = s.tangent[k];
            push(s, k, std::max(-pressed, -dot(velocity(s, k), n) / s.easiness[k]));
            change = std::max(change, std::abs(s.normal[k] - pressed) / (s.normal[k] + pressed + 1e-300));
            if (c.friction > 0) rub(c, s, k);
            const double pushed = std::abs(s.normal[k] - pressed) + std::abs(s.tangent[k] - rubbed);
            most = std::max(most, pushed * s.easiness[k]);
        }
        if (change < 1e-15 || (s.manifold.count == 1 && c.friction == 0)) break;
    }
    return most;
}

void Blow::expand(const SoftContact& c, Struck& s) {
    const double compressed[2] = {s.normal[0], s.normal[1]};
    for (int k = 0; k < s.manifold.count; ++k) push(s, k, c.restitution * compressed[k]);
    for (int k = 0; c.friction > 0 && k < s.manifold.count; ++k) rub(c, s, k);
}

}  // namespace carom
