#include "forces/loads.hpp"
#include "state/validate.hpp"
#include "world/building.hpp"

namespace carom {

namespace {

/// Where an end of a rope is, in the world.
Vec2 end_of(const World& world, const std::optional<BodyId>& body, Vec2 anchor) {
    return body ? world.position(*body) + turned(anchor, world.angle(*body)) : anchor;
}

/// A spring's hold: a body and a point of it.
struct Hold {
    BodyId body;
    Vec2 anchor{};
};

double checked_rest_length(const Rope& rope, double distance) {
    if (!(distance > 0))
        throw Error("Rope.anchor_b must be away from the other end: beads in one point have no direction to part in");
    const double rest_length = rope.rest_length.value_or(distance);
    const double widest = 0.5 * std::min(distance, rest_length) / rope.segments;
    // Half a segment itself is allowed, and rounding must not forbid it.
    if (rope.radius > widest * (1 + 1e-12))
        throw Error(fmt::format("Rope.radius must be at most half a segment, {:.6g} m, or beads overlap; got {} m",
                                widest, rope.radius));
    return rest_length;
}

}  // namespace

Built build(World& world, const Rope& rope) {
    validate(rope, "Rope");
    const Vec2 start = end_of(world, rope.a, rope.anchor_a), end = end_of(world, rope.b, rope.anchor_b);
    const double rest_length = checked_rest_length(rope, length(end - start));
    const double segment = rest_length / rope.segments, segment_mass = rope.mass / rope.segments;

    return all_or_nothing(world, [&](std::vector<BodyId>& made) {
        const auto bead = [&](int i, bool fixed) {
            const bool outermost = i == 0 || i == rope.segments;
            made.push_back(world.add(Body{.kind = fixed ? Kind::fixed : Kind::dynamic,
                                          .position = start + static_cast<double>(i) / rope.segments * (end - start),
                                          .mass = outermost ? 0.5 * segment_mass : segment_mass,
                                          .radius = rope.radius,
                                          .name = numbered(rope.name, made.size())}));
            return Hold{made.back()};
        };
        Hold last = rope.a ? Hold{*rope.a, rope.anchor_a} : bead(0, rope.fixed_a);
        for (int i = 1; i <= rope.segments; ++i) {
            const bool is_end = i == rope.segments;
            const Hold next = is_end && rope.b ? Hold{*rope.b, rope.anchor_b} : bead(i, is_end && rope.fixed_b);
            world.add(Spring{.a = last.body,
                             .b = next.body,
                             .anchor_a = last.anchor,
                             .anchor_b = next.anchor,
                             .stiffness = rope.stiffness / segment,
                             .rest_length = segment,
                             .damping = rope.damping / segment});
            last = next;
        }
    });
}

namespace {

bool is_held(const Lattice& lattice, int column, int row) {
    const bool left = column == 0, right = column == lattice.nx - 1, bottom = row == 0, top = row == lattice.ny - 1;
    switch (lattice.held) {
        case Held::none:
            return false;
        case Held::top:
            return top;
        case Held::bottom:
            return bottom;
        case Held::left:
            return left;
        case Held::right:
            return right;
        case Held::left_right:
            return left || right;
        case Held::top_corners:
            return top && (left || right);
        case Held::corners:
            return (top || bottom) && (left || right);
        case Held::border:
            return left || right || bottom || top;
    }
    return false;
}

/// The springs from a node to nodes farther on, so that every pair is met once: steps in columns and rows.
struct Bond {
    int columns, rows;
    double stiffness;
};

std::vector<Bond> bonds_of(const Lattice& lattice) {
    std::vector<Bond> bonds{{1, 0, lattice.stiffness}, {0, 1, lattice.stiffness}};
    if (lattice.shear_stiffness > 0)
        bonds.insert(bonds.end(), {{1, 1, lattice.shear_stiffness}, {-1, 1, lattice.shear_stiffness}});
    if (lattice.bend_stiffness > 0)
        bonds.insert(bonds.end(), {{2, 0, lattice.bend_stiffness}, {0, 2, lattice.bend_stiffness}});
    return bonds;
}

}  // namespace

Built build(World& world, const Lattice& lattice) {
    validate(lattice, "Lattice");
    check_product(lattice.nx, lattice.ny, "Lattice");
    if (2 * lattice.radius > lattice.spacing)
        throw Error(fmt::format("Lattice.radius must be at most half the spacing of {} m, or nodes overlap; got {} m",
                                lattice.spacing, lattice.radius));

    return all_or_nothing(world, [&](std::vector<BodyId>& made) {
        for (int row = 0; row < lattice.ny; ++row)
            for (int column = 0; column < lattice.nx; ++column)
                made.push_back(
                    world.add(Body{.kind = is_held(lattice, column, row) ? Kind::fixed : Kind::dynamic,
                                   .position = lattice.corner + lattice.spacing * Vec2{double(column), double(row)},
                                   .mass = lattice.mass,
                                   .radius = lattice.radius,
                                   .name = numbered(lattice.name, column, row)}));
        const auto node = [&](int column, int row) {
            return made[static_cast<std::size_t>(row) * lattice.nx + column];
        };
        const std::vector<Bond> bonds = bonds_of(lattice);
        for (int row = 0; row < lattice.ny; ++row)
            for (int column = 0; column < lattice.nx; ++column)
                for (const Bond& bond : bonds) {
                    const int to_column = column + bond.columns, to_row = row + bond.rows;
                    if (to_column < 0 || to_column >= lattice.nx || to_row >= lattice.ny) continue;
                    world.add(Spring{.a = node(column, row),
                                     .b = node(to_column, to_row),
                                     .stiffness = bond.stiffness,
                                     .rest_length = lattice.spacing * length({double(bond.columns), double(bond.rows)}),
                                     .damping = lattice.damping});
                }
    });
}

Built build(World& world, const GridOf& grid) {
    validate(grid, "GridOf");
    check_product(grid.nx, grid.ny, "GridOf");
    if ((grid.nx > 1 && grid.spacing.x == 0) || (grid.ny > 1 && grid.spacing.y == 0))
        throw Error("GridOf.spacing must not be 0 m: the copies would lie in one place");

    return all_or_nothing(world, [&](std::vector<BodyId>& made) {
        for (int row = 0; row < grid.ny; ++row)
            for (int column = 0; column < grid.nx; ++column) {
                Body copy = grid.body;
                copy.position += {column * grid.spacing.x, row * grid.spacing.y};
                copy.name = numbered(grid.body.name, column, row);
                made.push_back(world.add(copy));
            }
    });
}

}  // namespace carom
