// Every force that has a potential is minus its gradient; forces between bodies are opposite and give no torque.
#include <gtest/gtest.h>

#include <cmath>

#include "unit/forces/random_system.hpp"

using namespace carom;
using test::System;

namespace {

constexpr int seeds = 20;

/// F = −∂U/∂x and τ = −∂U/∂θ by central differences. Step 1e-4 with one Richardson extrapolation: truncation
/// ~ 1e-16 U⁗', rounding ~ 1e-16 U/1e-4; both stay under 1e-9 of the forces' scale here (U some 100 J at most).
void expect_force_is_gradient(const System& s) {
    const Rates rates = s.rates();
    const auto slope = [&](auto member) {
        const auto central = [&](double h) {
            State plus = s.state, minus = s.state;
            member(plus) += h;
            member(minus) -= h;
            return (s.potential(plus) - s.potential(minus)) / (2 * h);
        };
        return (4 * central(0.5e-4) - central(1e-4)) / 3;
    };
    const double tolerance = 1e-9 * (1 + std::abs(s.potential()));
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
        if (s.bodies.kind[i] != Kind::dynamic) continue;
        const Vec2 force = s.bodies.mass[i] * rates.acceleration.linear[i];
        EXPECT_NEAR(force.x, -slope([i](State& q) -> double& { return q.x.linear[i].x; }), tolerance);
        EXPECT_NEAR(force.y, -slope([i](State& q) -> double& { return q.x.linear[i].y; }), tolerance);
        if (s.bodies.inertia[i] == 0) continue;
        const double torque = s.bodies.inertia[i] * rates.acceleration.angular[i];
        EXPECT_NEAR(torque, -slope([i](State& q) -> double& { return q.x.angular[i]; }), tolerance);
    }
}

/// Σ F = 0 and Σ (x × F + τ) = 0 for forces between bodies; all of them must be dynamic and turn.
void expect_third_law(const System& s) {
    const Rates rates = s.rates();
    Vec2 force{};
    double torque = 0, scale = 0;
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
        const Vec2 f = s.bodies.mass[i] * rates.acceleration.linear[i];
        const double t = s.bodies.inertia[i] * rates.acceleration.angular[i];
        force += f;
        torque += cross(s.state.x.linear[i], f) + t;
        scale += length(f) * (1 + length(s.state.x.linear[i])) + std::abs(t);
    }
    EXPECT_GT(scale, 0.1);
    EXPECT_NEAR(length(force), 0, 1e-14 * scale);  // some 30 roundings of the largest terms
    EXPECT_NEAR(torque, 0, 1e-14 * scale);
}

System turning(std::uint64_t seed) {
    System s = test::random_system(seed, Kind::dynamic);
    s.bodies.inertia[0] = 0.7;  // the point turns too, or its torque would be lost
    s.bodies.inverse_inertia[0] = 1 / 0.7;
    return s;
}

}  // namespace

TEST(Gravity, IsTheGradientOfItsPotential) {
    for (int seed = 0; seed < seeds; ++seed) {
        System s = test::random_system(seed);
        s.forces.gravity = {1.5, -9.81};
        expect_force_is_gradient(s);
    }
}

TEST(Gravity, FallsWithGToTheLastBit) {
    System s = test::random_system(1);
    s.forces.gravity = {0.3, -9.81};
    EXPECT_EQ(s.rates().acceleration.linear[1], (Vec2{0.3, -9.81}));
}

TEST(Springs, AreTheGradientOfTheirPotentialTorquesIncluded) {
    for (int seed = 0; seed < seeds; ++seed) {
        System s = test::random_system(seed);
        Random random(1000 + seed);
        test::add_springs(s, random, 3, 0, DampingLaw::along);
        expect_force_is_gradient(s);
    }
}

TEST(Springs, ObeyNewtonsThirdLaw) {
    for (const DampingLaw law : {DampingLaw::along, DampingLaw::isotropic}) {
        System s = turning(3);
        Random random(4);
        test::add_springs(s, random, 3, law == DampingLaw::along ? 0.7 : 0, law);
        expect_third_law(s);
    }
}

TEST(Springs, DampedIsotropicallyKeepMomentumThoughNotAngularMomentum) {
    // −c Δv has a part across the spring, so that the two forces are a couple: the law says so, and so does its text.
    System s = turning(3);
    Random random(4);
    test::add_springs(s, random, 3, 0.7, DampingLaw::isotropic);
    const Rates rates = s.rates();
    Vec2 force{};
    for (std::size_t i = 0; i < s.bodies.size(); ++i) force += s.bodies.mass[i] * rates.acceleration.linear[i];
    EXPECT_NEAR(length(force), 0, 1e-13);
}

