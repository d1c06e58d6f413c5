#include "forces/dynamics.hpp"

#include <algorithm>

#include "math/slope.hpp"

namespace carom {

void Forces::forget_removed(const Bodies& bodies) {
    const auto gone = [&](BodyId id) { return !bodies.contains(id); };
    const auto held_by_gone = [&](const auto& f) { return gone(f.a) || gone(f.b); };
    const auto of_gone = [&](const auto& f) { return f.body && gone(*f.body); };
    std::erase_if(springs, held_by_gone);
    std::erase_if(torsion_springs, held_by_gone);
    std::erase_if(drags, of_gone);
    std::erase_if(fields, of_gone);
    std::erase_if(constant_forces, [&](const ConstantForce& f) { return gone(f.body); });
    std::erase_if(drives, [&](const Drive& d) { return gone(d.body); });
}

Dynamics::Dynamics(const Forces& forces, const Bodies& bodies, int threads)
    : threads_(threads),
      gravity_(forces.gravity),
      kind_(bodies.kind),
      given_mass_(bodies.mass),
      mass_(bodies.mass),
      inertia_(bodies.inertia),
      inverse_mass_(bodies.inverse_mass),
      inverse_inertia_(bodies.inverse_inertia),
      user_forces_(forces.user_forces) {
    const auto row = [&](BodyId id) { return static_cast<Row>(bodies.row(id)); };
    const auto first = [&](const std::optional<BodyId>& id) { return id ? row(*id) : 0; };
    const auto last = [&](const std::optional<BodyId>& id) {
        return id ? row(*id) + 1 : static_cast<Row>(bodies.size());
    };

    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (inverse_mass_[i] == 0) mass_[i] = 0;
        if (inverse_inertia_[i] == 0) inertia_[i] = 0;
    }
    for (const Drive& d : forces.drives) placed_.push_back({bodies.row(d.body), d.curve});
    for (const Spring& s : forces.springs) {
        springs_.push_back(
            {row(s.a), row(s.b), s.stiffness, s.rest_length, s.damping, s.damping_law, s.anchor_a, s.anchor_b});
        needs_velocity_ |= s.damping != 0;
    }
    for (const TorsionSpring& s : forces.torsion_springs) {
        torsion_springs_.push_back({row(s.a), row(s.b), s.stiffness, s.rest_angle, s.damping});
        needs_velocity_ |= s.damping != 0;
    }
    for (const Drag& d : forces.drags)
        drags_.push_back({first(d.body), last(d.body), d.linear, d.quadratic, d.angular, d.wind});
    for (const ConstantForce& f : forces.constant_forces) {
        constant_forces_.push_back({row(f.body), f.force, f.point, f.torque});
        needs_velocity_ |= f.torque != 0;
    }
    for (const ForceField& f : forces.fields) fields_.push_back({first(f.body), last(f.body), f.force, f.potential});
    for (const Attraction& a : forces.attractions) {
        const bool masses = a.couples == Couples::mass;
        std::vector<bool> moves(bodies.size());
        for (std::size_t i = 0; i < moves.size(); ++i) moves[i] = kind_[i] != Kind::fixed;
        attractions_.push_back({masses ? a.strength : -a.strength, a.law, a.softening * a.softening,
                                masses ? bodies.mass : bodies.charge, std::move(moves)});
    }
    needs_velocity_ |= !drags_.empty() || !fields_.empty() || !user_forces_.empty() ||
                       std::find(kind_.begin(), kind_.end(), Kind::driven) != kind_.end();
}

bool Dynamics::is_free_flight() const {
    return springs_.empty() && torsion_springs_.empty() && drags_.empty() && attractions_.empty() &&
           constant_forces_.empty() && fields_.empty() && user_forces_.empty() && placed_.empty();
}

void Dynamics::place_driven(State& state) const {
    for (const PlacedRow& p : placed_) {
        const auto rate = [&](auto component) {
            return slope([&](double t) { return component(p.curve(t)); }, state.time);
        };
        const Pose pose = p.curve(state.time);
        state.x.linear[p.row] = pose.position;
        state.x.angular[p.row] = pose.angle;
        state.v.linear[p.row] = {rate([](Pose q) { return q.position.x; }), rate([](Pose q) { return q.position.y; })};
        state.v.angular[p.row] = rate([](Pose q) { return q.angle; });
    }
}

void Dynamics::add_up(State& state, Rates& rates) const {
    place_driven(state);
    auto& force = rates.acceleration.linear;
    auto& torque = rates.acceleration.angular;
    force.assign(state.size(), Vec2{});
    torque.assign(state.size(), 0.0);
    rates.flow = {};
    Loads loads{force, torque, rates.flow};

    add_loads(springs_, state, loads);
    add_loads(torsion_springs_, state, loads);
    add_loads(drags_, inverse_mass_, state, loads);
    add_loads(attractions_, threads_, state, loads);
    add_loads(constant_forces_, state, loads);
    add_loads(fields_, mass_, inverse_mass_, state, loads);
    if (user_forces_.empty()) return;
    std::vector<Vec2> user_force(state.size());
    std::vector<double> user_torque(state.size());
    const Snapshot now{state.time, state.x.linear, state.x.angular, state.v.linear, state.v.angular, given_mass_};
    for (const UserForce& f : user_forces_) f.add(now, user_force, user_torque);
    for (std::size_t i = 0; i < state.size(); ++i) {
        force[i] += user_force[i];
        torque[i] += user_torque[i];
        loads.flow[Account::user] += dot(user_force[i], state.v.linear[i]) + user_torque[i] * state.v.angular[i];
        loads.flow[Giver::user].add(user_force[i], cross(state.x.linear[i], user_force[i]) + user_torque[i]);
    }
}

