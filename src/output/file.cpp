#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <carom/output.hpp>
#include <cerrno>
#include <system_error>

#include "output/fnv.hpp"
#include "output/process.hpp"
#include "output/signals.hpp"
#include "output/unfinished.hpp"

namespace carom {
namespace {

constexpr std::size_t block = std::size_t{1} << 18;

/// The last bytes of so many, which no other file has.
constexpr std::uint64_t tail_size = 1 << 16;

/// A name is on the disk when its folder is.
void sync_folder_of(const std::filesystem::path& file) {
    const int folder = ::open(file.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    ::fsync(folder);
    ::close(folder);
}

}  // namespace

File::File(const std::filesystem::path& target, const std::filesystem::path& temporary)
    : target_(target), temporary_(temporary) {
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
    open_temporary();
}

void File::open_temporary() {
    // A link stays a link: what it points at is replaced. Absolute, for the program may change its directory.
    std::error_code error;
    destination_ = std::filesystem::weakly_canonical(std::filesystem::absolute(target_, error), error);
    if (error) fail(error.value());
    for (int attempt = 0; temporary_.empty(); ++attempt) {
        const auto name = fmt::format("{}.{}-{}.tmp", destination_.string(), ::getpid(), attempt);
        descriptor_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0) {
            temporary_ = name;
            listed_ = list_unfinished(name);
            ::flock(descriptor_, LOCK_EX | LOCK_NB);  // as long as this process writes, no other goes on with it
            return;
        }
        if (errno != EEXIST) fail(errno);
    }
    descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(errno);
    listed_ = list_unfinished(temporary_.string());
}

File::File(File&& other) noexcept
    : target_(std::move(other.target_)),
      destination_(std::move(other.destination_)),
      temporary_(std::move(other.temporary_)),
      superseded_(std::move(other.superseded_)),
      buffer_(std::move(other.buffer_)),
      descriptor_(other.descriptor_),
      direct_(other.direct_),
      kept_(other.kept_),
      listed_(other.listed_) {
    other.descriptor_ = other.listed_ = -1;
}

File::~File() { discard(); }

void File::unlist() {
    unlist_unfinished(listed_);
    listed_ = -1;
}

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
        if (kept_) sync_folder_of(destination_);
    }
    if (error && !direct_ && !kept_) ::unlink(temporary_.c_str());
    unlist();
    if (!error && !superseded_.empty()) ::unlink(superseded_.c_str());
    if (!error) return;
    fail(error.value());
}

void File::discard() noexcept {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    descriptor_ = -1;
    if (!direct_ && !kept_) ::unlink(temporary_.c_str());
    unlist();
}

void File::fail(int error) {
    discard();
    throw Error(
        fmt::format("cannot write {}: {}", target_.empty() ? "a file without a name" : target_.string(), reason(error)),
        Error::Cause::run);
}

// ---- Bookmarks ------------------------------------------------------------------------------------------------------

Bookmark File::sync() {
    if (descriptor_ < 0) fail(EBADF);
    flush();
    if (direct_) throw Error(fmt::format("{} is no ordinary file, and no run can go on with it", target_.string()));
    if (::fsync(descriptor_) != 0) fail(errno);
    sync_folder_of(destination_);
    kept_ = true;
    unlist();
    const auto length = static_cast<std::uint64_t>(::lseek(descriptor_, 0, SEEK_CUR));
    return {destination_.string(), temporary_.string(), length, tail(length)};
}

std::uint64_t File::tail(std::uint64_t length) {
    std::string bytes(std::min(length, tail_size), '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
        const auto at = static_cast<off_t>(length - bytes.size() + done);
        const auto count = ::pread(descriptor_, bytes.data() + done, bytes.size() - done, at);
        if (count <= 0 && !(count < 0 && errno == EINTR)) fail(count < 0 ? errno : EIO);
        if (count > 0) done += static_cast<std::size_t>(count);
    }
    return fnv(bytes);
}

File::File(const Bookmark& bookmark, const Revision& revision)
    : target_(bookmark.target), destination_(bookmark.target) {
    const bool unfinished = reopen(bookmark, bookmark.temporary), revised = revision.before != revision.after;
    if (unfinished) take_over();
    if (unfinished && !revised) {
        go_on_in(bookmark);
        return;
    }
    // It has got its name since, and keeps what stands there until the run that goes on is at its end.
    if (!unfinished && !reopen(bookmark, destination_))
        throw Error(fmt::format("the data of {} are not where the checkpoint left them: neither {} nor the file itself",
                                destination_.string(), bookmark.temporary));
    const int source = descriptor_;
    if (unfinished) superseded_ = bookmark.temporary;
    if (!revised) temporary_ = bookmark.temporary;  // else nobody is to take this for what was bookmarked
    open_temporary();
    copy_from(source, bookmark.length, revision);
    ::close(source);
}

/// An unfinished file that nobody else writes.
void File::take_over() {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    ::close(descriptor_);
    throw Error(fmt::format("the data of {} are being written by another process", destination_.string()));
}

void File::go_on_in(const Bookmark& bookmark) {
    temporary_ = bookmark.temporary;
    kept_ = true;
    if (::ftruncate(descriptor_, static_cast<off_t>(bookmark.length)) != 0) fail(errno);
    if (::lseek(descriptor_, 0, SEEK_END) < 0) fail(errno);
}

/// Opens the file if it is the one that was bookmarked.
bool File::reopen(const Bookmark& bookmark, const std::filesystem::path& path) {
    struct stat status {};
    descriptor_ = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor_ >= 0 && ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode) &&
        static_cast<std::uint64_t>(status.st_size) >= bookmark.length && tail(bookmark.length) == bookmark.tail)
        return true;
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
    return false;
}

void File::copy_from(int source, std::uint64_t length, const Revision& revision) {
    std::string bytes = revised_start(source, length, revision);
    write(bytes);
    bytes.resize(block);
    while (length > 0) {
        const auto count = ::read(source, bytes.data(), std::min<std::uint64_t>(block, length));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail(count < 0 ? errno : EIO);
        write(std::string_view(bytes).substr(0, static_cast<std::size_t>(count)));
        length -= static_cast<std::uint64_t>(count);
    }
    flush();
}

/// The part of the source that is revised, revised; `length` is what is left of it. Empty if nothing is to be.
std::string File::revised_start(int source, std::uint64_t& length, const Revision& revision) {
    if (revision.before == revision.after) return {};
    std::string bytes(std::min<std::uint64_t>(length, block + revision.before.size()), '\0');
    for (std::size_t done = 0; done < bytes.size();) {
        const auto count = ::read(source, bytes.data() + done, bytes.size() - done);
        if (count <= 0 && !(count < 0 && errno == EINTR)) fail(count < 0 ? errno : EIO);
        if (count > 0) done += static_cast<std::size_t>(count);
    }
    length -= bytes.size();
    const std::size_t at = bytes.find(revision.before);
    if (at == bytes.npos) {
        ::close(source);
        discard();
        throw Error(fmt::format("{} does not say of its run what the checkpoint does", destination_.string()));
    }
    return bytes.replace(at, revision.before.size(), revision.after);
}

}  // namespace carom
