#pragma once
#include <cstddef>
#include <functional>

namespace carom {

/// Calls job(0) … job(jobs − 1), each once, on up to `threads` threads, and returns when all are done. Which thread
/// does which job is left open: a job writes only to what is its own, so that the result does not depend on `threads`.
/// An exception in a job is thrown on when all jobs have ended. Without threads (WebAssembly) it is a loop.
void parallel_for(int threads, std::size_t jobs, const std::function<void(std::size_t)>& job);

}  // namespace carom
