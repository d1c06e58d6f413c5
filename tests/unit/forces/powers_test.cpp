// The accounts that fill during flight: dE/dt = −damping − drag + wind + user + driven, at random states.
#include <gtest/gtest.h>

#include "unit/forces/random_system.hpp"

using namespace carom;
using test::System;

namespace {

/// d(kinetic + potential)/dt at the state: Σ m v·a + I ω α, and the slope of U along the motion.
double energy_rate(const System& s, const Rates& rates) {
    double rate = 0;
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
        if (s.bodies.kind[i] != Kind::dynamic) continue;
        rate += s.bodies.mass[i] * dot(s.state.v.linear[i], rates.acceleration.linear[i]) +
                s.bodies.inertia[i] * s.state.v.angular[i] * rates.acceleration.angular[i];
    }
    const auto central = [&](double h) {
        const auto shifted = [&](double t) {
            State at = s.state;
            each([t](double& x, double v) { x += t * v; }, at.x, s.state.v);
            return s.potential(at);
        };
        return (shifted(h) - shifted(-h)) / (2 * h);
    };
    return rate + (4 * central(0.5e-4) - central(1e-4)) / 3;
}

/// The accounts are algebra, the rate has finite differences in it: as in potential_test, 1e-9 of the scale.
void expect_accounts_close(const System& s) {
    const Rates rates = s.rates();
    const Flows& p = rates.flow;
    const double flow =
        -p[Account::damping] - p[Account::drag] + p[Account::wind] + p[Account::user] + p[Account::driven];
    EXPECT_NEAR(energy_rate(s, rates), flow, 1e-9 * (1 + std::abs(s.potential())));

    // And with the work of the potentials they are all the work there is, which `method` takes off; and all the
    // momentum. Sums of some ten terms in another order: 1e-13 of their size.
    const double conservative = p[Account::gravity] + p[Account::spring] + p[Account::field];
    double size = 1;
    for (const double power : p.power) size += std::abs(power);
    EXPECT_NEAR(flow + conservative + p[Account::method], 0, 1e-13 * size);
    Wrench sum;
    double pulls = 1;
    for (const Wrench& w : p.wrench) {
        sum.add(w.force, w.torque);
        pulls += length(w.force) + std::abs(w.torque);
    }
    for (std::size_t i = 0; i < s.bodies.size(); ++i) pulls += s.bodies.mass[i] * length(rates.acceleration.linear[i]);
    EXPECT_NEAR(length(sum.force), 0, 1e-13 * pulls);
    EXPECT_NEAR(sum.torque, 0, 1e-12 * pulls);  // arms of up to ten metres
}

void stop_the_point(System& s) {
    // The point of random_system does not turn; without inertia its ω would be a fiction that springs still feel.
    s.state.v.angular[0] = 0;
}

}  // namespace

TEST(Powers, OfSpringDampingAreTheEnergyLost) {
    for (const DampingLaw law : {DampingLaw::along, DampingLaw::isotropic})
        for (int seed = 0; seed < 20; ++seed) {
            System s = test::random_system(seed);
            stop_the_point(s);
            Random random(seed);
            test::add_springs(s, random, 3, 0.8, law);
            s.forces.torsion_springs.push_back({s.id(1), s.id(2), 2, 0.1, 0.5});
            expect_accounts_close(s);
            EXPECT_GT(s.rates().flow[Account::damping], 0);
        }
}

TEST(Powers, OfDragAndWindAreTwoAccounts) {
    for (int seed = 0; seed < 20; ++seed) {
        System s = test::random_system(seed);
        stop_the_point(s);
        s.forces.drags.push_back({.linear = 0.7, .quadratic = 0.4, .angular = 0.2, .wind = {2, -1}});
        s.forces.drags.push_back({.body = s.id(1), .quadratic = 3});
        expect_accounts_close(s);
        EXPECT_GT(s.rates().flow[Account::drag], 0);
    }
}

