#pragma once
// The text of the kernels in solvers/desk_rows.hpp, compiled once for each instruction set.

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

/// Lays numbers that follow one another in memory side by side.
template <int count>
[[gnu::always_inline]] inline void lay_numbers(const double* const* from, size_t first, Lanes* to) {
    const auto lay_four = [&](size_t at) {
        const Lanes4 four = quads_at([from, place = first + at](int lane) { return from[lane] + place; });
        to[at] = four.x, to[at + 1] = four.y, to[at + 2] = four.z, to[at + 3] = four.w;
    };
    for (size_t at = 0; at + 4 <= count; at += 4) lay_four(at);
    if (count % 4 != 0) lay_four(count - 4);
}
template <bool drifts>
void lay_rows(const DeskShape& shape, const DeskMemory& memory, const DeskSource& of) {
    constexpr int in_part = drifts ? 20 : 12, in_row = drifts ? 10 : 9, in_anchors = 7;
    for (size_t p = 0; p < shape.parts; ++p)
        lay_numbers<in_part>(of.parts, p * of.part, static_cast<DeskPart<Lanes>*>(memory.parts)[p].ease);
    for (size_t i = 0; i < shape.joints; ++i) {
        const JointShape& k = shape.joint[i];
        lay_numbers<in_anchors>(of.joints, i * of.joint, &static_cast<DeskAnchors<Lanes>*>(memory.anchors)[i].size);
        for (uint32_t r = 0; r < k.lines; ++r) {
            const size_t line = k.line + r;
            Lanes* const to = static_cast<DeskLine<Lanes>*>(memory.lines)[line].a;
            // Of what hinges do not have in common there are the levers.
            if (r < 2)
                lay_numbers<in_row - 2>(of.lines, line * of.line + 2, to + 2);
            else
                lay_numbers<4>(of.lines, line * of.line + in_row - 4, to + in_row - 4);
        }
    }
}
void lay(const DeskShape& shape, const DeskTask& task, const DeskMemory& memory, const DeskSource& of) {
    task.drifts ? lay_rows<true>(shape, memory, of) : lay_rows<false>(shape, memory, of);
    for (size_t i = 0; i < shape.bounds; ++i) {
        const BoundShape& b = shape.bound[i];
        const auto four = [](const double* const* from, size_t first) {
            return quads_at([=](int lane) { return from[lane] + first; });
        };
        const Lanes4 start = four(of.starts, b.line * of.line);  // gap, aim, before, half
        const Lanes4 law = four(of.laws, b.line * of.law), bounds = four(of.laws, b.line * of.law + 2);
        const DeskLaw<Lanes> numbers{law.x, law.y, bounds.x, bounds.y, bounds.z, bounds.w};
        static_cast<DeskBound<Lanes>*>(memory.bounds)[i] = wanted(
            task, b, numbers, start.x, static_cast<DeskLine<Lanes>*>(memory.lines)[b.line].error, start.z, all(1));
    }
}

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

/// The matrices of mechanisms of hinges, and the rows that they are made of.
template <int N>
struct LaneKeeper {
    using Block = BlockOf<Lanes, N>;

    const DeskShape& shape;
    const DeskMemory& memory;
    Mask has_factor{};
    DeskPart<Lanes>* parts = static_cast<DeskPart<Lanes>*>(memory.parts);
    DeskLine<Lanes>* lines = static_cast<DeskLine<Lanes>*>(memory.lines);
    const DeskBound<Lanes>* bounds = static_cast<const DeskBound<Lanes>*>(memory.bounds);
    Block *diagonal = static_cast<Block*>(memory.diagonal), *blocks = static_cast<Block*>(memory.blocks),
          *new_diagonal = static_cast<Block*>(memory.new_diagonal),
          *new_blocks = static_cast<Block*>(memory.new_blocks);

    const Lanes* ease(uint32_t part) const { return parts[part].ease; }
    const Lanes* a(uint32_t line) const { return lines[line].a; }
    const Lanes* b(uint32_t line) const { return lines[line].b; }
    Mask kept(uint32_t line) const { return is_in(lines[line].step); }
    bool is_stop(uint32_t line) const {
        return shape.bound_of[line] != no_bound && !shape.bound[shape.bound_of[line]].is_spring;
    }
    Lanes softness(uint32_t line) const {
        return shape.bound_of[line] == no_bound || is_stop(line) ? Lanes{} : bounds[shape.bound_of[line]].softness;
    }

    template <class OnDesk>
    Mask fits(const OnDesk&) const {
        Mask fit = has_factor;
        for (size_t i = 0; i < shape.bounds; ++i) {
            const DeskLine<Lanes>& line = lines[shape.bound[i].line];
            fit &= is_in(line.step) == is_in(line.factored_step);
        }
        return fit;
    }
    bool is_hinge(const JointShape&) const { return true; }
    Lanes common(uint32_t, Lanes own) const { return own; }

    template <class OnDesk>
    void refactor(const OnDesk&, Mask where) {
        if (!any(has_factor)) {
            factor(diagonal, blocks);
        } else {
            factor(new_diagonal, new_blocks);
            const auto take = [&](Block* to, const Block* from, size_t count) {
                for (size_t i = 0; i < count; ++i)
                    for (int r = 0; r < N; ++r)
                        for (int c = 0; c < N; ++c) to[i].at[r][c] = select(where, from[i].at[r][c], to[i].at[r][c]);
            };
            take(diagonal, new_diagonal, shape.joints), take(blocks, new_blocks, shape.blocks);
        }
        for (size_t i = 0; i < shape.bounds; ++i) {
            DeskLine<Lanes>& line = lines[shape.bound[i].line];
            line.factored_step = select(where, line.step, line.factored_step);
        }
        has_factor |= where;
    }
    void factor(Block* to_diagonal, Block* to_blocks) const {
        assemble<Lanes, N>(*this, slack, to_diagonal, to_blocks);
        factor_blocks(shape.order, to_diagonal, to_blocks, static_cast<Block*>(memory.scaled));
    }
    void solve(Lanes* y) const { solve_blocks(shape.order, diagonal, blocks, y); }
    template <bool whole, class OnDesk>
    void look(const OnDesk&, size_t) const {}  // there are hinges alone
};

template <int N>
unsigned iterate(const DeskShape& shape, const DeskTask& task, const DeskMemory& memory, unsigned wanted) {
    LaneKeeper<N> keeper{shape, memory};
    Desk<Lanes, N, LaneKeeper<N>> desk(shape, task, memory, keeper);
    if (task.begins)
        desk.begin();
    else
        keeper.has_factor = mask_of(*memory.factored), desk.keep();
    if (task.foresees) desk.foresee(mask_of(wanted));
    const Mask all = mask_of(wanted);
    const Mask found = desk.attempt(all);
    *memory.factored = bits_of(keeper.has_factor);
    return bits_of(found);
}

}  // namespace
}  // namespace carom
