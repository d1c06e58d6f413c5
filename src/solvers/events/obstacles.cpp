#include "solvers/events/obstacles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/roots.hpp"

namespace carom {

double descent(double c0, double c1, double c2) {
    if (c2 == 0) return c1 < 0 ? std::max(0.0, c0) / -c1 : gas_never;
    const double inside = c1 * c1 - 4 * c2 * c0;
    if (c0 <= 0) {  // it touches: it comes nearer, or departs and perhaps returns
        if (c1 < 0 || (c1 == 0 && c2 < 0)) return 0;
        if (c2 > 0) return gas_never;
        return inside > 0 ? (-c1 - std::sqrt(inside)) / (2 * c2) : -c1 / (2 * c2);
    }
    if (inside < 0 || (c2 > 0 && c1 >= 0)) return gas_never;
    const double root = std::sqrt(inside);
    return c1 <= 0 ? c0 / (0.5 * (-c1 + root)) : -0.5 * (c1 + root) / c2;
}

namespace {

/// Until the centre of a disc, seen from a point, comes as near as a distance.
double approach(Vec2 x, Vec2 v, Vec2 g, double distance) {
    const double b = dot(x, v), c = dot(x, x) - distance * distance;
    if (g == Vec2{}) {
        if (b >= 0) return gas_never;
        if (c <= 0) return 0;
        const double vv = dot(v, v), inside = b * b - vv * c;
        return inside < 0 ? gas_never : c / (-b + std::sqrt(inside));
    }
    const std::array gap{c, 2 * b, dot(v, v) + dot(x, g), dot(v, g), 0.25 * dot(g, g)};
    return first_descent(gap, gas_never).value_or(gas_never);
}

Vec2 place(const GasFlight& f, double t) { return f.x + t * (f.v + 0.5 * t * f.g); }

/// Which side of a line the disc is on: where it is, or, if it is on the line, where it goes.
double side_of(Vec2 normal, const GasFlight& f, double length) {
    const double away = dot(normal, f.x);
    if (std::abs(away) > 1e-13 * length) return away > 0 ? 1 : -1;
    return dot(normal, f.v) >= 0 ? 1 : -1;
}

/// The same of a gap below zero that has to open first.
double return_of(double c0, double c1, double c2) {
    if (!(c1 > 0 && c2 < 0)) return gas_never;
    const double inside = c1 * c1 - 4 * c2 * c0;
    return inside > 0 ? -0.5 * (c1 + std::sqrt(inside)) / c2 : gas_never;
}

/// A line from a to b with round ends: whichever of its two faces and its ends is first. A parabola comes down on the
/// near face once at most, and on the far one if it went past an end.
double time_to_line(const GasObstacle& o, const GasFlight& f) {
    const Vec2 way = o.b - o.a;
    const double reach = o.radius + f.radius, long_squared = dot(way, way);
    const Vec2 n = side_of(o.normal, f, std::sqrt(long_squared)) * o.normal;
    double first = gas_never;
    const auto face = [&](double t) {
        if (!(t < first)) return;
        const double along = dot(place(f, t), way);
        if (along >= 0 && along <= long_squared) first = t;
    };
    const double away = dot(n, f.x), departs = dot(n, f.v), pulled = 0.5 * dot(n, f.g);
    face(descent(away - reach, departs, pulled));
    face(return_of(-away - reach, -departs, -pulled));
    if (reach == 0) return first;  // a point misses the ends of a line without thickness
    const auto end = [&](Vec2 x, double sign) {
        const double t = approach(x, f.v, f.g, reach);
        if (!(t < first)) return;
        if (sign * dot(x + (place(f, t) - f.x), way) >= 0) first = t;
    };
    end(f.x, -1);
    end(f.x - way, 1);
    return first;
}

/// Until the centre of a disc in a circle around the origin leaves it.
double departure(const GasFlight& f, double radius) {
    const double b = dot(f.x, f.v), c = dot(f.x, f.x) - radius * radius;
    if (f.g == Vec2{}) {
        const double vv = dot(f.v, f.v);
        if (vv == 0) return gas_never;
        if (c >= 0 && b > 0) return 0;
        // Of what touches and by rounding never comes inside, |…|: it leaves when it would have come out.
        const double root = std::sqrt(std::abs(b * b - vv * c));
        return b > 0 ? -c / (b + root) : (root - b) / vv;
    }
    const std::array gap{-c, -2 * b, -(dot(f.v, f.v) + dot(f.x, f.g)), -dot(f.v, f.g), -0.25 * dot(f.g, f.g)};
    return first_descent(gap, gas_never).value_or(gas_never);
}

GasFlight later(const GasFlight& f, double t) { return {place(f, t), f.v + t * f.g, f.g, f.radius}; }

/// Until it leaves through a round end, whose half of a circle is on that side of its centre. With gravity it may be
/// there twice.
double time_to_end(const GasFlight& f, Vec2 out, double radius) {
    double passed = 0;
    for (int k = 0; k < 3; ++k) {
        const GasFlight now = later(f, passed);
        const double beyond = dot(out, now.x);
        const double enters = beyond >= 0 ? 0 : descent(-beyond, -dot(out, now.v), -0.5 * dot(out, now.g));
        if (enters == gas_never) return gas_never;
        passed += enters;
        const double leaves = departure(later(f, passed), radius);
        if (leaves == gas_never) return gas_never;
        passed += leaves;
        if (dot(out, place(f, passed)) >= 0) return passed;
    }
    return gas_never;
}

/// The inside of a line with round ends: whichever of its two sides and ends comes first.
double time_to_leave(const GasObstacle& o, const GasFlight& f) {
    const Vec2 way = o.b - o.a;
    const double room = o.radius - f.radius;
    if (way == Vec2{}) return time_to_end(f, {}, room);
    GasFlight from_b = f;
    from_b.x -= way;
    double first = std::min(time_to_end(f, -way, room), time_to_end(from_b, way, room));
    for (const Vec2 n : {o.normal, -o.normal}) {
        const double t = descent(room - dot(n, f.x), -dot(n, f.v), -0.5 * dot(n, f.g));
        if (!(t < first)) continue;
        const double along = dot(place(f, t), way);
        if (along >= 0 && along <= dot(way, way)) first = t;
    }
    return first;
}

}  // namespace

double time_to(const GasObstacle& o, const GasFlight& f) {
    if (o.hollow) return time_to_leave(o, f);
    if (o.endless) return descent(dot(o.normal, f.x) - f.radius, dot(o.normal, f.v), 0.5 * dot(o.normal, f.g));
    if (o.a == o.b) return o.radius + f.radius > 0 ? approach(f.x, f.v, f.g, o.radius + f.radius) : gas_never;
    return time_to_line(o, f);
}

namespace {

/// From the nearest point of the obstacle's line to the disc's centre.
Vec2 away_from(const GasObstacle& o, Vec2 x) {
    const Vec2 way = o.b - o.a;
    const double squared = dot(way, way);
    if (squared == 0) return x;
    return x - std::clamp(dot(x, way) / squared, 0.0, 1.0) * way;
}

}  // namespace

Vec2 normal_at(const GasObstacle& o, const GasFlight& f) {
    if (o.endless) return o.normal;
    const Vec2 away = away_from(o, f.x);
    const double distance = length(away);
    if (o.hollow) return distance > 0 ? -away / distance : o.normal;
    // A point on a line without thickness: what is left of the distance is rounding.
    if (distance <= 1e-9 * (o.radius + f.radius) || o.radius + f.radius == 0) {
        if (o.a == o.b) return -f.v / length(f.v);
        return dot(o.normal, f.v) > 0 ? -o.normal : o.normal;
    }
    return away / distance;
}

double gap_to(const GasObstacle& o, const GasFlight& f) {
    if (o.endless) return dot(o.normal, f.x) - f.radius;
    if (o.hollow) return o.radius - f.radius - length(away_from(o, f.x));
    return length(away_from(o, f.x)) - o.radius - f.radius;
}

std::vector<GasObstacle> obstacles_of(const Walls& walls, const Bodies& bodies, const State& state,
                                      const std::vector<Piece>& pieces) {
    std::vector<GasObstacle> all;
    for (const Wall& wall : walls.all)
        all.push_back({.a = wall.offset * wall.normal,
                       .b = wall.offset * wall.normal,
                       .normal = wall.normal,
                       .endless = true,
                       .restitution = wall.restitution,
                       .friction = wall.friction,
                       .temperature = wall.temperature.value_or(0)});
    for (const Stadium& wall : walls.round)
        all.push_back(
            {.a = wall.a,
             .b = wall.b,
             .normal = wall.a == wall.b ? Vec2{0, 1} : perpendicular(wall.b - wall.a) / length(wall.b - wall.a),
             .hollow = true,
             .radius = wall.radius,
             .restitution = wall.side.restitution,
             .friction = wall.side.friction,
             .temperature = wall.side.temperature.value_or(0)});
    for (const Piece& piece : pieces) {
        const std::uint32_t row = piece.row;
        if (bodies.inverse_mass[row] != 0 || piece.sensor) continue;
        const Frame frame = frame_at(state.x.linear[row], state.x.angular[row]);
        GasObstacle o{.radius = piece.outline.radius,
                      .restitution = piece.restitution,
                      .friction = piece.friction,
                      .v = state.v.linear[row],
                      .spin = state.v.angular[row],
                      .row = row};
        o.moves = o.v != Vec2{};
        const int corners = piece.outline.count, edges = corners == 2 ? 1 : corners;
        for (int i = 0; i < edges; ++i) {
            o.a = frame.position + frame.turn(piece.outline.corner[i]);
            o.b = frame.position + frame.turn(piece.outline.corner[(i + 1) % corners]);
            o.normal = corners > 1 ? perpendicular(o.b - o.a) / length(o.b - o.a) : Vec2{};
            all.push_back(o);
        }
    }
    return all;
}

std::vector<GasSolid> solids_of(const Bodies& bodies, const State& state, const std::vector<Piece>& pieces) {
    std::vector<GasSolid> all;
    for (const Piece& piece : pieces) {
        // Of an outline without faces the line says how deep a disc is.
        if (bodies.inverse_mass[piece.row] != 0 || piece.sensor || piece.outline.count <= 2) continue;
        const Frame at = frame_at(state.x.linear[piece.row], state.x.angular[piece.row]);
        const Vec2* const corner = piece.outline.corner;
        double extent = 0;
        for (int i = 1; i < piece.outline.count; ++i) extent = std::max(extent, length(corner[i] - corner[0]));
        all.push_back({&piece, at, at.position + at.turn(corner[0]), extent});
    }
    return all;
}

Vec2 GasSolid::seen(const std::optional<Periodic>& box, Vec2 place) const { return nearest_image(box, place - corner); }

double GasSolid::beyond(int face, Vec2 seen) const {
    const Convex& outline = piece->outline;
    return dot(outline.normal[face], turned.turn_back(seen) + outline.corner[0] - outline.corner[face]);
}

double GasSolid::depth(Vec2 seen, double radius) const {
    if (squared_length(seen) >= extent * extent) return 0;
    double outside = -HUGE_VAL;
    for (int i = 0; i < piece->outline.count; ++i) outside = std::max(outside, beyond(i, seen));
    return outside < 0 ? radius + piece->outline.radius - outside : 0;
}

double GasSolid::rounding(Vec2 place) const {
    constexpr double of_places = 16 * std::numeric_limits<double>::epsilon();
    return 1e-12 * extent + of_places * (length(place) + length(corner));
}

}  // namespace carom
