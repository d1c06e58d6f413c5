#pragma once
// Who is at rest or sleeps, and what a step leaves out with them.

#include <cmath>
#include <vector>

#include "math/pages.hpp"
#include "solvers/soft_contact.hpp"
#include "state/bodies.hpp"
#include "state/motion.hpp"
#include "state/row_ranges.hpp"

namespace carom {

/// Of how long a body has been at rest [s]: it was put there since the last step; something else was done to it since,
/// or to what it touches; it stands by forces that were found.
inline constexpr double put_down = -2, stirred = -1, stands = HUGE_VAL;
inline constexpr double time_to_sleep = 0.5;  // s

/// For how long bodies have been at rest, whom a step looks at for that, and what it leaves out.
struct Rest {
    // By row.
    std::vector<double> still;         ///< for how long each body has been at rest [s], or one of the above
    std::vector<double> calm;          ///< for how long it has been nearly so [s]
    std::vector<std::uint8_t> asleep;  ///< 1: the body sleeps; 2: it does, but is looked at
    std::vector<std::uint8_t> told;    ///< it was told that it sleeps

    // Who is looked at.
    bool is_known = false;  ///< what is left out, and the boxes of who is not awake, are as the last search left them
    RowRanges moving;       ///< rows of the bodies that a substep goes through: not those of sleepers alone
    std::vector<std::uint32_t> roused;        ///< rows of the sleepers that are looked at, if `is_known`
    std::vector<std::uint32_t> awake_pieces;  ///< of the bodies that are awake or looked at, if so

    // What is left out.
    LargeArray<SoftContact> contacts;  ///< those of bodies that sleep, in the order of their keys
    std::vector<WarmContact> warm;     ///< what they left, in that order too
    Flows flow;                        ///< what holds up those that `moving` leaves out, and sleepers, and their weight
    double fixed_size = 0;             ///< of the fixed bodies among those that do not move, there and back [m]
    bool is_new = true;                ///< since the last step others may sleep, or elsewhere

    double owed = 0;  ///< products of blocks that looking for who stands took and later steps are to earn

    /// Whether a body may move by itself in this step, or is driven.
    bool is_awake(const Bodies& bodies, std::size_t row) const {
        return bodies.kind[row] == Kind::driven || (bodies.inverse_mass[row] != 0 && !asleep[row]);
    }
    /// Calls act(row) for those that a search looks at, for some sleepers twice.
    template <class Act>
    void each_row_looked_at(const Act& act) const {
        if (!is_known) {
            for (std::size_t i = 0; i < asleep.size(); ++i) act(i);
            return;
        }
        moving.each_row(act);
        for (const std::uint32_t i : roused) act(i);
    }

    /// Whether something was done to a body since the last step.
    bool is_edited(std::size_t row) const { return still[row] <= stirred; }
    bool was_put_down(std::size_t row) const { return still[row] == put_down; }

    /// To be called when what acts on all is changed.
    void stir_all();
    /// To be called when something is done to a body, when it is put somewhere, when it is to be awake,
    void stir(std::size_t row);
    void put(std::size_t row);
    void keep_awake(std::size_t row);
    /// and before the last moves into a removed one's row.
    void remove(std::size_t row, std::size_t bodies);
    /// Makes room for so many bodies: who is new was put there.
    void resize(std::size_t bodies);
};

/// Makes one state the other, of which rows that do not move are alike.
void take_moving(int threads, const RowRanges& moving, const State& from, State& to);

}  // namespace carom
