// The pictures that a mechanics report needs, made from plain data.

#include <fmt/format.h>

#include <algorithm>
#include <carom/output.hpp>
#include <cmath>

#include "output/axis.hpp"
#include "output/heat.hpp"
#include "output/ink.hpp"

namespace carom {
namespace {

constexpr Colour black{0, 0, 0, 255};

void same_length(std::size_t a, std::size_t b, const std::string& what) {
    if (a != b) throw Error(fmt::format("{}: {} values at {} times", what, b, a));
}

std::vector<double> copy(std::span<const double> values) { return {values.begin(), values.end()}; }

std::vector<Line> outline(const Rectangle& room) {
    const Vec2 a = room.low, b{room.high.x, room.low.y}, c = room.high, d{room.low.x, room.high.y};
    return {{a, b}, {b, c}, {c, d}, {d, a}};
}

Panel plane(const std::optional<Rectangle>& room) {
    Panel panel{.x_label = "x [m]", .y_label = "y [m]", .equal_aspect = true};
    if (room) panel.lines = outline(*room);
    return panel;
}

/// "x" of "x [m]", to build "error of x [m]".
std::pair<std::string, std::string> name_and_unit(const std::string& label) {
    const auto bracket = label.rfind(" [");
    if (bracket == label.npos) return {label, ""};
    return {label.substr(0, bracket), label.substr(bracket)};
}

/// A curve for each account, the total first; with `change` from what it was at the first time.
std::vector<Curve> account_curves(std::span<const double> time, std::span<const Energy> energy, bool change) {
    struct Account {
        const char* name;
        double (*value)(const Energy&);
        Stroke stroke;
        Colour colour;
    };
    // Stored energy in full lines, heat dashed and work dotted, so that seven colours are enough.
    static const Account accounts[] = {
        {"total", [](const Energy& e) { return e.total(); }, Stroke::line, black},
        {"kinetic", [](const Energy& e) { return e.kinetic; }, Stroke::line, palette(0)},
        {"rotational", [](const Energy& e) { return e.rotational; }, Stroke::line, palette(4)},
        {"gravity", [](const Energy& e) { return e.gravity; }, Stroke::line, palette(3)},
        {"springs", [](const Energy& e) { return e.spring; }, Stroke::line, palette(2)},
        {"fields", [](const Energy& e) { return e.field; }, Stroke::line, palette(5)},
        {"heat: damping", [](const Energy& e) { return e.heat.damping; }, Stroke::dashed, palette(2)},
        {"heat: drag", [](const Energy& e) { return e.heat.drag; }, Stroke::dashed, palette(1)},
        {"heat: impact", [](const Energy& e) { return e.heat.impact; }, Stroke::dashed, palette(3)},
        {"heat: friction", [](const Energy& e) { return e.heat.friction; }, Stroke::dashed, palette(5)},
        {"heat: joints", [](const Energy& e) { return e.heat.joint_damping + e.heat.joint_friction + e.heat.limit; },
         Stroke::dashed, palette(0)},
        {"heat: baths", [](const Energy& e) { return e.heat.bath; }, Stroke::dashed, palette(4)},
        {"work: motor", [](const Energy& e) { return e.work.motor; }, Stroke::dotted, palette(3)},
        {"work: driven", [](const Energy& e) { return e.work.driven; }, Stroke::dotted, palette(0)},
        {"work: wind", [](const Energy& e) { return e.work.wind; }, Stroke::dotted, palette(1)},
        {"work: user", [](const Energy& e) { return e.work.user; }, Stroke::dotted, palette(5)},
        {"work: overlap", [](const Energy& e) { return e.work.overlap + e.work.correction; }, Stroke::dotted, black}};
    std::vector<Curve> curves;
    for (const auto& [name, value, stroke, colour] : accounts) {
        Curve curve{.label = name, .x = copy(time), .stroke = stroke, .colour = colour};
        const double from = change && !energy.empty() ? value(energy.front()) : 0;
        for (const Energy& e : energy) curve.y.push_back(value(e) - from);
        curves.push_back(std::move(curve));
    }
    curves.front().width = 2;  // below the others, and seen where one of them is all there is
    return curves;
}

/// Through a picture or past it; as far as the axes take account of it, it is as long as the picture is wide.
void add_walls(Panel& panel, std::span<const HalfPlane> walls, const Interval& x, const Interval& y) {
    const Vec2 middle{0.5 * (x.low + x.high), 0.5 * (y.low + y.high)};
    const double half = 0.5 * std::max(x.high - x.low, y.high - y.low);
    for (const HalfPlane& wall : walls) {
        const Vec2 n = wall.normal / length(wall.normal);
        const Vec2 foot = middle - dot(middle - wall.point, n) * n, along = half * perpendicular(n);
        if (std::isfinite(foot.x + foot.y + half)) panel.endless.push_back({foot - along, foot + along});
    }
}

/// Below all else. What is larger than the picture, as a long floor, does not make that smaller.
void add_surroundings(Panel& panel, const Moment& around) {
    const Axes own = axes(panel);
    const Vec2 size{own.x.high - own.x.low, own.y.high - own.y.low};
    const double most = std::max(size.x, size.y);
    std::vector<ShapeMark> shapes, large;
    std::vector<DiscMark> discs, large_discs;
    for (const ShapeMark& shape : around.shapes) {
        Vec2 low{INFINITY, INFINITY}, high = -low;
        for (const Vec2 point : shape.points) {
            low = {std::min(low.x, point.x), std::min(low.y, point.y)};
            high = {std::max(high.x, point.x), std::max(high.y, point.y)};
        }
        (std::max(high.x - low.x, high.y - low.y) > most ? large : shapes).push_back(shape);
    }
    for (const DiscMark& disc : around.discs) (2 * disc.radius > most ? large_discs : discs).push_back(disc);
    panel.shapes.insert(panel.shapes.begin(), shapes.begin(), shapes.end());
    panel.discs.insert(panel.discs.begin(), discs.begin(), discs.end());
    if (large.empty() && large_discs.empty()) return;
    const Axes all = axes(panel);
    panel.x_range = Interval{all.x.low, all.x.high};
    panel.y_range = Interval{all.y.low, all.y.high};
    panel.shapes.insert(panel.shapes.begin(), large.begin(), large.end());
    panel.discs.insert(panel.discs.begin(), large_discs.begin(), large_discs.end());
}

/// How far a body reaches from its place to all sides, however it is turned there.
double reach_of(const Track& track) {
    double reach = track.radius;
    const Vec2 place = track.points.back();
    for (const ShapeMark& shape : track.shapes) {
        double nearest = INFINITY;
        for (std::size_t i = 1; i < shape.points.size(); ++i) {
            const Vec2 from = shape.points[i - 1] - place, along = shape.points[i] - shape.points[i - 1];
            const double part = squared_length(along) > 0 ? -dot(from, along) / squared_length(along) : 0;
            nearest = std::min(nearest, length(from + std::clamp(part, 0.0, 1.0) * along));
        }
        if (shape.look == Look::filled) reach = std::max(reach, nearest);
    }
    return reach;
}

/// What bodies rest on is to be seen: there their rim is, not their place.
void include_rims(Panel& panel, const Interval& x, const Interval& y) {
    const Axes all = axes(panel);
    if (!(x.low < all.x.low || x.high > all.x.high || y.low < all.y.low || y.high > all.y.high)) return;
    const double margin = 0.03 * std::max(x.high - x.low, y.high - y.low);
    const auto around = [&](const Axis& axis, const Interval& rims) {
        return Interval{std::min(axis.low, rims.low - margin), std::max(axis.high, rims.high + margin)};
    };
    panel.x_range = around(all.x, x);
    panel.y_range = around(all.y, y);
}

}  // namespace

Figure trajectory_figure(std::span<const Track> tracks, const std::optional<Rectangle>& room,
                         std::span<const HalfPlane> walls, const Moment& around) {
    Panel panel = plane(room);
    panel.lines.insert(panel.lines.end(), around.lines.begin(), around.lines.end());
    Interval x{INFINITY, -INFINITY}, y = x;
    for (const Track& track : tracks) {
        const double reach = track.points.empty() ? 0 : reach_of(track);
        for (const Vec2 point : track.points) {
            x = {std::min(x.low, point.x - reach), std::max(x.high, point.x + reach)};
            y = {std::min(y.low, point.y - reach), std::max(y.high, point.y + reach)};
        }
    }
    add_walls(panel, walls, x, y);
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        const Track& track = tracks[i];
        if (track.points.empty()) continue;
        const Colour colour = track.colour.value_or(palette(i)), ink = on_white(colour);
        Curve path{.label = track.label, .stroke = next_stroke(panel.curves, ink), .colour = ink, .width = 0.8};
        for (Vec2 point : track.points) {
            path.x.push_back(point.x);
            path.y.push_back(point.y);
        }
        const Vec2 start = track.points.front();
        const bool moves = std::any_of(track.points.begin(), track.points.end(), [&](Vec2 p) { return p != start; });
        // Its path is to be seen on it.
        const Colour fill = moves && (track.radius > 0 || !track.shapes.empty()) ? pale(colour) : colour;
        panel.curves.push_back(std::move(path));
        if (moves) panel.curves.push_back({.x = {start.x}, .y = {start.y}, .stroke = Stroke::ring, .colour = ink});
        if (track.shapes.empty()) panel.discs.push_back({track.points.back(), track.radius, fill});
        for (const ShapeMark& shape : track.shapes)  // what is filled has a dark outline
            panel.shapes.push_back({shape.points, shape.look, shape.look == Look::filled ? fill : ink});
    }
    add_surroundings(panel, around);
    include_rims(panel, x, y);
    return {.panels = {std::move(panel)}};
}

