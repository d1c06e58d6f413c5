#pragma once
// The text of the kernels in solvers/contact_rows.hpp, compiled once for each instruction set.

#include "simd/lanes.hpp"
#include "solvers/contact_rows.hpp"
#include "solvers/measure_text.hpp"
#include "solvers/row_text.hpp"

namespace carom {
namespace {

/// A point of some contacts, with the levers of both bodies: along the normal as x, and across as y.
template <class Point, class More>
struct At {
    Point& p;
    More& more;
    Lanes2 on_a, on_b;
};
template <class Point, class More>
inline At<Point, More> at_point(Point& p, More& more, Lanes2 on_a, Lanes2 on_b) {
    return {p, more, on_a, on_b};
}

constexpr uint32_t most_points = 2;

/// As many rows of a block as there are lanes, with their two bodies. What is solved for in a row is how b moves as a
/// sees it, along the normal and across, and how the two turn; in the end both get the sum of all impulses.
template <class Block>
struct Rows {
    Block& block;
    size_t row;
    Lanes2 n, between;
    Lanes iia, iib;
    Moving a, b;
    Lanes inverse_mass;  ///< of both
    Lanes along, across;
    Lanes2 given{};  ///< along and across

    Rows(Block& from, size_t first, const Mover* movers)
        : block(from),
          row(first),
          n{at(from.normal_x), at(from.normal_y)},
          between{at(from.between_along), at(from.between_across)},
          iia(at(from.inverse_inertia_a)),
          iib(at(from.inverse_inertia_b)),
          a(gather(movers, from.a + first)),
          b(gather(movers, from.b + first)),
          inverse_mass(a.inverse_mass + b.inverse_mass) {
        const Lanes vx = b.v.x - a.v.x, vy = b.v.y - a.v.y;
        along = vx * n.x + vy * n.y, across = vy * n.x - vx * n.y;
    }

    Lanes at(const double* numbers) const { return load(numbers + row); }
    void put(double* numbers, Lanes value) const { __builtin_memcpy(numbers + row, &value, sizeof value); }

    template <class Work>
    void each_point(Work work) {
        for (uint32_t i = 0; i < most_points; ++i) with_point(i, work);
    }
    /// If there is a point of this number.
    template <class Work>
    void with_point(uint32_t i, Work work) {
        if (i >= block.points) return;
        auto& p = block.point[i];
        const Lanes2 on_a{at(p.lever_a_along), at(p.lever_a_across)};
        work(at_point(p, block.more[i], on_a, {on_a.x - between.x, on_a.y - between.y}));
    }

    /// Velocity of b's contact point as a's sees it.
    template <class Point>
    Lanes speed_along(const Point& p) const {
        return along + (a.w * p.on_a.y - b.w * p.on_b.y);
    }
    template <class Point>
    Lanes speed_across(const Point& p) const {
        return across + (b.w * p.on_b.x - a.w * p.on_a.x);
    }
    template <class Point>
    void push(const Point& p, Lanes impulse) {
        given.x += impulse;
        along += inverse_mass * impulse;
        a.w += iia * (p.on_a.y * impulse);
        b.w -= iib * (p.on_b.y * impulse);
    }
    template <class Point>
    void rub(const Point& p, Lanes impulse) {
        given.y += impulse;
        across += inverse_mass * impulse;
        a.w -= iia * (p.on_a.x * impulse);
        b.w += iib * (p.on_b.x * impulse);
    }
    void turn(Lanes angular_impulse) {
        a.w -= iia * angular_impulse;
        b.w += iib * angular_impulse;
    }
    /// The overlap that is not there for the load, with that of the preload.
    template <class Point>
    Lanes excess(const Point& p, const Softness& s) const {
        return -at(p.p.gap) - at(block.shallow) - all(s.give) * at(p.more.normal_force) / at(p.p.normal_mass);
    }
    /// Whether its normal may have turned in the midst of the substep: that of two rounded corners, which are one
    /// point.
    template <class Point>
    bool may_turn(const Point& p) const {
        return block.any_corners && &p.p == &block.point[0];
    }
    Lanes surface_speed() const { return block.any_belt ? at(block.surface_speed) : Lanes{}; }
    void write_back(Mover* movers) {
        const Lanes2 impulse{given.x * n.x - given.y * n.y, given.x * n.y + given.y * n.x};
        a.v.x -= a.inverse_mass * impulse.x, a.v.y -= a.inverse_mass * impulse.y;
        b.v.x += b.inverse_mass * impulse.x, b.v.y += b.inverse_mass * impulse.y;
        scatter(a, movers, block.a + row);
        scatter(b, movers, block.b + row);
    }
};

/// Calls work(rows) for all rows of a block in order.
template <class Block, class Work>
inline void for_each_rows(Block& block, const Mover* movers, Work work) {
    for (size_t row = 0; row < block_rows; row += static_cast<size_t>(lanes)) {
        Rows<Block> rows(block, row, movers);
        work(rows);
    }
}

/// A bit of each lane, from the row on.
inline Mask flags(uint32_t bits, size_t row) {
    Mask of_lane{};
    for (int lane = 0; lane < lanes; ++lane) of_lane[lane] = int64_t{1} << lane;
    const Mask none{};
    return (of_lane & static_cast<int64_t>(bits >> row)) != none;
}

/// As many contacts of a block as there are lanes.
struct RowsToWrite {
    using Number = Lanes;

