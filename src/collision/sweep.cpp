#include "collision/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/bits.hpp"

namespace carom {

namespace {

/// A double as an integer in the same order.
std::uint64_t key(double x) {
    const std::uint64_t bits = to_bits(x + 0.0);  // no −0
    return bits >> 63 ? ~bits : bits | 0x8000000000000000u;
}

/// Turns numbers of items into the places of the first of each.
template <class Counts>
void add_up(Counts& counts) {
    std::uint32_t before = 0;
    for (std::uint32_t& count : counts) before += std::exchange(count, before);
}

}  // namespace

/// The axis is the one along which the centres spread more. Twice the mean width makes half as many entries again as
/// there are boxes at most, whatever their widths.
Sweep::Strips::Strips(std::span<const Aabb> boxes) {
    const double n = static_cast<double>(boxes.size());
    Vec2 mean{}, spread{}, size{};
    for (const Aabb& b : boxes) mean += b.low + b.high, size += b.high - b.low;
    mean = mean / n;
    for (const Aabb& b : boxes) {
        const Vec2 d = b.low + b.high - mean;
        spread += {d.x * d.x, d.y * d.y};
    }
    along_x = spread.x >= spread.y;
    per_length = n / (2 * (along_x ? size.y : size.x));
    if (!(per_length > 0) || !std::isfinite(per_length)) return;
    while (static_cast<double>(count) * count < n) count *= 2;
}

Sweep::Reach Sweep::Strips::reach(double across_low, double across_high) const {
    if (count == 1) return {0, 1};
    const auto at = [&](double across) {
        // In this order what is no number is taken for a low one: a room that gravity made infinite is found by step().
        const double place = std::max(-0x1p60, std::min(across * per_length, 0x1p60));
        const auto whole = static_cast<std::int64_t>(place);
        return whole - (static_cast<double>(whole) > place);
    };
    const std::int64_t first = at(across_low), reached = at(across_high) - first + 1;
    return {static_cast<std::uint32_t>(first) & (count - 1),
            static_cast<std::uint32_t>(std::clamp<std::int64_t>(reached, 1, count))};
}

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
        add_up(place);
        for (const Key& k : keys_) spare_[place[k.key >> 8 * digit & 255]++] = k;
        keys_.swap(spare_);
    }
}

void Sweep::add_key(std::span<const Aabb> boxes, std::uint32_t box) {
    keys_.push_back({key(strips_.along_x ? boxes[box].low.x : boxes[box].low.y), box});
}

void Sweep::line_up(std::span<const Aabb> boxes, Line& line) {
    const Strips& strips = strips_;
    line.end.assign(strips.count, 0);
    const std::uint32_t mask = strips.count - 1;
    for (const Key& k : keys_) {
        const Aabb& b = boxes[k.box];
        const Reach reach = strips.along_x ? strips.reach(b.low.y, b.high.y) : strips.reach(b.low.x, b.high.x);
        reach_[k.box] = reach;
        for (std::uint32_t i = 0; i < reach.count; ++i) ++line.end[(reach.first + i) & mask];
    }
    std::uint32_t all = 0;
    for (const std::uint32_t count : line.end) all += count;
    line.entries.resize(all);
    add_up(line.end);
    sort();
    for (const Key& k : keys_) {
        const Aabb& b = boxes[k.box];
        const Reach reach = reach_[k.box];
        const Entry entry = strips.along_x ? Entry{b.low.x, b.high.x, b.low.y, b.high.y, k.box, reach.first}
                                           : Entry{b.low.y, b.high.y, b.low.x, b.high.x, k.box, reach.first};
        for (std::uint32_t i = 0; i < reach.count; ++i) line.entries[line.end[(reach.first + i) & mask]++] = entry;
    }
}

/// One box against those that begin within it, from a start on. Of the strips that two boxes share the first one
/// counts.
void Sweep::sweep(std::uint32_t strip, const Entry& from, std::span<const Entry> over, std::size_t start) {
    for (std::size_t k = start; k < over.size() && over[k].low <= from.high; ++k) {
        const Entry& to = over[k];
        if (found_.size() == count_) found_.resize(2 * count_ + 64);
        // Written in any case, and kept if they overlap: a branch here would be foreseen badly.
        found_[count_] = {std::min(from.box, to.box), std::max(from.box, to.box)};
        const std::uint32_t shared = from.across_low >= to.across_low ? from.strip : to.strip;
        count_ += std::size_t{to.across_low <= from.across_high} & std::size_t{from.across_low <= to.across_high} &
                  std::size_t{shared == strip};
    }
}

void Sweep::sweep_strip(std::uint32_t strip, std::span<const Entry> moving, std::span<const Entry> still) {
    std::size_t begun = 0;
    for (std::size_t i = 0; i < moving.size(); ++i) {
        while (begun < still.size() && still[begun].low < moving[i].low) ++begun;
        sweep(strip, moving[i], moving, i + 1);
        sweep(strip, moving[i], still, begun);
    }
    begun = 0;
    for (const Entry& from : still) {
        while (begun < moving.size() && moving[begun].low <= from.low) ++begun;
        sweep(strip, from, moving, begun);
    }
}

/// By b, then by a, each by counting.
void Sweep::sort_found(std::size_t boxes) {
    spare_found_.resize(found_.size());
    for (const auto number : {&BoxPair::b, &BoxPair::a}) {
        place_.assign(boxes, 0);
        for (std::size_t k = 0; k < count_; ++k) ++place_[found_[k].*number];
        add_up(place_);
        for (std::size_t k = 0; k < count_; ++k) spare_found_[place_[found_[k].*number]++] = found_[k];
        found_.swap(spare_found_);
    }
}

void Sweep::sweep_all() {
    count_ = 0;
    for (std::uint32_t strip = 0; strip < strips_.count; ++strip) {
        const auto part = [strip](const Line& line) {
            const std::size_t begin = strip == 0 ? 0 : line.end[strip - 1];
            return std::span(line.entries).subspan(begin, line.end[strip] - begin);
        };
        if (const auto moving = part(moving_); !moving.empty()) sweep_strip(strip, moving, part(still_));
    }
}

std::span<const BoxPair> Sweep::pairs(std::span<const Aabb> boxes, const Scratch<bool>& moves) {
    strips_ = Strips(boxes);
    reach_.resize(boxes.size());
    for (const bool moving : {true, false}) {
        keys_.clear();
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            if (moves[i] == moving) add_key(boxes, i);
        line_up(boxes, moving ? moving_ : still_);
    }
    sweep_all();
    sort_found(boxes.size());
    return {found_.data(), count_};
}

std::span<const BoxPair> Sweep::pairs_again(std::span<const Aabb> boxes, std::span<const std::uint32_t> moving) {
    keys_.clear();
    for (const std::uint32_t i : moving) add_key(boxes, i);
    line_up(boxes, moving_);
    sweep_all();
    const auto end = found_.begin() + static_cast<std::ptrdiff_t>(count_);
    if (count_ < boxes.size())
        std::sort(found_.begin(), end);
    else
        sort_found(boxes.size());
    // Who lay still is met there too, and by itself.
    const auto others = std::remove_if(found_.begin(), end, [](BoxPair pair) { return pair.a == pair.b; });
    return {found_.data(), static_cast<std::size_t>(std::unique(found_.begin(), others) - found_.begin())};
}

}  // namespace carom