Figure time_figure(std::span<const double> time, std::span<const Series> series, std::string y_label) {
    Panel panel{.x_label = "t [s]", .y_label = std::move(y_label)};
    for (std::size_t i = 0; i < series.size(); ++i) {
        same_length(time.size(), series[i].values.size(), series[i].label);
        const Colour colour = on_white(series[i].colour.value_or(palette(i)));
        panel.curves.push_back({.label = series[i].label,
                                .x = copy(time),
                                .y = series[i].values,
                                .stroke = next_stroke(panel.curves, colour),
                                .colour = colour});
    }
    return {.panels = {std::move(panel)}};
}

Figure phase_figure(std::span<const Series> position, std::span<const Series> velocity, std::string x_label,
                    std::string v_label) {
    same_length(position.size(), velocity.size(), "phase portrait");
    Panel panel{.x_label = std::move(x_label), .y_label = std::move(v_label)};
    for (std::size_t i = 0; i < position.size(); ++i) {
        const auto &x = position[i].values, &v = velocity[i].values;
        same_length(x.size(), v.size(), position[i].label);
        const Colour colour = on_white(position[i].colour.value_or(palette(i)));
        // The axes say what a single curve is.
        panel.curves.push_back({.label = position.size() > 1 ? position[i].label : "",
                                .x = x,
                                .y = v,
                                .stroke = next_stroke(panel.curves, colour),
                                .colour = colour});
        if (x.empty()) continue;
        panel.curves.push_back({.x = {x.front()}, .y = {v.front()}, .stroke = Stroke::ring, .colour = colour});
    }
    return {.panels = {std::move(panel)}};
}

