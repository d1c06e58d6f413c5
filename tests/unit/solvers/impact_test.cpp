// One impact as algebra: momentum, energy against heat, restitution, Coulomb's cone.
#include "solvers/impact.hpp"

#include <gtest/gtest.h>

#include <carom/random.hpp>
#include <cmath>

using namespace carom;

namespace {

struct TwoBodies {
    Bodies bodies;
    State state;
    Touch touch{};

    Vec2 momentum() const { return bodies.mass[0] * state.v.linear[0] + bodies.mass[1] * state.v.linear[1]; }
    /// About the point of contact, which is where the impulse acts: each disc's own part.
    double spin_about_contact(std::size_t i) const {
        const Vec2 arm = (i == 0 ? -bodies.radius[0] : bodies.radius[1]) * touch.normal;  // from contact to centre
        return bodies.mass[i] * cross(arm, state.v.linear[i]) + bodies.inertia[i] * state.v.angular[i];
    }
    double energy() const {
        double sum = 0;
        for (std::size_t i = 0; i < 2; ++i)
            sum += 0.5 * bodies.mass[i] * squared_length(state.v.linear[i]) +
                   0.5 * bodies.inertia[i] * state.v.angular[i] * state.v.angular[i];
        return sum;
    }
    double approach() const { return dot(state.v.linear[0] - state.v.linear[1], touch.normal); }
    double slip() const {
        return dot(state.v.linear[0] - state.v.linear[1], perpendicular(touch.normal)) +
               bodies.radius[0] * state.v.angular[0] + bodies.radius[1] * state.v.angular[1];
    }
};

double heat_of(const TwoBodies& p) { return p.state.account[Account::impact] + p.state.account[Account::friction]; }

TwoBodies random_pair(Random& random) {
    TwoBodies p;
    const double direction = random.uniform(-3.2, 3.2);
    p.touch = {
        {std::cos(direction), std::sin(direction)}, random.uniform(), random.uniform() < 0.3 ? 0 : random.uniform()};
    for (int i = 0; i < 2; ++i) {
        Body disc{.angular_velocity = random.uniform(-3, 3),
                  .mass = std::exp(random.uniform(-3, 3)),
                  .radius = random.uniform(0.1, 2)};
        disc.velocity.x = random.uniform(-3, 3);
        disc.velocity.y = random.uniform(-3, 3);
        p.bodies.add(disc, p.state);
    }
    if (p.approach() < 0) std::swap(p.state.v.linear[0], p.state.v.linear[1]);
    return p;
}

}  // namespace

TEST(Impact, KeepsMomentumAndAccountsForEnergy) {
    Random random(1);
    int stuck = 0, slid = 0;
    for (int n = 0; n < 2000; ++n) {
        TwoBodies before = random_pair(random), after = before;
        ASSERT_TRUE(collide(0, 1, after.touch, after.bodies, after.state));
        // Masses up to 20 kg at 4 m/s: some 100 kg m/s and 300 J, a few roundings each.
        ASSERT_NEAR(length(after.momentum() - before.momentum()), 0, 1e-13);
        for (const std::size_t i : {0, 1})
            ASSERT_NEAR(after.spin_about_contact(i), before.spin_about_contact(i), 1e-12);
        ASSERT_NEAR(after.energy() + heat_of(after), before.energy(), 1e-12);
        ASSERT_NEAR(after.approach(), -before.touch.restitution * before.approach(), 1e-13);
        ASSERT_GE(after.state.account[Account::impact], 0);
        ASSERT_GE(after.state.account[Account::friction], 0);

        // Coulomb: the tangential impulse is at most µ times the normal one; less only if slip ends.
        const Vec2 impulse = before.bodies.mass[1] * (after.state.v.linear[1] - before.state.v.linear[1]);
        const double normal = dot(impulse, before.touch.normal),
                     tangential = dot(impulse, perpendicular(before.touch.normal));
        ASSERT_LE(std::abs(tangential), before.touch.friction * normal + 1e-12);
        if (std::abs(after.slip()) < 1e-12) {
            ++stuck;
        } else {
            ++slid;
            ASSERT_NEAR(std::abs(tangential), before.touch.friction * normal, 1e-12);
            ASSERT_GT(after.slip() * before.slip(), 0);  // friction does not overshoot
        }
    }
    EXPECT_GT(stuck, 200);
    EXPECT_GT(slid, 200);
}

TEST(Impact, AgainstAWallIsAgainstInfiniteMass) {
    Random random(2);
    for (int n = 0; n < 500; ++n) {
        TwoBodies pair = random_pair(random), wall = pair;
        pair.bodies.inverse_mass[1] = pair.bodies.inverse_inertia[1] = 0;
        pair.state.v.linear[1] = {};
        pair.state.v.angular[1] = 0;
        if (pair.approach() <= 0) continue;
        const Vec2 before = pair.state.v.linear[0];
        collide(0, 1, pair.touch, pair.bodies, pair.state);
        collide(0, wall.touch, wall.bodies, wall.state);
        EXPECT_EQ(pair.state.v.linear[0], wall.state.v.linear[0]);
        EXPECT_EQ(pair.state.v.angular[0], wall.state.v.angular[0]);
        EXPECT_EQ(heat_of(pair), heat_of(wall));
        const Vec2 given = pair.state.account[Giver::held].force;
        EXPECT_EQ(given, wall.state.account[Giver::walls].force);
        const Vec2 gained = pair.bodies.mass[0] * (pair.state.v.linear[0] - before);
        EXPECT_NEAR(length(given - gained), 0, 1e-12);  // 100 kg m/s, some roundings
    }
}

TEST(Impact, ByADrivenBodyDoesWork) {
    Random random(3);
    for (int n = 0; n < 500; ++n) {
        TwoBodies p = random_pair(random);
        p.bodies.kind[0] = Kind::driven;
        p.bodies.inverse_mass[0] = p.bodies.inverse_inertia[0] = 0;
        const auto energy = [&] {
            return 0.5 * p.bodies.mass[1] * squared_length(p.state.v.linear[1]) +
                   0.5 * p.bodies.inertia[1] * p.state.v.angular[1] * p.state.v.angular[1];
        };
        const double before = energy();
        collide(0, 1, p.touch, p.bodies, p.state);
        ASSERT_NEAR(energy() - before, p.state.account[Account::driven] - heat_of(p), 1e-11);
    }
}

TEST(Impact, ObliqueIsTheTextbooks) {
    // truth.json ed.oblique: equal masses, σ = 1, impact parameter ½: v1' = (1/4, −√3/4), v2' = (3/4, √3/4).
    TwoBodies p;
    p.bodies.add(Body{.velocity = {1, 0}, .radius = 0.5}, p.state);
    p.bodies.add(Body{.position = {std::sqrt(0.75), 0.5}, .radius = 0.5}, p.state);
    collide(0, 1, {{std::sqrt(0.75), 0.5}, 1, 0}, p.bodies, p.state);
    EXPECT_NEAR(p.state.v.linear[0].x, 0.25, 1e-14);
    EXPECT_NEAR(p.state.v.linear[0].y, -std::sqrt(3) / 4, 1e-14);
    EXPECT_NEAR(p.state.v.linear[1].x, 0.75, 1e-14);
    EXPECT_NEAR(p.state.v.linear[1].y, std::sqrt(3) / 4, 1e-14);
    EXPECT_NEAR(heat_of(p), 0, 1e-15);
}
