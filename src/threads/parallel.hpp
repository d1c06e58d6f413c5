#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>

namespace carom {

/// Calls job(0) … job(jobs − 1), each once, on up to `threads` threads, and returns when all are done. Which thread
/// does which job is left open: a job writes only to what is its own, so that the result does not depend on `threads`.
/// An exception in a job is thrown on when all jobs have ended. Without threads (WebAssembly) it is a loop.
void parallel_for(int threads, std::size_t jobs, const std::function<void(std::size_t)>& job);

/// Calls job(first, last) for ranges that make up [0, count): for all of it at once where it is no longer than a grain,
/// which should be worth some 10 µs.
template <class Job>
void parallel_ranges(int threads, std::size_t count, std::size_t grain, const Job& job) {
    if (threads <= 1 || count <= grain) {
        if (count > 0) job(std::size_t{0}, count);
        return;
    }
    // A few ranges for each thread, so that none waits long for another.
    const std::size_t most = 4 * static_cast<std::size_t>(threads);
    const std::size_t length = std::max(grain, (count + most - 1) / most);
    parallel_for(threads, (count + length - 1) / length,
                 [&](std::size_t k) { job(k * length, std::min(count, (k + 1) * length)); });
}

}  // namespace carom
