#include "output/paint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "output/axis.hpp"
#include "output/ink.hpp"
#include "output/rim.hpp"
#include "state/bodies.hpp"

namespace carom {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr std::size_t few_springs = 200;

Colour darker(Colour c) {
    const auto part = [](std::uint8_t x) { return static_cast<std::uint8_t>(x * 11 / 20); };
    return {part(c.r), part(c.g), part(c.b), c.a};
}

/// How a sleeping body's colour looks.
Colour greyed(Colour c) {
    const auto faded = [](std::uint8_t part) { return static_cast<std::uint8_t>((2 * 200 + part) / 3); };
    return {faded(c.r), faded(c.g), faded(c.b), c.a};
}

/// The colour that a body was given; a dynamic one has one in any case.
std::optional<Colour> own_colour(const Body& body, BodyId id) {
    const Colour usual = default_colour(id.index), own = body.colour.value_or(usual);
    return own != usual || body.kind == Kind::dynamic ? std::optional(own) : std::nullopt;
}

}  // namespace

std::vector<Vec2> places(const World& world, Vec2 position) {
    const Vec2 home = world.wrapped(position);
    std::vector<Vec2> all{home};
    if (const auto box = world.periodic()) {
        const Vec2 size = box->high - box->low;
        for (int across : {-1, 0, 1})
            for (int up : {-1, 0, 1})
                if (across != 0 || up != 0) all.push_back(home + Vec2{across * size.x, up * size.y});
    }
    return all;
}

double round_length(double wanted) {
    const double power = std::pow(10, std::floor(std::log10(wanted)));
    const double digit = wanted / power;
    return (digit < 2 ? 1 : digit < 5 ? 2 : 5) * power;
}

std::string with_prefix(double value, const char* unit) {
    struct Prefix {
        double least, unit;
        const char* name;
    };
    static constexpr Prefix prefixes[] = {
        {1e6, 1e6, "M"}, {1e3, 1e3, "k"}, {0.1, 1, ""}, {1e-3, 1e-3, "m"}, {1e-6, 1e-6, "µ"}};
    for (const auto& [least, size, name] : prefixes)
        if (value >= 0.999 * least && value < 1e9) return fmt::format("{:.6g} {}{}", value / size, name, unit);
    return fmt::format("{} {}", words_in_thousands(value), unit);
}

Colour fill_of(const Body& body, BodyId id) {
    constexpr Colour fixed{205, 205, 205, 255}, driven{140, 140, 140, 255};
    return own_colour(body, id).value_or(body.kind == Kind::fixed ? fixed : driven);
}
bool shows_angle(const Body& body) {
    // Rounding alone may leave a frictionless disc with 1e-17 rad/s.
    const bool turns = body.friction > 0 || std::abs(body.angle) > 1e-9 || std::abs(body.angular_velocity) > 1e-9;
    return turns && body.kind != Kind::fixed;
}
Colour line_of(const Body& body, BodyId id) { return own_colour(body, id).value_or(wall_colour); }

void Painter::paint(const World& world, const std::map<BodyId, Trail>* trails) {
    background();
    cairo_save(cairo_);
    cairo_rectangle(cairo_, 0, 0, view_.width, scene_height());
    cairo_clip(cairo_);
    const View whole = view_;
    for (const Vec2 shift : repeats(world)) {
        view_.low = whole.low - shift;
        view_.high = whole.high - shift;
        cairo_save(cairo_);
        scene(world, trails);
        cairo_restore(cairo_);
    }
    view_ = whole;
    cairo_restore(cairo_);
    if (view_.caption) caption(world);
}

