#pragma once
// What a world asks of its bodies' shapes.

#include <carom/solver.hpp>

#include "collision/walls.hpp"
#include "state/bodies.hpp"

namespace carom {

/// An Error that says which of them is wrong, and where: a field, or the outline that fields make together.
void check_shapes(const std::vector<Shape>& shapes, const std::string& whose);

/// The body as it moves: with the mass of its shapes, about their centre of mass. An Error if they are wrong, or if a
/// mass is given that they do not have: neither that which a body has if nobody says one, nor what it had.
Body about_its_centre(const Body& body, std::optional<double> had = {});

bool has_sensor(const Bodies& bodies);

/// A row with shapes that could collide, under a solver that knows discs alone.
std::optional<std::size_t> row_beyond(const Solver& solver, const Bodies& bodies, const Walls& walls);

}  // namespace carom
