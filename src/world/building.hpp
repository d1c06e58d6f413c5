#pragma once
// What the builders share.

#include <fmt/format.h>

#include <carom/builder.hpp>

namespace carom {

/// Lets `make(built)` add bodies; if it throws, those that it made are taken out again.
template <class Make>
Built all_or_nothing(World& world, Make make) {
    Built built;
    try {
        make(built.bodies);
    } catch (...) {
        // The last one first: each is then in the last row, and no other body moves.
        for (auto id = built.bodies.rbegin(); id != built.bodies.rend(); ++id) world.remove(*id);
        throw;
    }
    return built;
}

inline std::string numbered(const std::string& name, std::size_t i) {
    return name.empty() ? name : fmt::format("{}[{}]", name, i);
}
inline std::string numbered(const std::string& name, int column, int row) {
    return name.empty() ? name : fmt::format("{}[{}][{}]", name, column, row);
}

inline void check_product(int nx, int ny, const char* where) {
    const double product = static_cast<double>(nx) * ny;
    if (product > most_built)
        throw Error(fmt::format("{}.nx times ny must be at most {}, got {:.6g}", where, most_built, product));
}

}  // namespace carom
