#include <algorithm>
#include <queue>

#include "solvers/paths.hpp"
#include "solvers/time_of_impact.hpp"

namespace carom {

namespace {

/// An impact to come, or (pair.i == pair.j without a wall) the moment at which a body at rest on a wall stops slipping.
struct Event {
    double time;
    Contact pair;
    std::uint32_t version_i, version_j;

    bool operator>(const Event& other) const {
        return std::tie(time, pair.i, pair.j, pair.wall) >
               std::tie(other.time, other.pair.i, other.pair.j, other.pair.wall);
    }
};

/// Bodies that fly on parabolas from impact to impact, each with a clock of its own, through one step.
class FreeFlight {
  public:
    FreeFlight(const Impulse& solver, const Walls& walls, const Bodies& bodies, const Motion& acceleration,
               State& state, double h, Contacts& contacts)
        : solver_(solver),
          walls_(walls),
          bodies_(bodies),
          free_(acceleration),
          state_(state),
          h_(h),
          contacts_(contacts),
          squeezed_(bodies) {
        const std::size_t n = state.size();
        path_.resize(n);
        version_.resize(n);
        impacts_.resize(n);
        support_.resize(n);
        centre_.resize(n);
        radius_.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) set_out(i, free_.linear[i]);
    }

    /// Runs all impacts up to the end of the step; afterwards state holds the bodies that had any at its end.
    void run() {
        if (solver_.disc_collisions) contacts_.grid.build(centre_, radius_, walls_.periodic);
        for (std::uint32_t i = 0; i < path_.size(); ++i) foresee(i, true);
        while (!events_.empty()) {
            const Event event = events_.top();
            events_.pop();
            if (event.version_i != version_[event.pair.i] || event.version_j != version_[event.pair.j]) continue;
            happen(event);
        }
        for (std::uint32_t i = 0; i < path_.size(); ++i)
            if (impacts_[i] > 0) bring_to(i, h_);
    }

    bool touched(std::size_t i) const { return impacts_[i] > 0; }
    bool touched() const {
        return std::any_of(impacts_.begin(), impacts_.end(), [](std::uint32_t n) { return n > 0; });
    }
    /// Pairs of discs that came to rest on one another.
    std::vector<Contact> resting() const {
        std::vector<Contact> pairs;
        for (std::uint32_t i = 0; i < support_.size(); ++i)
            for (const std::uint32_t j : support_[i].discs)
                if (i < j) pairs.push_back({i, j});
        return pairs;
    }

  private:
    /// What carries a body, and how it rubs on its wall.
    struct Support {
        std::vector<std::uint32_t> walls, discs;
        double friction_force = 0, spin_acceleration = 0;
        Vec2 along{};
    };

    /// Starts a new parabola of body i at its clock, from where the state has it.
    void set_out(std::uint32_t i, Vec2 acceleration) {
        path_[i] = parabola(path_[i].start, state_.x.linear[i], state_.v.linear[i], acceleration);
        const Reach r = reach(path_[i], h_);
        centre_[i] = r.centre;
        radius_[i] = r.radius + bodies_.radius[i];
    }

    /// Moves body i along its parabola to a time.
    void bring_to(std::uint32_t i, double time) {
        Path& p = path_[i];
        const Support& support = support_[i];
        const double t = time - p.start;
        book(i, t);
        state_.x.linear[i] = p.position(time);
        state_.v.linear[i] = p.velocity(time);
        state_.x.angular[i] += t * (state_.v.angular[i] + 0.5 * t * support.spin_acceleration);
        state_.v.angular[i] += t * support.spin_acceleration;
        p.start = time;
    }

    /// What gravity and the walls that carry body i do to it in a time t from its clock on.
    void book(std::uint32_t i, double t) {
        const Path& p = path_[i];
        const Support& support = support_[i];
        const double m = bodies_.mass[i];
        if (bodies_.inverse_mass[i] == 0) return;
        const Vec2 x = state_.x.linear[i], v = state_.v.linear[i], a = p.acceleration(p.start);
        const Vec2 gravity = free_.linear[i], carried = a - gravity;
        Flows& account = state_.account;
        account[Account::gravity] += m * t * dot(gravity, v + 0.5 * t * a);
        const Vec2 way = t * (x + t * (0.5 * v + t / 6 * a));  // the integral of the place over time
        account[Giver::gravity].add(m * t * gravity, m * cross(way, gravity));
        if (carried == Vec2{} && support.friction_force == 0) return;
        account[Giver::walls].add(m * t * carried,
                                  m * cross(way, carried) + bodies_.inertia[i] * t * support.spin_acceleration);
        const double spin = bodies_.radius[i] * support.spin_acceleration;
        const double slid = t * (slip(i) + 0.5 * t * (dot(a, support.along) + spin));
        account[Account::friction] += support.friction_force * slid;
        // Who keeps its spin takes it from what drives it.
        if (bodies_.inverse_inertia[i] == 0)
            account[Account::driven] += t * support.friction_force * bodies_.radius[i] * state_.v.angular[i];
    }

