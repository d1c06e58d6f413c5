#pragma once
// Which members of a list are of which body.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace carom {

/// Looked up for one question after another: the first one goes over the list.
class PlacesByBody {
  public:
    void forget() { is_known_ = false; }  ///< the list is another one now
    /// The places of those with an end at a body with this index, ascending. each_end(act) calls act(place, index) for
    /// every end of all of them, in the order of places.
    template <class EachEnd>
    std::span<const std::uint32_t> of(std::uint32_t index, const EachEnd& each_end) {
        if (!std::exchange(is_known_, true)) list(each_end);
        if (index + std::size_t{1} >= end_.size()) return {};
        const std::uint32_t first = index == 0 ? 0 : end_[index - 1];
        return std::span(places_).subspan(first, end_[index] - first);
    }

  private:
    template <class EachEnd>
    void list(const EachEnd& each_end) {
        std::uint32_t last = 0;
        each_end([&last](std::uint32_t, std::uint32_t index) { last = std::max(last, index); });
        end_.assign(last + std::size_t{2}, 0);
        each_end([this](std::uint32_t, std::uint32_t index) { ++end_[index]; });
        std::exclusive_scan(end_.begin(), end_.end(), end_.begin(), 0U);
        places_.resize(end_.back());
        each_end([this](std::uint32_t place, std::uint32_t index) { places_[end_[index]++] = place; });
    }

    bool is_known_ = false;
    std::vector<std::uint32_t> places_;  ///< of those at bodies with an index
    std::vector<std::uint32_t> end_;     ///< of these, an index later
};

}  // namespace carom
