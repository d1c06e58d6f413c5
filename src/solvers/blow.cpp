#include "solvers/blow.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/hodograph.hpp"

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
    }
    couple(s);
    s.approach = approach(s);
    struck.push_back(s);
}

Vec2 Blow::velocity(const Struck& s, int k) const {
    return now[s.b].velocity_at(s.lever[k][1]) - now[s.a].velocity_at(s.lever[k][0]);
}

void Blow::couple(Struck& s) const {
    const Partner &a = now[s.a], &b = now[s.b];
    const auto arm = [&](int k, int way, int side) { return cross(s.lever[k][side], s.direction(way)); };
    const auto of_free = [&](int k, int way, int l, int from) {
        const double shift = way == from ? a.inverse_mass + b.inverse_mass : 0;
        return shift + a.inverse_inertia * arm(k, way, 0) * arm(l, from, 0) +
               b.inverse_inertia * arm(k, way, 1) * arm(l, from, 1);
    };
    const auto of_joined = [&](int k, int way, Struck::Range given) {
        double speed = 0;
        for (std::uint32_t i = given.first; i < given.last; ++i) {
            const auto& [side, v, w] = yields[i];
            if (side == s.a) speed -= dot(v + cross(w, s.lever[k][0]), s.direction(way));
            if (side == s.b) speed += dot(v + cross(w, s.lever[k][1]), s.direction(way));
        }
        return speed;
    };
    const int ways = 2 * s.manifold.count;
    for (int i = 0; i < ways; ++i)
        for (int j = 0; j < ways; ++j) {
            const Struck::Range given = s.yields[j / 2][j % 2];
            s.coupling[i][j] =
                given.first == given.last ? of_free(i / 2, i % 2, j / 2, j % 2) : of_joined(i / 2, i % 2, given);
        }
    for (int i = 0; i < ways; ++i) {
        const double own = s.coupling[i][i], free = of_free(i / 2, i % 2, i / 2, i % 2);
        if (i % 2 == Struck::pressing) s.freedom = std::min(s.freedom, own / free);
        if (own > Hodograph::nothing * free) continue;
        // What joints hold fast yields by their slack and rounding, this way and by it any other: it would take any
        // impulse.
        for (int j = 0; j < ways; ++j) s.coupling[i][j] = s.coupling[j][i] = 0;
    }
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

void Blow::apply(const Struck& s, int k, int way, double impulse) {
    const Vec2 given = impulse * s.direction(way);
    const Struck::Range yielding = s.yields[k][way];
    if (yielding.first == yielding.last) now[s.a].push(s.lever[k][0], -given), now[s.b].push(s.lever[k][1], given);
    for (std::uint32_t i = yielding.first; i < yielding.last; ++i)
        now[yields[i].side].v += impulse * yields[i].v, now[yields[i].side].w += impulse * yields[i].w;
}

/// The points of a contact while its impulses are found: their speeds follow from these by the coupling alone, and the
/// bodies get the sum. So sweeps end at rounding of the impulses, and not of how fast the bodies are.
class Blow::Points {
  public:
    Points(Blow& blow, const SoftContact& c, Struck& s)
        : blow_(blow), contact_(c), s_(s), before_{s.normal[0], s.tangent[0], s.normal[1], s.tangent[1]} {
        for (int k = 0; k < s.manifold.count; ++k)
            for (const int way : {Struck::pressing, Struck::rubbing})
                speed_[Struck::number(k, way)] = dot(blow.velocity(s, k), s.direction(way));
    }
    void push(int k, double impulse) {
        s_.normal[k] += impulse;
        change(Struck::number(k, Struck::pressing), impulse);
    }
    void stop(int k) {
        const int i = Struck::number(k, Struck::pressing);
        push(k, std::max(-s_.normal[k], -answer(i, speed_[i])));
    }
    /// Ends the approach of both, none of which is pulled: a linear complementarity problem of two, solved as it is.
    /// Sweeps over points that lie close together would come to no end, and restitution would make energy of the rest.
    void stop_both() {
        constexpr double singular = 1e-14;
        constexpr int i = Struck::number(0, Struck::pressing), j = Struck::number(1, Struck::pressing);
        const auto& of = s_.coupling;
        const double free[] = {speed_[i] - of[i][i] * s_.normal[0] - of[i][j] * s_.normal[1],
                               speed_[j] - of[j][i] * s_.normal[0] - of[j][j] * s_.normal[1]};
        const double determinant = of[i][i] * of[j][j] - of[i][j] * of[j][i];
        double first = (of[i][j] * free[1] - of[j][j] * free[0]) / determinant;
        double second = (of[j][i] * free[0] - of[i][i] * free[1]) / determinant;
        if (!(determinant > singular * of[i][i] * of[j][j] && first >= 0 && second >= 0)) {
            first = std::max(0.0, -answer(i, free[0])), second = 0;
            if (free[1] + of[j][i] * first < 0) first = 0, second = std::max(0.0, -answer(j, free[1]));
        }
        push(0, first - s_.normal[0]), push(1, second - s_.normal[1]);
    }
    void rub(int k) {
        const int i = Struck::number(k, Struck::rubbing);
        const double most = contact_.friction * s_.normal[k], so_far = s_.tangent[k];
        const double slip = speed_[i] - contact_.surface_speed;
        s_.tangent[k] = std::clamp(so_far - answer(i, slip), -most, most);
        const double more = s_.tangent[k] - so_far;
        s_.rubbed += more * (slip + 0.5 * s_.coupling[i][i] * more);
        change(i, more);
    }
    /// Follows one point while its impulse grows. False where it would grow for ever.
    bool follow(int k, double most) {
        const int press = Struck::number(k, Struck::pressing), across = Struck::number(k, Struck::rubbing);
        const auto& of = s_.coupling;
        Hodograph point{.coupling = {{of[press][press], of[press][across]}, {of[across][press], of[across][across]}},
                        .speed = {speed_[press], speed_[across]},
                        .friction = contact_.friction,
                        .surface_speed = contact_.surface_speed};
        const bool ends = point.follow(most);
        s_.rubbed += point.rubbed;
        s_.tangent[k] += point.given[Hodograph::rubbing];
        change(across, point.given[Hodograph::rubbing]), push(k, point.given[Hodograph::pressing]);
        return ends;
    }

    /// What the bodies get of it.
    void settle() {
        const double after[] = {s_.normal[0], s_.tangent[0], s_.normal[1], s_.tangent[1]};
        for (int i = 0; i < 2 * s_.manifold.count; ++i)
            if (after[i] != before_[i]) blow_.apply(s_, i / 2, i % 2, after[i] - before_[i]);
    }

  private:
    /// The impulse that makes so much speed.
    double answer(int i, double speed) const {
        const double own = s_.coupling[i][i];
        return own > 0 ? speed / own : 0;
    }
    void change(int i, double impulse) {
        for (int j = 0; j < 4; ++j) speed_[j] += s_.coupling[j][i] * impulse;
    }

    Blow& blow_;
    const SoftContact& contact_;
    Struck& s_;
    const double before_[4];
    double speed_[4]{};
};

double Blow::compress(const SoftContact& c, Struck& s, int sweeps) {
    Points points(*this, c, s);
    double most = 0;
    if (const int k = s.lone(); s.active[0] != s.active[1] && c.friction > 0 && !s.pushes()) {
        s.is_followed = points.follow(k, HUGE_VAL);
        const int i = Struck::number(k, Struck::pressing);
        most = (s.normal[k] + std::abs(s.tangent[k])) * s.coupling[i][i];
        sweeps = s.is_followed ? 0 : sweeps;
    }
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        double change = 0;
        const double pressed[2] = {s.normal[0], s.normal[1]}, rubbed[2] = {s.tangent[0], s.tangent[1]};
        s.active[0] && s.active[1] ? points.stop_both() : points.stop(s.lone());
        for (int k = 0; k < s.manifold.count; ++k) {
            if (!s.active[k]) continue;
            if (c.friction > 0) points.rub(k);
            const double more = std::abs(s.normal[k] - pressed[k]);
            const int i = Struck::number(k, Struck::pressing);
            change = std::max(change, more / (s.normal[k] + pressed[k] + 1e-300));
            most = std::max(most, (more + std::abs(s.tangent[k] - rubbed[k])) * s.coupling[i][i]);
        }
        if (change < 1e-15 || c.friction == 0) break;
    }
    points.settle();
    return most;
}

