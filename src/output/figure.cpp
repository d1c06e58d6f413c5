// A Figure as a gnuplot program: the data as data blocks, then one plot a panel, everything placed by the layout.

#include <fmt/format.h>

#include <algorithm>
#include <carom/output.hpp>
#include <cmath>
#include <iterator>
#include <utility>

#include "output/heat.hpp"
#include "output/ink.hpp"
#include "output/layout.hpp"
#include "output/process.hpp"
#include "output/strokes.hpp"

namespace carom {
namespace {

constexpr const char* text_ink = "#222222";
constexpr const char* wall_ink = "#555555";

/// How to write to the file that is asked for.
struct Terminal {
    std::string settings, font, title_font;
    double line_spacing = 1;  ///< in the legend, with which lines are as far apart in all of them
};

class Script {
  public:
    Script(const Figure& figure, const Layout& layout) : figure_(figure), layout_(layout) {}
    std::string write(const Terminal& terminal);

  private:
    template <class... Arguments>
    void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
        text_ += '\n';
    }
    void data(std::size_t p);
    void shapes(std::size_t p);
    void discs(std::size_t p);
    bool curve(const Curve& curve, const PanelPlace& place);
    void setting(std::size_t p);
    void words(std::size_t p);
    void axis(char name, const Axis& axis, bool labelled);
    void legend(const PanelPlace& place);
    void heat_map(std::size_t p);
    void colour_bar(std::size_t p);
    void plot(std::size_t p);
    void plot_curves(std::size_t p, std::vector<std::string>& parts);
    void plot_shapes(std::size_t p, std::vector<std::string>& parts);
    void label(std::string_view text, double x, double y, std::string_view how);

    const Figure& figure_;
    const Layout& layout_;
    std::string text_, title_font_;
    double line_spacing_ = 1;
    std::vector<bool> drawn_;  ///< for each curve of each panel in turn
    std::size_t next_ = 0;     ///< among them, while plotting
};

/// Text that gnuplot prints as it is. In double quotes a quote, a backslash and a backquote, which would run a program,
/// have a meaning; as numbers they have none. (In single quotes a quote is two, but not at the beginning.)
std::string literal(std::string_view text) {
    std::string result = "\"";
    for (const char c : without_emoji(text)) {
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
        if (c == '"' || c == '\\' || c == '`')
            result += fmt::format("\\{:03o}", static_cast<unsigned>(c));
        else
            result += control ? ' ' : c;
    }
    return result += '"';
}

std::string hex(Colour colour) { return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b); }

/// What gnuplot calls "rgb variable".
unsigned number(Colour c) { return unsigned(255 - c.a) << 24 | unsigned(c.r) << 16 | unsigned(c.g) << 8 | c.b; }

/// The axis's power of ten, in front of the unit if there is one.
std::string with_unit(const std::string& label, const Axis& axis) {
    if (axis.exponent == 0) return label;
    const std::string power = power_of_ten(axis.exponent);
    const auto bracket = label.rfind('[');
    if (bracket == label.npos || label.back() != ']') return fmt::format("{} [{}]", label, power);
    return fmt::format("{}[{} {}", label.substr(0, bracket), power, label.substr(bracket + 1));
}

/// " − 1000000": what is taken off, so that its reader adds it.
std::string offset_words(const Axis& axis) {
    if (axis.offset == 0) return "";
    return fmt::format(" {} {}", axis.offset < 0 ? "+" : "−", exact_words(std::abs(axis.offset)));
}

/// What an axis of so many pixels has room for of its label.
std::string axis_label(const std::string& name, const Axis& axis, double length) {
    constexpr double generous = 1.22;  // is the width that is thought of a text
    const std::string offset = offset_words(axis);
    std::string label = shortened(with_unit(name, axis), generous * length - text_width(offset));
    return label.insert(unit_of(label), offset);
}

/// False if it has no point that can be drawn, which gnuplot would call an error.
bool Script::curve(const Curve& curve, const PanelPlace& place) {
    const auto pieces = strokes(curve, place);
    for (const auto& piece : pieces) {
        for (Vec2 point : piece) say("{} {}", point.x, point.y);
        say("");
    }
    return !pieces.empty();
}

/// Of a curve that has errors: its points with the ends of their bars, which stay within the axes.
std::vector<std::string> error_bars(const Curve& curve, const PanelPlace& place) {
    std::vector<std::string> bars;
    for (std::size_t i = 0; i < curve.error.size(); ++i) {
        const double x = curve.x[i], y = curve.y[i], bar = bar_at(curve, i);
        if (!(bar > 0) || !std::isfinite(x) || !std::isfinite(y)) continue;
        const double low = std::max(y - bar, place.y.low), high = std::min(y + bar, place.y.high);
        bars.push_back(fmt::format("{} {} {}", place.numbers({x, y}), place.y.number(low), place.y.number(high)));
    }
    return bars;
}

