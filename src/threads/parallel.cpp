#include "threads/parallel.hpp"

#if !defined(__EMSCRIPTEN__) || defined(__EMSCRIPTEN_PTHREADS__)
#define CAROM_HAS_THREADS 1
#endif

#if CAROM_HAS_THREADS
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace carom {

#if CAROM_HAS_THREADS
namespace {

/// Workers that wait for the next task: spinning for some 20 µs, since a step has many short stages, then asleep.
class Pool {
  public:
    static Pool& shared() {
        static Pool pool;
        return pool;
    }

    void run(std::size_t helpers, std::size_t jobs, const std::function<void(std::size_t)>& job) {
        while (workers_.size() < helpers)
            workers_.emplace_back([this, index = workers_.size(), seen = generation_.load()] { work(index, seen); });
        job_ = &job;
        jobs_ = jobs;
        next_ = 0;
        failure_ = nullptr;
        helpers_ = helpers;
        busy_ = workers_.size();
        generation_.fetch_add(1);
        generation_.notify_all();
        take_jobs();
        while (busy_.load() != 0) std::this_thread::yield();
        if (failure_) std::rethrow_exception(failure_);
    }

    std::mutex in_use;

  private:
    Pool() = default;
    ~Pool() {
        stopping_ = true;
        generation_.fetch_add(1);
        generation_.notify_all();
        for (std::thread& worker : workers_) worker.join();
    }

    void work(std::size_t index, std::uint32_t seen) {
        while (true) {
            for (int spin = 0; spin < 4000 && generation_.load() == seen; ++spin) {
            }
            generation_.wait(seen);
            seen = generation_.load();
            if (stopping_) return;
            if (index < helpers_) take_jobs();
            busy_.fetch_sub(1);
        }
    }

    void take_jobs() {
        for (std::size_t k = next_.fetch_add(1); k < jobs_; k = next_.fetch_add(1)) {
            try {
                (*job_)(k);
            } catch (...) {
                const std::lock_guard lock(failing_);
                if (!failure_) failure_ = std::current_exception();
            }
        }
    }

    std::vector<std::thread> workers_;
    std::atomic<std::uint32_t> generation_ = 0;
    std::atomic<std::size_t> next_ = 0, busy_ = 0;
    std::atomic<bool> stopping_ = false;
    const std::function<void(std::size_t)>* job_ = nullptr;
    std::size_t jobs_ = 0, helpers_ = 0;
    std::mutex failing_;
    std::exception_ptr failure_;
};

}  // namespace
#endif

void parallel_for([[maybe_unused]] int threads, std::size_t jobs, const std::function<void(std::size_t)>& job) {
#if CAROM_HAS_THREADS
    if (threads > 1 && jobs > 1) {
        Pool& pool = Pool::shared();
        // Another world, on a thread of the user's, may be using the workers: then this one does its jobs itself.
        if (const std::unique_lock lock(pool.in_use, std::try_to_lock); lock)
            return pool.run(std::min<std::size_t>(static_cast<std::size_t>(threads), jobs) - 1, jobs, job);
    }
#endif
    for (std::size_t k = 0; k < jobs; ++k) job(k);
}

}  // namespace carom
