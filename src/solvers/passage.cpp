#include "solvers/passage.hpp"

#include <cmath>

#include "solvers/covered.hpp"

namespace carom {

namespace {

/// What is round all about its body's position looks the same from all sides.
bool is_disc(const Convex& outline) { return outline.count == 1 && outline.corner[0] == Vec2{}; }

Frame frame(const Convex& outline, const Partner& body) {
    return is_disc(outline) ? Frame{body.x} : frame_at(body.x, body.angle);
}

}  // namespace

std::optional<double> Gap::closes() const {
    const double square = rate * rate - 2 * width * acceleration;
    if (square < 0) return std::nullopt;
    if (rate < 0) return std::max(0.0, 2 * width / (-rate + std::sqrt(square)));
    if (acceleration < 0) return std::max(0.0, (rate + std::sqrt(square)) / -acceleration);
    return std::nullopt;
}

bool Gap::stays_closed(double left) const {
    if (!(width < 0 && rate >= 0)) return false;
    const double widest_at = acceleration < 0 ? std::min(left, rate / -acceleration) : left;
    return width + widest_at * (rate + 0.5 * widest_at * acceleration) < 0;
}

Passage::Passage(const SoftScene& scene, const State& start, const State& end, double h, const SoftContacts& contacts)
    : scene_(scene),
      start_(start),
      end_(end),
      h_(h),
      contacts_(contacts),
      place_(start.size(), unknown),
      closed_(contacts.all.size()) {}

const Passage::Way& Passage::way_of(std::uint32_t row) {
    static const Way ground;
    if (row >= start_.size()) return ground;
    if (place_[row] == unknown) {
        place_[row] = static_cast<std::uint32_t>(ways_.size());
        ways_.push_back(find_way(row));
    }
    return ways_[place_[row]];
}

/// Nobody was struck whose way was not asked for before.
Passage::Way Passage::find_way(std::uint32_t row) const {
    Way way;
    support(row, way);
    contacts_.rest.moving.within(row, row + 1, [&](std::size_t i, std::size_t) {
        way.acceleration = (2 / (h_ * h_)) * (end_.x.linear[i] - start_.x.linear[i] - h_ * start_.v.linear[i]);
        way.press = length(way.acceleration);
        way.angular_acceleration =
            (2 / (h_ * h_)) * (end_.x.angular[i] - start_.x.angular[i] - h_ * start_.v.angular[i]);
        // More than that is no carrying: it lands.
        if (length(way.support) > 1.1 * way.press) way.support = {};
        way.acceleration += way.support;
    });
    return way;
}

/// What leans on something goes on as that has carried it so far: it does not fall in the meantime, and then meets the
/// next seam of the floor from above.
void Passage::support(std::uint32_t row, Way& way) const {
    contacts_.by_body.each(row, [&](std::uint32_t index) {
        const SoftContact& c = contacts_.all[index];
        if (!c.rests || closed_[index]) return;
        way.leans = true;
        const ContactBlock& block = contacts_.layout.blocks[c.block];
        const Vec2 n{block.normal_x[c.row], block.normal_y[c.row]};
        Vec2 force{};
        for (std::uint32_t i = 0; i < block.points; ++i)
            force += block.more[i].normal_force[c.row] * n + block.more[i].tangent_force[c.row] * perpendicular(n);
        way.support += (row == c.b ? 1 : -1) * scene_.bodies.inverse_mass[row] * force;
    });
}

Partner Passage::at(std::uint32_t row, double t) {
    Partner s{row};
    if (row >= start_.size()) return s;
    const Way& way = way_of(row);
    const double back = t - h_, squares = 0.5 * (t * t - h_ * h_);
    s.inverse_mass = scene_.bodies.inverse_mass[row], s.inverse_inertia = scene_.bodies.inverse_inertia[row];
    s.a = way.acceleration, s.alpha = way.angular_acceleration, s.press = way.press;
    s.x = end_.x.linear[row] + 0.5 * h_ * h_ * way.support + back * start_.v.linear[row] + squares * s.a;
    s.angle = end_.x.angular[row] + back * start_.v.angular[row] + squares * s.alpha;
    s.v = start_.v.linear[row] + (t / h_) * (end_.v.linear[row] - start_.v.linear[row]) + t * way.support;
    s.w = start_.v.angular[row] + (t / h_) * (end_.v.angular[row] - start_.v.angular[row]);
    return s;
}

Manifold Passage::look_at(const SoftScene& scene, const SoftContact& c, const Partner& a, const Partner& b) {
    constexpr double anywhere = 1e300;
    const Frame frame_b = frame(scene.pieces[c.piece_b].outline, b);
    return look(scene, c.candidate(), c.at_wall ? Frame{} : frame(scene.pieces[c.piece_a].outline, a), frame_b,
                anywhere);
}

double Passage::gap_beside(const SoftContact& c, const Partner& a, const Partner& b) const {
    constexpr double anywhere = 1e300;
    if (!is_at_chain(c.candidate(), contacts_.pieces)) return 0;
    const Manifold m = look_beside(scene_, c.candidate(), frame(scene_.pieces[c.piece_a].outline, a),
                                   frame(scene_.pieces[c.piece_b].outline, b), anywhere);
    return std::max(0.0, least_gap(m));
}

Gap Passage::gap(const SoftContact& c, const Manifold& m, int point, const Partner& a, const Partner& b) {
    const auto [ra, rb] = levers(c, m, point, b.x - a.x);
    return {m.point[point].gap, dot(b.velocity_at(rb) - a.velocity_at(ra), m.normal), dot(b.a - a.a, m.normal)};
}

bool Passage::is_disc(const SoftContact& c, bool of_a) const {
    return !(of_a && c.at_wall) && carom::is_disc(scene_.pieces[of_a ? c.piece_a : c.piece_b].outline);
}

double Passage::little_way(const SoftContact& c, const Partner& a, const Partner& b) const {
    constexpr double part = 0.1;
    const double extent = std::min(contacts_.pieces.extent[c.a], contacts_.pieces.extent[c.b]),
                 turning = of_turning(c, a, b, [](const Partner&p) { return std::abs(p.w); });
    const auto least = [&](std::uint32_t piece) {
        const Convex& outline = scene_.pieces[piece].outline;
        return outline.one_sided ? outline.width : HUGE_VAL;  // he is not to be past a line that is short
    };
    const double width = std::min(least(c.piece_a), least(c.piece_b));
    return part * std::min(width, thickness(c.candidate(), contacts_.pieces)) / (length(b.v - a.v) + turning * extent);
}

double Passage::stay_apart(const SoftContact& c, double from, const Partner& a, const Partner& b) const {
    const bool a_is_small = contacts_.pieces.extent[c.a] < contacts_.pieces.extent[c.b];
    Partner s = a_is_small ? a : b, l = a_is_small ? b : a;
    s.angle -= a_is_small ? c.seen.angle_a : c.seen.angle_b, l.angle -= a_is_small ? c.seen.angle_b : c.seen.angle_a;
    if (is_disc(c, !a_is_small)) l.angle = l.w = l.alpha = 0;
    const Vec2 before = (a_is_small ? -1 : 1) * c.seen.between, lever = s.x - l.x;
    const double left = h_ - from, far = length(lever);
    const double extent = is_disc(c, a_is_small) ? 0 : contacts_.pieces.extent[s.row];
    const auto apart = [&](double gone, double speed, double bend) {
        const double gap = c.seen.gap - gone;
        return gap > 0 ? 2 * gap / (speed + std::sqrt(speed * speed + 2 * bend * gap)) : 0;
    };
    // As the larger one's material sees it: the chord of the turn, and what it is off by; beside the forces on the two
    // Coriolis's bends the way, Euler's, and the centrifugal one.
    const double along = length(s.v - l.v - cross(l.w, lever));
    const double chord = length(lever - before - cross(0.5 * l.angle, lever + before));
    const double bend =
        length(s.a - l.a) + 2 * std::abs(l.w) * along + (std::abs(l.alpha) + l.w * l.w) * (far + left * along);
    const double there =
        apart(chord + std::abs(l.angle * l.angle * l.angle) * far + extent * std::abs(s.angle - l.angle),
              along + extent * std::abs(s.w - l.w), bend + extent * std::abs(s.alpha - l.alpha));
    // As who does not turn sees it, for what spins far away.
    const auto of_both = [&](double its, double others) {
        return (its == 0 ? 0 : extent * std::abs(its)) +
               (others == 0 ? 0 : contacts_.pieces.extent[l.row] * std::abs(others));
    };
    const double here = apart(length(lever - before) + of_both(s.angle, l.angle), length(s.v - l.v) + of_both(s.w, l.w),
                              length(s.a - l.a) + of_both(s.alpha, l.alpha));
    return std::max(there, here);
}

}  // namespace carom
