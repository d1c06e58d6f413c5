#pragma once
#include <array>
#include <cstddef>

#include "state/motion.hpp"
#include "state/rows_text.hpp"

namespace carom {

enum class Angles { summed, left };

/// Σ weight in over vectors and angles, as of a method's stages. Small terms are summed before they meet the large one,
/// the start, which rounds once.
class Combination {
  public:
    void add(double weight, const Motion& in) {
        if (weight == 0 || in.size() == 0) return;
        linear_[count_] = {weight, &in.linear.data()->x};
        angular_[count_++] = {weight, in.angular.data()};
    }
    /// From a start if there is one.
    void write(std::size_t rows, const Motion* start, Angles angles, Motion& out) const {
        if (out.size() != rows) out.resize(rows);
        if (rows == 0) return;  // there is no first number then to point at
        sum(linear_, 2 * rows, start ? &start->linear.data()->x : nullptr, &out.linear.data()->x);
        if (angles == Angles::left) return;
        sum(angular_, rows, start ? start->angular.data() : nullptr, out.angular.data());
    }

  private:
    static constexpr std::size_t most = 18;  ///< the stages of the longest method here, and the velocity
    using Terms = std::array<Term, most>;

    void sum(const Terms& terms, std::size_t numbers, const double* start, double* out) const {
        if (are_few(numbers / 2))
            combine_few(terms.data(), count_, start, out, numbers);
        else
            rows_kernel().combine(terms.data(), count_, start, out, numbers);
    }

    Terms linear_, angular_;
    std::size_t count_ = 0;
};

}  // namespace carom
