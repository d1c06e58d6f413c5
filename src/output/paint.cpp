#include "output/paint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "state/bodies.hpp"

namespace carom {
namespace {

constexpr Colour ink{34, 34, 34, 255}, wall{70, 70, 70, 255}, ground{228, 228, 228, 255}, paper{255, 255, 255, 255};
constexpr double turn = 2 * std::numbers::pi;
constexpr std::size_t few_springs = 200;

Colour darker(Colour c) {
    const auto part = [](std::uint8_t x) { return static_cast<std::uint8_t>(x * 11 / 20); };
    return {part(c.r), part(c.g), part(c.b), c.a};
}

bool is_bright(Colour c) { return 299 * c.r + 587 * c.g + 114 * c.b > 140 * 1000; }

}  // namespace

Colour fill_of(const Body& body, BodyId id) {
    const Colour usual = default_colour(id.index), own = body.colour.value_or(usual);
    if (own != usual || body.kind == Kind::dynamic) return own;
    return body.kind == Kind::fixed ? Colour{205, 205, 205, 255} : Colour{140, 140, 140, 255};
}

std::vector<DiscMark> disc_marks(const World& world) {
    std::vector<DiscMark> marks;
    marks.reserve(world.size());
    const auto ids = world.ids();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        marks.push_back({world.wrapped(world.positions()[i]), world.radii()[i], fill_of(world.body(ids[i]), ids[i])});
    }
    return marks;
}

void Painter::paint(const World& world, const std::unordered_map<std::uint64_t, Trail>* trails) {
    background();
    cairo_save(cairo_);
    cairo_rectangle(cairo_, 0, 0, view_.width, scene_height());
    cairo_clip(cairo_);
    for (const Rectangle& walls : world.rectangles()) room(walls);
    for (const HalfPlane& plane : world.half_planes()) half_plane(plane);
    if (const auto box = world.periodic()) periodic(*box);
    tracks();
    if (trails) {
        for (const auto& [id, places] : *trails) trail(world, places);
    }
    springs(world);
    bodies(world);
    cairo_restore(cairo_);
    if (view_.caption) caption(world);
}

void Painter::colour(Colour c, double opacity) {
    cairo_set_source_rgba(cairo_, c.r / 255.0, c.g / 255.0, c.b / 255.0, c.a / 255.0 * opacity);
}

void Painter::stroke(double width) {
    cairo_set_line_width(cairo_, width);
    cairo_stroke(cairo_);
}

void Painter::background() {
    colour(paper);
    cairo_paint(cairo_);
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_ROUND);
}

void Painter::room(const Rectangle& walls) {
    const Vec2 a = view_.pixel({walls.low.x, walls.high.y}), b = view_.pixel({walls.high.x, walls.low.y});
    const double line = 3;
    cairo_rectangle(cairo_, 0, 0, view_.width, scene_height());
    cairo_rectangle(cairo_, a.x, a.y, b.x - a.x, b.y - a.y);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
    colour(ground);
    cairo_fill(cairo_);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_WINDING);
    // Outside of the room, where no disc can be.
    cairo_rectangle(cairo_, a.x - line / 2, a.y - line / 2, b.x - a.x + line, b.y - a.y + line);
    colour(wall);
    stroke(line);
}

void Painter::half_plane(const HalfPlane& plane) {
    const Vec2 normal = plane.normal / length(plane.normal);
    const Vec2 middle = 0.5 * (view_.low + view_.high);
    const Vec2 foot = view_.pixel(middle - dot(middle - plane.point, normal) * normal);
    const double reach = view_.width + view_.height, spacing = 12;
    cairo_save(cairo_);
    // x runs along the wall and y into it.
    cairo_translate(cairo_, foot.x, foot.y);
    cairo_rotate(cairo_, std::atan2(normal.x, normal.y));
    cairo_rectangle(cairo_, -reach, 0, 2 * reach, 2 * reach);
    colour(ground);
    cairo_fill(cairo_);
    for (double x = -reach; x < reach; x += spacing) {
        cairo_move_to(cairo_, x, 0);
        cairo_line_to(cairo_, x - spacing, spacing);
    }
    colour(wall);
    stroke(1);
    cairo_rectangle(cairo_, -reach, 0, 2 * reach, 3);
    cairo_fill(cairo_);
    cairo_restore(cairo_);
}

