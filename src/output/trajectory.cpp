#include <fmt/format.h>

#include <carom/output.hpp>

namespace carom {

TrajectoryCsv::TrajectoryCsv(const std::filesystem::path& path, const World& world)
    : csv_(path, {{"t", "s"},
                  {"body"},
                  {"x", "m"},
                  {"y", "m"},
                  {"angle", "rad"},
                  {"vx", "m/s"},
                  {"vy", "m/s"},
                  {"omega", "rad/s"}}) {
    labels_.reserve(world.size());
}

void TrajectoryCsv::add(const World& world) {
    const double time = world.time();
    const auto ids = world.ids();
    const auto positions = world.positions(), velocities = world.velocities();
    const auto angles = world.angles(), spins = world.angular_velocities();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        csv_.row(time, label(world, ids[i]), positions[i].x, positions[i].y, angles[i], velocities[i].x,
                 velocities[i].y, spins[i]);
    }
}

// Remembered, because asking the world for a body copies all of it.
const std::string& TrajectoryCsv::label(const World& world, BodyId id) {
    auto [place, fresh] = labels_.try_emplace(id.index, Label{id.generation, {}});
    Label& label = place->second;
    if (fresh || label.generation != id.generation) {
        label = {id.generation, world.body(id).name};
        if (label.text.empty()) {
            label.text = fresh ? fmt::format("{}", id.index) : fmt::format("{}#{}", id.index, id.generation);
        }
    }
    return label.text;
}

void TrajectoryCsv::commit() { csv_.commit(); }

}  // namespace carom
