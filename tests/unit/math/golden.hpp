#pragma once
// The bits of the elementary functions as one hash a function, over a million arguments: every other one any 64 bits at
// all (subnormal, infinite, NaN), the rest from the range where the function is used.

#include <cstdint>

#include "carom/random.hpp"
#include "math/bits.hpp"
#include "math/elementary.hpp"

namespace carom::golden {

/// FNV-1a over the bytes of doubles, lowest byte first.
class Hash {
  public:
    void add(double x) {
        std::uint64_t word = to_bits(x);
        for (int k = 0; k < 8; ++k, word >>= 8) value_ = (value_ ^ (word & 0xff)) * 0x100000001b3;
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325;
};

inline double argument(Random& random, int k, double low, double high) {
    return k % 2 ? from_bits(random.bits()) : random.uniform(low, high);
}

inline std::uint64_t hash(double (*function)(double), double low, double high) {
    Random random(20240229);
    Hash hash;
    for (int k = 0; k < 1'000'000; ++k) hash.add(function(argument(random, k, low, high)));
    return hash.value();
}

inline std::uint64_t hash(double (*function)(double, double), double low, double high) {
    Random random(20240229);
    Hash hash;
    for (int k = 0; k < 1'000'000; ++k) {
        const double x = argument(random, k, low, high);
        hash.add(function(x, argument(random, k / 2, low, high)));
    }
    return hash.value();
}

inline double sin_and_cos(double x) {
    const portable::SinCos both = portable::sincos(x);
    return both.sin + 2 * both.cos;
}

struct Row {
    const char* name;
    std::uint64_t found, wanted;
};

/// Calls visit(Row) for each function.
template <class Visit>
void each(Visit visit) {
    namespace p = portable;
    visit(Row{"sin", hash(p::sin, -10, 10), 0x4993b2c9961a01bd});
    visit(Row{"cos", hash(p::cos, -10, 10), 0x0334d4ce52f39344});
    visit(Row{"sincos", hash(sin_and_cos, -1000, 1000), 0x01c1841d54ea96a4});
    visit(Row{"tan", hash(p::tan, -10, 10), 0x780138b5685e0246});
    visit(Row{"asin", hash(p::asin, -1, 1), 0x48489db947229700});
    visit(Row{"acos", hash(p::acos, -1, 1), 0x08a4a308f46afe73});
    visit(Row{"atan", hash(p::atan, -5, 5), 0xaa966021aecaffb9});
    visit(Row{"atan2", hash(p::atan2, -5, 5), 0xdc180c6a9b90e0a0});
    visit(Row{"exp", hash(p::exp, -20, 20), 0xd9fdf853e0ac7f37});
    visit(Row{"log", hash(p::log, 0, 10), 0x06c96030a9b417ce});
    visit(Row{"pow", hash(p::pow, 0, 10), 0xfe496c645fbb5a89});
    visit(Row{"sinh", hash(p::sinh, -5, 5), 0x1403dffd7491e95a});
    visit(Row{"cosh", hash(p::cosh, -5, 5), 0xcc107030b7ffe3df});
    visit(Row{"tanh", hash(p::tanh, -5, 5), 0x224f1d2d1328decd});
    visit(Row{"hypot", hash(p::hypot, -5, 5), 0x0797722e2a8633c6});
}

}  // namespace carom::golden