    double slip(std::uint32_t i) const {
        return dot(state_.v.linear[i], support_[i].along) + bodies_.radius[i] * state_.v.angular[i];
    }

    void foresee(std::uint32_t i, bool later_only) {
        const double now = path_[i].start;
        if (bodies_.inverse_mass[i] != 0) {
            for (std::uint32_t w = 0; w < walls_.all.size(); ++w) {
                const auto& carried = support_[i].walls;
                if (std::find(carried.begin(), carried.end(), w) != carried.end()) continue;
                if (const auto t = first_touch(path_[i], bodies_.radius[i], walls_.all[w], now, h_))
                    expect(*t, {i, i, w});
            }
        }
        if (!solver_.disc_collisions) return;
        auto& near = contacts_.candidates;
        near.clear();
        contacts_.grid.near(centre_[i], radius_[i], near);
        for (const std::uint32_t j : near) {
            if (j == i || (later_only && j < i) || (bodies_.inverse_mass[i] == 0 && bodies_.inverse_mass[j] == 0))
                continue;
            const double distance = bodies_.radius[i] + bodies_.radius[j];
            const Vec2 apart = nearest_image(walls_.periodic, centre_[j] - centre_[i]);
            const double far = radius_[i] + radius_[j];
            if (distance == 0 || squared_length(apart) > far * far) continue;
            const Contact pair{std::min(i, j), std::max(i, j)};
            if (rest_on_one_another(i, j)) continue;
            const double from = std::max(now, path_[j].start);
            if (const auto t = first_touch(path_[pair.i], path_[pair.j], distance, from, h_, walls_.periodic))
                expect(*t, pair);
        }
    }

    void expect(double time, const Contact& pair) { events_.push({time, pair, version_[pair.i], version_[pair.j]}); }

    void happen(const Event& event) {
        const auto [i, j, wall] = event.pair;
        bring_to(i, event.time);
        ++version_[i];
        let_go(i);
        if (i == j && wall == Contact::no_wall) {  // it stopped slipping
            depart(i, true);
            return foresee(i, false);
        }
        ++impacts_[i];
        if (wall != Contact::no_wall) return hit_wall(i, wall);
        bring_to(j, event.time);
        ++version_[j];
        ++impacts_[j];
        hit_disc(event.pair);
    }

    bool rest_on_one_another(std::uint32_t i, std::uint32_t j) const {
        const auto& discs = support_[i].discs;
        return std::find(discs.begin(), discs.end(), j) != discs.end();
    }

    /// Body i was struck, and no disc rests on it any more, if the blow was hard.
    void wake(std::uint32_t i, const Bounce& blow) {
        if (!ends_rest(blow.approach, length(free_.linear[i]), blow.size, h_)) return;
        for (const std::uint32_t j : support_[i].discs) std::erase(support_[j].discs, i);
        support_[i].discs.clear();
    }

    void hit_wall(std::uint32_t i, std::uint32_t w) {
        Touch touch = touch_of({i, i, w}, walls_, bodies_, state_);
        const double approach = dot(state_.v.linear[i], touch.normal), pull = dot(free_.linear[i], touch.normal);
        const Bounce bounce{touch.restitution, approach, pull, 2 * bodies_.radius[i]};
        const double now = path_[i].start;
        const bool jams = squeezed_.hold({i, i, w}, touch.normal, bounce, now, bodies_, state_, impacts_[i]);
        const bool rests = jams || comes_to_rest(bounce, h_, impacts_[i]);
        if (rests) touch.restitution = 0;
        if (!(rests && (jams || impacts_[i] > most_inelastic))) wake(i, bounce);
        if (approach > 0) carom::collide(i, touch, bodies_, state_);
        contacts_.collisions += approach > std::max(0.0, 1e-9 * h_ * pull);  // less is a touch of one at rest
        if (rests) {
            state_.v.linear[i] -= dot(state_.v.linear[i], touch.normal) * touch.normal;
            support_[i].walls.push_back(w);
            come_to_corner(i, w);
        } else {
            support_[i].walls.clear();
        }
        depart(i, false);
        foresee(i, false);
    }

