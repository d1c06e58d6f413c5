// Springs between centres: the network's kernels against the plain formulas, on networks of every shape.
#include "forces/network.hpp"

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "simd/isa.hpp"
#include "unit/forces/random_system.hpp"

using namespace carom;

namespace {

struct Net {
    std::vector<Link> links;
    State state;

    SpringNetwork network() const { return {links, state.size()}; }
    std::vector<Vec2> forces(NetworkPowers* powers = nullptr) const {
        std::vector<Vec2> out(state.size(), Vec2{7, 7});  // to be overwritten
        const NetworkPowers p = network().write_forces(state, 0, state.size(), out);
        if (powers) *powers = p;
        return out;
    }
};

State random_state(Random& random, std::size_t size) {
    State state;
    state.resize(size);
    for (Vec2& x : state.x.linear) x = test::vector(random, 2);
    for (Vec2& v : state.v.linear) v = test::vector(random, 1);
    return state;
}

/// Some lattice-like springs to the next rows, some to anywhere, so that columns of all kinds arise.
Net random_net(std::uint64_t seed) {
    Random random(seed);
    const auto size = 2 + static_cast<std::size_t>(random.uniform(0, 60));
    Net net{{}, random_state(random, size)};
    const bool same = seed % 3 == 0, damped = seed % 2 == 0;
    const auto tie = [&](std::size_t a, std::size_t b) {
        net.links.push_back({static_cast<Row>(a), static_cast<Row>(b), same ? 3 : random.uniform(1, 5),
                             same ? 0.7 : random.uniform(0, 2), damped && random.uniform(0, 1) < 0.5 ? 0.4 : 0});
    };
    for (const std::size_t step : {1u, 2u, 9u})
        for (std::size_t i = 0; i + step < size; ++i)
            if (seed % 4 != 1 || random.uniform(0, 1) < 0.9) tie(i + step, i);
    for (std::size_t k = 0; k < size; ++k) {
        const auto a = static_cast<std::size_t>(random.uniform(0, double(size)));
        const auto b = static_cast<std::size_t>(random.uniform(0, double(size)));
        if (a != b) tie(a, b);
    }
    return net;
}

struct Plain {
    std::vector<std::array<long double, 2>> force;
    std::vector<long double> scale;  ///< Σ |F| at each body
    long double elastic = 0, damping = 0, energy = 0;
};

/// F = k (|d| − L) n + c (Δv·n) n on a, spring by spring, in extended precision.
Plain plain(const Net& net) {
    Plain out{std::vector<std::array<long double, 2>>(net.state.size()), std::vector<long double>(net.state.size())};
    for (const Link& l : net.links) {
        const Vec2 xa = net.state.x.linear[l.a], xb = net.state.x.linear[l.b];
        const Vec2 va = net.state.v.linear[l.a], vb = net.state.v.linear[l.b];
        const long double dx = (long double)xb.x - xa.x, dy = (long double)xb.y - xa.y,
                          d = std::sqrt(dx * dx + dy * dy);
        const long double ux = (long double)vb.x - va.x, uy = (long double)vb.y - va.y;
        const long double rate = (ux * dx + uy * dy) / d, pull = l.stiffness * (d - l.rest_length),
                          drag = l.damping * rate;
        out.force[l.a][0] += (pull + drag) * dx / d, out.force[l.a][1] += (pull + drag) * dy / d;
        out.force[l.b][0] -= (pull + drag) * dx / d, out.force[l.b][1] -= (pull + drag) * dy / d;
        for (const Row i : {l.a, l.b}) out.scale[i] += l.stiffness * (d + l.rest_length) + std::abs(drag);
        out.elastic -= pull * rate;
        out.damping += drag * rate;
        out.energy += 0.5L * l.stiffness * (d - l.rest_length) * (d - l.rest_length);
    }
    return out;
}

constexpr double eps = 2.3e-16;

class Network : public testing::Test {
  protected:
    ~Network() override { use_isa({}); }
};

}  // namespace

TEST_F(Network, HasThePlainFormulasForcesPowersAndEnergy) {
    for (int seed = 0; seed < 200; ++seed) {
        const Net net = random_net(seed);
        const Plain truth = plain(net);
        NetworkPowers powers;
        const std::vector<Vec2> force = net.forces(&powers);
        long double scale = 0;
        for (std::size_t i = 0; i < force.size(); ++i) {
            EXPECT_NEAR(force[i].x, (double)truth.force[i][0], 8 * eps * (double)truth.scale[i]) << seed;
            EXPECT_NEAR(force[i].y, (double)truth.force[i][1], 8 * eps * (double)truth.scale[i]) << seed;
            scale += truth.scale[i];
        }
        const double tolerance = 20 * eps * (double)scale;  // speeds and lengths are near 1
        EXPECT_NEAR(powers.elastic, (double)truth.elastic, tolerance) << seed;
        EXPECT_NEAR(powers.damping, (double)truth.damping, tolerance) << seed;
        EXPECT_NEAR(net.network().potential(net.state, 0, force.size()), (double)truth.energy, tolerance) << seed;
    }
}

