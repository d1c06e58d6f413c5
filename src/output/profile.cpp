// Averages over slices of a room, and their picture.

#include <fmt/format.h>

#include <carom/output.hpp>
#include <limits>

#include "output/axis.hpp"
#include "output/ink.hpp"

namespace carom {

namespace {

bool lies(const Rectangle& room) { return room.high.x - room.low.x >= room.high.y - room.low.y; }
double along(const Rectangle& room, Vec2 v) { return lies(room) ? v.x : v.y; }

}  // namespace

Profile profile_of(const World& world, const Rectangle& room, std::size_t slices) {
    const Vec2 size = room.high - room.low;
    if (slices == 0 || !(size.x > 0 && size.y > 0))
        throw Error(fmt::format("a profile of {} slices of a room of {} m x {} m: there must be a slice, and room",
                                slices, size.x, size.y));
    struct Slice {
        double bodies = 0, mass = 0, energy = 0;
        Vec2 momentum{};
    };
    std::vector<Slice> all(slices);
    const double width = along(room, size) / static_cast<double>(slices);
    for (std::size_t i = 0; i < world.size(); ++i) {
        const double place = along(room, world.wrapped(world.positions()[i]) - room.low) / width;
        if (world.kinds()[i] != Kind::dynamic || !(place >= 0 && place < static_cast<double>(slices))) continue;
        Slice& in = all[static_cast<std::size_t>(place)];
        const double mass = world.masses()[i];
        const Vec2 v = world.velocities()[i];
        in.bodies += 1, in.mass += mass, in.momentum += mass * v, in.energy += 0.5 * mass * dot(v, v);
    }
    Profile profile{.time = world.time()};
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    for (const Slice& in : all) {
        const Vec2 flow = in.momentum / in.mass;
        profile.density.push_back(in.bodies / (size.x * size.y) * static_cast<double>(slices));
        profile.flow.push_back(in.bodies > 0 ? along(room, flow) : unknown);
        // The mean velocity is theirs, which takes away one body's share.
        const double about_mean = in.energy - 0.5 * in.mass * dot(flow, flow);
        profile.temperature.push_back(in.bodies > 1 ? about_mean / (in.bodies - 1) : unknown);
    }
    return profile;
}

Figure profile_figure(std::span<const Profile> profiles, const Rectangle& room) {
    const std::string axis = lies(room) ? "x" : "y";
    const struct {
        std::string label;
        std::vector<double> Profile::*values;
    } kinds[] = {{"bodies [1/m²]", &Profile::density},
                 {fmt::format("flow along {} [m/s]", axis), &Profile::flow},
                 {"k T [J]", &Profile::temperature}};
    Figure figure{.shared_x = true};
    for (const auto& [label, values] : kinds) {
        Panel panel{.x_label = fmt::format("{} [m]", axis), .y_label = label, .height = 0.6};
        for (const Profile& profile : profiles) {
            const std::size_t slices = (profile.*values).size();
            const double start = along(room, room.low),
                         width = (along(room, room.high) - start) / static_cast<double>(slices);
            const Colour colour = palette(panel.curves.size());
            Curve curve{.label = figure.panels.empty() ? time_words(profile.time) : "",
                        .y = profile.*values,
                        .stroke = next_stroke(panel.curves, colour),
                        .colour = colour};
            for (std::size_t k = 0; k < slices; ++k) curve.x.push_back(start + (static_cast<double>(k) + 0.5) * width);
            panel.curves.push_back(std::move(curve));
        }
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

}  // namespace carom