    /// Speeds along a normal below this are rounding.
    double still(std::uint32_t i) const {
        return std::max(1e-9 * h_ * length(free_.linear[i]), 1e-12 * length(state_.v.linear[i]));
    }
    /// The walls that body i has left do not carry it any more.
    void let_go(std::uint32_t i) {
        std::erase_if(support_[i].walls,
                      [&](std::uint32_t w) { return dot(state_.v.linear[i], walls_.all[w].normal) > still(i); });
    }

    /// Body i came to rest on wall `last`. From the others on which it rested it slides away now, or it strikes them
    /// next: if they carried it on they would do work. It is caught if it would be back at once, or if the two would
    /// throw it to and fro without a bounce, as walls do that make less than 90°.
    void come_to_corner(std::uint32_t i, std::uint32_t last) {
        const Vec2 v = state_.v.linear[i];
        const Vec2 on = walls_.all[last].normal, free = free_.linear[i];
        const Vec2 along = free - std::min(0.0, dot(free, on)) * on;
        const auto is_back = [&](double speed, double pull) {
            return impacts_[i] > most_inelastic || 2 * speed <= shortest_flight * h_ * pull;
        };
        const double size = 2 * bodies_.radius[i];
        bool caught = false;
        std::erase_if(support_[i].walls, [&](std::uint32_t w) {
            const Touch touch = touch_of({i, i, w}, walls_, bodies_, state_);
            const double approach = dot(v, touch.normal), pull = dot(free, touch.normal);
            if (w == last || std::abs(approach) <= still(i)) return false;
            const bool stays = approach < 0
                                   ? is_back(-approach, dot(along, touch.normal))
                                   : dot(touch.normal, on) >= 0 &&
                                         comes_to_rest({touch.restitution, approach, pull, size}, h_, impacts_[i]);
            caught |= stays;
            return !stays;
        });
        if (caught) stop(i);
    }
    void stop(std::uint32_t i) {
        Vec2& v = state_.v.linear[i];
        const double m = bodies_.mass[i];
        state_.account[Account::impact] += 0.5 * m * squared_length(v);
        state_.account[Giver::walls].add_at(state_.x.linear[i], -m * v);
        v = {};
    }

    void hit_disc(const Contact& pair) {
        const auto [i, j, no_wall] = pair;
        const Touch touch = touch_of(pair, walls_, bodies_, state_);
        const Vec2 v = state_.v.linear[i] - state_.v.linear[j];
        const Vec2 a = path_[i].acceleration(0) - path_[j].acceleration(0);
        const double approach = dot(v, touch.normal);
        const double distance = bodies_.radius[i] + bodies_.radius[j];
        const double pull = pull_of(dot(a, touch.normal), touch.restitution, length(free_.linear[i]), distance, h_);
        const std::size_t impacts = std::min(impacts_[i], impacts_[j]);
        const Bounce bounce{touch.restitution, approach, pull, distance};
        const double now = path_[i].start;
        const bool jams = squeezed_.hold(pair, touch.normal, bounce, now, bodies_, state_, impacts);
        const bool rests = jams || comes_to_rest(bounce, h_, impacts);
        if (approach > 1e-9 * h_ * std::max(0.0, dot(a, touch.normal))) {
            if (rests)
                bring_to_rest(pair, touch, walls_, bodies_, state_);
            else
                carom::collide(i, j, touch, bodies_, state_);
            ++contacts_.collisions;
        }
        for (const std::uint32_t k : {i, j}) {
            support_[k].walls.clear();
            if (!(rests && (jams || impacts > most_inelastic))) wake(k, bounce);
        }
        if (rests) {
            support_[i].discs.push_back(j);
            support_[j].discs.push_back(i);
        }
        for (const std::uint32_t k : {i, j}) depart(k, false);
        for (const std::uint32_t k : {i, j}) foresee(k, false);  // once both are on their new ways
    }

    /// Whether an acceleration leads into none of the walls on which body i rests.
    bool leads_into_none(std::uint32_t i, Vec2 a) const {
        const auto& on = support_[i].walls;
        const double rounding = 1e-9 * length(free_.linear[i]);
        return std::none_of(on.begin(), on.end(),
                            [&](std::uint32_t w) { return dot(a, walls_.all[w].normal) < -rounding; });
    }

