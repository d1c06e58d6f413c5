// Any sequence of calls on a world, with any numbers, does what it says or is an Error; afterwards the world is intact:
// every number of every body is finite, the ledger closes, what ends has begun, and a copy and a world that was
// restored go on with the same bits.

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

#include "fuzz/from_bytes.hpp"
#include "throughput.hpp"

namespace {

using namespace carom;
using namespace carom::fuzz;

void require(bool condition) {
    if (!condition) std::abort();
}

BodyId some_body(const World& world, Bytes& in) {
    const std::uint8_t n = in.byte();
    if (n == 255 || world.size() == 0) return {n, 1};
    return world.ids()[n % world.size()];
}

/// So many small ones that the contact solver takes them for a crowd.
constexpr std::size_t crowd = 56;
void add_crowd(World& world, Bytes& in) {
    const Vec2 velocity = in.vector();
    const double pitch = 0.2 + std::abs(in.number()) / 16, restitution = in.byte() / 255.0;
    for (std::size_t i = 0; i < crowd; ++i) {
        Body body{.position = {pitch * static_cast<double>(i % 8), pitch * static_cast<double>(i / 8)},
                  .velocity = i % 8 < 5 ? velocity : Vec2{},
                  .radius = 0.1,
                  .restitution = restitution,
                  .friction = 0.5};
        if (i % 3 == 0) body.radius = 0, body.shapes = {{.geometry = Box{0.2, 0.15}}};
        world.add(body);
    }
}

void add_body(World& world, Bytes& in) {
    if (world.size() % crowd > 12) return;
    const std::uint8_t kind = in.byte();
    world.add(Body{.kind = kind < 200   ? Kind::dynamic
                           : kind < 230 ? Kind::fixed
                                        : Kind::driven,
                   .position = in.vector(),
                   .angle = in.number(),
                   .velocity = in.vector(),
                   .angular_velocity = in.number(),
                   .mass = in.number(),
                   .radius = in.number(),
                   .shapes = shapes(in),
                   .charge = in.number(),
                   .restitution = in.number() / 8,
                   .friction = in.number()});
}

void add_force(World& world, Bytes& in) {
    switch (in.byte() % 8) {
        case 0:
            world.add(Spring{.a = some_body(world, in),
                             .b = some_body(world, in),
                             .anchor_a = in.vector(),
                             .stiffness = in.number(),
                             .rest_length = in.number(),
                             .damping = in.number()});
            return;
        case 1:
            world.add(TorsionSpring{.a = some_body(world, in),
                                    .b = some_body(world, in),
                                    .stiffness = in.number(),
                                    .damping = in.number()});
            return;
        case 2:
            world.add(Drag{.linear = in.number(), .quadratic = in.number(), .wind = in.vector()});
            return;
        case 3:
            world.add(Attraction{.strength = in.number(), .softening = in.number()});
            return;
        case 4:
            world.add(SoftDiscs{.stiffness = in.number(), .damping = in.number()});
            return;
        case 5:
            world.add(ForceField{
                .force = [k = in.number()](Vec2 x, Vec2 v, double m, double) { return -m * (k * x + 0.1 * v); }});
            return;
        case 6:
            world.add(UserForce{
                .add = [f = in.vector()](const Snapshot& now, std::span<Vec2> force, std::span<double> torque) {
                    for (std::size_t i = 0; i < force.size(); ++i) force[i] += now.mass[i] * f, torque[i] += f.x;
                }});
            return;
        default:
            world.add(ConstantForce{
                .body = some_body(world, in), .force = in.vector(), .point = in.vector(), .torque = in.number()});
    }
}

void change_force(World& world, Bytes& in) {
    const std::uint8_t kind = in.byte(), n = in.byte();
    const auto change = [&](auto all, auto make) {
        if (all.empty()) return;
        using Force = std::remove_cv_t<typename decltype(all)::element_type>;
        const ForceId<Force> id = world.force_id<Force>(n % all.size());
        if (kind & 128) {
            world.remove(id);
            return require(!world.contains(id));
        }
        Force changed = world.force(id);
        make(changed);
        world.set(id, changed);
    };
    switch (kind % 4) {
        case 0:
            return change(world.springs(), [&](Spring& s) { s.a = some_body(world, in), s.stiffness = in.number(); });
        case 1:
            return change(world.constant_forces(), [&](ConstantForce& f) { f.force = in.vector(); });
        case 2:
            return change(world.drags(), [&](Drag& d) { d.wind = in.vector(); });
        default:
            return change(world.attractions(), [&](Attraction& a) { a.strength = in.number(); });
    }
}

void change_body(World& world, Bytes& in) {
    const BodyId id = some_body(world, in);
    const std::uint8_t kind = in.byte();
    Body body = world.body(id);
    if (kind & 1) body.mass = in.number();
    if (kind & 2) body.moment_of_inertia.reset();
    if (kind & 4) body.shapes = shapes(in), body.radius = body.shapes.empty() ? in.number() : 0;
    if (kind & 8) body.position = in.vector(), body.velocity = in.vector();
    if (kind & 16) body.kind = Kind::dynamic;
    if (kind & 32) body.kind = Kind::driven;
    if (kind & 64) body.friction = in.number(), body.charge = in.number();
    world.set(id, body);
}

void push(World& world, Bytes& in) {
    const BodyId id = some_body(world, in);
    switch (in.byte() % 3) {
        case 0:
            return world.apply_impulse(id, in.vector(), in.vector());
        case 1:
            return world.apply_angular_impulse(id, in.number());
        default:
            return world.wake(id);
    }
}

Joint joint(const World& world, Bytes& in) {
    Joint made{.b = some_body(world, in), .type = joint_type(in)};
    const std::uint8_t kind = in.byte();
    if (kind & 3) made.a = some_body(world, in);
    if (kind & 4)
        made.at = in.vector();
    else
        made.anchor_a = in.vector(), made.anchor_b = in.vector();
    made.collide = (kind & 8) != 0;
    if ((kind & 48) == 48) made.break_force = 16 * in.number(), made.break_torque = perhaps(in);
    return made;
}

void change_joints(World& world, Bytes& in) {
    const std::uint8_t kind = in.byte();
    if (kind < 200 || world.joints().empty()) {
        if (world.joints().size() < 12) world.add(joint(world, in));
        return;
    }
    const JointId id = world.joint_ids()[kind % world.joints().size()];
    if (kind < 230) return world.remove(id);
    Joint changed = world.joint(id);
    changed.type = joint_type(in);
    world.set(id, changed);
}

void drive(World& world, Bytes& in) {
    const Vec2 from = in.vector(), swing = in.vector();
    const double turns = in.number(), start = world.time();
    world.drive(some_body(world, in), [=](double t) {
        const double s = t - start;
        return Pose{from + s / (1 + s * s) * swing, turns * s};
    });
}

/// What touches and what sensors see, by what steps said of it.
class Touching {
  public:
    void step(const StepEvents& events) {
        follow(touching_, events.begins, events.ends);
        follow(sensed_, events.sensor_begins, events.sensor_ends);
    }
    /// Walls behind some that are removed or put before them have other numbers from now on.
    void renumber_walls(std::size_t first, std::size_t removed, std::size_t added) {
        for (ShapePair& pair : touching_)
            if (pair.at_wall() && pair.a.shape >= first + removed)
                pair.a.shape = static_cast<std::uint32_t>(pair.a.shape - removed + added);
    }

