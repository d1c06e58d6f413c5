#include <gtest/gtest.h>

#include <limits>

#include "error_of.hpp"
#include "integrators/nystrom_tables.hpp"
#include "restored.hpp"
#include "scenes.hpp"

namespace carom::test {
namespace {

// ---- The numbers ----------------------------------------------------------------------------------------------------

/// A tree of derivatives of a(x): a stage's value of it is c^leaves times, for each branch, Σ a_ij of the branch's
/// (Hairer, Norsett, Wanner, II.14: a special Nystrom tree). In the solution it is exact × t^weight.
struct Tree {
    int weight;
    double exact;
    std::vector<double> at_stages;
};

/// The products of branches from the first on that weigh so much together; each with the number of its last branch.
void grow(const NystromTable& table, const std::vector<Tree>& branches, std::size_t first, Tree product, int most,
          std::vector<Tree>& out) {
    out.push_back(product);
    for (std::size_t k = first; k < branches.size(); ++k) {
        const Tree& branch = branches[k];
        Tree more = product;
        more.weight += branch.weight + 2;
        if (more.weight > most) continue;
        more.exact *= branch.exact / ((branch.weight + 1) * (branch.weight + 2));
        for (std::size_t i = 0; i < table.stages(); ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < i; ++j) sum += table.row(i)[j] * branch.at_stages[j];
            more.at_stages[i] *= sum;
        }
        grow(table, branches, k, more, most, out);
    }
}

/// All trees that weigh at most so much.
std::vector<Tree> trees(const NystromTable& table, int most) {
    std::vector<Tree> all;
    for (int weight = 0; weight <= most; ++weight) {
        std::vector<Tree> branches;
        for (const Tree& t : all)
            if (t.weight + 2 <= weight) branches.push_back(t);
        for (int leaves = 0; leaves <= weight; ++leaves) {
            Tree stem{leaves, 1, std::vector<double>(table.stages())};
            for (std::size_t i = 0; i < table.stages(); ++i) {
                stem.at_stages[i] = 1;
                for (int k = 0; k < leaves; ++k) stem.at_stages[i] *= table.c[i];
            }
            std::vector<Tree> grown;
            grow(table, branches, 0, stem, weight, grown);
            for (const Tree& t : grown)
                if (t.weight == weight) all.push_back(t);
        }
    }
    return all;
}

/// The largest defect of the weights over the trees of a weight, in units of rounding.
double defect(const std::vector<Tree>& all, std::span<const double> weights, int weight, bool place) {
    double worst = 0;
    for (const Tree& t : all) {
        if (t.weight != weight) continue;
        double sum = 0, size = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            sum += weights[i] * t.at_stages[i];
            size += std::abs(weights[i] * t.at_stages[i]);
        }
        const double exact = t.exact / ((weight + 1) * (place ? weight + 2 : 1));
        worst = std::max(worst, std::abs(sum - exact) / size);
    }
    return worst / std::numeric_limits<double>::epsilon();
}

struct Method {
    const char* name;
    const NystromTable& table;
    NystromPair pair;
    int order;
};
const Method methods[] = {{"rkn64", tables::nystrom64, NystromPair::dormand_prince64, 6},
                          {"rkn86", tables::nystrom86, NystromPair::dormand_prince86, 8},
                          {"rkn1210", tables::nystrom1210, NystromPair::dormand_prince1210, 12}};

class Nystroms : public testing::TestWithParam<Method> {
  protected:
    Nystrom with(double tolerance) const { return {GetParam().pair, tolerance}; }
};
INSTANTIATE_TEST_SUITE_P(All, Nystroms, testing::ValuesIn(methods), [](const auto& test) { return test.param.name; });

