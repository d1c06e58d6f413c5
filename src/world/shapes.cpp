#include "world/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collision/convex.hpp"
#include "state/validate.hpp"

namespace carom {

namespace {

/// What f makes; an Error of its says what is wrong, what() by name.
template <class Name, class F>
auto named(Name what, F f) {
    try {
        return f();
    } catch (const Error& e) {
        throw Error(fmt::format("{} is wrong: {}", what(), e.what()));
    }
}

}  // namespace

void check_shapes(const std::vector<Shape>& shapes, const std::string& whose) {
    validate_field(shapes, whose + ".shapes", "", any);
    for (std::size_t i = 0; i < shapes.size(); ++i)
        named([&] { return fmt::format("{}.shapes[{}]", whose, i); }, [&] { return pieces_of(shapes[i].geometry); });
}

Body about_its_centre(const Body& body, std::optional<double> had) {
    check_shapes(body.shapes, called(body));
    const Body made = named([&] { return called(body); }, [&] { return with_mass_of_shapes(body); });
    constexpr double rounding = 1e-9;
    const bool is_given = body.mass != Body{}.mass && body.mass != had;
    if (is_given && !(std::abs(made.mass - body.mass) <= rounding * made.mass))
        throw Error(fmt::format("{}.mass must not be given beside a density, which makes it {:.6g} kg, got {}",
                                called(body), made.mass, body.mass));
    return made;
}

bool has_sensor(const Bodies& bodies) {
    return std::any_of(bodies.shapes.begin(), bodies.shapes.end(), [](const std::vector<Shape>& shapes) {
        return std::any_of(shapes.begin(), shapes.end(), [](const Shape& shape) { return shape.sensor; });
    });
}

std::optional<std::size_t> row_beyond(const Solver& solver, const Bodies& bodies, const Walls& walls) {
    const auto* impulse = std::get_if<Impulse>(&solver);
    if (!impulse || (walls.all.empty() && !(impulse->disc_collisions && bodies.size() > 1))) return {};
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (!bodies.shapes[row].empty()) return row;
    return {};
}

}  // namespace carom