/// From frame to frame along a line, a thousandth of a pixel less: gnuplot leaves a line away whose ends rounding has
/// put outside.
void add_endless(const Line& line, const PanelPlace& place, std::vector<Line>& to) {
    const Vec2 way = line.to - line.from;
    double first = -INFINITY, last = INFINITY;
    const auto cut = [&](double start, double along, const Axis& axis) {
        if (along == 0 && start >= axis.low && start <= axis.high) return;
        const double a = (axis.low - start) / along, b = (axis.high - start) / along;
        first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
    };
    cut(line.from.x, way.x, place.x), cut(line.from.y, way.y, place.y);
    if (!(first < last) || !std::isfinite(last - first)) return;
    const double less = 1e-6 * (last - first);
    to.push_back({line.from + (first + less) * way, line.from + (last - less) * way});
}

std::vector<Line> segments(const Panel& panel, const PanelPlace& place) {
    std::vector<Line> all = panel.lines;
    for (const Line& line : panel.endless) add_endless(line, place, all);
    return all;
}

/// Shapes of one look and colour, the first that come below. (Of a variable colour gnuplot draws no dashes.)
using Group = std::pair<std::pair<Look, unsigned>, std::vector<const ShapeMark*>>;

std::vector<Group> groups_of(const Panel& panel) {
    std::vector<Group> groups;
    for (const ShapeMark& shape : panel.shapes) {
        const std::pair key{shape.look, number(shape.colour)};
        auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.first == key; });
        if (group == groups.end()) group = groups.insert(group, {key, {}});
        group->second.push_back(&shape);
    }
    return groups;
}

/// What the data of a group are called.
std::string name_of(std::size_t p, const Group& group) {
    return fmt::format("$p{}look{}colour{:x}", p, static_cast<int>(group.first.first), group.first.second);
}

double radius_in_pixels(const DiscMark& disc, const PanelPlace& place) {
    return disc.radius * place.width / (place.x.high - place.x.low);
}

/// Those that are dots, or the others.
std::vector<DiscMark> discs_of(const Panel& panel, const PanelPlace& place, bool dots) {
    std::vector<DiscMark> some;
    for (const DiscMark& disc : panel.discs)
        if (is_dot(radius_in_pixels(disc, place), panel.discs.size()) == dots) some.push_back(disc);
    return some;
}

/// As in frames: a disc of a few pixels has no room for a radius.
bool is_marked(const DiscMark& disc, const PanelPlace& place) {
    return disc.angle && radius_in_pixels(disc, place) >= 4;
}
bool has_marks(const Panel& panel, const PanelPlace& place) {
    return std::any_of(panel.discs.begin(), panel.discs.end(), [&](const DiscMark& d) { return is_marked(d, place); });
}

void Script::shapes(std::size_t p) {
    for (const auto& group : groups_of(figure_.panels[p])) {
        say("{} << EOD", name_of(p, group));
        for (const ShapeMark* shape : group.second) {
            for (const Vec2 point : shape->points) say("{}", layout_.places[p].numbers(point));
            say("");
        }
        say("EOD");
    }
}

void Script::data(std::size_t p) {
    const Panel& panel = figure_.panels[p];
    const PanelPlace& place = layout_.places[p];
    for (std::size_t c = 0; c < panel.curves.size(); ++c) {
        say("$p{}c{} << EOD", p, c);
        drawn_.push_back(curve(panel.curves[c], place));
        say("EOD");
        if (const auto bars = error_bars(panel.curves[c], place); !bars.empty())
            say("$p{}c{}bars << EOD\n{}\nEOD", p, c, fmt::join(bars, "\n"));
    }
    if (const auto lines = segments(panel, place); !lines.empty()) {
        say("$p{}segments << EOD", p);
        for (const auto& [from, to] : lines) say("{}\n{}\n", place.numbers(from), place.numbers(to));
        say("EOD");
    }
    heat_map(p);
    shapes(p);
    discs(p);
}

