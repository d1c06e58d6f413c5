#include "analysis/refinement.hpp"

#include <algorithm>
#include <cmath>

#include "math/elementary.hpp"

namespace carom {

namespace {

constexpr double aim = 0.7;      // of the error allowed: what is rounded to two digits stays within it, and a bit
constexpr double enough = 0.25;  // of it: who is nearer need not be looked for
constexpr int most_tries = 8;

/// The number cut to its first two digits, as it is read from a command line.
double two_digits(double value) {
    int exponent = static_cast<int>(std::floor(portable::log(value) / portable::log(10.0))) - 1;
    const auto scaled = [&] {
        double by = 1;
        for (int k = 0; k < std::abs(exponent); ++k) by *= 10;  // exact up to 1e22
        return exponent < 0 ? std::pair{std::floor(value * by), by} : std::pair{std::floor(value / by), by};
    };
    if (scaled().first >= 100) ++exponent;
    const auto [digits, by] = scaled();
    return exponent < 0 ? digits / by : digits * by;
}

}  // namespace

void Refinement::know(Trial trial) {
    if (trial.error <= 1) {
        if (!fine_ || trial.value > fine_->value) fine_ = trial;
    } else if (trial.value < coarse_.value) {
        coarse_ = trial;
    }
}

double Refinement::between() const {
    const double all = portable::log(fine_->error / coarse_.error);
    const double part = portable::log(aim / coarse_.error) / all;  // of the way, both in logarithms
    return coarse_.value *
           portable::pow(fine_->value / coarse_.value, std::isfinite(part) ? std::clamp(part, 0.1, 0.9) : 0.5);
}

double Refinement::beyond() const {
    const double by_order = coarse_.value * portable::pow(aim / coarse_.error, 1 / order_);
    // Where the order has promised too much once, it is not believed again.
    const double bold = std::isfinite(coarse_.error) && tries_ == 0 ? coarse_.value : coarse_.value / 2;
    return std::isfinite(by_order) && by_order > 0 ? std::min(by_order, bold) : bold;
}

std::optional<double> Refinement::next() const {
    if (tries_ == most_tries || (fine_ && fine_->error >= enough)) return {};
    const double value = two_digits(std::max(fine_ ? between() : beyond(), finest_));
    const bool new_one = value < coarse_.value && value >= 0.9 * finest_ && (!fine_ || value > fine_->value);
    return new_one ? std::optional(value) : std::nullopt;
}

}  // namespace carom