    /// Sends body i on its way: freely, or along the wall that carries it, or not at all if it is wedged between two.
    void depart(std::uint32_t i, bool stopped_slipping) {
        Support& support = support_[i];
        support.friction_force = support.spin_acceleration = 0;
        set_out(i, carried(i, stopped_slipping));
        if (solver_.disc_collisions) contacts_.grid.move(i, centre_[i], radius_[i]);
    }
    Vec2 carried(std::uint32_t i, bool stopped_slipping) {
        const Vec2 free = free_.linear[i];
        if (leads_into_none(i, free)) return free;
        for (const std::uint32_t w : support_[i].walls) {
            const Vec2 n = walls_.all[w].normal, along = free - std::min(0.0, dot(free, n)) * n;
            if (!leads_into_none(i, along)) continue;
            const Vec2 rubbed = rub(i, walls_.all[w], along, stopped_slipping);
            if (leads_into_none(i, rubbed)) return rubbed;
            support_[i].friction_force = support_[i].spin_acceleration = 0;
        }
        stop(i);  // what is left of its velocity is rounding, on which two walls would work
        return {};
    }

    /// Coulomb's friction on a body that a wall carries: its acceleration along the wall.
    Vec2 rub(std::uint32_t i, const Wall& wall, Vec2 a, bool stopped_slipping) {
        const double mu = mixed_friction(bodies_, wall.friction, bodies_.friction[i]);
        if (mu == 0) return a;
        Support& support = support_[i];
        support.along = perpendicular(-wall.normal);
        const double most = mu * bodies_.mass[i] * -dot(free_.linear[i], wall.normal);
        const double r = bodies_.radius[i], easiness = bodies_.inverse_mass[i] + r * r * bodies_.inverse_inertia[i];
        const double slip = this->slip(i), drive = dot(a, support.along), holding = drive / easiness;
        // Slower than what gravity gives in a billionth of a step is rounding.
        const bool slips = !stopped_slipping && std::abs(slip) > 1e-9 * h_ * length(free_.linear[i]);
        double force = std::clamp(holding, -most, most);
        if (slips) {
            force = slip > 0 ? most : -most;
            const double rate = drive - force * easiness;
            if (slip * rate < 0 && path_[i].start - slip / rate < h_) expect(path_[i].start - slip / rate, {i, i});
        }
        support.friction_force = force;
        support.spin_acceleration = -r * force * bodies_.inverse_inertia[i];
        return a - force * bodies_.inverse_mass[i] * support.along;
    }

    const Impulse& solver_;
    const Walls& walls_;
    const Bodies& bodies_;
    const Motion& free_;
    State& state_;
    const double h_;
    Contacts& contacts_;
    Squeezed squeezed_;

    std::vector<Path> path_;
    std::vector<std::uint32_t> version_, impacts_;
    std::vector<Support> support_;
    std::vector<Vec2> centre_;
    std::vector<double> radius_;
    std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
};

/// What gravity did to a body that an integrator moved freely, from place x and velocity v on. Every method gives it
/// the impulse m g h, and its own error in the place: the work is g times the mean velocity, and what the place makes
/// of that is seen in the potential.
void book_fall(double m, Vec2 gravity, double h, Vec2 x, Vec2 v, Vec2 end, Flows& account) {
    const Vec2 mean = v + 0.5 * h * gravity;
    account[Account::gravity] += m * h * dot(gravity, mean);
    account[Giver::gravity].add(m * h * gravity, m * h * cross(0.5 * (x + end), gravity));
    account[Giver::method].torque += m * cross(end - x, mean);
}

}  // namespace

void fly_freely(const Impulse& solver, const Flight& flight, const Walls& walls, const Bodies& bodies, State& state,
                double h, Contacts& contacts) {
    State bouncing = state;
    flight.propose(state, h);
    Rates rates;
    flight.dynamics.evaluate(bouncing, rates);
    FreeFlight free(solver, walls, bodies, rates.acceleration, bouncing, h, contacts);
    free.run();
    if (!free.touched()) return;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (!free.touched(i)) {
            if (bodies.inverse_mass[i] != 0)
                book_fall(bodies.mass[i], flight.dynamics.gravity(), h, bouncing.x.linear[i], bouncing.v.linear[i],
                          state.x.linear[i], bouncing.account);
            continue;
        }
        state.x.linear[i] = bouncing.x.linear[i];
        state.x.angular[i] = bouncing.x.angular[i];
        state.v.linear[i] = bouncing.v.linear[i];
        state.v.angular[i] = bouncing.v.angular[i];
    }
    state.account = bouncing.account;
    settle_resting(free.resting(), solver, walls, bodies, flight.dynamics.gravity(), state, contacts);
    flight.memory.continues = false;
}

}  // namespace carom
