// Bodies are moved in lanes: each as if it were alone, whatever the instruction set.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "math/elementary.hpp"
#include "simd/isa.hpp"
#include "solvers/mover_rows.hpp"

namespace carom {
namespace {

class MoverLanes : public testing::Test {
  protected:
    ~MoverLanes() override { use_isa({}); }
};

/// Angles of all sizes and both signs, in all quadrants, at the bounds of each method; also such as are no angles.
std::vector<double> angles_of_all_sizes() {
    std::vector<double> angles{0, std::numeric_limits<double>::infinity(), std::nan("")};
    for (int power = -40; power <= 60; ++power)
        for (int k = 0; k < 7; ++k) angles.push_back(std::ldexp(1 + 0.137 * k, power));
    for (int quarter = 0; quarter < 40; ++quarter)
        for (const double beside : {-1e-9, 0.0, 1e-9, 0.3}) angles.push_back(quarter * 0.78539816339744831 + beside);
    for (const double bound : {0x1p-27, 0x1.921fb54442d18p-1, 0x1p20})
        for (const double towards : {0.0, 1e9}) angles.push_back(std::nextafter(bound, towards));
    for (std::size_t i = angles.size(); i-- > 0;) angles.push_back(-angles[i]);
    return angles;
}

TEST_F(MoverLanes, FramesHaveTheSineAndCosineOfEachAngleToTheBit) {
    const std::vector<double> angles = angles_of_all_sizes();
    for (const Isa which : available_isas()) {
        use_isa(which);
        std::vector<double> x(2 * angles.size(), 1), angle = angles, inverse_mass(angles.size(), 2);
        std::vector<double> frames(4 * angles.size()), movers(4 * angles.size());
        MoverRows rows{};
        rows.movers = movers.data(), rows.frames = frames.data();
        rows.x = x.data(), rows.angle = angle.data(), rows.rows = angles.size();
        mover_kernel().place(rows, inverse_mass.data(), 0, angles.size());
        for (std::size_t i = 0; i < angles.size(); ++i) {
            const portable::SinCos turned = portable::sincos(angles[i]);
            const double expected[] = {1, 1, turned.cos, turned.sin};
            EXPECT_EQ(0, std::memcmp(expected, &frames[4 * i], sizeof expected)) << angles[i];
            EXPECT_EQ(2, movers[4 * i + 3]);
        }
    }
}

}  // namespace
}  // namespace carom
