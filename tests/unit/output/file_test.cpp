#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "helpers.hpp"

namespace carom {
namespace {

using Files = OutputTest;

TEST_F(Files, AppearWhenTheyAreWhole) {
    File file(path("a.txt"));
    file.write("half ");
    EXPECT_FALSE(std::filesystem::exists(path("a.txt")));
    file.write("and half");
    file.commit();
    EXPECT_EQ(contents(path("a.txt")), "half and half");
    EXPECT_EQ(files().size(), 1u) << "a temporary is left";
}

TEST_F(Files, WithoutCommitLeaveTheOldFileAndNothingElse) {
    std::ofstream(path("a.txt")) << "old";
    {
        File file(path("a.txt"));
        file.write(std::string(1 << 20, 'x'));
    }
    EXPECT_EQ(contents(path("a.txt")), "old");
    EXPECT_EQ(files().size(), 1u);
}

TEST_F(Files, ReplaceTheOldFileAndKeepItsPermissions) {
    std::ofstream(path("a.txt")) << "a longer old text";
    ::chmod(path("a.txt").c_str(), 0640);
    File file(path("a.txt"));
    file.write("new");
    file.commit();
    EXPECT_EQ(contents(path("a.txt")), "new");
    struct stat status {};
    ::stat(path("a.txt").c_str(), &status);
    EXPECT_EQ(status.st_mode & 0777u, 0640u);
}

TEST_F(Files, WriteThroughALinkAndKeepIt) {
    std::ofstream(path("real.txt")) << "old";
    std::filesystem::create_symlink("real.txt", path("link.txt"));
    File file(path("link.txt"));
    file.write("new");
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(path("link.txt")));
    EXPECT_EQ(contents(path("real.txt")), "new");
}

TEST_F(Files, ReachTheirPlaceThoughTheProgramGoesElsewhere) {
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder_);
    File file("a.txt");
    file.write("here");
    std::filesystem::current_path(before);
    file.commit();
    EXPECT_EQ(contents(path("a.txt")), "here");
}

TEST_F(Files, SayThatTheDirectoryIsMissing) {
    const auto words = error_of([&] { File file(path("no/where/a.txt")); });
    EXPECT_CONTAINS(words, path("no/where/a.txt").string());
    EXPECT_CONTAINS(words, "No such file or directory");
}

TEST_F(Files, SayThatTheTargetIsADirectory) {
    EXPECT_CONTAINS(error_of([&] { File file(folder_); }), "Is a directory");
    EXPECT_CONTAINS(error_of([] { File file(""); }), "a file without a name");
}

// Root may write everywhere, so the test becomes nobody for a while.
class Nobody {
  public:
    Nobody() : root_(::geteuid() == 0 && ::seteuid(65534) == 0) {}
    ~Nobody() {
        if (root_ && ::seteuid(0) != 0) ADD_FAILURE() << "cannot become root again";
    }

  private:
    bool root_;
};

TEST_F(Files, SayThatPermissionIsMissing) {
    ::chmod(folder_.c_str(), 0555);
    {
        const Nobody nobody;
        const auto words = error_of([&] { File file(path("a.txt")); });
        EXPECT_CONTAINS(words, path("a.txt").string());
        EXPECT_CONTAINS(words, "Permission denied");
    }
    ::chmod(folder_.c_str(), 0755);
    EXPECT_TRUE(files().empty());
}

TEST_F(Files, LeaveAWriteProtectedFileAlone) {
    std::ofstream(path("a.txt")) << "old";
    ::chmod(path("a.txt").c_str(), 0444);
    ::chmod(folder_.c_str(), 0777);  // where a new name could be put
    const Nobody nobody;
    EXPECT_CONTAINS(error_of([&] { File file(path("a.txt")); }), "Permission denied");
    EXPECT_EQ(contents(path("a.txt")), "old");
}

TEST_F(Files, SayThatTheDiskIsFull) {
    make_full_device(path("full"));
    const auto words = error_of([&] {
        File file(path("full"));
        file.write("anything");
        file.commit();
    });
    EXPECT_CONTAINS(words, path("full").string());
    EXPECT_CONTAINS(words, "No space left on device");
    EXPECT_TRUE(std::filesystem::is_character_file(path("full"))) << "the device was replaced by a file";
}

// A limit on the size of files stands for a disk that fills up; by default it would kill the process.
class SmallDisk {
  public:
    explicit SmallDisk(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SmallDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

  private:
    rlimit before_{};
};

TEST_F(Files, LeaveNothingWhenTheDiskFillsUp) {
    std::ofstream(path("a.txt")) << "old";
    {
        const SmallDisk disk(1 << 20);
        File file(path("a.txt"));
        const auto words = error_of([&] {
            for (int i = 0; i < 64; ++i) file.write(std::string(1 << 16, 'x'));
        });
        EXPECT_CONTAINS(words, path("a.txt").string());
        EXPECT_CONTAINS(words, "File too large");
        error_of([&] { file.write("more"); });
        error_of([&] { file.commit(); });
        EXPECT_EQ(files().size(), 1u) << "the temporary is left while its File lives";
    }
    EXPECT_EQ(contents(path("a.txt")), "old");
    sigset_t pending;
    ::sigpending(&pending);
    EXPECT_EQ(::sigismember(&pending, SIGXFSZ), 0) << "a signal still waits";
}

TEST_F(Files, LastBlockIsCheckedToo) {
    const SmallDisk disk(16);
    File file(path("a.txt"));
    file.write("seventeen letters and more");
    error_of([&] { file.commit(); });
    EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace carom
