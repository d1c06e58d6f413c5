#include <algorithm>
#include <limits>

#include "forces/dynamics.hpp"
#include "forces/parts.hpp"

namespace carom {

namespace {

void add(NodeStiffness& node, const Stretch& now, const SpringRow& s, Vec2 arm, double share) {
    // Along the spring k; across it k (1 − L/d), which counts only when it stiffens (d > L).
    const Vec2 n = now.direction;
    const double across = now.length > s.rest_length ? s.stiffness * (1 - s.rest_length / now.length) : 0;
    const double along = s.stiffness - across;
    node.xx += share * (along * n.x * n.x + across);
    node.xy += share * along * n.x * n.y;
    node.yy += share * (along * n.y * n.y + across);
    // Whichever way the arm points: a body may turn far within a step.
    node.angle +=
        share * (s.stiffness * squared_length(arm) + s.stiffness * std::abs(now.length - s.rest_length) * length(arm));
    node.damping += share * s.damping;
    node.angular_damping += share * s.damping * squared_length(arm);
}

/// Who may be struck by the fastest will be as fast, and who falls comes to where drag bears his weight: there a force
/// q u² has the rate 2 q u/m. Stable so far, none of those does more than stop who is twice as fast.
void add(std::vector<NodeStiffness>& nodes, const DragRow& d, const State& state, const std::vector<double>& mass,
         double gravity) {
    double fastest = 0;
    for (Row i = d.first; i < d.last && d.quadratic != 0; ++i)
        fastest = std::max(fastest, squared_length(state.v.linear[i] - d.wind));
    fastest = std::sqrt(fastest);
    for (Row i = d.first; i < d.last; ++i) {
        const double falling = std::sqrt(d.quadratic * mass[i] * gravity);
        nodes[i].damping += d.linear + 2 * std::max(d.quadratic * fastest, falling);
        nodes[i].angular_damping += d.angular;
    }
}

double largest(const NodeStiffness& node) {
    const double mean = 0.5 * (node.xx + node.yy), half = 0.5 * (node.xx - node.yy);
    return mean + std::sqrt(half * half + node.xy * node.xy);
}

/// Squares of frequencies, and rates.
struct Largest {
    double frequency2 = 0, rate = 0;

    void operator+=(const Largest& other) {
        frequency2 = std::max(frequency2, other.frequency2);
        rate = std::max(rate, other.rate);
    }
    /// Of forces that act at once.
    void add(const Largest& other) { frequency2 += other.frequency2, rate += other.rate; }
    Stiffness stiffness() const { return {std::sqrt(frequency2), rate}; }
};

Largest largest(const std::vector<SoftDiscRows>& soft_discs) {
    Largest sum;
    for (const SoftDiscRows& discs : soft_discs) sum.add({discs.squared_frequency(), discs.damping_rate()});
    return sum;
}

}  // namespace

// (a − b)² ≤ 2 a² + 2 b² when both ends move; a² alone when one stands.
double Dynamics::share(Row self, Row other) const {
    return inverse_mass_[self] == 0 ? 0 : inverse_mass_[other] == 0 ? 1 : 2;
}

Stiffness Dynamics::stiffness(const State& state) const {
    const Largest of_discs = largest(soft_discs_);
    const bool has_others = !(springs_.empty() && torsion_springs_.empty() && drags_.empty());
    if (network_.empty() && !has_others) return of_discs.stiffness();
    std::vector<NodeStiffness> others(has_others ? state.size() : 0);
    for (const SpringRow& s : springs_) {
        const Stretch now = stretch(s, state);
        add(others[s.a], now, s, now.arm_a, share(s.a, s.b));
        add(others[s.b], now, s, now.arm_b, share(s.b, s.a));
    }
    for (const TorsionRow& s : torsion_springs_) {
        others[s.a].angle += share(s.a, s.b) * s.stiffness;
        others[s.b].angle += share(s.b, s.a) * s.stiffness;
        others[s.a].angular_damping += share(s.a, s.b) * s.damping;
        others[s.b].angular_damping += share(s.b, s.a) * s.damping;
    }
    for (const DragRow& d : drags_) add(others, d, state, mass_, length(gravity_));
    const auto consider = [&](std::size_t first, std::size_t last, Largest& most) {
        std::array<NodeStiffness, rows_at_once> nodes{};
        if (!network_.empty()) network_.write_stiffness(state, first, last, inverse_mass_, nodes);
        for (std::size_t i = first; i < last; ++i) {
            NodeStiffness& node = nodes[i - first];
            if (!others.empty()) node += others[i];
            // λ_max of the whole 3 × 3 block is at most that of its place plus that of its angle.
            most += {inverse_mass_[i] * largest(node) + inverse_inertia_[i] * node.angle,
                     inverse_mass_[i] * node.damping + inverse_inertia_[i] * node.angular_damping};
        }
    };
    Largest most = sum_over_rows<Largest>(threads_, state.size(), consider);
    most.add(of_discs);
    return most.stiffness();
}

// No direction is stiffer than k, however the springs are turned and stretched; but drag may be of any rate.
Stiffness Dynamics::bound_stiffness(const std::vector<Link>& links) const {
    const auto has_no_bound = [](const DragRow& d) { return d.quadratic != 0; };
    if (!springs_.empty() || std::any_of(drags_.begin(), drags_.end(), has_no_bound))
        return {std::numeric_limits<double>::infinity(), 0};
    std::vector<NodeStiffness> node(mass_.size());
    for (const Link& l : links) {
        for (const auto& [self, other] : {std::pair{l.a, l.b}, std::pair{l.b, l.a}}) {
            node[self].xx += share(self, other) * l.stiffness;
            node[self].damping += share(self, other) * l.damping;
        }
    }
    for (const TorsionRow& s : torsion_springs_) {
        for (const auto& [self, other] : {std::pair{s.a, s.b}, std::pair{s.b, s.a}}) {
            node[self].angle += share(self, other) * s.stiffness;
            node[self].angular_damping += share(self, other) * s.damping;
        }
    }
    for (const DragRow& d : drags_)
        for (Row i = d.first; i < d.last; ++i) node[i].damping += d.linear, node[i].angular_damping += d.angular;
    Largest most;
    for (std::size_t i = 0; i < node.size(); ++i)
        most += {inverse_mass_[i] * node[i].xx + inverse_inertia_[i] * node[i].angle,
                 inverse_mass_[i] * node[i].damping + inverse_inertia_[i] * node[i].angular_damping};
    most.add(largest(soft_discs_));
    return most.stiffness();
}

}  // namespace carom
