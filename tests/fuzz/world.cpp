// Any sequence of calls on a world, with any numbers, does what it says or is an Error; afterwards the world is intact:
// every number of every body is finite, the ledger closes, what ends has begun, and a copy and a world that was
// restored go on with the same bits.

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

#include "throughput.hpp"

namespace {

using namespace carom;

/// The input, read as numbers; zeros at its end.
class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    explicit operator bool() const { return size_ > 0; }
    std::uint8_t byte() {
        std::uint8_t value = 0;
        take(&value, 1);
        return value;
    }
    /// Mostly of a size that bodies have, sometimes any bits at all.
    double number() {
        if (const std::uint8_t kind = byte(); kind < 240) return (kind - 120) / 16.0;
        double value = 0;
        take(&value, sizeof value);
        wild_ = true;
        return value;
    }
    /// Whether a number has been any bits at all.
    bool wild() const { return wild_; }
    Vec2 vector() {
        const double x = number();
        return {x, number()};
    }

  private:
    void take(void* to, std::size_t n) {
        n = std::min(n, size_);
        std::memcpy(to, data_, n);
        data_ += n, size_ -= n;
    }
    const std::uint8_t* data_;
    std::size_t size_;
    bool wild_ = false;
};

void require(bool condition) {
    if (!condition) std::abort();
}

BodyId some_body(const World& world, Bytes& in) {
    const std::uint8_t n = in.byte();
    if (n == 255 || world.size() == 0) return {n, 1};
    return world.ids()[n % world.size()];
}

Settings settings(Bytes& in) {
    static const Integrator methods[] = {Euler{}, SymplecticEuler{}, Verlet{},  Pefrl{},
                                         Rk4{},   RungeKutta{},      Adaptive{}};
    Settings s;
    s.gravity = in.vector();
    s.integrator = methods[in.byte() % std::size(methods)];
    const std::uint8_t kind = in.byte();
    switch (kind % 5) {
        case 0:
            s.solver = NoContact{};
            break;
        case 1:
            s.solver = Impulse{.time_of_impact = true};
            break;
        case 2:
            s.solver = Impulse{.time_of_impact = false};
            break;
        default:
            s.solver = SoftStep{.substeps = 1 + kind % 4, .precise = kind % 2 == 0};
    }
    s.threads = kind & 16 ? 2 : 1;
    s.long_step = kind & 8 ? LongStep::refuse : LongStep::substep;
    return s;
}

std::vector<Vec2> points(Bytes& in) {
    std::vector<Vec2> all(in.byte() % 10);
    for (Vec2& point : all) point = in.vector();
    return all;
}

Geometry geometry(Bytes& in) {
    switch (in.byte() % 7) {
        case 0:
            return Disc{in.vector(), in.number()};
        case 1:
            return Capsule{in.vector(), in.vector(), in.number()};
        case 2:
            return Box{in.number(), in.number(), in.vector(), in.number(), in.number() / 8};
        case 3:
            return Polygon{points(in), in.number() / 8};
        case 4:
            return Hull{points(in), in.number() / 8};
        case 5:
            return Segment{in.vector(), in.vector()};
        default:
            return Chain{points(in), in.byte() % 2 == 0};
    }
}

std::vector<Shape> shapes(Bytes& in) {
    std::vector<Shape> all(in.byte() % 4);
    for (Shape& shape : all) {
        shape.geometry = geometry(in);
        const std::uint8_t kind = in.byte();
        if (kind & 1) shape.density = in.number();
        if (kind & 2) shape.rolling_resistance = in.number(), shape.surface_speed = in.number();
        shape.sensor = (kind & 28) == 28;
        if (kind & 32) shape.filter = {in.byte() % 4, in.byte() % 4, in.byte() % 5 - 2};
        if (kind & 64) shape.restitution = in.byte() / 255.0, shape.friction = in.byte() / 64.0;
    }
    return all;
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
            return world.add(Spring{.a = some_body(world, in),
                                    .b = some_body(world, in),
                                    .anchor_a = in.vector(),
                                    .stiffness = in.number(),
                                    .rest_length = in.number(),
                                    .damping = in.number()});
        case 1:
            return world.add(TorsionSpring{.a = some_body(world, in),
                                           .b = some_body(world, in),
                                           .stiffness = in.number(),
                                           .damping = in.number()});
        case 2:
            return world.add(Drag{.linear = in.number(), .quadratic = in.number(), .wind = in.vector()});
        case 3:
            return world.add(Attraction{.strength = in.number(), .softening = in.number()});
        case 4:
            return world.add(SoftDiscs{.stiffness = in.number(), .damping = in.number()});
        case 5:
            return world.add(ForceField{
                .force = [k = in.number()](Vec2 x, Vec2 v, double m, double) { return -m * (k * x + 0.1 * v); }});
        case 6:
            return world.add(UserForce{
                .add = [f = in.vector()](const Snapshot& now, std::span<Vec2> force, std::span<double> torque) {
                    for (std::size_t i = 0; i < force.size(); ++i) force[i] += now.mass[i] * f, torque[i] += f.x;
                }});
        default:
            return world.add(ConstantForce{
                .body = some_body(world, in), .force = in.vector(), .point = in.vector(), .torque = in.number()});
    }
}

