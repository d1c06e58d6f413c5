// Sleep: islands at rest are left out of the solve, and their bodies stay where they are.

#include <algorithm>
#include <iterator>
#include <limits>

#include "forces/gains.hpp"
#include "math/scratch.hpp"
#include "solvers/islands.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/shared.hpp"

namespace carom {

namespace {

/// A body is at rest while it is slower than this part of what gravity gives it in a step. What sweeps leave of the
/// motion of a stack is a thousandth of that; what begins to tip or to slide is faster in a hundredth of the time.
constexpr double slowness = 1e-6;
/// Where bodies do not sleep: then its energy is less than the rounding of that of its weight.
constexpr double hardly_any = 1e-8;

/// Who is on a curve moves whatever his velocity is now; who is not, as he is told, which wakes those around.
bool is_under_way(const SoftScene& scene, const Motion& velocity, std::uint32_t row) {
    return is_driven(scene, row) &&
           (!scene.may_rest[row] || velocity.linear[row] != Vec2{} || velocity.angular[row] != 0);
}
bool is_under_way(const SoftScene& scene, const Motion& velocity, const SoftContact& c) {
    return is_under_way(scene, velocity, c.a) || is_under_way(scene, velocity, c.b);
}

/// By row, for the first of every island: whether all of it may sleep. A belt keeps those awake who are: who sleeps was
/// found to be near none, and when he is looked at again, as in a restored world, a longer step may see farther.
Scratch<bool> quiet_islands(const SoftScene& scene, const Scratch<std::uint32_t>& first, const Motion& velocity,
                            const SoftContacts& contacts) {
    Scratch<bool> quiet(first.size(), true);
    const auto is_awake = [&](std::uint32_t row) { return moves(scene, row) && !contacts.rest.asleep[row]; };
    const auto all_sleep = [&](const SoftContact& c) { return !is_awake(c.a) && !is_awake(c.b); };
    contacts.rest.each_row_looked_at([&](std::size_t i) {
        const double time = scene.sleeps ? time_to_sleep : stands;
        if (!scene.may_rest[i] || contacts.rest.still[i] < time) quiet[first[i]] = false;
    });
    for (std::size_t i = 0; i < contacts.all.size(); ++i) {
        const std::uint32_t island = first_of(scene, first, contacts.ends[i]);
        if (!quiet[island]) continue;
        const SoftContact& c = contacts.all[i];
        if (all_sleep(c) ? is_under_way(scene, velocity, c) : keeps_awake(scene, velocity, c)) quiet[island] = false;
    }
    for (const Mechanism& m : scene.mechanisms.all) {
        const auto is_quiet = [&](const Mechanism::Part& p) { return moves(scene, p.row) && quiet[first[p.row]]; };
        if (is_left_out(contacts.rest, m) || std::none_of(m.parts.begin(), m.parts.end(), is_quiet) ||
            !keeps_awake(scene, velocity, m))
            continue;
        for (const Mechanism::Part& p : m.parts)
            if (moves(scene, p.row)) quiet[first[p.row]] = false;
    }
    return quiet;
}

/// Takes what little velocity there is, on the method's account.
void stop(const SoftScene& scene, std::size_t row, State& state) {
    Gains gains(scene.flight.dynamics);
    Vec2& v = state.v.linear[row];
    double& w = state.v.angular[row];
    gains.add(row, state.x.linear[row], v, w, {}, -v, -w);
    gains.book(state.account);
    v = {}, w = 0;
}

/// The contacts of those that sleep, among those of who slept before, by their keys. There may be a hundred thousand:
/// they are written where they stay, or stay where they are.
void set_aside(const SoftScene& scene, SoftContacts& contacts) {
    Rest& rest = contacts.rest;
    const auto sleeps = [&](const auto& c) { return rest.asleep[moves(scene, c.a) ? c.a : c.b] != 0; };
    const auto count = static_cast<std::size_t>(std::count_if(contacts.ends.begin(), contacts.ends.end(), sleeps));
    if (count == 0) return;
    const auto keep_touched = [](SoftContact& c) { c.touched_before = c.touched = c.touched || c.touched_before; };
    if (rest.contacts.empty() && count == contacts.all.size()) {
        std::for_each(contacts.all.begin(), contacts.all.end(), keep_touched);
        rest.contacts.swap(contacts.all);
    } else {
        const Scratch<SoftContact> before(rest.contacts.begin(), rest.contacts.end());
        rest.contacts.clear();
        if (const std::size_t all = before.size() + count; all > rest.contacts.capacity())
            rest.contacts.reserve(std::max(all, 2 * rest.contacts.capacity()));
        auto next = before.begin();
        for (const SoftContact& c : contacts.all) {
            if (!sleeps(c)) continue;
            for (; next != before.end() && next->key < c.key; ++next) rest.contacts.push_back(*next);
            keep_touched(rest.contacts.emplace_back(c));
        }
        rest.contacts.insert(rest.contacts.end(), next, before.end());
        std::erase_if(contacts.all, sleeps);
    }
    std::erase_if(contacts.ends, sleeps);
    rest.is_new = true;
    keep_resting_warm(contacts);
}

/// Rows that are looked at and of which is_one(row) is true, each once and in order.
template <class IsOne>
Scratch<std::uint32_t> rows_looked_at(const Rest& rest, const IsOne& is_one) {
    Scratch<std::uint32_t> rows;
    rest.each_row_looked_at([&](std::size_t row) {
        if (is_one(static_cast<std::uint32_t>(row))) rows.push_back(static_cast<std::uint32_t>(row));
    });
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
}

/// Who has fallen asleep or woken up. What stands where nobody sleeps is left out all the same.
void tell(const SoftScene& scene, Rest& rest, SoftEvents& events) {
    const auto is_news = [&](std::uint32_t i) { return (scene.sleeps && rest.asleep[i] != 0) != (rest.told[i] != 0); };
    for (const std::uint32_t i : rows_looked_at(rest, is_news)) {
        rest.told[i] = !rest.told[i];
        (rest.told[i] ? events.sleeps : events.wakes).push_back(scene.bodies.id[i]);
    }
}

/// Deals all rows out, chunk by chunk, to those that a substep goes through and the others: of these nobody is awake,
/// nor does any force act on them that may change. If nobody moves at all, no force and no method is in the way.
RowRanges deal_out(const SoftScene& scene, Rest& rest) {
    const std::size_t rows = rest.asleep.size();
    RowRanges others;
    rest.moving.clear();
    const auto may_be_left = [&](std::size_t i) { return !rest.is_awake(scene.bodies, i) && scene.may_rest[i]; };
    for (std::size_t first = 0; first < rows; first += chunk_rows) {
        const std::size_t last = std::min(first + chunk_rows, rows);
        bool left = true;
        for (std::size_t i = first; i < last; ++i) left = left && may_be_left(i);
        (left ? others : rest.moving).add(first, last);
    }
    if (scene.may_leave_out || rest.moving.empty()) return others;
    rest.moving = RowRanges::all(rows);
    return {};
}

void book_resting(const SoftScene& scene, const State& state, double dt, const Rest& rest, Flows& account) {
    for (const SoftContact& c : rest.contacts) {
        if (moves(scene, c.a) && moves(scene, c.b)) continue;
        const Vec2 n = c.manifold.normal;
        for (int i = 0; i < c.manifold.count; ++i) {
            book_held(scene, c, point_of(c, i, state.x.linear[c.b]),
                      dt * (c.normal_force[i] * n + c.tangent_force[i] * perpendicular(n)), dt * c.rolling_moment[i],
                      {}, {}, account);
        }
    }
}

/// Lists the pieces of those that are awake or looked at.
void list_pieces(const SoftScene& scene, Rest& rest) {
    rest.awake_pieces.clear();
    for (std::uint32_t k = 0; k < scene.pieces.size(); ++k) {
        const std::uint32_t row = scene.pieces[k].row;
        if (rest.is_awake(scene.bodies, row) || rest.asleep[row] == 2) rest.awake_pieces.push_back(k);
    }
}

/// Leaves those that do not move as a step would leave them, and sums up what holds them.
void leave_out(const SoftScene& scene, const State& state, SoftContacts& contacts) {
    Rest& rest = contacts.rest;
    BodyMotion& motion = contacts.motion;
    const RowRanges others = deal_out(scene, rest);
    motion.start = motion.proposed = state;
    for (auto* of_bodies : {&motion.before, &motion.means}) of_bodies->assign(state.size() + 1, {});
    others.each_row([&](std::size_t i) { motion.movers[i] = {0, 0, 0, scene.bodies.inverse_mass[i]}; });
    rest.flow = {};
    if (!others.empty()) {
        // Of a copy: what is on a curve would be put where that has it now, and is there but for rounding.
        scene.flight.dynamics.evaluate(motion.proposed, motion.rates, rest.moving.empty() ? nullptr : &others);
        rest.flow = motion.rates.flow;
    }
    constexpr double second = 1;
    book_resting(scene, state, second, rest, rest.flow);
    book_resting(scene, scene.mechanisms, state, second, contacts, rest.flow);
    rest.fixed_size = 0;
    others.each_row([&](std::size_t i) {
        if (!rest.asleep[i]) rest.fixed_size += 2 * contacts.pieces.extent[i];
    });
    list_pieces(scene, rest);
}

}  // namespace

double speed_at_rest(const SoftScene& scene, double dt) {
    return (scene.sleeps ? slowness : hardly_any) * length(scene.flight.dynamics.gravity()) * dt;
}

bool keeps_awake(const SoftScene& scene, const Motion& velocity, const SoftContact& c) {
    return c.surface_speed != 0 || is_under_way(scene, velocity, c);
}

bool keeps_awake(const SoftScene& scene, const Motion& velocity, const Mechanism& m) {
    const auto is_one = [&](const auto& p) { return is_under_way(scene, velocity, p.row); };
    return std::any_of(m.lines.begin(), m.lines.end(), [](const JointLine& l) { return l.law->speed != 0; }) ||
           std::any_of(m.parts.begin(), m.parts.end(), is_one);
}

void Rest::stir_all() {
    for (std::size_t row = 0; row < still.size(); ++row) stir(row);
}

void Rest::stir(std::size_t row) {
    if (row < still.size()) still[row] = std::min(still[row], stirred), calm[row] = 0;
}

void Rest::put(std::size_t row) {
    if (row < still.size()) still[row] = put_down, calm[row] = 0;
}

void Rest::resize(std::size_t bodies) {
    still.resize(bodies, put_down), calm.resize(bodies), asleep.resize(bodies), told.resize(bodies);
}

void Rest::keep_awake(std::size_t row) {
    if (row < still.size()) still[row] = calm[row] = 0;
}

void Rest::remove(std::size_t row, std::size_t bodies) {
    const auto close = [=](auto& array, auto of_new) {
        array.resize(bodies, of_new);
        array[row] = array.back();
        array.pop_back();
    };
    close(still, put_down), close(calm, 0.0), close(asleep, std::uint8_t{0}), close(told, std::uint8_t{0});
}

void SoftContacts::stir(std::size_t row) {
    rest.stir(row);
    if (row < rest.asleep.size() && rest.asleep[row] != 0) rest.is_known = false;
}

void SoftContacts::stir_around(BodyId body, const Bodies& bodies) {
    for (const auto* contacts : {&warm, &rest.warm})
        for (const WarmContact& c : *contacts) {
            const BodyId other = c.key.a == body ? c.key.b : c.key.a;
            if ((c.key.a == body || c.key.b == body) && bodies.contains(other)) stir(bodies.row(other));
        }
}

void SoftContacts::renumber_walls(std::uint32_t first, std::uint32_t removed, std::uint32_t added) {
    for (auto* contacts : {&warm, &rest.warm}) {
        const auto is_later = [&](const WarmContact& c) { return c.key.a.generation == 0 && c.key.a.index >= first; };
        std::erase_if(*contacts, [&](const WarmContact& c) { return is_later(c) && c.key.a.index < first + removed; });
        for (WarmContact& c : *contacts)
            if (is_later(c)) c.key.a.index = c.key.a.index - removed + added;
    }
    // Those of the last step are told until the next one.
    for (auto* contacts : {&all, &rest.contacts})
        for (SoftContact& c : *contacts)
            if (c.at_wall && c.shape_a >= first)
                c.shape_a = c.shape_a < first + removed ? SoftContact::no_shape : c.shape_a - removed + added;
}

bool is_left_out(const Rest& rest, const Mechanism& m) { return rest.is_known && m.is_asleep; }

bool reach_sleepers(const SoftContacts& contacts) {
    const auto sleeps = [&](std::uint32_t row) {
        return row < contacts.rest.asleep.size() && contacts.rest.asleep[row] == 1;
    };
    return std::any_of(contacts.ends.begin(), contacts.ends.end(),
                       [&](const ContactEnds& c) { return sleeps(c.a) || sleeps(c.b); });
}

void rouse(const SoftScene& scene, const State& state, SoftContacts& contacts) {
    const Timed timed(scene.profile, Work::sleep);
    Rest& rest = contacts.rest;
    State& from = contacts.outlook.from;
    const Scratch<std::uint32_t> first = firsts_of_resting(scene, contacts);
    Scratch<bool> reached(first.size());
    for (const SoftContact& c : contacts.all)
        for (const std::uint32_t row : {c.a, c.b})
            if (row < first.size() && rest.asleep[row] == 1) reached[first[row]] = true;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
        if (rest.asleep[i] != 1 || !reached[first[i]]) continue;
        rest.asleep[i] = 2;
        rest.roused.push_back(i);
        from.x.linear[i] = state.x.linear[i], from.x.angular[i] = state.x.angular[i];
        from.v.linear[i] = {}, from.v.angular[i] = 0;
    }
    const auto is_roused = [&](std::uint32_t row) { return moves(scene, row) && rest.asleep[row] == 2; };
    list_pieces(scene, rest);
    for (Mechanism& m : scene.mechanisms.all)
        for (const Mechanism::Part& p : m.parts)
            if (is_roused(p.row)) m.is_asleep = false;
    recall_roused(scene, contacts);
    contacts.search.knows_pairs = false;
}

