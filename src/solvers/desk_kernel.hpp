#pragma once
// The text of the kernels in solvers/desk_rows.hpp, compiled once for each instruction set.

#include "solvers/desk_lay.hpp"

namespace carom {
namespace {

/// The matrices of mechanisms of hinges, and the rows that they are made of.
template <int N>
struct LaneKeeper {
    using Block = BlockOf<Lanes, N>;

    const DeskShape& shape;
    const DeskMemory& memory;
    bool has_factor = false;
    DeskPart<Lanes>* parts = static_cast<DeskPart<Lanes>*>(memory.parts);
    DeskLine<Lanes>* lines = static_cast<DeskLine<Lanes>*>(memory.lines);
    const DeskBound<Lanes>* bounds = static_cast<const DeskBound<Lanes>*>(memory.bounds);
    Block *diagonal = static_cast<Block*>(memory.diagonal), *blocks = static_cast<Block*>(memory.blocks);

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
        Mask fit = has_factor ? Ops<Lanes>::everywhere() : Mask{};
        for (size_t i = 0; i < shape.bounds; ++i) {
            const DeskLine<Lanes>& line = lines[shape.bound[i].line];
            fit &= is_in(line.step) == is_in(line.factored_step);
        }
        return fit;
    }
    bool is_hinge(const JointShape&) const { return true; }
    Lanes common(uint32_t, Lanes own) const { return own; }

    /// Of all lanes: a matrix follows from rows and steps, and where these are as they were so is its factor.
    template <class OnDesk>
    void refactor(const OnDesk&, Mask) {
        assemble<Lanes, N>(*this, slack, diagonal, blocks);
        factor_blocks(shape.order, diagonal, blocks, static_cast<Block*>(memory.scaled));
        for (size_t i = 0; i < shape.bounds; ++i) {
            DeskLine<Lanes>& line = lines[shape.bound[i].line];
            line.factored_step = line.step;
        }
        has_factor = true;
    }
    void solve(Lanes* y) const { solve_blocks(shape.order, diagonal, blocks, y); }
    template <bool whole, class OnDesk>
    void look(const OnDesk&, size_t) const {}  // there are hinges alone
    static bool looks_ahead(const DeskShape&, const DeskTask&, const Lanes&) { return false; }
};

template <int N>
unsigned iterate(const DeskShape& shape, const DeskTask& task, const DeskMemory& memory, unsigned wanted) {
    LaneKeeper<N> keeper{shape, memory};
    Desk<Lanes, N, LaneKeeper<N>> desk(shape, task, memory, keeper);
    if (task.begins)
        desk.begin();
    else
        keeper.has_factor = *memory.is_factored, desk.keep();
    if (task.foresees) desk.foresee(mask_of(wanted));
    const Mask all = mask_of(wanted);
    const Mask found = desk.attempt(all);
    *memory.is_factored = keeper.has_factor;
    return bits_of(found);
}

}  // namespace
}  // namespace carom
