#include "output/strokes.hpp"

#include <algorithm>
#include <carom/error.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "output/covered.hpp"
#include "output/unfinished.hpp"

namespace carom {
namespace {

constexpr double tolerance = 0.1;  // pixels

double part(const Axis& axis, double value) {
    if (axis.log) return std::log10(value / axis.low) / std::log10(axis.high / axis.low);
    return (value - axis.low) / (axis.high - axis.low);
}

double value(const Axis& axis, double part) {
    if (axis.log) return axis.low * std::pow(axis.high / axis.low, part);
    return axis.number(axis.low + part * (axis.high - axis.low));
}

double angle(Vec2 a) { return std::atan2(a.y, a.x); }

/// A line from an anchor that may turn as long as it passes all points since at less than the tolerance.
class Sleeve {
  public:
    explicit Sleeve(Vec2 anchor) : anchor_(anchor) {}
    /// False if no such line passes this point too, or if it turns back.
    bool take(Vec2 point) {
        const Vec2 arm = point - anchor_;
        const double reach = length(arm);
        if (reach < farthest_ - tolerance) return false;
        if (reach <= tolerance) return true;
        const double play = std::asin(tolerance / reach);
        if (farthest_ <= tolerance) {
            middle_ = angle(arm);
            left_ = play;
            right_ = -play;
        } else {
            const double turn = std::remainder(angle(arm) - middle_, 2 * std::numbers::pi);
            if (turn > left_ || turn < right_) return false;
            left_ = std::min(left_, turn + play);
            right_ = std::max(right_, turn - play);
        }
        farthest_ = std::max(farthest_, reach);
        return true;
    }

  private:
    Vec2 anchor_;
    double farthest_ = 0, middle_ = 0, left_ = 0, right_ = 0;
};

// After Zhao and Saalfeld (1997): one pass, no point farther off than the tolerance.
std::vector<Vec2> simplify(const std::vector<Vec2>& points) {
    std::vector<Vec2> kept{points.front()};
    Sleeve sleeve(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (sleeve.take(points[i])) continue;
        kept.push_back(points[i - 1]);
        sleeve = Sleeve(points[i - 1]);
        sleeve.take(points[i]);
    }
    if (points.size() > 1) kept.push_back(points.back());
    return kept;
}

// Gnuplot moves a piece that happens to be level or upright onto whole pixels. That makes long ones sharp, but a short
// one in a smooth curve becomes a step; a tenth of a pixel off the level it is left alone.
void avoid_steps(std::vector<Vec2>& points) {
    const auto aside = [](double to, double from) {
        return std::abs(to - from) < 0.06 ? from + (to < from ? -0.12 : 0.12) : to;
    };
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Vec2 from = points[i - 1];
        Vec2& to = points[i];
        if (length(to - from) > 60) continue;
        to = {aside(to.x, from.x), aside(to.y, from.y)};
    }
}

// Marks: of neighbours that nobody could tell apart, one.
std::vector<Vec2> thin(const std::vector<Vec2>& points) {
    std::vector<Vec2> kept{points.front()};
    for (Vec2 point : points) {
        if (length(point - kept.back()) > 0.25) kept.push_back(point);
    }
    return kept;
}

/// Of millions of points the outlines take seconds, in which Ctrl-C is heard. Of a run that was cut short by it before,
/// there is a figure nevertheless.
class Patience {
  public:
    void ask() const {
        if (figures_were_interrupted() && !before_)
            throw Error("interrupted while a figure was drawn", Error::Cause::run);
    }

  private:
    bool before_ = figures_were_interrupted();
};

// Of a crowd of marks: none where one stands.
std::vector<std::vector<Vec2>> without_others(const std::vector<Vec2>& points, Covered& covered,
                                              const Patience& patience) {
    std::vector<Vec2> kept;
    for (Vec2 point : points) {
        patience.ask();
        if (covered.adds(point, point)) kept.push_back(point);
    }
    if (kept.empty()) return {};
    return {kept};
}

// What runs over itself a thousand times is drawn once: Cairo works out the outline of a whole path, in far more time
// than twice the path takes twice of. So none is too long, either; each begins where the last one ended.
std::vector<std::vector<Vec2>> without_repeats(const std::vector<Vec2>& points, Covered& covered,
                                               const Patience& patience) {
    constexpr std::size_t longest = 1000;
    std::vector<std::vector<Vec2>> parts;
    bool goes_on = false;
    for (std::size_t i = 1; i < points.size(); ++i) {
        patience.ask();
        const bool drawn = covered.adds(points[i - 1], points[i]);
        if (drawn && (!goes_on || parts.back().size() == longest)) parts.push_back({points[i - 1]});
        if (drawn) parts.back().push_back(points[i]);
        goes_on = drawn;
    }
    return parts;
}

// Of dashes the phase would be lost where some are left out.
std::vector<std::vector<Vec2>> drawn(const std::vector<Vec2>& piece, Stroke stroke, bool crowded, Covered& covered,
                                     const Patience& patience) {
    const bool marks = stroke == Stroke::points || stroke == Stroke::ring;
    if (marks && crowded) return without_others(piece, covered, patience);
    if (marks || stroke == Stroke::line_and_points) return {thin(piece)};
    std::vector<Vec2> points = simplify(piece);
    avoid_steps(points);
    if (stroke == Stroke::line && points.size() > 1) return without_repeats(points, covered, patience);
    return {points};
}

}  // namespace

std::vector<std::vector<Vec2>> strokes(const Curve& curve, const PanelPlace& place) {
    const Patience patience;
    std::vector<std::vector<Vec2>> pieces(1);
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
        const double x = curve.x[i], y = curve.y[i];
        const bool has_log = !(place.x.log && x <= 0) && !(place.y.log && y <= 0);
        if (std::isfinite(x) && std::isfinite(y) && has_log) {
            pieces.back().push_back({part(place.x, x) * place.width, part(place.y, y) * place.height});
        } else if (!pieces.back().empty()) {
            pieces.emplace_back();
        }
    }
    if (pieces.back().empty()) pieces.pop_back();
    std::vector<std::vector<Vec2>> parts;
    Covered covered(place.width, place.height, curve.stroke == Stroke::line ? line_width * curve.width : 0);
    constexpr std::size_t few = 1000;
    for (const auto& piece : pieces)
        for (auto& part_of_it : drawn(piece, curve.stroke, curve.x.size() > few, covered, patience))
            parts.push_back(std::move(part_of_it));
    if (parts.empty() && !pieces.empty()) parts.push_back({pieces[0][0]});  // all of it is outside; it has its name
    for (auto& points : parts)
        for (Vec2& point : points)
            point = {value(place.x, point.x / place.width), value(place.y, point.y / place.height)};
    return parts;
}

}  // namespace carom
