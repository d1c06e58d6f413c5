#pragma once
// How mechanisms that are alike are laid side by side, one a lane, and one that is alone part by part.

#include "simd/lanes.hpp"
#include "solvers/desk.hpp"

namespace carom {
namespace {

template <>
struct Ops<Lanes> {
    using Mask = carom::Mask;
    static constexpr int lanes = carom::lanes;
    static Mask everywhere() { return Lanes{} == Lanes{}; }
    static Mask nowhere() { return Mask{}; }
    static Mask some(Mask where) { return where; }
    static Lanes select(Mask where, Lanes yes, Lanes no) { return carom::select(where, yes, no); }
    static bool any(Mask where) { return carom::any(where); }
    static Mask both(Mask a, Mask b) { return a & b; }
    static Mask either(Mask a, Mask b) { return a | b; }
    static Mask no(Mask a) { return ~a; }
    static double at(Lanes a, int lane) { return a[lane]; }
    static void put(Lanes& a, int lane, double x) { a[lane] = x; }
    static Lanes all(double a) { return carom::all(a); }
    static Lanes larger(Lanes a, Lanes b) { return carom::select((a > b) | (a != a), a, b); }
};

unsigned bits_of(Mask where) {
    unsigned bits = 0;
    for (int lane = 0; lane < lanes; ++lane) bits |= where[lane] != 0 ? 1U << lane : 0;
    return bits;
}
Mask mask_of(unsigned bits) {
    Mask where{};
    for (int lane = 0; lane < lanes; ++lane) where[lane] = (bits >> lane & 1U) != 0 ? -1 : 0;
    return where;
}

/// Lays numbers that follow one another in memory side by side.
template <size_t count>
[[gnu::always_inline]] inline void lay_numbers(const double* const* from, size_t first, Lanes* to) {
    const auto lay_four = [&](size_t at) {
        const Lanes4 four = quads_at([from, place = first + at](int lane) { return from[lane] + place; });
        to[at] = four.x, to[at + 1] = four.y, to[at + 2] = four.z, to[at + 3] = four.w;
    };
    for (size_t at = 0; at + 4 <= count; at += 4) lay_four(at);
    if (count % 4 != 0) lay_four(count - 4);
}
inline Lanes4 four_of(const double* const* from, size_t first) {
    return quads_at([=](int lane) { return from[lane] + first; });
}
inline void lay_anchors(const DeskMemory& memory, const DeskSource& of, size_t joint) {
    lay_numbers<laid_of_anchors>(of.joints, joint * of.joint,
                                 &static_cast<DeskAnchors<Lanes>*>(memory.anchors)[joint].size);
}
/// What a row of a bound is to be at, of which `start` has the gap and what follows it where the substep began.
inline void lay_bound(const DeskShape& shape, const DeskTask& task, const DeskMemory& memory, const DeskSource& of,
                      size_t bound, const Lanes4& start) {
    const BoundShape& b = shape.bound[bound];
    DeskBound<Lanes>& to = static_cast<DeskBound<Lanes>*>(memory.bounds)[bound];
    const size_t from = shape.line_of[b.line] * of.law;
    const Lanes4 law = four_of(of.laws, from), bounds = four_of(of.laws, from + 2);
    const DeskLaw<Lanes> numbers{law.x, law.y, bounds.x, bounds.y, bounds.z, bounds.w};
    to = wanted(task, b, numbers, start.x, static_cast<DeskLine<Lanes>*>(memory.lines)[b.line].error, start.z, all(1));
}
template <bool drifts>
void lay_rows(const DeskShape& shape, const DeskMemory& memory, const DeskSource& of) {
    constexpr size_t in_row = laid_of_row[drifts];
    for (size_t p = 0; p < shape.parts; ++p)
        lay_numbers<laid_of_part[drifts]>(of.parts, p * of.part, static_cast<DeskPart<Lanes>*>(memory.parts)[p].ease);
    for (size_t i = 0; i < shape.joints; ++i) {
        const JointShape& k = shape.joint[i];
        lay_anchors(memory, of, i);
        for (uint32_t r = 0; r < k.lines; ++r) {
            const size_t from = shape.line_of[k.line + r] * of.line;
            Lanes* const to = static_cast<DeskLine<Lanes>*>(memory.lines)[k.line + r].a;
            // Of what hinges do not have in common there are the levers.
            if (r < 2)
                lay_numbers<in_row - 2>(of.lines, from + 2, to + 2);
            else
                lay_numbers<4>(of.lines, from + in_row - 4, to + in_row - 4);
        }
    }
}
void lay(const DeskShape& shape, const DeskTask& task, const DeskMemory& memory, const DeskSource& of) {
    task.drifts ? lay_rows<true>(shape, memory, of) : lay_rows<false>(shape, memory, of);
    for (size_t i = 0; i < shape.bounds; ++i)
        lay_bound(shape, task, memory, of, i, four_of(of.starts, shape.line_of[shape.bound[i].line] * of.line));
}

/// What the joints of mechanisms that have drifted begin with (begin_relax of one that is alone).
class Drifted {
  public:
    Drifted(const DeskShape& shape, const DeskTask& task, const DeskMemory& memory, const DeskSource& of)
        : shape_(shape),
          task_(task),
          memory_(memory),
          of_(of),
          parts_(static_cast<DeskPart<Lanes>*>(memory.parts)),
          lines_(static_cast<DeskLine<Lanes>*>(memory.lines)),
          expected_(load(of.expected)),
          of_springs_(load(of.of_springs)) {}

