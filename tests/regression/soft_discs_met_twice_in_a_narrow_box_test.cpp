// In a periodic box so narrow that two soft discs meet on both sides, the nearest image was pushed alone, and the force
// jumped where that changes: of 1 J a milli went lost, without a word.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <string>

namespace carom {
namespace {

World two_discs(double width, Kind second = Kind::dynamic) {
    World world({.solver = NoContact{}});
    world.add(Periodic{.low = {0, 0}, .high = {width, 5}});
    world.add(Body{.position = {0.2, 1}, .velocity = {1, 0.3}, .radius = 0.25});
    world.add(Body{.kind = second, .position = {0.7, 1.1}, .radius = 0.35});
    world.add(SoftDiscs{.stiffness = 100});
    return world;
}

TEST(Regression, SoftDiscsMetTwiceInANarrowBox) {
    for (const Kind second : {Kind::dynamic, Kind::fixed}) {
        World narrow = two_discs(1.19, second), wide = two_discs(1.2, second);
        try {
            narrow.step(1e-3);
            ADD_FAILURE();
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find("side by side, 1.2 m"), std::string::npos) << e.what();
        }
        EXPECT_NO_THROW(wide.step(1e-3));
    }
    // Two that are held never meet, and who is alone meets nobody.
    World held({.solver = NoContact{}});
    held.add(Periodic{.low = {0, 0}, .high = {1, 5}});
    for (const double y : {1., 4.}) held.add(Body{.kind = Kind::fixed, .position = {0, y}, .radius = 0.4});
    held.add(SoftDiscs{});
    EXPECT_NO_THROW(held.step(1e-3));
    held.add(Body{.position = {0, 2.5}, .radius = 0.1});
    EXPECT_NO_THROW(held.step(1e-3));
}

}  // namespace
}  // namespace carom
