#pragma once
#include <carom/archive.hpp>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// Sums of several quantities over blocks of samples. When there are too many blocks, two become one.
class Blocks {
  public:
    explicit Blocks(std::size_t quantities = 0) : open_(quantities) {}
    /// Where the next sample is to be added; then call end_sample.
    std::vector<double>& sample() { return open_; }
    void end_sample();
    /// Whether all samples, read from wherever, are of so many quantities.
    bool are_of(std::size_t quantities) const;

    /// Over all blocks, the one that is not full included.
    double sum(std::size_t quantity) const;
    /// Σ a / Σ b over the run.
    double ratio(std::size_t a, std::size_t b) const { return sum(a) / sum(b); }
    /// Its standard error; NaN if there are too few blocks.
    double error(std::size_t a, std::size_t b) const;

    /// factor × Σ a / Σ b.
    struct Term {
        std::size_t a, b;
        double factor;
    };
    /// The standard error of a sum of terms, which may vary together; NaN if there are too few blocks.
    double error(std::span<const Term> terms) const;

    friend auto members(Maybe_const<Blocks> auto& b) {
        auto& [open, in_open, length, full] = b;
        return std::tie(open, in_open, length, full);
    }

  private:
    static constexpr std::size_t most = 128;
    std::vector<double> open_;
    std::uint64_t in_open_ = 0, length_ = 1;
    std::vector<std::vector<double>> full_;
};

}  // namespace carom
