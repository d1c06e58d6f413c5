// Discs that overlap at the start are moved apart, in the way of Clarke and Wiley (Phys. Rev. B 35, 7350 (1987)): what
// overlaps is pushed along the line of the centres, again and again, until nothing does.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collision/grid.hpp"
#include "math/elementary.hpp"
#include "solvers/events/gas.hpp"
#include "solvers/impact.hpp"

namespace carom {

namespace {

constexpr int most_rounds = 5000;
/// How far beyond touching pairs are pushed, as a part of it: towards mere touching the rounds would never end.
constexpr double slack = 1e-3;
/// How far to the side of their line pairs are pushed: discs in a row that is too short for them would stay in it.
constexpr double aside = 1e-3;

class Relaxation {
  public:
    Relaxation(const GasScene& scene, State& state)
        : scene_(scene),
          state_(state),
          obstacles_(obstacles_of(scene.walls, scene.bodies, state, scene.pieces)),
          solids_(solids_of(scene.bodies, state, scene.pieces)),
          start_(state.x.linear) {
        MovingDiscs discs = moving_discs(scene.bodies, state);
        grid_.build(discs.centre, discs.radius, scene.walls.periodic);
        rows_ = std::move(discs.row), radius_ = std::move(discs.radius);
    }

    /// One after another, in the order of rows: first into the room, then off the others. How deep the deepest was.
    double round() {
        deepest_ = 0;
        for (std::uint32_t i = 0; i < rows_.size(); ++i) {
            push_out(i);
            for (const GasObstacle& o : obstacles_) push_off(i, o);
            near_.clear();
            grid_.near(place(i), radius_[i], near_);
            std::sort(near_.begin(), near_.end());
            for (const std::uint32_t j : near_)
                if (j != i) push_apart(i, j);
        }
        return deepest_;
    }

    double farthest() const {
        double squared = 0;
        for (const std::size_t row : rows_)
            squared = std::max(squared, squared_length(state_.x.linear[row] - start_[row]));
        return std::sqrt(squared);
    }

  private:
    Vec2 place(std::uint32_t i) const { return state_.x.linear[rows_[i]]; }
    /// Where centres lie upon one another each disc has a way of its own out: turned by the golden angle from the last.
    static Vec2 some_way(std::uint32_t i) {
        constexpr double golden_angle = 0x1.3331febfa4bfbp1;
        const auto [sin, cos] = portable::sincos(golden_angle * i);
        return {cos, sin};
    }
    void move(std::uint32_t i, Vec2 by) {
        shift(rows_[i], by, scene_.bodies, scene_.gravity, state_);
        grid_.move(i, place(i), radius_[i]);
    }

    /// Out of what is solid: its lines alone would have who is beyond one of them inside. On the shortest way that does
    /// not lead into another solid, as over the seam of two, if there is one.
    void push_out(std::uint32_t i) {
        struct Way {
            Vec2 by{};
            double depth = HUGE_VAL;
        } shortest, shortest_free;
        double deepest = 0;
        for (const GasSolid& solid : solids_) {
            const Vec2 seen = solid.seen(scene_.walls.periodic, place(i));
            const Convex& outline = solid.piece->outline;
            const double depth = solid.depth(seen, radius_[i]), r = radius_[i] + outline.radius;
            if (depth <= solid.rounding(place(i))) continue;
            deepest = std::max(deepest, depth);
            for (int face = 0; face < outline.count; ++face) {
                const double out = r - solid.beyond(face, seen), more = slack * (r > 0 ? r : solid.extent);
                const Way way{(out + more) * solid.turned.turn(outline.normal[face]), out};
                if (out < shortest.depth) shortest = way;
                if (out < shortest_free.depth && is_free(place(i) + way.by)) shortest_free = way;
            }
        }
        if (deepest == 0) return;
        deepest_ = std::max(deepest_, deepest);
        move(i, shortest_free.depth < HUGE_VAL ? shortest_free.by : shortest.by);
    }
    bool is_free(Vec2 place) const {
        return std::none_of(solids_.begin(), solids_.end(), [&](const GasSolid& solid) {
            return solid.depth(solid.seen(scene_.walls.periodic, place), 0) > 0;
        });
    }
    void push_off(std::uint32_t i, const GasObstacle& o) {
        const Vec2 x = nearest_image(scene_.walls.periodic, place(i) - o.a);
        const GasFlight still{x, -some_way(i), {}, radius_[i]};
        const double depth = -gap_to(o, still), rounding = 1e-12 * length(x);
        if (depth <= rounding) return;
        deepest_ = std::max(deepest_, depth);
        move(i, (depth + slack * (radius_[i] + o.radius)) * normal_at(o, still));
    }

    void push_apart(std::uint32_t i, std::uint32_t j) {
        const Vec2 d = nearest_image(scene_.walls.periodic, place(j) - place(i));
        const double reach = radius_[i] + radius_[j], distance = length(d);
        if (distance >= reach) return;
        deepest_ = std::max(deepest_, reach - distance);
        const Vec2 way = distance > 1e-9 * reach ? d / distance + aside * some_way(i) : some_way(i);
        const double half = 0.5 * ((1 + slack) * reach - distance);
        move(i, -half * way);
        move(j, half * way);
    }

    const GasScene& scene_;
    State& state_;
    const std::vector<GasObstacle> obstacles_;
    const std::vector<GasSolid> solids_;
    const std::vector<Vec2> start_;
    std::vector<std::size_t> rows_;
    std::vector<double> radius_;
    Grid grid_;
    std::vector<std::uint32_t> near_;
    double deepest_ = 0;
};

}  // namespace

double relax_gas(const GasScene& scene, State& state) {
    Relaxation relaxation(scene, state);
    double deepest = 0;
    for (int k = 0; k < most_rounds; ++k)
        if (deepest = relaxation.round(); deepest == 0) return relaxation.farthest();
    const std::string filled =
        packing_fraction(scene) > 0 ? fmt::format("they fill {:.4g} of the room", packing_fraction(scene)) : "";
    throw Error(fmt::format(
        "the solver 'events' could not relax the discs: after {} rounds of moving them apart the deepest "
        "overlap is still {:.3g} m{}{}. Equal discs jam in disorder at 0.84 or so and fill 0.9069, π/(2√3), "
        "at most: take fewer or smaller ones, or start from a lattice",
        most_rounds, deepest, filled.empty() ? "" : ", and ", filled));
}

}  // namespace carom