TEST(Springs, PushAlongXAtLengthZero) {
    System s = test::random_system(1, Kind::dynamic, 2);
    s.state.x.linear[0] = s.state.x.linear[1] = {1, 1};
    s.forces.springs.push_back({.a = s.id(0), .b = s.id(1), .stiffness = 2, .rest_length = 0.5});
    const Vec2 force = s.bodies.mass[1] * s.rates().acceleration.linear[1];
    EXPECT_NEAR(force.x, 1, 1e-15);  // k L, times m / m
    EXPECT_EQ(force.y, 0);
}

TEST(TorsionSprings, AreTheGradientOfTheirPotential) {
    for (int seed = 0; seed < seeds; ++seed) {
        System s = turning(seed);
        for (std::size_t i = 0; i + 1 < s.bodies.size(); ++i)
            s.forces.torsion_springs.push_back({s.id(i), s.id(i + 1), 2.0 + double(i), 0.3, 0});
        expect_force_is_gradient(s);
        s.forces.torsion_springs[0].damping = 2;
        expect_third_law(s);
    }
}

TEST(Attractions, AreTheGradientOfTheirPotentialUnderAllFourLaws) {
    for (const Couples couples : {Couples::mass, Couples::charge})
        for (const DistanceLaw law : {DistanceLaw::inverse_square, DistanceLaw::inverse})
            for (int seed = 0; seed < seeds; ++seed) {
                System s = test::random_system(seed);
                s.forces.attractions.push_back({.strength = 1.3, .couples = couples, .law = law, .softening = 0.5});
                expect_force_is_gradient(s);
                System t = turning(seed);
                t.forces.attractions = s.forces.attractions;
                t.forces.attractions[0].softening = 0;
                expect_third_law(t);
            }
}

TEST(Attractions, HaveTheSignAndSizeOfTheirLaw) {
    System s = test::random_system(1, Kind::dynamic, 2);
    s.state.x.linear = {{0, 0}, {2, 0}};
    s.bodies.mass = {3, 5};
    s.bodies.inverse_mass = {1. / 3, 1. / 5};
    s.bodies.charge = {7, 11};
    const auto force_on_first = [&](Couples couples, DistanceLaw law) {
        s.forces.attractions = {{.strength = 0.5, .couples = couples, .law = law}};
        return 3 * s.rates().acceleration.linear[0].x;
    };
    // 0.5 · 3 · 5 / 2², 0.5 · 15 / 2, and like charges repel: 0.5 · 77 / 4, 0.5 · 77 / 2.
    EXPECT_NEAR(force_on_first(Couples::mass, DistanceLaw::inverse_square), 1.875, 1e-14);
    EXPECT_NEAR(force_on_first(Couples::mass, DistanceLaw::inverse), 3.75, 1e-14);
    EXPECT_NEAR(force_on_first(Couples::charge, DistanceLaw::inverse_square), -9.625, 1e-14);
    EXPECT_NEAR(force_on_first(Couples::charge, DistanceLaw::inverse), -19.25, 1e-14);
}

TEST(ConstantForce, IsTheGradientOfItsPotentialAtAPoint) {
    for (int seed = 0; seed < seeds; ++seed) {
        System s = test::random_system(seed);
        for (std::size_t i = 0; i < s.bodies.size(); ++i)
            s.forces.constant_forces.push_back({.body = s.id(i), .force = {2, -3 + double(i)}, .point = {0.4, 0.2}});
        expect_force_is_gradient(s);
    }
}

TEST(ForceField, IsTheGradientOfThePotentialGivenWithIt) {
    for (int seed = 0; seed < seeds; ++seed) {
        System s = test::random_system(seed);
        s.forces.fields.push_back(
            {.force =
                 [](Vec2 x, Vec2, double m, double) {
                     return Vec2{-2 * m * x.x, -m * std::cos(x.y)};
                 },
             .potential = [](Vec2 x, double m, double) { return m * (x.x * x.x + std::sin(x.y)); }});
        expect_force_is_gradient(s);
    }
}

TEST(ForceField, ActsOnItsBodyAlone) {
    System s = test::random_system(1);
    s.forces.fields.push_back({.body = s.id(2), .force = [](Vec2, Vec2, double m, double) { return Vec2{m, 0}; }});
    const Rates rates = s.rates();
    for (std::size_t i = 0; i < s.bodies.size(); ++i) EXPECT_EQ(rates.acceleration.linear[i].x, i == 2 ? 1 : 0);
}

TEST(Forces, OfAllKindsTogetherAreTheGradient) {
    System s = turning(11);
    Random random(12);
    test::add_springs(s, random, 3, 0, DampingLaw::along);
    s.forces.gravity = {0, -9.81};
    s.forces.attractions.push_back({.softening = 0.2});
    s.forces.torsion_springs.push_back({s.id(1), s.id(2), 4, 0, 0});
    s.forces.constant_forces.push_back({.body = s.id(3), .force = {1, 1}, .point = {0.1, 0}});
    expect_force_is_gradient(s);
}
