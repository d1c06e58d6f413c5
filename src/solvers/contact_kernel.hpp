#pragma once
// The text of the kernels in solvers/contact_rows.hpp, compiled once for each instruction set.

#include "simd/lanes.hpp"
#include "solvers/contact_rows.hpp"

namespace carom {
namespace {

struct Moving {
    Lanes2 at, direction, v;  ///< direction: cosine and sine of the angle
    Lanes w;
};

/// The movers in these rows, which are four pairs of numbers each.
inline Moving gather(const Mover* movers, const uint32_t* rows) {
    static_assert(sizeof(Mover) == 4 * sizeof(Pair));
    const auto pair = [&](size_t k) {
        return pairs(&movers->x, [=](int lane) { return 4 * static_cast<size_t>(rows[lane]) + k; });
    };
    return {pair(0), pair(1), pair(2), pair(3).x};
}
/// Bodies that nothing moves may be in several rows at once, and are left alone.
inline void scatter(const Moving& in, Mover* movers, const uint32_t* rows) {
    for (int lane = 0; lane < lanes; ++lane) {
        Mover& m = movers[rows[lane]];
        if (m.inverse_mass == 0) continue;
        m.vx = in.v.x[lane], m.vy = in.v.y[lane], m.w = in.w[lane];
    }
}

inline Lanes2 turned(Lanes x, Lanes y, Lanes2 direction) {
    return {direction.x * x - direction.y * y, direction.y * x + direction.x * y};
}

/// The first few of an array.
template <class T>
struct Some {
    T *first, *last;
    T* begin() const { return first; }
    T* end() const { return last; }
};
template <class T>
inline Some<T> some(T* from, size_t count) {
    return {from, from + count};
}

/// As many rows of a block as there are lanes, with their two bodies.
template <class Block>
struct Rows {
    Block& block;
    size_t row;
    Lanes2 n;
    Lanes ima, imb, iia, iib;
    Moving a, b;

    Rows(Block& from, size_t first, const Mover* movers)
        : block(from),
          row(first),
          n{at(from.normal_x), at(from.normal_y)},
          ima(at(from.inverse_mass_a)),
          imb(at(from.inverse_mass_b)),
          iia(at(from.inverse_inertia_a)),
          iib(at(from.inverse_inertia_b)),
          a(gather(movers, from.a + first)),
          b(gather(movers, from.b + first)) {}

    Lanes at(const double* numbers) const { return load(numbers + row); }
    void put(double* numbers, Lanes value) const { __builtin_memcpy(numbers + row, &value, sizeof value); }

