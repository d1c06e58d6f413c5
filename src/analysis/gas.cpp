// The measures of a gas.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <carom/gas.hpp>
#include <cmath>
#include <limits>

#include "analysis/blocks.hpp"
#include "analysis/diffusion.hpp"
#include "analysis/gas_rows.hpp"
#include "analysis/measured_room.hpp"
#include "collision/grid.hpp"
#include "math/bits.hpp"
#include "math/elementary.hpp"

namespace carom {

namespace {

constexpr double pi = 0x1.921fb54442d18p1;
constexpr std::size_t speed_bins = 40, distance_bins = 60, height_bins = 40, lags = 50, cells = 16;
constexpr std::size_t longest_lag = lags - 1, half_lag = lags / 2;
constexpr double fastest = 4;  // in units of √(kT/m)
constexpr double highest = 8;  // in units of kT/(m g), where there is no lid

/// Where each sum lies in the samples.
enum Sum : std::size_t {
    one,
    time_passed,
    temperature,
    virial,
    wall_impulse,
    disc_collisions,
    speed,
    looks,       ///< at distances
    references,  ///< discs from which they were measured
    speeds,
    pair_distances = speeds + speed_bins,
    ways = pair_distances + distance_bins,
    memory = ways + lags,
    origins = memory + lags,
    heights = origins + lags,
    in_cells = heights + height_bins,
    count = in_cells + 5 * cells * cells
};
/// What is summed up in a cell.
enum Part : std::size_t { discs_in, momentum_x, momentum_y, kinetic_in, mass_in, parts };
static_assert(count == in_cells + parts * cells * cells);

}  // namespace

struct GasMeter::State {
    MeasuredRoom room;
    std::vector<BodyId> ids;
    std::vector<std::size_t> rows;
    std::vector<std::size_t> followed;  // among the rows
    double unit = 1;                    ///< kT at the start [J], by which speeds are binned
    double widest = 0;                  ///< disc [m]
    double mean_radius = 0;
    bool counts = false;
    bool alone = false;   ///< nothing else is in the room
    bool pushed = false;  ///< what is no disc of the gas moves: there is no one room, and no one pressure

    /// Where gravity pulls, and how far up discs are counted.
    struct Column {
        Vec2 up{};
        double floor = 0, top = 0;  ///< [m]
        double scale = 0;           ///< kT/(m g) [m]; 0 without gravity
        double lid = 0;             ///< height above the floor to which centres can be [m]; 0 if there is none
    } column;

    double last_time = 0, step = 0;
    std::uint64_t frames = 0;
    GasTally last;
    std::vector<GasFrame> past;  ///< the last ones, the newest first
    Blocks blocks{count};

    Grid grid;
    std::vector<std::uint32_t> near;

    /// That of the centres, on which the walls push a radius away from them.
    MeasuredRoom inner_room() const { return room.walls ? room.within(mean_radius) : room; }
    double discs() const { return static_cast<double>(rows.size()); }
    /// Of two degrees of freedom a disc the box takes two away, for its momentum.
    double moving() const { return discs() - (room.periodic && rows.size() > 1 ? 1 : 0); }
    /// Why there is no coefficient of diffusion, in words; empty if there is one.
    std::string keeps_from_diffusing() const;
    /// What the mean squared way grows by in the later half of what is looked at, as terms.
    std::array<Blocks::Term, 2> growth_of_ways() const;
    double narrower_side() const { return std::min(room.high.x - room.low.x, room.high.y - room.low.y); }
    /// Distances that are looked at: from contact to some diameters, and to no image.
    double farthest() const { return std::min(4 * widest, (room.periodic ? 0.5 : 0.125) * narrower_side()); }
    /// How far from walls discs are whose neighbours count: next to a wall discs lie in layers, and such are no
    /// neighbours yet.
    double margin() const { return 2 * farthest(); }
    bool has_distances() const { return widest > 0 && (room.periodic || (room.walls && alone && column.scale == 0)); }
    bool is_reference(Vec2 x) const;
    /// Around the discs whose neighbours count [1/m²]: of others, for where one is there is no other.
    double density() const;

