#include "world/together.hpp"

#include <cmath>
#include <utility>

#include "integrators/propose.hpp"
#include "world/state.hpp"

namespace carom {

namespace {

constexpr double least_turn = 1e-6;  ///< the shortest, of a substep

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

std::vector<GasKink> Together::kinks(const std::vector<Kink>& of_rows, double begin) const {
    std::vector<GasKink> all;
    for (const Kink& k : of_rows)
        if (const std::uint32_t mover = company.of_row(k.row); mover != GasMover::none)
            all.push_back({mover, k.time - begin, k.v, k.w});
    return all;
}

std::vector<GasTouch> Together::touches(const LargeArray<SoftContact>& contacts, const carom::State& start,
                                        const carom::State& end) const {
    std::vector<GasTouch> all;
    std::uint32_t number = 0;
    for (const SoftContact& c : contacts) {
        const auto place = [&](std::uint32_t row) { return row < start.size() ? start.x.linear[row] : Vec2{}; };
        const auto way = [&](std::uint32_t row, Vec2 lever) {
            if (row >= start.size()) return Vec2{};
            return end.x.linear[row] - start.x.linear[row] + cross(end.x.angular[row] - start.x.angular[row], lever);
        };
        const std::uint32_t a = company.of_row(c.a), b = company.of_row(c.b);
        for (int k = 0; k < c.manifold.count; ++k) {
            const Vec2 n = c.manifold.normal;
            const auto lever = levers(c, c.manifold, k, place(c.b) - place(c.a));
            const double gap = c.manifold.point[k].gap, later = gap + dot(way(c.b, lever[1]) - way(c.a, lever[0]), n);
            GasTouch touch{a, b, n, lever[0], lever[1], std::min(gap, later), c.restitution, c.at_wall, number++};
            if (a != GasMover::none) all.push_back(touch);
            std::swap(touch.mover, touch.other), std::swap(touch.lever, touch.lever_of_other);
            touch.normal = -n;
            if (b != GasMover::none) all.push_back(touch);
        }
    }
    return all;
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

/// Substep by substep: within one, forces do not know whom the gas struck.
void World::State::step_together(double dt, int cuts) {
    const int substeps = cuts * least_parts();
    for (int i = 0; i < substeps; ++i) take_turns(dt / substeps, cuts);
    memory.finite = false;
}

/// Moves the others as if there were no gas.
void World::State::move_company(double h, int cuts) {
    for (std::size_t row = 0; row < motion.size(); ++row)
        if (together.bodies_of_gas.inverse_mass[row] != 0) motion.v.linear[row] = {}, motion.v.angular[row] = 0;
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
    memory.continues = false;
}

/// Turn by turn, of which a hit ends one where it sends bodies on ways that their own method has to find.
void World::State::take_turns(double h, int cuts) {
    constexpr int most = 100;  // who is struck more often goes on as he was thought to
    Turn turn{h, h};
    for (int k = 0; turn.left > 0; ++k) turn = take_turn(turn, cuts, k < most && turn.left > 2 * least_turn * h);
    for (std::size_t row = 0; row < motion.size(); ++row)  // where their contacts are told
        soft_contacts.motion.frames[row].position = motion.x.linear[row];
}

/// Takes back how they moved in the turn that was planned, and moves them no further than to where it ends. The gas is
/// there already.
void World::State::move_company_again(double h, int cuts) {
    TurnBegin& begin = together.turn_begin;
    std::swap(motion, begin.motion), std::swap(soft_contacts, begin.contacts), std::swap(memory, begin.memory);
    std::swap(mechanisms.memory, begin.joints), std::swap(mechanisms.cuts, begin.cuts);
    move_company(h, cuts);
    const carom::State& shown = begin.motion;
    for (std::size_t row = 0; row < motion.size(); ++row) {
        if (together.bodies_of_gas.inverse_mass[row] == 0) continue;
        motion.x.linear[row] = shown.x.linear[row], motion.x.angular[row] = shown.x.angular[row];
        motion.v.linear[row] = shown.v.linear[row], motion.v.angular[row] = shown.v.angular[row];
    }
}

/// The others move as if there were no gas. That it pushes them is added to their ways while the gas flies by. If it is
/// about to strike one who bounces after that, or would be pressed into what he lies on, they move once more and no
/// further than to there, and that hit finds them as they are then: what is booked is what happened.
World::State::Turn World::State::take_turn(const Turn& turn, int cuts, bool may_stop) {
    const double least = least_turn * turn.substep;
    const GasScene scene = gas_scene();
    GasCompany& company = together.company;
    TurnBegin& begin = together.turn_begin;
    make_ready(scene, motion, gas);
    begin.motion = motion, begin.contacts = soft_contacts, begin.memory = memory;
    begin.joints = mechanisms.memory, begin.cuts = mechanisms.cuts;
    soft_contacts.events.kinks.clear();
    move_company(turn.left, cuts);
    company.set_out(begin.motion, motion, mechanisms,
                    {turn.left, turn.ahead, turn.substep, may_stop ? least : HUGE_VAL,
                     together.kinks(soft_contacts.events.kinks, begin.motion.time),
                     together.touches(soft_contacts.all, begin.motion, motion)});
    const Flows of_others = std::exchange(motion.account, {});
    carom::advance(scene, motion, turn.left + turn.ahead, gas);
    const Flows of_gas = std::exchange(motion.account, of_others);
    const double gone = company.gone(), moved = company.stopped ? std::max(gone, least) : turn.left;
    if (company.stopped) move_company_again(moved, cuts);
    motion.account += of_gas;
    company.arrive(together.dynamics, motion, moved);
    if (company.stopped) {
        make_hit(scene, motion, gas);
        company.arrive(together.dynamics, motion, moved);
    }
    company.rest();
    return company.stopped ? Turn{turn.substep, turn.left - moved, moved - gone} : Turn{};
}

}  // namespace carom
