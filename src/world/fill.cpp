// Discs at random places.

#include <algorithm>
#include <carom/random.hpp>
#include <numeric>

#include "collision/grid.hpp"
#include "collision/queries.hpp"
#include "solvers/events/obstacles.hpp"
#include "state/validate.hpp"
#include "world/building.hpp"

namespace carom {

namespace {

constexpr double pi = 3.14159265358979323846;

double area(double radius) { return pi * radius * radius; }

/// Checks that a range of radii, a rectangle and what is made a disc make sense.
template <class T>
void check_ranges(const T& t, const std::string& where) {
    if (!t.body.shapes.empty()) throw Error(fmt::format("{}.body.shapes must be none: these are discs", where));
    if (t.largest_radius < t.smallest_radius)
        throw Error(fmt::format("{}.largest_radius must be at least smallest_radius, {} m, got {} m", where,
                                t.smallest_radius, t.largest_radius));
    if (!(t.low.x < t.high.x && t.low.y < t.high.y))
        throw Error(fmt::format("{}.high must lie above and right of low ({}, {}) [m], got ({}, {})", where, t.low.x,
                                t.low.y, t.high.x, t.high.y));
}

/// As many radii as were asked for, or as cover the fraction.
std::vector<double> draw_radii(const Fill& fill, const std::string& where, Random& random) {
    std::vector<double> radii;
    const auto draw = [&] { return random.uniform(fill.smallest_radius, fill.largest_radius); };
    if (fill.count) {
        for (int i = 0; i < *fill.count; ++i) radii.push_back(draw());
        return radii;
    }
    const Vec2 size = fill.high - fill.low;
    const double r1 = fill.smallest_radius, r2 = fill.largest_radius;
    const double wanted = *fill.fraction * size.x * size.y, mean_area = pi * (r1 * r1 + r1 * r2 + r2 * r2) / 3;
    if (wanted / mean_area > most_built)
        throw Error(fmt::format("{}.fraction must need at most {} discs of such radii, and {} needs {:.3g}", where,
                                most_built, *fill.fraction, wanted / mean_area));
    double covered = 0;
    for (double r = draw(); covered + 0.5 * area(r) <= wanted; r = draw()) {
        radii.push_back(r);
        covered += area(r);
    }
    if (radii.empty())
        throw Error(fmt::format("{}.fraction must be worth a disc at least, and {} is not", where, *fill.fraction));
    return radii;
}

/// What discs may overlap beside one another: walls, and shapes that are no sensors.
class Solids {
  public:
    explicit Solids(const World& world)
        : box_(world.periodic()),
          walls_(obstacles_of({world.rectangles(), world.half_planes(), world.stadiums(), {}}, {}, {}, {})) {
        std::vector<Vec2> centre;
        std::vector<double> radius;
        for (std::size_t i = 0; i < world.size(); ++i)
            for (const Shape& shape : world.shapes()[i]) {
                if (shape.sensor) continue;
                const Frame at = frame_at(world.positions()[i], world.angles()[i]);
                for (const Convex& outline : pieces_of(shape.geometry)) {
                    const Aabb around = bounds(outline, at);
                    centre.push_back(0.5 * (around.low + around.high));
                    radius.push_back(0.5 * length(around.high - around.low));
                    pieces_.push_back({outline, at, centre.back()});
                }
            }
        grid_.build(centre, radius, box_);
    }

    bool are_met_by(Vec2 centre, double radius) {
        for (const GasObstacle& wall : walls_) {
            const Vec2 x = centre - wall.a;
            if (gap_to(wall, {x, {}, {}, radius}) < -1e-12 * (radius + length(x))) return true;  // beyond rounding
        }
        near_.clear();
        grid_.near(centre, radius, near_);
        Convex disc;
        disc.radius = radius;
        return std::any_of(near_.begin(), near_.end(), [&](std::uint32_t k) {
            const SolidPiece& piece = pieces_[k];
            const Vec2 image = piece.middle - nearest_image(box_, piece.middle - centre);
            return closest_points(piece.outline, piece.at, disc, Frame{image}).distance < 0;
        });
    }

