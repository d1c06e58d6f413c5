#pragma once
// Numbers, settings, shapes and joints from a fuzzer's bytes.

#include <algorithm>
#include <carom/carom.hpp>
#include <cstring>

namespace carom::fuzz {

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

inline Settings settings(Bytes& in) {
    static const Integrator methods[] = {Euler{}, SymplecticEuler{}, Verlet{},   Pefrl{},
                                         Rk4{},   RungeKutta{},      Adaptive{}, Nystrom{}};
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
            s.solver = SoftStep{.substeps = 1 + kind % 4, .precise = static_cast<Precise>(kind % 3)};
    }
    s.threads = kind & 16 ? 2 : 1;
    s.long_step = kind & 8 ? LongStep::refuse : LongStep::substep;
    return s;
}

inline std::vector<Vec2> points(Bytes& in) {
    std::vector<Vec2> all(in.byte() % 10);
    for (Vec2& point : all) point = in.vector();
    return all;
}

inline Geometry geometry(Bytes& in) {
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

inline std::vector<Shape> shapes(Bytes& in) {
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

inline std::optional<double> perhaps(Bytes& in) {
    if (in.byte() % 2 == 0) return std::nullopt;
    return in.number();
}
inline std::optional<JointSpring> spring(Bytes& in) {
    const std::uint8_t kind = in.byte();
    if (kind % 3 == 0) return std::nullopt;
    if (kind % 3 == 1) return JointSpring{.stiffness = 4 * in.number(), .damping = in.number()};
    return JointSpring{.frequency = in.number(), .damping_ratio = in.number()};
}
inline std::optional<JointMotor> motor(Bytes& in) {
    if (in.byte() % 2 == 0) return std::nullopt;
    return JointMotor{in.number(), perhaps(in)};
}
inline JointLimits limits(Bytes& in) { return {perhaps(in), perhaps(in)}; }

inline JointType joint_type(Bytes& in) {
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

}  // namespace carom::fuzz
