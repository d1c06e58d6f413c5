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
    s.solver = kind % 3 == 0 ? Solver{NoContact{}} : Solver{Impulse{.time_of_impact = kind % 3 == 1}};
    s.long_step = kind & 8 ? LongStep::refuse : LongStep::substep;
    return s;
}

void add_body(World& world, Bytes& in) {
    if (world.size() > 12) return;
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
        default:
            return world.add(ConstantForce{.body = some_body(world, in), .force = in.vector(), .point = in.vector()});
    }
}

void add_room(World& world, Bytes& in) {
    switch (in.byte() % 3) {
        case 0:
            return world.add(Rectangle{.low = in.vector(), .high = in.vector()});
        case 1:
            return world.add(HalfPlane{.point = in.vector(), .normal = in.vector()});
        default:
            return world.add(Periodic{.low = in.vector(), .high = in.vector()});
    }
}

/// A method that chooses its own step may choose any number of them: for a torque of 1e14 N m, more than there is time
/// for.
bool is_bounded(const World& world, const Bytes& in) {
    return !in.wild() || !std::holds_alternative<Adaptive>(world.settings().integrator);
}

void act(World& world, Bytes& in) {
    switch (in.byte() % 8) {
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
        default:
            const double step = std::abs(in.number()) / 64;
            if (is_bounded(world, in)) world.step(step);
    }
}

void require(bool condition) {
    if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes in(data, size);
    World world;
    for (int actions = 0; in && actions < 60; ++actions) {
        try {
            if (actions == 0) world.configure(settings(in));
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
