#include "analysis/diffusion.hpp"

#include <fmt/format.h>

#include <cmath>

namespace carom {

namespace {

std::string bounded(const MeasuredRoom& room, bool fall) {
    if (!room.periodic && !room.walls)
        return "there is no rectangle, stadium or periodic box, and what bounds the ways is not known";
    if (room.empty) return "";
    if (room.walls) return "other bodies or further walls bound the ways, and by how much is not known";
    if (!room.open) return "other bodies may bound or stir the ways: take fixed discs that others pass on all sides";
    return fall ? "what falls past fixed bodies is driven, and does not diffuse alone" : "";
}

}  // namespace

/// Discs must have forgotten their first velocity, and few may have met a wall, which takes √(D t/π) P/A of what the
/// squared way grows by (Mitra et al., Phys. Rev. Lett. 68, 3555 (1992), in a plane, differentiated).
std::string keeps_from_diffusing(const Ways& ways, const MeasuredRoom& room) {
    constexpr double enough = 5, most = 0.05, pi = 0x1.921fb54442d18p1;
    if (const std::string by = bounded(room, ways.fall); !by.empty()) return by;
    if (ways.met < enough)
        return fmt::format(
            "in {:.3g} s a disc meets {:.2g} others, too few to have forgotten its velocity: look less often (--every)",
            ways.shortest, ways.met);
    if (room.periodic) return "";
    if (!(ways.diffusion > 0)) return "ways do not grow between walls so near: look more often, or take a larger room";
    const double lost = std::sqrt(ways.diffusion * ways.longest / pi) * room.perimeter() / room.area();
    if (lost < most) return "";
    return fmt::format(
        "in {:.3g} s walls take {:.0f} % of what ways grow by, more than {:.0f} %: look more often, or take a larger "
        "room or a periodic box",
        ways.longest, 100 * lost, 100 * most);
}

}  // namespace carom