TEST(Powers, OfDragAtRestInAWindHeatTheAir) {
    System s = test::random_system(1);
    s.state.v.fill_zero();
    s.forces.drags.push_back({.linear = 2, .wind = {3, 0}});
    const Flows p = s.rates().flow;
    EXPECT_NEAR(p[Account::drag], 5 * 18, 1e-12);  // five bodies that feel it, c u² each
    EXPECT_NEAR(p[Account::wind], 5 * 18, 1e-12);
}

TEST(Drag, HasTheLawsOfStokesAndNewton) {
    System s = test::random_system(1, Kind::dynamic, 1);
    s.bodies.mass = {2};
    s.bodies.inverse_mass = {0.5};
    s.state.v.linear = {{3, 4}};
    s.forces.drags = {{.linear = 0.5, .quadratic = 0.1, .wind = {0, 0}}};
    const Vec2 a = s.rates().acceleration.linear[0];
    EXPECT_NEAR(a.x, -(0.5 + 0.1 * 5) * 3 / 2, 1e-15);
    EXPECT_NEAR(a.y, -(0.5 + 0.1 * 5) * 4 / 2, 1e-15);
}

TEST(Powers, OfDrivenBodiesAreTheirWorkOnTheOthers) {
    for (int seed = 0; seed < 20; ++seed) {
        System s = test::random_system(seed, Kind::driven);
        stop_the_point(s);
        Random random(seed);
        test::add_springs(s, random, 3, 0.8, DampingLaw::along);
        s.forces.attractions.push_back({.softening = 0.3});
        s.forces.torsion_springs.push_back({s.id(1), s.id(5), 2, 0.1, 0.5});
        expect_accounts_close(s);
    }
}

TEST(Powers, OfUserForcesAndTorquesAreWork) {
    for (int seed = 0; seed < 20; ++seed) {
        System s = test::random_system(seed);
        stop_the_point(s);
        s.forces.constant_forces.push_back({.body = s.id(2), .force = {1, 2}, .point = {0.3, 0.1}, .torque = 1.5});
        s.forces.fields.push_back({.force = [](Vec2 x, Vec2 v, double, double) { return Vec2{x.y - v.x, 2 * v.y}; }});
        s.forces.user_forces.push_back({.add = [](const Snapshot& now, std::span<Vec2> f, std::span<double> t) {
            for (std::size_t i = 0; i < f.size(); ++i) f[i] += Vec2{now.velocity[i].y, 1}, t[i] += 0.3;
        }});
        expect_accounts_close(s);
    }
}

TEST(Powers, OfTorqueOnAFixedBodyAreNone) {
    System s = test::random_system(1);
    s.forces.constant_forces.push_back({.body = s.id(5), .force = {1, 2}, .torque = 1.5});
    EXPECT_EQ(s.rates().flow[Account::user], 0);
}

// What a force does to a body that is driven, or that does not turn, moves nothing: no account may fill.
TEST(Powers, CloseWhenForcesActOnDrivenBodies) {
    for (int seed = 0; seed < 20; ++seed) {
        System s = test::random_system(seed, Kind::driven);
        stop_the_point(s);
        const BodyId driven = s.id(5);
        s.forces.constant_forces.push_back({.body = driven, .force = {1, 2}, .point = {0.2, 0.1}, .torque = 1.5});
        s.forces.drags.push_back({.linear = 0.7, .wind = {1, 0}});
        s.forces.fields.push_back({.force = [](Vec2 x, Vec2, double, double) { return Vec2{x.y, 2}; }});
        s.forces.user_forces.push_back({.add = [](const Snapshot&, std::span<Vec2> f, std::span<double> t) {
            for (std::size_t i = 0; i < f.size(); ++i) f[i] += Vec2{1, 2}, t[i] += 0.3;
        }});
        expect_accounts_close(s);
    }
}

TEST(Powers, CloseForAPointThatCannotTurn) {
    System s = test::random_system(7);
    ASSERT_NE(s.state.v.angular[0], 0);
    Random random(8);
    test::add_springs(s, random, 3, 0.8, DampingLaw::isotropic);
    expect_accounts_close(s);
}
