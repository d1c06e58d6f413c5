#include <carom/random.hpp>
#include <cmath>

#include "math/elementary.hpp"

namespace carom {
namespace {

/// A pair of normal numbers by Marsaglia's polar method: the second is returned, the first is the spare. In numpy's
/// order, for both generators.
template <class Uniform>
double normal_pair(Uniform uniform, double& spare) {
    double x, y, square;
    do {
        x = 2 * uniform() - 1;
        y = 2 * uniform() - 1;
        square = x * x + y * y;
    } while (square >= 1 || square == 0);
    const double factor = std::sqrt(-2 * portable::log(square) / square);
    spare = factor * x;
    return factor * y;
}

constexpr std::uint64_t rotate_left(std::uint64_t x, int n) { return x << n | x >> (64 - n); }

}  // namespace

// splitmix64 (Steele, Lea, Flood 2014; Vigna's form) fills the state: never all zeros, and near seeds lie far apart.
Random::Random(std::uint64_t seed) {
    for (std::uint64_t& word : state_) {
        std::uint64_t z = seed += 0x9e3779b97f4a7c15;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
        z = (z ^ z >> 27) * 0x94d049bb133111eb;
        word = z ^ z >> 31;
    }
}

std::uint64_t Random::bits() {
    auto& [a, b, c, d] = state_;
    const std::uint64_t result = rotate_left(b * 5, 7) * 9;
    const std::uint64_t shifted = b << 17;
    c ^= a;
    d ^= b;
    b ^= c;
    a ^= d;
    c ^= shifted;
    d = rotate_left(d, 45);
    return result;
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

double Random::uniform(double low, double high) {
    const double value = low + (high - low) * uniform();
    // Rounding can reach the upper end, which is not in the range.
    return value < high || low >= high ? value : std::nextafter(high, low);
}

double Random::normal() {
    has_spare_ = !has_spare_;
    return has_spare_ ? normal_pair([this] { return uniform(); }, spare_) : spare_;
}

// init_genrand of Matsumoto and Nishimura's mt19937ar: what numpy's seed() does with an integer of 32 bits.
NumpyRandom::NumpyRandom(std::uint32_t seed) {
    state_[0] = seed;
    for (std::uint32_t i = 1; i < 624; ++i) state_[i] = 1812433253u * (state_[i - 1] ^ state_[i - 1] >> 30) + i;
}

std::uint32_t NumpyRandom::word() {
    if (next_ == 624) {
        for (int i = 0; i < 624; ++i) {
            const std::uint32_t joined = (state_[i] & 0x80000000u) | (state_[(i + 1) % 624] & 0x7fffffffu);
            state_[i] = state_[(i + 397) % 624] ^ joined >> 1 ^ (joined & 1 ? 0x9908b0dfu : 0);
        }
        next_ = 0;
    }
    std::uint32_t y = state_[next_++];
    y ^= y >> 11;
    y ^= y << 7 & 0x9d2c5680u;
    y ^= y << 15 & 0xefc60000u;
    return y ^ y >> 18;
}

double NumpyRandom::uniform() {
    const std::uint32_t high = word() >> 5, low = word() >> 6;
    return (high * 67108864.0 + low) / 9007199254740992.0;
}

double NumpyRandom::uniform(double low, double high) { return low + (high - low) * uniform(); }

// numpy calls the machine's log, which is not the same on all machines. portable::log came out correctly rounded in
// each of 1e6 tries; glibc 2.36 (with FMA) misses that in 8 of 10,000. So some 4 in 10,000 pairs of normals are one
// or two units in the last place off those of numpy on such a machine. Uniform numbers never are, and the streams stay
// in step.
double NumpyRandom::normal() {
    has_spare_ = !has_spare_;
    return has_spare_ ? normal_pair([this] { return uniform(); }, spare_) : spare_;
}

}  // namespace carom
