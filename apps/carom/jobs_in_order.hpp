#pragma once
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace carom::app {

/// Makes something for each of many jobs on several threads, and takes it on this one, in order.
template <class Made>
class SideBySide {
  public:
    SideBySide(std::size_t jobs, std::size_t threads) : jobs_(jobs), ahead_(2 * threads), threads_(threads) {}
    SideBySide(const SideBySide&) = delete;
    SideBySide& operator=(const SideBySide&) = delete;
    ~SideBySide() { stop(); }

    /// `make(job)` must not throw; `take(made)` says whether to go on. On one thread they take turns.
    template <class Make, class Take>
    void run(const Make& make, const Take& take) {
        if (threads_ <= 1) {
            for (std::size_t job = 0; job < jobs_; ++job)
                if (!take(make(job))) return;
            return;
        }
        for (std::size_t k = 0; k < threads_; ++k) workers_.emplace_back([this, &make] { work(make); });
        for (std::size_t job = 0; job < jobs_; ++job)
            if (!take(next())) return stop();
        stop();
    }

  private:
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

    const std::size_t jobs_, ahead_, threads_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::size_t, Made> ready_;
    std::size_t begun_ = 0, taken_ = 0;
    bool stopped_ = false;
    std::vector<std::thread> workers_;
};

}  // namespace carom::app