std::optional<double> perhaps(Bytes& in) {
    if (in.byte() % 2 == 0) return std::nullopt;
    return in.number();
}
std::optional<JointSpring> spring(Bytes& in) {
    const std::uint8_t kind = in.byte();
    if (kind % 3 == 0) return std::nullopt;
    if (kind % 3 == 1) return JointSpring{.stiffness = 4 * in.number(), .damping = in.number()};
    return JointSpring{.frequency = in.number(), .damping_ratio = in.number()};
}
std::optional<JointMotor> motor(Bytes& in) {
    if (in.byte() % 2 == 0) return std::nullopt;
    return JointMotor{in.number(), perhaps(in)};
}
JointLimits limits(Bytes& in) { return {perhaps(in), perhaps(in)}; }

JointType joint_type(Bytes& in) {
    switch (in.byte() % 11) {
        case 0:
            return DistanceJoint{perhaps(in), spring(in), limits(in)};
        case 1:
            return RevoluteJoint{perhaps(in), spring(in), motor(in), limits(in)};
        case 2:
            return PrismaticJoint{in.vector(), perhaps(in), spring(in), motor(in), limits(in)};
        case 3:
            return WeldJoint{perhaps(in), spring(in)};
        case 4:
            return WheelJoint{in.vector(), spring(in), motor(in), limits(in)};
        case 5:
            return MotorJoint{in.vector(), in.number(), perhaps(in), perhaps(in)};
        case 6:
            return GearJoint{.ratio = in.number(), .sum = perhaps(in)};
        case 7:
            return PulleyJoint{in.vector(), in.vector(), in.number(), perhaps(in)};
        case 8:
            return FrictionJoint{in.number(), in.number()};
        case 9:
            return DragHandle{spring(in), perhaps(in)};
        default:
            return FilterJoint{};
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

void add_room(World& world, Bytes& in) {
    switch (in.byte() % 4) {
        case 0:
            return world.add(Rectangle{.low = in.vector(), .high = in.vector()});
        case 1:
            return world.add(HalfPlane{.point = in.vector(), .normal = in.vector()});
        case 2:
            return world.add(Stadium{.a = in.vector(), .b = in.vector(), .radius = in.number()});
        default:
            return world.add(Periodic{.low = in.vector(), .high = in.vector()});
    }
}

/// A method that chooses its own step may choose any number of them: for a torque of 1e14 N m, more than there is time
/// for. A step that is too long for its springs is cut into up to a million parts, whatever they cost.
bool is_bounded(const World& world, double dt, const Bytes& in) {
    constexpr double most_parts = 1000;
    return !in.wild() ||
           (!std::holds_alternative<Adaptive>(world.settings().integrator) && dt <= most_parts * world.stable_step());
}

Sought sought(const World& world, Bytes& in) {
    const std::uint8_t kind = in.byte();
    Sought asked{.sensors = (kind & 1) != 0};
    if (kind & 2) asked.filter = Filter{kind >> 2 & 3, kind >> 4 & 3, kind >> 6};
    if (kind & 4) asked.except = some_body(world, in);
    return asked;
}

void ask(const World& world, Bytes& in) {
    const Sought asked = sought(world, in);
    const Vec2 from = in.vector(), way = in.vector();
    const std::vector<Hit> through = world.cast_ray_through(from, way, asked);
    for (const Hit& hit : through) require(hit.fraction >= 0 && hit.fraction <= 1 && world.contains(hit.body));
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
    if (const auto hit = world.cast_shape(shape, at, in.vector(), asked))
        require(hit->fraction >= 0 && hit->fraction <= 1 && world.contains(hit->body));
    world.closest_points(some_body(world, in), some_body(world, in), asked);
    for (const ContactPoint& contact : world.contacts()) require(contact.normal_force >= 0);
    for (const JointId id : world.joint_ids()) world.reaction(id);
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

/// What touches and what sensors see, by what steps said of it.
class Touching {
  public:
    void step(const StepEvents& events) {
        follow(touching_, events.begins, events.ends);
        follow(sensed_, events.sensor_begins, events.sensor_ends);
    }

  private:
    static void follow(std::vector<ShapePair>& now, const std::vector<ShapePair>& begins,
                       const std::vector<ShapePair>& ends) {
        for (const ShapePair& pair : ends) require(std::erase(now, pair) == 1);
        for (const ShapePair& pair : begins) {
            require(std::find(now.begin(), now.end(), pair) == now.end());
            now.push_back(pair);
        }
    }
    std::vector<ShapePair> touching_, sensed_;
};

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

void act(World& world, Bytes& in, Touching& touching) {
    switch (in.byte() % 16) {
        case 0:
        case 1:
            return add_body(world, in);
        case 2:
            return add_force(world, in);
        case 3:
            return add_room(world, in);
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
