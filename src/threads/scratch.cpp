#include "math/scratch.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <utility>

#include "math/pages.hpp"

namespace carom {

namespace {

std::size_t size_class(std::size_t bytes) {
    return static_cast<std::size_t>(std::bit_width(std::max(bytes, cache_line) - 1));
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
using Piles = std::array<Pile, 64>;

/// Of which blocks are cut, side by side in large pages: the first step of a large world waits for the system to find
/// pages longer than for what is done with them, and most of its arrays are smaller than a large one. Each slab is as
/// large as all before it.
class Slabs {
  public:
    void* cut(std::size_t bytes) {
#if defined(CAROM_SPOILS_SCRATCH)
        return new_lines(bytes);  // a sanitizer sees who leaves his block
#endif
        if (bytes > most / 2) return new_lines(bytes);
        // Blocks that lie alike would take one another's places in the cache.
        constexpr std::size_t apart = 17 * cache_line;
        const std::size_t room = bytes + (bytes > apart ? apart : 0);
        if (room > left_) {
            const std::size_t size = std::max(std::clamp(cut_, least, most), 2 * bytes);
            next_ = static_cast<std::byte*>(new_lines(size, size < 2 * large_page ? cache_line : large_page));
            left_ = size, cut_ += size;
        }
        left_ -= room;
        return std::exchange(next_, next_ + room);
    }

  private:
    static constexpr std::size_t least = 1 << 16, most = 1 << 25;
    std::byte* next_ = nullptr;
    std::size_t left_ = 0, cut_ = 0;
};

/// New blocks; and what is given back by another thread than took it: else the one would hoard what the other asks the
/// system for.
class Depot {
  public:
    /// Never destroyed: threads and what is static give back to it when they end.
    static Depot& shared() {
        static Depot& depot = *new Depot;
        return depot;
    }
    void move_from(std::size_t k, Pile& pile, std::size_t most) {
        const std::lock_guard lock(mutex_);
        pile.move_to(piles_[k], most);
    }
    void move_to(std::size_t k, Pile& pile, std::size_t most) {
        const std::lock_guard lock(mutex_);
        piles_[k].move_to(pile, most);
        if (pile.height == 0) pile.put(slabs_.cut(std::size_t{1} << k));
    }

  private:
    std::mutex mutex_;
    Piles piles_;
    Slabs slabs_;
};

constexpr std::size_t some = 32;  ///< blocks are moved between a thread and the depot at a time

struct OwnPiles : Piles {
    OwnPiles() : Piles{} {}
    OwnPiles(const OwnPiles&) = delete;
    ~OwnPiles() {
        for (std::size_t k = 0; k < size(); ++k) Depot::shared().move_from(k, (*this)[k], SIZE_MAX);
    }
};
thread_local OwnPiles own;

}  // namespace

void* take_scratch(std::size_t bytes) {
    const std::size_t k = size_class(bytes);
    if (own[k].height == 0) Depot::shared().move_to(k, own[k], some);
    void* const memory = own[k].take();
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
