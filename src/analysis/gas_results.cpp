// The measures of a gas: what is made of what was seen.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/gas_state.hpp"
#include "math/bits.hpp"
#include "math/elementary.hpp"

namespace carom {

double GasMeter::State::density() const {
    if (room.periodic) return (discs() - 1) / room.area();
    return blocks.ratio(references, looks) / room.within(margin()).area();
}

std::vector<GasNumber> GasMeter::numbers() const {
    using enum State::Sum;
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
        if (s.keeps_from_pressing().empty())
            add("gas.pressure",
                {{temperature, one, s.moving() / inner.area()}, {virial, time_passed, 0.5 / inner.area()}});
        if (s.keeps_from_pressing_walls().empty())
            add("gas.wall_pressure", {{wall_impulse, time_passed, 1 / inner.perimeter()}});
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
        const bool overlap = b.sum(origins + State::longest_lag) < State::lags;  // all ways, each with each
        put("gas.diffusion", sum_of(growth), overlap ? nan : b.error(growth));
        const Ways ways = s.grown_ways();
        all.back().from = ways.shortest, all.back().to = ways.longest;
    }
    return all;
}

std::array<Blocks::Term, 2> GasMeter::State::growth_of_ways() const {
    const double time = 4 * static_cast<double>(longest_lag - half_lag) * step;
    return {{{ways + longest_lag, origins + longest_lag, 1 / time}, {ways + half_lag, origins + half_lag, -1 / time}}};
}

std::string GasMeter::State::keeps_from_pressing() const {
    if (pushed) return "the room changes, for what is no disc moves in it";
    if (!room.periodic && !room.walls)
        return "the gas is in no rectangle, stadium or periodic box, whose area is known";
    if (!room.empty)
        return "fixed bodies or further walls take a part of the room, and the virial knows of discs alone";
    return "";
}

std::string GasMeter::State::keeps_from_pressing_walls() const {
    if (pushed) return keeps_from_pressing();
    if (!room.walls) return "the gas is between no walls";
    return room.open ? "" : "fixed bodies or further walls may keep the gas from a part of the walls";
}

Ways GasMeter::State::grown_ways() const {
    return {.shortest = static_cast<double>(half_lag) * step,
            .longest = static_cast<double>(longest_lag) * step,
            .fall = falls};
}

std::string GasMeter::State::keeps_from_diffusing() const {
    if (!(blocks.sum(origins + longest_lag) > 0))
        return fmt::format("it takes more than {} frames: look more often, or longer", lags);
    Ways all = grown_ways();
    for (const Blocks::Term& t : growth_of_ways()) all.diffusion += t.factor * blocks.ratio(t.a, t.b);
    if (counts) all.met = 2 * blocks.ratio(disc_collisions, time_passed) / discs() * all.shortest;
    return carom::keeps_from_diffusing(all, room);
}

std::vector<GasAbsence> GasMeter::left_out() const {
    using enum State::Sum;
    const State& s = *state_;
    if (s.blocks.sum(one) == 0) return {};
    std::vector<GasAbsence> out;
    const auto put = [&](std::string_view quantity, const std::string& why) {
        for (const auto& [known, name, unit] : gas_measures)
            if (known == quantity && !why.empty()) out.push_back({std::string(known), std::string(name), why});
    };
    if (s.counts) put("gas.pressure", s.keeps_from_pressing());
    if (s.counts && s.room.walls) put("gas.wall_pressure", s.keeps_from_pressing_walls());
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
    constexpr double pi = 0x1.921fb54442d18p1;
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

/// Beside that of a column that of points: N/H e^(−h/H) from a radius above the floor on, as much as is below a lid.
GasCurve GasMeter::State::height_curve() const {
    GasCurve curve{.name = "density by height", .x_label = "h [m]", .y_label = "discs a m of height"};
    if (is_column) curve.law_name = "ideal gas";
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
        if (is_column) curve.law.push_back(discs() * (below(low + width) - below(low)) / width);
    }
    return curve;
}

std::vector<GasCurve> GasMeter::curves() const {
    using enum State::Sum;
    const State& s = *state_;
    const Blocks& b = s.blocks;
    if (b.sum(one) == 0) return {};
    std::vector<GasCurve> all{s.speed_curve()};
    if (b.sum(references) > 0) all.push_back(s.pair_correlation());
    GasCurve way{.name = "mean squared way", .x_label = "t [s]", .y_label = "way² [m²]"};
    GasCurve memory_curve{.name = "memory of the velocity", .x_label = "t [s]", .y_label = "⟨v(0)·v(t)⟩ [m²/s²]"};
    for (std::size_t lag = 0; lag < State::lags && b.sum(origins + lag) > 0; ++lag) {
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
    using enum State::Sum;
    using enum State::Part;
    constexpr std::size_t cells = State::cells;
    const State& s = *state_;
    const Blocks& b = s.blocks;
    const Vec2 size = s.room.high - s.room.low, cell = size / static_cast<double>(cells);
    std::vector<Field> all;
    if (!(size.x > 0 && size.y > 0) || b.sum(one) == 0) return all;
    const Vec2 drift{b.ratio(drift_x, one), b.ratio(drift_y, one)};
    for (std::size_t k = 0; k < cells * cells; ++k) {
        const auto in = [k](State::Part part) { return in_cells + parts * k + part; };
        const Vec2 at{static_cast<double>(k % cells) + 0.5, static_cast<double>(k / cells) + 0.5};
        const double area = cell.x * cell.y;
        Field f{.centre = s.room.low + Vec2{at.x * cell.x, at.y * cell.y}};
        f.density = b.ratio(in(discs_in), one) / area;
        f.density_error = b.error(in(discs_in), one) / area;
        if (b.sum(in(discs_in)) > 0) {
            const Vec2 flow{b.ratio(in(momentum_x), in(mass_in)), b.ratio(in(momentum_y), in(mass_in))};
            f.flow = drift + flow;
            f.flow_error = Vec2{b.error(in(momentum_x), in(mass_in)), b.error(in(momentum_y), in(mass_in))};
            // What the flow seems to be by chance alone is heat.
            const double squared = squared_length(flow) - squared_length(f.flow_error);
            // Of its two degrees of freedom a disc of mass m leaves 2 m/M to the momentum of a box that drifts.
            const double moving = b.sum(in(discs_in)) - (s.drifts() ? b.sum(in(mass_in)) / s.mass : 0);
            f.temperature = (b.sum(in(kinetic_in)) - 0.5 * squared * b.sum(in(mass_in))) / moving;
            f.temperature_error = b.error(in(kinetic_in), in(discs_in)) * b.sum(in(discs_in)) / moving;
        }
        all.push_back(f);
    }
    return all;
}

}  // namespace carom
