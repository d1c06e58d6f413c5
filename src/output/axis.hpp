#pragma once
#include <carom/output.hpp>
#include <string>
#include <vector>

namespace carom {

/// What an axis shows: from low to high, less an offset and in units of 10^exponent when its numbers would be too long
/// otherwise.
struct Axis {
    double low = 0, high = 1;
    bool log = false;
    int exponent = 0;
    double step = 0.2;  ///< between labelled ticks, in units of 10^exponent; of a log axis in decades
    int decimals = 1;   ///< of the ticks' labels
    double offset = 0;
    std::vector<double> marks{};  ///< labelled ticks of a log axis that is too short for powers of ten

    double unit() const;
    /// A value as the axis's number for it.
    double number(double value) const { return (value - offset) / unit(); }
    /// A value that is farther along by a part of the axis, or its end.
    double beyond(double value, double part) const;
    /// The largest of its numbers, in the unit of the values.
    double largest() const;
    /// Characters in its longest tick label.
    std::size_t label_length() const;
};

struct Axes {
    Axis x, y;
};

/// Half of a point's error bar; 0 if it has none.
double bar_at(const Curve& curve, std::size_t point);
/// The panel's ranges, or the data's with a little margin.
Axes axes(const Panel& panel);
/// From low to high; with room around what differs by rounding alone, or is as good as zero.
Interval with_room(double low, double high);
/// A round number to count from, if the numbers on the axis would differ late in their digits.
void choose_offset(Axis& axis);
/// A power of ten for the axis's label, if the largest number on the axis asks for it.
void choose_unit(Axis& axis, double largest);
/// Round numbers, `apart` pixels or more from each other on an axis of so many pixels.
void choose_ticks(Axis& axis, double pixels, double apart);

/// A tick of a log axis: 0.02, or 2·10⁻⁷.
std::string mark_words(double value);
/// All digits of a number that has not many: 49.95, or 1.5 · 10¹⁸.
std::string exact_words(double value);
/// 10⁶, or 10⁻³.
std::string power_of_ten(int exponent);
/// 200 · 10⁹, to six digits; the power is one of a thousand.
std::string words_in_thousands(double value);
/// "t = 2.5 s" to six digits; from 10⁵ s on with a power of ten, as on an axis.
std::string time_words(double time);

}  // namespace carom
