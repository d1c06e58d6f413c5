#include "solvers/events/cells.hpp"

#include "state/pages.hpp"

namespace carom {

void GasCells::begin(const GasWindow& window) {
    window_ = window;
    reserve_large(crowd_, window.cells());
    crowd_.assign(window.cells(), {});
}

/// Around what is rolled up; what is not in the window is empty.
std::array<const GasCrowd*, cells_around + 1> GasCells::around_the_rim(std::int32_t x, std::int32_t y) const {
    static constexpr GasCrowd empty;
    const auto wrapped = [](std::int32_t c, std::int32_t n) { return c < 0 ? c + n : c >= n ? c - n : c; };
    std::array<const GasCrowd*, cells_around + 1> crowds;
    for (std::size_t k = 0; k < crowds.size(); ++k) {
        const std::int32_t c = wrapped(x + column[k], window_.all_x), r = wrapped(y + row[k], window_.all_y);
        crowds[k] = c < window_.nx && r < window_.ny ? &crowd_[window_.index(c, r)] : &empty;
    }
    return crowds;
}

}  // namespace carom
