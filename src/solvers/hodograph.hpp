#pragma once
// Routh's hodograph: the slip at one point of a blow, as its impulse grows.

#include <algorithm>
#include <cmath>

namespace carom {

struct Hodograph {
    enum Way { pressing, rubbing };
    /// A part of what yields that is rounding.
    static constexpr double nothing = 1e-10;

    double coupling[2][2];  ///< how fast an impulse of 1 N s makes the point part or slip [1/kg], and by which way
    double speed[2];        ///< at which it parts, and slips [m/s]
    double friction;
    double surface_speed = 0;  ///< at which what it touches runs [m/s]
    double given[2]{};         ///< impulses so far [N s]
    double rubbed = 0;         ///< work of friction [J]

    /// Follows it while the impulse grows by so much, or until the point comes no nearer: friction opposes the slip of
    /// each moment, and where that has ended the point sticks as long as the cone lets it, or slips the other way.
    /// False where the impulse would grow for ever.
    bool follow(double most) {
        while (true) {
            const double slip = speed[rubbing] - surface_speed, ratio = ratio_at(slip);
            const double parting = coupling[pressing][pressing] + ratio * coupling[pressing][rubbing],
                         slipping = coupling[rubbing][pressing] + ratio * coupling[rubbing][rubbing];
            // Or it wedges itself, as what has one way left to go and sticks, where rounding alone parts it.
            const double until_parted =
                parting > nothing * coupling[pressing][pressing] ? -speed[pressing] / parting : HUGE_VAL;
            double impulse = most < HUGE_VAL ? most : until_parted;
            const bool ends = slip * slipping < 0 && -slip / slipping < impulse;
            if (ends) impulse = -slip / slipping;
            if (!(impulse > 0 && impulse < HUGE_VAL)) return !(impulse > 0);
            rubbed += ratio * impulse * (slip + 0.5 * slipping * impulse);
            given[pressing] += impulse, given[rubbing] += ratio * impulse;
            speed[pressing] += parting * impulse, speed[rubbing] += slipping * impulse;
            if (!ends) return true;
            speed[rubbing] = surface_speed, most -= impulse;
        }
    }

  private:
    /// By how much friction grows with what presses.
    double ratio_at(double slip) const {
        const double own = coupling[rubbing][rubbing];
        if (!(own > 0)) return 0;
        if (slip != 0) return slip > 0 ? -friction : friction;
        return std::clamp(-coupling[rubbing][pressing] / own, -friction, friction);
    }
};

}  // namespace carom
