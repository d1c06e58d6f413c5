#pragma once
// The dense arrays of bodies, and the ids that name their rows.

#include <carom/archive.hpp>
#include <carom/body.hpp>
#include <carom/error.hpp>
#include <carom/mixing.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "state/motion.hpp"

namespace carom {

template <class T>
requires Maybe_const<T, Polygon> || Maybe_const<T, Hull>
auto members(T& outline) {
    auto& [points, rounding] = outline;
    return std::tie(points, rounding);
}
auto members(Maybe_const<Chain> auto& chain) {
    auto& [points, closed] = chain;
    return std::tie(points, closed);
}
auto members(Maybe_const<Shape> auto& shape) {
    auto& [geometry, density, restitution, friction, rolling_resistance, surface_speed, sensor, filter] = shape;
    return std::tie(geometry, density, restitution, friction, rolling_resistance, surface_speed, sensor, filter);
}

/// What does not change while the world moves, one row a body.
struct Bodies {
    std::vector<BodyId> id;
    std::vector<Kind> kind;
    std::vector<double> mass, inverse_mass;        ///< the inverse is 0 unless dynamic
    std::vector<double> inertia, inverse_inertia;  ///< 0 and 0 for a point; the inverse is 0 of what cannot be turned
    std::vector<double> radius, charge, restitution, friction;
    std::vector<Colour> colour;
    std::vector<std::vector<Shape>> shapes;     ///< none of points and discs
    std::map<std::uint32_t, std::string> name;  ///< by id index; only of bodies that have one
    std::map<std::string, BodyId, std::less<>> by_name;
    /// What the world's settings say of two that touch.
    struct {
        Mixing restitution = Mixing::minimum, friction = Mixing::geometric_mean;
    } mixing;

    std::size_t size() const { return id.size(); }
    /// Gives a body that was checked a row at the end of the arrays and of the state.
    BodyId add(const Body& body, State& state);
    /// An Error if it cannot be the body of this id.
    void check(const Body& body, BodyId which) const;
    /// Puts a body that was checked in the place of this one: its id and row stay.
    void set(BodyId which, const Body& body, State& state);
    /// Moves the last body into the row of this one.
    void remove(BodyId which, State& state);
    bool contains(BodyId which) const;
    /// The row of a body; an Error that names what was wrong with the id.
    std::size_t row(BodyId which) const;
    /// That of a body which a field of something names: the error says which.
    std::size_t row(BodyId which, std::string_view whose, std::string_view field) const;
    Body body(std::size_t row, const State& state) const;

    friend auto members(Maybe_const<Bodies> auto& b);
    /// To be called when the members were read: makes the names' index; an Error if they do not fit together.
    void check_members(const State& state);

  private:
    void write(std::size_t row, const Body& body, State& state);
    void forget_name(std::uint32_t index);

    static constexpr std::uint32_t no_row = 0xffffffff;
    std::vector<std::uint32_t> row_of_, generation_;  ///< by id index
    std::vector<std::uint32_t> free_;
};

/// All but the names' index, which follows from the names, and what the settings say.
auto members(Maybe_const<Bodies> auto& b) {
    auto& [id, kind, mass, inverse_mass, inertia, inverse_inertia, radius, charge, restitution, friction, colour,
           shapes, name, by_name, mixing, row_of, generation, free] = b;
    return std::tie(id, kind, mass, inverse_mass, inertia, inverse_inertia, radius, charge, restitution, friction,
                    colour, shapes, name, row_of, generation, free);
}

/// What errors call a body.
std::string called(const Body& body);

/// Okabe and Ito's colours, which the colour-blind tell apart, in turn.
Colour default_colour(std::size_t n);

}  // namespace carom
