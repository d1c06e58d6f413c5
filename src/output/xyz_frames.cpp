// Extended XYZ (https://github.com/libAtoms/extxyz): per frame the number of bodies, a line of key=value pairs that
// names the columns, and a line a body. The plane is z = 0. Lengths are in m, not in Å.

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>

#include "output/frames.hpp"
#include "output/provenance.hpp"

namespace carom {

namespace {

/// The species is X, for programs that know atoms alone take no other that is no element; kind is 0 for dynamic bodies,
/// 1 for fixed and 2 for driven ones.
constexpr const char* properties =
    "species:S:1:pos:R:3:velo:R:3:id:I:1:kind:I:1:radius:R:1:mass:R:1:angle:R:1:angular_velocity:R:1";

/// A cell of unit depth: three dimensions are what the format has.
std::string box_of(const World& world) {
    const auto room = room_of(world);
    if (!room) return R"(pbc="F F F")";
    const Vec2 size = room->high - room->low;
    return fmt::format(R"(Lattice="{} 0 0 0 {} 0 0 0 1" Origin="{} {} -0.5" pbc="{} F")", size.x, size.y, room->low.x,
                       room->low.y, room->periodic ? "T T" : "F F");
}

}  // namespace

XyzFrames::XyzFrames(File file, bool begun, const World& world, const Provenance& provenance)
    : file_(std::move(file)), box_(box_of(world)), provenance_(begun ? "" : xyz_pairs(provenance)) {}

void XyzFrames::comment_line(const World& world) {
    const auto to = std::back_inserter(text_);
    fmt::format_to(to, "{}\n{} Properties={} Time={} step={}", world.size(), box_, properties, world.time(),
                   world.steps());
    const Observed values = observe(world);
    for (std::size_t k = 0; k < values.size(); ++k) fmt::format_to(to, " {}={}", observables[k].name, values[k]);
    fmt::format_to(to, " state_hash={:016x}{}\n", state_hash(world), provenance_);
    provenance_.clear();
}

void XyzFrames::add(const World& world) {
    comment_line(world);
    const auto ids = world.ids();
    const auto x = world.positions(), v = world.velocities();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const Vec2 at = world.wrapped(x[i]);
        fmt::format_to(std::back_inserter(text_), FMT_COMPILE("X {} {} 0 {} {} 0 {} {} {} {} {} {}\n"), at.x, at.y,
                       v[i].x, v[i].y, number_of(ids[i]), static_cast<int>(world.kinds()[i]), world.radii()[i],
                       world.masses()[i], world.angles()[i], world.angular_velocities()[i]);
        if (text_.size() > 1 << 16) file_.write(text_), text_.clear();
    }
    file_.write(text_);
    text_.clear();
}

// The last frame says how the run came out: time, energies and the hash of the state.
void XyzFrames::commit(const Provenance&, const GasMeter*) { file_.commit(); }

}  // namespace carom
