// What is where in a world: the questions are checked here, and answered by the pieces of its bodies.

#include "collision/queries.hpp"

#include <fmt/format.h>

#include "state/validate.hpp"
#include "world/state.hpp"

namespace carom {

PlacedPieces World::State::placed_pieces() {
    if (!pieces_fit) pieces = pieces_of(bodies);
    pieces_fit = true;
    if (!places) places.emplace(pieces, motion.x);
    return {pieces, bodies.id, *places};
}

namespace {

/// What is asked for and makes sense, of the one who asks.
void check_sought(const Sought& sought, const Bodies& bodies, const std::string& who) {
    validate(sought, who + ": sought");
    if (sought.except) bodies.row(*sought.except);
}
void check_ray(Vec2 origin, Vec2 way, const std::string& who) {
    validate_field(origin, who + ": origin", "m", any);
    validate_field(way, who + ": way", "m", any);
    if (way == Vec2{}) throw Error(who + ": way must not be (0, 0)");
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

}  // namespace

std::optional<Hit> World::cast_ray(Vec2 origin, Vec2 way, const Sought& sought) const {
    check_ray(origin, way, "World::cast_ray");
    check_sought(sought, state_->bodies, "World::cast_ray");
    return first_hit(state_->placed_pieces(), origin, way, sought);
}

std::vector<Hit> World::cast_ray_through(Vec2 origin, Vec2 way, const Sought& sought) const {
    check_ray(origin, way, "World::cast_ray_through");
    check_sought(sought, state_->bodies, "World::cast_ray_through");
    return all_hits(state_->placed_pieces(), origin, way, sought);
}

std::optional<Hit> World::cast_shape(const Geometry& shape, const Pose& from, Vec2 way, const Sought& sought) const {
    const std::vector<Convex> outlines = checked_outlines(shape, "World::cast_shape");
    const Frame frame = checked_frame(from, "World::cast_shape");
    validate_field(way, "World::cast_shape: way", "m", any);
    check_sought(sought, state_->bodies, "World::cast_shape");
    return first_hit(state_->placed_pieces(), outlines, frame, way, sought);
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

std::optional<ClosestPoints> World::closest_points(BodyId a, BodyId b, const Sought& sought) const {
    const std::size_t row_a = state_->bodies.row(a), row_b = state_->bodies.row(b);
    if (a == b) throw Error("World::closest_points: b must be another body than a");
    check_sought(sought, state_->bodies, "World::closest_points");
    return carom::closest_points(state_->placed_pieces(), static_cast<std::uint32_t>(row_a),
                                 static_cast<std::uint32_t>(row_b), sought);
}

}  // namespace carom
