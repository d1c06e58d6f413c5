#pragma once
#include <algorithm>
#include <cstddef>

namespace carom {

/// What is called for every job: no copy, and good for as long as the call that it is handed to.
class JobRef {
  public:
    JobRef() = default;
    template <class Job>
    JobRef(const Job& job)
        : job_(&job), call_([](const void* j, std::size_t k) { (*static_cast<const Job*>(j))(k); }) {}
    void operator()(std::size_t k) const { call_(job_, k); }

  private:
    const void* job_ = nullptr;
    void (*call_)(const void*, std::size_t) = nullptr;
};

/// Calls job(0) … job(jobs − 1), each once, on up to `threads` threads, and returns when all are done. Which thread
/// does which job is left open: a job writes only to what is its own, so that the result does not depend on `threads`.
/// As a rule it is that which did the same part of the jobs before, and has what they look at in its cache.
/// An exception in a job is thrown on when all jobs have ended. Without threads (WebAssembly) it is a loop.
void parallel_for(int threads, std::size_t jobs, JobRef job);

/// Calls job(first, last) for ranges that make up [0, count): for all of it at once where it is shorter than two
/// grains, of which each should be worth some microseconds. Ranges begin at whole cache lines of numbers.
template <class Job>
void parallel_ranges(int threads, std::size_t count, std::size_t grain, const Job& job) {
    if (threads <= 1 || count < 2 * grain) {
        if (count > 0) job(std::size_t{0}, count);
        return;
    }
    // A few ranges for each thread, so that none waits long for another, and as many for each.
    const std::size_t sharing = static_cast<std::size_t>(threads), most = 4 * sharing;
    std::size_t ranges = std::min(count / grain, most);
    if (ranges > sharing) ranges -= ranges % sharing;
    const std::size_t line = grain < 8 ? 1 : 8;
    const auto begin = [=](std::size_t k) { return k == ranges ? count : count * k / ranges / line * line; };
    parallel_for(threads, ranges, [&](std::size_t k) { job(begin(k), begin(k + 1)); });
}

}  // namespace carom