    Vec2 drift(const World& world) const;
    double heat(const World& world) const;
    void add_velocities(const World& world, std::vector<double>& sums) const;
    void add_distances(const World& world, std::vector<double>& sums);
    void add_ways(const World& world, double passed, std::vector<double>& sums);
    void add_fields(const World& world, std::vector<double>& sums) const;
    void add_heights(const World& world, std::vector<double>& sums) const;
    void measure_column(const World& world);
    GasCurve speed_curve() const;
    GasCurve pair_correlation() const;
    GasCurve height_curve() const;
};

/// The velocity of a periodic box as a whole, which is no heat.
Vec2 GasMeter::State::drift(const World& world) const {
    if (!room.periodic || rows.size() < 2) return {};
    Vec2 p{};
    double m = 0;
    for (const std::size_t row : rows) p += world.masses()[row] * world.velocities()[row], m += world.masses()[row];
    return p / m;
}

double GasMeter::State::heat(const World& world) const {
    const Vec2 flow = drift(world);
    double sum = 0;
    for (const std::size_t row : rows)
        sum += 0.5 * world.masses()[row] * squared_length(world.velocities()[row] - flow);
    return sum;
}

GasMeter::GasMeter(const World& start) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.room = measured_room(start);
    for (std::size_t row = 0; row < start.size(); ++row) {
        s.pushed = s.pushed || start.kinds()[row] == Kind::driven;
        if (start.kinds()[row] != Kind::dynamic) continue;
        if (start.in_steps(start.ids()[row])) {
            s.pushed = true;
            continue;
        }
        s.ids.push_back(start.ids()[row]), s.rows.push_back(row);
        s.mean_radius += start.radii()[row];
        s.widest = std::max(s.widest, 2 * start.radii()[row]);
    }
    if (s.rows.empty()) throw Error("the measures of a gas are of dynamic bodies, and there is none");
    s.mean_radius /= s.discs();
    s.alone = s.rows.size() == start.size() && start.half_planes().empty() &&
              start.rectangles().size() + start.stadiums().size() == 1;
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
    s.blocks = Blocks(count);
    s.measure_column(now);
}

/// Without a lid the room is as high as the gas is after its start.
void GasMeter::State::measure_column(const World& world) {
    const Vec2 g = world.settings().gravity;
    column = {};
    if (g == Vec2{} || room.periodic) return;
    double mass = 0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::size_t row : rows) mass += world.masses()[row] / discs();
    column.up = -g / length(g);
    for (const Vec2 corner : {room.low, room.high, Vec2{room.low.x, room.high.y}, Vec2{room.high.x, room.low.y}}) {
        low = std::min(low, dot(corner, column.up));
        high = std::max(high, dot(corner, column.up));
    }
    column.scale = unit / (mass * length(g));
    column.floor = low, column.top = high;
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
    const Vec2 flow = drift(world);
    double sum = 0;
    for (const std::size_t row : rows) {
        const double v = length(world.velocities()[row] - flow), scaled = v * std::sqrt(world.masses()[row] / unit);
        sum += v;
        if (scaled < fastest) sums[speeds + static_cast<std::size_t>(scaled / fastest * speed_bins)] += 1;
    }
    sums[speed] += sum / discs();
}

bool GasMeter::State::is_reference(Vec2 x) const {
    if (room.periodic) return true;
    if (!room.round)
        return std::min({x.x - room.low.x, room.high.x - x.x, x.y - room.low.y, room.high.y - x.y}) >= margin();
    const Vec2 way = room.round->b - room.round->a, from = x - room.round->a;
    const double squared = dot(way, way), along = squared > 0 ? std::clamp(dot(from, way) / squared, 0.0, 1.0) : 0;
    return length(from - along * way) <= room.round->radius - margin();
}

