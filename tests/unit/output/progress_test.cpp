#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <thread>

#include "helpers.hpp"

namespace carom {
namespace {

/// A terminal of 80 columns, and what was shown on it.
class Terminal {
  public:
    explicit Terminal(unsigned short columns = 80) {
        winsize size{25, columns, 0, 0};
        EXPECT_EQ(::openpty(&screen_, &line_, nullptr, nullptr, &size), 0);
        ::fcntl(screen_, F_SETFL, O_NONBLOCK);
    }
    ~Terminal() {
        ::close(screen_);
        ::close(line_);
    }
    int line() const { return line_; }
    std::string shown() {
        std::array<char, 1 << 16> bytes;
        const auto count = ::read(screen_, bytes.data(), bytes.size());
        return {bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
    }

  private:
    int screen_ = -1, line_ = -1;
};

void pause(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

TEST(ProgressBar, ShortRunsShowNothing) {
    Terminal terminal;
    {
        Progress progress(100, "run", terminal.line());
        for (std::uint64_t i = 0; i <= 100; ++i) progress.update(i);
    }
    EXPECT_EQ(terminal.shown(), "");
}

TEST(ProgressBar, LongRunsShowPercentRateAndTimeLeftAndThenNothing) {
    Terminal terminal;
    Progress progress(4000, "gas", terminal.line());
    pause(1.05);
    progress.update(1000);
    const auto line = terminal.shown();
    EXPECT_CONTAINS(line, "gas");
    EXPECT_CONTAINS(line, " 25 % [##########....");
    EXPECT_CONTAINS(line, " 3 s left");
    const double rate = std::stod(line.substr(line.find(']') + 1));
    EXPECT_GT(rate, 700);
    EXPECT_LT(rate, 955);
    progress.finish();
    EXPECT_EQ(terminal.shown(), "\r\x1b[K");
    progress.finish();
    EXPECT_EQ(terminal.shown(), "") << "cleared twice";
}

TEST(ProgressBar, FitsItsTerminal) {
    Terminal terminal(60);
    Progress progress(10, "a run with a long name", terminal.line());
    pause(1.05);
    progress.update(5);
    const auto line = terminal.shown();
    EXPECT_LT(line.size() - std::string("\r\x1b[K").size(), 60u) << line;
}

TEST(ProgressBar, StaysOutOfFilesAndPipes) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    {
        Progress progress(10, "run", ends[1]);
        pause(1.05);
        progress.update(5);
    }
    char byte;
    EXPECT_LE(::read(ends[0], &byte, 1), 0);
    ::close(ends[0]);
    ::close(ends[1]);
}

}  // namespace
}  // namespace carom
