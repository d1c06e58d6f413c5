#pragma once
#include <cstdint>
#include <string_view>

namespace carom {

/// FNV-1a, 64 bits; of pieces one after another if the hash of those before is given.
inline std::uint64_t fnv(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325u) {
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return hash;
}

}  // namespace carom
