#include "collision/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "math/bits.hpp"
#include "threads/parallel.hpp"

namespace carom {

namespace {

/// A double as an integer in the same order.
std::uint64_t key(double x) {
    const std::uint64_t bits = to_bits(x + 0.0);  // no −0
    return bits >> 63 ? ~bits : bits | 0x8000000000000000u;
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
        std::exclusive_scan(place.begin(), place.end(), place.begin(), 0U);  // where the first of each goes
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
    std::exclusive_scan(line.end.begin(), line.end.end(), line.end.begin(), 0U);
    sort();
    for (const Key& k : keys_) {
        const Aabb& b = boxes[k.box];
        const Reach reach = reach_[k.box];
        const Entry entry = strips.along_x ? Entry{b.low.x, b.high.x, b.low.y, b.high.y, k.box, reach.first}
                                           : Entry{b.low.y, b.high.y, b.low.x, b.high.x, k.box, reach.first};
        for (std::uint32_t i = 0; i < reach.count; ++i) line.entries[line.end[(reach.first + i) & mask]++] = entry;
    }
}

/// Of the strips that two boxes share the first one counts.
void Sweep::Found::sweep(std::uint32_t strip, const Entry& from, std::span<const Entry> over, std::size_t start) {
    constexpr std::size_t some = 64;
    const auto [low, high, across_low, across_high, box, first] = from;
    const bool begins_here = first == strip;
    while (start < over.size() && over[start].low <= high) {
        if (pairs_.size() < count_ + some) pairs_.resize(2 * count_ + some);
        BoxPair* next = pairs_.data() + count_;
        const std::size_t end = std::min(over.size(), start + some);
        for (; start < end && over[start].low <= high; ++start) {
            const Entry& to = over[start];
            // Written in any case, and kept if they overlap, without a branch, which would be foreseen badly.
            const std::uint32_t both = (box ^ to.box) & -std::uint32_t{to.box < box};
            *next = {box ^ both, to.box ^ both};
            const bool begins_later = to.across_low > across_low;
            const bool is_first = (begins_later & (to.strip == strip)) | (!begins_later & begins_here);
            next += (to.across_low <= across_high) & (across_low <= to.across_high) & is_first;
        }
        count_ = static_cast<std::size_t>(next - pairs_.data());
    }
}

void Sweep::Found::sweep_strip(std::uint32_t strip, std::span<const Entry> moving, std::span<const Entry> still) {
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

/// By counting: those with the same key stay in the order in which they are.
template <class KeyOf>
void Sweep::sort_by(std::size_t keys, const KeyOf& key_of) {
    unsorted_.swap(sorted_);
    sorted_.resize(unsorted_.size());
    place_.assign(keys, 0);
    for (const BoxPair& pair : unsorted_) ++place_[key_of(pair)];
    std::exclusive_scan(place_.begin(), place_.end(), place_.begin(), 0U);
    for (const BoxPair& pair : unsorted_) sorted_[place_[key_of(pair)]++] = pair;
}

/// By what counts least first, each by counting, unless they are few.
std::span<BoxPair> Sweep::sort_found(std::span<const BoxName> names) {
    const auto name = [names](std::uint32_t box) { return names.empty() ? BoxName{box, 0} : names[box]; };
    BoxName most{0, 0};
    sorted_.clear();
    for (const Found& found : found_)
        for (auto [a, b] : found.all()) {
            if (name(b).body < name(a).body) std::swap(a, b);
            most = {std::max(most.body, name(b).body), std::max({most.piece, name(a).piece, name(b).piece})};
            sorted_.push_back({a, b});
        }
    if (8 * sorted_.size() < std::size_t{most.body} + most.piece) {
        std::sort(sorted_.begin(), sorted_.end(), [name](const BoxPair& p, const BoxPair& q) {
            const auto key = [name](BoxPair pair) {
                const BoxName a = name(pair.a), b = name(pair.b);
                return std::array{a.body, b.body, a.piece, b.piece};
            };
            return key(p) < key(q);
        });
        return sorted_;
    }
    if (most.piece > 0) {
        sort_by(most.piece + std::size_t{1}, [name](BoxPair pair) { return name(pair.b).piece; });
        sort_by(most.piece + std::size_t{1}, [name](BoxPair pair) { return name(pair.a).piece; });
    }
    sort_by(most.body + std::size_t{1}, [name](BoxPair pair) { return name(pair.b).body; });
    sort_by(most.body + std::size_t{1}, [name](BoxPair pair) { return name(pair.a).body; });
    return sorted_;
}

/// Threads share the strips. Which of them are found together does not matter: pairs are sorted.
void Sweep::sweep_all(int threads, const Keep& keep) {
    constexpr std::size_t some = 8;
    const auto part = [](const Line& line, std::size_t strip) {
        const std::size_t begin = strip == 0 ? 0 : line.end[strip - 1];
        return std::span(line.entries).subspan(begin, line.end[strip] - begin);
    };
    found_.resize(strips_.count / some + 1);
    for (Found& found : found_) found.clear();
    parallel_ranges(threads, strips_.count, some, [&](std::size_t first, std::size_t last) {
        Found& found = found_[first / some];
        for (std::size_t strip = first; strip < last; ++strip)
            if (const auto moving = part(moving_, strip); !moving.empty())
                found.sweep_strip(static_cast<std::uint32_t>(strip), moving, part(still_, strip));
        if (keep) found.keep(keep);
    });
}

std::span<const BoxPair> Sweep::pairs(std::span<const Aabb> boxes, const Scratch<bool>& moves, int threads,
                                      const Keep& keep, std::span<const BoxName> names) {
    strips_ = Strips(boxes);
    reach_.resize(boxes.size());
    for (const bool moving : {true, false}) {
        keys_.clear();
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            if (moves[i] == moving) add_key(boxes, i);
        line_up(boxes, moving ? moving_ : still_);
    }
    lies_still_.assign(boxes.size(), false);
    for (const Key& k : keys_) lies_still_[k.box] = true;
    sweep_all(threads, keep);
    return sort_found(names);
}

std::span<const BoxPair> Sweep::pairs_again(std::span<const Aabb> boxes, std::span<const std::uint32_t> moving,
                                            int threads, const Keep& keep, std::span<const BoxName> names) {
    keys_.clear();
    for (const std::uint32_t i : moving) add_key(boxes, i);
    line_up(boxes, moving_);
    sweep_all(threads, keep);
    const std::span found = sort_found(names);
    if (std::none_of(moving.begin(), moving.end(), [&](std::uint32_t i) { return lies_still_[i]; })) return found;
    // Who lay still is met there too, and by itself.
    const auto others = std::remove_if(found.begin(), found.end(), [](BoxPair pair) { return pair.a == pair.b; });
    return {found.begin(), std::unique(found.begin(), others)};
}

}  // namespace carom