void Blow::expand(const SoftContact& c, Struck& s) {
    Points points(*this, c, s);
    const double compressed[2] = {s.normal[0], s.normal[1]};
    if (s.is_followed) {
        points.follow(s.lone(), c.restitution * compressed[s.lone()]);
        points.settle();
        return;
    }
    for (int k = 0; k < s.manifold.count; ++k) points.push(k, c.restitution * compressed[k]);
    for (int k = 0; c.friction > 0 && k < s.manifold.count; ++k) points.rub(k);
    points.settle();
}

void Blow::bounce(std::span<const SoftContact> all) {
    constexpr double rounding = 1e-14;
    constexpr int most_rounds = 500;
    if (struck.size() == 1) {
        compress(all[struck[0].index], struck[0], 200), expand(all[struck[0].index], struck[0]);
        return;
    }
    for (int round = 0; round < most_rounds; ++round) {
        double most = 0;
        for (Struck& s : struck) most = std::max(most, compress(all[s.index], s, 4));
        if (most <= rounding * struck[0].approach) break;
    }
    // Nobody slips for what the others have yet to give.
    const auto for_each_point = [&](const auto& work) {
        for (Struck& s : struck) {
            Points points(*this, all[s.index], s);
            for (int k = 0; k < s.manifold.count; ++k) work(points, s, k);
            points.settle();
        }
    };
    for_each_point(
        [&](Points& points, const Struck& s, int k) { points.push(k, all[s.index].restitution * s.normal[k]); });
    for_each_point([&](Points& points, const Struck& s, int k) {
        if (all[s.index].friction > 0) points.rub(k);
    });
    for (Struck& s : struck) s.is_followed = false;  // the slip of all is what the ends of the blow say
}

}  // namespace carom
