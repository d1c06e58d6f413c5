// Bodies, paths and walls in the plane of a figure.

#include <cmath>

#include "helpers.hpp"

namespace carom {
namespace {

using Marks = OutputTest;

TEST_F(Marks, ALargeDiscHidItsPath) {
    const Track track{.points = {{0, 0}, {2, 0}, {2, 1}, {2, 0}}, .radius = 3, .colour = Colour{0, 114, 178, 255}};
    save(trajectory_figure({&track, 1}), path("a.png"));
    const Pixels pixels(path("a.png"));
    const auto [left, right, top, bottom] = pixels.extent(*track.colour);
    // From the middle of the disc, where the path ends, to its start: that part was below the disc.
    std::size_t seen = 0;
    for (double x = left; x <= right; ++x)
        for (double y = top; y <= bottom; ++y)
            if (const Colour c = pixels.at(x, y); c.r < 20 && c.b > 150) {
                ++seen;
                break;
            }
    EXPECT_GT(static_cast<double>(seen), 0.95 * (right - left));
    EXPECT_GT(right - left, 150);
    EXPECT_LT(pixels.count(*track.colour), 4000u) << "the disc is paler than its path";
}

}  // namespace
}  // namespace carom
