#pragma once
// What a loop does that waits for another thread.

namespace carom {

/// Tells the processor so: it saves energy, and leaves more to a thread that shares the core.
inline void pause() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

}  // namespace carom
