// The measures of a gas: what is seen of it.

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/gas_rows.hpp"
#include "analysis/gas_state.hpp"

namespace carom {

GasMeter::State::Whole GasMeter::State::whole(const World& world) const {
    if (!drifts()) return {};
    Vec2 x{}, p{};
    double m = 0;
    for (const std::size_t row : rows) {
        x += world.masses()[row] * world.positions()[row], p += world.masses()[row] * world.velocities()[row];
        m += world.masses()[row];
    }
    return {x / m, p / m};
}

double GasMeter::State::heat(const World& world) const {
    const Vec2 flow = whole(world).velocity;
    double sum = 0;
    for (const std::size_t row : rows)
        sum += 0.5 * world.masses()[row] * squared_length(world.velocities()[row] - flow);
    return sum;
}

GasMeter::GasMeter(const World& start) : state_(std::make_unique<State>()) {
    State& s = *state_;
    for (std::size_t row = 0; row < start.size(); ++row) {
        s.pushed = s.pushed || start.kinds()[row] == Kind::driven;
        if (start.kinds()[row] != Kind::dynamic) continue;
        if (start.in_steps(start.ids()[row])) {
            s.pushed = true;
            continue;
        }
        s.ids.push_back(start.ids()[row]), s.rows.push_back(row);
        s.mean_radius += start.radii()[row], s.mass += start.masses()[row];
        s.widest = std::max(s.widest, 2 * start.radii()[row]);
    }
    if (s.rows.empty()) throw Error("the measures of a gas are of dynamic bodies, and there is none");
    s.mean_radius /= s.discs();
    s.room = measured_room(start, s.rows.size(), s.widest);
    constexpr std::size_t most_followed = 1000;
    const std::size_t every = (s.rows.size() + most_followed - 1) / most_followed;
    for (std::size_t k = 0; k < s.rows.size(); k += every) s.followed.push_back(k);
    s.counts = std::holds_alternative<Events>(start.settings().solver);
    begin(start);
}
GasMeter::GasMeter(GasMeter&&) noexcept = default;
GasMeter& GasMeter::operator=(GasMeter&&) noexcept = default;
GasMeter::~GasMeter() = default;

void GasMeter::begin(const World& now) {
    State& s = *state_;
    find_rows(now, s.ids, s.rows);
    const double heat = s.heat(now);
    s.unit = heat > 0 ? heat / s.moving() : 1;
    s.last_time = now.time(), s.step = 0, s.frames = 0;
    s.last = now.gas();
    s.past.clear();
    s.blocks = Blocks(State::count);
    s.measure_column(now);
}

namespace {

/// Whether the room is as wide above as below: an empty rectangle, or half-planes beside a floor.
bool stands_upright(const World& world, const MeasuredRoom& room, Vec2 up) {
    if (room.walls) return room.empty && !room.round && up.x * up.y == 0;
    int floors = 0, others = 0;
    for (const HalfPlane& wall : world.half_planes()) {
        if (wall.normal == length(wall.normal) * up)
            ++floors;
        else if (dot(wall.normal, up) != 0)
            ++others;
    }
    return floors == 1 && others == 0;
}

}  // namespace

/// Without a lid the room is as high as the gas is after its start.
void GasMeter::State::measure_column(const World& world) {
    const Vec2 g = world.settings().gravity;
    column = {};
    falls = g != Vec2{};
    if (!falls || room.periodic) return;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    column.up = -g / length(g);
    for (const Vec2 corner : {room.low, room.high, Vec2{room.low.x, room.high.y}, Vec2{room.high.x, room.low.y}}) {
        low = std::min(low, dot(corner, column.up));
        high = std::max(high, dot(corner, column.up));
    }
    column.scale = unit * discs() / (mass * length(g));
    column.floor = low, column.top = high;
    const auto is_alike = [&](std::size_t row) { return world.masses()[row] == world.masses()[rows[0]]; };
    is_column = rows.size() == world.size() && stands_upright(world, room, column.up) &&
                std::all_of(rows.begin(), rows.end(), is_alike);
    if (room.walls) {
        column.lid = high - low - 2 * mean_radius;
        return;
    }
    for (const HalfPlane& wall : world.half_planes())
        if (wall.normal == length(wall.normal) * column.up) column.floor = dot(wall.point, column.up);
    column.top = column.floor + std::max(high - column.floor, highest * column.scale);
    if (column.up == Vec2{0, 1}) room.low.y = column.floor, room.high.y = column.top;
}

void GasMeter::observe(const World& world) {
    using enum State::Sum;
    State& s = *state_;
    const double passed = world.time() - s.last_time;
    if (!(passed > 0)) return;
    find_rows(world, s.ids, s.rows);
    const GasTally now = world.gas();
    std::vector<double>& sums = s.blocks.sample();
    sums[one] += 1;
    sums[time_passed] += passed;
    sums[virial] += now.virial - s.last.virial;
    sums[wall_impulse] += now.wall_impulse - s.last.wall_impulse;
    sums[disc_collisions] += static_cast<double>(now.disc_collisions - s.last.disc_collisions);
    sums[temperature] += s.heat(world) / s.moving();
    s.add_velocities(world, sums);
    s.add_distances(world, sums);
    s.add_ways(world, passed, sums);
    s.add_fields(world, sums);
    s.add_heights(world, sums);
    s.blocks.end_sample();
    s.last_time = world.time();
    s.last = now;
}

void GasMeter::State::add_velocities(const World& world, std::vector<double>& sums) const {
    const Vec2 flow = whole(world).velocity;
    sums[drift_x] += flow.x, sums[drift_y] += flow.y;
    double sum = 0;
    for (const std::size_t row : rows) {
        const double v = length(world.velocities()[row] - flow), scaled = v * std::sqrt(world.masses()[row] / unit);
        sum += v;
        if (scaled < fastest) sums[speeds + static_cast<std::size_t>(scaled / fastest * speed_bins)] += 1;
    }
    sums[speed] += sum / discs();
}

void GasMeter::State::add_distances(const World& world, std::vector<double>& sums) {
    // Pairs are many and change slowly.
    constexpr std::uint64_t every = 8;
    if (!has_distances() || frames++ % every != 0) return;
    std::vector<Vec2> x;
    for (const std::size_t row : rows) x.push_back(world.positions()[row]);
    const double far = farthest();
    grid.build(x, std::vector<double>(x.size(), 0.5 * far), world.periodic());
    sums[looks] += 1;
    for (std::uint32_t i = 0; i < x.size(); ++i) {
        if (!room.periodic && room.distance(x[i]) < margin()) continue;
        sums[references] += 1;
        near.clear();
        grid.near(x[i], 0.5 * far, near);
        for (const std::uint32_t j : near) {
            if (j == i) continue;
            const double r = length(nearest_image(world.periodic(), x[j] - x[i]));
            if (r < far) sums[pair_distances + static_cast<std::size_t>(r / far * distance_bins)] += 1;
        }
    }
}

void GasMeter::State::add_ways(const World& world, double passed, std::vector<double>& sums) {
    if (step == 0) step = passed;
    if (std::abs(passed - step) > 1e-6 * step) past.clear();  // a shorter last step
    GasFrame now;
    const Whole all = whole(world);
    for (const std::size_t k : followed) {
        now.x.push_back(world.positions()[rows[k]] - all.place);
        now.v.push_back(world.velocities()[rows[k]] - all.velocity);
    }
    past.insert(past.begin(), std::move(now));
    if (past.size() > lags) past.pop_back();
    const double each = 1 / static_cast<double>(followed.size());
    for (std::size_t lag = 0; lag < past.size(); ++lag) {
        double way = 0, product = 0;
        for (std::size_t k = 0; k < followed.size(); ++k) {
            way += squared_length(past[0].x[k] - past[lag].x[k]);
            product += dot(past[0].v[k], past[lag].v[k]);
        }
        sums[ways + lag] += way * each;
        sums[memory + lag] += product * each;
        sums[origins + lag] += 1;
    }
}

void GasMeter::State::add_fields(const World& world, std::vector<double>& sums) const {
    const Vec2 size = room.high - room.low;
    if (!(size.x > 0 && size.y > 0)) return;
    const Vec2 flow = whole(world).velocity;
    for (const std::size_t row : rows) {
        const Vec2 x = world.wrapped(world.positions()[row]) - room.low, v = world.velocities()[row] - flow;
        const double column_of = x.x / size.x * cells, row_of = x.y / size.y * cells, m = world.masses()[row];
        if (!(column_of >= 0 && column_of < cells && row_of >= 0 && row_of < cells)) continue;
        double* const at =
            &sums[in_cells + parts * (static_cast<std::size_t>(row_of) * cells + static_cast<std::size_t>(column_of))];
        at[discs_in] += 1, at[mass_in] += m, at[kinetic_in] += 0.5 * m * squared_length(v);
        at[momentum_x] += m * v.x, at[momentum_y] += m * v.y;
    }
}

void GasMeter::State::add_heights(const World& world, std::vector<double>& sums) const {
    if (column.scale == 0) return;
    for (const std::size_t row : rows) {
        const double part = (dot(world.positions()[row], column.up) - column.floor) / (column.top - column.floor);
        if (part >= 0 && part < 1) sums[heights + static_cast<std::size_t>(part * height_bins)] += 1;
    }
}

void GasMeter::save(Saver& to) const {
    const State& s = *state_;
    to(s.unit, s.room.low, s.room.high, s.column, s.last_time, s.step, s.frames, s.last, s.past, s.blocks);
}
void GasMeter::restore(Loader& from) {
    State s = *state_;
    from(s.unit, s.room.low, s.room.high, s.column, s.last_time, s.step, s.frames, s.last, s.past, s.blocks);
    const auto is_of_others = [n = s.followed.size()](const GasFrame& f) { return f.x.size() != n || f.v.size() != n; };
    if (std::any_of(s.past.begin(), s.past.end(), is_of_others) || !s.blocks.are_of(State::count))
        throw Error("GasMeter::restore: these measures are of another gas");
    *state_ = std::move(s);
}

}  // namespace carom