    unsigned lay() {
        for (size_t p = 0; p < shape_.parts; ++p) {
            lay_numbers<laid_of_part[false]>(of_.parts, p * of_.part, parts_[p].ease);
            lay_numbers<5>(of_.parts, p * of_.part + laid_of_part[true], &parts_[p].now.x);
        }
        for (size_t i = 0; i < shape_.joints; ++i) begin(i);
        const Mask lost = is_lost();
        for (size_t p = 0; p < shape_.parts; ++p) feel_given<Lanes>(Ops<Lanes>::everywhere(), parts_[p]);
        return bits_of(lost);
    }

  private:
    void begin(size_t joint) {
        const JointShape& k = shape_.joint[joint];
        DeskPart<Lanes>&a = parts_[k.a], &b = parts_[k.b];
        lay_anchors(memory_, of_, joint);
        const auto& anchors = static_cast<const DeskAnchors<Lanes>*>(memory_.anchors)[joint];
        const HingeEnds<Lanes> ends(a.now, b.now, anchors);
        DeskLine<Lanes>* const lines = &lines_[k.line];
        ends.put_levers(lines);
        lines[0].error = ends.x, lines[1].error = ends.y;
        Lanes turn_a = a.given[2], turn_b = b.given[2];
        for (uint32_t r = 0; r < 2; ++r) {
            lines[r].impulse = expected_ * start_of(k.line + r).w;
            a.given[r] -= lines[r].impulse, b.given[r] += lines[r].impulse;
            turn_a += lines[r].a[2] * lines[r].impulse, turn_b += lines[r].b[2] * lines[r].impulse;
        }
        a.given[2] = turn_a, b.given[2] = turn_b;
        if (const uint32_t spring = shape_.spring_of[joint]; spring != no_bound)
            turn(select(of_springs_ != Lanes{}, at_start(spring).z, Lanes{}), a, b);
        const Lanes angle = b.now.angle - a.now.angle - anchors.rest;
        for (uint32_t r = 2; r < k.lines; ++r) begin_turning(k, r, angle, a, b);
    }
    /// A row of the angle: of stops nothing is expected where contacts do not act.
    void begin_turning(const JointShape& k, uint32_t row, Lanes angle, DeskPart<Lanes>& a, DeskPart<Lanes>& b) {
        DeskLine<Lanes>& line = lines_[k.line + row];
        const uint32_t bound = shape_.bound_of[k.line + row];
        const Lanes4 start = start_of(k.line + row);
        line.error = angle, line.impulse = bound == no_bound || task_.is_warm ? expected_ * start.w : Lanes{};
        if (bound != no_bound) lay_bound(shape_, task_, memory_, of_, bound, start);
        turn(line.impulse, a, b);
    }
    static void turn(Lanes impulse, DeskPart<Lanes>& a, DeskPart<Lanes>& b) {
        const Mask gives = impulse != Lanes{};
        a.given[2] = select(gives, a.given[2] - impulse, a.given[2]);
        b.given[2] = select(gives, b.given[2] + impulse, b.given[2]);
    }
    /// Gap, aim, impulse before the drift and expected force of a row; and of a line of the mechanism.
    Lanes4 start_of(size_t line) const { return at_start(shape_.line_of[line]); }
    Lanes4 at_start(size_t line) const { return four_of(of_.starts, line * of_.line); }
    /// As of one that is alone (mechanism.hpp).
    Mask is_lost() const {
        Lanes before{}, after{};
        const auto note = [](Lanes& most, Lanes v) { most = select(most < magnitude(v), magnitude(v), most); };
        for (size_t p = 0; p < shape_.parts; ++p)
            for (int i = 0; i < 2; ++i) {
                const DeskPart<Lanes>& part = parts_[p];
                note(before, part.v[i]);
                note(after, part.v[i] + part.ease[i] * (part.given[i] - part.known[i]));
            }
        return after > digits_of_speed * before;
    }

    const DeskShape& shape_;
    const DeskTask& task_;
    const DeskMemory& memory_;
    const DeskSource& of_;
    DeskPart<Lanes>* parts_;
    DeskLine<Lanes>* lines_;
    Lanes expected_, of_springs_;
};
unsigned lay_drifted(const DeskShape& shape, const DeskTask& task, const DeskMemory& memory, const DeskSource& of) {
    return Drifted(shape, task, memory, of).lay();
}

/// A mechanism of plain hinges that is alone where its drift ends: as many of its parts, and then of its joints, at a
/// time as there are lanes. Lanes that are left over have the last one too.
class Ahead {
  public:
    Ahead(const DeskShape& shape, const DeskTask& task, const DeskMemory& memory)
        : shape_(shape),
          task_(task),
          parts_(static_cast<DeskPart<double>*>(memory.parts)),
          anchors_(static_cast<const DeskAnchors<double>*>(memory.anchors)),
          lines_(static_cast<const DeskLine<double>*>(memory.lines)),
          unknowns_(static_cast<double*>(memory.unknowns)) {}

