// The integrator's flight of bodies that hang on joints.

#include <algorithm>

#include "forces/gains.hpp"
#include "solvers/parts.hpp"

namespace carom {

namespace {

/// The rows that joints hold and that are awake, in their order.
Scratch<std::uint32_t> held_rows(const Mechanisms& mechanisms) {
    Scratch<std::uint32_t> rows;
    for (const Mechanism& m : mechanisms.all)
        for (const Mechanism::Part& p : m.parts)
            if (!m.is_asleep && p.inverse_mass != 0) rows.push_back(p.row);
    if (!std::is_sorted(rows.begin(), rows.end())) std::sort(rows.begin(), rows.end());
    return rows;
}

/// What joints will give each body in a substep of h.
class Ahead {
  public:
    Ahead(const SoftScene& scene, Mechanisms& mechanisms, double h, State& state, const RowRanges& moving, Rates& rates)
        : scene_(scene),
          dynamics_(scene.flight.dynamics),
          mechanisms_(mechanisms),
          h_(h),
          state_(state),
          some_(scene.may_leave_out ? &moving : nullptr),
          rates_(rates),
          gains_(state.size(), Twist{}) {}

    Guidance run() {
        constexpr auto alone = Dynamics::Wanted::accelerations;
        const auto is_forced = [this](const Mechanism& m) {
            return std::any_of(m.parts.begin(), m.parts.end(), [this](const Mechanism::Part& p) {
                return p.inverse_mass != 0 && dynamics_.varies(p.row);
            });
        };
        const auto& all = mechanisms_.all;
        if (std::none_of(all.begin(), all.end(), is_forced)) return {.rows = {}, .since = state_.time};
        dynamics_.evaluate(state_, rates_, some_, alone);
        Motion kick = rates_.acceleration;
        each([this](double& a) { a *= 0.5 * h_; }, kick);
        foresee_drifts(scene_, mechanisms_, h_, state_, kick, is_forced, gains_);
        Scratch<Twist> more = gains_;
        if (scene_.ramp_share != 0) {
            State end = end_of_drift();
            const Motion first = rates_.acceleration;
            dynamics_.evaluate(end, rates_, some_, alone);
            const auto grows = [&](const Mechanism& m) { return changes_little(m, first, rates_.acceleration); };
            each([this](double& v, double from, double to) { v += h_ * scene_.ramp_share * (to - from); }, kick, first,
                 rates_.acceleration);
            foresee_drifts(scene_, mechanisms_, h_, state_, kick, grows, more);
        }
        return guidance(more);
    }

  private:
    /// Where all are then, as fast as they are.
    State end_of_drift() const {
        State end = state_;
        end.time += h_;
        const Motion& a = rates_.acceleration;
        const auto go = [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const Vec2 half = 0.5 * h_ * a.linear[i] + gains_[i].velocity;
                const double half_turning = 0.5 * h_ * a.angular[i] + gains_[i].angular_velocity;
                end.x.linear[i] += h_ * (end.v.linear[i] + half), end.v.linear[i] += 2 * half;
                end.x.angular[i] += h_ * (end.v.angular[i] + half_turning), end.v.angular[i] += 2 * half_turning;
            }
        };
        some_ ? some_->within(0, end.size(), go) : go(0, end.size());
        return end;
    }
    /// Whether forces go on in a mechanism as they began. What free bodies do to it in a flight in which they are stiff
    /// is not known from there.
    bool changes_little(const Mechanism& m, const Motion& first, const Motion& last) const {
        constexpr double much = 4;
        double there = 0, change = 0;
        for (const Mechanism::Part& p : m.parts) {
            if (p.inverse_mass == 0) continue;
            const double mass = dynamics_.mass()[p.row], inertia = dynamics_.inertia()[p.row];
            const double turned = first.angular[p.row], turns = last.angular[p.row] - turned;
            there += mass * squared_length(first.linear[p.row] - dynamics_.gravity()) + inertia * turned * turned;
            change += mass * squared_length(last.linear[p.row] - first.linear[p.row]) + inertia * turns * turns;
        }
        return there > 0 && change <= much * much * there;
    }
    /// `more`: what joints give if forces change as they do.
    Guidance guidance(const Scratch<Twist>& more) const {
        Guidance to;
        to.since = state_.time;
        const double mean = 2 / h_, growth = scene_.ramp_share == 0 ? 0 : 1 / (scene_.ramp_share * h_ * h_);
        for (const std::uint32_t i : held_rows(mechanisms_)) {
            const Twist &at_first = gains_[i], &all = more[i];
            Guidance::Row row{i, mean * at_first.velocity, growth * (all.velocity - at_first.velocity), 0, 0};
            if (dynamics_.turns()) {
                row.angular = mean * at_first.angular_velocity;
                row.angular_growth = growth * (all.angular_velocity - at_first.angular_velocity);
            }
            to.rows.push_back(row);
        }
        return to;
    }

    const SoftScene& scene_;
    const Dynamics& dynamics_;
    Mechanisms& mechanisms_;
    const double h_;
    State& state_;
    const RowRanges* const some_;
    Rates& rates_;
    Scratch<Twist> gains_;
};

/// Takes back what that gave, places and velocities.
void take_back(const SoftScene& scene, const Guidance& guidance, double h, State& state) {
    Gains gains(scene.flight.dynamics);
    const double ramp = scene.ramp_share * h * h;
    for (const Guidance::Row& r : guidance.rows) {
        const std::uint32_t i = r.row;
        Vec2 &x = state.x.linear[i], &v = state.v.linear[i];
        double &angle = state.x.angular[i], &w = state.v.angular[i];
        const Vec2 dv = -h * (r.linear + 0.5 * h * r.growth), dx = -h * (0.5 * h * r.linear + ramp * r.growth);
        const double dw = -h * (r.angular + 0.5 * h * r.angular_growth);
        gains.add(i, x, v, w, dx, dv, dw);
        x += dx, v += dv, angle -= h * (0.5 * h * r.angular + ramp * r.angular_growth), w += dw;
    }
    gains.book(state.account);
}

}  // namespace

void propose_held(const SoftScene& scene, Mechanisms& mechanisms, double h, State& state, const RowRanges& moving,
                  Rates& rates) {
    const Dynamics& dynamics = scene.flight.dynamics;
    if (mechanisms.all_sleep() || !dynamics.varies() || !gives_halves(scene)) return scene.flight.propose(state, h);
    const Guidance guidance = Ahead(scene, mechanisms, h, state, moving, rates).run();
    {
        const Guided guided(dynamics, guidance);
        scene.flight.propose(state, h);
    }
    take_back(scene, guidance, h, state);
}

}  // namespace carom
