#pragma once
// What random worlds are made of.

#include <carom/random.hpp>
#include <cmath>
#include <initializer_list>

namespace carom::test {

struct Choices {
    explicit Choices(std::uint64_t seed) : random(seed) {}

    double between(double low, double high) { return random.uniform(low, high); }
    /// As likely to be between 1 and 10 as between 10 and 100.
    double magnitude(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    template <class Whole>
    Whole below(Whole n) {
        return static_cast<Whole>(between(0, static_cast<double>(n)));
    }
    bool chance(double part) { return between(0, 1) < part; }
    template <class T>
    T one_of(std::initializer_list<T> all) {
        return std::data(all)[below(all.size())];
    }

    Random random;
};

}  // namespace carom::test
