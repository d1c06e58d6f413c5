#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <carom/output.hpp>
#include <cmath>

namespace carom {
namespace {

std::string duration(double seconds) {
    const auto s = static_cast<long long>(seconds + 0.5);
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
    return fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

std::string per_second(double rate, const std::string& unit) {
    if (rate >= 1e6) return fmt::format("{:.1f} M {}/s", rate / 1e6, unit);
    if (rate >= 1e4) return fmt::format("{:.0f} k {}/s", rate / 1e3, unit);
    return fmt::format("{:.3g} {}/s", rate, unit);
}

int terminal_width(int descriptor) {
    winsize size{};
    return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// Nobody is served by a run that fails because its progress cannot be shown.
void print(int descriptor, const std::string& text) {
    static_cast<void>(!::write(descriptor, text.data(), text.size()));
}

}  // namespace

Progress::Progress(std::uint64_t total, std::string label, int descriptor, std::string unit)
    : total_(total),
      label_(std::move(label)),
      unit_(std::move(unit)),
      descriptor_(descriptor),
      terminal_(::isatty(descriptor) == 1),
      start_(Clock::now()),
      next_(start_ + std::chrono::seconds(1)) {}

void Progress::update(std::uint64_t done) {
    if (!terminal_) return;
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(100);
    show(std::min(done, total_), now);
}

void Progress::show(std::uint64_t done, Clock::time_point now) {
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double part = total_ == 0 ? 1 : static_cast<double>(done) / static_cast<double>(total_);
    const double rate = static_cast<double>(done) / elapsed;
    const auto left = done == 0 ? std::string("?") : duration(elapsed * (1 - part) / part);
    const auto head = fmt::format("{} {:3.0f} % ", label_, std::floor(100 * part));
    const auto tail = fmt::format(" {}, {} left", per_second(rate, unit_), left);
    const int room = terminal_width(descriptor_) - static_cast<int>(head.size() + tail.size()) - 3;
    std::string bar;
    if (room >= 5) {
        const int width = std::min(room, 40), full = static_cast<int>(part * width);
        bar = fmt::format("[{:#<{}}{:.<{}}]", "", full, "", width - full);
    }
    // To the line's start, and what an earlier, longer line left is cleared.
    print(descriptor_, "\r" + head + bar + tail + "\x1b[K");
    shown_ = true;
}

void Progress::finish() {
    if (shown_) print(descriptor_, "\r\x1b[K");
    shown_ = terminal_ = false;
}

}  // namespace carom
