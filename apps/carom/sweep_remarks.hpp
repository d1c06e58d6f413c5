#pragma once
// What is said after the last run of a sweep.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "experiment.hpp"
#include "report.hpp"

namespace carom::app {

/// Expectations that were not met, of columns that do not show them: of which values how many.
class Missed {
  public:
    void add(const std::string& value, const Result& result) {
        if (!result.failure.empty()) return;  // which is said
        const auto missed =
            std::count_if(result.verdicts.begin(), result.verdicts.end(), [](const Verdict& v) { return !v.ok; });
        if (missed == 0) return;
        constexpr int most = 5;
        if (++values_ <= most)
            words_ +=
                fmt::format("{}{} of {} for {}", words_.empty() ? "" : ", ", missed, result.verdicts.size(), value);
        else
            more_ = fmt::format(", and of {} values more", values_ - most);
    }
    /// Empty if all were met.
    std::string words() const {
        return words_.empty()
                   ? ""
                   : fmt::format("expectations of the scene were not met: {}{}; --set 'expects=[]' leaves them out",
                                 words_, more_);
    }

  private:
    int values_ = 0;
    std::string words_{}, more_{};
};

/// What is noted of the runs, each kind of it once: of how many runs, and what it says of the first.
class Noted {
  public:
    void add(const std::string& point, const std::vector<Note>& notes) {
        for (const Note& note : notes) {
            auto known = std::find_if(all_.begin(), all_.end(), [&](const One& o) { return o.kind == note.kind; });
            if (known == all_.end()) known = all_.insert(known, {note.kind, 0, point + ": " + note.text});
            ++known->runs;
        }
    }
    std::vector<std::string> words(std::size_t runs) const {
        std::vector<std::string> lines;
        for (const One& o : all_)
            lines.push_back(fmt::format("in {} of {}, first at {}", o.runs, counted(runs, "run", "runs"), o.first));
        return lines;
    }

  private:
    struct One {
        std::string kind;
        std::size_t runs = 0;
        std::string first;  ///< of them, and what is noted of it
    };
    std::vector<One> all_{};
};

}  // namespace carom::app
