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
/// Nobody waits for one that sleeps: who calls does all jobs that are left.
class Pool {
  public:
    static Pool& shared() {
        static Pool pool;
        return pool;
    }

    void run(std::size_t helpers, std::size_t jobs, const std::function<void(std::size_t)>& job) {
        while (workers_.size() < helpers) workers_.emplace_back([this, index = workers_.size()] { work(index); });
        job_ = &job;
        failure_ = nullptr;
        helpers_ = helpers;
        done_ = 0;
        const std::uint64_t task = (ticket_.load() / most_jobs + 1) * most_jobs;
        ticket_ = task + jobs;
        ticket_.notify_all();
        take_jobs(task);
        while (done_.load() != jobs) std::this_thread::yield();
        if (failure_) std::rethrow_exception(failure_);
    }

    std::mutex in_use;

  private:
    /// A ticket is the number of a task, times this, and the number of its jobs that nobody has taken. As long as a
    /// worker holds one of the task's jobs the task does not end, so that what it says of the job is true.
    static constexpr std::uint64_t most_jobs = std::uint64_t{1} << 32;

    Pool() = default;
    ~Pool() {
        stopping_ = true;
        ticket_.fetch_add(most_jobs);
        ticket_.notify_all();
        for (std::thread& worker : workers_) worker.join();
    }

    void work(std::size_t index) {
        std::uint64_t seen = 0;
        while (true) {
            for (int spin = 0; spin < 4000 && ticket_.load() == seen; ++spin) {
            }
            ticket_.wait(seen);
            seen = ticket_.load();
            if (stopping_) return;
            if (index < helpers_.load()) take_jobs(seen / most_jobs * most_jobs);
            if (const std::uint64_t now = ticket_.load(); now / most_jobs == seen / most_jobs) seen = now;
        }
    }

    void take_jobs(std::uint64_t task) {
        std::uint64_t ticket = ticket_.load();
        while (ticket / most_jobs * most_jobs == task && ticket != task) {
            if (!ticket_.compare_exchange_weak(ticket, ticket - 1)) continue;
            --ticket;
            try {
                (*job_)(ticket - task);
            } catch (...) {
                const std::lock_guard lock(failing_);
                if (!failure_) failure_ = std::current_exception();
            }
            done_.fetch_add(1);
        }
    }

    std::vector<std::thread> workers_;
    std::atomic<std::uint64_t> ticket_ = 0;
    std::atomic<std::size_t> done_ = 0, helpers_ = 0;
    std::atomic<bool> stopping_ = false;
    const std::function<void(std::size_t)>* job_ = nullptr;
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