double GasMeter::State::density() const {
    if (room.periodic) return (discs() - 1) / room.area();
    return blocks.ratio(references, looks) / room.within(margin()).area();
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
        if (!is_reference(x[i])) continue;
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
    const Vec2 flow = drift(world);
    for (const std::size_t k : followed) {
        now.x.push_back(world.positions()[rows[k]] - world.time() * flow);
        now.v.push_back(world.velocities()[rows[k]] - flow);
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
    for (const std::size_t row : rows) {
        const Vec2 x = world.wrapped(world.positions()[row]) - room.low, v = world.velocities()[row];
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

std::vector<GasNumber> GasMeter::numbers() const {
    const State& s = *state_;
    const Blocks& b = s.blocks;
    if (b.sum(one) == 0) return {};
    std::vector<GasNumber> all;
    const auto put = [&](std::string_view quantity, double value, double error) {
        const auto measure = std::find_if(gas_measures.begin(), gas_measures.end(),
                                          [&](const GasMeasure& m) { return m.quantity == quantity; });
        all.push_back({std::string(quantity), std::string(measure->name), std::string(measure->unit), value, error});
    };
    using Terms = std::span<const Blocks::Term>;
    const auto sum_of = [&](Terms terms) {
        double sum = 0;
        for (const Blocks::Term& t : terms) sum += t.factor * b.ratio(t.a, t.b);
        return sum;
    };
    const auto add = [&](std::string_view quantity, std::initializer_list<Blocks::Term> terms) {
        put(quantity, sum_of(terms), b.error(Terms(terms)));
    };
    add("gas.temperature", {{temperature, one, 1}});
    add("gas.mean_speed", {{speed, one, 1}});
    if (s.counts) {
        const MeasuredRoom inner = s.inner_room();
        if (!s.pushed && (s.room.periodic || s.room.walls))
            add("gas.pressure",
                {{temperature, one, s.moving() / inner.area()}, {virial, time_passed, 0.5 / inner.area()}});
        if (!s.pushed && s.room.walls) add("gas.wall_pressure", {{wall_impulse, time_passed, 1 / inner.perimeter()}});
        add("gas.collision_rate", {{disc_collisions, time_passed, 2 / s.discs()}});
        if (b.sum(disc_collisions) > 0) {
            const double rate = all.back().value, path = b.ratio(speed, one) / rate;
            const Blocks::Term changes[] = {{speed, one, 1 / rate},
                                            {disc_collisions, time_passed, -path / rate * 2 / s.discs()}};
            put("gas.mean_free_path", path, b.error(changes));
        }
    }
    if (s.keeps_from_diffusing().empty()) {
        const auto growth = s.growth_of_ways();
        const bool overlap = b.sum(origins + longest_lag) < lags;  // all ways, each with each
        put("gas.diffusion", sum_of(growth), overlap ? nan : b.error(growth));
    }
    return all;
}

std::array<Blocks::Term, 2> GasMeter::State::growth_of_ways() const {
    const double time = 4 * static_cast<double>(longest_lag - half_lag) * step;
    return {{{ways + longest_lag, origins + longest_lag, 1 / time}, {ways + half_lag, origins + half_lag, -1 / time}}};
}

std::string GasMeter::State::keeps_from_diffusing() const {
    if (!(blocks.sum(origins + longest_lag) > 0))
        return fmt::format("it takes more than {} frames: look more often, or longer", lags);
    Ways all{.shortest = static_cast<double>(half_lag) * step, .longest = static_cast<double>(longest_lag) * step};
    for (const Blocks::Term& t : growth_of_ways()) all.diffusion += t.factor * blocks.ratio(t.a, t.b);
    if (counts) all.met = 2 * blocks.ratio(disc_collisions, time_passed) / discs() * all.shortest;
    return carom::keeps_from_diffusing(all, room);
}

std::vector<GasAbsence> GasMeter::left_out() const {
    const State& s = *state_;
    if (s.blocks.sum(one) == 0) return {};
    std::vector<GasAbsence> out;
    const auto put = [&](std::string_view quantity, const std::string& why) {
        for (const auto& [known, name, unit] : gas_measures)
            if (known == quantity && !why.empty()) out.push_back({std::string(known), std::string(name), why});
    };
    const std::string outside = s.room.periodic || s.room.walls ? "" : "the gas is in no room";
    if (s.counts) put("gas.pressure", s.pushed ? "the room changes, for what is no disc moves in it" : outside);
    if (s.counts && s.blocks.sum(disc_collisions) == 0) put("gas.mean_free_path", "no disc met another one");
    put("gas.diffusion", s.keeps_from_diffusing());
    return out;
}

GasCurve GasMeter::State::speed_curve() const {
    GasCurve curve{.name = "speeds", .x_label = "v √(m/kT)", .y_label = "density", .law_name = "Maxwell"};
    const double width = fastest / speed_bins, scale = 1 / (discs() * width);
    const double cold = unit / blocks.ratio(temperature, one);  // than it is now, when it began
    for (std::size_t k = 0; k < speed_bins; ++k) {
        const double v = (static_cast<double>(k) + 0.5) * width;
        curve.x.push_back(v);
        curve.y.push_back(scale * blocks.ratio(speeds + k, one));
        curve.error.push_back(scale * blocks.error(speeds + k, one));
        curve.law.push_back(cold * v * portable::exp(-0.5 * cold * v * v));
    }
    return curve;
}

GasCurve GasMeter::State::pair_correlation() const {
    GasCurve g{.name = "pair correlation", .x_label = "r [m]", .y_label = "g(r)"};
    const double width = farthest() / distance_bins, others = density();
    for (std::size_t k = 0; k < distance_bins; ++k) {
        const double r = static_cast<double>(k) * width, ring = (r + width) * (r + width) - r * r;
        const double expected = others * pi * ring;
        g.x.push_back(r + 0.5 * width);
        g.y.push_back(blocks.ratio(pair_distances + k, references) / expected);
        g.error.push_back(blocks.error(pair_distances + k, references) / expected);
    }
    return g;
}

/// Beside it that of points of one mass: N/H e^(−h/H) from a radius above the floor on, as much as is below a lid.
GasCurve GasMeter::State::height_curve() const {
    GasCurve curve{
        .name = "density by height", .x_label = "h [m]", .y_label = "discs a m of height", .law_name = "ideal gas"};
    const double width = (column.top - column.floor) / height_bins;
    const double scale = blocks.ratio(temperature, one) / unit * column.scale;
    const auto below = [&](double h) {  // the part of an ideal gas
        const double all = column.lid > 0 ? 1 - portable::exp(-column.lid / scale) : 1;
        const double up = std::max(0.0, column.lid > 0 ? std::min(h, column.lid) : h);
        return (1 - portable::exp(-up / scale)) / all;
    };
    for (std::size_t k = 0; k < height_bins; ++k) {
        const double low = static_cast<double>(k) * width - mean_radius;
        curve.x.push_back((static_cast<double>(k) + 0.5) * width);
        curve.y.push_back(blocks.ratio(heights + k, one) / width);
        curve.error.push_back(blocks.error(heights + k, one) / width);
        curve.law.push_back(discs() * (below(low + width) - below(low)) / width);
    }
    return curve;
}

std::vector<GasCurve> GasMeter::curves() const {
    const State& s = *state_;
    const Blocks& b = s.blocks;
    if (b.sum(one) == 0) return {};
    std::vector<GasCurve> all{s.speed_curve()};
    if (b.sum(references) > 0) all.push_back(s.pair_correlation());
    GasCurve way{.name = "mean squared way", .x_label = "t [s]", .y_label = "way² [m²]"};
    GasCurve memory_curve{.name = "memory of the velocity", .x_label = "t [s]", .y_label = "⟨v(0)·v(t)⟩ [m²/s²]"};
    for (std::size_t lag = 0; lag < lags && b.sum(origins + lag) > 0; ++lag) {
        for (auto [curve, sums] : {std::pair{&way, ways}, std::pair{&memory_curve, memory}}) {
            curve->x.push_back(static_cast<double>(lag) * s.step);
            curve->y.push_back(b.ratio(sums + lag, origins + lag));
            curve->error.push_back(b.error(sums + lag, origins + lag));
        }
    }
    all.push_back(std::move(way));
    all.push_back(std::move(memory_curve));
    if (s.column.scale > 0) all.push_back(s.height_curve());
    return all;
}

std::vector<GasMeter::Field> GasMeter::fields() const {
    const State& s = *state_;
    const Blocks& b = s.blocks;
    const Vec2 size = s.room.high - s.room.low, cell = size / static_cast<double>(cells);
    std::vector<Field> all;
    if (!(size.x > 0 && size.y > 0) || b.sum(one) == 0) return all;
    for (std::size_t k = 0; k < cells * cells; ++k) {
        const auto in = [k](Part part) { return in_cells + parts * k + part; };
        const Vec2 at{static_cast<double>(k % cells) + 0.5, static_cast<double>(k / cells) + 0.5};
        const double area = cell.x * cell.y;
        Field f{.centre = s.room.low + Vec2{at.x * cell.x, at.y * cell.y}};
        f.density = b.ratio(in(discs_in), one) / area;
        f.density_error = b.error(in(discs_in), one) / area;
        if (b.sum(in(discs_in)) > 0) {
            f.flow = Vec2{b.ratio(in(momentum_x), in(mass_in)), b.ratio(in(momentum_y), in(mass_in))};
            f.flow_error = Vec2{b.error(in(momentum_x), in(mass_in)), b.error(in(momentum_y), in(mass_in))};
            // What the flow seems to be by chance alone is heat.
            const double flow = squared_length(f.flow) - squared_length(f.flow_error);
            const double of_flow = 0.5 * flow * b.ratio(in(mass_in), in(discs_in));
            f.temperature = b.ratio(in(kinetic_in), in(discs_in)) - of_flow;
            f.temperature_error = b.error(in(kinetic_in), in(discs_in));
        }
        all.push_back(f);
    }
    return all;
}

void GasMeter::save(Saver& to) const {
    const State& s = *state_;
    to(s.unit, s.room.low, s.room.high, s.column, s.last_time, s.step, s.frames, s.last, s.past, s.blocks);
}
void GasMeter::restore(Loader& from) {
    State s = *state_;
    from(s.unit, s.room.low, s.room.high, s.column, s.last_time, s.step, s.frames, s.last, s.past, s.blocks);
    const auto is_of_others = [n = s.followed.size()](const GasFrame& f) { return f.x.size() != n || f.v.size() != n; };
    if (std::any_of(s.past.begin(), s.past.end(), is_of_others) || !s.blocks.are_of(count))
        throw Error("GasMeter::restore: these measures are of another gas");
    *state_ = std::move(s);
}

}  // namespace carom
