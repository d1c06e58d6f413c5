// From a world's state to the exact gas.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "math/pages.hpp"
#include "solvers/events/gas.hpp"
#include "solvers/impact.hpp"

namespace carom {

namespace {

/// The rows of the discs, in the order of the cells they are in: neighbours in space are neighbours in memory. Rows of
/// cells go back and forth in strips, so that the next one is near as well.
std::vector<std::uint32_t> in_order_of_cells(const GasScene& scene, const State& state, const GasGrid& grid) {
    std::vector<std::uint32_t> rows;
    for (std::uint32_t row = 0; row < scene.bodies.size(); ++row)
        if (scene.bodies.inverse_mass[row] != 0) rows.push_back(row);
    std::vector<std::uint64_t> place(scene.bodies.size());
    constexpr std::uint64_t strip = 8;  // cells
    for (const std::uint32_t row : rows) {
        GasDisc d;
        grid.put(d, state.x.linear[row]);
        place[row] = (d.cell.y / strip * static_cast<std::uint64_t>(grid.nx) + d.cell.x) * strip + d.cell.y % strip;
    }
    std::stable_sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) { return place[a] < place[b]; });
    return rows;
}

/// Every cell, of storage and with its turns, that an upright box touches.
template <class F>
void for_cells(const GasGrid& grid, Vec2 low, Vec2 high, F f) {
    const auto column = [](double place, double from, double side) {
        return static_cast<std::int64_t>(std::floor((place - from) / side));
    };
    const auto turns = [](std::int64_t c, std::int64_t n) { return c >= 0 ? c / n : -((-c - 1) / n) - 1; };
    for (std::int64_t y = column(low.y, grid.low.y, grid.side.y); y <= column(high.y, grid.low.y, grid.side.y); ++y)
        for (std::int64_t x = column(low.x, grid.low.x, grid.side.x); x <= column(high.x, grid.low.x, grid.side.x);
             ++x) {
            const std::int64_t tx = turns(x, grid.nx), ty = turns(y, grid.ny);
            const Cell cell{static_cast<std::uint16_t>(x - tx * grid.nx), static_cast<std::uint16_t>(y - ty * grid.ny)};
            f(grid.index(cell), static_cast<std::int32_t>(tx), static_cast<std::int32_t>(ty));
        }
}

/// The part of the grid that an obstacle can be struck in; none if that is anywhere.
std::optional<Aabb> reach_of(const GasObstacle& o, const GasGrid& grid, double widest) {
    const double room = o.radius + 0.5 * widest * (1 + 1e-6);
    if (o.moves || o.hollow || (o.endless && grid.rim != GasGrid::Rim::closed)) return {};
    if (!o.endless) {
        const Aabb box{{std::min(o.a.x, o.b.x) - room, std::min(o.a.y, o.b.y) - room},
                       {std::max(o.a.x, o.b.x) + room, std::max(o.a.y, o.b.y) + room}};
        const Vec2 cells{(box.high.x - box.low.x) / grid.side.x, (box.high.y - box.low.y) / grid.side.y};
        constexpr double many = 1e6;  // a giant among points
        return (cells.x + 1) * (cells.y + 1) > many ? std::nullopt : std::optional(box);
    }
    Aabb box{grid.low + 0.5 * grid.side, grid.low + Vec2{(grid.nx - 0.5) * grid.side.x, (grid.ny - 0.5) * grid.side.y}};
    if (o.normal == Vec2{1, 0}) box.high.x = o.a.x + room;
    if (o.normal == Vec2{-1, 0}) box.low.x = o.a.x - room;
    if (o.normal == Vec2{0, 1}) box.high.y = o.a.y + room;
    if (o.normal == Vec2{0, -1}) box.low.y = o.a.y - room;
    return box;
}

