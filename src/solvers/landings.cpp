// What SoftStep notes of a step for those who listen: which contacts touch, and with what impulse they come together.

#include <algorithm>
#include <bit>
#include <vector>

#include "solvers/shared.hpp"
#include "solvers/soft_step.hpp"

namespace carom {

void note_pressed(const SoftScene& scene, SoftContacts& contacts) {
    contacts.landing.clear();
    const auto presses = [&](const ContactBlock& block, std::size_t row) {
        return block.point[0].normal_impulse[row] != 0 || block.point[1].normal_impulse[row] != 0;
    };
    each_row_where(
        scene.threads, contacts.blocks.size(),
        [&](std::size_t k) {
            std::uint32_t found = 0;
            for (std::uint32_t left = contacts.untouched[k]; left != 0; left &= left - 1) {
                const auto row = static_cast<std::uint32_t>(std::countr_zero(left));
                if (presses(contacts.blocks[k], row)) found |= 1U << row;
            }
            return found;
        },
        [&](std::size_t k, std::uint32_t row) {
            contacts.untouched[k] &= ~(1U << row);
            const std::uint32_t index = contacts.solved_in[k][row];
            SoftContact& c = contacts.all[index];
            if (!c.touched && !c.touched_before) contacts.landing.push_back(index);
            c.touched = true;
        });
    std::sort(contacts.landing.begin(), contacts.landing.end());
}

void note_landings(const SoftScene& scene, const State& proposed, SoftContacts& contacts) {
    for (const std::uint32_t index : contacts.landing) {
        const SoftContact& c = contacts.all[index];
        const ContactBlock& block = contacts.blocks[c.block];
        const std::uint32_t k = c.row;
        const Frame at_b = contacts.frames[c.b];
        const Vec2 n{block.normal_x[k], block.normal_y[k]};
        Impact impact{.shapes = c.shapes, .time = proposed.time, .normal = n};
        for (int i = 0; i < 2; ++i) {
            const Vec2 lever_a = lever_a_of(block, i, k), lever_b = lever_b_of(block, i, k);
            const double approach = dot(velocity_at(proposed, c.a, lever_a) - velocity_at(proposed, c.b, lever_b), n);
            const double impulse = block.point[i].normal_impulse[k];
            if (impulse == 0) continue;
            impact.approach = std::max(impact.approach, approach);
            impact.impulse += impulse;
            const Vec2 core = at_b.position + at_b.turn({block.more[i].core_b_x[k], block.more[i].core_b_y[k]});
            impact.point += impulse * (core - scene.pieces[c.piece_b].outline.radius * n);
        }
        if (impact.impulse == 0) continue;
        impact.point = impact.point / impact.impulse;
        contacts.landings.push_back(impact);
    }
}

}  // namespace carom
