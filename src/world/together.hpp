#pragma once
// Who is what where an exact gas and bodies that are moved in steps are in one world.

#include <vector>

#include "forces/dynamics.hpp"
#include "solvers/events/company.hpp"
#include "solvers/soft_step.hpp"
#include "state/memory.hpp"

namespace carom {

/// Where a turn begins, to which one that is stopped goes back. The storage is used again; a copy of the world has its
/// own.
struct TurnBegin {
    State motion;
    SoftContacts contacts;
    Memory memory;
    decltype(Mechanisms::memory) joints;
    decltype(Mechanisms::cuts) cuts{};

    TurnBegin() = default;
    TurnBegin(const TurnBegin&) {}
    TurnBegin& operator=(const TurnBegin&) { return *this; }
};

/// Free discs are the gas. All that has shapes, springs, joints or forces of its own is moved in steps. Either method
/// sees the bodies of the other as if they were fixed; rows are the same.
class Together {
  public:
    Together() = default;
    /// Whose joints broke stay in steps: they may overlap what the gas would have them beside.
    Together(const Forces& forces, const Mechanisms& mechanisms, const std::vector<BodyId>& let_go, const Bodies& all,
             const std::vector<Piece>& of_all, int threads);

    bool empty() const { return company.empty(); }
    /// Whether no disc is left that is free.
    bool everybody() const { return everybody_; }
    std::size_t first() const { return company.mover.front().row; }
    bool is_stepped(std::size_t row) const { return company.of_row(static_cast<std::uint32_t>(row)) != GasMover::none; }

    /// The blows of those in steps, in one that began at a time.
    std::vector<GasKink> kinks(const std::vector<Kink>& of_rows, double begin) const;
    /// Where they touch, or are about to.
    std::vector<GasTouch> touches(const LargeArray<SoftContact>&, const carom::State& start,
                                  const carom::State& end) const;

    GasCompany company;
    Bodies bodies_of_gas, bodies_in_steps;
    std::vector<Piece> pieces;  ///< all but the gas
    Dynamics dynamics;          ///< of the bodies in steps
    std::vector<bool> may_rest;
    TurnBegin turn_begin;

  private:
    bool everybody_ = false;
};

}  // namespace carom
