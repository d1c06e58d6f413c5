#include <fmt/format.h>

#include "output/frames.hpp"
#include "output/provenance.hpp"

namespace carom {

namespace {

const Column frame_columns[] = {{"t", "s"},       {"body"},      {"x", "m"},    {"y", "m"},
                                {"angle", "rad"}, {"vx", "m/s"}, {"vy", "m/s"}, {"omega", "rad/s"}};

File with_comments(File file, bool begun, const Provenance& provenance) {
    if (!begun) file.write(comment_lines(provenance));
    return file;
}

}  // namespace

CsvFrames::CsvFrames(File file, bool begun, const World& world, const Provenance& provenance)
    : csv_(with_comments(std::move(file), begun, provenance), frame_columns, begun) {
    labels_.reserve(world.size());
}

void CsvFrames::add(const World& world) {
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
const std::string& CsvFrames::label(const World& world, BodyId id) {
    auto [place, fresh] = labels_.try_emplace(id.index, Label{id.generation, {}});
    Label& label = place->second;
    if (fresh || label.generation != id.generation) {
        label = {id.generation, world.body(id).name};
        if (label.text.empty())
            label.text =
                id.generation == 1 ? fmt::format("{}", id.index) : fmt::format("{}.{}", id.index, id.generation);
    }
    return label.text;
}

void CsvFrames::commit(const Provenance& provenance, const GasMeter*) {
    csv_.file().write(comment_lines({.summary = provenance.summary}));
    csv_.commit();
}

}  // namespace carom
