#include "math/scratch.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>
#include <vector>

namespace carom {
namespace {

// Threads share out the work as it comes: who gives back may be always another one than who took.
TEST(Scratch, WhatOneThreadTakesAndAnotherGivesBackIsTakenAgain) {
    constexpr std::size_t bytes = 5000, at_once = 20, rounds = 500;
    std::set<void*> seen;
    std::vector<void*> taken;
    std::atomic<bool> full = false, over = false;
    std::thread giver([&] {
        while (!over.load())
            if (full.load()) {
                for (void* block : taken) give_back_scratch(block, bytes);
                taken.clear();
                full = false;
            }
    });
    for (std::size_t round = 0; round < rounds; ++round) {
        for (std::size_t k = 0; k < at_once; ++k) taken.push_back(take_scratch(bytes));
        seen.insert(taken.begin(), taken.end());
        full = true;
        while (full.load()) std::this_thread::yield();
    }
    over = true;
    giver.join();
    EXPECT_LE(seen.size(), 10 * at_once);  // some wait with the giver, and in the depot
}

}  // namespace
}  // namespace carom
