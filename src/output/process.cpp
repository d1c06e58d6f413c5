#include "output/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <carom/error.hpp>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "output/signals.hpp"
#include "output/unfinished.hpp"

extern char** environ;

namespace carom {
namespace {

struct Ends {
    int read = -1, write = -1;
};

// Neither end is for children that the program starts elsewhere.
bool make_pipe(Ends& ends) {
    std::array<int, 2> both{};
    if (::pipe(both.data()) != 0) return false;
    for (int end : both) ::fcntl(end, F_SETFD, FD_CLOEXEC);
    ends = {both[0], both[1]};
    return true;
}

void close_end(int& descriptor) {
    if (descriptor >= 0) ::close(descriptor);
    descriptor = -1;
}

}  // namespace

std::string reason(int error) { return std::generic_category().message(error); }

Process::Process(const std::string& name, std::string purpose)
    : name_(name), purpose_(std::move(purpose)), errors_(std::tmpfile()) {}

// By way of the other constructor, so that the destructor cleans up if the program cannot be started.
Process::Process(const std::vector<std::string>& arguments, std::string purpose, Output output)
    : Process(arguments.front(), std::move(purpose)) {
    start(arguments, output);
}

void Process::start(const std::vector<std::string>& arguments, Output output) {
    Ends in, out;
    if (!make_pipe(in)) fail(reason(errno));
    input_ = in.write;
    if (output == Output::keep) {
        if (!make_pipe(out)) {
            const int error = errno;
            ::close(in.read);
            fail(reason(error));
        }
        output_ = out.read;
    }
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, in.read, 0);
    if (output == Output::keep) {
        posix_spawn_file_actions_adddup2(&files, out.write, 1);
    } else {
        posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
    }
    // A file and not a pipe, which could fill up while nobody reads it.
    if (errors_) {
        posix_spawn_file_actions_adddup2(&files, ::fileno(errors_), 2);
    } else {
        posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0);
    }
    std::vector<char*> words;
    for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    // In a group of its own: Ctrl-C on a terminal is for the program, which ends its own way what it has begun.
    posix_spawnattr_t group;
    posix_spawnattr_init(&group);
    posix_spawnattr_setflags(&group, POSIX_SPAWN_SETPGROUP);
    const int error = ::posix_spawnp(&child_, words[0], &files, &group, words.data(), environ);
    posix_spawnattr_destroy(&group);
    posix_spawn_file_actions_destroy(&files);
    close_end(in.read);
    close_end(out.write);
    draws_ = output == Output::keep;
    if (error == 0) listed_ = list_program(child_, draws_);
    if (error == 0) return;
    child_ = -1;
    fail(error == ENOENT ? "it is not installed (or not in PATH)" : reason(error));
}

Process::~Process() {
    close_end(input_);
    close_end(output_);
    if (child_ > 0) {
        ::kill(child_, SIGKILL);
        int status = 0;
        reap(status);
    }
    if (errors_) std::fclose(errors_);
}

void Process::write(std::string_view bytes) {
    const QuietWrites quiet;
    while (!bytes.empty()) {
        const auto count = ::write(input_, bytes.data(), bytes.size());
        if (count >= 0) {
            bytes.remove_prefix(static_cast<std::size_t>(count));
        } else if (errno != EINTR) {
            const int error = errno;
            if (error == EPIPE) finish();  // it ended early: its own words say more
            fail(reason(error));
        }
    }
}

std::string Process::filter(std::string_view input) {
    const QuietWrites quiet;
    ::fcntl(input_, F_SETFL, O_NONBLOCK);
    std::string answer;
    std::array<char, 1 << 16> part;
    for (bool open = true; open;) {
        if (input.empty()) close_end(input_);
        std::array<pollfd, 2> ends{pollfd{output_, POLLIN, 0}, pollfd{input_, POLLOUT, 0}};
        if (::poll(ends.data(), ends.size(), -1) < 0 && errno != EINTR) fail(reason(errno));
        if (ends[1].revents != 0) {
            const auto count = ::write(input_, input.data(), input.size());
            if (count >= 0) {
                input.remove_prefix(static_cast<std::size_t>(count));
            } else if (errno == EPIPE) {
                input = {};  // it has ended; finish() says whether that is an error
            }
        }
        if (ends[0].revents != 0) {
            const auto count = ::read(output_, part.data(), part.size());
            if (count > 0) answer.append(part.data(), static_cast<std::size_t>(count));
            open = count > 0 || (count < 0 && errno == EINTR);
        }
    }
    finish();
    return answer;
}

/// It keeps its number until it is off the list: who gets that next is not to be ended.
void Process::reap(int& status) {
    siginfo_t ended;
    while (::waitid(P_PID, static_cast<id_t>(child_), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    unlist_program(std::exchange(listed_, -1));
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
}

void Process::finish() {
    close_end(input_);
    if (child_ <= 0) return;
    int status = 0;
    reap(status);
    if (WIFSIGNALED(status) && draws_ && figures_were_interrupted())
        throw Error(fmt::format("interrupted while {} drew", name_), Error::Cause::run);
    if (WIFSIGNALED(status)) fail(::strsignal(WTERMSIG(status)));
    if (WEXITSTATUS(status) != 0) fail(complaint());
}

// What it wrote, in one line; of a long story the end.
std::string Process::complaint() {
    std::string said, line;
    const auto end_line = [&] {
        const auto start = line.find_first_not_of(" ^\t");
        if (start != line.npos) said += (said.empty() ? "" : "; ") + line.substr(start);
        line.clear();
    };
    if (errors_) {
        std::rewind(errors_);
        for (int c; (c = std::fgetc(errors_)) != EOF;) {
            if (c == '\n' || c == '\r')
                end_line();
            else
                line += static_cast<char>(c);
        }
        end_line();
    }
    constexpr std::size_t longest = 300;
    if (said.size() > longest) return "… " + said.substr(said.size() - longest);
    return said.empty() ? "it gave no reason" : said;
}

void Process::fail(const std::string& why) {
    throw Error(fmt::format("{} failed, which {} need: {}", name_, purpose_, why), Error::Cause::run);
}

}  // namespace carom