void place_obstacles(GasData& gas) {
    std::vector<std::pair<std::size_t, GasNear>> all;
    gas.everywhere.clear(), gas.near.clear(), gas.first_near.clear();
    for (std::uint32_t k = 0; k < gas.obstacle.size(); ++k) {
        if (gas.obstacle[k].mover != GasObstacle::no_row) continue;
        const auto reach = reach_of(gas.obstacle[k], gas.grid, gas.widest);
        if (!reach) {
            gas.everywhere.push_back(k);
            continue;
        }
        // Discs leave a cell a rounding too late.
        const Vec2 slack = 1e-9 * gas.grid.side;
        for_cells(gas.grid, reach->low - slack, reach->high + slack,
                  [&](std::size_t cell, std::int32_t tx, std::int32_t ty) {
                      all.push_back({cell, {k, tx, ty}});
                  });
    }
    if (all.empty()) return;
    std::stable_sort(all.begin(), all.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    gas.first_near.assign(gas.grid.cells() + 1, 0);
    for (const auto& [cell, near] : all) {
        gas.near.push_back(near);
        ++gas.first_near[cell + 1];
    }
    std::partial_sum(gas.first_near.begin(), gas.first_near.end(), gas.first_near.begin());
}

/// The outlines of bodies that are moved in steps, in their own frames.
void outline_company(const GasCompany& company, const State& state, std::vector<GasObstacle>& obstacles) {
    for (GasObstacle& o : obstacles) {
        if (o.row == GasObstacle::no_row || company.of_row(o.row) == GasMover::none) continue;
        const Frame frame = frame_at(state.x.linear[o.row], state.x.angular[o.row]);
        o.mover = company.of_row(o.row);
        o.a = frame.turn_back(o.a - frame.position), o.b = frame.turn_back(o.b - frame.position);
        o.normal = frame.turn_back(o.normal);
        o.v = {}, o.spin = 0, o.moves = false;
    }
}

/// Half of the time in which a disc meets with something is the unit in which clocks are set back; a power of two, so
/// that nothing is rounded.
double unit_of_time(const GasData& gas, const GasDiscs& discs) {
    double fastest = 0;
    for (const GasDisc& d : discs.disc) fastest = std::max(fastest, squared_length(d.v));
    const double time = fastest > 0 ? 16 * gas.grid.side.x / std::sqrt(fastest) : 1;
    return std::ldexp(1.0, std::clamp(std::ilogb(time), -900, 900));
}

/// So short that even in a dense gas few discs meet anybody; the next ones are longer.
double first_stride(const GasData& gas, const GasDiscs& discs) {
    double sum = 0;
    for (const GasDisc& d : discs.disc) sum += squared_length(d.v);
    return 0.01 * gas.grid.side.x / std::sqrt(sum / discs.size());
}

}  // namespace

void fill_gas(const GasScene& scene, const State& state, GasData& gas, GasDiscs& discs) {
    const Bodies& bodies = scene.bodies;
    const GasData before = std::move(gas);
    gas = {};
    gas.tally = before.tally, gas.made_anew = before.made_anew + 1;
    discs = {};
    std::vector<Vec2> places;
    std::vector<std::uint32_t> rows;
    bool elastic = !scene.options.restitution_speed, smooth = true, still = true;
    for (std::uint32_t row = 0; row < bodies.size(); ++row) {
        if (bodies.inverse_mass[row] == 0) continue;
        rows.push_back(row);
        places.push_back(state.x.linear[row]);
        gas.widest = std::max(gas.widest, 2 * bodies.radius[row]);
        gas.alike = gas.alike && bodies.radius[row] == bodies.radius[rows[0]] &&
                    bodies.inverse_mass[row] == bodies.inverse_mass[rows[0]];
        elastic = elastic && bodies.restitution[row] == 1;
        smooth = smooth && bodies.friction[row] == 0;
        still = still && state.v.angular[row] == 0;
    }
    gas.plain = elastic && smooth;
    gas.grid = choose_grid(room_of(scene.walls, places), places.size(), gas.widest);
    gas.obstacle = obstacles_of(scene.walls, bodies, state, scene.pieces);
    if (scene.company) outline_company(*scene.company, state, gas.obstacle);
    place_obstacles(gas);
    for (const GasObstacle& o : gas.obstacle) {
        elastic = elastic && o.restitution == 1;
        smooth = smooth && mixed_friction(bodies, o.friction, 0) == 0;
    }
    const bool warmed =
        std::any_of(gas.obstacle.begin(), gas.obstacle.end(), [](const GasObstacle& o) { return o.temperature > 0; });
    const bool loses = !elastic || !smooth || warmed;
    reserve_large(discs.disc, rows.size() + 1);
    reserve_large(discs.event, rows.size());
    for (const std::uint32_t row : in_order_of_cells(scene, state, gas.grid)) {
        GasDisc d{.v = state.v.linear[row]};
        gas.grid.put(d, state.x.linear[row]);
        discs.disc.push_back(d);
        discs.event.push_back({.row = row});
        if (!gas.alike || discs.radius.empty()) {
            discs.radius.push_back(bodies.radius[row]);
            discs.inverse_mass.push_back(bodies.inverse_mass[row]);
        }
        if (!smooth || !still) discs.spin.push_back({state.x.angular[row], state.v.angular[row], 0});
        if (loses) discs.past.push_back({});
    }
    gas.set_back = unit_of_time(gas, discs);
    gas.first_stride = gas.stride = first_stride(gas, discs);
    discs.disc.push_back(nobody);
    if (!gas.alike) discs.radius.push_back(0);
}

}  // namespace carom
