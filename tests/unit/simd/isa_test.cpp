#include "simd/isa.hpp"

#include <gtest/gtest.h>

using namespace carom;

TEST(Isa, IsTheWidestThereIsUnlessToldOtherwise) {
    const std::vector<Isa> all = available_isas();
    EXPECT_EQ(all.front(), Isa::baseline);
    EXPECT_EQ(isa(), all.back());
    for (const Isa which : all) {
        use_isa(which);
        EXPECT_EQ(isa(), which);
    }
    use_isa({});
    EXPECT_EQ(isa(), all.back());
}