// All conditions of the method's order and of its estimate's, and none of the next. 1e4 roundings: where coefficients
// of order 12 are a hundred, sums over stages cancel, and trees have up to five of them.
TEST_P(Nystroms, TheNumbersMeetTheConditionsOfTheirOrders) {
    const auto& [name, table, pair, order] = GetParam();
    constexpr double rounding = 1e4, none = 1e6;
    std::vector<double> place(table.stages()), coarse_place, coarse_velocity;
    const auto weights = table.ends_at_a_stage() ? table.row(table.stages() - 1) : table.place;
    std::copy(weights.begin(), weights.end(), place.begin());
    for (std::size_t i = 0; i < table.stages(); ++i) {
        coarse_place.push_back(place[i] - table.place_error[i]);
        coarse_velocity.push_back(table.velocity[i] - table.velocity_error[i]);
        double sum = 0, size = table.c[i] * table.c[i];
        for (std::size_t j = 0; j < i; ++j) sum += table.row(i)[j], size += std::abs(table.row(i)[j]);
        EXPECT_NEAR(sum, 0.5 * table.c[i] * table.c[i], 1e-15 * size);
    }
    const std::vector<Tree> all = trees(table, order);
    for (int weight = 0; weight <= order; ++weight) {
        const bool in = weight + 1 <= order, in_place = weight + 2 <= order;
        const bool coarse = weight + 1 <= order - 2, coarse_in_place = weight + 2 <= order - 2;
        EXPECT_EQ(defect(all, table.velocity, weight, false) < (in ? rounding : none), in) << weight;
        EXPECT_EQ(defect(all, coarse_velocity, weight, false) < (coarse ? rounding : none), coarse) << weight;
        if (weight == order) break;
        EXPECT_EQ(defect(all, place, weight, true) < (in_place ? rounding : none), in_place) << weight;
        EXPECT_EQ(defect(all, coarse_place, weight, true) < (coarse_in_place ? rounding : none), coarse_in_place)
            << weight;
    }
}

// ---- The motion -----------------------------------------------------------------------------------------------------

/// A disc that hangs from a point off its centre, with a torsion spring: places and angles in one.
World turning(const Integrator& method) {
    World world({.gravity = {0, -9.81}, .integrator = method, .solver = NoContact{}});
    const BodyId origin = world.add(Body{.kind = Kind::fixed});
    const BodyId disc = world.add(
        Body{.position = {0.9, 0.2}, .angle = 0.3, .velocity = {0, 0.5}, .angular_velocity = 2, .radius = 0.4});
    world.add(Spring{.a = origin, .b = disc, .anchor_b = {-0.25, 0.1}, .stiffness = 30, .rest_length = 0.5});
    world.add(TorsionSpring{.a = origin, .b = disc, .stiffness = 0.7, .rest_angle = 0.2});
    return world;
}

/// Six bodies in a row between a wall and a hand that moves, so many that sums are in lanes.
World pulled(const Integrator& method) {
    World world({.gravity = {0, -9.81}, .integrator = method});
    BodyId before = world.add(Body{.kind = Kind::fixed});
    for (int k = 1; k <= 7; ++k) {
        const BodyId now = world.add(
            Body{.kind = k == 7 ? Kind::driven : Kind::dynamic, .position = {0.8 * k, 0.1 * k * (7 - k)}, .mass = 0.5});
        world.add(Spring{.a = before, .b = now, .stiffness = 20.0 + k, .rest_length = 0.6});
        before = now;
    }
    world.drive(before, [](double t) { return Pose{{5.6 + 0.5 * t * t, 0.6 * t - 0.2 * t * t * t}, t}; });
    return world;
}

const std::vector<Scene> smooth = {
    {"elastic_pendulum", elastic_pendulum}, {"turning", turning}, {"pulled", pulled}, {"kepler", kepler_orbit}};

std::vector<double> truth(const Scene& scene, double duration) {
    return everything(after(scene.make(GaussRadau{}), duration, 10));
}

// A tolerance that nothing exceeds: a step a frame. Of the full state and the work of who drives, at a time that is no
// multiple of any period. Between rounding and steps where the next term counts there is room for one halving at order
// 12; the next term is then still worth 0.3 of an order. The turning disc has, at order 6, a leading term that is
// small: over four halvings it shows 7.
TEST_P(Nystroms, HaveTheirOrder) {
    constexpr double duration = 1.7;
    for (const Scene& scene : smooth) {
        const auto exact = truth(scene, duration);
        const int n = GetParam().order == 6 ? 50 : GetParam().order == 8 ? 26 : 10;
        const auto error = [&](int steps) {
            return largest_difference(everything(after(scene.make(with(1e3)), duration, steps)), exact);
        };
        const double order = std::log2(error(n) / error(2 * n));
        RecordProperty(scene.name, std::to_string(order));
        EXPECT_GT(order, GetParam().order - 0.3) << scene.name;
        EXPECT_LT(order, GetParam().order + 1) << scene.name;
    }
}