void let_sleep(const SoftScene& scene, const Scratch<std::uint32_t>& first, State& state, SoftContacts& contacts) {
    Rest& rest = contacts.rest;
    const Scratch<bool> quiet = quiet_islands(scene, first, state.v, contacts);
    const Scratch<std::uint32_t> changed = rows_looked_at(rest, [&](std::uint32_t i) {
        rest.asleep[i] = rest.asleep[i] != 0;  // who was looked at sleeps on, unless he changes
        return moves(scene, i) && quiet[first[i]] != (rest.asleep[i] != 0);
    });
    for (const std::uint32_t i : changed) {
        rest.asleep[i] = quiet[first[i]];
        if (!rest.asleep[i]) {
            rest.still[i] = std::min(rest.still[i], time_to_sleep);
            continue;
        }
        stop(scene, i, state);
        contacts.search.left_out = false;  // he is among those of whom all pairs are known
    }
    tell(scene, rest, contacts.events);
    set_aside(scene, contacts);
    if (!rest.is_known || !changed.empty() || !rest.roused.empty()) leave_out(scene, state, contacts);
    rest.is_known = true;
    rest.roused.clear();
}

void take_moving(int threads, const RowRanges& moving, const State& from, State& to) {
    to.time = from.time, to.account = from.account;
    for_each_moving(threads, moving, from.size(), [&](std::size_t first, std::size_t last) {
        const auto take = [=](const auto& in, auto& out) {
            std::copy(in.data() + first, in.data() + last, out.data() + first);
        };
        take(from.x.linear, to.x.linear), take(from.x.angular, to.x.angular);
        take(from.v.linear, to.v.linear), take(from.v.angular, to.v.angular);
    });
}

