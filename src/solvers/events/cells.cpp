#include "solvers/events/cells.hpp"

#include "math/pages.hpp"

namespace carom {

void GasCells::begin(const GasWindow& window) {
    window_ = window;
    reserve_large(crowd_, window.cells());
    crowd_.assign(window.cells(), {});
}

/// Around what is rolled up; what is not in the window is empty.
GasCells::Around GasCells::around_the_rim(std::int32_t x, std::int32_t y, Rim& rim) const {
    const auto wrapped = [](std::int32_t c, std::int32_t n) { return c < 0 ? c + n : c >= n ? c - n : c; };
    for (std::size_t k = 0; k < cells_around; ++k) {
        const std::int32_t c = wrapped(x + column_around(k), window_.all_x),
                           r = wrapped(y + row_around(k), window_.all_y);
        rim[k] = c < window_.nx && r < window_.ny ? crowd_[window_.index(c, r)] : GasCrowd{};
    }
    return {rim.data(), 3};
}

}  // namespace carom
