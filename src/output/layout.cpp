#include "output/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>

#include "output/heat.hpp"

namespace carom {
namespace {

constexpr double em = font_size;
constexpr double letter = 0.62 * em;  ///< width, a little generous
constexpr double line = 1.5 * em;     ///< height of a line of text
constexpr double sample = 3.0 * em;   ///< of a curve in the legend, with the gaps around its words
constexpr double smallest = 40;       ///< axes are never shorter [pixels]
constexpr double readable_x = 12 * em, readable_y = 6 * em;  ///< axes with room for two or three labelled ticks

struct Margins {
    double left = 0, right = 0, top = 0, bottom = 0;
};

struct Grid {
    std::size_t panels, columns, rows;
    std::size_t row(std::size_t i) const { return i / columns; }
    std::size_t column(std::size_t i) const { return i % columns; }
};

Grid grid(const Figure& figure) {
    const std::size_t panels = figure.panels.size();
    const std::size_t columns = std::clamp<std::size_t>(figure.columns, 1, std::max<std::size_t>(1, panels));
    return {panels, columns, (panels + columns - 1) / columns};
}

bool has_below(const Figure& figure, const Grid& grid, std::size_t i) {
    return i + grid.columns < grid.panels && !figure.panels[i + grid.columns].empty;
}

double ticks_width(const Axis& axis) { return letter * static_cast<double>(axis.label_length()); }

/// How far the label of the last tick goes on beyond an axis of so many pixels.
double overhang(const Axis& axis, double pixels) {
    if (axis.log) return 0.5 * ticks_width(axis);
    const double step = axis.step * axis.unit(),
                 last = axis.offset + step * std::floor((axis.high - axis.offset) / step);
    return 0.5 * ticks_width(axis) - (axis.high - last) / (axis.high - axis.low) * pixels;
}

double rise_of(const PanelPlace& place) { return (place.y.high - place.y.low) / (place.x.high - place.x.low); }

void widen(Axis& axis, double factor) {
    const double middle = axis.low + (axis.high - axis.low) / 2, half = factor * (axis.high - axis.low) / 2;
    axis.low = middle - half;
    axis.high = middle + half;
}

/// At equal aspect what is almost a line would be a strip without room for its ticks: nothingness around it is shown.
void widen_strip(PanelPlace& place, double across, double highest) {
    const double rise = rise_of(place), flattest = readable_y / across, steepest = highest / readable_x;
    if (rise < flattest) widen(place.y, flattest / rise);
    if (rise > steepest) widen(place.x, rise / steepest);
}

double usual_width(const Figure& figure, const Grid& grid) {
    return 0.75 * figure.width / static_cast<double>(grid.columns);
}
double highest(const Figure& figure) { return 1.1 * figure.width; }

/// Of a legend beside the axes, in one column. Gnuplot keeps a row free, and would cut a second column off.
double legend_height(const PanelPlace& place) {
    return 1.2 * em * place.legend_spacing * static_cast<double>(place.legend_entries + 1);
}

/// What a panel's axes are thought to have before they are laid out.
struct Space {
    double width, height;
    bool beside = true;  ///< a long legend fits beside them
};

void choose_axes(const Figure& figure, const Grid& grid, std::span<const Space> spaces,
                 std::vector<PanelPlace>& places) {
    for (std::size_t i = 0; i < grid.panels; ++i) {
        const Axes both = axes(figure.panels[i]);
        places[i].x = both.x;
        places[i].y = both.y;
        // One x axis for the column: its first panel's, widened by every other's, then given to them all.
        if (!figure.shared_x || i < grid.columns || figure.panels[i].empty) continue;
        Axis& first = places[grid.column(i)].x;
        first.low = std::min(first.low, both.x.low);
        first.high = std::max(first.high, both.x.high);
    }
    for (std::size_t i = 0; i < grid.panels; ++i) {
        PanelPlace& place = places[i];
        if (figure.panels[i].equal_aspect) widen_strip(place, usual_width(figure, grid), highest(figure));
        if (figure.shared_x) place.x = places[grid.column(i)].x;
        place.x_labelled = !figure.shared_x || !has_below(figure, grid, i);
        if (!figure.panels[i].x_label.empty()) choose_offset(place.x);  // which the label tells
        if (!figure.panels[i].y_label.empty()) choose_offset(place.y);
        double x = place.x.largest(), y = place.y.largest();
        if (figure.panels[i].equal_aspect) x = y = std::max(x, y);
        if (const auto& map = figure.panels[i].map) {
            place.heat = colour_axis(*map);
            if (!map->label.empty()) choose_offset(place.heat);
            choose_unit(place.heat, place.heat.largest());
            choose_ticks(place.heat, spaces[i].height, 2.5 * em);
        }
        choose_unit(place.x, x);
        choose_unit(place.y, y);
        choose_ticks(place.x, spaces[i].width, 5 * em);
        choose_ticks(place.x, spaces[i].width, std::max(5 * em, 1.2 * ticks_width(place.x)));  // as wide as these are
        choose_ticks(place.y, spaces[i].height, 2.5 * em);
    }
}

/// Whether this panel's is the only legend, of panels beside each other, and nothing else is above them.
bool is_legend_for_all(const Figure& figure, const Grid& grid, std::size_t i) {
    const auto has_legend = [](const Panel& panel) {
        return std::any_of(panel.curves.begin(), panel.curves.end(), [](const Curve& c) { return !c.label.empty(); });
    };
    for (std::size_t k = 0; k < grid.panels; ++k)
        if ((grid.row(k) == 0 && !figure.panels[k].title.empty()) || (k != i && has_legend(figure.panels[k])))
            return false;
    return grid.columns > 1 && grid.row(i) == 0;
}

void choose_legend(const Figure& figure, const Grid& grid, std::size_t i, bool beside, PanelPlace& place,
                   Margins& margins) {
    double widest = 0;
    place.legend_for_all = is_legend_for_all(figure, grid, i);
    const double cell = figure.width / (place.legend_for_all ? 1.0 : static_cast<double>(grid.columns));
    place.label_width = 0.9 * cell - sample;  // of a legend that is wider than a picture gnuplot draws nothing
    for (const Curve& curve : figure.panels[i].curves) {
        if (curve.label.empty()) continue;
        ++place.legend_entries;
        widest = std::max(widest, std::min(text_width(curve.label), place.label_width));
    }
    if (place.legend_entries == 0) return;
    const double entry = widest + sample;
    const auto fit =
        std::max<std::size_t>(1, static_cast<std::size_t>((place.legend_for_all ? 0.9 : 0.8) * cell / entry));
    // Long names beside the axes would leave little of these.
    place.legend_right = beside && !place.legend_for_all && place.legend_entries > fit && entry < 0.22 * cell;
    if (place.legend_right && place.legend_entries <= 12) place.legend_spacing = 1.25;
    if (place.legend_right) {
        margins.right += entry + 0.5 * em;
    } else {
        place.legend_rows = (place.legend_entries + fit - 1) / fit;
        const std::size_t columns = (place.legend_entries + place.legend_rows - 1) / place.legend_rows;
        place.legend_width = entry * static_cast<double>(columns);
        margins.top += line * static_cast<double>(place.legend_rows);
    }
}

// The same for a whole column to the left and right, and for a whole row above and below, so that axes align.
std::vector<Margins> choose_margins(const Figure& figure, const Grid& grid, std::span<const Space> spaces,
                                    std::vector<PanelPlace>& places) {
    std::vector<Margins> all(grid.panels);
    for (std::size_t i = 0; i < grid.panels; ++i) {
        const Panel& panel = figure.panels[i];
        if (panel.empty) continue;
        Margins& own = all[i];
        own.left = 1.2 * em + ticks_width(places[i].y);
        if (!panel.y_label.empty()) own.left += line;
        own.right = 1.2 * em;
        if (places[i].x_labelled) own.right = std::max(own.right, overhang(places[i].x, spaces[i].width) + 0.2 * em);
        if (panel.map) own.right += bar_width + ticks_width(places[i].heat) + (panel.map->label.empty() ? 0 : line);
        own.top = 0.7 * em + (panel.title.empty() ? 0 : line);
        own.bottom = 0.6 * em;
        if (places[i].x_labelled) own.bottom += line + (panel.x_label.empty() ? 0 : line);
        choose_legend(figure, grid, i, spaces[i].beside, places[i], own);
    }
    auto columns = all, rows = all;
    for (std::size_t i = 0; i < grid.panels; ++i) {
        Margins& column = columns[grid.column(i)];
        column.left = std::max(column.left, all[i].left);
        column.right = std::max(column.right, all[i].right);
        Margins& row = rows[grid.row(i) * grid.columns];
        row.top = std::max(row.top, all[i].top);
        row.bottom = std::max(row.bottom, all[i].bottom);
    }
    for (std::size_t i = 0; i < grid.panels; ++i) {
        const Margins &column = columns[grid.column(i)], &row = rows[grid.row(i) * grid.columns];
        all[i] = {column.left, column.right, row.top, row.bottom};
    }
    return all;
}

double wanted_height(const Figure& figure, const Panel& panel, const PanelPlace& place, double width) {
    if (panel.empty) return 0;
    const double usual = (figure.columns > 1 ? 0.7 : 0.5) * width * panel.height;
    if (!panel.equal_aspect) return std::max(smallest, usual);
    return std::max(smallest, std::min(width * rise_of(place), highest(figure)));
}

// At equal aspect the axes shrink to their ranges' shape and stand in the middle of their cell.
void shape(const Panel& panel, PanelPlace& place) {
    if (!panel.equal_aspect) return;
    const double rise = rise_of(place);
    const double width = std::min(place.width, place.height / rise), height = width * rise;
    place.left += (place.width - width) / 2;
    place.top += (place.height - height) / 2;
    place.width = width;
    place.height = height;
}

}  // namespace

double text_width(std::string_view text) {
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return letter * static_cast<double>(letters);
}

namespace {

/// Whether fonts show it as a coloured picture by itself: Emoji_Presentation of Unicode 15.
bool is_emoji(char32_t c) {
    struct Range {
        char32_t first, last;
    };
    static constexpr Range pictures[] = {
        {0x231A, 0x231B}, {0x23E9, 0x23F3}, {0x25FD, 0x25FE}, {0x2614, 0x2615}, {0x2648, 0x2653},  {0x267F, 0x267F},
        {0x2693, 0x2693}, {0x26A1, 0x26A1}, {0x26AA, 0x26AB}, {0x26BD, 0x26BE}, {0x26C4, 0x26C5},  {0x26CE, 0x26CE},
        {0x26D4, 0x26D4}, {0x26EA, 0x26EA}, {0x26F2, 0x26F5}, {0x26FA, 0x26FA}, {0x26FD, 0x26FD},  {0x2705, 0x2705},
        {0x270A, 0x270B}, {0x2728, 0x2728}, {0x274C, 0x274E}, {0x2753, 0x2757}, {0x2795, 0x2797},  {0x27B0, 0x27B0},
        {0x27BF, 0x27BF}, {0x2B1B, 0x2B1C}, {0x2B50, 0x2B50}, {0x2B55, 0x2B55}, {0x1F000, 0x1FAFF}};
    return std::any_of(std::begin(pictures), std::end(pictures),
                       [c](const Range& r) { return r.first <= c && c <= r.last; });
}

/// The bytes of the character that begins with this one; 1 of a byte that begins none.
std::size_t bytes_of(char first) {
    const auto byte = static_cast<unsigned char>(first);
    return byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : byte >= 0xC0 ? 2 : 1;
}

/// The character that UTF-8 has in these bytes.
char32_t decoded(std::string_view bytes) {
    const unsigned first = static_cast<unsigned char>(bytes[0]);
    char32_t c = bytes.size() == 1 ? first : first & (0x7Fu >> bytes.size());
    for (const char next : bytes.substr(1)) c = c << 6 | (static_cast<unsigned char>(next) & 0x3Fu);
    return c;
}

}  // namespace

std::string without_emoji(std::string_view text) {
    constexpr char32_t joiner = 0x200D, as_picture = 0xFE0F;
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = bytes_of(text[i]);
        const std::string_view bytes = text.substr(i, length);
        i += bytes.size();
        const char32_t c = decoded(bytes);
        if (c == joiner || c == as_picture) continue;
        if (bytes.size() < length || is_emoji(c))
            out += "□";
        else
            out += bytes;
    }
    return out;
}

