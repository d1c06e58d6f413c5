#pragma once
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// What the system says of an errno.
std::string reason(int error);

/// Another program (gnuplot, ffmpeg) that is fed through its standard input. Its complaints become Errors.
class Process {
  public:
    enum class Output { none, keep };
    /// Starts arguments[0], found by PATH. `purpose` says in the Error what it was wanted for.
    Process(const std::vector<std::string>& arguments, std::string purpose, Output output = Output::none);
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    /// Without finish(): ends the program.
    ~Process();

    void write(std::string_view bytes);
    /// Writes all of `input` and reads what the program answers, both at a time so that neither waits for the other.
    std::string filter(std::string_view input);
    /// Closes its input and waits for its end; an Error if it failed, or was interrupted.
    void finish();

  private:
    Process(const std::string& name, std::string purpose);
    void start(const std::vector<std::string>& arguments, Output output);
    [[noreturn]] void fail(const std::string& why);
    std::string complaint();
    std::string name_, purpose_;
    void reap(int& status);
    int child_ = -1, input_ = -1, output_ = -1;
    int listed_ = -1;  ///< where, among the programs that a signal ends
    bool draws_ = false;
    std::FILE* errors_ = nullptr;
};

}  // namespace carom
