#pragma once
// What a checkpoint holds of a world, and another world that goes on from there.

#include <carom/carom.hpp>
#include <string>

namespace carom::test {

inline std::string saved(const World& world) {
    std::string bytes;
    Saver to([&](std::string_view more) { bytes += more; });
    world.save(to);
    return bytes;
}

/// Makes another world what this one is, by what a checkpoint holds.
inline void restore_from(const World& world, World& other) {
    const std::string bytes = saved(world);
    Loader from(bytes);
    other.restore(from);
}

}  // namespace carom::test