  private:
    struct SolidPiece {
        Convex outline;
        Frame at;
        Vec2 middle;
    };
    std::optional<Periodic> box_;
    std::vector<GasObstacle> walls_;
    std::vector<SolidPiece> pieces_;
    Grid grid_;  ///< of discs around the pieces
    std::vector<std::uint32_t> near_;
};

/// Random sequential addition to what a world has already.
class Packing {
  public:
    Packing(const World& world, const Fill& fill, const std::vector<double>& radii)
        : low_(fill.low), high_(fill.high), box_(world.periodic()), solids_(world) {
        for (std::size_t i = 0; i < world.size(); ++i)
            if (world.shapes()[i].empty()) centre_.push_back(world.positions()[i]), radius_.push_back(world.radii()[i]);
        wraps_ = box_ && box_->low == low_ && box_->high == high_;
        std::vector<double> all = radius_;
        all.insert(all.end(), radii.begin(), radii.end());
        grid_.prepare(all, box_);
        for (std::uint32_t i = 0; i < centre_.size(); ++i) grid_.put(i, centre_[i], radius_[i]);
    }

    /// One try; the disc stays where it fits.
    std::optional<Vec2> place(double radius, Random& random) {
        const double margin = wraps_ ? 0 : radius;
        const double x = random.uniform(low_.x + margin, high_.x - margin);
        const Vec2 centre{x, random.uniform(low_.y + margin, high_.y - margin)};
        near_.clear();
        grid_.near(centre, radius, near_);
        for (const std::uint32_t i : near_)
            if (length(nearest_image(box_, centre_[i] - centre)) < radius + radius_[i]) return {};
        if (solids_.are_met_by(centre, radius)) return {};
        grid_.put(static_cast<std::uint32_t>(centre_.size()), centre, radius);
        centre_.push_back(centre);
        radius_.push_back(radius);
        return centre;
    }

  private:
    Vec2 low_, high_;
    std::optional<Periodic> box_;
    bool wraps_ = false;
    Solids solids_;
    Grid grid_;
    std::vector<Vec2> centre_;
    std::vector<double> radius_;
    std::vector<std::uint32_t> near_;
};

/// Centres for discs of these radii, the largest placed first: small ones then find room between.
std::vector<Vec2> place_all(const World& world, const Fill& fill, const std::string& where,
                            const std::vector<double>& radii, Random& random) {
    std::vector<std::size_t> order(radii.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return radii[i] > radii[j]; });

    // Enough for equal discs at a fraction of 0.51; infinitely many tries would end at 0.547.
    const double most_tries = 1e6 + 100.0 * static_cast<double>(radii.size());
    Packing packing(world, fill, radii);
    std::vector<Vec2> centres(radii.size());
    double tries = 0, covered = 0;
    for (std::size_t n = 0; n < order.size(); ++n) {
        std::optional<Vec2> centre;
        while (!centre && tries++ < most_tries) centre = packing.place(radii[order[n]], random);
        if (!centre) {
            const Vec2 size = fill.high - fill.low;
            throw Error(fmt::format(
                "{}.{} must leave room for random places: {} of {} discs, a fraction of {:.3f}, found one in {:.0f} "
                "tries",
                where, fill.count ? "count" : "fraction", n, radii.size(), covered / (size.x * size.y), tries - 1));
        }
        centres[order[n]] = *centre;
        covered += area(radii[order[n]]);
    }
    return centres;
}

void check(const Fill& fill, const std::string& where) {
    check_ranges(fill, where);
    if (fill.fraction.has_value() == fill.count.has_value())
        throw Error(fmt::format("{} must have either a fraction or a count, and has {}", where,
                                fill.count ? "both" : "neither"));
    const Vec2 size = fill.high - fill.low;
    const double widest = 0.5 * std::min(size.x, size.y);
    if (fill.largest_radius > widest)
        throw Error(fmt::format("{}.largest_radius must fit into the rectangle, at most {} m, got {} m", where, widest,
                                fill.largest_radius));
    const double least = fill.count.value_or(0) * area(fill.smallest_radius) / (size.x * size.y);
    if (least > 1)
        throw Error(fmt::format("{}.count must leave room: {} discs would cover {:.3g} times the rectangle", where,
                                *fill.count, least));
}

/// The discs, not yet in the world.
std::vector<Body> discs(const World& world, const Fill& fill, const std::string& where, Random& random) {
    check(fill, where);
    const std::vector<double> radii = draw_radii(fill, where, random);
    const std::vector<Vec2> centres = place_all(world, fill, where, radii, random);
    std::vector<Body> out(radii.size(), fill.body);
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].position = centres[i];
        out[i].radius = radii[i];
        if (fill.density) out[i].mass = *fill.density * area(radii[i]);
        out[i].name = numbered(fill.body.name, i);
    }
    return out;
}