TEST_P(Nystroms, ErrorIsInProportionToTheTolerance) {
    for (const Scene& scene : smooth) {
        const auto exact = truth(scene, 1.7);
        for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
            const double error = largest_difference(everything(after(scene.make(with(tolerance)), 1.7, 1)), exact);
            EXPECT_LT(error, 20 * tolerance) << scene.name << " " << tolerance;
        }
    }
}

// Three hundred periods; what is left of the energy's error is that of so many steps at this tolerance, and it is what
// the ledger says it is.
TEST_P(Nystroms, KeepsEnergyAndKnowsWhatItLost) {
    World world = elastic_pendulum(with(1e-12));
    const double start = energy(world).total();
    run(world, 300.7, 1);
    const Energy e = energy(world);
    EXPECT_LT(std::abs(e.residual), 1e-8);
    EXPECT_NEAR(e.residual, e.total() - start, 1e-12);
}

// What the pivot and gravity gave, against a method that shares no weight with it, and of which nothing is the method's
// own doing: in a world of two rows, which books by itself, and in one of eight.
TEST_P(Nystroms, KnowsWhoGaveMomentum) {
    for (const Scene& scene : smooth) {
        const auto given = [&](const Integrator& method) {
            const MomentumBalance m = momentum_balance(after(scene.make(method), 1.7, 3));
            std::vector<double> all;
            for (const Momentum& from : {m.gravity, m.held, m.residual})
                all.insert(all.end(), {from.linear.x, from.linear.y, from.angular});
            return all;
        };
        EXPECT_LT(largest_difference(given(with(1e-11)), given(Adaptive{.tolerance = 1e-13})), 1e-9) << scene.name;
    }
}

TEST_P(Nystroms, ACopyGoesOnWithTheSameBits) {
    for (const Scene& scene : smooth) {
        World world = after(scene.make(with(1e-9)), 0.7, 13);
        World copy = world;
        World restored = scene.make(with(1e-9));
        restore_from(world, restored);
        for (World* each : {&world, &copy, &restored}) run(*each, 1, 0.3);
        EXPECT_EQ(state_hash(world), state_hash(copy)) << scene.name;
        EXPECT_EQ(everything(world), everything(copy)) << scene.name;
        EXPECT_EQ(state_hash(world), state_hash(restored)) << scene.name;
        EXPECT_EQ(everything(world), everything(restored)) << scene.name;
    }
}

// Changes from outside begin a new step.
TEST_P(Nystroms, AChangedVelocityCounts) {
    const auto play = [](const Integrator& method) {
        World world = after(elastic_pendulum(method), 0.5, 30);
        world.set_velocity(world.ids()[1], {0, 1}, 0);
        return everything(after(world, 0.5, 30));
    };
    EXPECT_LT(largest_difference(play(with(1e-10)), play(GaussRadau{})), 1e-8);
}

TEST_P(Nystroms, AFreeBodyKeepsItsVelocityToTheLastBit) {
    World world({.integrator = with(1e-9)});
    const Vec2 v = {1e6, -123456.789e-3};
    world.add(Body{.velocity = v, .angular_velocity = 0.1, .radius = 0.3});
    world.add(Body{.kind = Kind::driven, .position = {0, 5}, .velocity = {3, 0}});
    run(world, 10, 1.0 / 60);
    EXPECT_EQ(world.velocities()[0], v);
    EXPECT_EQ(world.angular_velocities()[0], 0.1);
    EXPECT_NEAR(world.positions()[0].x, 1e7, 6e-7);  // 600 roundings of 1e7
    EXPECT_NEAR(world.angles()[0], 1, 1e-13);
    EXPECT_NEAR(world.positions()[1].x, 30, 1e-12);
}

TEST_P(Nystroms, AStepThatCollapsesIsAnErrorWithItsTime) {
    // Free fall from 1 into a point mass of GM = 1: after π/√8 = 1.1107 s.
    World world({.integrator = with(1e-9)});
    world.add(Body{.kind = Kind::fixed, .mass = 1});
    world.add(Body{.position = {1, 0}, .mass = 1});
    world.add(Attraction{.strength = 1});
    EXPECT_NE(complaint(world, 2).find("'nystrom' found no step short enough at t = 1.1107"), std::string::npos)
        << complaint(world, 2);
}

TEST(Nystrom, MovesAnEmptyWorld) {
    World world({.integrator = Nystrom{}});
    world.step(1);
    EXPECT_EQ(world.time(), 1);
}