TEST_F(Network, HasTheSameBitsOnEveryInstructionSet) {
    for (int seed = 0; seed < 100; ++seed) {
        const Net net = random_net(seed);
        const std::vector<double> inverse_mass(net.state.size(), 1);
        std::vector<std::vector<double>> results;
        for (const Isa which : available_isas()) {
            use_isa(which);
            NetworkPowers powers;
            std::vector<double>& all = results.emplace_back();
            for (const Vec2 f : net.forces(&powers)) all.insert(all.end(), {f.x, f.y});
            std::vector<NodeStiffness> node(net.state.size());
            net.network().write_stiffness(net.state, 0, node.size(), inverse_mass, node);
            for (const NodeStiffness& n : node) all.insert(all.end(), {n.xx, n.xy, n.yy, n.damping});
            const double energy = net.network().potential(net.state, 0, net.state.size());
            all.insert(all.end(), {powers.elastic, powers.damping, energy});
        }
        for (const auto& other : results) EXPECT_EQ(other, results[0]) << seed;
    }
}

TEST_F(Network, IsMinusTheGradientOfItsPotential) {
    for (int seed = 1; seed < 20; seed += 2) {  // those without damping
        Net net = random_net(seed);
        const std::vector<Vec2> force = net.forces();
        const SpringNetwork network = net.network();
        for (std::size_t i = 0; i < force.size(); ++i) {
            const auto slope = [&](double& x, double h) {
                const double x0 = x;
                x = x0 + h;
                const double after = network.potential(net.state, 0, force.size());
                x = x0 - h;
                const double before = network.potential(net.state, 0, force.size());
                x = x0;
                return (after - before) / (2 * h);
            };
            const auto fine = [&](double& x) { return (4 * slope(x, 0.5e-3) - slope(x, 1e-3)) / 3; };
            EXPECT_NEAR(force[i].x, -fine(net.state.x.linear[i].x), 1e-6) << seed;
            EXPECT_NEAR(force[i].y, -fine(net.state.x.linear[i].y), 1e-6) << seed;
        }
    }
}

TEST_F(Network, PullsBothEndsAlikeToTheLastBit) {
    Random random(3);
    for (int k = 0; k < 1000; ++k) {
        Net net{{{0, 1, random.uniform(1, 9), random.uniform(0, 2), random.uniform(0, 1)}}, random_state(random, 2)};
        const std::vector<Vec2> force = net.forces();
        EXPECT_EQ(force[0], -force[1]);
    }
}

TEST_F(Network, PullsBothEndsAlikeWhateverColumnsTheyLieIn) {
    // Every spring alone between two bodies, its ends in columns of several kinds: spring 15 in one of neighbours and,
    // with the damped ones, in another that damps; spring 0 with a body that has none.
    Random random(6);
    for (const Isa which : available_isas()) {
        use_isa(which);
        Net net{{}, random_state(random, 65)};
        for (Row i = 0; i < 32; ++i)
            net.links.push_back({i, i + 33, random.uniform(1, 9), random.uniform(0, 2), i > 15 && i < 19 ? 0.4 : 0});
        const std::vector<Vec2> force = net.forces();
        for (std::size_t i = 0; i < 32; ++i) EXPECT_EQ(force[i], -force[i + 33]) << i;
    }
}

TEST_F(Network, KeepsPullsForHigherRowsToTheSameBits) {
    // Lattices of sides, diagonals and double steps: pulls kept in a pass, from its first row on, beside none kept.
    enum Kind { alike, mixed, own_and_damped };
    Random random(8);
    for (const Row wide : {16u, 21u, 43u})
        for (const auto kind : {alike, mixed, own_and_damped}) {
            Net net{{}, random_state(random, 20 * wide)};
            for (const Row far : {1u, 2u, wide - 1, wide, wide + 1, 2 * wide}) {
                const bool own = kind == own_and_damped || (kind == mixed && far % 2 == 1);
                for (Row i = 0; i + far < 20 * wide; ++i)
                    if (far > 2 || i % wide + far < wide)
                        net.links.push_back({i, i + far, own ? random.uniform(1, 5) : 3, own ? random.uniform(0, 2) : 1,
                                             kind == own_and_damped && i % 97 == 0 ? 0.4 : 0});
            }
            const SpringNetwork network = net.network();
            const Plain truth = plain(net);
            for (const Isa which : available_isas())
                for (const std::size_t first : {std::size_t{0}, std::size_t{5 * wide / 8 * 8}}) {
                    use_isa(which);
                    const std::vector<Vec2> whole = net.forces();
                    SpringNetwork::Pass pass(network, first);
                    for (std::size_t row = first; row < whole.size(); row += 64) {
                        const std::size_t end = std::min(row + 64, whole.size());
                        std::vector<Vec2> force(end - row);
                        network.write_forces(net.state, row, end, force, &pass);
                        for (std::size_t i = row; i < end; ++i) {
                            EXPECT_EQ(force[i - row], whole[i]) << i;
                            EXPECT_NEAR(whole[i].x, (double)truth.force[i][0], 8 * eps * (double)truth.scale[i]);
                        }
                    }
                }
        }
}

