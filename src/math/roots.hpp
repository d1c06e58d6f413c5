#pragma once
#include <optional>
#include <span>
namespace carom {
std::optional<double> first_descent(std::span<const double> coefficients, double end);
}
