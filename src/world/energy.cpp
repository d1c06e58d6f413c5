#include "world/state.hpp"

namespace carom {

Energy World::State::stored_energy() const {
    Energy e;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.inverse_mass[i] == 0) continue;
        e.kinetic += 0.5 * bodies.mass[i] * squared_length(motion.v.linear[i]);
        e.rotational += 0.5 * bodies.inertia[i] * motion.v.angular[i] * motion.v.angular[i];
    }
    e.gravity = dynamics.gravity_potential(motion);
    e.spring = dynamics.spring_potential(motion);
    for (const Joint& joint : mechanisms.joints)
        if (has_spring(joint))
            e.spring += spring_energy(joint, {joint, end_of(joint.a, bodies, motion), end_of(joint.b, bodies, motion)});
    e.field = dynamics.field_potential(motion);
    return e;
}

Energy World::State::energy() const {
    Energy e = stored_energy();
    const Given all_given = given_so_far();
    const Flows& flown = motion.account;
    e.heat = {flown[Account::damping],  flown[Account::drag],          flown[Account::impact],
              flown[Account::friction], flown[Account::joint_damping], flown[Account::joint_friction],
              flown[Account::limit],    flown[Account::bath]};
    e.work = {.driven = flown[Account::driven],
              .wind = flown[Account::wind],
              .user = flown[Account::user],
              .motor = flown[Account::motor],
              .overlap = flown[Account::overlap] + flown[Account::parting],
              .correction = flown[Account::correction]};
    e.initial_total = all_given.energy;
    // Work that a potential did not lose was made by the method; where bodies were put apart it was overlap that rose.
    const double done = flown[Account::gravity] + flown[Account::spring] + flown[Account::field];
    const double risen = e.potential() - all_given.potential - (flown[Account::overlap] + flown[Account::correction]);
    e.residual = flown[Account::method] + (done + risen);
    return e;
}

Momentum World::State::momentum() const {
    Momentum total;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.inverse_mass[i] == 0) continue;
        const Vec2 p = bodies.mass[i] * motion.v.linear[i];
        total.linear += p;
        total.angular += cross(motion.x.linear[i], p) + bodies.inertia[i] * motion.v.angular[i];
    }
    return total;
}

MomentumBalance World::State::momentum_balance() const {
    MomentumBalance m;
    m.total = momentum();
    const auto from = [this](Giver giver) {
        const Wrench& w = motion.account[giver];
        return Momentum{w.force, w.torque};
    };
    m.initial = given_so_far().momentum;
    m.gravity = from(Giver::gravity);
    m.walls = from(Giver::walls);
    m.held = from(Giver::held);
    m.medium = from(Giver::medium);
    m.field = from(Giver::field);
    m.user = from(Giver::user);
    m.residual = from(Giver::method);
    return m;
}

World::State::Given World::State::has() const {
    const Energy e = stored_energy();
    return {e.total(), e.potential(), momentum()};
}

World::State::Given World::State::given_so_far() const {
    if (!edited) return given;
    const Given now = has();
    return {.energy = given.energy + (now.energy - before_edit.energy),
            .potential = given.potential + (now.potential - before_edit.potential),
            .momentum = {given.momentum.linear + (now.momentum.linear - before_edit.momentum.linear),
                         given.momentum.angular + (now.momentum.angular - before_edit.momentum.angular)}};
}

Energy energy(const World& world) {
    world.state_->settle();
    return world.state_->energy();
}

MomentumBalance momentum_balance(const World& world) {
    world.state_->settle();
    return world.state_->momentum_balance();
}

Momentum MomentumBalance::unaccounted() const {
    Momentum left = total;
    for (const Momentum& m : {initial, gravity, walls, held, medium, field, user, residual}) {
        left.linear -= m.linear;
        left.angular -= m.angular;
    }
    return left;
}

}  // namespace carom