Figure energy_figure(std::span<const double> time, std::span<const Energy> energy, bool change) {
    same_length(time.size(), energy.size(), "energy");
    Panel top{.x_label = "t [s]", .y_label = change ? "change of energy [J]" : "energy [J]"};
    // Zero belongs to the picture: a constant energy is a line far above it, not an axis of many digits.
    Interval range{0, 0};
    std::vector<Curve> curves = account_curves(time, energy, change);
    for (const Curve& curve : curves) {
        for (double y : curve.y) range = {std::min(range.low, y), std::max(range.high, y)};
    }
    const double size = range.high - range.low;
    if (size > 0) top.y_range = Interval{range.low - 0.06 * size, range.high + 0.06 * size};
    // Rounding may leave 1e-15 J of heat where nothing rubs.
    const auto visible = [&](double y) { return std::abs(y) > 1e-9 * size; };
    for (Curve& curve : curves) {
        if (std::any_of(curve.y.begin(), curve.y.end(), visible)) top.curves.push_back(std::move(curve));
    }
    Panel bottom{.x_label = "t [s]", .y_label = "residual [J]", .height = 0.45};
    Curve residual{.x = copy(time), .colour = palette(3)};
    for (const Energy& e : energy) residual.y.push_back(e.residual);
    // None at all is shown as what it is, beside an energy that has a size.
    const auto none = [](double r) { return r == 0; };
    if (size > 0 && std::all_of(residual.y.begin(), residual.y.end(), none))
        bottom.y_range = Interval{-1e-12 * size, 1e-12 * size};
    bottom.curves.push_back(std::move(residual));
    return {.panels = {std::move(top), std::move(bottom)}, .shared_x = true};
}

