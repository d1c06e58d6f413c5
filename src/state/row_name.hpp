#pragma once
#include <fmt/format.h>

#include <string>

#include "state/bodies.hpp"

namespace carom {

/// What errors call the body of a row, after the word "body".
inline std::string name_of_row(const Bodies& bodies, std::size_t row) {
    const auto named = bodies.name.find(bodies.id[row].index);
    return named == bodies.name.end() ? fmt::format("number {}", row) : "'" + named->second + "'";
}

}  // namespace carom
