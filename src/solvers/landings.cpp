// What SoftStep notes of a step for those who listen: which contacts touch, and with what impulse they come together.

#include <algorithm>
#include <vector>

#include "solvers/soft_step.hpp"

namespace carom {

void note_pressed(SoftContacts& contacts) {
    contacts.landing.clear();
    std::erase_if(contacts.untouched, [&](std::uint32_t index) {
        SoftContact& c = contacts.all[index];
        if (c.touched) return true;  // it struck
        const ContactBlock& block = contacts.blocks[c.block];
        c.touched = block.point[0].normal_impulse[c.row] != 0 || block.point[1].normal_impulse[c.row] != 0;
        if (c.touched && !c.touched_before) contacts.landing.push_back(index);
        return c.touched;
    });
}

void note_landings(const SoftScene& scene, const State& proposed, SoftContacts& contacts) {
    for (const std::uint32_t index : contacts.landing) {
        const SoftContact& c = contacts.all[index];
        const ContactBlock& block = contacts.blocks[c.block];
        const std::uint32_t k = c.row;
        const Frame at_b = frame_of(contacts.movers[c.b]);
        const Vec2 n{block.normal_x[k], block.normal_y[k]};
        Impact impact{.shapes = c.shapes, .time = proposed.time, .normal = n};
        for (const auto& p : block.point) {
            const Vec2 lever_a{p.lever_a_x[k], p.lever_a_y[k]}, lever_b{p.lever_b_x[k], p.lever_b_y[k]};
            const double approach = dot(velocity_at(proposed, c.a, lever_a) - velocity_at(proposed, c.b, lever_b), n);
            const double impulse = p.normal_impulse[k];
            if (impulse == 0) continue;
            impact.approach = std::max(impact.approach, approach);
            impact.impulse += impulse;
            const Vec2 core = at_b.position + at_b.turn({p.core_b_x[k], p.core_b_y[k]});
            impact.point += impulse * (core - scene.pieces[c.piece_b].outline.radius * n);
        }
        if (impact.impulse == 0) continue;
        impact.point = impact.point / impact.impulse;
        contacts.landings.push_back(impact);
    }
}

}  // namespace carom