    double look() {
        for (size_t p = 0; p < shape_.parts; p += some) drift(p);
        Lanes worst{};
        for (size_t i = 0; i < shape_.joints; i += some) look_at(i, worst);
        double most = 0;
        for (int lane = 0; lane < lanes; ++lane) most = Ops<double>::larger(worst[lane], most);
        return most;
    }

  private:
    static constexpr size_t some = lanes;

    static size_t left(size_t first, size_t count) { return count - first < some ? count - first : some; }
    static size_t at(size_t first, int lane, size_t count) {
        const size_t place = first + static_cast<size_t>(lane);
        return place < count ? place : count - 1;
    }
    void drift(size_t first) {
        double* of[some];
        for (int lane = 0; lane < lanes; ++lane) of[lane] = parts_[at(first, lane, shape_.parts)].ease;
        DeskPart<Lanes> p;
        lay_numbers<laid_of_part[true]>(of, 0, p.ease);
        feel_given<Lanes>(Ops<Lanes>::everywhere(), p);
        drift_part(task_, p);
        const auto put = [&](size_t number, const Lanes4& four) {
            store_fours_at([&](int lane) { return of[lane] + number; }, four, left(first, shape_.parts));
        };
        put(2, {p.ease[2], p.v[0], p.v[1], p.v[2]});
        put(8, {p.given[2], p.known[0], p.known[1], p.known[2]});
        put(17, {p.now.x, p.now.y, p.now.cosine, p.now.sine});
        put(18, {p.now.y, p.now.cosine, p.now.sine, p.now.angle});
    }
    void look_at(size_t first, Lanes& worst) const {
        const JointShape* of[some];
        const double* anchors[some];
        for (int lane = 0; lane < lanes; ++lane) {
            const size_t joint = at(first, lane, shape_.joints);
            of[lane] = &shape_.joint[joint], anchors[lane] = &anchors_[joint].size;
        }
        DeskAnchors<Lanes> k;
        lay_numbers<laid_of_anchors>(anchors, 0, &k.size);
        const auto place = [&](uint32_t JointShape::*part) {
            const Lanes4 now = quads_at([&](int lane) { return &parts_[of[lane]->*part].now.x; });
            return DeskPlace<Lanes>{now.x, now.y, now.z, now.w, Lanes{}};
        };
        const HingeEnds<Lanes> ends(place(&JointShape::a), place(&JointShape::b), k);
        const double per_h = 1 / task_.h;
        const auto missing = [&](uint32_t row, Lanes gap) {
            Lanes aim;
            for (int lane = 0; lane < lanes; ++lane) aim[lane] = lines_[of[lane]->line + row].aim;
            const Lanes speed = (aim - gap) * per_h;
            worst = Ops<Lanes>::larger(magnitude(speed) * k.per_size, worst);
            return speed;
        };
        const Lanes2 both{missing(0, ends.x), missing(1, ends.y)};
        double pairs_of[2 * some];
        store_pairs(pairs_of, both, some);
        for (int lane = 0; lane < lanes; ++lane)
            __builtin_memcpy(&unknowns_[2 * of[lane]->place], &pairs_of[2 * lane], sizeof(Pair));
    }

    const DeskShape& shape_;
    const DeskTask& task_;
    DeskPart<double>* parts_;
    const DeskAnchors<double>* anchors_;
    const DeskLine<double>* lines_;
    double* unknowns_;
};
double look_ahead(const DeskShape& shape, const DeskTask& task, const DeskMemory& memory) {
    return Ahead(shape, task, memory).look();
}

/// Those whose energy is no more than so many times that of the velocities with which the solve began.
unsigned calm(const DeskShape& shape, const DeskMemory& memory, double most) {
    const auto* const parts = static_cast<const DeskPart<Lanes>*>(memory.parts);
    const auto energy = [&](auto velocity_of) {
        Lanes sum{};
        for (size_t p = 0; p < shape.parts; ++p) {
            const Lanes* const v = velocity_of(parts[p]);
            const Lanes m = parts[p].ease[0], i = parts[p].ease[2];
            sum +=
                select(m > 0.0, (v[0] * v[0] + v[1] * v[1]) / m, Lanes{}) + select(i > 0.0, v[2] * v[2] / i, Lanes{});
        }
        return sum;
    };
    return bits_of(energy([](const DeskPart<Lanes>& p) { return p.v; }) <=
                   most * energy([](const DeskPart<Lanes>& p) { return p.first_v; }));
}

}  // namespace
}  // namespace carom
