#pragma once
// Bodies at random places with random speeds, and the forces that a test puts on them.

#include <carom/random.hpp>

#include "forces/dynamics.hpp"

namespace carom::test {

struct System {
    Bodies bodies;
    State state;
    Forces forces;

    Dynamics dynamics() const { return Dynamics(forces, bodies); }
    BodyId id(std::size_t i) const { return bodies.id[i]; }
    double potential(const State& at) const {
        const Dynamics d = dynamics();
        return d.gravity_potential(at) + d.spring_potential(at) + d.field_potential(at);
    }
    double potential() const { return potential(state); }
    Rates rates() const {
        State at = state;
        Rates out;
        dynamics().evaluate(at, out);
        return out;
    }
};

inline Vec2 vector(Random& random, double size) {
    const double x = random.uniform(-size, size);
    return {x, random.uniform(-size, size)};
}

/// Discs that turn, a point that does not, and (last) a body of another kind.
inline System random_system(std::uint64_t seed, Kind last = Kind::fixed, std::size_t size = 6) {
    Random random(seed);
    System s;
    for (std::size_t i = 0; i < size; ++i) {
        const bool other = i + 1 == size && last != Kind::dynamic;
        Body body{.kind = other ? last : Kind::dynamic,
                  .position = vector(random, 2),
                  .angle = random.uniform(-3, 3),
                  .velocity = vector(random, 1),
                  .angular_velocity = random.uniform(-1, 1),
                  .mass = random.uniform(0.5, 2),
                  .radius = i == 0 ? 0 : random.uniform(0.3, 1),
                  .charge = random.uniform(-1, 1)};
        if (body.kind == Kind::fixed) body.velocity = {}, body.angular_velocity = 0;
        s.bodies.add(body, s.state);
    }
    return s;
}

/// A spring between every two bodies, at points off their centres.
inline void add_springs(System& s, Random& random, double stiffness, double damping, DampingLaw law) {
    for (std::size_t i = 0; i < s.bodies.size(); ++i)
        for (std::size_t j = i + 1; j < s.bodies.size(); ++j)
            s.forces.springs.push_back({.a = s.id(i),
                                        .b = s.id(j),
                                        .anchor_a = vector(random, 0.5),
                                        .anchor_b = vector(random, 0.5),
                                        .stiffness = stiffness * random.uniform(0.5, 2),
                                        .rest_length = random.uniform(0, 2),
                                        .damping = damping,
                                        .damping_law = law});
}

}  // namespace carom::test