/// Cells from left to right and upwards, each of which goes on a little under the next ones: no gap is seen between.
void Script::heat_map(std::size_t p) {
    if (!figure_.panels[p].map) return;
    const HeatMap& map = *figure_.panels[p].map;
    const PanelPlace& place = layout_.places[p];
    const std::vector<double> x = edges_of(map.x, place.x.log), y = edges_of(map.y, place.y.log);
    say("$p{}heat << EOD", p);
    for (std::size_t row = 0; row < map.y.size(); ++row)
        for (std::size_t column = 0; column < map.x.size(); ++column) {
            const double value = map.values[row * map.x.size() + column];
            if (!std::isfinite(value)) continue;
            const double right = place.x.beyond(x[column + 1], 1 / place.width);
            const double top = place.y.beyond(y[row + 1], 1 / place.height);
            say("{} {} {} {} {} {}", place.numbers({map.x[column], map.y[row]}), place.x.number(x[column]),
                place.x.number(right), place.y.number(y[row]), place.y.number(top), place.heat.number(value));
        }
    say("EOD");
}

void Script::colour_bar(std::size_t p) {
    const PanelPlace& place = layout_.places[p];
    const Axis& heat = place.heat;
    say("set palette {}", palette_of_heat());
    say("set cbrange [{}:{}]\nset cbtics {} format '%.{}f' nomirror", heat.number(heat.low), heat.number(heat.high),
        heat.step, heat.decimals);
    say("set colorbox user origin {:.6f},{:.6f} size {:.6f},{:.6f}", place.bar_left / layout_.width,
        1 - (place.top + place.height) / layout_.height, bar_width / layout_.width, place.height / layout_.height);
    const double at = place.bar_left + bar_width + 0.62 * font_size * static_cast<double>(heat.label_length());
    label(axis_label(figure_.panels[p].map->label, heat, place.height), at + 1.4 * font_size,
          place.top + place.height / 2, "center rotate by 90");
}

/// Discs by their size, points by that of a dot.
void Script::discs(std::size_t p) {
    const PanelPlace& place = layout_.places[p];
    const double dot = dot_radius * (place.x.high - place.x.low) / place.width;
    for (const bool dots : {false, true}) {
        const std::vector<DiscMark> discs = discs_of(figure_.panels[p], place, dots);
        if (discs.empty()) continue;
        say("$p{}{} << EOD", p, dots ? "dots" : "discs");
        for (const DiscMark& disc : discs) {
            const double radius = dots ? dot : disc.radius;
            say("{} {} {}", place.numbers(disc.centre), radius / place.x.unit(), number(disc.fill));
        }
        say("EOD");
    }
    if (!has_marks(figure_.panels[p], place)) return;
    say("$p{}marks << EOD", p);
    for (const DiscMark& disc : figure_.panels[p].discs) {
        if (!is_marked(disc, place)) continue;
        const double reach = disc.radius - dot / 2;  // up to the rim, not on it
        const Vec2 rim = disc.centre + reach * Vec2{std::cos(*disc.angle), std::sin(*disc.angle)};
        for (const Vec2 end : {disc.centre, rim}) say("{} {}", place.numbers(end), number(mark_on(disc.fill)));
        say("");
    }
    say("EOD");
}

void Script::label(std::string_view text, double x, double y, std::string_view how) {
    if (text.empty()) return;
    say("set label {} at screen {:.6f},{:.6f} noenhanced front textcolor '{}' {}", literal(text), x / layout_.width,
        1 - y / layout_.height, text_ink, how);
}

std::string words_of_marks(const Axis& axis, bool labelled) {
    std::vector<std::string> words;
    for (const double mark : axis.marks)
        words.push_back(fmt::format("{} {}", literal(labelled ? mark_words(mark) : ""), mark));
    return fmt::format("{}", fmt::join(words, ", "));
}

void Script::axis(char name, const Axis& axis, bool labelled) {
    if (axis.log) {
        say("set logscale {}", name);
        if (axis.marks.empty())
            say("set {}tics 1e{} format '10^{{%L}}'", name, static_cast<int>(axis.step));
        else
            say("set {}tics ({})", name, words_of_marks(axis, labelled));
    } else {
        say("unset logscale {}", name);
        say("set {}tics {} format '%.{}f'", name, axis.step, axis.decimals);
    }
    if (!labelled) say("set {}tics format ''", name);
    say("set {}range [{}:{}]", name, axis.number(axis.low), axis.number(axis.high));
}

void Script::words(std::size_t p) {
    const Panel& panel = figure_.panels[p];
    const PanelPlace& place = layout_.places[p];
    const double middle = place.left + place.width / 2, bottom = place.top + place.height;
    const double rows = place.legend_entries > 0 && !place.legend_right ? static_cast<double>(place.legend_rows) : 0;
    const double above = 1.5 * font_size * rows;
    say("unset label");
    label(panel.title, middle, place.top - above - 0.9 * font_size, "center");
    if (place.x_labelled)
        label(axis_label(panel.x_label, place.x, place.width), middle, bottom + 2.65 * font_size, "center");
    label(axis_label(panel.y_label, place.y, place.height), place.y_label_at, place.top + place.height / 2,
          "center rotate by 90");
    for (std::size_t k = 0; p == 0 && k < layout_.title.size(); ++k)
        label(layout_.title[k], layout_.width / 2, 1.25 * font_size + static_cast<double>(k) * title_line,
              "center " + title_font_);
}

