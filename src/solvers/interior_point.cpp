#include "solvers/interior_point.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {
constexpr double same_slip = 1e-4;  // of the fastest speed
constexpr double blocked = 0.1;     // is the way of which so little is free
}  // namespace

void InteriorPoint::add(const ContactCone& cone) {
    constexpr double compliance = 1e-8;  // of the inverse mass: where more contacts bear than need to, all bear a part
    const std::size_t first = edges_.size();
    for (const double slip : {cone.friction, -cone.friction})
        for (const double roll : {cone.rolling, -cone.rolling}) {
            const bool is_twin = (slip == 0 && std::signbit(slip)) || (roll == 0 && std::signbit(roll));
            if (is_twin) continue;
            Edge edge{.row = cone.normal, .slip = slip, .roll = roll, .compliance = compliance / cone.mass};
            edge.row.add(slip, cone.slip), edge.row.add(roll, cone.roll);
            edges_.push_back(edge);
        }
    contacts_.push_back({cone, first, edges_.size()});
}

ConeImpulse InteriorPoint::impulse(std::size_t contact) const {
    ConeImpulse sum{};
    for (std::size_t i = contacts_[contact].first; i < contacts_[contact].end; ++i) {
        const Edge& e = edges_[i];
        sum.normal += e.impulse, sum.slip += e.slip * e.impulse, sum.roll += e.roll * e.impulse;
    }
    return sum;
}

/// Far inside, with nothing known of who slides: products are all alike. Who is only near could come at his gap by the
/// time of a substep, and parts as fast from it: in a substep that is cut short that is as fast as you like, and no
/// measure of what moves.
void InteriorPoint::begin() {
    fastest_ = bodies_.fastest(v_);
    for (const Contact& c : contacts_) fastest_ = std::max(fastest_, c.cone.speed - c.cone.normal.speed(v_));
    if (!(fastest_ > 0)) return;
    for (const Contact& c : contacts_)
        for (std::size_t i = c.first; i < c.end; ++i) {
            Edge& e = edges_[i];
            e.target = e.wanted(c.cone, 0);
            e.gap = std::max(fastest_, e.row.speed(v_) - e.target);
            e.impulse = fastest_ * c.cone.mass * (fastest_ / e.gap);
        }
}

/// Moves the speeds that are wanted to what keeps those together who slide as they do now; who hardly does is taken to
/// stick. Returns the largest change.
double InteriorPoint::follow_slip() {
    double worst = 0;
    const auto slide = [this](double speed) { return std::abs(speed) > same_slip * fastest_ ? std::abs(speed) : 0; };
    for (const Contact& c : contacts_) {
        const double slip = c.cone.slip.speed(v_) - c.cone.slip_speed, roll = c.cone.roll.speed(v_) - c.cone.roll_speed;
        const double lift = c.cone.friction * slide(slip) + slide(c.cone.rolling * roll);
        for (std::size_t i = c.first; i < c.end; ++i) {
            Edge& e = edges_[i];
            const double target = e.wanted(c.cone, lift);
            worst = std::max(worst, std::abs(target - e.target));
            e.target = target;
        }
    }
    return worst;
}

/// Goes back inside by so much, from where edges push or part and hardly both.
void InteriorPoint::make_room(double speed) {
    for (const Contact& c : contacts_)
        for (std::size_t i = c.first; i < c.end; ++i) {
            edges_[i].impulse = std::max(edges_[i].impulse, speed * c.cone.mass);
            edges_[i].gap = std::max(edges_[i].gap, speed);
        }
}

double InteriorPoint::mean_product() const {
    double sum = 0;
    for (const Edge& e : edges_) sum += e.impulse * e.gap;
    return sum / static_cast<double>(edges_.size());
}
double InteriorPoint::lack(const Edge& e) const {
    return e.row.speed(v_) - e.target + e.compliance * e.impulse - e.gap;
}
double InteriorPoint::worst_lack() const {
    double worst = 0;
    for (const Edge& e : edges_) worst = std::max(worst, std::abs(lack(e)));
    return worst;
}
/// Whether gaps are those of the speeds to such a part of what moves, or of the gap.
bool InteriorPoint::fits(double part) const {
    return std::all_of(edges_.begin(), edges_.end(),
                       [&](const Edge& e) { return std::abs(lack(e)) <= part * std::max(fastest_, e.gap); });
}

