#include "collision/sweep.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "math/bits.hpp"

namespace carom {

namespace {

/// A double as an integer in the same order.
std::uint64_t key(double x) {
    const std::uint64_t bits = to_bits(x + 0.0);  // no −0
    return bits >> 63 ? ~bits : bits | 0x8000000000000000u;
}

/// Whether centres spread more along x than along y.
bool wider_along_x(std::span<const Aabb> boxes) {
    Vec2 mean{}, spread{};
    for (const Aabb& b : boxes) mean += b.low + b.high;
    mean = mean / static_cast<double>(boxes.size());
    for (const Aabb& b : boxes) {
        const Vec2 d = b.low + b.high - mean;
        spread += {d.x * d.x, d.y * d.y};
    }
    return spread.x >= spread.y;
}

}  // namespace

/// By key, then by box: radix sort, eight bits at a time, without the digits that all have in common.
void Sweep::sort() {
    if (keys_.size() < 128) {
        std::sort(keys_.begin(), keys_.end(),
                  [](Key a, Key b) { return a.key < b.key || (a.key == b.key && a.box < b.box); });
        return;
    }
    std::array<std::array<std::uint32_t, 256>, 8> count{};
    for (const Key& k : keys_)
        for (int digit = 0; digit < 8; ++digit) ++count[digit][k.key >> 8 * digit & 255];
    spare_.resize(keys_.size());
    for (int digit = 0; digit < 8; ++digit) {
        auto& place = count[digit];
        if (place[keys_[0].key >> 8 * digit & 255] == keys_.size()) continue;
        std::uint32_t before = 0;
        for (std::uint32_t& p : place) before += std::exchange(p, before);
        for (const Key& k : keys_) spare_[place[k.key >> 8 * digit & 255]++] = k;
        keys_.swap(spare_);
    }
}

void Sweep::line_up(std::span<const Aabb> boxes, bool along_x, Line& line) {
    sort();
    for (auto* values : {&line.low, &line.high, &line.across_low, &line.across_high}) values->resize(keys_.size());
    line.box.resize(keys_.size());
    for (std::size_t k = 0; k < keys_.size(); ++k) {
        const Aabb& b = boxes[keys_[k].box];
        line.box[k] = keys_[k].box;
        line.low[k] = along_x ? b.low.x : b.low.y;
        line.high[k] = along_x ? b.high.x : b.high.y;
        line.across_low[k] = along_x ? b.low.y : b.low.x;
        line.across_high[k] = along_x ? b.high.y : b.high.x;
    }
}

/// Box i of one line against those of a line that begin within it, from a start on.
void Sweep::sweep(const Line& from, std::size_t i, const Line& over, std::size_t start) {
    std::size_t end = start;
    while (end < over.low.size() && over.low[end] <= from.high[i]) ++end;
    if (found_.size() < count_ + (end - start)) found_.resize(2 * (count_ + (end - start)));
    const double low = from.across_low[i], high = from.across_high[i];
    const std::uint32_t box = from.box[i];
    for (std::size_t k = start; k < end; ++k) {
        // Written in any case, and kept if they overlap: a branch here would be foreseen badly.
        const std::uint32_t other = over.box[k];
        found_[count_] = {std::min(box, other), std::max(box, other)};
        count_ += std::size_t{over.across_low[k] <= high} & std::size_t{low <= over.across_high[k]};
    }
}

/// By b, then by a, each by counting.
void Sweep::sort_found(std::size_t boxes) {
    spare_found_.resize(found_.size());
    for (const auto number : {&BoxPair::b, &BoxPair::a}) {
        place_.assign(boxes, 0);
        for (std::size_t k = 0; k < count_; ++k) ++place_[found_[k].*number];
        std::uint32_t before = 0;
        for (std::uint32_t& p : place_) before += std::exchange(p, before);
        for (std::size_t k = 0; k < count_; ++k) spare_found_[place_[found_[k].*number]++] = found_[k];
        found_.swap(spare_found_);
    }
}

std::span<const BoxPair> Sweep::pairs(std::span<const Aabb> boxes, const std::vector<bool>& moves) {
    const bool along_x = wider_along_x(boxes);
    for (const bool moving : {true, false}) {
        keys_.clear();
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            if (moves[i] == moving) keys_.push_back({key(along_x ? boxes[i].low.x : boxes[i].low.y), i});
        line_up(boxes, along_x, moving ? moving_ : still_);
    }
    count_ = 0;
    std::size_t still = 0, moving = 0;
    for (std::size_t i = 0; i < moving_.low.size(); ++i) {
        while (still < still_.low.size() && still_.low[still] < moving_.low[i]) ++still;
        sweep(moving_, i, moving_, i + 1);
        sweep(moving_, i, still_, still);
    }
    for (std::size_t i = 0; i < still_.low.size(); ++i) {
        while (moving < moving_.low.size() && moving_.low[moving] <= still_.low[i]) ++moving;
        sweep(still_, i, moving_, moving);
    }
    sort_found(boxes.size());
    return {found_.data(), count_};
}

}  // namespace carom
