// What figures show of a world at an instant.

#include "output/paint.hpp"
#include "output/rim.hpp"
#include "state/bodies.hpp"

namespace carom {
namespace {

/// What joins bodies belongs to a picture of some of them if one of these is among what it joins, or nothing of that
/// moves; without any names, always.
class Shown {
  public:
    Shown(const World& world, std::span<const BodyId> named) : all_(named.empty()) {
        if (all_) return;
        for (std::size_t i = 0; i < world.size(); ++i)
            if (world.kinds()[i] != Kind::fixed) role_of(world.ids()[i]) = Role::hidden;
        for (const BodyId id : named) role_of(id) = Role::shown;
    }
    bool has(const std::optional<BodyId>& a, BodyId b) const {
        const auto is = [&](Role role) { return (a && of(*a) == role) || of(b) == role; };
        return all_ || is(Role::shown) || !is(Role::hidden);
    }

  private:
    enum class Role : std::uint8_t { none, shown, hidden };
    Role& role_of(BodyId id) {
        if (id.index >= roles_.size()) roles_.resize(id.index + 1, Role::none);
        return roles_[id.index];
    }
    Role of(BodyId id) const { return id.index < roles_.size() ? roles_[id.index] : Role::none; }
    bool all_;
    std::vector<Role> roles_{};  ///< by the bodies' indices
};

/// Hinges, pulleys and nails of rods as white dots, all or those that do not move. Of very many joints none.
void add_pins(const World& world, const Shown& parts, bool still_alone, std::vector<DiscMark>& to) {
    if (world.joints().size() > 100) return;
    for (const Joint& j : world.joints()) {
        if (!parts.has(j.a, j.b)) continue;
        const bool moves = j.a && world.body(*j.a).kind != Kind::fixed;
        const bool hinge = std::holds_alternative<RevoluteJoint>(j.type) || std::holds_alternative<WheelJoint>(j.type);
        const bool nail = !j.a && std::holds_alternative<DistanceJoint>(j.type);
        if (nail || (hinge && !(moves && still_alone)))
            to.push_back({world.wrapped(end_of(world, j.a, j.anchor_a)), 0, paper});
        if (const auto* pulley = std::get_if<PulleyJoint>(&j.type))
            for (const Vec2 at : {pulley->ground_a, pulley->ground_b}) to.push_back({at, 0, paper});
    }
}

void add_body(const World& world, BodyId id, Moment& to) {
    const auto shapes = shapes_of(world, id);
    to.shapes.insert(to.shapes.end(), shapes.begin(), shapes.end());
    const Body body = world.body(id);
    if (!shapes.empty()) return;
    const auto angle = shows_angle(body) ? std::optional(body.angle) : std::nullopt;
    to.discs.push_back({world.wrapped(body.position), body.radius, fill_of(body, id), angle});
}

}  // namespace

std::vector<ShapeMark> shapes_of(const World& world, BodyId id) {
    const Body body = world.body(id);
    std::vector<ShapeMark> marks;
    for (const Shape& shape : body.shapes) {
        auto [points, closed] = rim_of(shape.geometry);
        if (closed) points.push_back(points.front());
        const Look look = shape.sensor ? Look::dashed : closed ? Look::filled : Look::line;
        const Colour colour = look == Look::line ? line_of(body, id) : fill_of(body, id);
        marks.push_back({placed(std::move(points), world.wrapped(body.position), body.angle), look, colour});
    }
    return marks;
}

std::vector<Line> lines_of(const World& world, std::span<const BodyId> shown) {
    const Shown parts(world, shown);
    constexpr std::size_t most = 20000;
    std::vector<Line> lines;
    for (const Stadium& walls : world.stadiums()) {
        const std::vector<Vec2> rim = rim_of(walls).points;
        for (std::size_t i = 0; i < rim.size(); ++i) lines.push_back({rim[i], rim[(i + 1) % rim.size()]});
    }
    const auto join = [&](Vec2 from, Vec2 to) {
        const Vec2 start = world.wrapped(from);
        lines.push_back({start, start + (to - from)});
    };
    for (const Joint& j : world.joints()) {
        if (!parts.has(j.a, j.b)) continue;
        if (std::holds_alternative<DistanceJoint>(j.type))
            join(end_of(world, j.a, j.anchor_a), end_of(world, std::optional(j.b), j.anchor_b));
        if (const auto* pulley = std::get_if<PulleyJoint>(&j.type))
            for (const Line& part : rope_of(world, j, *pulley)) lines.push_back(part);
    }
    if (world.springs().size() > most) return lines;
    for (const Spring& spring : world.springs())
        if (parts.has(spring.a, spring.b))
            join(end_of(world, spring.a, spring.anchor_a), end_of(world, spring.b, spring.anchor_b));
    return lines;
}

Moment moment_of(const World& world) {
    Moment now{.time = world.time(), .lines = lines_of(world)};
    for (const BodyId id : world.ids()) add_body(world, id, now);
    add_pins(world, Shown(world, {}), false, now.discs);
    return now;
}

Moment surroundings_of(const World& world, std::span<const BodyId> shown) {
    Moment now{.time = world.time(), .lines = lines_of(world, shown)};
    for (std::size_t i = 0; i < world.size(); ++i)
        if (world.kinds()[i] == Kind::fixed) add_body(world, world.ids()[i], now);
    add_pins(world, Shown(world, shown), true, now.discs);
    return now;
}

}  // namespace carom
