#pragma once
// Large results made where they are to lie.

#include <memory>
#include <new>
#include <type_traits>

namespace carom {

/// Puts what `make` returns in the place of a value, without a copy: who copies what was just written number by number
/// waits until it is in memory.
template <class T, class Make>
void make_at(T& place, const Make& make) {
    static_assert(std::is_trivially_destructible_v<T> && std::is_same_v<decltype(make()), T>);
    new (std::addressof(place)) T(make());
}

}  // namespace carom
