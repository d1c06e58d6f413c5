#pragma once
// Plane vectors. Plain doubles, no hidden normalisation, no fast-math: the same bits on every machine.

#include <cmath>

namespace carom {

struct Vec2 {
    double x = 0, y = 0;

    constexpr Vec2& operator+=(Vec2 b) { return x += b.x, y += b.y, *this; }
    constexpr Vec2& operator-=(Vec2 b) { return x -= b.x, y -= b.y, *this; }
    constexpr Vec2& operator*=(double s) { return x *= s, y *= s, *this; }
    constexpr bool operator==(const Vec2&) const = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
constexpr Vec2 operator*(Vec2 a, double s) { return {s * a.x, s * a.y}; }
constexpr Vec2 operator/(Vec2 a, double s) { return {a.x / s, a.y / s}; }

constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// The z component of a × b: positive when b lies counterclockwise of a.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// ω × r: the velocity at r of a body that turns with ω [rad/s] about the origin.
constexpr Vec2 cross(double w, Vec2 r) { return {-w * r.y, w * r.x}; }
/// a turned by +90°.
constexpr Vec2 perpendicular(Vec2 a) { return {-a.y, a.x}; }
constexpr double squared_length(Vec2 a) { return dot(a, a); }
inline double length(Vec2 a) { return std::sqrt(dot(a, a)); }  // sqrt is exact everywhere; hypot is not

}  // namespace carom
