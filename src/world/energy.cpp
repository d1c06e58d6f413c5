#include "world/state.hpp"

namespace carom {

Energy World::State::energy() const {
    Energy e = initial;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.inverse_mass[i] == 0) continue;
        e.kinetic += 0.5 * bodies.mass[i] * squared_length(motion.v.linear[i]);
        e.rotational += 0.5 * bodies.inertia[i] * motion.v.angular[i] * motion.v.angular[i];
    }
    e.gravity = dynamics.gravity_potential(motion);
    e.spring = dynamics.spring_potential(motion);
    e.field = dynamics.field_potential(motion);
    const Powers& flown = motion.account;
    e.heat = {flown[Account::damping], flown[Account::drag], contacts.heat_impact, contacts.heat_friction};
    e.work = {flown[Account::driven] + contacts.work_driven, flown[Account::wind], flown[Account::user],
              contacts.work_overlap};
    return e;
}

Energy energy(const World& world) {
    world.state_->settle();
    return world.state_->energy();
}

}  // namespace carom
