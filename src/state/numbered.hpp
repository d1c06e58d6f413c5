#pragma once
// A list whose members are known by numbers that stay while others come and go.

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace carom {

/// In the order in which they were added, numbered from 1. No number is given twice. As long as nothing was erased the
/// numbers follow from the places, and none is kept: a cloth has millions of springs.
template <class T>
class Numbered {
  public:
    Numbered() = default;
    Numbered(std::initializer_list<T> all) : all_(all), given_(static_cast<std::uint32_t>(all.size())) {}

    std::size_t size() const { return all_.size(); }
    bool empty() const { return all_.empty(); }
    const T* data() const { return all_.data(); }
    auto begin() const { return all_.begin(); }
    auto end() const { return all_.end(); }
    const T& operator[](std::size_t place) const { return all_[place]; }
    T& operator[](std::size_t place) { return all_[place]; }

    /// Numbers given so far.
    std::uint32_t given() const { return given_; }
    std::uint32_t number(std::size_t place) const {
        return is_whole() ? static_cast<std::uint32_t>(place) + 1 : numbers_[place];
    }
    /// Where it is, if it was added and not erased.
    std::optional<std::size_t> place(std::uint32_t number) const {
        if (number == 0 || number > given_) return {};
        if (is_whole()) return number - 1;
        const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), number);
        if (found == numbers_.end() || *found != number) return {};
        return static_cast<std::size_t>(found - numbers_.begin());
    }

    /// Returns the number of the new one.
    template <class U = T>
    std::uint32_t push_back(U&& one) {
        if (!is_whole()) numbers_.push_back(given_ + 1);
        all_.push_back(std::forward<U>(one));
        return ++given_;
    }
    void erase(std::size_t place) {
        keep_numbers();
        all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(place));
        numbers_.erase(numbers_.begin() + static_cast<std::ptrdiff_t>(place));
    }
    template <class Gone>
    void erase_if(const Gone& gone) {
        const auto first = std::find_if(all_.begin(), all_.end(), gone);
        if (first == all_.end()) return;
        keep_numbers();
        auto kept = static_cast<std::size_t>(first - all_.begin());
        for (std::size_t i = kept + 1; i < all_.size(); ++i) {
            if (gone(all_[i])) continue;
            all_[kept] = std::move(all_[i]);
            numbers_[kept++] = numbers_[i];
        }
        all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(kept), all_.end());
        numbers_.resize(kept);
    }

  private:
    bool is_whole() const { return all_.size() == given_; }
    void keep_numbers() {
        if (!is_whole()) return;
        numbers_.resize(all_.size());
        std::iota(numbers_.begin(), numbers_.end(), 1u);
    }

    std::vector<T> all_;
    std::vector<std::uint32_t> numbers_;  ///< ascending; none as long as nothing was erased
    std::uint32_t given_ = 0;
};

}  // namespace carom