void Painter::periodic(const Periodic& box) {
    const Vec2 a = view_.pixel({box.low.x, box.high.y}), b = view_.pixel({box.high.x, box.low.y});
    cairo_rectangle(cairo_, a.x, a.y, b.x - a.x, b.y - a.y);
    const std::array<double, 2> dashes{8, 6};
    cairo_set_dash(cairo_, dashes.data(), 2, 0);
    colour(wall);
    stroke(1.5);
    cairo_set_dash(cairo_, nullptr, 0, 0);
    cairo_rectangle(cairo_, a.x, a.y, b.x - a.x, b.y - a.y);
    cairo_clip(cairo_);
}

void Painter::tracks() {
    for (std::size_t i = 0; i < view_.tracks.size(); ++i) {
        for (Vec2 place : view_.tracks[i].points) line_to(view_.pixel(place));
        colour(view_.tracks[i].colour.value_or(palette(i)), 0.7);
        stroke(1.5);
    }
}

// The older, the fainter.
void Painter::trail(const World& world, const Trail& trail) {
    const double now = world.time();
    const auto box = world.periodic();
    const double far = box ? 0.5 * std::min(box->high.x - box->low.x, box->high.y - box->low.y) : INFINITY;
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_BUTT);  // round ones would show where two faint lines overlap
    for (std::size_t i = 1; i < trail.places.size(); ++i) {
        const auto& [time, place] = trail.places[i];
        const Vec2 from = world.wrapped(trail.places[i - 1].second), to = world.wrapped(place);
        if (length(to - from) > far) continue;  // it has crossed the box's edge
        move_to(view_.pixel(from));
        line_to(view_.pixel(to));
        colour(trail.colour, std::clamp(1 - (now - time) / view_.trail, 0.05, 1.0));
        stroke(2);
    }
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_ROUND);
}

void Painter::springs(const World& world) {
    const bool few = world.springs().size() <= few_springs;
    for (const Spring& spring : world.springs()) {
        const Vec2 from = end_of(world, spring.a, spring.anchor_a), to = end_of(world, spring.b, spring.anchor_b);
        // Both ends move by the same number of boxes, or the spring would be torn.
        const Vec2 start = world.wrapped(from);
        const Vec2 a = view_.pixel(start), b = view_.pixel(start + (to - from));
        colour({95, 95, 95, 255});
        if (few) {
            coil(a, b, spring.rest_length);
        } else {
            move_to(a);
            line_to(b);
            stroke(1);
        }
    }
}

// As many windings as fit the relaxed spring, so that a stretched one is seen to be stretched.
void Painter::coil(Vec2 from, Vec2 to, double rest_length) {
    const double stretch = length(to - from);
    if (stretch < 1) return;
    const Vec2 along = (to - from) / stretch, across = perpendicular(along);
    const int windings = std::clamp(static_cast<int>(rest_length * scale_ / 12), 5, 24);
    const double lead = std::min(14.0, 0.15 * stretch), pitch = (stretch - 2 * lead) / windings;
    const double half_width = std::clamp(0.12 * rest_length * scale_, 4.0, 11.0);
    move_to(from);
    line_to(from + lead * along);
    for (int i = 0; i < 2 * windings; ++i) {
        const double side = i % 2 == 0 ? half_width : -half_width;
        line_to(from + (lead + (i + 0.5) * pitch / 2) * along + side * across);
    }
    line_to(to - lead * along);
    line_to(to);
    stroke(1.5);
}

void Painter::bodies(const World& world) {
    const auto box = world.periodic();
    const auto ids = world.ids();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const Body body = world.body(ids[i]);
        // Rounding alone may leave a frictionless disc with 1e-17 rad/s.
        const bool turns = body.friction > 0 || std::abs(body.angle) > 1e-9 || std::abs(body.angular_velocity) > 1e-9;
        Disc disc{world.wrapped(body.position),
                  body.radius,
                  fill_of(body, ids[i]),
                  body.kind,
                  view_.angle_marks && turns && body.kind != Kind::fixed,
                  body.angle};
        this->body(disc);
        if (!box) continue;
        // What leaves the box on one side comes in on the other.
        const Vec2 size = box->high - box->low, home = disc.centre;
        for (int across : {-1, 0, 1}) {
            for (int up : {-1, 0, 1}) {
                if (across == 0 && up == 0) continue;
                disc.centre = home + Vec2{across * size.x, up * size.y};
                this->body(disc);
            }
        }
    }
}

