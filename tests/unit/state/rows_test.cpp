// The passes over all bodies against plain loops: to the last bit, for every instruction set and any number of rows.

#include "state/rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/random.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "simd/isa.hpp"

namespace carom {
namespace {

std::vector<const RowsKernel*> kernels() {
    std::vector<const RowsKernel*> all{&baseline_rows_kernel};
#if defined(__x86_64__)
    for (const Isa isa : available_isas()) {
        if (isa == Isa::avx2) all.push_back(&avx2_rows_kernel);
        if (isa == Isa::avx512) all.push_back(&avx512_rows_kernel);
    }
#endif
    return all;
}

std::vector<double> some_numbers(std::size_t count, Random& random) {
    std::vector<double> out(count);
    for (double& x : out) x = random.uniform(-2, 2);
    return out;
}

TEST(Rows, CombineIsTheSumInOrderAndThenTheStart) {
    Random random(5);
    for (const RowsKernel* kernel : kernels())
        for (std::size_t n = 0; n < 80; ++n) {
            std::vector<std::vector<double>> in;
            std::vector<Term> terms;
            for (int j = 0; j < 5; ++j) in.push_back(some_numbers(n, random));
            for (const auto& numbers : in) terms.push_back({random.uniform(-1, 1), numbers.data()});
            const std::vector<double> start = some_numbers(n, random);
            for (const double* from : {start.data(), static_cast<const double*>(nullptr)}) {
                std::vector<double> out(n + 1, 7);
                kernel->combine(terms.data(), terms.size(), from, out.data(), n);
                for (std::size_t k = 0; k < n; ++k) {
                    double sum = 0;
                    for (const Term& t : terms) sum += t.weight * t.in[k];
                    EXPECT_EQ(out[k], from ? from[k] + sum : sum) << n << " " << k;
                }
                EXPECT_EQ(out[n], 7);  // no more than was asked for
            }
        }
}

// Every third row is held. The sums of rows in the same place of a chunk come first, and these are added in order.
TEST(Rows, AccelerateSumsAlikeForAnyNumberOfRows) {
    Random random(6);
    for (const RowsKernel* kernel : kernels())
        for (std::size_t n = 1; n < 40; ++n) {
            std::vector<double> x = some_numbers(2 * n, random), v = some_numbers(2 * n, random);
            std::vector<double> force = some_numbers(2 * n, random), mass(n, 2), inverse(n, 0.5);
            for (std::size_t i = 0; i < n; i += 3) mass[i] = inverse[i] = 0;
            double power[8] = {}, held[8] = {};
            std::vector<double> acceleration(2 * n);
            for (std::size_t i = 0; i < n; ++i) {
                const double fx = force[2 * i], fy = force[2 * i + 1];
                const bool free = inverse[i] != 0;
                const double ax = acceleration[2 * i] = free ? 0.1 + 0.5 * fx : 0;
                const double ay = acceleration[2 * i + 1] = free ? -9 + 0.5 * fy : 0;
                power[i % 8] += mass[i] * ax * v[2 * i] + mass[i] * ay * v[2 * i + 1];
                held[i % 8] += free ? 0 : x[2 * i] * fy - x[2 * i + 1] * fx;
            }
            double all_power = 0, all_held = 0;
            for (int place = 0; place < 8; ++place) all_power += power[place], all_held += held[place];
            const AccelerationSums sum =
                kernel->accelerate({x.data(), v.data(), mass.data(), inverse.data(), n}, 0.1, -9, force.data(), 0, n);
            EXPECT_EQ(force, acceleration) << n;
            EXPECT_EQ(sum.power, all_power) << n;
            EXPECT_EQ(sum.held_torque, all_held) << n;
        }
}

TEST(Rows, SayWhereTheNumbersEnd) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Random random(7);
    for (const RowsKernel* kernel : kernels())
        for (std::size_t n = 1; n < 20; ++n)
            for (const double odd : {0.0, infinity, -infinity, std::nan("")})
                for (std::size_t k = 0; k < 2 * n; ++k) {
                    std::vector<double> x = some_numbers(2 * n, random), v = some_numbers(2 * n, random);
                    const std::vector<double> mass(n, 2), a(2 * n, 0.5), x0 = x;
                    v[k] = odd;
                    EXPECT_EQ(kernel->finite(v.data(), 2 * n), odd == 0) << n << " " << k;
                    EXPECT_EQ(
                        kernel->kick({x.data(), v.data(), mass.data(), mass.data(), n}, 0.1, a.data(), v.data(), 0, n)
                            .finite,
                        odd == 0)
                        << n << " " << k;
                    EXPECT_EQ(kernel->drift(0.1, v.data(), x.data(), 2 * n), odd == 0) << n << " " << k;
                    for (std::size_t j = 0; j < 2 * n; ++j)
                        EXPECT_TRUE(j == k || x[j] == x0[j] + 0.1 * v[j]) << n << " " << j;
                }
}

TEST(Rows, CompareErrorsWithSizes) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Random random(8);
    for (const RowsKernel* kernel : kernels())
        for (std::size_t n = 1; n < 40; ++n)
            for (const double odd : {0.0, infinity, -infinity, std::nan("")})
                for (std::size_t k = 0; k < n; ++k) {
                    std::vector<double> e = some_numbers(n, random);
                    const std::vector<double> a = some_numbers(n, random), b = some_numbers(n, random);
                    e[k] = odd;
                    double most = odd == 0 ? 0 : infinity;
                    for (std::size_t j = 0; j < n; ++j)
                        most =
                            std::max(most, std::abs(e[j]) / (0.01 * std::max({1.0, std::abs(a[j]), std::abs(b[j])})));
                    EXPECT_EQ(kernel->largest(e.data(), a.data(), b.data(), 0.01, n), most) << n << " " << k;
                }
}

TEST(Rows, KnowZeros) {
    for (const RowsKernel* kernel : kernels())
        for (std::size_t n = 1; n < 20; ++n) {
            std::vector<double> number(n + 1);
            number[n] = 1;  // not asked for
            number[0] = -0.0;
            EXPECT_TRUE(kernel->zero(number.data(), n));
            number[n - 1] = 5e-324;
            EXPECT_FALSE(kernel->zero(number.data(), n));
        }
}

}  // namespace
}  // namespace carom
