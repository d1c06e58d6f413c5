#pragma once
#include <cstddef>
#include <vector>

namespace carom {

/// Asks the system for large pages of memory under an array that is about to be written, if it is large and the system
/// has any: whoever reads all over it spends less time looking up where the pages are. It changes nothing else.
void prefer_large_pages(void* data, std::size_t bytes);

/// Room for so many, in large pages if they are many.
template <class T>
void reserve_large(std::vector<T>& array, std::size_t count) {
    if (count <= array.capacity()) return;
    array.reserve(count);
    prefer_large_pages(array.data(), count * sizeof(T));
}

/// Leaves no room for more, in large pages if they are many.
template <class T>
void settle_large(std::vector<T>& array) {
    std::vector<T> settled;
    reserve_large(settled, array.size());
    settled.insert(settled.end(), array.begin(), array.end());
    array.swap(settled);
}

}  // namespace carom