  private:
    static void follow(std::vector<ShapePair>& now, const std::vector<ShapePair>& begins,
                       const std::vector<ShapePair>& ends) {
        for (const ShapePair& pair : ends) {
            const auto ended = std::find(now.begin(), now.end(), pair);
            require(ended != now.end());
            now.erase(ended);
        }
        for (const ShapePair& pair : begins) {
            require(std::find(now.begin(), now.end(), pair) == now.end());
            now.push_back(pair);
        }
    }
    std::vector<ShapePair> touching_, sensed_;
};

void add_room(World& world, Bytes& in, Touching& touching) {
    const std::size_t sides = 4 * world.rectangles().size();
    switch (in.byte() % 4) {
        case 0:
            world.add(Rectangle{.low = in.vector(), .high = in.vector()});
            return touching.renumber_walls(sides, 0, 4);
        case 1:
            world.add(HalfPlane{.point = in.vector(), .normal = in.vector()});
            return;
        case 2:
            world.add(Stadium{.a = in.vector(), .b = in.vector(), .radius = in.number()});
            return;
        default:
            return world.add(Periodic{.low = in.vector(), .high = in.vector()});
    }
}

void change_room(World& world, Bytes& in, Touching& touching) {
    const std::uint8_t kind = in.byte(), n = in.byte();
    const auto change = [&](auto all, auto make, std::size_t first, std::size_t sides) {
        if (all.empty()) return;
        using Walls = std::remove_cv_t<typename decltype(all)::element_type>;
        const std::size_t place = n % all.size();
        const WallId<Walls> id = world.wall_id<Walls>(place);
        if (kind & 128) {
            world.remove(id);
            require(!world.contains(id));
            return touching.renumber_walls(first + sides * place, sides, 0);
        }
        Walls changed = world.wall(id);
        make(changed);
        world.set(id, changed);
    };
    switch (kind % 3) {
        case 0:
            return change(
                world.rectangles(), [&](Rectangle& walls) { walls.high = in.vector(); }, 0, 4);
        case 1:
            return change(
                world.half_planes(), [&](HalfPlane& wall) { wall.point = in.vector(); }, 4 * world.rectangles().size(),
                1);
        default:
            return change(
                world.stadiums(), [&](Stadium& walls) { walls.radius = in.number(); },
                4 * world.rectangles().size() + world.half_planes().size(), 1);
    }
}

/// A method that chooses its own step may choose any number of them: for a torque of 1e14 N m, more than there is time
/// for. A step that is too long for its springs is cut into up to a million parts, whatever they cost.
bool is_bounded(const World& world, double dt, const Bytes& in) {
    constexpr double most_parts = 1000;
    const Integrator& method = world.settings().integrator;
    return !in.wild() || (!std::holds_alternative<Adaptive>(method) && !std::holds_alternative<Nystrom>(method) &&
                          dt <= most_parts * world.stable_step());
}

Sought sought(const World& world, Bytes& in) {
    const std::uint8_t kind = in.byte();
    Sought asked{.sensors = (kind & 1) != 0};
    if (kind & 2) asked.filter = Filter{kind >> 2 & 3, kind >> 4 & 3, kind >> 6};
    if (kind & 4) asked.except = some_body(world, in);
    asked.walls = (kind & 8) != 0;
    return asked;
}

void ask(const World& world, Bytes& in) {
    const Sought asked = sought(world, in);
    const Vec2 from = in.vector(), way = in.vector();
    const std::vector<Hit> through = world.cast_ray_through(from, way, asked);
    const auto makes_sense = [&](const Hit& hit) {
        return hit.fraction >= 0 && hit.fraction <= 1 && (hit.at_wall() ? asked.walls : world.contains(hit.body));
    };
    for (const Hit& hit : through) require(makes_sense(hit));
    const std::optional<Hit> first = world.cast_ray(from, way, asked);
    require(first.has_value() == !through.empty());
    if (first) require(first->body == through[0].body && first->fraction == through[0].fraction);
    const Vec2 point = in.vector();
    for (const ShapeId& shape : world.shapes_at(point, asked)) {
        const auto near = world.shapes_in_box(point, point, asked);
        require(std::find(near.begin(), near.end(), shape) != near.end());
    }
    const Geometry shape = geometry(in);
    const Pose at{in.vector(), in.number()};
    for (const ShapeId& touched : world.shapes_touching(shape, at, asked)) require(world.contains(touched.body));
    if (const auto hit = world.cast_shape(shape, at, in.vector(), asked)) require(makes_sense(*hit));
    world.closest_points(some_body(world, in), some_body(world, in), asked);
    for (const ContactPoint& contact : world.contacts()) require(contact.normal_force >= 0);
    for (const JointId id : world.joint_ids()) world.reaction(id);
    const BodyId one = some_body(world, in);
    require(world.contacts(one).size() <= world.contacts().size() && world.joints(one).size() <= world.joints().size());
    const Bounds box = world.bounds(one);
    require(box.low.x <= box.high.x && box.low.y <= box.high.y);
}

/// A copy that went elsewhere is put back where this world is, and takes its place.
void save_and_restore(World& world, Bytes& in) {
    std::string bytes;
    Saver to([&](std::string_view more) { bytes += more; });
    world.save(to);
    World other = world;
    try {
        const double dt = 0.01 + in.byte() / 4096.0;
        if (is_bounded(other, dt, in)) other.step(dt);
    } catch (const Error&) {
    }
    Loader from(bytes);
    other.restore(from);
    require(state_hash(other) == state_hash(world));
    std::string again;
    Saver second([&](std::string_view more) { again += more; });
    other.save(second);
    require(again == bytes);
    world = std::move(other);
}

/// Of what flowed through the ledger so much may be left without an account. Sums of numbers of any size leave any
/// rounding.
void require_closed(const World& world, const test::Throughput& through, const Bytes& in) {
    if (in.wild()) return;
    constexpr double rounding = 1e-10;
    const Momentum left = momentum_balance(world).unaccounted();
    require(std::abs(energy(world).unaccounted()) <= rounding * through.energy);
    require(length(left.linear) <= rounding * through.momentum);
    if (!world.periodic()) require(std::abs(left.angular) <= rounding * through.angular);
}

void step(World& world, Bytes& in, Touching& touching) {
    const double dt = std::abs(in.number()) / 64;
    if (!is_bounded(world, dt, in)) return;
    world.step(dt);
    touching.step(world.events());
}

void change(World& world, Bytes& in, Touching& touching) {
    switch (in.byte() % 4) {
        case 0:
            return change_body(world, in);
        case 1:
            return change_force(world, in);
        case 2:
            return change_room(world, in, touching);
        default:
            return push(world, in);
    }
}

void act(World& world, Bytes& in, Touching& touching) {
    const std::uint8_t kind = in.byte();
    if (kind >= 224) return change(world, in, touching);
    switch (kind % 16) {
        case 0:
        case 1:
            return add_body(world, in);
        case 2:
            return add_force(world, in);
        case 3:
            return add_room(world, in, touching);
        case 4:
            return world.remove(some_body(world, in));
        case 5:
            return world.set_velocity(some_body(world, in), in.vector(), in.number());
        case 6:
            return world.set_position(some_body(world, in), in.vector(), in.number());
        case 7:
            return ask(world, in);
        case 8:
        case 9:
            return change_joints(world, in);
        case 10:
            return drive(world, in);
        case 11:
            return world.configure(settings(in));
        case 12:
            return save_and_restore(world, in);
        default:
            return step(world, in, touching);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes in(data, size);
    World world;
    Touching touching;
    test::Throughput through(world);
    for (int actions = 0; in && actions < 60; ++actions) {
        try {
            if (actions == 0) world.configure(settings(in));
            if (actions == 0 && in.byte() % 4 == 0) add_crowd(world, in);
            act(world, in, touching);
        } catch (const Error& e) {
            if (e.cause() == Error::Cause::run) return 0;
        }
        for (std::size_t i = 0; i < world.size(); ++i) {
            const Vec2 x = world.positions()[i], v = world.velocities()[i];
            for (const double number : {x.x, x.y, v.x, v.y, world.angles()[i], world.angular_velocities()[i]})
                require(std::isfinite(number));
        }
        try {
            through.add(world);
            require_closed(world, through, in);
        } catch (const Error&) {  // of forces that the solver cannot do
        }
    }
    constexpr double dt = 0.01;
    try {
        if (!is_bounded(world, dt, in)) return 0;
        World copy = world;
        world.step(dt);
        copy.step(dt);
        require(state_hash(world) == state_hash(copy));
        require(world.events() == copy.events());
    } catch (const Error&) {
    }
    return 0;
}
