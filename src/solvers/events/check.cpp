// What the exact gas cannot do, said before it starts.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/grid.hpp"
#include "math/elementary.hpp"
#include "solvers/events/gas.hpp"
#include "state/row_name.hpp"

namespace carom {

MovingDiscs moving_discs(const Bodies& bodies, const State& state) {
    MovingDiscs discs;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        if (bodies.inverse_mass[row] == 0) continue;
        discs.row.push_back(row), discs.centre.push_back(state.x.linear[row]);
        discs.radius.push_back(bodies.radius[row]);
    }
    return discs;
}

namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw Error(fmt::format("the solver 'events' moves discs in free flight: {}", what));
}

void check_shapes(const GasScene& scene) {
    const Bodies& bodies = scene.bodies;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const std::string body = name_of_row(bodies, row);
        const bool moves = bodies.inverse_mass[row] != 0;
        for (const Shape& shape : bodies.shapes[row]) {
            if (moves && !shape.sensor)
                refuse(fmt::format("body {} is dynamic and has shapes; give it a radius instead, or use 'softstep'",
                                   body));
            if (std::holds_alternative<Chain>(shape.geometry))
                refuse(fmt::format("body {} has a chain, solid from one side; use segments", body));
            if (shape.surface_speed != 0)
                refuse(fmt::format("body {} has a surface_speed; use 'softstep' for conveyors", body));
            if (shape.rolling_resistance != 0)
                refuse(fmt::format("body {} has rolling_resistance, which nothing has that only bounces", body));
            if (shape.filter != Filter{})
                refuse(fmt::format("body {} has a filter, and here all discs meet all; remove it", body));
        }
    }
}

void check_driven(const GasScene& scene, const State& state) {
    for (const Piece& piece : scene.pieces) {
        if (scene.bodies.kind[piece.row] != Kind::driven || piece.sensor) continue;
        const std::string body = name_of_row(scene.bodies, piece.row);
        if (state.v.angular[piece.row] != 0 && (piece.outline.count > 1 || piece.outline.corner[0] != Vec2{}))
            refuse(fmt::format("driven body {} turns; only a disc about its own centre can", body));
        if (state.v.linear[piece.row] != Vec2{} && scene.walls.periodic)
            refuse(fmt::format("driven body {} moves through a periodic box; use walls", body));
    }
}

/// Points would slip through what has no thickness, by rounding, where a step ends as they touch it.
void check_points(const GasScene& scene) {
    if (!scene.company) return;
    const Bodies& bodies = scene.bodies;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        if (bodies.inverse_mass[row] == 0 || bodies.radius[row] > 0) continue;
        for (const Piece& piece : scene.pieces)
            if (scene.company->of_row(piece.row) != GasMover::none && !piece.sensor && piece.outline.radius == 0)
                refuse(fmt::format("body {} has no radius and body {}, which is moved in steps, no rounding; give one",
                                   name_of_row(bodies, row), name_of_row(bodies, piece.row)));
    }
}

/// Beyond this part of a radius an overlap is no rounding.
constexpr double deepest = 1e-9;

struct Overlap {
    double depth;
    std::string words;
};

using Overlaps = std::vector<Overlap>;

void report(Overlaps found) {
    if (found.empty()) return;
    std::stable_sort(found.begin(), found.end(), [](const Overlap& a, const Overlap& b) { return a.depth > b.depth; });
    std::string words;
    constexpr std::size_t most = 5;
    for (std::size_t k = 0; k < std::min(most, found.size()); ++k)
        words += fmt::format("{}{} by {:.6g} m", k > 0 ? "; " : "", found[k].words, found[k].depth);
    if (found.size() > most) words += fmt::format("; and {} more", found.size() - most);
    refuse(
        fmt::format("they must not overlap at the start, and do: {}. Move them apart, or let the solver's option "
                    "'relax' do that",
                    words));
}

Overlaps of_pairs(const GasScene& scene, const State& state) {
    const Bodies& bodies = scene.bodies;
    Overlaps found;
    const auto [rows, centre, radius] = moving_discs(bodies, state);
    Grid grid;
    grid.build(centre, radius, scene.walls.periodic);
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
        near.clear();
        grid.near(centre[i], radius[i], near);
        std::sort(near.begin(), near.end());
        for (const std::uint32_t j : near) {
            if (j <= i) continue;
            const double reach = radius[i] + radius[j];
            const double depth = reach - length(nearest_image(scene.walls.periodic, centre[j] - centre[i]));
            if (depth > deepest * reach)
                found.push_back({depth, fmt::format("bodies {} and {}", name_of_row(bodies, rows[i]),
                                                    name_of_row(bodies, rows[j]))});
        }
    }
    return found;
}

/// How deep a disc is in a body, or beyond a wall.
struct Depth {
    std::uint32_t row;  ///< of the body
    double depth;
};

/// In each of them once, as far as it is deepest: outlines are many lines.
std::vector<Depth> depths(const GasScene& scene, const State& state, std::size_t row,
                          const std::vector<GasObstacle>& obstacles, const std::vector<GasSolid>& solids) {
    const double r = scene.bodies.radius[row];
    const Vec2 place = state.x.linear[row];
    std::vector<Depth> found;
    const auto note = [&](std::uint32_t of, double depth, double by_rounding) {
        if (depth <= by_rounding) return;
        const auto known = std::find_if(found.begin(), found.end(), [of](const Depth& d) { return d.row == of; });
        if (known == found.end()) return found.push_back({of, depth});
        known->depth = std::max(known->depth, depth);
    };
    for (const GasObstacle& o : obstacles) {
        const Vec2 x = nearest_image(scene.walls.periodic, place - o.a);
        note(o.row, -gap_to(o, {x, {}, {}, r}), deepest * (r + o.radius) + 1e-12 * length(x));
    }
    for (const GasSolid& solid : solids)
        note(solid.piece->row, solid.depth(solid.seen(scene.walls.periodic, place), r),
             deepest * r + solid.rounding(place));
    return found;
}

