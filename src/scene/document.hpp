#pragma once
#include <carom/scene.hpp>

#include "scene/json.hpp"
#include "scene/reader.hpp"

namespace carom {

struct Scene::Document {
    Json root;
    Place top;

    /// The parameters, each of which may be an expression of those before it.
    Names names(const World* world) const;
    template <class T>
    std::vector<T> list(const char* key) const;
};

/// The place that "world.gravity", "bodies.ball.mass" or "forces[0].stiffness" names; lists also by their items' names.
/// The last name may be new, the others must be there.
Json* find_place(Json& root, const std::string& path, const Place& top);

/// Runs the scene's builders.
void build_all(World& world, const Reader& reader, const Json& root, const Place& top, int seed);

}  // namespace carom
