#include "output/unfinished.hpp"

#include <unistd.h>

#include <carom/output.hpp>
#include <csignal>
#include <cstring>

namespace carom {

namespace {

/// Files are opened and closed by one thread at a time; a handler may come at any moment, and on any thread. So a path
/// is written while its entry is marked as empty.
struct Entry {
    volatile std::sig_atomic_t taken = 0;
    char path[4096];
};
Entry entries[64];

}  // namespace

int list_unfinished(const std::string& file) {
    int at = 0;
    for (Entry& entry : entries) {
        if (entry.taken == 0 && file.size() < sizeof entry.path) {
            std::memcpy(entry.path, file.c_str(), file.size() + 1);
            entry.taken = 1;
            return at;
        }
        ++at;
    }
    return -1;
}

void unlist_unfinished(int place) {
    if (place >= 0) entries[place].taken = 0;
}

void remove_unfinished() noexcept {
    for (const Entry& entry : entries)
        if (entry.taken != 0) ::unlink(entry.path);
}

}  // namespace carom