/// Around all bodies of all moments, what holds them, and the room.
Panel same_view(std::span<const Moment> moments, const std::optional<Rectangle>& room) {
    Panel panel = plane(room);
    Interval x{INFINITY, -INFINITY}, y = x;
    const auto widen = [](Interval& range, double low, double high) {
        range = {std::min(range.low, low), std::max(range.high, high)};
    };
    if (room) widen(x, room->low.x, room->high.x), widen(y, room->low.y, room->high.y);
    const auto include = [&](Vec2 point, double radius) {
        widen(x, point.x - radius, point.x + radius), widen(y, point.y - radius, point.y + radius);
    };
    for (const Moment& moment : moments) {
        for (const DiscMark& disc : moment.discs) include(disc.centre, disc.radius);
        for (const ShapeMark& shape : moment.shapes)
            for (const Vec2 point : shape.points) include(point, 0);
        for (const Line& line : moment.lines) include(line.from, 0), include(line.to, 0);
    }
    const double margin = 0.04 * std::max(x.high - x.low, y.high - y.low);
    if (!(margin > 0) || !std::isfinite(margin)) return panel;  // a point: the figure finds a range around it
    panel.x_range = Interval{x.low - margin, x.high + margin};
    panel.y_range = Interval{y.low - margin, y.high + margin};
    return panel;
}

Figure snapshot_figure(std::span<const Moment> moments, const std::optional<Rectangle>& room,
                       std::span<const HalfPlane> walls) {
    Figure figure;
    Panel view = same_view(moments, room);
    if (view.x_range && view.y_range) add_walls(view, walls, *view.x_range, *view.y_range);
    figure.columns = moments.size() < 2 ? 1 : moments.size() % 3 == 0 && moments.size() > 4 ? 3 : 2;
    for (const Moment& moment : moments) {
        Panel panel = view;
        panel.title = time_words(moment.time);
        panel.discs = moment.discs;
        panel.shapes = moment.shapes;
        panel.lines.insert(panel.lines.end(), moment.lines.begin(), moment.lines.end());
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

Panel map_panel(HeatMap map, std::string x_label, std::string y_label, bool log_x, bool log_y) {
    Panel panel{.x_label = std::move(x_label), .y_label = std::move(y_label), .height = 1.3};
    check(map, panel.log_x = log_x, panel.log_y = log_y);
    if (const auto edges = edges_of(map.x, log_x); !edges.empty())
        panel.x_range = with_room(edges.front(), edges.back());
    if (const auto edges = edges_of(map.y, log_y); !edges.empty())
        panel.y_range = with_room(edges.front(), edges.back());
    panel.map = std::move(map);
    return panel;
}

Figure comparison_figure(std::span<const double> time, std::span<const double> simulated,
                         std::span<const double> analytic, std::string y_label) {
    same_length(time.size(), simulated.size(), "simulated");
    same_length(time.size(), analytic.size(), "analytic");
    const auto [name, unit] = name_and_unit(y_label);
    Curve exact{.label = "analytic", .x = copy(time), .y = copy(analytic), .colour = black, .width = 0.8};
    // So few points that the curve between them can be seen.
    Curve points{.label = "simulated", .stroke = Stroke::points, .colour = palette(3)};
    const std::size_t stride = std::max<std::size_t>(1, time.size() / 60);
    for (std::size_t i = 0; i < time.size(); i += stride) {
        points.x.push_back(time[i]);
        points.y.push_back(simulated[i]);
    }
    Curve error{.x = copy(time), .colour = palette(3)};
    for (std::size_t i = 0; i < time.size(); ++i) error.y.push_back(simulated[i] - analytic[i]);
    Panel top{.x_label = "t [s]", .y_label = y_label, .curves = {std::move(exact), std::move(points)}};
    Panel bottom{
        .x_label = "t [s]", .y_label = "error of " + name + unit, .height = 0.45, .curves = {std::move(error)}};
    return {.panels = {std::move(top), std::move(bottom)}, .shared_x = true};
}

}  // namespace carom
