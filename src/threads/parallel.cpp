#include "threads/parallel.hpp"

#if !defined(__EMSCRIPTEN__) || defined(__EMSCRIPTEN_PTHREADS__)
#define CAROM_HAS_THREADS 1
#endif

#if CAROM_HAS_THREADS
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "simd/pause.hpp"
#endif

namespace carom {

#if CAROM_HAS_THREADS
namespace {

using std::chrono::microseconds;

/// For so long a worker waits awake for the next task, if there is a processor for it: between those that threads share
/// a step has others. To be woken takes it a tenth of that, in which the others do its jobs.
constexpr microseconds awake{500};

/// Whether is_over() comes true in some time. Now and then others have the processor, if they want it.
template <class IsOver>
bool spin(microseconds most, const IsOver& is_over) {
    constexpr int at_once = 256;
    const auto start = std::chrono::steady_clock::now();
    do {
        for (int k = 0; k < at_once; ++k, pause())
            if (is_over()) return true;
        std::this_thread::yield();
    } while (std::chrono::steady_clock::now() - start < most);
    return false;
}

/// The jobs that a thread begins with, a run of all. Others take some when they have done theirs, from the end: it goes
/// on with what lies next to what it did. All that a worker has to know comes in one line of the cache.
class alignas(64) Share {
  public:
    void give(JobRef job, std::uint64_t first, std::uint64_t last) {
        job_ = job;
        left_ = first << 32 | last;
    }
    void end() { left_ = over; }
    void wake() {
        if (is_asleep_) left_.notify_one();
    }
    /// False if there will be no more jobs.
    bool wait(microseconds before_sleep) {
        std::uint64_t left = 0;
        while (!spin(before_sleep, [&] { return left = left_.load(std::memory_order_acquire), !is_empty(left); })) {
            if (left == over) return false;
            is_asleep_ = true;
            left_.wait(left);
            is_asleep_ = false;
        }
        return true;
    }

    /// Takes the next job, or the last one, and calls act(job, k). A task does not end while somebody has one of its
    /// jobs: the two belong together, also if they are of a later task than that which the thread began with.
    template <class Act>
    bool take(bool last_one, const Act& act) {
        std::uint64_t left = left_.load(std::memory_order_acquire);
        while (!is_empty(left)) {
            const std::uint64_t rest = last_one ? left - 1 : left + first_one;
            if (!left_.compare_exchange_weak(left, rest)) continue;
            act(job_, last_one ? rest & low : left >> 32);
            return true;
        }
        return false;
    }

  private:
    static constexpr std::uint64_t low = 0xffffffff, first_one = low + 1, over = ~std::uint64_t{0};
    static bool is_empty(std::uint64_t left) { return left >> 32 >= (left & low); }

    std::atomic<std::uint64_t> left_ = 0;  ///< first and end
    JobRef job_;
    alignas(64) std::atomic<bool> is_asleep_ = false;
};

/// Workers that wait for the next task: spinning for a while, since a step has many short stages, then asleep.
/// Nobody waits for one that sleeps: who calls does all jobs that are left.
class Pool {
  public:
    static constexpr std::size_t most_threads = 256;

    static Pool& shared() {
        static Pool pool;
        return pool;
    }

    void run(std::size_t threads, std::size_t jobs, JobRef job) {
        while (workers_.size() + 1 < threads) workers_.emplace_back([this, me = workers_.size() + 1] { work(me); });
        if (threads_ != threads) threads_ = threads;  // workers have it in their caches
        const std::size_t before = done_;
        for (std::size_t k = threads; k-- > 0;) shares_[k].give(job, k * jobs / threads, (k + 1) * jobs / threads);
        for (std::size_t k = 1; k < threads; ++k) shares_[k].wake();
        const std::size_t own = do_own(0), taken = take_others(0);
        const auto is_over = [&] { return own + taken + (done_.load(std::memory_order_acquire) - before) == jobs; };
        while (!spin(awake, is_over)) {
        }
        if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    }

    std::mutex in_use;

  private:
    Pool() = default;
    ~Pool() {
        for (std::size_t k = 1; k <= workers_.size(); ++k) shares_[k].end(), shares_[k].wake();
        for (std::thread& worker : workers_) worker.join();
    }

    /// What it has done of its own is said before it looks for more: the caller may be waiting.
    void work(std::size_t me) {
        const microseconds before_sleep = me < std::thread::hardware_concurrency() ? awake : microseconds{0};
        while (shares_[me].wait(before_sleep)) {
            if (const std::size_t done = do_own(me); done > 0) done_.fetch_add(done);
            if (const std::size_t done = take_others(me); done > 0) done_.fetch_add(done);
        }
    }

    /// Both return how many.
    std::size_t do_own(std::size_t me) {
        std::size_t done = 0;
        while (do_job(shares_[me], false)) ++done;
        return done;
    }
    std::size_t take_others(std::size_t me) {
        std::size_t done = 0;
        const std::size_t threads = threads_;
        for (std::size_t other = 1; other < threads; ++other)
            while (do_job(shares_[(me + other) % threads], true)) ++done;
        return done;
    }
    bool do_job(Share& of, bool last_one) {
        return of.take(last_one, [this](const JobRef& job, std::size_t k) {
            try {
                job(k);
            } catch (...) {
                const std::lock_guard lock(failing_);
                if (!failure_) failure_ = std::current_exception();
            }
        });
    }

    std::array<Share, most_threads> shares_;
    std::vector<std::thread> workers_;
    std::atomic<std::size_t> threads_ = 0;
    alignas(64) std::atomic<std::size_t> done_ = 0;  ///< by workers, of all tasks
    alignas(64) std::mutex failing_;
    std::exception_ptr failure_;
};

}  // namespace
#endif

void parallel_for([[maybe_unused]] int threads, std::size_t jobs, JobRef job) {
#if CAROM_HAS_THREADS
    if (threads > 1 && jobs > 1) {
        Pool& pool = Pool::shared();
        // Another world, on a thread of the user's, may be using the workers: then this one does its jobs itself.
        if (const std::unique_lock lock(pool.in_use, std::try_to_lock); lock)
            return pool.run(std::min({static_cast<std::size_t>(threads), jobs, Pool::most_threads}), jobs, job);
    }
#endif
    for (std::size_t k = 0; k < jobs; ++k) job(k);
}

}  // namespace carom
