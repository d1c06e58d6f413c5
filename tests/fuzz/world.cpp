// Any sequence of calls on a world, with any numbers, does what it says or is an Error; afterwards the world is intact:
// every number of every body is finite, and a copy goes on with the same bits.

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <cstdlib>
#include <cstring>

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
        shape.sensor = (kind & 60) == 60;
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
    switch (in.byte() % 5) {
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
        default:
            return world.add(ConstantForce{.body = some_body(world, in), .force = in.vector(), .point = in.vector()});
    }
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
/// for.
bool is_bounded(const World& world, const Bytes& in) {
    return !in.wild() || !std::holds_alternative<Adaptive>(world.settings().integrator);
}

void ask(const World& world, Bytes& in) {
    for (const Hit& hit : world.cast_ray_through(in.vector(), in.vector()))
        require(hit.fraction >= 0 && hit.fraction <= 1);
    world.shapes_at(in.vector());
    world.cast_shape(geometry(in), {in.vector(), in.number()}, in.vector());
    world.closest_points(some_body(world, in), some_body(world, in));
}

void act(World& world, Bytes& in) {
    switch (in.byte() % 9) {
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
        default:
            const double step = std::abs(in.number()) / 64;
            if (is_bounded(world, in)) world.step(step);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes in(data, size);
    World world;
    for (int actions = 0; in && actions < 60; ++actions) {
        try {
            if (actions == 0) world.configure(settings(in));
            if (actions == 0 && in.byte() % 4 == 0) add_crowd(world, in);
            act(world, in);
        } catch (const Error& e) {
            if (e.cause() == Error::Cause::run) return 0;
        }
        for (std::size_t i = 0; i < world.size(); ++i) {
            const Vec2 x = world.positions()[i], v = world.velocities()[i];
            for (const double number : {x.x, x.y, v.x, v.y, world.angles()[i], world.angular_velocities()[i]})
                require(std::isfinite(number));
        }
    }
    if (!is_bounded(world, in)) return 0;
    World copy = world;
    try {
        world.step(0.01);
        copy.step(0.01);
        require(state_hash(world) == state_hash(copy));
    } catch (const Error&) {
    }
    return 0;
}
