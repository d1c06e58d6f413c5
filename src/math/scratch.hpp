#pragma once
// Memory of what lives no longer than a step. It is kept by the thread for the next step, which needs as much: a steady
// step asks the system for none.

#include <cstddef>
#include <vector>

namespace carom {

/// Aligned to 64 bytes. What lies idle is shared out by threads/scratch.cpp.
void* take_scratch(std::size_t bytes);
/// Also by another thread than took it.
void give_back_scratch(void* memory, std::size_t bytes) noexcept;

template <class T>
struct ScratchAllocator {
    using value_type = T;
    ScratchAllocator() = default;
    template <class U>
    ScratchAllocator(const ScratchAllocator<U>&) {}

    T* allocate(std::size_t count) {
        static_assert(alignof(T) <= 64);
        return static_cast<T*>(take_scratch(count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t count) noexcept { give_back_scratch(memory, count * sizeof(T)); }
    bool operator==(const ScratchAllocator&) const = default;
};

template <class T>
using Scratch = std::vector<T, ScratchAllocator<T>>;

}  // namespace carom
