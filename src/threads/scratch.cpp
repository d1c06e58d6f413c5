#include "math/scratch.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <mutex>
#include <new>
#include <utility>

#include "math/pages.hpp"

namespace carom {

namespace {

/// Of a cache line: lanes and what is aligned for them fit.
constexpr std::align_val_t alignment{64};

std::size_t size_class(std::size_t bytes) {
    constexpr std::size_t least = 64;
    return static_cast<std::size_t>(std::bit_width(std::max(bytes, least) - 1));
}

/// Free blocks, each with the address of the next one in its first bytes.
struct Pile {
    void* top = nullptr;
    std::size_t height = 0;

    void put(void* block) { *static_cast<void**>(block) = std::exchange(top, block), ++height; }
    void* take() { return --height, std::exchange(top, *static_cast<void**>(top)); }
    void move_to(Pile& other, std::size_t most) {
        while (most-- > 0 && height > 0) other.put(take());
    }
};

/// By the binary logarithm of their size.
struct Piles : std::array<Pile, 64> {
    Piles() = default;
    Piles(const Piles&) = delete;
    ~Piles() {
        for (Pile& pile : *this)
            while (pile.height > 0) ::operator delete(pile.take(), alignment);
    }
};

/// What is given back by another thread than took it: else the one would hoard what the other asks the system for.
class Depot {
  public:
    static Depot& shared() {
        static Depot depot;
        return depot;
    }
    void move_from(std::size_t k, Pile& pile, std::size_t most) {
        const std::lock_guard lock(mutex_);
        pile.move_to(piles_[k], most);
    }
    void move_to(std::size_t k, Pile& pile, std::size_t most) {
        const std::lock_guard lock(mutex_);
        piles_[k].move_to(pile, most);
    }

  private:
    std::mutex mutex_;
    Piles piles_;
};

constexpr std::size_t some = 32;  ///< blocks are moved between a thread and the depot at a time
thread_local Piles own;

/// In large pages: who is asked for much at once, as in the first step of a large world, waits for the system longer
/// than for what is done with it.
void* new_block(std::size_t bytes) {
    void* const memory = ::operator new(bytes, alignment);
    prefer_large_pages(memory, bytes);
    return memory;
}

}  // namespace

void* take_scratch(std::size_t bytes) {
    const std::size_t k = size_class(bytes);
    if (own[k].height == 0) Depot::shared().move_to(k, own[k], some);
    void* const memory = own[k].height > 0 ? own[k].take() : new_block(std::size_t{1} << k);
#if defined(CAROM_SPOILS_SCRATCH)
    std::memset(memory, 0x7f, bytes);  // as a double 1e306: who reads what nobody wrote is found out by the bits
#endif
    return memory;
}

void give_back_scratch(void* memory, std::size_t bytes) noexcept {
    const std::size_t k = size_class(bytes);
    own[k].put(memory);
    if (own[k].height > 2 * some) Depot::shared().move_from(k, own[k], some);
}

}  // namespace carom
