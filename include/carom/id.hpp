#pragma once
// Ids as keys: those of one kind are ordered and hashed, for std::map and std::unordered_map.
//
// An id I is described by a function beside it:
//     constexpr std::uint64_t key(I);    another number for another id, or nearly always

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace carom {

template <class I>
concept Id = requires(const I& id) {
    std::uint64_t{key(id)};
};

}  // namespace carom

template <carom::Id I>
struct std::hash<I> {
    std::size_t operator()(const I& id) const noexcept { return std::hash<std::uint64_t>{}(key(id)); }
};
