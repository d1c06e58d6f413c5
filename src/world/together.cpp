#include "world/together.hpp"

#include "integrators/propose.hpp"
#include "world/state.hpp"

namespace carom {

namespace {

/// The dynamic bodies that do not fly freely, by row.
std::vector<bool> not_free(const Forces& forces, const Mechanisms& mechanisms, const std::vector<BodyId>& let_go,
                           const Bodies& bodies) {
    std::vector<bool> some(bodies.size());
    const auto mark = [&](BodyId id) { some[bodies.row(id)] = true; };
    for (const Spring& s : forces.springs) mark(s.a), mark(s.b);
    for (const TorsionSpring& s : forces.torsion_springs) mark(s.a), mark(s.b);
    for (const ConstantForce& f : forces.constant_forces) mark(f.body);
    for (const Drag& d : forces.drags)
        if (d.body) mark(*d.body);
    for (const ForceField& f : forces.fields)
        if (f.body) mark(*f.body);
    for (const Joint& joint : mechanisms.joints) {
        if (joint.a) mark(*joint.a);
        mark(joint.b);
    }
    for (const BodyId id : let_go) mark(id);
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        for (const Shape& shape : bodies.shapes[row]) some[row] = some[row] || !shape.sensor;
        if (bodies.inverse_mass[row] == 0) some[row] = false;
    }
    return some;
}

/// The bodies, where some of them are as if fixed.
Bodies with_fixed(Bodies bodies, const std::vector<bool>& stepped, bool which) {
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (bodies.inverse_mass[row] != 0 && stepped[row] == which)
            bodies.kind[row] = Kind::fixed, bodies.inverse_mass[row] = bodies.inverse_inertia[row] = 0;
    return bodies;
}

}  // namespace

Together::Together(const Forces& forces, const Mechanisms& mechanisms, const std::vector<BodyId>& let_go,
                   const Bodies& all, const std::vector<Piece>& of_all, int threads) {
    const std::vector<bool> stepped = not_free(forces, mechanisms, let_go, all);
    company = GasCompany(stepped, all, of_all);
    if (company.empty()) return;
    bodies_of_gas = with_fixed(all, stepped, true);
    bodies_in_steps = with_fixed(all, stepped, false);
    everybody_ = true;
    for (const double inverse_mass : bodies_of_gas.inverse_mass) everybody_ = everybody_ && inverse_mass == 0;
    for (const Piece& piece : of_all)
        if (all.inverse_mass[piece.row] == 0 || stepped[piece.row]) pieces.push_back(piece);
    dynamics = Dynamics(forces, bodies_in_steps, threads);
    may_rest.assign(all.size(), false);
}

GasScene World::State::gas_scene() {
    const bool alone = together.empty();
    return {std::get<Events>(settings.solver),
            walls,
            alone ? bodies : together.bodies_of_gas,
            alone ? pieces : together.pieces,
            settings.gravity,
            settings.threads,
            alone ? nullptr : &together.company};
}

/// Substep by substep, for a body that bounces in one is hit by the gas as if it had done so all the time.
void World::State::step_together(double dt, int cuts) {
    const int substeps = cuts * least_parts();
    for (int i = 0; i < substeps; ++i) take_turns(dt / substeps, cuts);
    memory.finite = false;
}

/// The others move as if there were no gas. That it pushes them is added to their ways while the gas flies by.
void World::State::take_turns(double h, int cuts) {
    const GasScene scene = gas_scene();
    make_ready(scene, motion, gas);
    const carom::State start = motion;
    for (std::size_t row = 0; row < motion.size(); ++row)
        if (scene.bodies.inverse_mass[row] != 0) motion.v.linear[row] = {}, motion.v.angular[row] = 0;
    const Flight flight{together.dynamics, memory, [this](carom::State& state, double part) {
                            propose(settings.integrator, together.dynamics, state, part, memory);
                        }};
    const SoftScene others{flight,
                           walls,
                           together.bodies_in_steps,
                           together.pieces,
                           1,
                           cuts,
                           drift_share(settings.integrator),
                           ramp_share(settings.integrator),
                           Precise::some,
                           false,
                           false,
                           std::nullopt,
                           false,
                           settings.threads,
                           together.may_rest,
                           mechanisms,
                           profile,
                           false};
    carom::advance(others, motion, h, soft_contacts);
    together.company.set_out(start, motion, mechanisms, h);
    carom::advance(scene, motion, h, gas);
    together.company.arrive(together.dynamics, motion);
    memory.continues = false;
    for (std::size_t row = 0; row < motion.size(); ++row)  // where their contacts are told
        soft_contacts.motion.frames[row].position = motion.x.linear[row];
}

}  // namespace carom
