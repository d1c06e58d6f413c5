#pragma once
#include <carom/archive.hpp>
#include <limits>
#include <string>
#include <vector>

#include "analysis/measured_room.hpp"

namespace carom {

/// Places and velocities of the discs whose ways are followed.
struct GasFrame {
    std::vector<Vec2> x, v;
};
auto members(Maybe_const<GasFrame> auto& f) {
    auto& [x, v] = f;
    return std::tie(x, v);
}

/// Ways of discs from which a coefficient of diffusion is to be made.
struct Ways {
    double shortest = 0, longest = 0;  ///< they take [s]
    double diffusion = 0;              ///< a quarter of what their squares grow by [m²/s]
    double met =
        std::numeric_limits<double>::infinity();  ///< discs, on the shortest, by one of them; if that is counted
    bool fall = false;                            ///< under gravity
};

/// Why these are none of diffusion in a room, in words; empty if they are.
std::string keeps_from_diffusing(const Ways& ways, const MeasuredRoom& room);

}  // namespace carom