std::size_t unit_of(const std::string& text) {
    return text.ends_with(']') ? std::min(text.rfind(" ["), text.size()) : text.size();
}

std::string shortened(const std::string& text, double width) {
    const std::size_t unit = unit_of(text);
    std::vector<std::size_t> letters;  // where they start
    for (std::size_t i = 0; i < unit; ++i)
        if ((text[i] & 0xC0) != 0x80) letters.push_back(i);
    constexpr double least = 8;
    const auto room = static_cast<std::size_t>(std::max(least, (width - text_width(text.substr(unit))) / letter));
    if (letters.size() <= room) return text;
    const std::size_t tail = (room - 1) / 2, head = room - 1 - tail;
    return text.substr(0, letters[head]) + "…" + text.substr(letters[letters.size() - tail]);
}

namespace {

/// A title in lines that fit, broken between words.
std::vector<std::string> title_lines(const std::string& title, double width) {
    std::vector<std::string> lines;
    for (std::size_t start = 0; start < title.size();) {
        const std::size_t end = std::min(title.find(' ', start), title.size());
        const std::string word = title.substr(start, end - start);
        start = end + 1;
        const bool fits = !lines.empty() && text_width(lines.back() + " " + word) * title_size / font_size <= width;
        if (fits)
            lines.back() += " " + word;
        else
            lines.push_back(word);
    }
    return lines;
}

/// All places, for axes whose ticks suit these spaces.
Layout place_all(const Figure& figure, const Grid& grid, std::span<const Space> spaces) {
    Layout layout{std::vector<PanelPlace>(grid.panels), static_cast<double>(figure.width), 0};
    layout.title = title_lines(figure.title, layout.width - 2 * em);
    choose_axes(figure, grid, spaces, layout.places);
    const auto margins = choose_margins(figure, grid, spaces, layout.places);
    double free_width = layout.width;
    for (std::size_t c = 0; c < std::min(grid.columns, grid.panels); ++c) {
        free_width -= margins[c].left + margins[c].right;
    }
    const double width = std::max(smallest, free_width / static_cast<double>(grid.columns));

    std::vector<double> heights(grid.rows, 0);
    for (std::size_t i = 0; i < grid.panels; ++i) {
        double& height = heights[grid.row(i)];
        height = std::max(height, wanted_height(figure, figure.panels[i], layout.places[i], width));
    }
    const double more_lines = layout.title.empty() ? 0 : static_cast<double>(layout.title.size() - 1);
    const double heading = layout.title.empty() ? 0.3 * em : 2.2 * em + more_lines * title_line;
    double taken = heading;
    for (std::size_t r = 0; r < grid.rows; ++r) {
        taken += margins[r * grid.columns].top + margins[r * grid.columns].bottom;
    }
    const double wanted = std::accumulate(heights.begin(), heights.end(), 0.0);
    layout.height = figure.height > 0 ? figure.height : std::ceil(taken + wanted);
    const double stretch = wanted > 0 ? std::max(0.0, layout.height - taken) / wanted : 1;

    double top = heading, left = 0;
    for (std::size_t i = 0; i < grid.panels; ++i) {
        PanelPlace& place = layout.places[i];
        if (grid.column(i) == 0) left = 0;
        place.width = width;
        place.height = std::max(smallest, heights[grid.row(i)] * stretch);
        place.left = left + margins[i].left;
        place.top = top + margins[i].top;
        left += margins[i].left + width + margins[i].right;
        if (grid.column(i) + 1 == grid.columns) top = place.top + place.height + margins[i].bottom;
        shape(figure.panels[i], place);
        place.legend_middle = place.legend_for_all ? layout.width / 2 : place.left + place.width / 2;
        place.y_label_at = std::max(0.7 * em, place.left - ticks_width(place.y) - 1.7 * em);
        place.bar_left = place.left + place.width + 0.7 * em;
    }
    // Labels of a column stand in one line, whatever the length of their ticks' numbers.
    for (std::size_t i = 0; i < grid.panels; ++i) {
        for (std::size_t j = grid.column(i); j < grid.panels; j += grid.columns) {
            if (figure.panels[i].equal_aspect || figure.panels[j].equal_aspect || figure.panels[j].empty) continue;
            layout.places[i].y_label_at = std::min(layout.places[i].y_label_at, layout.places[j].y_label_at);
        }
    }
    return layout;
}

}  // namespace

std::string PanelPlace::numbers(Vec2 point) const { return fmt::format("{} {}", x.number(point.x), y.number(point.y)); }

Layout lay_out(const Figure& figure) {
    const Grid grid = carom::grid(figure);
    const double across = usual_width(figure, grid);
    std::vector<Space> spaces;
    for (const Panel& panel : figure.panels) spaces.push_back({across, 0.55 * across * panel.height});
    const Layout first = place_all(figure, grid, spaces);
    // Where axes are much shorter than thought, their ticks would print over each other, and a legend be cut off.
    const double spare = 1.2;
    for (std::size_t i = 0; i < grid.panels; ++i) {
        spaces[i].width = std::min(spaces[i].width, spare * first.places[i].width);
        spaces[i].height = std::min(spaces[i].height, spare * first.places[i].height);
        spaces[i].beside = legend_height(first.places[i]) <= first.places[i].height;
    }
    return place_all(figure, grid, spaces);
}

}  // namespace carom
