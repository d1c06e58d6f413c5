#include <fmt/format.h>

#include <carom/output.hpp>
#include <variant>

#include "output/frames.hpp"
#include "output/provenance.hpp"

namespace carom {

namespace {

using Frames = std::variant<CsvFrames, XyzFrames, H5mdFrames>;

Frames frames_in(File file, bool begun, DataFormat format, const World& world, const Provenance& provenance) {
    if (format == DataFormat::csv) return CsvFrames(std::move(file), begun, world, provenance);
    if (format == DataFormat::xyz) return XyzFrames(std::move(file), begun, world, provenance);
    return H5mdFrames(std::move(file), begun, world, provenance);
}

/// H5MD has its provenance only when it is HDF5.
Revision revision_of(DataFormat format, const Provenance& before, const Provenance& after) {
    if (format == DataFormat::csv) return {comment_lines(before), comment_lines(after)};
    if (format == DataFormat::xyz) return {xyz_pairs(before), xyz_pairs(after)};
    return {};
}

}  // namespace

DataFormat data_format(const std::filesystem::path& path) {
    const auto ending = path.extension();
    if (ending == ".csv") return DataFormat::csv;
    if (ending == ".xyz" || ending == ".extxyz") return DataFormat::xyz;
    if (ending == ".h5" || ending == ".h5md") return DataFormat::h5md;
    throw Error(fmt::format("{}: a data file ends with .csv, .xyz, .extxyz, .h5 or .h5md", path.string()));
}

std::optional<Room> room_of(const World& world) {
    if (const auto box = world.periodic()) return Room{box->low, box->high, true};
    if (const auto rooms = world.rectangles(); rooms.size() == 1) return Room{rooms[0].low, rooms[0].high, false};
    return {};
}

struct Trajectory::State {
    Frames frames;
    Provenance provenance;
};

Trajectory::Trajectory(const std::filesystem::path& path, DataFormat format, const World& world, Provenance provenance)
    : state_(std::make_unique<State>(
          State{frames_in(File(path), false, format, world, provenance), std::move(provenance)})) {}
Trajectory::Trajectory(const Bookmark& bookmark, DataFormat format, const World& world, Provenance provenance,
                       const Provenance* before)
    : state_(std::make_unique<State>(
          State{frames_in(File(bookmark, before != nullptr ? revision_of(format, *before, provenance) : Revision{}),
                          bookmark.length > 0, format, world, provenance),
                std::move(provenance)})) {}
Trajectory::Trajectory(Trajectory&&) noexcept = default;
Trajectory::~Trajectory() = default;

void Trajectory::add(const World& world) {
    std::visit([&](auto& frames) { frames.add(world); }, state_->frames);
}
void Trajectory::commit(const std::string& summary, const GasMeter* measures) {
    state_->provenance.summary = summary;
    std::visit([&](auto& frames) { frames.commit(state_->provenance, measures); }, state_->frames);
}
Bookmark Trajectory::sync() {
    return std::visit([](auto& frames) { return frames.sync(); }, state_->frames);
}
void Trajectory::release() {
    std::visit([](auto& frames) { frames.release(); }, state_->frames);
}

}  // namespace carom
