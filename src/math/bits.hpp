#pragma once
// Doubles as bits. emscripten's libc++ 13 has no std::bit_cast.

#include <cstdint>
#include <limits>

namespace carom {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr std::uint64_t to_bits(double x) { return __builtin_bit_cast(std::uint64_t, x); }
constexpr double from_bits(std::uint64_t bits) { return __builtin_bit_cast(double, bits); }

/// 2^exponent for -1022 <= exponent <= 1023.
constexpr double power_of_two(int exponent) { return from_bits(static_cast<std::uint64_t>(exponent + 1023) << 52); }

/// floor(log2 |x|) of a normal number, -1023 for zero and the subnormals, 1024 for infinity and NaN.
constexpr int exponent_of(double x) { return static_cast<int>(to_bits(x) >> 52 & 0x7ff) - 1023; }

/// A hash of all words so far, with one more.
constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15;
    return hash ^ hash >> 29;
}

}  // namespace carom
