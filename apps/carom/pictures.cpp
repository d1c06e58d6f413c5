#include "pictures.hpp"

#include <carom/analysis.hpp>
#include <fmt/format.h>

#include <cmath>

namespace carom::app {

namespace {

constexpr std::size_t most_bodies = 20;

const char* name_of(PictureType type) {
    for (const auto& choice : choices(&type))
        if (choice.value == type) return choice.name;
    return "";
}

std::vector<BodyId> shown_bodies(const Picture& picture, const World& world) {
    std::vector<BodyId> ids;
    for (const std::string& name : picture.bodies) ids.push_back(world.find(name));
    for (std::size_t i = 0; picture.bodies.empty() && i < world.size() && ids.size() < most_bodies; ++i)
        if (world.kinds()[i] != Kind::fixed) ids.push_back(world.ids()[i]);
    return ids;
}

}  // namespace

Pictures::Pictures(const Scene& scene, const World& start) : title_(scene.title()), parameters_(scene.parameters()) {
    if (!start.rectangles().empty()) room_ = start.rectangles()[0];
    std::vector<Picture> wanted = scene.pictures();
    if (wanted.empty()) wanted = {{.type = PictureType::trajectories}, {.type = PictureType::energy}};
    for (const Picture& picture : wanted) {
        Recorder& r = recorders_.emplace_back(Recorder{.picture = picture});
        if (picture.type == PictureType::trajectories) {
            r.bodies = shown_bodies(picture, start);
            for (const BodyId id : r.bodies) r.tracks.push_back({.label = start.body(id).name, .radius = start.body(id).radius});
        }
        for (const std::string& text : picture.quantities) {
            r.quantities.emplace_back(text, start, parameters_);
            r.series.push_back({.label = text});
        }
        if (picture.type == PictureType::twin && picture.formulas.size() != picture.quantities.size())
            throw Error(fmt::format("a picture of type twin must have one formula a quantity, got {} for {}", picture.formulas.size(),
                                    picture.quantities.size()));
    }
    observe(start);
}

void Pictures::observe(const World& world) {
    for (Recorder& recorder : recorders_) record(recorder, world);
}

void Pictures::record(Recorder& r, const World& world) {
    if (r.picture.until && world.time() > *r.picture.until * (1 + 1e-12)) return;
    if (r.picture.type == PictureType::snapshots) {
        // The first frame at or after each time that was asked for.
        const auto& at = r.picture.at;
        while (r.moments.size() < at.size() && world.time() >= at[r.moments.size()] - 1e-9)
            r.moments.push_back({world.time(), disc_marks(world)});
        return;
    }
    r.time.push_back(world.time());
    for (std::size_t k = 0; k < r.bodies.size(); ++k) r.tracks[k].points.push_back(world.position(r.bodies[k]));
    for (std::size_t k = 0; k < r.quantities.size(); ++k) r.series[k].values.push_back(r.quantities[k](world));
    if (r.picture.type == PictureType::energy) r.energies.push_back(energy(world));
}

Figure Pictures::twin(const Recorder& r) const {
    Figure all;
    for (std::size_t k = 0; k < r.series.size(); ++k) {
        const auto exact = closed_form(r.picture.formulas[k], parameters_);
        std::vector<double> analytic;
        for (const double t : r.time) analytic.push_back(exact(t));
        Figure one = comparison_figure(r.time, r.series[k].values, analytic,
                                       fmt::format("{} [{}]", r.series[k].label, r.picture.unit.empty() ? "m" : r.picture.unit));
        if (k == 0)
            all = std::move(one);
        else
            all.panels.insert(all.panels.end(), one.panels.begin(), one.panels.end());
    }
    return all;
}

Figure Pictures::figure(const Recorder& r) const {
    const std::string unit = r.picture.unit.empty() ? "m" : r.picture.unit;
    switch (r.picture.type) {
        case PictureType::trajectories: return trajectory_figure(r.tracks, room_);
        case PictureType::time: return time_figure(r.time, r.series, fmt::format("[{}]", unit));
        case PictureType::phase:
            if (r.series.size() != 2) throw Error("a picture of type phase must have two quantities");
            return phase_figure({&r.series[0], 1}, {&r.series[1], 1}, r.series[0].label, r.series[1].label);
        case PictureType::energy: return energy_figure(r.time, r.energies);
        case PictureType::snapshots: return snapshot_figure(r.moments, room_);
        case PictureType::twin: return twin(r);
    }
    return {};
}

std::vector<std::filesystem::path> Pictures::draw(const std::filesystem::path& folder, const std::string& format) const {
    std::vector<std::filesystem::path> files;
    for (const Recorder& r : recorders_) {
        Figure picture = figure(r);
        picture.title = r.picture.title.empty() ? title_ : r.picture.title;
        const std::string name = r.picture.name.empty() ? name_of(r.picture.type) : r.picture.name;
        files.push_back(folder / (name + "." + format));
        save(picture, files.back());
    }
    return files;
}

}  // namespace carom::app