double InteriorPoint::imbalance() const {
    Scratch<double> given(v_.size(), 0.0);
    for (const Edge& e : edges_) e.row.push(e.impulse, given);
    return bodies_.imbalance(v_, given);
}

/// The changes that lead to the goals. Returns what part of them leaves all impulses and gaps positive, 1 at most.
double InteriorPoint::aim() {
    bodies_.lack(v_, step_);
    for (Edge& e : edges_) {
        e.at_rest = (e.goal - e.impulse * (e.gap + e.lack)) / e.below();
        e.row.push(e.impulse + e.at_rest, step_);
    }
    matrix_.solve(step_);
    constexpr double nearly = 0.99;
    double length = 1;
    const auto keep_positive = [&](double value, double change) {
        const bool may_be_least = nearly * value < -length * change * (1 + 1e-9);  // most need no division
        if (may_be_least) length = std::min(length, -nearly * value / change);
    };
    for (Edge& e : edges_) {
        const double speed_change = e.row.speed(step_);
        e.impulse_change = e.at_rest - e.weight * speed_change;
        e.gap_change = speed_change + e.compliance * e.impulse_change + e.lack;
        keep_positive(e.impulse, e.impulse_change), keep_positive(e.gap, e.gap_change);
    }
    return length;
}

/// A step of Newton's method towards products that are all the same, where now they are so large in the mean: as much
/// less as the way without such an aim is free, and no less than the least. Returns what part of it could be gone.
double InteriorPoint::step(double mean, double least) {
    constexpr double stays = 0.8, lowest = 1e-6;
    bodies_.weigh(matrix_);
    for (Edge& e : edges_) {
        e.weight = e.impulse / e.below();
        e.row.couple(e.weight, matrix_);
        e.lack = lack(e);
        e.goal = 0;
    }
    matrix_.factor();
    const double straight = aim();
    double left = 0;
    for (const Edge& e : edges_) left += (e.impulse + straight * e.impulse_change) * (e.gap + straight * e.gap_change);
    const double ratio = left / (mean * static_cast<double>(edges_.size()));
    const bool is_blocked = straight < blocked;
    const double goal = std::max((is_blocked ? stays : std::max(ratio * ratio * ratio, lowest)) * mean, least);
    for (Edge& e : edges_) e.goal = goal - (is_blocked ? 0 : e.impulse_change * e.gap_change);
    const double length = aim();
    for (Edge& e : edges_) e.impulse += length * e.impulse_change, e.gap += length * e.gap_change;
    for (std::size_t i = 0; i < v_.size(); ++i) v_[i] += length * step_[i];
    return length;
}

bool InteriorPoint::is_near(double part, double of_products) const {
    constexpr double rounding = 1e-9;  // of impulses
    return mean_product() <= part * of_products && fits(std::sqrt(part)) && imbalance() <= std::max(part, rounding);
}

bool InteriorPoint::solve() {
    constexpr int most = 300, most_followed = 40, most_slips = 6, few = 5;
    constexpr double enough = 1e-12, loosely = 1e-8;  // parts of the products at the start
    begin();
    if (!(fastest_ > 0)) return true;
    const double first = mean_product();
    // Who slides is looked at where all stick, nearly; if some do slide they are followed on the way, until a whole
    // step would move slips by little, and then slips are held, for else the last digits would wait for theirs.
    int looks = 0, followed = 0;
    bool follows = false;
    double length = 1;
    for (int i = 0; i < most; ++i) {
        if (follows) {
            const bool settles = follow_slip() <= length * same_slip * fastest_;
            const bool is_stuck = ++followed == most_followed || (followed > few && length < blocked);
            follows = !settles && !is_stuck;
            if (is_stuck && !settles) make_room(worst_lack());
        }
        if (!follows && is_near(looks == 0 ? loosely : enough, first)) {
            const double moved = follow_slip();
            const bool stays = moved <= same_slip * fastest_;
            if (looks > 0 && (stays || looks == most_slips)) return true;
            if (!stays) make_room(moved), follows = looks == 0;
            ++looks;
        }
        length = step(mean_product(), 0.1 * enough * first);
    }
    return false;
}

}  // namespace carom