void Dynamics::accelerate(const State& state, Rates& rates) const {
    Flows& flow = rates.flow;
    double mass = 0, total = 0, turning = 0;
    Vec2 first_moment{}, momentum{}, total_force{};
    for (std::size_t i = 0; i < state.size(); ++i) {
        const Vec2 x = state.x.linear[i], v = state.v.linear[i];
        Vec2& force = rates.acceleration.linear[i];
        double& torque = rates.acceleration.angular[i];
        // Whoever drives a body holds against the forces on it, and so works on those that exert them. A point has no
        // inertia that torques could act on: it turns as it was told to, as a driven body does.
        if (inverse_mass_[i] == 0) {
            flow[Account::driven] -= dot(force, v);
            flow[Giver::held].add_at(x, -force);
        }
        if (inverse_inertia_[i] == 0) {
            flow[Account::driven] -= torque * state.v.angular[i];
            flow[Giver::held].torque -= torque;
        }
        mass += mass_[i];
        first_moment += mass_[i] * x;
        momentum += mass_[i] * v;
        // Not (m g) / m: a free body falls with g to the last bit.
        force = inverse_mass_[i] == 0 ? Vec2{} : gravity_ + inverse_mass_[i] * force;
        torque *= inverse_inertia_[i];
        total_force += mass_[i] * force;
        total += mass_[i] * dot(force, v) + inertia_[i] * torque * state.v.angular[i];
        turning += mass_[i] * cross(x, force) + inertia_[i] * torque;
    }
    flow[Account::gravity] = dot(gravity_, momentum);
    flow[Giver::gravity] = {mass * gravity_, cross(first_moment, gravity_)};
    flow[Account::method] -= total;
    flow[Giver::method].add(-total_force, -turning);
}

double Dynamics::gravity_potential(const State& state) const {
    double sum = 0;
    for (std::size_t i = 0; i < state.size(); ++i)
        if (inverse_mass_[i] != 0) sum -= mass_[i] * dot(gravity_, state.x.linear[i]);
    return sum;
}

double Dynamics::spring_potential(const State& state) const {
    return potential(springs_, state) + potential(torsion_springs_, state);
}

double Dynamics::field_potential(const State& state) const {
    return potential(attractions_, state) + potential(constant_forces_, state) +
           potential(fields_, mass_, inverse_mass_, state);
}

namespace {

/// A body's share of the springs' Hessian: 2 × 2 for its place and one number for its angle.
struct NodeStiffness {
    double xx = 0, xy = 0, yy = 0, angle = 0, damping = 0, angular_damping = 0;

    void add(const Stretch& now, const SpringRow& s, Vec2 arm, double share) {
        // Along the spring k; across it k (1 − L/d), which counts only when it stiffens (d > L).
        const Vec2 n = now.direction;
        const double across = now.length > s.rest_length ? s.stiffness * (1 - s.rest_length / now.length) : 0;
        const double along = s.stiffness - across;
        xx += share * (along * n.x * n.x + across);
        xy += share * along * n.x * n.y;
        yy += share * (along * n.y * n.y + across);
        // Whichever way the arm points: a body may turn far within a step.
        angle += share *
                 (s.stiffness * squared_length(arm) + s.stiffness * std::abs(now.length - s.rest_length) * length(arm));
        damping += share * s.damping;
        angular_damping += share * s.damping * squared_length(arm);
    }
    double largest() const {
        const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
        return mean + std::sqrt(half * half + xy * xy);
    }
};

}  // namespace

Stiffness Dynamics::stiffness(const State& state) const {
    if (springs_.empty() && torsion_springs_.empty()) return {};
    std::vector<NodeStiffness> node(state.size());
    // (a − b)² ≤ 2 a² + 2 b² when both ends move; a² alone when one stands.
    const auto share = [&](Row self, Row other) {
        return inverse_mass_[self] == 0 ? 0.0 : inverse_mass_[other] == 0 ? 1.0 : 2.0;
    };
    for (const SpringRow& s : springs_) {
        const Stretch now = stretch(s, state);
        node[s.a].add(now, s, now.arm_a, share(s.a, s.b));
        node[s.b].add(now, s, now.arm_b, share(s.b, s.a));
    }
    for (const TorsionRow& s : torsion_springs_) {
        node[s.a].angle += share(s.a, s.b) * s.stiffness;
        node[s.b].angle += share(s.b, s.a) * s.stiffness;
        node[s.a].angular_damping += share(s.a, s.b) * s.damping;
        node[s.b].angular_damping += share(s.b, s.a) * s.damping;
    }
    double frequency2 = 0, rate = 0;
    for (std::size_t i = 0; i < node.size(); ++i) {
        // λ_max of the whole 3 × 3 block is at most that of its place plus that of its angle.
        frequency2 = std::max(frequency2, inverse_mass_[i] * node[i].largest() + inverse_inertia_[i] * node[i].angle);
        rate = std::max(rate, inverse_mass_[i] * node[i].damping + inverse_inertia_[i] * node[i].angular_damping);
    }
    return {std::sqrt(frequency2), rate};
}

}  // namespace carom