void stir_parted(const SoftScene& scene, double h, SoftContacts& contacts) {
    Rest& rest = contacts.rest;
    const Softness soft = softness(h, h * contacts.pace.softer);
    const auto is_still = [&](std::uint32_t row) {
        return row < rest.still.size() && (rest.still[row] > 0 || rest.calm[row] > 0);
    };
    const auto is_parted = [&](const ContactBlock& block, std::uint32_t i, std::size_t k) {
        const auto& point = block.point[i];
        const auto& more = block.more[i];
        const double loaded = soft.give * more.normal_force[k] / point.normal_mass[k];  // of no contact 0/0
        return more.open[k] == 0 && -point.gap[k] > explained_overlap(block.shallow[k], loaded);
    };
    each_row_where(
        scene.threads, contacts.layout.blocks.size(),
        [&](std::size_t number) {
            const ContactBlock& block = contacts.layout.blocks[number];
            bool any_still = false;
            for (std::size_t k = 0; k < block_rows; ++k) any_still |= is_still(block.a[k]) || is_still(block.b[k]);
            if (!any_still) return 0U;
            std::uint32_t found = 0;
            for (std::uint32_t i = 0; i < block.points; ++i)
                for (std::size_t k = 0; k < block_rows; ++k)
                    found |= static_cast<std::uint32_t>(is_parted(block, i, k)) << k;
            return found;
        },
        [&](std::size_t number, std::uint32_t k) {
            const ContactBlock& block = contacts.layout.blocks[number];
            rest.keep_awake(block.a[k]), rest.keep_awake(block.b[k]);
        });
}