    /// Velocity of b's contact point as a's sees it.
    template <class Point>
    Lanes2 velocity(const Point& p) const {
        return {b.v.x - b.w * at(p.lever_b_y) - a.v.x + a.w * at(p.lever_a_y),
                b.v.y + b.w * at(p.lever_b_x) - a.v.y - a.w * at(p.lever_a_x)};
    }
    template <class Point>
    void apply(const Point& p, Lanes2 impulse) {
        a.v.x -= ima * impulse.x;
        a.v.y -= ima * impulse.y;
        a.w -= iia * (at(p.lever_a_x) * impulse.y - at(p.lever_a_y) * impulse.x);
        b.v.x += imb * impulse.x;
        b.v.y += imb * impulse.y;
        b.w += iib * (at(p.lever_b_x) * impulse.y - at(p.lever_b_y) * impulse.x);
    }
    auto points() const { return some(block.point, block.points); }
    void turn(Lanes angular_impulse) {
        a.w -= iia * angular_impulse;
        b.w += iib * angular_impulse;
    }
    Lanes along_normal(Lanes2 v) const { return v.x * n.x + v.y * n.y; }
    /// The tangent is the normal turned by +90°.
    Lanes along_tangent(Lanes2 v) const { return v.y * n.x - v.x * n.y; }
    Lanes2 impulse(Lanes normal, Lanes tangent) const {
        return {normal * n.x - tangent * n.y, normal * n.y + tangent * n.x};
    }
    template <class Point>
    Lanes gap(const Point& p) const {
        const Lanes2 on_a = turned(at(p.core_a_x), at(p.core_a_y), a.direction);
        const Lanes2 on_b = turned(at(p.core_b_x), at(p.core_b_y), b.direction);
        const Lanes dx = (b.at.x - a.at.x) + on_b.x - on_a.x, dy = (b.at.y - a.at.y) + on_b.y - on_a.y;
        return dx * n.x + dy * n.y - at(block.radii);
    }
    /// The overlap that is not there for the load.
    template <class Point>
    Lanes excess(const Point& p, Lanes gap, const Softness& s) const {
        return -gap - at(block.shallow) - all(s.give) * at(p.normal_force) / at(p.normal_mass);
    }
    void write_back(Mover* movers) const {
        scatter(a, movers, block.a + row);
        scatter(b, movers, block.b + row);
    }
};

/// Calls work(rows) for all rows of all blocks in order.
template <class Block, class Work>
inline void for_each_rows(Block* blocks, size_t count, const Mover* movers, Work work) {
    for (size_t i = 0; i < count; ++i)
        for (size_t row = 0; row < block_rows; row += static_cast<size_t>(lanes)) {
            Rows<Block> rows(blocks[i], row, movers);
            work(rows);
        }
}

inline Lanes larger(Lanes a, Lanes b) { return select(a > b, a, b); }
inline Lanes smaller(Lanes a, Lanes b) { return select(a < b, a, b); }

void warm_start(const ContactBlock* blocks, size_t count, Mover* movers, double time) {
    for_each_rows(blocks, count, movers, [&](Rows<const ContactBlock>& r) {
        for (const auto& p : r.points()) {
            r.apply(p, r.impulse(all(time) * r.at(p.normal_force), all(time) * r.at(p.tangent_force)));
            if (r.block.any_rolling) r.turn(all(time) * r.at(p.rolling_moment));
        }
        r.write_back(movers);
    });
}

void foresee_bounces(ContactBlock* blocks, size_t count, const Mover* movers, double least) {
    for (size_t i = 0; i < count; ++i)
        if (blocks[i].any_bounce)
            for_each_rows(&blocks[i], 1, movers, [&](Rows<ContactBlock>& r) {
                for (auto& p : r.points()) {
                    const Lanes bounce = -r.at(r.block.restitution) * r.along_normal(r.velocity(p));
                    r.put(p.bounce, select(bounce > all(least), bounce, Lanes{}));
                }
            });
}

/// Adds the impulses of the forces before in so much time to those so far, or to none.
template <bool to_none>
inline void begin(const Rows<ContactBlock>& r, ContactBlock::Point& p, double time) {
    const auto add = [&](double* impulses, const double* forces) {
        r.put(impulses, (to_none ? Lanes{} : r.at(impulses)) + all(time) * r.at(forces));
    };
    add(p.normal_impulse, p.normal_force);
    add(p.tangent_impulse, p.tangent_force);
    if (r.block.any_rolling) add(p.rolling_impulse, p.rolling_moment);
}

/// Coulomb: the impulse that stops the slip, as far as the cone goes.
inline void rub(Rows<ContactBlock>& r, ContactBlock::Point& p, Lanes friction, Lanes surface_speed) {
    const Lanes slip = r.along_tangent(r.velocity(p)) - surface_speed;
    const Lanes most = friction * r.at(p.normal_impulse), before = r.at(p.tangent_impulse);
    const Lanes after = larger(-most, smaller(before - r.at(p.tangent_mass) * slip, most));
    r.put(p.tangent_impulse, after);
    r.apply(p, r.impulse(Lanes{}, after - before));
}

/// The same for rolling: the moment that stops it, as far as the normal force allows.
inline void resist_rolling(Rows<ContactBlock>& r, ContactBlock::Point& p) {
    const Lanes most = r.at(r.block.rolling) * r.at(p.normal_impulse), before = r.at(p.rolling_impulse);
    const Lanes wanted = before - r.at(r.block.rolling_mass) * (r.b.w - r.a.w);
    const Lanes after = larger(-most, smaller(wanted, most));
    r.put(p.rolling_impulse, after);
    r.turn(after - before);
}

template <bool soft>
inline void push(Rows<ContactBlock>& r, ContactBlock::Point& p, const Softness& s, Lanes recovery) {
    const Lanes gap = r.gap(p), zero{}, mass = r.at(p.normal_mass), before = r.at(p.normal_impulse);
    const Lanes speed = r.along_normal(r.velocity(p));
    Lanes touching = -mass * speed;
    if constexpr (soft) {
        // What the spring of the overlap still lacks, and of that no more than parts the two at the speed of recovery.
        // Where it is deep nothing but the approach is ended: what parts the two is to become no velocity.
        const Lanes soft_mass = all(s.mass_scale) * mass;
        const Lanes spring =
            smaller(-soft_mass * gap * all(s.bias_rate) - all(s.impulse_scale) * before, soft_mass * recovery);
        touching = select(r.excess(p, gap, s) > zero, touching, spring - soft_mass * speed);
    }
    Lanes change = select(gap > zero, -mass * (speed + gap * all(s.inverse_h)), touching);
    if constexpr (!soft)
        if (r.block.any_bounce) {
            const Lanes bounce = select(before > zero, r.at(p.bounce), zero);
            change = select(bounce > zero, mass * (bounce - speed), change);
        }
    const Lanes after = select(r.at(p.open) != zero, zero, larger(before + change, zero));
    r.put(p.normal_impulse, after);
    r.apply(p, r.impulse(after - before, zero));
}

template <bool soft, bool first>
inline void sweep(ContactBlock* blocks, size_t count, Mover* movers, const Softness& softness, double warm) {
    for_each_rows(blocks, count, movers, [&](Rows<ContactBlock>& r) {
        if constexpr (first)
            for (auto& p : r.points()) begin<soft>(r, p, warm);
        const Lanes friction = r.at(r.block.friction), speed = r.at(r.block.surface_speed);
        const Lanes recovery = r.at(r.block.recovery);
        for (auto& p : r.points()) push<soft>(r, p, softness, recovery);
        for (auto& p : r.points()) rub(r, p, friction, speed);
        if (r.block.any_rolling)
            for (auto& p : r.points()) resist_rolling(r, p);
        r.write_back(movers);
    });
}
template <bool soft>
void sweep(ContactBlock* blocks, size_t count, Mover* movers, const Softness& s, const double* warm) {
    warm ? sweep<soft, true>(blocks, count, movers, s, *warm) : sweep<soft, false>(blocks, count, movers, s, 0);
}

void part(const ContactBlock* blocks, size_t count, Mover* movers, const Softness& s) {
    for_each_rows(blocks, count, movers, [&](Rows<const ContactBlock>& r) {
        const Lanes zero{}, recovery = r.at(r.block.recovery);
        for (const auto& p : r.points()) {
            const Lanes excess = r.excess(p, r.gap(p), s);
            const Lanes wanted = smaller(excess * all(s.part_rate), recovery) - r.along_normal(r.velocity(p));
            const Lanes push = select(excess > zero, larger(r.at(p.normal_mass) * wanted, zero), zero);
            r.apply(p, r.impulse(select(r.at(p.open) != zero, zero, push), zero));
        }
        r.write_back(movers);
    });
}

/// Sums by the row in a block, added up at the end: an order that does not depend on the number of lanes.
struct RowSums {
    Lanes of[block_rows / lanes] = {};

