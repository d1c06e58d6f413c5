#include "analysis/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

std::vector<double> plus(std::vector<double> a, const std::vector<double>& b) {
    for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
    return a;
}

/// Two by two; an odd one at the end is left out.
std::vector<std::vector<double>> merged(const std::vector<std::vector<double>>& blocks) {
    std::vector<std::vector<double>> out;
    for (std::size_t k = 0; k + 1 < blocks.size(); k += 2) out.push_back(plus(blocks[k], blocks[k + 1]));
    return out;
}

}  // namespace

void Blocks::end_sample() {
    if (++in_open_ < length_) return;
    full_.push_back(open_);
    std::fill(open_.begin(), open_.end(), 0.0);
    in_open_ = 0;
    if (full_.size() < most) return;
    full_ = merged(full_);
    length_ *= 2;
}

double Blocks::sum(std::size_t quantity) const {
    double sum = open_[quantity];
    for (const auto& block : full_) sum += block[quantity];
    return sum;
}

double Blocks::error(std::size_t a, std::size_t b) const {
    // The error of the mean of independent blocks. Short ones are not, and seem to have less: the largest counts, of
    // those lengths of which there are blocks enough to tell.
    constexpr std::size_t enough = 8;
    const double mean = ratio(a, b);
    double largest = std::numeric_limits<double>::quiet_NaN();
    for (auto blocks = full_; blocks.size() >= enough; blocks = merged(blocks)) {
        double squares = 0, weight = 0;
        for (const auto& block : blocks) weight += block[b] / static_cast<double>(blocks.size());
        for (const auto& block : blocks) {
            const double off = (block[a] - mean * block[b]) / weight;
            squares += off * off;
        }
        const double n = static_cast<double>(blocks.size()), error = std::sqrt(squares / (n * (n - 1)));
        if (!(error <= largest)) largest = error;
    }
    return largest;
}

}  // namespace carom
