#pragma once
#include <carom/scene.hpp>
#include <span>

#include "scene/expression.hpp"
#include "scene/json.hpp"
#include "scene/reader.hpp"

namespace carom {

struct Scene::Document {
    Json root;
    Place top;

    /// The parameters, each of which may be an expression of those before it.
    Names names(const World* world = nullptr) const;
    Settings settings() const;
    Plan plan() const;
    int seed() const;
    std::vector<Expectation> expectations() const;
    std::vector<Twin> twins() const;
    std::vector<Picture> pictures() const;
    /// All that can be checked without making the world.
    void check() const;
    /// That nothing is looked at after the end of the run, or after a later one [s].
    void check_times(double end) const;
};

/// The place that "world.gravity", "bodies.ball.mass" or "forces[0].stiffness" names. In a list an item goes by its
/// number or its name, in an object a key that is not there yet is made.
Json& find_place(Json& root, const std::string& path, const Place& top);

/// An Error if a body's mass is written beside densities that make another one: `made` are the masses of its bodies.
void check_mass(const Reader& reader, const Json& body, const Place& place, std::span<const double> made);

/// A function written in a field.
Function function_of(const std::string& text, const Place& place, const std::vector<std::string>& variables,
                     const Names& names);
/// Runs the scene's builders.
void build_all(World& world, const Reader& reader, const Json& root, const Place& top, int seed);

}  // namespace carom
