#pragma once
#include <cstddef>
#include <vector>

#include "math/scratch.hpp"

namespace carom {

/// Asks the system for large pages of memory under an array that is about to be written, if it is large and the system
/// has any: whoever reads all over it spends less time looking up where the pages are. It changes nothing else.
void prefer_large_pages(void* data, std::size_t bytes);

constexpr std::size_t cache_line = 64, large_page = 1 << 21;
/// Memory that begins with a cache line, in large pages if it is large; for delete_lines if it begins with no more.
void* new_lines(std::size_t bytes, std::size_t alignment = cache_line);
void delete_lines(void* memory) noexcept;

/// For arrays that grow, are read all over and live longer than a step: what of them is not large is in one large page
/// with others, and is kept by the thread for the next world.
template <class T>
struct LargeAllocator {
    using value_type = T;
    LargeAllocator() = default;
    template <class U>
    LargeAllocator(const LargeAllocator<U>&) {}

    T* allocate(std::size_t count) {
        static_assert(alignof(T) <= cache_line);
        const std::size_t bytes = count * sizeof(T);
        return static_cast<T*>(bytes < large ? take_scratch(bytes) : new_lines(bytes));
    }
    void deallocate(T* memory, std::size_t count) noexcept {
        const std::size_t bytes = count * sizeof(T);
        bytes < large ? give_back_scratch(memory, bytes) : delete_lines(memory);
    }
    bool operator==(const LargeAllocator&) const = default;

  private:
    static constexpr std::size_t large = 1 << 24;
};
template <class T>
using LargeArray = std::vector<T, LargeAllocator<T>>;

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