void Script::legend(const PanelPlace& place) {
    if (place.legend_entries == 0) return say("unset key");
    if (place.legend_right) {
        say("set key at screen {:.6f},{:.6f} left top vertical maxrows {} Left reverse samplen 1.6 spacing {:.3g}",
            (place.left + place.width + 0.6 * font_size) / layout_.width, 1 - place.top / layout_.height,
            place.legend_entries, line_spacing_ * place.legend_spacing);
    } else {
        // Gnuplot breaks rows at the width of the axes, however wide the picture is, but not columns.
        const char* in = place.legend_width > place.width ? "vertical" : "horizontal";
        say("set key at screen {:.6f},{:.6f} center bottom {} maxrows {} Left reverse samplen 1.6 spacing {}",
            place.legend_middle / layout_.width, 1 - (place.top - 0.3 * font_size) / layout_.height, in,
            place.legend_rows, line_spacing_);
    }
}

void Script::setting(std::size_t p) {
    const PanelPlace& place = layout_.places[p];
    say("set lmargin at screen {:.6f}", place.left / layout_.width);
    say("set rmargin at screen {:.6f}", (place.left + place.width) / layout_.width);
    say("set tmargin at screen {:.6f}", 1 - place.top / layout_.height);
    say("set bmargin at screen {:.6f}", 1 - (place.top + place.height) / layout_.height);
    axis('x', place.x, place.x_labelled);
    axis('y', place.y, true);
    legend(place);
}

void Script::plot_curves(std::size_t p, std::vector<std::string>& parts) {
    const Panel& panel = figure_.panels[p];
    const double room = layout_.places[p].label_width;
    for (std::size_t c = 0; c < panel.curves.size(); ++c) {
        const Curve& curve = panel.curves[c];
        if (!drawn_[next_++]) continue;
        std::string how = fmt::format("$p{}c{} with ", p, c);
        const std::string colour = fmt::format("lc rgb '{}'", hex(curve.colour));
        const std::string width = fmt::format("lw {}", line_width * curve.width);
        switch (curve.stroke) {
            case Stroke::line:
                how += "lines " + width;
                break;
            case Stroke::dashed:
                how += "lines dt (14,7) " + width;
                break;
            case Stroke::dotted:
                how += "lines dt (3,5) " + width;
                break;
            case Stroke::points:
                how += fmt::format("points pt 7 ps {}", 0.65 * curve.width);
                break;
            case Stroke::ring:
                how += fmt::format("points pt 6 ps {} lw 2", 1.2 * curve.width);
                break;
            case Stroke::line_and_points:
                how += fmt::format("linespoints pt 7 ps 0.7 {}", width);
                break;
        }
        const auto title =
            curve.label.empty() ? "notitle" : "title " + literal(shortened(curve.label, room)) + " noenhanced";
        // Below its points: around each gnuplot leaves a gap.
        if (!error_bars(curve, layout_.places[p]).empty())
            parts.push_back(fmt::format("$p{}c{}bars with yerrorbars pt 0 lw 1.5 {} notitle", p, c, colour));
        parts.push_back(fmt::format("{} {} {}", how, colour, title));
    }
}

void Script::plot_shapes(std::size_t p, std::vector<std::string>& parts) {
    for (const auto& group : groups_of(figure_.panels[p])) {
        const auto [look, colour] = group.first;
        const std::string name = name_of(p, group);
        if (look == Look::filled) {
            parts.push_back(fmt::format("{} with filledcurves closed lc rgb 0x{:x} notitle", name, colour));
            parts.push_back(fmt::format("{} with lines lw 1 lc rgb '{}' notitle", name, text_ink));
        } else {
            const char* dashes = look == Look::dashed ? "dt (14,7)" : "";
            parts.push_back(fmt::format("{} with lines lw 2 {} lc rgb 0x{:x} notitle", name, dashes, colour));
        }
    }
}

