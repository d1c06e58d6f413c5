#pragma once
// Forces on one body at a time: constant ones and the user's fields.

#include <carom/force.hpp>
#include <optional>
#include <vector>

#include "forces/loads.hpp"

namespace carom {

struct ConstantForceRow {
    Row body;
    Vec2 force, point;
    double torque;
};
using ConstantForces = std::vector<ConstantForceRow>;

struct FieldRow {
    Row first, last;  ///< the bodies that feel it: rows first to last - 1
    std::function<Vec2(Vec2, Vec2, double, double)> force;
    std::function<double(Vec2, double, double)> potential;
};
using Fields = std::vector<FieldRow>;

/// Where a field was no finite number, for whoever finds that a run went wrong: by then nobody is where that was.
struct FieldDoubt {
    std::size_t field = 0;  ///< its place in the list
    Row row = 0;
    Vec2 force{}, x{}, v{};
    double mass = 0, time = 0;
};

void add_loads(const ConstantForces& forces, const State& state, Loads& loads);
double potential(const ConstantForces& forces, const State& state);

/// The masses say which bodies feel the fields: those of inverse mass 0 do not. `doubt` gets the first one, if there is
/// none in it yet.
void add_loads(const Fields& fields, std::span<const double> mass, std::span<const double> inverse_mass,
               const State& state, Loads& loads, std::optional<FieldDoubt>& doubt);
double potential(const Fields& fields, std::span<const double> mass, std::span<const double> inverse_mass,
                 const State& state);

}  // namespace carom
