#include "analysis/blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "math/elementary.hpp"

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

constexpr std::size_t slow_waves = 16;  ///< whose powers are looked at: one counts as much as another block would

/// What each of the slowest cosines of the run says of the squared error of the mean of what is off in n blocks.
std::array<double, slow_waves> powers(const std::vector<double>& off) {
    constexpr double pi = 0x1.921fb54442d18p1;
    const double n = static_cast<double>(off.size());
    std::array<double, slow_waves> out{};
    for (std::size_t wave = 0; wave < slow_waves; ++wave) {
        const double turn = pi * static_cast<double>(wave + 1) / n, twice = 2 * portable::cos(turn);
        double sum = 0, before = portable::cos(0.5 * turn), now = before;  // cos((k - ½) turn), cos((k + ½) turn)
        for (const double each : off) {
            sum += each * now;
            before = std::exchange(now, twice * now - before);
        }
        out[wave] = 2 / (n * n) * sum * sum;
    }
    return out;
}

double mean_of_first(const std::array<double, slow_waves>& powers, std::size_t count) {
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += powers[k] / static_cast<double>(count);
    return sum;
}

}  // namespace

bool Blocks::are_of(std::size_t quantities) const {
    return open_.size() == quantities && length_ > 0 && full_.size() < most &&
           std::all_of(full_.begin(), full_.end(), [=](const auto& block) { return block.size() == quantities; });
}

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

double Blocks::error(std::size_t a, std::size_t b) const { return error(std::array{Term{a, b, 1}}); }

// The error of a mean is the power of its fluctuations at the frequency 0, and what the slowest waves of the run have
// is nearest to that, whether faster ones have less, as where neighbours in time are alike, or more, as where what is
// missing now comes soon after.
double Blocks::error(std::span<const Term> terms) const {
    if (full_.size() < 2 * slow_waves) return std::numeric_limits<double>::quiet_NaN();
    std::vector<double> off(full_.size());
    for (const Term& term : terms) {
        const double mean = ratio(term.a, term.b);
        double weight = 0;
        for (const auto& block : full_) weight += block[term.b] / static_cast<double>(full_.size());
        for (std::size_t k = 0; k < off.size(); ++k)
            off[k] += term.factor * (full_[k][term.a] - mean * full_[k][term.b]) / weight;
    }
    const auto power = powers(off);
    double squared = mean_of_first(power, slow_waves);
    // Where it still rises towards the slowest, it is taken to rise once more as much as it did: of white noise one in
    // fifteen does by so much, of a run as short as a few of its memories nearly all.
    constexpr double much = 3;
    constexpr std::size_t fewest = 4;
    for (std::size_t count = slow_waves; count >= 2 * fewest; count /= 2) {
        const double all = mean_of_first(power, count), slower = mean_of_first(power, count / 2);
        if (!(slower > much * (2 * all - slower))) break;
        squared = slower * slower / all;
    }
    return std::sqrt(squared);
}

}  // namespace carom
