#pragma once
#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace carom::app {

/// Makes something for each of many jobs on several threads, and takes it on this one, in order. The threads end with
/// run(), however it ends: what they make things with is not ours.
template <class Made>
class JobsInOrder {
  public:
    JobsInOrder(std::size_t jobs, std::size_t threads)
        : jobs_(jobs), threads_(std::min({threads, jobs, most_threads})), ahead_(2 * threads_) {}
    JobsInOrder(const JobsInOrder&) = delete;
    JobsInOrder& operator=(const JobsInOrder&) = delete;

    /// `make(job)` must not throw; `take(made)` says whether to go on. On one thread they take turns. Where the system
    /// has fewer threads left, there are fewer.
    template <class Make, class Take>
    void run(const Make& make, const Take& take) {
        const End end{*this};
        try {
            for (std::size_t k = 0; k < threads_ && threads_ > 1; ++k)
                workers_.emplace_back([this, &make] { work(make); });
        } catch (const std::system_error&) {
        }
        const bool alone = workers_.empty();
        for (std::size_t job = 0; job < jobs_; ++job)
            if (!take(alone ? make(job) : next())) return;
    }

  private:
    struct End {
        JobsInOrder& jobs;
        ~End() { jobs.stop(); }
    };

    template <class Make>
    void work(const Make& make) {
        std::unique_lock lock(mutex_);
        while (true) {
            // None is far ahead of the first, behind which all others wait in memory.
            changed_.wait(lock, [&] { return stopped_ || begun_ == jobs_ || begun_ < taken_ + ahead_; });
            if (stopped_ || begun_ == jobs_) return;
            const std::size_t job = begun_++;
            lock.unlock();
            Made made = make(job);
            lock.lock();
            ready_.emplace(job, std::move(made));
            changed_.notify_all();
        }
    }
    Made next() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ready_.count(taken_) > 0; });
        Made made = std::move(ready_.extract(taken_).mapped());
        ++taken_;
        changed_.notify_all();
        return made;
    }
    void stop() {
        {
            const std::lock_guard lock(mutex_);
            stopped_ = true;
        }
        changed_.notify_all();
        for (std::thread& worker : workers_) worker.join();
        workers_.clear();
    }

    static constexpr std::size_t most_threads = 256;

    const std::size_t jobs_, threads_, ahead_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::size_t, Made> ready_;
    std::size_t begun_ = 0, taken_ = 0;
    bool stopped_ = false;
    std::vector<std::thread> workers_;
};

}  // namespace carom::app
