#include "state/row_ranges.hpp"

#include <gtest/gtest.h>

using namespace carom;

namespace {

std::vector<std::size_t> rows_within(const RowRanges& ranges, std::size_t first, std::size_t last) {
    std::vector<std::size_t> rows;
    ranges.within(first, last, [&](std::size_t from, std::size_t to) {
        EXPECT_LT(from, to);
        for (std::size_t i = from; i < to; ++i) rows.push_back(i);
    });
    return rows;
}

}  // namespace

TEST(RowRanges, JoinsNeighboursAndCutsToAnyWindow) {
    RowRanges ranges;
    for (const std::size_t first : {8, 16, 40, 64}) ranges.add(first, first + 8);
    EXPECT_EQ(std::distance(ranges.begin(), ranges.end()), 3);
    EXPECT_EQ(ranges.count(), 32u);
    std::vector<std::size_t> rows;
    ranges.each_row([&](std::size_t i) { rows.push_back(i); });
    for (std::size_t first = 0; first < 80; ++first)
        for (std::size_t last = first + 1; last < 80; ++last) {
            std::vector<std::size_t> expected;
            for (const std::size_t i : rows)
                if (i >= first && i < last) expected.push_back(i);
            ASSERT_EQ(rows_within(ranges, first, last), expected) << first << ' ' << last;
        }
}

TEST(RowRanges, AllOfNoneIsEmpty) {
    EXPECT_TRUE(RowRanges::all(0).empty());
    EXPECT_EQ(RowRanges::all(5).count(), 5u);
}
