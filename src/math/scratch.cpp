#include "math/scratch.hpp"

#include <array>
#include <new>

namespace carom {

namespace {

/// Of a cache line: lanes and what is aligned for them fit.
constexpr std::align_val_t alignment{64};

/// Free blocks by the binary logarithm of their size, each with the address of the next one in its first bytes.
class Shelf {
  public:
    ~Shelf() {
        for (void* block : first_)
            while (block) {
                void* next = *static_cast<void**>(block);
                ::operator delete(block, alignment);
                block = next;
            }
    }
    void* take(std::size_t bytes) {
        const std::size_t k = size_class(bytes);
        void* const block = first_[k];
        if (!block) return ::operator new (std::size_t{1} << k, alignment);
        first_[k] = *static_cast<void**>(block);
        return block;
    }
    void give_back(void* block, std::size_t bytes) noexcept {
        const std::size_t k = size_class(bytes);
        *static_cast<void**>(block) = first_[k];
        first_[k] = block;
    }

  private:
    static std::size_t size_class(std::size_t bytes) {
        constexpr std::size_t least = 6;  // 64 bytes
        std::size_t k = least;
        while (std::size_t{1} << k < bytes) ++k;
        return k;
    }
    std::array<void*, 64> first_{};
};

thread_local Shelf shelf;

}  // namespace

void* take_scratch(std::size_t bytes) { return shelf.take(bytes); }
void give_back_scratch(void* memory, std::size_t bytes) noexcept { shelf.give_back(memory, bytes); }

}  // namespace carom