    void add(size_t row, Lanes a) { of[row / static_cast<size_t>(lanes)] += a; }
    double total() const {
        double sum = 0;
        for (const Lanes& some : of)
            for (int lane = 0; lane < lanes; ++lane) sum += some[lane];
        return sum;
    }
};

ContactSums settle(ContactBlock* blocks, size_t count, const Mover* means, double h) {
    RowSums normal, slip, belt;
    for_each_rows(blocks, count, means, [&](const Rows<ContactBlock>& r) {
        for (auto& p : r.points()) {
            r.put(p.normal_force, r.at(p.normal_impulse) / all(h));
            r.put(p.tangent_force, r.at(p.tangent_impulse) / all(h));
            if (r.block.any_rolling) r.put(p.rolling_moment, r.at(p.rolling_impulse) / all(h));
            const Lanes2 mean = r.velocity(p);
            normal.add(r.row, r.at(p.normal_impulse) * r.along_normal(mean));
            const Lanes speed = r.at(r.block.surface_speed), rubbed = r.at(p.tangent_impulse);
            slip.add(r.row, rubbed * (r.along_tangent(mean) - speed));
            belt.add(r.row, rubbed * speed);
            slip.add(r.row, r.at(p.rolling_impulse) * (r.b.w - r.a.w));
        }
    });
    return {normal.total(), slip.total(), belt.total()};
}

}  // namespace
}  // namespace carom
