#include "carom/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "golden.hpp"

namespace {

using carom::NumpyRandom;
using carom::Random;
using carom::golden::Hash;

TEST(Random, GivesTheStreamOfItsAuthors) {
    // splitmix64 from 42, then xoshiro256**, by a separate program in Python's integers.
    Random random(42);
    for (std::uint64_t wanted : {0x15780b2e0c2ec716, 0x6104d9866d113a7e}) EXPECT_EQ(random.bits(), wanted);
    EXPECT_EQ(random.bits(), 0xae17533239e499a1);
    EXPECT_EQ(random.bits(), 0xecb8ad4703b360a1);
    EXPECT_EQ(Random(42).uniform(), static_cast<double>(0x15780b2e0c2ec716 >> 11) / 9007199254740992.0);
}

TEST(Random, UniformNumbersFillTheirRangeEvenly) {
    Random random(1);
    constexpr int n = 1'000'000, bins = 64;
    std::array<int, bins> count{};
    double sum = 0, squares = 0, lag = 0, last = 0;
    for (int k = 0; k < n; ++k) {
        const double u = random.uniform();
        ASSERT_TRUE(u >= 0 && u < 1);
        ++count[static_cast<int>(u * bins)];
        sum += u, squares += u * u, lag += (u - 0.5) * (last - 0.5), last = u;
    }
    EXPECT_NEAR(sum / n, 0.5, 4 * std::sqrt(1 / 12. / n));  // four standard deviations
    EXPECT_NEAR(squares / n, 1 / 3., 4 * std::sqrt(4 / 45. / n));
    EXPECT_NEAR(lag / n, 0, 4 / 12. / std::sqrt(n));
    double chi_square = 0;
    for (int c : count) chi_square += std::pow(c - n / double{bins}, 2) / (n / double{bins});
    EXPECT_NEAR(chi_square, bins - 1, 4 * std::sqrt(2. * (bins - 1)));
}

TEST(Random, UniformRangeExcludesItsUpperEnd) {
    Random random(2);
    double least = 5, most = -3;
    for (int k = 0; k < 100'000; ++k) {
        const double u = random.uniform(-3, 5);
        ASSERT_TRUE(u >= -3 && u < 5);
        least = std::min(least, u), most = std::max(most, u);
    }
    EXPECT_LT(least, -2.999);
    EXPECT_GT(most, 4.999);
    // Two neighbours: rounding would give the upper one half of the time.
    const double above = std::nextafter(1.0, 2.0);
    for (int k = 0; k < 100; ++k) ASSERT_EQ(random.uniform(1, above), 1);
    EXPECT_EQ(random.uniform(7, 7), 7);
}

/// Mean, variance, skewness, kurtosis of n normal numbers, each within four standard deviations of its estimate.
template <class Generator>
void expect_normal(Generator random) {
    constexpr int n = 1'000'000;
    std::array<double, 5> moment{};
    double pairs = 0, last = 0;
    int beyond_two = 0;
    for (int k = 0; k < n; ++k) {
        const double x = random.normal();
        for (int p = 1; p <= 4; ++p) moment[p] += std::pow(x, p) / n;
        beyond_two += std::fabs(x) > 2;
        pairs += x * last / n, last = x;
    }
    const double unit = 4 / std::sqrt(n);
    EXPECT_NEAR(moment[1], 0, unit);
    EXPECT_NEAR(moment[2], 1, unit * std::sqrt(2));
    EXPECT_NEAR(moment[3], 0, unit * std::sqrt(15));
    EXPECT_NEAR(moment[4], 3, unit * std::sqrt(96));
    EXPECT_NEAR(pairs, 0, unit);
    EXPECT_NEAR(beyond_two / double{n}, std::erfc(std::sqrt(2)), unit * 0.21);
}

TEST(Random, NormalNumbersHaveTheMomentsOfTheNormalDistribution) { expect_normal(Random(3)); }
TEST(NumpyRandom, NormalNumbersHaveTheMomentsOfTheNormalDistribution) { expect_normal(NumpyRandom(3)); }

TEST(Random, GivesTheSameNormalNumbersEverywhere) {
    Random random(1);
    Hash hash;
    for (int k = 0; k < 1'000'000; ++k) hash.add(random.normal());
    EXPECT_EQ(hash.value(), 0xb1d8b009d0340bc5);
}

struct Disc {
    double x, y, vx, vy, radius;
};

// The gas of the textbook (shared/reference/textbook.json): 15 discs, numpy seeded with 99.
const Disc discs[] = {
    {0x1.a33b81d405d9ep+3, 0x1.d614cb5e85c91p+2, 0x1.b317209f82e92p-1, 0x1.fea5d632a9509p+1, 0x1.09c0ca5b96fccp-1},
    {0x1.d72c8367edeb7p+0, 0x1.bc19db04476aap+3, -0x1.07b876bc3c1cap+1, 0x1.097d87579d43fp+2, 0x1.32005ba238abcp-1},
    {0x1.1b8981ce30059p+4, 0x1.89048c3d7e252p+2, 0x1.20c4f302f883fp-4, 0x1.5e5cd2376c51ap+0, 0x1.bff1a4f04e557p-2},
    {0x1.f477348f897c4p+3, 0x1.e03f2f0529323p+1, -0x1.558c40593e076p+2, 0x1.656afe3c7d028p+0, 0x1.73f22a20d1f7cp-1},
    {0x1.fcf3d83a7f33ap+3, 0x1.f0b46a453aa72p+1, -0x1.18f0cdcb60364p+1, 0x1.920e6f7cd767ap-1, 0x1.211bcf4309644p-1},
    {0x1.5f2d74b32cc3ap+1, 0x1.6fa261a0b9228p+1, -0x1.700d5263e10fep-2, -0x1.1b9acccd54af2p+2, 0x1.b9640029766fcp-2},
    {0x1.4ec53b507e011p+2, 0x1.15cef2d6ae3bep+0, 0x1.74b80bb7e1a5dp-2, 0x1.6390dcae88bf2p+1, 0x1.de3a2324240dbp-2},
    {0x1.1b8454a997a31p+4, 0x1.01822bec3a8a0p+3, 0x1.861744b10e592p-4, -0x1.c11a1da68e757p+0, 0x1.4fe6b489d474ap-1},
    {0x1.ed2dd9a54ec49p+3, 0x1.7b53849d97381p+3, -0x1.4739586922ebfp+2, -0x1.76a48de132a8fp-1, 0x1.3d500d1aeb298p-1},
    {0x1.f2b0430986cfap+2, 0x1.d301043f10436p+1, -0x1.6ebdec30ed1f2p-1, 0x1.cc6460a6cf4f5p+1, 0x1.5f75be23cc6c2p-1},
    {0x1.052fe3c647750p+4, 0x1.03889f89c0417p+1, 0x1.52967772feb49p+2, -0x1.aeb2892f1c023p+1, 0x1.94c6f898d88cdp-1},
    {0x1.b63f0013bbb25p+3, 0x1.28d57e94d2b34p+3, -0x1.f9f49e5f88f6cp+0, -0x1.682a20c9d35d5p+1, 0x1.db23df5197e5fp-2},
    {0x1.9e218c8ae2d80p+2, 0x1.4ae60e300f0eep+3, -0x1.b15c5159bcad0p-1, -0x1.6814f55754d84p-2, 0x1.7ff3fcf876bdcp-1},
    {0x1.af9ac3cba5485p+3, 0x1.77d92d339d6ccp+3, 0x1.de92757776cd2p+2, -0x1.36010bd3de707p+2, 0x1.3687520ae9e67p-1},
    {0x1.bef5e43260571p+3, 0x1.762ba36592ad1p+3, -0x1.207e42f31ca4cp+0, -0x1.833b71a30f50bp-1, 0x1.4a85cb3f755c4p-1},
};

TEST(NumpyRandom, ThrowsTheDiscsOfTheTextbook) {
    NumpyRandom random(99);
    for (const Disc& disc : discs) {
        EXPECT_EQ(random.uniform(1, 19), disc.x);
        EXPECT_EQ(random.uniform(1, 14), disc.y);
        EXPECT_EQ(3 * random.normal(), disc.vx);
        EXPECT_EQ(3 * random.normal(), disc.vy);
        EXPECT_EQ(random.uniform(0.4, 0.8), disc.radius);
    }
}

// From numpy 1.24.2: r = RandomState(seed); r.random_sample(), or r.randn() from the start; then hashes over 100,000 of
// them. Those of the normals are over multiples of 2^-32, for glibc's log is not always the correctly rounded one.
struct Stream {
    std::uint32_t seed;
    std::array<double, 4> uniform, normal;
    std::uint64_t uniform_hash, normal_hash;
};

const Stream streams[] = {
    {0,
     {0x1.18fe1565f12a8p-1, 0x1.6e2d4cf608733p-1, 0x1.349d66b6e894bp-1, 0x1.16faedb6395f5p-1},
     {0x1.c398ef3e5cfa5p+0, 0x1.99c2cfacc8953p-2, 0x1.f51d25222c9abp-1, 0x1.1ed5969e3314ep+1},
     0x8c0363452a1238f2,
     0xa67ad62d871b71cb},
    {1,
     {0x1.ab07d0ffa3c06p-2, 0x1.70ce5f3baf051p-1, 0x1.dfb906661c000p-14, 0x1.3596ab7fe08f4p-2},
     {0x1.9fd5190657c50p+0, -0x1.393822fb7d9adp-1, -0x1.0e6c872548fd2p-1, -0x1.12ae1255cb80cp+0},
     0xaf7b7c2ad335ccd9,
     0xc20fb73664dcb29b},
    {99,
     {0x1.5834e52e3e170p-1, 0x1.f3cad2ea7d464p-2, 0x1.a6a74daefae1bp-1, 0x1.019bdacdd5510p-5},
     {-0x1.238d086d9c366p-3, 0x1.07530ab9c4334p+1, 0x1.220f6b1501f0cp-2, 0x1.546e8ecc70e06p+0},
     0x967f331effa47a41,
     0x5bdc131bf1899752},
    {4294967295,
     {0x1.8fe69a3924820p-4, 0x1.d323d824032b1p-1, 0x1.93fc6f61af3f9p-1, 0x1.8f5ca1b151c07p-1},
     {0x1.4bfc38c486d8ap-1, 0x1.56b192e507eeep-1, -0x1.149e836f192fdp+0, 0x1.23543dec5a0fcp-2},
     0xe15a6020047799ff,
     0xf3e2ab62526488af},
};

TEST(NumpyRandom, GivesTheStreamsOfNumpy) {
    for (const Stream& stream : streams) {
        SCOPED_TRACE(stream.seed);
        NumpyRandom uniform(stream.seed), normal(stream.seed), both(stream.seed);
        for (double wanted : stream.uniform) EXPECT_EQ(uniform.uniform(), wanted);
        for (double wanted : stream.normal) EXPECT_EQ(normal.normal(), wanted);
        uniform = normal = NumpyRandom(stream.seed);
        Hash uniforms, normals;
        for (int k = 0; k < 100'000; ++k) {
            uniforms.add(uniform.uniform());
            normals.add(std::nearbyint(normal.normal() * 0x1p32));
        }
        EXPECT_EQ(uniforms.value(), stream.uniform_hash);
        EXPECT_EQ(normals.value(), stream.normal_hash);
    }
}

}  // namespace