    const RowSource& from;
    const uint32_t* contacts;
    const RowKinds& kinds;
    ContactBlock& block;
    size_t row;

    Lanes4 four(size_t field) const {
        const size_t fours = from.at.length / 4;
        return quads_of(from.contacts + field, [this, fours](int lane) { return fours * contacts[row + lane]; });
    }
    Lanes number(size_t field) const {
        Lanes out{};
        for (int lane = 0; lane < lanes; ++lane)
            out[lane] = from.contacts[from.at.length * contacts[row + lane] + field];
        return out;
    }
    Lanes4 frame_a() const { return quads(from.frames, block.a + row); }
    Lanes4 frame_b() const { return quads(from.frames, block.b + row); }
    Lanes inverse_mass() const {
        return gather(from.movers, block.a + row).inverse_mass + gather(from.movers, block.b + row).inverse_mass;
    }
    Lanes inverse_inertia(const uint32_t* bodies) const {
        Lanes out{};
        for (int lane = 0; lane < lanes; ++lane)
            out[lane] = bodies[row + lane] < from.bodies ? from.inverse_inertia[bodies[row + lane]] : 0;
        return out;
    }
    Lanes inverse_inertia_a() const { return inverse_inertia(block.a); }
    Lanes inverse_inertia_b() const { return inverse_inertia(block.b); }
    Mask has_point(uint32_t i) const { return flags(kinds.has_point[i], row); }
    static bool is_blank() { return true; }  // a block is written whole
    Mask is_at_wall() const { return flags(kinds.is_at_wall, row); }
    Mask is_let_bounce() const { return flags(kinds.is_let_bounce, row); }
    Mask rounds_a_corner() const { return flags(kinds.rounds_a_corner, row); }
    Mask follows_corner() const { return flags(kinds.follows_corner, row); }
    void put(double* numbers, Lanes value) const { __builtin_memcpy(numbers + row, &value, sizeof value); }
};

void write_block(const RowSource& from, const uint32_t* contacts, const RowKinds& kinds, ContactBlock& block) {
    for (size_t row = 0; row < block_rows; row += static_cast<size_t>(lanes))
        write_rows(RowsToWrite{from, contacts, kinds, block, row}, block);
}

void warm_start(const ContactBlock* blocks, size_t count, Mover* movers, double time) {
    for (size_t i = 0; i < count; ++i)
        if (!blocks[i].is_precise && !blocks[i].is_idle)
            for_each_rows(blocks[i], movers, [&](Rows<const ContactBlock>& r) {
                r.each_point([&](const auto& p) {
                    r.push(p, all(time) * r.at(p.more.normal_force));
                    r.rub(p, all(time) * r.at(p.more.tangent_force));
                    if (r.block.any_rolling) r.turn(all(time) * r.at(p.more.rolling_moment));
                });
                r.write_back(movers);
            });
}

void foresee_bounces(ContactBlock* blocks, size_t count, const Mover* movers, double least) {
    for (size_t i = 0; i < count; ++i)
        if (blocks[i].any_bounce)
            for_each_rows(blocks[i], movers, [&](Rows<ContactBlock>& r) {
                r.each_point([&](const auto& p) {
                    const Lanes bounce = -r.at(r.block.restitution) * r.speed_along(p);
                    r.put(p.more.bounce, select(bounce > all(least), bounce, Lanes{}));
                });
            });
}

/// Adds the impulses of the forces before in so much time to those so far, or to none.
template <bool to_none, class Point>
inline void begin(const Rows<ContactBlock>& r, const Point& p, double time) {
    const auto add = [&](double* impulses, const double* forces) {
        r.put(impulses, (to_none ? Lanes{} : r.at(impulses)) + all(time) * r.at(forces));
    };
    add(p.p.normal_impulse, p.more.normal_force);
    add(p.p.tangent_impulse, p.more.tangent_force);
    if (r.block.any_rolling) add(p.more.rolling_impulse, p.more.rolling_moment);
}

/// Coulomb: the impulse that stops the slip, as far as the cone goes.
template <class Point>
inline void rub(Rows<ContactBlock>& r, const Point& p) {
    Lanes slip = r.speed_across(p) - r.surface_speed();
    if (r.block.any_pivots) slip += r.at(p.more.turned_tangent);
    const Lanes most = r.at(r.block.friction) * r.at(p.p.normal_impulse), before = r.at(p.p.tangent_impulse);
    const Lanes after = larger(-most, smaller(before - r.at(p.p.tangent_mass) * slip, most));
    r.put(p.p.tangent_impulse, after);
    r.rub(p, after - before);
}

/// The same for rolling: the moment that stops it, as far as the normal force allows.
template <class Point>
inline void resist_rolling(Rows<ContactBlock>& r, const Point& p) {
    const Lanes most = r.at(r.block.rolling) * r.at(p.p.normal_impulse), before = r.at(p.more.rolling_impulse);
    const Lanes wanted = before - r.at(r.block.rolling_mass) * (r.b.w - r.a.w);
    const Lanes after = larger(-most, smaller(wanted, most));
    r.put(p.more.rolling_impulse, after);
    r.turn(after - before);
}

template <bool soft, class Point>
inline void push(Rows<ContactBlock>& r, const Point& p, const Softness& s) {
    const Lanes zero{}, mass = r.at(p.p.normal_mass), before = r.at(p.p.normal_impulse);
    const Lanes gap = r.at(p.p.gap);
    Lanes speed = r.speed_along(p);
    if (r.block.any_pivots) {  // as speed_apart() has it
        const Lanes most = select(gap < -r.at(r.block.shallow), zero, r.at(r.block.recovery));
        speed += larger(-most, smaller(r.at(p.more.turned_normal), most));
    }
    Lanes touching = -mass * speed;
    if constexpr (soft) {
        // What the spring of the overlap still lacks, and of that no more than parts the two at the speed of recovery.
        // Where it is deep nothing but the approach is ended: what parts the two is to become no velocity.
        const Lanes soft_mass = all(s.mass_scale) * mass;
        const Lanes spring = smaller(-soft_mass * gap * all(s.bias_rate) - all(s.impulse_scale) * before,
                                     soft_mass * r.at(r.block.recovery));
        const Lanes sprung = spring - soft_mass * speed;
        touching = r.block.any_deep ? select(r.excess(p, s) > zero, touching, sprung) : sprung;
    }
    Lanes change = select(gap > zero, -mass * (speed + gap * all(s.inverse_h)), touching);
    if constexpr (!soft)
        if (r.block.any_bounce) {
            const Lanes bounce = select(before > zero, r.at(p.more.bounce), zero);
            change = select(bounce > zero, mass * (bounce - speed), change);
        }
    const Lanes after = larger(before + change, zero);
    r.put(p.p.normal_impulse, after);
    r.push(p, after - before);
}

/// Whether anything comes so near that it will press, in a block in which nothing does.
inline bool is_struck(const ContactBlock& block, const Mover* movers, const Softness& s) {
    Mask where{};
    for_each_rows(block, movers, [&](Rows<const ContactBlock>& r) {
        r.each_point([&](const auto& p) {
            const Lanes gap = r.at(p.p.gap);
            where |= (gap <= Lanes{}) | (r.speed_along(p) + gap * all(s.inverse_h) < Lanes{});
        });
    });
    return any(where);
}

/// Solves rows that share no moving body, point by point: what one of them waits for the others use. Inlined, so that
/// all of it stays in registers.
template <bool soft, bool first, class... AllRows>
[[gnu::always_inline]] inline void solve(Mover* movers, const Softness& softness, double warm, AllRows&... r) {
    if constexpr (first) (..., r.each_point([&](const auto& p) { begin<soft>(r, p, warm); }));
    for (uint32_t i = 0; i < most_points; ++i)
        (..., r.with_point(i, [&](const auto& p) { push<soft>(r, p, softness); }));
    for (uint32_t i = 0; i < most_points; ++i) (..., r.with_point(i, [&](const auto& p) { rub(r, p); }));
    (..., r.each_point([&](const auto& p) {
        if (r.block.any_rolling) resist_rolling(r, p);
    }));
    (..., r.write_back(movers));
}

template <bool soft, bool first>
inline void sweep(ContactBlock* blocks, size_t count, Mover* movers, const Softness& softness, HalfBegin half) {
    constexpr size_t step = static_cast<size_t>(lanes);
    const auto begin_block = [&](ContactBlock& block) {
        if (first && !(half.keeps_gaps && block.is_measured)) measure(block, half, movers);
    };
    const auto solve_all = [&](auto&... rows) { solve<soft, first>(movers, softness, half.warm, rows...); };
    ContactBlock* waiting = nullptr;
    for (size_t i = 0; i < count; ++i) {
        ContactBlock& block = blocks[i];
        begin_block(block);
        if (block.is_precise || (block.is_idle && !is_struck(block, movers, softness))) continue;
        block.is_idle = false;
        if constexpr (step < block_rows) {
            for (size_t row = 0; row < block_rows; row += 2 * step) {
                Rows a(block, row, movers), b(block, row + step, movers);
                solve_all(a, b);
            }
        } else if (!waiting) {
            waiting = &block;
        } else {
            Rows a(*waiting, 0, movers), b(block, 0, movers);
            solve_all(a, b);
            waiting = nullptr;
        }
    }
    if constexpr (step == block_rows)
        if (waiting) {
            Rows a(*waiting, 0, movers);
            solve_all(a);
        }
}
template <bool soft>
void sweep(ContactBlock* blocks, size_t count, Mover* movers, const Softness& s, const HalfBegin* half) {
    half ? sweep<soft, true>(blocks, count, movers, s, *half) : sweep<soft, false>(blocks, count, movers, s, {});
}

void part(const ContactBlock* blocks, size_t count, Mover* movers, const Softness& s) {
    for (size_t i = 0; i < count; ++i)
        if (blocks[i].any_deep)
            for_each_rows(blocks[i], movers, [&](Rows<const ContactBlock>& r) {
                const Lanes zero{}, recovery = r.at(r.block.recovery);
                r.each_point([&](const auto& p) {
                    const Lanes excess = r.excess(p, s);
                    const Lanes wanted = smaller(excess * all(s.part_rate), recovery) - r.speed_along(p);
                    const Lanes push = larger(r.at(p.p.normal_mass) * wanted, zero);
                    r.push(p, select(excess > zero, push, zero));
                });
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
    RowSums landing, parting, slip, belt;
    for (size_t i = 0; i < count; ++i) {
        if (blocks[i].is_idle) continue;
        Mask presses{};
        for_each_rows(blocks[i], means, [&](Rows<ContactBlock>& r) {
            const Lanes speed = r.surface_speed();
            r.each_point([&](const auto& p) {
                const Lanes pressed = r.at(p.p.normal_impulse), rubbed = r.at(p.p.tangent_impulse), zero{};
                r.put(p.more.normal_force, pressed / all(h));
                r.put(p.more.tangent_force, rubbed / all(h));
                presses |= (pressed != zero) | (rubbed != zero);
                const Lanes speed_apart = r.speed_along(p);
                const Lanes across = r.speed_across(p);
                Lanes landed = pressed * speed_apart;
                if (r.may_turn(p))
                    landed -= r.at(r.block.lag_along) * r.along + r.at(r.block.lag_across) * r.across +
                              (r.at(r.block.lag_turn_b) * r.b.w - r.at(r.block.lag_turn_a) * r.a.w);
                const Lanes undone = larger(zero, smaller(landed, pressed * r.at(r.block.recovery)));
                const Lanes parted = select(r.at(p.p.gap) < zero, undone, zero);
                landing.add(r.row, landed - parted);
                parting.add(r.row, parted);
                slip.add(r.row, rubbed * (across - speed));
                belt.add(r.row, rubbed * speed);
                if (!r.block.any_rolling) return;
                const Lanes rolled = r.at(p.more.rolling_impulse);
                presses |= rolled != zero;
                r.put(p.more.rolling_moment, rolled / all(h));
                slip.add(r.row, rolled * (r.b.w - r.a.w));
            });
        });
        blocks[i].is_idle = !blocks[i].any_precise && !any(presses);
    }
    return {landing.total(), parting.total(), slip.total(), belt.total()};
}

HeldSums sum_held(const ContactBlock* blocks, size_t count, const Mover* movers, const double* frames,
                  uint32_t ground) {
    struct Given {
        RowSums x, y, moment;
        void add(size_t row, Mask where, const Lanes2& impulse, Lanes moment_of_it) {
            x.add(row, select(where, impulse.x, Lanes{})), y.add(row, select(where, impulse.y, Lanes{}));
            moment.add(row, select(where, moment_of_it, Lanes{}));
        }
        HeldSums::Given total() const { return {x.total(), y.total(), moment.total()}; }
    } walls, all_of_them;
    for (size_t i = 0; i < count; ++i)
        if (blocks[i].any_held && !blocks[i].is_idle)
            for_each_rows(blocks[i], movers, [&](Rows<const ContactBlock>& r) {
                const Mask a_holds = r.a.inverse_mass == Lanes{}, holds = a_holds | (r.b.inverse_mass == Lanes{});
                const Mask at_wall = whole_numbers(r.block.a + r.row) == all(ground);
                const Lanes4 a = quads(frames, r.block.a + r.row), b = quads(frames, r.block.b + r.row);
                r.each_point([&](const auto& p) {
                    const Lanes pressed = r.at(p.p.normal_impulse), rubbed = r.at(p.p.tangent_impulse);
                    const Lanes along = select(a_holds, p.on_b.x, p.on_a.x);
                    const Lanes across = select(a_holds, p.on_b.y, p.on_a.y);
                    const Lanes x = select(a_holds, b.x, a.x) + (along * r.n.x - across * r.n.y);
                    const Lanes y = select(a_holds, b.y, a.y) + (along * r.n.y + across * r.n.x);
                    const Lanes sign = select(a_holds, all(1), all(-1));
                    Lanes2 impulse{sign * (pressed * r.n.x - rubbed * r.n.y),
                                   sign * (pressed * r.n.y + rubbed * r.n.x)};
                    Lanes moment = x * impulse.y - y * impulse.x;
                    if (r.block.any_rolling) moment += sign * r.at(p.more.rolling_impulse);
                    if (r.may_turn(p)) {
                        const Lanes of_n = sign * r.at(r.block.lag_along), of_t = sign * r.at(r.block.lag_across);
                        const Lanes2 lag{of_n * r.n.x - of_t * r.n.y, of_n * r.n.y + of_t * r.n.x};
                        impulse.x -= lag.x, impulse.y -= lag.y;
                        moment -= select(a_holds, a.x, b.x) * lag.y - select(a_holds, a.y, b.y) * lag.x +
                                  sign * select(a_holds, r.at(r.block.lag_turn_a), r.at(r.block.lag_turn_b));
                    }
                    walls.add(r.row, at_wall, impulse, moment);
                    all_of_them.add(r.row, holds, impulse, moment);
                });
            });
    return {walls.total(), all_of_them.total()};
}

}  // namespace
}  // namespace carom
