#pragma once
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <carom/output.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace carom {

/// A folder of its own, gone after the test.
class OutputTest : public ::testing::Test {
  protected:
    OutputTest() {
        std::string name = (std::filesystem::temp_directory_path() / "carom-output-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    ~OutputTest() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
            names.push_back(entry.path().filename().string());
        }
        return names;
    }
    std::filesystem::path folder_;
};

/// Makes `path` a device that is always full. For root, who could replace it by mistake, not the machine's own one.
inline void make_full_device(const std::filesystem::path& path) {
    if (::mknod(path.c_str(), S_IFCHR | 0666, ::makedev(1, 7)) == 0) {
        if (std::ofstream test(path); test.is_open()) return;  // not so where the folder allows no devices
        std::filesystem::remove(path);
    }
    if (::geteuid() == 0) GTEST_SKIP() << "no safe full device for root here";
    std::filesystem::create_symlink("/dev/full", path);
}

inline std::string contents(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream all;
    all << file.rdbuf();
    return all.str();
}

inline std::string output_of(const std::string& command) {
    std::string all;
    std::FILE* pipe = ::popen(command.c_str(), "r");
    for (int c; (c = std::fgetc(pipe)) != EOF;) all += static_cast<char>(c);
    return ::pclose(pipe) == 0 ? all : "failed: " + all;
}

/// Pixels of a PNG, read by ffmpeg.
struct Pixels {
    explicit Pixels(const std::filesystem::path& path) {
        const auto size = output_of("ffprobe -v error -show_entries stream=width -of csv=p=0 " + path.string());
        width = std::stoul(size);
        bytes = output_of("ffmpeg -v error -i " + path.string() + " -f rawvideo -pix_fmt rgb24 -");
    }
    std::size_t count(Colour c) const {
        std::size_t n = 0;
        for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) n += is(i, c);
        return n;
    }
    /// Smallest and largest x and y with that colour.
    std::array<double, 4> extent(Colour c) const {
        std::array<double, 4> all{1e9, -1e9, 1e9, -1e9};
        for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
            if (!is(i, c)) continue;
            const double x = static_cast<double>(i / 3 % width), y = static_cast<double>(i / 3 / width);
            all = {std::min(all[0], x), std::max(all[1], x), std::min(all[2], y), std::max(all[3], y)};
        }
        return all;
    }
    bool is(std::size_t i, Colour c) const {
        const auto near = [](char byte, int part) { return std::abs(static_cast<unsigned char>(byte) - part) < 3; };
        return near(bytes[i], c.r) && near(bytes[i + 1], c.g) && near(bytes[i + 2], c.b);
    }
    Colour at(double x, double y) const {
        const auto i = 3 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x));
        const auto part = [&](std::size_t k) { return static_cast<std::uint8_t>(bytes[i + k]); };
        return {part(0), part(1), part(2), 255};
    }
    std::size_t width = 0;
    std::string bytes;
};

/// What the Error says that `act` ends with.
template <class Act>
std::string error_of(Act&& act, Error::Cause cause = Error::Cause::run) {
    try {
        act();
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), cause) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "more than one line: " << error.what();
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}

inline ::testing::AssertionResult contains(const char*, const char*, const std::string& text, const std::string& part) {
    if (text.find(part) != text.npos) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << '"' << part << "\" is not in: " << text.substr(0, 400);
}
#define EXPECT_CONTAINS(text, part) EXPECT_PRED_FORMAT2(contains, text, part)

/// PATH is `value` while it lives.
class WithPath {
  public:
    explicit WithPath(const std::string& value) : before_(::getenv("PATH")) { ::setenv("PATH", value.c_str(), 1); }
    ~WithPath() { ::setenv("PATH", before_.c_str(), 1); }

  private:
    std::string before_;
};

}  // namespace carom
