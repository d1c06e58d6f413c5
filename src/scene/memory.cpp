#include "scene/memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>

namespace carom {

namespace {

// Measured: a body takes 190 bytes in the world and twice as much while the integrator works; a document of nlohmann's
// takes up to 25 bytes for one in the file.
constexpr double bytes_per_body = 600, bytes_per_byte = 25;

double available_bytes() {
    double bytes = 1e18;
    std::ifstream info("/proc/meminfo");
    for (std::string word; info >> word;)
        if (double kilobytes = 0; word == "MemAvailable:" && info >> kilobytes) bytes = kilobytes * 1024;
    if (rlimit limit{}; getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
    return bytes;
}

void require(double bytes, const std::string& what, const Place& place) {
    const double there = available_bytes();
    if (bytes > there)
        throw place.error(
            fmt::format("needs about {:.3g} GB for {}, and {:.3g} GB are free", bytes / 1e9, what, there / 1e9));
}

}  // namespace

void require_memory_for(double bodies, const Place& place) {
    require(bodies * bytes_per_body, fmt::format("{:.0f} bodies", bodies), place);
}

void require_memory_for_text(double bytes, const Place& place) {
    require(bytes * bytes_per_byte, fmt::format("a document of {:.0f} bytes", bytes), place);
}

}  // namespace carom
