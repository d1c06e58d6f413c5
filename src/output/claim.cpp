#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <carom/output.hpp>
#include <cerrno>

#include "output/unfinished.hpp"

namespace carom {

namespace {

/// Whether a path still leads to the file that is open: who had locked it before may have removed it since.
bool leads_to(const std::filesystem::path& path, int descriptor) {
    struct stat there {
    }, open{};
    return ::stat(path.c_str(), &there) == 0 && ::fstat(descriptor, &open) == 0 && there.st_ino == open.st_ino &&
           there.st_dev == open.st_dev;
}

bool is_empty(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_size == 0;
}

/// Locks a whole file; false if another process has. Not by flock(2): a child that is on its way to become gnuplot when
/// this process is killed would hold that a little longer.
bool take(int descriptor) {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    return ::fcntl(descriptor, F_SETLK, &lock) == 0 || (errno != EACCES && errno != EAGAIN);
}

}  // namespace

std::filesystem::path checkpoint_lock(const std::filesystem::path& checkpoint) {
    // One lock for all the names of a checkpoint.
    std::error_code error;
    const auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(checkpoint, error), error);
    return (error ? checkpoint : place).string() + ".lock";
}

CheckpointClaim::CheckpointClaim(const std::filesystem::path& checkpoint) : file_(checkpoint_lock(checkpoint)) {
    for (;;) {
        descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0) return;  // what is wrong there says who writes the checkpoint
        const bool is_ours = is_empty(descriptor_);
        const bool is_held = is_ours && !take(descriptor_);
        if (is_ours && !is_held && leads_to(file_, descriptor_)) break;
        ::close(descriptor_);
        descriptor_ = -1;
        if (!is_ours) throw Error(fmt::format("{} is no lock of Carom's and would be removed", file_.string()));
        if (is_held) throw Error(fmt::format("{} is being written by another process", checkpoint.string()));
    }
    listed_ = list_unfinished(file_.string());
}

CheckpointClaim::~CheckpointClaim() {
    if (descriptor_ < 0) return;
    ::unlink(file_.c_str());  // before it is unlocked: later it may be another's
    unlist_unfinished(listed_);
    ::close(descriptor_);
}

}  // namespace carom
