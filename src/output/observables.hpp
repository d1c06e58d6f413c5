#pragma once
// Numbers of the world as a whole, which data files have for every frame.

#include <array>
#include <carom/analysis.hpp>

namespace carom {

struct Observable {
    const char* name;
    const char* unit;  ///< in H5MD's way of writing units
};
inline constexpr std::array observables{
    Observable{"energy_kinetic", "J"},      Observable{"energy_rotational", "J"},
    Observable{"energy_gravity", "J"},      Observable{"energy_spring", "J"},
    Observable{"energy_field", "J"},        Observable{"heat_damping", "J"},
    Observable{"heat_drag", "J"},           Observable{"heat_impact", "J"},
    Observable{"heat_friction", "J"},       Observable{"heat_joint_damping", "J"},
    Observable{"heat_joint_friction", "J"}, Observable{"heat_limit", "J"},
    Observable{"heat_bath", "J"},           Observable{"work_driven", "J"},
    Observable{"work_wind", "J"},           Observable{"work_user", "J"},
    Observable{"work_motor", "J"},          Observable{"work_overlap", "J"},
    Observable{"work_correction", "J"},     Observable{"energy_initial_total", "J"},
    Observable{"energy_total", "J"},        Observable{"energy_residual", "J"},
    Observable{"energy_unaccounted", "J"},  Observable{"momentum_x", "kg m s-1"},
    Observable{"momentum_y", "kg m s-1"},   Observable{"angular_momentum", "kg m2 s-1"},
    Observable{"collisions", ""},           Observable{"bodies", ""}};
using Observed = std::array<double, observables.size()>;

inline Observed observe(const World& world) {
    static_assert(sizeof(Energy) == 21 * sizeof(double), "the new account is missing in the data files");
    const Energy e = energy(world);
    const Vec2 p = momentum(world);
    return {e.kinetic,
            e.rotational,
            e.gravity,
            e.spring,
            e.field,
            e.heat.damping,
            e.heat.drag,
            e.heat.impact,
            e.heat.friction,
            e.heat.joint_damping,
            e.heat.joint_friction,
            e.heat.limit,
            e.heat.bath,
            e.work.driven,
            e.work.wind,
            e.work.user,
            e.work.motor,
            e.work.overlap,
            e.work.correction,
            e.initial_total,
            e.total(),
            e.residual,
            e.unaccounted(),
            p.x,
            p.y,
            angular_momentum(world),
            static_cast<double>(world.collisions()),
            static_cast<double>(world.size())};
}

}  // namespace carom
