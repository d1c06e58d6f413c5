#pragma once
#include <stdexcept>
#include <string>

namespace carom {

/// Wrong input or a failed run, in one line: which field, its value, what is allowed, the unit.
class Error : public std::runtime_error {
  public:
    enum class Cause {
        input,  ///< what was asked for makes no sense: the program's exit status 2
        run     ///< the run itself failed: exit status 1
    };
    explicit Error(const std::string& what, Cause cause = Cause::input) : std::runtime_error(what), cause_(cause) {}
    Cause cause() const { return cause_; }

  private:
    Cause cause_;
};

}  // namespace carom
