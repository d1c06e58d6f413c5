#include <algorithm>

#include "solvers/paths.hpp"
#include "solvers/time_of_impact.hpp"

namespace carom {

namespace {

struct FirstImpact {
    double time;
    Contact pair;
};

/// A step in which the whole world flies from impact to impact.
class FlightUnderForces {
  public:
    FlightUnderForces(const Impulse& solver, const Flight& flight, const Walls& walls, const Bodies& bodies,
                      State& state, double h, Contacts& contacts)
        : solver_(solver),
          flight_(flight),
          walls_(walls),
          bodies_(bodies),
          state_(state),
          h_(h),
          contacts_(contacts),
          squeezed_(bodies),
          paths_(state.size()) {}

    void run() {
        double left = h_;
        for (std::size_t impacts = 0; left > 0; ++impacts) {
            const State before = state_;
            const Memory remembered = flight_.memory;
            flight_.propose(state_, left);
            if (!flight_.dynamics.is_finite(state_)) return;  // there is no path along which to look; the world says so
            for (std::size_t i = 0; i < paths_.size(); ++i)
                paths_[i] =
                    hermite(before.x.linear[i], before.v.linear[i], state_.x.linear[i], state_.v.linear[i], left);
            const auto hit = first_impact(left);
            if (!hit) break;

            state_ = before;
            flight_.memory = remembered;
            if (hit->time > 0) flight_.propose(state_, hit->time);
            left -= hit->time;
            bounce(*hit, h_ - left, impacts / (state_.size() + 1));
            flight_.memory.continues = false;
        }
        if (resting_.empty()) return;
        settle_resting(resting_, solver_, walls_, bodies_, flight_.dynamics.gravity(), state_, contacts_);
        flight_.memory.continues = false;
    }

  private:
    /// The earliest impact of all on the paths, ties by the order of pairs; pairs at rest do not count.
    std::optional<FirstImpact> first_impact(double end) {
        std::optional<FirstImpact> first;
        const auto consider = [&](const std::optional<double>& time, const Contact& pair) {
            if (!time || (first && *time >= first->time)) return;
            if (std::find(resting_.begin(), resting_.end(), pair) == resting_.end()) first = FirstImpact{*time, pair};
        };
        // Next to the roots of polynomials a glance costs nothing, and does for most once an early impact is known.
        const auto until = [&] { return first ? first->time : end; };
        const auto n = static_cast<std::uint32_t>(paths_.size());
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t w = 0; bodies_.inverse_mass[i] != 0 && w < walls_.all.size(); ++w)
                if (!stay_apart(paths_[i], bodies_.radius[i], walls_.all[w], 0, until()))
                    consider(first_touch(paths_[i], bodies_.radius[i], walls_.all[w], 0, end), {i, i, w});
        if (!solver_.disc_collisions) return first;

        std::vector<Vec2> centre(n);
        std::vector<double> radius(n);
        for (std::uint32_t i = 0; i < n; ++i) {
            const Reach r = reach(paths_[i], end);
            centre[i] = r.centre;
            radius[i] = r.radius + bodies_.radius[i];
        }
        contacts_.grid.build(centre, radius, walls_.periodic);
        for (std::uint32_t i = 0; i < n; ++i) {
            contacts_.candidates.clear();
            contacts_.grid.near(centre[i], radius[i], contacts_.candidates);
            std::sort(contacts_.candidates.begin(), contacts_.candidates.end());
            for (const std::uint32_t j : contacts_.candidates) {
                const double distance = bodies_.radius[i] + bodies_.radius[j];
                if (j <= i || distance == 0 || (bodies_.inverse_mass[i] == 0 && bodies_.inverse_mass[j] == 0)) continue;
                if (!stay_apart(paths_[i], paths_[j], distance, 0, until(), walls_.periodic))
                    consider(first_touch(paths_[i], paths_[j], distance, 0, end, walls_.periodic), {i, j});
            }
        }
        return first;
    }

    /// Lets a pair bounce, or come to rest, at a time [s] of the step.
    void bounce(const FirstImpact& hit, double time, std::size_t impacts) {
        const auto [i, j, wall] = hit.pair;
        const bool at_wall = wall != Contact::no_wall;
        const Touch touch = touch_of(hit.pair, walls_, bodies_, state_);
        const double approach = dot(state_.v.linear[i] - (at_wall ? Vec2{} : state_.v.linear[j]), touch.normal);
        const Vec2 a = paths_[i].acceleration(hit.time), b = at_wall ? Vec2{} : paths_[j].acceleration(hit.time);
        const double press = std::max(length(a), length(b));
        const double distance = bodies_.radius[i] + bodies_.radius[at_wall ? i : j];
        double pull = dot(a - b, touch.normal);
        if (!at_wall) pull = pull_of(pull, touch.restitution, press, distance, h_);
        const Bounce how{touch.restitution, approach, pull, distance};
        const bool jams = squeezed_.hold(hit.pair, touch.normal, how, time, bodies_, state_, impacts);
        const bool rests = jams || comes_to_rest(how, h_, impacts);
        if (!(rests && (jams || impacts > most_inelastic)) && ends_rest(approach, press, distance, h_))
            std::erase_if(resting_,
                          [i = i, j = j](const Contact& c) { return c.i == i || c.j == i || c.i == j || c.j == j; });
        if (rests) resting_.push_back(hit.pair);
        if (approach <= 0) return;
        if (rests)
            bring_to_rest(hit.pair, touch, walls_, bodies_, state_);
        else
            collide(hit.pair, touch, bodies_, state_);
        ++contacts_.collisions;
    }

    const Impulse& solver_;
    const Flight& flight_;
    const Walls& walls_;
    const Bodies& bodies_;
    State& state_;
    const double h_;
    Contacts& contacts_;
    Squeezed squeezed_;

    std::vector<Path> paths_;  ///< of what is left of the step
    std::vector<Contact> resting_{};
};

}  // namespace

void fly_under_forces(const Impulse& solver, const Flight& flight, const Walls& walls, const Bodies& bodies,
                      State& state, double h, Contacts& contacts) {
    FlightUnderForces(solver, flight, walls, bodies, state, h, contacts).run();
}

}  // namespace carom
