#pragma once
// The arrays over which bodies go through a substep in lanes.

#include "solvers/mover_rows.hpp"
#include "solvers/soft_step.hpp"

namespace carom {

/// The arrays of all, of whom none is carried.
inline MoverRows mover_rows(State& state, SoftContacts& contacts) {
    static_assert(sizeof(Mover) == 4 * sizeof(double) && sizeof(Frame) == 4 * sizeof(double));
    // Not the address of a first number: there may be none yet.
    const auto numbers = [](auto& array) { return reinterpret_cast<double*>(array.data()); };
    const auto then = [&](State& s) {
        return MoverRows::Then{numbers(s.x.linear), s.x.angular.data(), numbers(s.v.linear), s.v.angular.data()};
    };
    return {numbers(contacts.motion.movers), numbers(contacts.motion.before),
            numbers(contacts.motion.means),  numbers(contacts.motion.given),
            numbers(contacts.motion.frames), numbers(state.x.linear),
            state.x.angular.data(),          numbers(state.v.linear),
            state.v.angular.data(),          then(contacts.motion.start),
            then(contacts.motion.proposed),  contacts.lists.any_corners ? numbers(contacts.motion.leads) : nullptr,
            contacts.rest.asleep.data(),     nullptr,
            contacts.motion.given_fits,      state.size()};
}

}  // namespace carom
