#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <carom/output.hpp>
#include <cerrno>
#include <system_error>

#include "output/signals.hpp"

namespace carom {
namespace {

constexpr std::size_t block = std::size_t{1} << 18;

std::string reason(int error) { return std::generic_category().message(error); }

}  // namespace

File::File(const std::filesystem::path& target) : target_(target) {
    if (target.empty()) fail(ENOENT);
    struct stat status {};
    if (::stat(target.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode)) fail(EISDIR);
        // Renaming would ask only for permission to change the directory: a write-protected file is protected.
        if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) fail(errno);
        direct_ = !S_ISREG(status.st_mode);
    }
    open();
    // What replaces a file may be read by those who could read it before.
    if (!direct_ && S_ISREG(status.st_mode)) static_cast<void>(::fchmod(descriptor_, status.st_mode & 07777));
}

void File::open() {
    if (direct_) {
        temporary_ = target_;
        descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) fail(errno);
        return;
    }
    // A link stays a link: what it points at is replaced. Absolute, for the program may change its directory.
    std::error_code error;
    destination_ = std::filesystem::weakly_canonical(std::filesystem::absolute(target_, error), error);
    if (error) fail(error.value());
    for (int attempt = 0;; ++attempt) {
        const auto name = fmt::format("{}.{}-{}.tmp", destination_.string(), ::getpid(), attempt);
        descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0) {
            temporary_ = name;
            return;
        }
        if (errno != EEXIST) fail(errno);
    }
}

File::File(File&& other) noexcept
    : target_(std::move(other.target_)),
      destination_(std::move(other.destination_)),
      temporary_(std::move(other.temporary_)),
      buffer_(std::move(other.buffer_)),
      descriptor_(other.descriptor_),
      direct_(other.direct_) {
    other.descriptor_ = -1;
}

File::~File() { discard(); }

void File::write(std::string_view bytes) {
    if (descriptor_ < 0) fail(EBADF);
    buffer_.append(bytes);
    if (buffer_.size() >= block) flush();
}

void File::flush() {
    const QuietWrites quiet;
    std::string_view left = buffer_;
    while (!left.empty()) {
        const auto count = ::write(descriptor_, left.data(), left.size());
        if (count >= 0) {
            left.remove_prefix(static_cast<std::size_t>(count));
        } else if (errno != EINTR) {
            fail(errno);
        }
    }
    buffer_.clear();
}

void File::commit() {
    if (descriptor_ < 0) fail(EBADF);
    flush();
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    // A file on another machine may report a full disk only now.
    std::error_code error;
    if (closed != 0) {
        error = {errno, std::generic_category()};
    } else if (!direct_) {
        std::filesystem::rename(temporary_, destination_, error);
    }
    if (!error) return;
    if (!direct_) ::unlink(temporary_.c_str());
    fail(error.value());
}

void File::discard() noexcept {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    descriptor_ = -1;
    if (!direct_) ::unlink(temporary_.c_str());
}

void File::fail(int error) {
    discard();
    throw Error(
        fmt::format("cannot write {}: {}", target_.empty() ? "a file without a name" : target_.string(), reason(error)),
        Error::Cause::run);
}

}  // namespace carom