void Painter::scene(const World& world, const std::map<BodyId, Trail>* trails) {
    if (const auto box = world.periodic(); box && view_.follow) clip_to(*box);
    if (view_.follow) grid();
    walls(world);
    tracks(world);
    if (trails) {
        for (const auto& [id, places] : *trails) trail(world, places);
    }
    springs(world);
    // A hinge is seen on what it holds, and what is as small as the hinge on that.
    bodies(world, false);
    joints(world);
    bodies(world, true);
    if (view_.contact_forces) contact_forces(world);
    if (view_.follow) grid_numbers();
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

/// A way from one place to another; through the edge of a periodic box it goes out and comes in again.
void Painter::way(const World& world, Vec2 from, Vec2 to) {
    const Vec2 start = world.wrapped(from), end = start + (to - from), inside = world.wrapped(to);
    move_to(view_.pixel(start));
    line_to(view_.pixel(end));
    if (end == inside || !world.periodic()) return;
    move_to(view_.pixel(inside - (to - from)));
    line_to(view_.pixel(inside));
}

void Painter::tracks(const World& world) {
    for (std::size_t i = 0; i < view_.tracks.size(); ++i) {
        const std::vector<Vec2>& points = view_.tracks[i].points;
        for (std::size_t k = 1; k < points.size(); ++k) way(world, points[k - 1], points[k]);
        colour(on_white(view_.tracks[i].colour.value_or(palette(i))), 0.7);
        stroke(1.5);
    }
}

// The older, the fainter.
void Painter::trail(const World& world, const Trail& trail) {
    const double now = world.time();
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_BUTT);  // round ones would show where two faint lines overlap
    for (std::size_t i = 1; i < trail.places.size(); ++i) {
        const auto& [time, place] = trail.places[i];
        way(world, trail.places[i - 1].second, place);
        colour(on_white(trail.colour), std::clamp(1 - (now - time) / view_.trail, 0.05, 1.0));
        stroke(2);
    }
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_ROUND);
}

namespace {

/// Whether a spring stands for a rod: the weight of what it joins stretches it by less than could ever be seen.
bool is_rod(const World& world, const Spring& spring) {
    constexpr double unseen = 1e-6;
    double mass = 0;
    for (const BodyId id : {spring.a, spring.b}) {
        const Body body = world.body(id);
        if (body.kind == Kind::dynamic) mass = std::max(mass, body.mass);
    }
    const double weight = mass * length(world.settings().gravity);
    return weight > 0 && weight < unseen * spring.stiffness * spring.rest_length;
}

}  // namespace

