#pragma once
// Memory asked for before it is needed.

namespace carom {

/// Asks for the cache line at an address. Nothing is computed with it, and the address need not be one of an object.
/// GCC takes a function that does nothing but ask for one without any effect, and leaves out its calls; the empty
/// statement is an effect.
inline void prefetch(const void* address) {
    __builtin_prefetch(address);
    asm volatile("");
}

}  // namespace carom
