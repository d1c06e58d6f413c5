#include "output/unfinished.hpp"

#include <unistd.h>

#include <carom/output.hpp>
#include <csignal>
#include <cstring>

namespace carom {

namespace {

/// Files are opened and closed by one thread at a time; a handler may come at any moment, and on any thread. So a path
/// is written while its place is marked as empty.
struct Place {
    volatile std::sig_atomic_t taken = 0;
    char path[4096];
};
Place places[64];

}  // namespace

int list_unfinished(const std::string& file) {
    int at = 0;
    for (Place& place : places) {
        if (place.taken == 0 && file.size() < sizeof place.path) {
            std::memcpy(place.path, file.c_str(), file.size() + 1);
            place.taken = 1;
            return at;
        }
        ++at;
    }
    return -1;
}

void unlist_unfinished(int place) {
    if (place >= 0) places[place].taken = 0;
}

void remove_unfinished() noexcept {
    for (const Place& place : places)
        if (place.taken != 0) ::unlink(place.path);
}

}  // namespace carom