Built add_all(World& world, const std::vector<Body>& bodies) {
    return all_or_nothing(world, [&](std::vector<BodyId>& made) {
        for (const Body& body : bodies) made.push_back(world.add(body));
    });
}

/// Maxwell's velocities, as seen in the wind.
std::vector<Vec2> thermal_velocities(const std::vector<Body>& discs, double temperature, Random& random) {
    std::vector<Vec2> v;
    for (const Body& disc : discs) {
        const double x = random.normal();
        v.push_back(std::sqrt(temperature / disc.mass) * Vec2{x, random.normal()});
    }
    return v;
}

/// Shifts to zero momentum and scales to a kinetic energy.
void make_exact(const std::vector<Body>& discs, double energy, std::vector<Vec2>& v) {
    double mass = 0, drawn = 0;
    Vec2 momentum{};
    for (std::size_t i = 0; i < v.size(); ++i) mass += discs[i].mass, momentum += discs[i].mass * v[i];
    for (std::size_t i = 0; i < v.size(); ++i) {
        v[i] -= momentum / mass;
        drawn += 0.5 * discs[i].mass * squared_length(v[i]);
    }
    const double scale = drawn > 0 ? std::sqrt(energy / drawn) : 0;
    for (Vec2& each : v) each *= scale;
}

}  // namespace

Built build(World& world, const Fill& fill) {
    validate(fill, "Fill");
    Random random(static_cast<std::uint64_t>(fill.seed));
    return add_all(world, discs(world, fill, "Fill", random));
}

Built build(World& world, const Gas& gas) {
    validate(gas, "Gas");
    if (gas.fill.body.kind != Kind::dynamic)
        throw Error("Gas.fill.body.kind must be dynamic: heat does not move others");
    Random random(static_cast<std::uint64_t>(gas.fill.seed));
    std::vector<Body> bodies = discs(world, gas.fill, "Gas.fill", random);
    std::vector<Vec2> v = thermal_velocities(bodies, gas.temperature, random);
    if (gas.exact) {
        if (bodies.size() < 2) throw Error("Gas.exact must be false for a single disc: at rest it has no temperature");
        const auto moving = static_cast<double>(bodies.size()) - (world.periodic() ? 1 : 0);
        make_exact(bodies, moving * gas.temperature, v);
    }
    for (std::size_t i = 0; i < v.size(); ++i) bodies[i].velocity += v[i];
    return add_all(world, bodies);
}

Built build(World& world, const NotebookGas& gas) {
    validate(gas, "NotebookGas");
    check_ranges(gas, "NotebookGas");
    NumpyRandom random(static_cast<std::uint32_t>(gas.seed));
    std::vector<Body> bodies(static_cast<std::size_t>(gas.count), gas.body);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        Body& disc = bodies[i];
        disc.position.x = random.uniform(gas.low.x, gas.high.x);
        disc.position.y = random.uniform(gas.low.y, gas.high.y);
        disc.velocity.x = gas.speed * random.normal();
        disc.velocity.y = gas.speed * random.normal();
        disc.radius = random.uniform(gas.smallest_radius, gas.largest_radius);
        disc.name = numbered(gas.body.name, i);
    }
    return add_all(world, bodies);
}

}  // namespace carom
