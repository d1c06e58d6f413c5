// Mass, centre and moment of inertia of shapes.

#include <fmt/format.h>

#include <algorithm>
#include <carom/error.hpp>

#include "collision/outline.hpp"
#include "math/elementary.hpp"

namespace carom {

namespace {

constexpr double pi = 0x1.921fb54442d18p1;

/// ∫dA, ∫r dA and ∫|r|² dA.
struct Moments {
    double area = 0;
    Vec2 first{};
    double second = 0;

    /// Adds moments that were taken about a point.
    void add(const Moments& m, Vec2 about) {
        area += m.area;
        first += m.first + m.area * about;
        second += m.second + 2 * dot(about, m.first) + m.area * squared_length(about);
    }
};

/// The triangle from the origin to a and b (Steger, On the calculation of moments of polygons, 1996).
Moments triangle(Vec2 a, Vec2 b) {
    const double doubled = cross(a, b);
    return {doubled / 2, doubled / 6 * (a + b), doubled / 12 * (dot(a, a) + dot(a, b) + dot(b, b))};
}

/// The rectangle on an edge from the origin, as thick as the rim.
Moments strip(Vec2 edge, Vec2 out, double rim) {
    const double along = length(edge), area = along * rim;
    return {area, area / 2 * (edge + rim * out), area / 3 * (along * along + rim * rim)};
}

/// The sector of a disc about the origin, counterclockwise from one unit vector to another.
Moments sector(Vec2 from, Vec2 to, double angle, double rim) {
    const double squared = rim * rim;
    return {angle / 2 * squared, -squared * rim / 3 * perpendicular(to - from), angle / 4 * squared * squared};
}

/// About the outline's first corner, for the sake of precision: a polygon, a strip on each edge, a sector at each
/// corner (Steiner's formula for parallel bodies; Schneider, Convex Bodies, 2014, 4.1).
Moments moments_of(const Outline& outline) {
    const auto& p = outline.corners;
    const std::size_t n = p.size();
    const double rim = outline.rounding;
    if (n == 1) return {pi * rim * rim, {}, pi / 2 * rim * rim * rim * rim};
    Moments sum;
    const auto out_of = [&](std::size_t i) {
        const Vec2 edge = p[(i + 1) % n] - p[i % n];
        return -perpendicular(edge / length(edge));
    };
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 here = p[i] - p[0], next = p[(i + 1) % n] - p[0];
        sum.add(triangle(here, next), {});
        if (rim == 0) continue;
        sum.add(strip(next - here, out_of(i), rim), here);
        const Vec2 before = out_of(i + n - 1), after = out_of(i);
        const double turned = portable::atan2(cross(before, after), dot(before, after));
        sum.add(sector(before, after, n == 2 ? pi : turned, rim), here);
    }
    return sum;
}

/// The area of a shape, its centre, and its moment of inertia about that for a density of 1.
MassProperties unit_mass(const Outline& outline) {
    const Moments m = moments_of(outline);
    if (!(m.area > 0)) return {};
    const Vec2 centre = m.first / m.area;
    return {m.area, outline.corners[0] + centre, m.second - m.area * squared_length(centre)};
}
MassProperties unit_mass(const Chain&) { return {}; }
template <class T>
MassProperties unit_mass(const T& shape) {
    return unit_mass(outline_of(shape));
}

struct Part {
    MassProperties of;  ///< for a density of 1
    double density;
};

struct Parts {
    std::vector<Part> all;
    bool have_density = false;
};

/// What weighs: sensors are no matter, unless there is nothing else.
Parts parts_with_area(const std::vector<Shape>& shapes, double mass_without_density) {
    std::vector<Part> parts;
    double area = 0;
    std::size_t given = 0;
    const bool is_ghost = std::all_of(shapes.begin(), shapes.end(), [](const Shape& shape) { return shape.sensor; });
    for (const Shape& shape : shapes) {
        if (shape.sensor && !is_ghost) continue;
        const MassProperties of = std::visit([](const auto& s) { return unit_mass(s); }, shape.geometry);
        if (of.mass == 0) continue;
        parts.push_back({of, shape.density.value_or(0)});
        area += of.mass;
        given += shape.density.has_value();
    }
    if (given > 0 && given < parts.size())
        throw Error(fmt::format("Shape.density must be given for all shapes of a body or for none, got it for {} of {}",
                                given, parts.size()));
    if (given == 0)
        for (Part& part : parts) part.density = mass_without_density / area;
    return {parts, given > 0};
}

void move(Disc& shape, Vec2 by) { shape.centre += by; }
void move(Box& shape, Vec2 by) { shape.centre += by; }
template <class T>
void move(T& shape, Vec2 by) {
    if constexpr (requires { shape.points; })
        for (Vec2& point : shape.points) point += by;
    else
        shape.a += by, shape.b += by;
}

/// How far the shapes reach from their body's origin, at least about.
double reach(const std::vector<Shape>& shapes) {
    double farthest = 0;
    for (const Shape& shape : shapes)
        for (const Convex& piece : pieces_of(shape.geometry)) {
            const Aabb box = bounds(piece, {});
            farthest = std::max({farthest, length(box.low), length(box.high)});
        }
    return farthest;
}

}  // namespace

MassProperties mass_properties(const std::vector<Shape>& shapes, double mass_without_density) {
    const auto [parts, have_density] = parts_with_area(shapes, mass_without_density);
    MassProperties whole;
    if (parts.empty()) return whole;
    const Vec2 origin = parts[0].of.centre;
    Vec2 first{};
    for (const Part& part : parts) {
        whole.mass += part.density * part.of.mass;
        first += part.density * part.of.mass * (part.of.centre - origin);
    }
    whole.centre = origin + first / whole.mass;
    for (const Part& part : parts)
        whole.moment += part.density * (part.of.moment + part.of.mass * squared_length(part.of.centre - whole.centre));
    if (!have_density) whole.mass = mass_without_density;  // to the last bit
    return whole;
}

Vec2 centre_of_shapes(const Body& body) {
    // What never moves by itself has no use for a centre of mass, and a driven body turns about the place it is given.
    if (body.shapes.empty() || body.kind != Kind::dynamic) return {};
    const Vec2 centre = mass_properties(body.shapes, body.mass).centre;
    return length(centre) > 1e-12 * reach(body.shapes) ? centre : Vec2{};
}

Body with_mass_of_shapes(const Body& body) {
    if (body.shapes.empty()) return body;
    if (body.radius != 0)
        throw Error(fmt::format("Body.radius must be 0 for a body with shapes, got {} m", body.radius));
    if (mass_properties(body.shapes, body.mass).mass == 0 || body.kind != Kind::dynamic) return body;
    Body out = body;
    if (const Vec2 centre = centre_of_shapes(body); centre != Vec2{}) {
        for (Shape& shape : out.shapes) std::visit([&](auto& geometry) { move(geometry, -centre); }, shape.geometry);
        out.position += frame_at({}, body.angle).turn(centre);
    }
    // Of the shapes where they are now: a body that is read back from a world gets the same bits again.
    const MassProperties now = mass_properties(out.shapes, body.mass);
    out.mass = now.mass;
    if (!out.moment_of_inertia) out.moment_of_inertia = now.moment;
    return out;
}

}  // namespace carom