void note_rest(const SoftScene& scene, const State& state, double dt, Rest& rest) {
    constexpr double nearly = 1e4;  // times as fast
    const double least = speed_at_rest(scene, dt), slow = nearly * least, most = scene.sleep_speed.value_or(least);
    // Without gravity nothing tells how slow that is, and what friction stopped keeps the rounding of its forces.
    const double hair = scene.sleeps && !scene.sleep_speed ? std::numeric_limits<double>::epsilon() / dt : 0;
    // Who turns back in the air at the end of a long step is not at rest: he would be in two of them.
    const double counted = std::min(dt, 0.5 * time_to_sleep);
    rest.moving.each_row([&](std::size_t i) {
        if (rest.asleep[i]) return;
        const Vec2 v = state.v.linear[i];
        const double w = state.v.angular[i], gyration = scene.bodies.inertia[i] / scene.bodies.mass[i];
        const double squared = dot(v, v) + gyration * w * w;
        const Vec2 x = state.x.linear[i];
        const double rounded = hair * hair * (dot(x, x) + gyration);  // so fast a step does not move it
        rest.still[i] = squared <= std::max(most * most, rounded) ? std::max(rest.still[i], 0.0) + counted : 0;
        rest.calm[i] = squared <= slow * slow ? rest.calm[i] + dt : 0;
    });
}

}  // namespace carom