void Painter::body(const Disc& disc) {
    const Vec2 at = view_.pixel(disc.centre);
    const double radius = disc.radius * scale_, reach = radius + 8;
    if (at.x < -reach || at.y < -reach || at.x > view_.width + reach || at.y > scene_height() + reach) return;
    if (disc.radius == 0) return point(disc);
    colour(disc.fill);
    if (radius < 1) {  // smaller than a pixel: its area counts, not its shape
        const double side = radius * std::sqrt(std::numbers::pi);
        cairo_rectangle(cairo_, at.x - side / 2, at.y - side / 2, side, side);
        return cairo_fill(cairo_);
    }
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, at.x, at.y, radius, 0, turn);
    cairo_fill(cairo_);
    if (radius < 3) return;
    if (disc.kind == Kind::fixed) hatch(at, radius);
    // The outline's outer edge is the disc's.
    const double line = disc.kind == Kind::dynamic ? std::min(1.5, radius / 4) : 2;
    colour(disc.kind == Kind::dynamic ? darker(disc.fill) : ink);
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, at.x, at.y, radius - line / 2, 0, turn);
    if (disc.kind == Kind::driven) {
        const std::array<double, 2> dashes{6, 4};
        cairo_set_dash(cairo_, dashes.data(), 2, 0);
    }
    stroke(line);
    cairo_set_dash(cairo_, nullptr, 0, 0);
    if (!disc.marked || radius < 4) return;
    colour(is_bright(disc.fill) ? ink : paper);
    move_to(at);
    line_to(at + (radius - line) * Vec2{std::cos(disc.angle), -std::sin(disc.angle)});
    stroke(std::clamp(radius / 10, 1.0, 2.5));
}

void Painter::point(const Disc& disc) {
    const Vec2 at = view_.pixel(disc.centre);
    if (disc.kind == Kind::dynamic) {
        cairo_new_sub_path(cairo_);
        cairo_arc(cairo_, at.x, at.y, 3.5, 0, turn);
    } else if (disc.kind == Kind::fixed) {
        cairo_rectangle(cairo_, at.x - 5, at.y - 5, 10, 10);
    } else {
        move_to(at + Vec2{0, -7});
        for (Vec2 corner : {Vec2{7, 0}, Vec2{0, 7}, Vec2{-7, 0}}) line_to(at + corner);
        cairo_close_path(cairo_);
    }
    colour(disc.fill);
    if (disc.kind == Kind::dynamic) return cairo_fill(cairo_);
    cairo_fill_preserve(cairo_);
    colour(ink);
    stroke(1.5);
}

void Painter::hatch(Vec2 centre, double radius) {
    cairo_save(cairo_);
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, centre.x, centre.y, radius, 0, turn);
    cairo_clip(cairo_);
    for (double d = -2 * radius; d < 2 * radius; d += 8) {
        move_to(centre + Vec2{d - radius, radius});
        line_to(centre + Vec2{d + radius, -radius});
    }
    colour(wall);
    stroke(1);
    cairo_restore(cairo_);
}

void Painter::caption(const World& world) {
    const double top = scene_height(), middle = top + caption_height / 2.0;
    colour(paper);
    cairo_rectangle(cairo_, 0, top, view_.width, caption_height);
    cairo_fill(cairo_);
    colour(ink);
    cairo_select_font_face(cairo_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, 16);
    const double time = world.time();
    const auto words =
        time != 0 && std::abs(time) < 0.01 ? fmt::format("t = {:.3g} s", time) : fmt::format("t = {:.3f} s", time);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, words.c_str(), &extents);
    cairo_move_to(cairo_, view_.width - 14 - extents.x_advance, middle + 6);
    cairo_show_text(cairo_, words.c_str());
    scale_bar(middle);
}

// A round length of about a sixth of the picture's width.
void Painter::scale_bar(double middle) {
    const double wanted = view_.width / (6 * scale_);
    const double power = std::pow(10, std::floor(std::log10(wanted)));
    const double digit = wanted / power, metres = (digit < 2 ? 1 : digit < 5 ? 2 : 5) * power;
    const double left = 14, right = left + metres * scale_;
    for (double end : {left, right}) {
        cairo_move_to(cairo_, end, middle - 5);
        cairo_line_to(cairo_, end, middle + 5);
    }
    cairo_move_to(cairo_, left, middle);
    cairo_line_to(cairo_, right, middle);
    stroke(2);
    struct Prefix {
        double least, unit;
        const char* name;
    };
    static constexpr Prefix prefixes[] = {{1e3, 1e3, "km"}, {0.1, 1, "m"}, {1e-3, 1e-3, "mm"}, {1e-6, 1e-6, "µm"}};
    std::string words = fmt::format("{:.1g} m", metres);
    for (const auto& [least, unit, name] : prefixes) {
        if (metres < 0.999 * least) continue;
        words = fmt::format("{:.6g} {}", metres / unit, name);
        break;
    }
    cairo_move_to(cairo_, right + 10, middle + 6);
    cairo_show_text(cairo_, words.c_str());
}

}  // namespace carom