Overlaps with_obstacles(const GasScene& scene, const State& state) {
    const Bodies& bodies = scene.bodies;
    Overlaps found;
    const auto obstacles = obstacles_of(scene.walls, bodies, state, scene.pieces);
    const auto solids = solids_of(bodies, state, scene.pieces);
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        if (bodies.inverse_mass[row] == 0) continue;
        for (const Depth& in : depths(scene, state, row, obstacles, solids))
            found.push_back({in.depth, in.row == GasObstacle::no_row
                                           ? fmt::format("body {} is outside the room", name_of_row(bodies, row))
                                           : fmt::format("bodies {} and {}", name_of_row(bodies, row),
                                                         name_of_row(bodies, in.row))});
    }
    return found;
}

/// No packing of discs is denser, whose radii have this ratio at most (Florian, Rend. Circ. Mat. Palermo 9, 300
/// (1960)): that of a triangle between three that touch, one large and two small. Equal ones fill π/(2√3).
double densest(double ratio) {
    constexpr double pi = 0x1.921fb54442d18p1;
    return (pi * ratio * ratio + 2 * (1 - ratio * ratio) * portable::asin(ratio / (1 + ratio))) /
           (2 * ratio * std::sqrt(2 * ratio + 1));
}

void check_packing(const GasScene& scene) {
    const double filled = packing_fraction(scene);
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
        const double r = scene.bodies.radius[row];
        if (scene.bodies.inverse_mass[row] == 0 || r == 0) continue;
        smallest = std::min(smallest, r), largest = std::max(largest, r);
    }
    if (largest == 0) return;
    const double most = densest(smallest / largest);
    if (filled > most * (1 + deepest))
        refuse(fmt::format(
            "they fill {:.4g} of the room, and no packing {} fills more than {}; take fewer or smaller ones, "
            "or a larger room",
            filled, smallest == largest ? "of equal discs" : "of discs of these radii",
            smallest == largest ? "0.9069, π/(2√3)" : fmt::format("{:.4g}", most)));
}

void check_box(const GasScene& scene) {
    if (!scene.walls.periodic) return;
    const Vec2 size = scene.walls.periodic->high - scene.walls.periodic->low;
    double widest = 0;
    for (std::size_t row = 0; row < scene.bodies.size(); ++row)
        if (scene.bodies.inverse_mass[row] != 0) widest = std::max(widest, 2 * scene.bodies.radius[row]);
    if (widest > std::min(size.x, size.y))
        refuse(fmt::format("the periodic box must be wider than the widest disc, {} m, and is {} x {} m", widest,
                           size.x, size.y));
}

void check_motion(const GasScene& scene, const State& state) {
    bool any = false;
    for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
        const Vec2 v = state.v.linear[row];
        if (!std::isfinite(squared_length(v)))
            refuse(
                fmt::format("body {} moves at ({:g}, {:g}) m/s, and neither the square of that nor its energy is a "
                            "number; choose other units",
                            name_of_row(scene.bodies, row), v.x, v.y));
    }
    for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
        if (scene.bodies.kind[row] == Kind::dynamic) any = true;
        if (state.v.linear[row] != Vec2{} || state.v.angular[row] != 0) return;
    }
    if (any && scene.gravity == Vec2{})
        refuse("all of them are at rest and there is no gravity, so that nothing would ever happen; give a velocity");
}

/// A radius that was forgotten: it is 0 if none is given.
void check_radii(const GasScene& scene) {
    const Bodies& bodies = scene.bodies;
    std::size_t points = 0;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        if (bodies.inverse_mass[row] == 0 || !scene.walls.all.empty() || !scene.walls.round.empty() ||
            bodies.radius[row] > 0)
            return;
        ++points;
    }
    if (points > 1)
        refuse(
            "points without a radius never meet, and there is nothing else to strike, so that nothing would ever "
            "happen; give a radius");
}

}  // namespace

double packing_fraction(const GasScene& scene) {
    const GasRoom room = room_of(scene.walls, {});
    if (room.rim == GasGrid::Rim::open) return 0;
    constexpr double pi = 0x1.921fb54442d18p1;
    double discs = 0;
    for (std::size_t row = 0; row < scene.bodies.size(); ++row)
        if (scene.bodies.inverse_mass[row] != 0) discs += pi * scene.bodies.radius[row] * scene.bodies.radius[row];
    return discs / room.area;
}

double check_gas(const GasScene& scene, State& state) {
    check_shapes(scene);
    check_driven(scene, state);
    check_points(scene);
    check_box(scene);
    check_packing(scene);
    if (!scene.company) check_radii(scene), check_motion(scene, state);
    const Overlaps outside = with_obstacles(scene, state), overlapping = of_pairs(scene, state);
    if (scene.options.relax && !(outside.empty() && overlapping.empty())) return relax_gas(scene, state);
    report(outside);
    report(overlapping);
    return 0;
}

}  // namespace carom