void Painter::springs(const World& world) {
    const bool few = world.springs().size() <= few_springs;
    for (const Spring& spring : world.springs()) {
        const Vec2 from = end_of(world, spring.a, spring.anchor_a), to = end_of(world, spring.b, spring.anchor_b);
        colour({95, 95, 95, 255});
        // Both ends move by the same number of boxes, or the spring would be torn. What goes out comes in again.
        const Vec2 start = world.wrapped(from), again = world.wrapped(to) - (to - from);
        const auto show = [&](Vec2 first) {
            const Vec2 a = view_.pixel(first), b = view_.pixel(first + (to - from));
            if (few && !is_rod(world, spring)) return coil(a, b, spring.rest_length);
            move_to(a);
            line_to(b);
            stroke(few ? 3 : 1);
        };
        show(start);
        if (length(again - start) * scale_ > 1) show(again);
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

void Painter::bodies(const World& world, bool small) {
    const auto radii = world.radii();
    const auto shapes = world.shapes();
    for (std::size_t i = 0; i < world.size(); ++i) {
        if ((shapes[i].empty() && radii[i] * scale_ < 4) != small) continue;
        const BodyId id = world.ids()[i];
        const Body body = world.body(id);
        const bool marked = view_.angle_marks && shows_angle(body);
        const bool asleep = world.asleep(id);
        const auto shown = [asleep](Colour c) { return asleep ? greyed(c) : c; };
        Appearance seen{{}, body.angle, shown(fill_of(body, id)), shown(line_of(body, id)), body.kind, marked};
        const bool is_small = body.radius > 0 && is_dot(body.radius * scale_, world.size());
        const double radius = is_small ? dot_radius / scale_ : body.radius;
        for (const Vec2 place : places(world, body.position)) {
            seen.position = place;
            if (body.shapes.empty()) disc(seen, radius);
            for (const Shape& part : body.shapes) shape(seen, part);
        }
    }
}

void Painter::disc(const Appearance& body, double size) {
    const Vec2 at = view_.pixel(body.position);
    const double radius = size * scale_, reach = radius + 8;
    if (at.x < -reach || at.y < -reach || at.x > view_.width + reach || at.y > scene_height() + reach) return;
    if (size == 0) return point(body);
    colour(body.fill);
    if (radius < 1) {  // smaller than a pixel: its area counts, not its shape
        const double side = radius * std::sqrt(std::numbers::pi);
        cairo_rectangle(cairo_, at.x - side / 2, at.y - side / 2, side, side);
        return cairo_fill(cairo_);
    }
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, at.x, at.y, radius, 0, turn);
    inside(body, false, at - Vec2{radius, radius}, at + Vec2{radius, radius});
    if (body.marked && radius >= 4) radius_line(body, body.position, size);
}

void Painter::radius_line(const Appearance& body, Vec2 centre, double radius) {
    colour(mark_on(body.fill));
    move_to(view_.pixel(centre));
    line_to(view_.pixel(centre + (radius - 1.5 / scale_) * Vec2{std::cos(body.angle), std::sin(body.angle)}));
    stroke(std::clamp(radius * scale_ / 10, 1.0, 2.5));
}

void Painter::shape(const Appearance& body, const Shape& shape) {
    const Rim rim = rim_of(shape.geometry);
    std::vector<Vec2> pixels = placed(rim.points, body.position, body.angle);
    Vec2 low{INFINITY, INFINITY}, high = -low;
    for (Vec2& point : pixels) {
        point = view_.pixel(point);
        low = {std::min(low.x, point.x), std::min(low.y, point.y)};
        high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
    const double reach = 8;
    if (high.x < -reach || high.y < -reach || low.x > view_.width + reach || low.y > scene_height() + reach) return;
    if (!rim.closed) return line(body, pixels, shape.sensor, std::holds_alternative<Chain>(shape.geometry));
    for (const Vec2 point : pixels) line_to(point);
    cairo_close_path(cairo_);
    inside(body, shape.sensor, low, high);
    const auto* disc = std::get_if<carom::Disc>(&shape.geometry);
    if (disc && body.marked && !shape.sensor && disc->radius * scale_ >= 4)
        radius_line(body, placed({disc->centre}, body.position, body.angle)[0], disc->radius);
}

/// Fills the path, and draws its rim inside of it, so that the picture is as large as the body.
void Painter::inside(const Appearance& body, bool sensor, Vec2 low, Vec2 high) {
    colour(body.fill, sensor ? 0.15 : 1);
    cairo_fill_preserve(cairo_);
    const double size = std::max(high.x - low.x, high.y - low.y);
    if (size < 6) return cairo_new_path(cairo_);
    cairo_path_t* rim = cairo_copy_path(cairo_);
    cairo_save(cairo_);
    cairo_clip(cairo_);
    if (body.kind == Kind::fixed && !sensor) hatch(low, high);
    cairo_append_path(cairo_, rim);
    cairo_path_destroy(rim);
    colour(sensor || body.kind == Kind::dynamic ? darker(body.fill) : ink_colour);
    if (sensor || body.kind == Kind::driven) dash();
    stroke(2 * (body.kind == Kind::dynamic ? std::min(1.5, size / 8) : 2));
    cairo_restore(cairo_);
}

/// Of a chain, solid from one side alone, short strokes show the ground.
void Painter::line(const Appearance& body, const std::vector<Vec2>& pixels, bool sensor, bool one_sided) {
    colour(body.line);
    cairo_save(cairo_);
    if (sensor) dash();
    for (const Vec2 point : pixels) line_to(point);
    stroke(body.kind == Kind::dynamic ? 2 : 3);
    cairo_restore(cairo_);
    if (!one_sided || sensor) return;
    const double spacing = 12;
    double next = spacing / 2;
    for (std::size_t i = 1; i < pixels.size(); ++i) {
        const Vec2 from = pixels[i - 1], along = pixels[i] - from;
        const double piece = length(along);
        const Vec2 unit = along / piece, right = perpendicular(unit);
        for (; next < piece; next += spacing) {
            move_to(from + next * unit);
            line_to(from + next * unit + 0.6 * spacing * (right - unit));
        }
        next -= piece;
    }
    stroke(1);
}

void Painter::dash() {
    const std::array<double, 2> dashes{6, 4};
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_BUTT);  // round ones would close the gaps
    cairo_set_dash(cairo_, dashes.data(), 2, 0);
}

void Painter::point(const Appearance& body) {
    const Vec2 at = view_.pixel(body.position);
    if (body.kind == Kind::dynamic) {
        cairo_new_sub_path(cairo_);
        cairo_arc(cairo_, at.x, at.y, 5, 0, turn);
    } else if (body.kind == Kind::fixed) {
        cairo_rectangle(cairo_, at.x - 5, at.y - 5, 10, 10);
    } else {
        move_to(at + Vec2{0, -7});
        for (Vec2 corner : {Vec2{7, 0}, Vec2{0, 7}, Vec2{-7, 0}}) line_to(at + corner);
        cairo_close_path(cairo_);
    }
    colour(body.fill);
    if (body.kind == Kind::dynamic) return cairo_fill(cairo_);
    cairo_fill_preserve(cairo_);
    colour(ink_colour);
    stroke(1.5);
}

/// Fills a rectangle of the picture with lines that go on from one body to the next.
void Painter::hatch(Vec2 low, Vec2 high) {
    const double spacing = 8;
    low = {std::max(low.x, 0.0), std::max(low.y, 0.0)};
    high = {std::min(high.x, double(view_.width)), std::min(high.y, scene_height())};
    const double start = origin().x + origin().y;
    for (double d = start + spacing * std::floor((low.x + low.y - start) / spacing); d < high.x + high.y;
         d += spacing) {
        move_to({d - low.y, low.y});
        line_to({d - high.y, high.y});
    }
    colour(wall_colour);
    stroke(1);
}

void Painter::caption(const World& world) {
    const double top = scene_height(), middle = top + caption_height / 2.0;
    colour(paper);
    cairo_rectangle(cairo_, 0, top, view_.width, caption_height);
    cairo_fill(cairo_);
    colour(ink_colour);
    cairo_select_font_face(cairo_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, 16);
    const double time = world.time();
    const auto words = std::abs(time) >= 1e5                ? time_words(time)
                       : time != 0 && std::abs(time) < 0.01 ? fmt::format("t = {:.3g} s", time)
                                                            : fmt::format("t = {:.3f} s", time);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, words.c_str(), &extents);
    cairo_move_to(cairo_, view_.width - 14 - extents.x_advance, middle + 6);
    cairo_show_text(cairo_, words.c_str());
    double right = scale_bar(middle);
    if (pixels_per_newton_ > 0) force_bar(right + 30, middle);
}

// A round length of about a sixth of the picture's width.
double Painter::scale_bar(double middle) {
    const double metres = round_length(view_.width / (6 * scale_));
    const double left = 14, right = left + metres * scale_;
    for (double end : {left, right}) {
        cairo_move_to(cairo_, end, middle - 5);
        cairo_line_to(cairo_, end, middle + 5);
    }
    cairo_move_to(cairo_, left, middle);
    cairo_line_to(cairo_, right, middle);
    stroke(2);
    const std::string words = with_prefix(metres, "m");
    cairo_move_to(cairo_, right + 10, middle + 6);
    cairo_show_text(cairo_, words.c_str());
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, words.c_str(), &extents);
    return right + 10 + extents.x_advance;
}

}  // namespace carom
