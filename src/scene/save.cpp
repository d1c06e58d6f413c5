#include <carom/scene.hpp>
#include <set>

#include "scene/document.hpp"
#include "scene/kinds.hpp"
#include "scene/writer.hpp"

namespace carom {

namespace {

/// A name for every body: its own, or one that no other has.
std::map<std::uint32_t, std::string> names_of(const World& world) {
    std::map<std::uint32_t, std::string> names;
    std::set<std::string> taken;
    for (const BodyId id : world.ids()) taken.insert(names[id.index] = world.body(id).name);
    for (auto& [index, name] : names) {
        if (!name.empty()) continue;
        name = fmt::format("body{}", index);
        while (!taken.insert(name).second) name += "_";
    }
    return names;
}

template <class... T, class S>
void add_typed(Json& list, const Writer& writer, const std::tuple<Type<T>...>& types, std::span<const S> items) {
    const auto name = std::get<Type<std::remove_const_t<S>>>(types).name;
    for (const S& item : items) {
        Json whole{{"type", name}};
        whole.update(writer.write(item));
        list.push_back(whole);
    }
}

}  // namespace

Scene Scene::of(const World& world, const std::string& title) {
    if (!world.fields().empty() || !world.user_forces().empty())
        throw Error("Scene::of: forces that are C++ functions cannot be written into a scene");
    for (const BodyId id : world.ids())
        if (world.follows_curve(id))
            throw Error(
                fmt::format("Scene::of: body '{}' follows a curve, and a C++ function cannot be written into a scene",
                            world.body(id).name));
    const auto names = names_of(world);
    const Writer writer([&](BodyId id) { return names.contains(id.index) ? names.at(id.index) : ""; });
    Json root{{"carom", 1}};
    if (!title.empty()) root["title"] = title;
    if (const Json settings = writer.write(world.settings()); !settings.empty()) root["world"] = settings;
    Json walls = Json::array(), forces = Json::array();
    add_typed(walls, writer, wall_types, world.rectangles());
    add_typed(walls, writer, wall_types, world.half_planes());
    add_typed(walls, writer, wall_types, world.stadiums());
    if (const auto box = world.periodic()) add_typed(walls, writer, wall_types, std::span<const Periodic>(&*box, 1));
    for (const BodyId id : world.ids()) {
        Body body = world.body(id);
        body.name = names.at(id.index);
        root["bodies"].push_back(writer.write(body));
    }
    for (const Joint& joint : world.joints()) root["joints"].push_back(writer.write(joint));
    add_typed(forces, writer, force_types, world.springs());
    add_typed(forces, writer, force_types, world.torsion_springs());
    add_typed(forces, writer, force_types, world.drags());
    add_typed(forces, writer, force_types, world.attractions());
    add_typed(forces, writer, force_types, world.soft_discs());
    add_typed(forces, writer, force_types, world.constant_forces());
    if (!walls.empty()) root["walls"] = walls;
    if (!forces.empty()) root["forces"] = forces;
    require_utf8(root, {"Scene::of", ""});
    return Scene(std::make_unique<Document>(Document{root, {"scene", ""}}));
}

}  // namespace carom
