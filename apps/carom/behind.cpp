#include "behind.hpp"

#include <algorithm>

#include "linked.hpp"

namespace carom::app {

namespace {

/// Two neighbouring points of a chain [m].
struct Piece {
    Vec2 a, b;
    BodyId of;
};

/// The pieces of fixed chains whose free side is below.
std::vector<Piece> facing(const World& world, Vec2 down) {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < world.size(); ++i) {
        if (world.kinds()[i] != Kind::fixed) continue;
        const BodyId id = world.ids()[i];
        for (const Shape& shape : world.shapes()[i]) {
            const auto* const chain = std::get_if<Chain>(&shape.geometry);
            if (!chain || shape.sensor) continue;
            const std::size_t n = chain->points.size();
            for (std::size_t k = 0; k + (chain->closed ? 0 : 1) < n; ++k) {
                const Vec2 a = to_world(world.pose(id), chain->points[k]),
                           b = to_world(world.pose(id), chain->points[(k + 1) % n]);
                if (cross(b - a, down) > 0) pieces.push_back({a, b, id});  // the left of a way is its free side
            }
        }
    }
    return pieces;
}

/// How far a piece is below a point [m]; nothing if it is not.
std::optional<double> depth_below(Vec2 point, Vec2 down, const Piece& piece) {
    const Vec2 along = piece.b - piece.a;
    const double across = cross(along, down), depth = cross(along, piece.a - point) / across;
    const double part = cross(point - piece.a, down) / across;
    if (!(part >= 0 && part <= 1 && depth > 0)) return {};
    return depth;
}

/// Bodies that hang on something, or stand on it by joints.
std::unordered_set<BodyId> held(const World& world) {
    std::vector<BodyId> anchors;
    for (std::size_t i = 0; i < world.size(); ++i)
        if (world.kinds()[i] != Kind::dynamic) anchors.push_back(world.ids()[i]);
    for (const Joint& joint : world.joints())
        if (!joint.a) anchors.push_back(joint.b);
    return linked(world, anchors);
}

/// Whether a body comes to the back of a piece before anything else, and would collide with its front.
bool meets(const World& world, BodyId id, Vec2 down, double depth, const Piece& piece, const Shape* shape) {
    constexpr double hair = 1e-6;
    const Vec2 centre = world.position(id);
    Sought sought{.except = id, .walls = true};
    if (shape) sought.filter = shape->filter;
    if (world.cast_ray(centre, (1 + hair) * depth * down, sought)) return false;
    const auto front = world.cast_ray(centre + (1 + hair) * depth * down, -2 * hair * depth * down, sought);
    return front && front->body == piece.of;
}

}  // namespace

std::optional<FromBehind> falls_from_behind(const World& world) {
    constexpr std::size_t many = 10'000'000;  // more are looked for as long as a run takes
    const Vec2 gravity = world.settings().gravity;
    if (gravity == Vec2{} || !world.fields().empty() || !world.constant_forces().empty() ||
        !world.attractions().empty())
        return {};
    const Vec2 down = gravity / length(gravity);
    const std::vector<Piece> pieces = facing(world, down);
    if (pieces.empty() || pieces.size() * world.size() > many) return {};
    const std::unordered_set<BodyId> hang = held(world);
    for (std::size_t i = 0; i < world.size(); ++i) {
        const BodyId id = world.ids()[i];
        const auto& shapes = world.shapes()[i];
        const auto solid = std::find_if(shapes.begin(), shapes.end(), [](const Shape& s) { return !s.sensor; });
        const bool collides = solid != shapes.end() || world.radii()[i] > 0;
        if (world.kinds()[i] != Kind::dynamic || !collides || hang.contains(id)) continue;
        for (const Piece& piece : pieces) {
            const auto depth = depth_below(world.position(id), down, piece);
            if (depth && meets(world, id, down, *depth, piece, solid == shapes.end() ? nullptr : &*solid))
                return FromBehind{id, piece.of};
        }
    }
    return {};
}

}  // namespace carom::app
