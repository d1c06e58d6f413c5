// Numbers that stay, in a list from which others are taken out.
#include "state/numbered.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

using carom::Numbered;

TEST(Numbered, AWholeListIsNumberedByItsPlaces) {
    Numbered<int> list;
    for (int i = 0; i < 5; ++i) EXPECT_EQ(list.push_back(10 * i), i + 1u);
    for (std::uint32_t n = 1; n <= 5; ++n) EXPECT_EQ(list.place(n), n - 1);
    EXPECT_FALSE(list.place(0));
    EXPECT_FALSE(list.place(6));
}

TEST(Numbered, NumbersStayWhoeverIsTakenOut) {
    Numbered<int> list;
    std::map<std::uint32_t, int> expected;
    std::mt19937 random(1);  // of the standard: the same everywhere
    for (int i = 0; i < 2000; ++i) {
        const auto dice = random() % 20;
        if (dice < 12 || list.empty())
            expected[list.push_back(i)] = i;
        else if (dice < 19) {
            const std::size_t place = random() % list.size();
            expected.erase(list.number(place));
            list.erase(place);
        } else {
            const auto gone = [](int value) { return value % 7 == 3; };
            list.erase_if(gone);
            std::erase_if(expected, [&](const auto& e) { return gone(e.second); });
        }
        ASSERT_EQ(list.size(), expected.size());
    }
    std::uint32_t last = 0;
    for (std::size_t place = 0; place < list.size(); ++place) {
        const std::uint32_t number = list.number(place);
        EXPECT_GT(number, last) << "in the order in which they were added";
        last = number;
        EXPECT_EQ(list[place], expected.at(number));
        EXPECT_EQ(list.place(number), place);
    }
    for (std::uint32_t n = 1; n <= list.given(); ++n) EXPECT_EQ(list.place(n).has_value(), expected.contains(n));
}

TEST(Numbered, OneThatWasEmptiedGivesNoNumberTwice) {
    Numbered<int> list{1, 2};
    list.erase(0), list.erase(0);
    EXPECT_TRUE(list.empty());
    EXPECT_FALSE(list.place(1));
    EXPECT_EQ(list.push_back(3), 3u);
    EXPECT_EQ(list.place(3), 0u);
}
