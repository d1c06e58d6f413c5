// What SoftStep notes of a step for those who listen: which contacts touch, and with what impulse they come together.

#include <algorithm>

#include "solvers/shared.hpp"
#include "solvers/soft_step.hpp"

namespace carom {

void note_pressed(const SoftScene& scene, SoftContacts& contacts) {
    contacts.lists.landing.clear();
    const auto pressed = [&](const ContactBlock& block) {
        std::uint32_t rows = 0;
        for (std::size_t k = 0; k < block_rows; ++k) {
            const bool first = block.point[0].normal_impulse[k] != 0, second = block.point[1].normal_impulse[k] != 0;
            rows |= (std::uint32_t{first} | std::uint32_t{second}) << k;
        }
        return rows;
    };
    each_row_where(
        scene.threads, contacts.layout.blocks.size(),
        [&](std::size_t k) {
            auto& [now, before] = contacts.layout.untouched[k];
            if (now == 0) return 0U;
            const std::uint32_t found = now & pressed(contacts.layout.blocks[k]);
            now = static_cast<std::uint8_t>(now & ~found);
            return found & before;
        },
        [&](std::size_t k, std::uint32_t row) {
            const std::uint32_t index = contacts.layout.solved_in[k][row];
            if (!contacts.all[index].touched) contacts.lists.landing.push_back(index);
        });
    std::sort(contacts.lists.landing.begin(), contacts.lists.landing.end());
}

void note_landings(const SoftScene& scene, const State& proposed, SoftContacts& contacts) {
    for (const std::uint32_t index : contacts.lists.landing) {
        const SoftContact& c = contacts.all[index];
        const ContactBlock& block = contacts.layout.blocks[c.block];
        const std::uint32_t k = c.row;
        const Frame at_b = contacts.motion.frames[c.b];
        const Vec2 n{block.normal_x[k], block.normal_y[k]};
        Impact impact{.shapes = c.shapes(), .time = proposed.time, .normal = n};
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
        contacts.events.landings.push_back(impact);
    }
}

}  // namespace carom
