#include "scene/memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace carom {

namespace {

// Measured (tests/e2e/cli/memory_test.py): the peak of `carom run` with rk4, which keeps the world of the start and
// four stages beside the world; the document of a list of zeros.
constexpr double bytes_per_body = 900, bytes_per_name = 350, bytes_per_spring = 300, bytes_per_byte = 30;

double number_in(const char* file, double otherwise) {
    double number = 0;
    return std::ifstream(file) >> number ? number : otherwise;
}

/// The number in a line "name 123" of a file of Linux's.
double number_in(const char* file, const std::string& name, double otherwise) {
    std::ifstream lines(file);
    for (std::string word; lines >> word;)
        if (double number = 0; word == name && lines >> number) return number;
    return otherwise;
}

/// What the machine, its container, a limit of the shell and the user leave to this process.
double available_bytes() {
    constexpr double plenty = 1e18;
    constexpr double kB = 1024;
    double bytes = kB * number_in("/proc/meminfo", "MemAvailable:", plenty / kB);
    const double container = number_in("/sys/fs/cgroup/memory.max", plenty);  // "max" is no number
    // What is kept of files that nobody reads any more is given back for the asking.
    bytes = std::min(bytes, container - number_in("/sys/fs/cgroup/memory.current", 0) +
                                number_in("/sys/fs/cgroup/memory.stat", "inactive_file", 0));
    if (rlimit limit{}; getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        bytes =
            std::min(bytes, static_cast<double>(limit.rlim_cur) - kB * number_in("/proc/self/status", "VmSize:", 0));
    if (const char* wish = std::getenv("CAROM_MEMORY")) bytes = std::min(bytes, std::strtod(wish, nullptr));
    return std::max(bytes, 0.0);
}

void require(double bytes, const std::string& what, const Place& place) {
    const double there = available_bytes();
    if (bytes > there)
        throw place.error(
            fmt::format("needs about {:.3g} GB for {}, and {:.3g} GB are free", bytes / 1e9, what, there / 1e9));
}

}  // namespace

void require_memory_for(const Amount& a, const Place& place) {
    const double bytes = a.bodies * (bytes_per_body + (a.named ? bytes_per_name : 0)) + a.springs * bytes_per_spring;
    require(
        bytes,
        fmt::format("{:.15g} bodies{}", a.bodies, a.springs > 0 ? fmt::format(" and {:.15g} springs", a.springs) : ""),
        place);
}

void require_memory_for_text(double bytes, const Place& place) {
    require(bytes * bytes_per_byte, fmt::format("a document of {:.0f} bytes", bytes), place);
}

}  // namespace carom
