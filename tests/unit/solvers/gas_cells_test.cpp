// Which discs the exact gas finds in a cell and around it, against plain lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <set>

#include "solvers/events/cells.hpp"

using namespace carom;

namespace {

std::multiset<Slot> discs_of(const GasCrowd& crowd, const std::vector<GasDisc>& disc) {
    std::multiset<Slot> all;
    for (std::size_t k = 0; k < std::min(crowd.count, GasCrowd::at_hand); ++k) all.insert(crowd.slot[k]);
    if (crowd.count > GasCrowd::at_hand)
        for (Slot s = disc[crowd.slot.back()].next_in_cell; s != no_slot; s = disc[s].next_in_cell) all.insert(s);
    return all;
}

}  // namespace

TEST(GasCells, HoldWhoIsThereHoweverMany) {
    constexpr Slot n = 40;
    std::vector<GasDisc> disc(n);
    GasCells cells;
    cells.begin({0, 0, 2, 2, 2, 2});  // ten discs a cell: most do not fit at hand
    std::vector<std::set<Slot>> wanted(4);
    Random random(3);
    const auto pick = [&](std::uint16_t count) { return static_cast<std::uint16_t>(random.uniform() * count); };
    const auto index = [](Cell c) { return static_cast<std::size_t>(2 * c.y + c.x); };
    for (Slot i = 0; i < n; ++i) {
        disc[i].cell = {pick(2), pick(2)};
        cells.at(disc[i].cell).put(disc.data(), i);
        wanted[index(disc[i].cell)].insert(i);
    }
    for (int k = 0; k < 5000; ++k) {
        const Slot i = pick(n);
        cells.at(disc[i].cell).take(disc.data(), i);
        wanted[index(disc[i].cell)].erase(i);
        // One cell empties and fills as time goes on.
        const bool away = k / 500 % 2 == 0;
        disc[i].cell = {pick(2), away ? std::uint16_t{1} : pick(2)};
        cells.at(disc[i].cell).put(disc.data(), i);
        wanted[index(disc[i].cell)].insert(i);
        for (std::uint16_t y = 0; y < 2; ++y)
            for (std::uint16_t x = 0; x < 2; ++x) {
                const GasCrowd& crowd = cells.at({x, y});
                const std::set<Slot>& there = wanted[index({x, y})];
                ASSERT_EQ(crowd.count, there.size()) << k;
                ASSERT_EQ(discs_of(crowd, disc), std::multiset<Slot>(there.begin(), there.end())) << k;
            }
    }
}

/// A part of a grid of 9 × 7 that reaches around it.
TEST(GasCells, AroundOneAreEightAndTheWindowEnds) {
    std::vector<GasDisc> disc(63);
    const GasWindow window{6, 5, 5, 4, 9, 7};
    GasCells cells;
    cells.begin(window);
    for (Slot i = 0; i < disc.size(); ++i) {
        disc[i].cell = {static_cast<std::uint16_t>(i % 9), static_cast<std::uint16_t>(i / 9)};
        if (window.has(disc[i].cell)) cells.at(disc[i].cell).put(disc.data(), i);
    }
    for (const GasDisc& d : disc) {
        if (!window.has(d.cell)) continue;
        GasCells::Rim rim;
        const auto around = cells.around(d.cell, rim);
        for (std::size_t k = 0; k < cells_around; ++k) {
            const Cell c{static_cast<std::uint16_t>((d.cell.x + column_around(k) + 9) % 9),
                         static_cast<std::uint16_t>((d.cell.y + row_around(k) + 7) % 7)};
            EXPECT_EQ(around.at(k).count, window.has(c) ? 1u : 0u) << k;
            EXPECT_EQ(around.at(k).slot[0], window.has(c) ? static_cast<Slot>(9 * c.y + c.x) : no_slot) << k;
        }
    }
}