TEST_F(Network, IsStillAtItsRestLengthToTheLastBit) {
    // The root of a square is the number itself where both are rounded as IEEE says; of an estimate of 1/√ it is not.
    Random random(7);
    for (const Row size : {2u, 40u}) {
        Net net;
        net.state.resize(size);
        for (int k = 0; k < 200; ++k) {
            const double length = random.uniform(0.1, 10);
            net.links.clear();
            for (Row i = 0; i < size; i += 2) net.links.push_back({i, i + 1, 100, length, 0.3});
            for (Row i = 0; i < size; ++i) net.state.x.linear[i] = {i % 2 * length, 3.0 * i};
            for (Row i = 1; i < size; i += 2) net.state.x.linear[i].y = net.state.x.linear[i - 1].y;
            for (const Vec2 f : net.forces()) EXPECT_EQ(f, Vec2{}) << length;
        }
    }
}

TEST_F(Network, AddsParallelSprings) {
    Random random(4);
    Net one{{{0, 1, 2, 0.5, 0}}, random_state(random, 2)}, three = one;
    three.links.assign(3, one.links[0]);
    EXPECT_NEAR(three.forces()[0].x, 3 * one.forces()[0].x, 1e-15);
}

TEST_F(Network, PushesBodiesAtOnePlaceApartAlongX) {
    // The direction is arbitrary, but it must be one and its opposite.
    for (const std::size_t far : {1u, 20u}) {
        Net net{{{static_cast<Row>(far), 0, 5, 0.4, 0.3}}, {}};
        net.state.resize(21);
        net.state.v.linear[0] = {1, 2};
        const std::vector<Vec2> force = net.forces();
        EXPECT_EQ(force[0], (Vec2{-5 * 0.4 - 0.3, 0}));
        EXPECT_EQ(force[far], -force[0]);
    }
    // And along columns of neighbours: each is pushed by the one before it as much as by the one behind.
    Net row;
    row.state.resize(40);
    for (Row i = 0; i + 1 < 40; ++i) row.links.push_back({i, i + 1, 5, 0.4, 0});
    const std::vector<Vec2> force = row.forces();
    EXPECT_EQ(force[0], (Vec2{-2, 0}));
    EXPECT_EQ(force[39], (Vec2{2, 0}));
    for (std::size_t i = 1; i < 39; ++i) EXPECT_EQ(force[i], Vec2{});
}

TEST_F(Network, LeavesBodiesWithoutSpringsAlone) {
    Random random(5);
    Net net{{{3, 17, 2, 0.5, 0}}, random_state(random, 19)};
    net.state.x.linear[4] = {1e300, -1e300};  // far out: not even a zero of it may be added elsewhere
    const std::vector<Vec2> force = net.forces();
    for (std::size_t i = 0; i < force.size(); ++i) EXPECT_EQ(force[i] == Vec2{}, i != 3 && i != 17) << i;
}

TEST_F(Network, GivesItsSpringsBack) {
    for (int seed = 0; seed < 20; ++seed) {
        Net net = random_net(seed);
        const auto key = [](const Link& l) {
            return std::array{double(std::min(l.a, l.b)), double(std::max(l.a, l.b)), l.stiffness, l.rest_length,
                              l.damping};
        };
        const auto sorted = [&](const std::vector<Link>& links) {
            std::vector<std::array<double, 5>> keys;
            for (const Link& l : links) keys.push_back(key(l));
            std::sort(keys.begin(), keys.end());
            return keys;
        };
        EXPECT_EQ(sorted(net.network().links()), sorted(net.links));
    }
}

TEST_F(Network, StoresALatticeInAFewBytesASpring) {
    std::vector<Link> links;
    constexpr Row n = 80;
    for (Row i = 0; i < n * n; ++i) {
        if (i % n + 1 < n) links.push_back({i, i + 1, 100, 1, 0});
        if (i / n + 1 < n) links.push_back({i, i + n, 100, 1, 0});
    }
    const double bytes = static_cast<double>(SpringNetwork(links, n * n).bytes()) / static_cast<double>(links.size());
    EXPECT_LT(bytes, 8);
    for (Link& l : links) l.stiffness += l.a;
    EXPECT_LT(static_cast<double>(SpringNetwork(links, n * n).bytes()) / static_cast<double>(links.size()), 26);
}
