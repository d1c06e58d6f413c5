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

struct Program {
    volatile std::sig_atomic_t process = 0;  ///< none
    volatile std::sig_atomic_t draws = 0;
};
Program programs[64];
volatile std::sig_atomic_t interrupted = 0;

void end_programs(bool all) {
    for (const Program& program : programs)
        if (program.process != 0 && (all || program.draws != 0)) ::kill(-program.process, SIGKILL);  // its group
}

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

int list_program(int process, bool draws) {
    int at = 0;
    for (Program& program : programs) {
        if (program.process == 0) {
            program.draws = draws ? 1 : 0;
            program.process = process;
            return at;
        }
        ++at;
    }
    return -1;
}

void unlist_program(int place) {
    if (place >= 0) programs[place].process = 0;
}

bool figures_were_interrupted() { return interrupted != 0; }

void interrupt_figures() noexcept {
    interrupted = 1;
    end_programs(false);
}

void remove_unfinished() noexcept {
    end_programs(true);  // first: they write to these files
    for (const Entry& entry : entries)
        if (entry.taken != 0) ::unlink(entry.path);
}

}  // namespace carom
