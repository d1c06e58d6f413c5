#pragma once
// Sixteen numbers of sixteen bits at once, which every processor compares eight at a time.

#include <cstdint>

namespace carom {

using Shorts = std::int16_t __attribute__((vector_size(32)));

inline void take_in(const Shorts& own, Shorts& least, Shorts& most) {
    least = own < least ? own : least, most = own > most ? own : most;
}

}  // namespace carom
