#pragma once
#include <array>
#include <cstdint>

namespace carom {

/// Carom's generator: xoshiro256** (Blackman, Vigna 2018), seeded by splitmix64. The same numbers on every machine.
class Random {
  public:
    explicit Random(std::uint64_t seed);
    std::uint64_t bits();
    double uniform();                         ///< in [0, 1), 53 bits
    double uniform(double low, double high);  ///< in [low, high)
    double normal();                          ///< mean 0, variance 1 (polar method)

  private:
    std::array<std::uint64_t, 4> state_;
    double spare_ = 0;
    bool has_spare_ = false;
};

/// numpy's legacy stream (np.random.seed, uniform, randn): MT19937, 53-bit doubles, polar normals with a spare. A
/// notebook's seed gives the notebook's numbers, to the last bit.
class NumpyRandom {
  public:
    explicit NumpyRandom(std::uint32_t seed);
    double uniform();                         ///< random_sample()
    double uniform(double low, double high);  ///< low + (high - low) * random_sample()
    double normal();                          ///< randn()

  private:
    std::uint32_t word();
    std::array<std::uint32_t, 624> state_;
    int next_ = 624;
    double spare_ = 0;
    bool has_spare_ = false;
};

}  // namespace carom
