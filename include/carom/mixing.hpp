#pragma once
#include <array>
#include <carom/field.hpp>
#include <cstdint>

namespace carom {

/// How the coefficient of a contact follows from those of the two that touch.
enum class Mixing : std::uint8_t { minimum, maximum, mean, product, geometric_mean };
constexpr auto choices(const Mixing*) {
    return std::array{Choice<Mixing>{"minimum", Mixing::minimum, "the smaller one"},
                      Choice<Mixing>{"maximum", Mixing::maximum, "the larger one"},
                      Choice<Mixing>{"mean", Mixing::mean, "half of their sum"},
                      Choice<Mixing>{"product", Mixing::product, "their product"},
                      Choice<Mixing>{"geometric_mean", Mixing::geometric_mean, "the square root of their product"}};
}

}  // namespace carom
