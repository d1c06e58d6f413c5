#include "threads/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <carom/carom.hpp>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace carom {
namespace {

TEST(ParallelFor, DoesEveryJobOnce) {
    for (const int threads : {1, 2, 3, 8}) {
        for (const std::size_t jobs : {0u, 1u, 2u, 7u, 1000u}) {
            std::vector<std::atomic<int>> done(jobs);
            parallel_for(threads, jobs, [&](std::size_t k) { ++done[k]; });
            for (const auto& count : done) EXPECT_EQ(count, 1) << threads << " threads, " << jobs << " jobs";
        }
    }
}

TEST(ParallelFor, ManyShortStagesInARow) {
    std::atomic<int> sum = 0;
    for (int stage = 0; stage < 2000; ++stage)
        parallel_for(1 + stage % 4, 4, [&](std::size_t k) { sum += static_cast<int>(k); });
    EXPECT_EQ(sum, 2000 * 6);
}

TEST(ParallelFor, WakesWorkersThatFellAsleep) {
    for (int round = 0; round < 20; ++round) {
        std::vector<std::atomic<int>> done(50);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        parallel_for(4, done.size(), [&](std::size_t k) { ++done[k]; });
        for (const auto& count : done) EXPECT_EQ(count, 1);
    }
}

TEST(ParallelFor, JobsThatTakeVeryDifferentTimesAreDoneOnceEach) {
    for (int round = 0; round < 20; ++round) {
        std::vector<std::atomic<int>> done(64);
        parallel_for(4, done.size(), [&](std::size_t k) {
            if (k < 4) std::this_thread::sleep_for(std::chrono::microseconds(100));
            ++done[k];
        });
        for (const auto& count : done) EXPECT_EQ(count, 1);
    }
}

TEST(ParallelRanges, MakeUpAllInOrderAndNoneIsShorterThanAGrain) {
    for (const int threads : {1, 2, 3, 8})
        for (const std::size_t grain : {1u, 8u, 32u, 512u})
            for (const std::size_t count : {0u, 1u, 7u, 31u, 63u, 64u, 65u, 1000u, 1023u, 1024u, 5000u}) {
                std::vector<std::atomic<std::size_t>> end(count);
                parallel_ranges(threads, count, grain, [&](std::size_t first, std::size_t last) { end[first] = last; });
                for (std::size_t first = 0; first < count; first = end[first]) {
                    ASSERT_GT(end[first], first) << threads << " threads, " << count << " by " << grain;
                    EXPECT_TRUE(end[first] == count || end[first] - first >= grain);
                    EXPECT_TRUE(end[first] == count || grain < 8 || end[first] % 8 == 0);
                }
            }
}

TEST(ParallelFor, ThrowsWhatAJobThrewWhenAllHaveEnded) {
    std::atomic<int> done = 0;
    const auto job = [&](std::size_t k) {
        ++done;
        if (k == 3) throw std::runtime_error("job 3");
    };
    EXPECT_THROW(parallel_for(2, 100, job), std::runtime_error);
    EXPECT_EQ(done, 100);
}

TEST(ParallelFor, WorldsOnThreadsOfTheUsersShareTheWorkers) {
    const auto hash = [](int threads) {
        World world({.solver = NoContact{}, .threads = threads});
        build(world, Gas{.fill = {.low = {0, 0}, .high = {10, 10}, .count = 600}});
        world.add(Attraction{.softening = 0.1});
        run(world, 0.02, 0.001);
        return state_hash(world);
    };
    const std::uint64_t alone = hash(1);
    std::vector<std::uint64_t> together(4);
    std::vector<std::thread> users;
    for (std::size_t k = 0; k < together.size(); ++k)
        users.emplace_back([&, k] { together[k] = hash(1 + static_cast<int>(k)); });
    for (std::thread& user : users) user.join();
    for (const std::uint64_t other : together) EXPECT_EQ(other, alone);
}

}  // namespace
}  // namespace carom
