#include "forces/dynamics.hpp"

#include <algorithm>

#include "forces/parts.hpp"

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

namespace {

/// Whether a spring is one of the network's.
bool joins_centres(const Spring& s) {
    return s.anchor_a == Vec2{} && s.anchor_b == Vec2{} && (s.damping == 0 || s.damping_law == DampingLaw::along);
}

}  // namespace

Dynamics::Dynamics(const Forces& forces, const Bodies& bodies, int threads)
    : threads_(threads),
      gravity_(forces.gravity),
      kind_(bodies.kind),
      mass_(bodies.mass),
      inverse_mass_(bodies.inverse_mass),
      inverse_inertia_(bodies.inverse_inertia),
      user_forces_(forces.user_forces) {
    const auto row = [&](BodyId id) { return static_cast<Row>(bodies.row(id)); };
    const auto first = [&](const std::optional<BodyId>& id) { return id ? row(*id) : 0; };
    const auto last = [&](const std::optional<BodyId>& id) {
        return id ? row(*id) + 1 : static_cast<Row>(bodies.size());
    };

    for (const Drive& d : forces.drives) placed_.push_back({bodies.row(d.body), d.curve});
    std::vector<Link> links;
    for (const Spring& s : forces.springs) {
        if (joins_centres(s))
            links.push_back({row(s.a), row(s.b), s.stiffness, s.rest_length, s.damping});
        else
            springs_.push_back(
                {row(s.a), row(s.b), s.stiffness, s.rest_length, s.damping, s.damping_law, s.anchor_a, s.anchor_b});
        needs_velocity_ |= s.damping != 0;
    }
    network_ = SpringNetwork(links, bodies.size());
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
    driven_ = std::find(kind_.begin(), kind_.end(), Kind::driven) != kind_.end();
    needs_velocity_ |= !drags_.empty() || !fields_.empty() || !user_forces_.empty() || driven_;
    others_ = !(springs_.empty() && torsion_springs_.empty() && drags_.empty() && attractions_.empty() &&
                constant_forces_.empty() && fields_.empty() && user_forces_.empty());
    bound_ = bound_stiffness(links);
}

bool Dynamics::is_free_flight() const { return network_.empty() && !others_ && placed_.empty(); }

void Dynamics::place_driven(State& state) const {
    // The velocity on a curve by a five-point difference: error ~1e-12 of the curve's scale for smooth curves.
    constexpr double h = 1.0 / 1024;
    for (const PlacedRow& p : placed_) {
        const auto slope = [&, t = state.time](auto component) {
            const auto at = [&](double s) { return component(p.curve(t + s)); };
            return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
        };
        const Pose pose = p.curve(state.time);
        state.x.linear[p.row] = pose.position;
        state.x.angular[p.row] = pose.angle;
        state.v.linear[p.row] = {slope([](Pose q) { return q.position.x; }),
                                 slope([](Pose q) { return q.position.y; })};
        state.v.angular[p.row] = slope([](Pose q) { return q.angle; });
    }
}

void Dynamics::evaluate(State& state, Rates& rates) const {
    place_driven(state);
    rates.acceleration.resize(state.size());
    // What acts on a block of rows alone is done with while the block is in the cache.
    rates.power =
        sum_over_rows<Powers>(threads_, state.size(), [&](std::size_t first, std::size_t last, Powers& power) {
            write_spring_forces(state, first, last, rates.acceleration, power);
            if (!others_) accelerate(state, first, last, rates.acceleration, power);
        });
    if (!others_) return;
    add_other_loads(state, {rates.acceleration.linear, rates.acceleration.angular, rates.power});
    rates.power +=
        sum_over_rows<Powers>(threads_, state.size(), [&](std::size_t first, std::size_t last, Powers& power) {
            accelerate(state, first, last, rates.acceleration, power);
        });
}

// A wave through the rows: springs reach only so far, so a block's forces can be had as soon as the rows up to the
// farthest that they read are ready, and rows that no later block reads are done with. Each row is then moved and
// evaluated while it is in the cache: once through memory a step.
void Dynamics::evaluate_between(const RowWork& before, State& state, Rates& rates, const RowWork& after) const {
    const std::size_t size = state.size();
    if (others_ || threads_ > 1 || !placed_.empty()) {
        for_each_rows(threads_, size, before);
        evaluate(state, rates);
        return for_each_rows(threads_, size, after);
    }
    rates.acceleration.resize(size);
    std::size_t ready = 0, done = 0;
    const auto advance = [](std::size_t& mark, std::size_t to, const RowWork& work) {
        if (mark < to) work(mark, to);
        mark = std::max(mark, to);
    };
    rates.power = sum_over_rows<Powers>(1, size, [&](std::size_t first, std::size_t last, Powers& power) {
        advance(ready, network_.empty() ? last : network_.reads_up_to(first, last), before);
        write_spring_forces(state, first, last, rates.acceleration, power, ready - first);
        accelerate(state, first, last, rates.acceleration, power);
        advance(done, network_.empty() ? last : network_.free_after(last), after);
    });
}

