#pragma once
#include <cstddef>
#include <new>
#include <vector>

namespace carom {

/// Asks the system for large pages of memory under an array that is about to be written, if it is large and the system
/// has any: whoever reads all over it spends less time looking up where the pages are. It changes nothing else.
void prefer_large_pages(void* data, std::size_t bytes);

/// For arrays that grow and are read all over: where their memory is large, it is in large pages from the first one on.
/// It does not begin with one: arrays that lie alike would take one another's places in the cache.
template <class T>
struct LargeAllocator {
    using value_type = T;
    LargeAllocator() = default;
    template <class U>
    LargeAllocator(const LargeAllocator<U>&) {}

    T* allocate(std::size_t count) {
        static_assert(alignof(T) <= static_cast<std::size_t>(line));
        void* const memory = ::operator new(count * sizeof(T), line);
        prefer_large_pages(memory, count * sizeof(T));
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) noexcept { ::operator delete(memory, line); }
    bool operator==(const LargeAllocator&) const = default;

  private:
    static constexpr std::align_val_t line{64};
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
