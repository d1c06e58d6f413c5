// What is where in a world: the questions are checked here, and answered by the pieces of its bodies.

#include "collision/queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "collision/room.hpp"
#include "state/validate.hpp"
#include "world/state.hpp"

namespace carom {

PlacedPieces World::State::placed_pieces() {
    if (!places.fit()) fit_pieces(), places.follow(pieces, motion.x);
    return {pieces, bodies.id, places};
}

namespace {

/// What is asked for and makes sense, of the one who asks.
void check_sought(const Sought& sought, const Bodies& bodies, const std::string& who) {
    validate(sought, who + ": sought");
    if (sought.except) bodies.row(*sought.except, who + ": sought", "except");
}
void check_ray(Vec2 origin, Vec2 way, const std::string& who) {
    validate_field(origin, who + ": origin", "m", any);
    validate_field(way, who + ": way", "m", any);
    if (way == Vec2{}) throw Error(who + ": way must not be (0, 0)");
    if (!std::isfinite(squared_length(way)))
        throw Error(fmt::format("{}: way must be shorter than 1e154 m, got ({}, {})", who, way.x, way.y));
}
Frame checked_frame(const Pose& pose, const std::string& who) {
    validate_field(pose.position, who + ": position", "m", any);
    validate_field(pose.angle, who + ": angle", "rad", any);
    return frame_at(pose.position, pose.angle);
}
std::vector<Convex> checked_outlines(const Geometry& shape, const std::string& who) {
    validate_field(shape, who + ": shape", "", any);
    return pieces_of(shape);
}

/// What is met first; of a body and a wall at once the body.
std::optional<Hit> sooner(const std::optional<Hit>& body, const std::optional<Hit>& wall) {
    return wall && (!body || wall->fraction < body->fraction) ? wall : body;
}

}  // namespace

Walls World::State::sought_walls(const Sought& sought) const {
    return sought.walls ? Walls(rectangles, half_planes, stadiums, {}) : Walls{};
}

std::optional<Hit> World::cast_ray(Vec2 origin, Vec2 way, const Sought& sought) const {
    check_ray(origin, way, "World::cast_ray");
    check_sought(sought, state_->bodies, "World::cast_ray");
    return sooner(first_hit(state_->placed_pieces(), origin, way, sought),
                  wall_hit(state_->sought_walls(sought), origin, way));
}

std::vector<Hit> World::cast_ray_through(Vec2 origin, Vec2 way, const Sought& sought) const {
    check_ray(origin, way, "World::cast_ray_through");
    check_sought(sought, state_->bodies, "World::cast_ray_through");
    std::vector<Hit> hits = all_hits(state_->placed_pieces(), origin, way, sought);
    if (const auto wall = wall_hit(state_->sought_walls(sought), origin, way))
        hits.insert(std::upper_bound(hits.begin(), hits.end(), *wall,
                                     [](const Hit& a, const Hit& b) { return a.fraction < b.fraction; }),
                    *wall);
    return hits;
}

std::optional<Hit> World::cast_shape(const Geometry& shape, const Pose& from, Vec2 way, const Sought& sought) const {
    const std::vector<Convex> outlines = checked_outlines(shape, "World::cast_shape");
    const Frame frame = checked_frame(from, "World::cast_shape");
    validate_field(way, "World::cast_shape: way", "m", any);
    check_sought(sought, state_->bodies, "World::cast_shape");
    return sooner(first_hit(state_->placed_pieces(), outlines, frame, way, sought),
                  wall_hit(state_->sought_walls(sought), outlines, frame, way));
}

std::vector<ShapeId> World::shapes_touching(const Geometry& shape, const Pose& at, const Sought& sought) const {
    const std::vector<Convex> outlines = checked_outlines(shape, "World::shapes_touching");
    const Frame frame = checked_frame(at, "World::shapes_touching");
    check_sought(sought, state_->bodies, "World::shapes_touching");
    return overlapping(state_->placed_pieces(), outlines, frame, sought);
}

std::vector<ShapeId> World::shapes_in_box(Vec2 low, Vec2 high, const Sought& sought) const {
    validate_field(low, "World::shapes_in_box: low", "m", any);
    validate_field(high, "World::shapes_in_box: high", "m", any);
    if (!(low.x <= high.x && low.y <= high.y))
        throw Error(
            fmt::format("World::shapes_in_box: high must not lie left of or below low ({}, {}) [m], got "
                        "({}, {})",
                        low.x, low.y, high.x, high.y));
    check_sought(sought, state_->bodies, "World::shapes_in_box");
    return overlapping(state_->placed_pieces(), Aabb{low, high}, sought);
}

std::vector<ShapeId> World::shapes_at(Vec2 point, const Sought& sought) const {
    validate_field(point, "World::shapes_at: point", "m", any);
    check_sought(sought, state_->bodies, "World::shapes_at");
    return overlapping(state_->placed_pieces(), point, sought);
}

Bounds World::bounds(BodyId id) const {
    const auto row = static_cast<std::uint32_t>(state_->bodies.row(id));
    const PlacedPieces all = state_->placed_pieces();
    Aabb box{{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    each_piece_of(all.pieces, row, [&](std::size_t k) { box = hull(box, all.bounds(k)); });
    return {box.low, box.high};
}

std::optional<ClosestPoints> World::closest_points(BodyId a, BodyId b, const Sought& sought) const {
    const std::size_t row_a = state_->bodies.row(a), row_b = state_->bodies.row(b);
    if (a == b) throw Error("World::closest_points: b must be another body than a");
    check_sought(sought, state_->bodies, "World::closest_points");
    return carom::closest_points(state_->placed_pieces(), static_cast<std::uint32_t>(row_a),
                                 static_cast<std::uint32_t>(row_b), sought);
}

namespace {

/// Of shapes in several pieces the deepest; and of all pairs the deepest first.
std::vector<Overlap> deepest_first(std::vector<Overlap> found) {
    const auto key = [](const Overlap& o) {
        return std::tie(o.shapes.a.body.generation, o.shapes.a.body.index, o.shapes.a.shape, o.shapes.b.body.index,
                        o.shapes.b.shape);
    };
    std::sort(found.begin(), found.end(), [key](const Overlap& a, const Overlap& b) {
        return key(a) != key(b) ? key(a) < key(b) : a.depth > b.depth;
    });
    found.erase(std::unique(found.begin(), found.end(),
                            [](const Overlap& a, const Overlap& b) { return a.shapes == b.shapes; }),
                found.end());
    std::stable_sort(found.begin(), found.end(), [](const Overlap& a, const Overlap& b) { return a.depth > b.depth; });
    return found;
}

}  // namespace

std::vector<Overlap> World::overlaps() const {
    State& s = *state_;
    const PlacedPieces all = s.placed_pieces();
    const KeptApart apart(s.current_joints(), s.bodies);
    const Walls walls(s.rectangles, s.half_planes, {}, {});
    std::vector<Overlap> found;
    Scratch<bool> moves(all.pieces.size());
    for (std::size_t k = 0; k < all.pieces.size(); ++k) {
        moves[k] = s.bodies.kind[all[k].row] == Kind::dynamic && !all[k].sensor;
        for (std::uint32_t w = 0; w < walls.all.size() && moves[k]; ++w) {
            const double depth = depth_in(walls.all[w], all[k].outline, all.frame(k));
            if (depth > 0) found.push_back({{{{}, w}, all.shape(k)}, depth, depth / thickness(all[k].outline)});
        }
    }
    Sweep sweep;
    for (const auto [k, l] : sweep.pairs(all.places.bounds(), moves)) {
        const Piece &a = all[k], &b = all[l];
        if (!may_meet(a, b) || apart.contains(a.row, b.row)) continue;
        const double distance = carom::closest_points(a.outline, all.frame(k), b.outline, all.frame(l)).distance;
        if (distance >= 0) continue;
        ShapePair shapes{all.shape(k), all.shape(l)};
        if (shapes.b.body.index < shapes.a.body.index) std::swap(shapes.a, shapes.b);
        found.push_back({shapes, -distance, -distance / std::min(thickness(a.outline), thickness(b.outline))});
    }
    return deepest_first(std::move(found));
}

}  // namespace carom