/// Of the network, which writes where the others add.
void Dynamics::write_spring_forces(const State& state, std::size_t first, std::size_t last, Motion& load, Powers& power,
                                   std::size_t ahead) const {
    if (turns(load, first, last)) std::fill(load.angular.begin() + first, load.angular.begin() + last, 0.0);
    if (network_.empty()) return std::fill(load.linear.begin() + first, load.linear.begin() + last, Vec2{});
    power[Account::damping] += network_.write_forces(state, first, last, load.linear, ahead).damping;
}

void Dynamics::add_other_loads(const State& state, Loads loads) const {
    add_loads(springs_, state, loads);
    add_loads(torsion_springs_, state, loads);
    add_loads(drags_, inverse_mass_, state, loads);
    add_loads(attractions_, threads_, state, loads);
    add_loads(constant_forces_, state, loads);
    add_loads(fields_, mass_, inverse_mass_, state, loads);
    if (user_forces_.empty()) return;
    std::vector<Vec2> user_force(state.size());
    std::vector<double> user_torque(state.size());
    const Snapshot now{state.time, state.x.linear, state.x.angular, state.v.linear, state.v.angular, mass_};
    for (const UserForce& f : user_forces_) f.add(now, user_force, user_torque);
    for (std::size_t i = 0; i < state.size(); ++i) {
        loads.force[i] += user_force[i];
        loads.torque[i] += user_torque[i];
        loads.power[Account::user] += dot(user_force[i], state.v.linear[i]) + user_torque[i] * state.v.angular[i];
    }
}

/// From force and torque to acceleration; the power of whoever holds against them.
void Dynamics::accelerate(const State& state, std::size_t first, std::size_t last, Motion& load, Powers& power) const {
    double held = 0;
    if (others_ || driven_)
        for (std::size_t i = first; i < last; ++i) {
            // Whoever drives a body holds against the forces on it, and so works on those that exert them.
            if (kind_[i] == Kind::driven) held += dot(load.linear[i], state.v.linear[i]);
            // A point has no inertia that torques could act on: it turns as it was told to, as a driven body does.
            if (kind_[i] != Kind::fixed && inverse_inertia_[i] == 0) held += load.angular[i] * state.v.angular[i];
        }
    power[Account::driven] -= held;
    for (std::size_t i = first; i < last; ++i) {
        // Not (m g) / m: a free body falls with g to the last bit.
        const Vec2 acceleration = gravity_ + inverse_mass_[i] * load.linear[i];
        load.linear[i] = inverse_mass_[i] != 0 ? acceleration : Vec2{};
    }
    if (others_)  // or there are no torques
        for (std::size_t i = first; i < last; ++i) load.angular[i] *= inverse_inertia_[i];
}

Springs Dynamics::springs() const {
    Springs all = springs_;
    for (const Link& l : network_.links())
        all.push_back({l.a, l.b, l.stiffness, l.rest_length, l.damping, DampingLaw::along, {}, {}});
    return all;
}

double Dynamics::gravity_potential(const State& state) const {
    double sum = 0;
    for (std::size_t i = 0; i < state.size(); ++i)
        if (inverse_mass_[i] != 0) sum -= mass_[i] * dot(gravity_, state.x.linear[i]);
    return sum;
}

double Dynamics::spring_potential(const State& state) const {
    const auto add_network = [&](std::size_t first, std::size_t last, double& sum) {
        sum += network_.potential(state, first, last);
    };
    const double of_network = network_.empty() ? 0 : sum_over_rows<double>(threads_, state.size(), add_network);
    return of_network + potential(springs_, state) + potential(torsion_springs_, state);
}

double Dynamics::field_potential(const State& state) const {
    return potential(attractions_, state) + potential(constant_forces_, state) +
           potential(fields_, mass_, inverse_mass_, state);
}

}  // namespace carom