// Every field was refused as a function of velocity too. Its power is left out with that of all potentials, and what
// changes the potential works; a driven body beside it has powers looked at.
TEST_P(Nystroms, FieldsThatDoNotLookAtVelocityWereRefused) {
    for (const bool driven : {false, true}) {
        const auto play = [&](const Integrator& method) {
            World world({.gravity = {0, -1}, .integrator = method});
            const BodyId a = world.add(Body{.position = {1, 0.2}, .velocity = {0, 0.5}, .mass = 2});
            if (driven) {
                const BodyId hand = world.add(Body{.kind = Kind::driven, .position = {2, 0}});
                world.drive(hand, [](double t) { return Pose{{2, std::sin(t)}, 0}; });
                world.add(Spring{.a = a, .b = hand, .stiffness = 3});
            }
            world.add(
                ForceField{.force = [](Vec2 x, Vec2, double, double t) { return -(4 + std::sin(t)) * x; },
                           .potential = [](Vec2 x, double, double t) { return 0.5 * (4 + std::sin(t)) * dot(x, x); },
                           .sees_velocity = false});
            run(world, 5, 0.25);
            return world;
        };
        const World is = play(with(1e-11)), ought = play(GaussRadau{});
        EXPECT_LT(length(is.positions()[0] - ought.positions()[0]), 1e-8);
        const Energy e = energy(is), exact = energy(ought);
        EXPECT_NEAR(e.work.user, exact.work.user, 1e-7);
        EXPECT_GT(std::abs(exact.work.user), 0.1);
        EXPECT_NEAR(e.work.driven, exact.work.driven, 1e-7);
        EXPECT_NEAR(e.field, exact.field, 1e-7);
        EXPECT_LT(std::abs(e.residual), 1e-7);
        EXPECT_LT(std::abs(e.unaccounted()), 1e-12);
    }
}

// ---- What it refuses ------------------------------------------------------------------------------------------------

TEST(Nystrom, RefusesForcesThatDependOnVelocity) {
    const auto says = [](auto force) {
        World world({.integrator = Nystrom{}});
        const BodyId a = world.add(Body{}), b = world.add(Body{.position = {1, 0}, .radius = 0.1});
        if constexpr (requires { force.b; }) force.a = a, force.b = b;
        if constexpr (std::is_same_v<decltype(force), ConstantForce>) force.body = b;
        world.add(force);
        return error_of([&] { world.step(0.1); });
    };
    const auto sentence = [](const std::string& what) {
        return "the integrator 'nystrom' needs forces that depend on places and time alone: " + what +
               "; use 'adaptive' or 'gauss-radau'";
    };
    EXPECT_EQ(says(Spring{.damping = 0.5}), sentence("Spring 1 has a damping of 0.5"));
    EXPECT_EQ(says(TorsionSpring{.damping = 2}), sentence("TorsionSpring 1 has a damping of 2"));
    EXPECT_EQ(says(SoftDiscs{.damping = 3}), sentence("SoftDiscs 1 has a damping of 3"));
    EXPECT_EQ(says(Drag{.linear = 1}), sentence("Drag 1 depends on velocity"));
    EXPECT_EQ(says(ConstantForce{.torque = 1}), sentence("the work of ConstantForce 1, which has a torque, does not"));
    EXPECT_EQ(says(ForceField{.name = "magnet", .force = [](Vec2, Vec2 v, double, double) { return v; }}),
              sentence("ForceField 'magnet' depends on velocity"));
    EXPECT_EQ(says(ForceField{.force = [](Vec2, Vec2 v, double, double) { return v; }}),
              sentence("ForceField 1 depends on velocity"));
    EXPECT_EQ(says(ForceField{.force = [](Vec2 x, Vec2, double, double) { return x; }, .sees_velocity = false}),
              sentence("the work of ForceField 1, which has no potential, does not"));
    EXPECT_EQ(says(UserForce{.name = "hand", .add = [](const Snapshot&, std::span<Vec2>, std::span<double>) {}}),
              sentence("UserForce 'hand' is a function of velocity too"));
    EXPECT_EQ(says(UserForce{.add = [](const Snapshot&, std::span<Vec2>, std::span<double>) {}}),
              sentence("UserForce 1 is a function of velocity too"));
    EXPECT_EQ(says(Spring{}), "no error");
    EXPECT_EQ(says(ConstantForce{.force = {1, 0}}), "no error");
}

}  // namespace
}  // namespace carom::test
