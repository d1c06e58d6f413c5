#pragma once
#include <carom/output.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "output/axis.hpp"

namespace carom {

/// Where a panel is in the picture [pixels from the upper left corner] and what its axes show.
struct PanelPlace {
    Axis x, y;
    double left = 0, top = 0, width = 0, height = 0;  ///< of the axes
    double y_label_at = 0;                            ///< x of the y axis's label
    std::size_t legend_entries = 0;
    bool legend_right = false;    ///< else above,
    std::size_t legend_rows = 1;  ///< in so many rows
    double legend_width = 0;      ///< of those, about
    bool legend_for_all = false;  ///< it spans the figure,
    double legend_middle = 0;     ///< and has its middle there
    double legend_spacing = 1;    ///< between its lines
    double label_width = 0;       ///< the most that one of its words may have
    bool x_labelled = true;
    Axis heat{};          ///< of the colour bar of a heat map,
    double bar_left = 0;  ///< whose left side is there

    /// A point, as gnuplot is told it.
    std::string numbers(Vec2 point) const;
};

struct Layout {
    std::vector<PanelPlace> places;
    double width = 0, height = 0;
    std::vector<std::string> title{};  ///< of the figure, in lines
};

inline constexpr double font_size = 18;   ///< pixels
inline constexpr double title_size = 20;  ///< of a figure's title
inline constexpr double title_line = 1.35 * title_size;

inline constexpr double bar_width = 1.1 * font_size;  ///< of a colour bar

/// Width of a text in pixels, a little generous.
double text_width(std::string_view text);
/// With a square for each emoji that is a picture by itself: where a font has one it is coloured, and Cairo draws it
/// over all else.
std::string without_emoji(std::string_view text);
/// Where the unit [in brackets] at the end of a text begins.
std::size_t unit_of(const std::string& text);
/// A text for so many pixels: in one that is too wide "…" stands for its middle. A unit [in brackets] at its end is
/// whole, for half of it is another one.
std::string shortened(const std::string& text, double width);
Layout lay_out(const Figure& figure);

}  // namespace carom