/// Paths lie on what they belong to, and points on their paths.
void Script::plot(std::size_t p) {
    const Panel& panel = figure_.panels[p];
    const PanelPlace& place = layout_.places[p];
    std::vector<std::string> parts;
    if (panel.map &&
        std::any_of(panel.map->values.begin(), panel.map->values.end(), [](double v) { return std::isfinite(v); }))
        parts.push_back(
            fmt::format("$p{}heat using 1:2:3:4:5:6:7 with boxxyerror fs solid noborder lc palette notitle", p));
    if (!segments(panel, place).empty()) {
        parts.push_back(fmt::format("$p{}segments with lines lw 2 lc rgb '{}' notitle", p, wall_ink));
    }
    const auto circles = [&](const char* what) {
        parts.push_back(fmt::format(
            "$p{}{} using 1:2:3:4 with circles lc rgb variable fs solid border rgb '{}' notitle", p, what, text_ink));
    };
    if (!discs_of(panel, place, false).empty()) circles("discs");
    if (has_marks(panel, place))
        parts.push_back(fmt::format("$p{}marks using 1:2:3 with lines lw 1.5 lc rgb variable notitle", p));
    plot_shapes(p, parts);
    plot_curves(p, parts);
    if (!discs_of(panel, place, true).empty()) circles("dots");
    if (parts.empty()) parts.push_back("NaN notitle");  // axes without data
    say("plot {}", fmt::join(parts, ", \\\n     "));
}

std::string Script::write(const Terminal& terminal) {
    say("set encoding utf8\nset minussign");
    say("set terminal {} enhanced rounded background '#ffffff' font '{}'", terminal.settings, terminal.font);
    title_font_ = fmt::format("font '{}'", terminal.title_font);
    line_spacing_ = terminal.line_spacing;
    for (std::size_t p = 0; p < figure_.panels.size(); ++p) data(p);
    say("set border 31 lw 1.2 lc rgb '{}'\nset tics in scale 0.6 textcolor rgb '{}'", text_ink, text_ink);
    say("set grid lw 0.8 lc rgb '#d9d9d9' lt 1\nset style fill solid\nset key textcolor rgb '{}'", text_ink);
    say("set clip two");  // lines whose ends are both outside, too
    say("set multiplot");
    for (std::size_t p = 0; p < figure_.panels.size(); ++p) {
        if (figure_.panels[p].empty) continue;
        setting(p);
        words(p);
        if (figure_.panels[p].map) colour_bar(p);
        plot(p);
    }
    say("unset multiplot");
    return std::move(text_);
}

// The same lengths of text and lines for all three: gnuplot counts a PNG's fonts at 96 dpi and halves a PDF's.
Terminal terminal(const std::filesystem::path& path, const Layout& layout) {
    const auto ending = path.extension();
    const double w = layout.width, h = layout.height;
    if (ending == ".png") {
        const double size = 0.75 * font_size;
        return {fmt::format("pngcairo pointscale 1.7 size {},{}", w, h), fmt::format("Sans,{}", size),
                fmt::format("Sans:Bold,{}", size)};
    }
    if (ending == ".svg") {
        // No ":Bold" here, which would become a part of the family's name.
        return {fmt::format("svg size {},{}", w, h), fmt::format("sans-serif,{}", font_size),
                fmt::format("sans-serif,{}", 1.15 * font_size), 0.8};
    }
    if (ending == ".pdf") {
        const double size = font_size / 2;
        return {fmt::format("pdfcairo fontscale 0.75 size {}in,{}in", w / 144, h / 144), fmt::format("Sans,{}", size),
                fmt::format("Sans:Bold,{}", size)};
    }
    throw Error(fmt::format("{}: a figure ends with .png, .svg or .pdf", path.string()));
}

void check(const Figure& figure) {
    if (figure.width < 100) throw Error(fmt::format("a figure's width is {} pixels: 100 or more", figure.width));
    if (figure.panels.empty()) throw Error("a figure without panels");
    for (const Panel& panel : figure.panels) {
        if (panel.map) check(*panel.map, panel.log_x, panel.log_y);
        for (const Curve& curve : panel.curves) {
            if (curve.x.size() != curve.y.size())
                throw Error(fmt::format("curve \"{}\" has {} x and {} y", curve.label, curve.x.size(), curve.y.size()));
            if (!curve.error.empty() && curve.error.size() != curve.y.size())
                throw Error(fmt::format("curve \"{}\" has {} y and {} errors", curve.label, curve.y.size(),
                                        curve.error.size()));
        }
    }
}

}  // namespace

void save(const Figure& figure, const std::filesystem::path& path) {
    check(figure);
    const Layout layout = lay_out(figure);
    const Terminal how = terminal(path, layout);
    File file(path);
    // Without the user's own settings, which would change the picture.
    Process gnuplot({"gnuplot", "--default-settings", "-"}, "figures", Process::Output::keep);
    file.write(gnuplot.filter(Script(figure, layout).write(how)));
    file.commit();
}

}  // namespace carom
