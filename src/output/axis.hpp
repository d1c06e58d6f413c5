#pragma once
#include <carom/output.hpp>
#include <string>

namespace carom {

/// What an axis shows: from low to high, in units of 10^exponent when its numbers would be too long otherwise.
struct Axis {
    double low = 0, high = 1;
    bool log = false;
    int exponent = 0;
    double step = 0.2;  ///< between labelled ticks, in units of 10^exponent; of a log axis in decades
    int decimals = 1;   ///< of the ticks' labels

    double unit() const;
    /// Characters in its longest tick label.
    std::size_t label_length() const;
};

struct Axes {
    Axis x, y;
};

/// The panel's ranges, or the data's with a little margin.
Axes axes(const Panel& panel);
/// From low to high; with room around what differs by rounding alone, or is as good as zero.
Interval with_room(double low, double high);
/// A power of ten for the axis's label, if the largest number on the axis asks for it.
void choose_unit(Axis& axis, double largest);
/// Round numbers, `apart` pixels or more from each other on an axis of so many pixels.
void choose_ticks(Axis& axis, double pixels, double apart);

/// 10⁶, or 10⁻³.
std::string power_of_ten(int exponent);
/// "t = 2.5 s" to six digits; from 10⁵ s on with a power of ten, as on an axis.
std::string time_words(double time);

}  // namespace carom
