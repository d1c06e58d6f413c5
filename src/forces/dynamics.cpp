#include "forces/dynamics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "forces/network_text.hpp"
#include "forces/parts.hpp"
#include "math/slope.hpp"
#include "state/rows_text.hpp"

namespace carom {

void Forces::forget_removed(const Bodies& bodies) {
    const auto forget = [&](auto&... forces) {
        (forces.erase_if([&](const auto& force) { return is_left(force, bodies); }), ...);
    };
    forget(springs, torsion_springs, drags, fields, constant_forces);
    std::erase_if(drives, [&](const Drive& d) {
        return !bodies.contains(d.body) || bodies.kind[bodies.row(d.body)] != Kind::driven;
    });
}

namespace {

/// Whether a spring is one of the network's.
bool joins_centres(const Spring& s) {
    return s.anchor_a == Vec2{} && s.anchor_b == Vec2{} && (s.damping == 0 || s.damping_law == DampingLaw::along);
}

}  // namespace

Dynamics::Dynamics(const Forces& forces, const Bodies& bodies, int threads, const std::optional<Periodic>& box)
    : threads_(threads),
      gravity_(forces.gravity),
      kind_(bodies.kind),
      given_mass_(bodies.mass),
      mass_(bodies.mass),
      inertia_(bodies.inertia),
      inverse_mass_(bodies.inverse_mass),
      inverse_inertia_(bodies.inverse_inertia),
      user_forces_(forces.user_forces.begin(), forces.user_forces.end()) {
    const auto row = [&](BodyId id) { return static_cast<Row>(bodies.row(id)); };
    const auto first = [&](const std::optional<BodyId>& id) { return id ? row(*id) : 0; };
    const auto last = [&](const std::optional<BodyId>& id) {
        return id ? row(*id) + 1 : static_cast<Row>(bodies.size());
    };

    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (inverse_mass_[i] == 0) mass_[i] = 0;
        if (inverse_inertia_[i] == 0) inertia_[i] = 0;
    }
    for (const Drive& d : forces.drives) placed_.push_back({bodies.row(d.body), d.curve});
    std::vector<Link> links;
    links.reserve(forces.springs.size());
    for (const Spring& s : forces.springs) {
        if (joins_centres(s))
            links.push_back({row(s.a), row(s.b), s.stiffness, s.rest_length, s.damping});
        else
            springs_.push_back(
                {row(s.a), row(s.b), s.stiffness, s.rest_length, s.damping, s.damping_law, s.anchor_a, s.anchor_b});
        sees_velocity_ |= s.damping != 0;
    }
    for (const Link& l : links) reach_ = std::max<std::size_t>(reach_, l.a > l.b ? l.a - l.b : l.b - l.a);
    network_ = SpringNetwork(links, bodies.size());
    for (const TorsionSpring& s : forces.torsion_springs) {
        torsion_springs_.push_back({row(s.a), row(s.b), s.stiffness, s.rest_angle, s.damping});
        sees_velocity_ |= s.damping != 0;
    }
    for (const Drag& d : forces.drags)
        drags_.push_back({first(d.body), last(d.body), d.linear, d.quadratic, d.angular, d.wind});
    for (const ConstantForce& f : forces.constant_forces) {
        constant_forces_.push_back({row(f.body), f.force, f.point, f.torque});
        needs_velocity_ |= f.torque != 0;
    }
    for (const ForceField& f : forces.fields) fields_.push_back({first(f.body), last(f.body), f.force, f.potential});
    take_pair_forces(forces, bodies, box);
    const auto is_linear = [](const DragRow& d) { return d.quadratic == 0; };
    sees_velocity_ |= std::any_of(drags_.begin(), drags_.end(), is_linear) || !fields_.empty() || !user_forces_.empty();
    needs_velocity_ |=
        sees_velocity_ || !drags_.empty() || std::find(kind_.begin(), kind_.end(), Kind::driven) != kind_.end();
    others_ = !(springs_.empty() && torsion_springs_.empty() && drags_.empty() && attractions_.empty() &&
                constant_forces_.empty() && fields_.empty() && user_forces_.empty());
    turns_ = !(springs_.empty() && torsion_springs_.empty() && drags_.empty() && constant_forces_.empty() &&
               user_forces_.empty());
    for (std::size_t i = 0; turns_ && i < inertia_.size(); ++i)
        turns_points_ |= kind_[i] == Kind::dynamic && inertia_[i] == 0;
    note_varied(links);
    few_ = are_few(bodies.size());
    bound_ = bound_stiffness(links);
}

void Dynamics::note_varied(const std::vector<Link>& links) {
    const bool all = !(attractions_.empty() && soft_discs_.empty() && user_forces_.empty());
    varied_.assign(mass_.size(), all);
    const auto note_pairs = [this](const auto& pairs) {
        for (const auto& p : pairs) varied_[p.a] = varied_[p.b] = true;
    };
    note_pairs(links), note_pairs(springs_), note_pairs(torsion_springs_);
    const auto note_ranges = [this](const auto& ranges) {
        for (const auto& r : ranges)
            for (Row i = r.first; i < r.last; ++i) varied_[i] = true;
    };
    note_ranges(drags_), note_ranges(fields_);
    for (const auto& f : constant_forces_)
        if (f.point != Vec2{}) varied_[f.body] = true;
    varies_ = std::find(varied_.begin(), varied_.end(), true) != varied_.end();
}

void Dynamics::take_pair_forces(const Forces& forces, const Bodies& bodies, const std::optional<Periodic>& box) {
    std::vector<bool> moves(bodies.size());
    for (std::size_t i = 0; i < moves.size(); ++i) moves[i] = kind_[i] != Kind::fixed;
    for (const Attraction& a : forces.attractions) {
        const bool masses = a.couples == Couples::mass;
        attractions_.push_back({masses ? a.strength : -a.strength,
                                a.law,
                                a.softening * a.softening,
                                masses ? bodies.mass : bodies.charge,
                                {moves.begin(), moves.end()}});
    }
    std::vector<double> radius = bodies.radius;
    for (std::size_t i = 0; i < radius.size(); ++i)
        if (!bodies.shapes[i].empty()) radius[i] = 0;
    for (const SoftDiscs& d : forces.soft_discs) {
        soft_discs_.emplace_back(d, radius, inverse_mass_, moves, box);
        sees_velocity_ |= d.damping != 0;
    }
}

bool Dynamics::is_free_flight() const { return feels_nothing() && placed_.empty(); }

void Dynamics::look_around(const State& state) const {
    for (SoftDiscRows& discs : soft_discs_) discs.look_around(state, threads_);
}

namespace {

/// A curve that is asked once for each time: the differences of its three components look at the same ones.
class AskedOnce {
  public:
    explicit AskedOnce(const std::function<Pose(double)>& curve) : curve_(curve) {}
    Pose operator()(double t) {
        for (std::size_t k = 0; k < count_; ++k)
            if (times_[k] == t) return poses_[k];
        const Pose pose = curve_(t);
        if (count_ < most) times_[count_] = t, poses_[count_] = pose, ++count_;
        return pose;
    }

  private:
    static constexpr std::size_t most = 16;  // of a curve that needs a closer look there are more
    const std::function<Pose(double)>& curve_;
    std::array<double, most> times_{};
    std::array<Pose, most> poses_{};
    std::size_t count_ = 0;
};

}  // namespace

OnCurve on_curve(const std::function<Pose(double)>& curve, double time) {
    AskedOnce asked(curve);
    const auto rate = [&](auto component) { return slope([&](double t) { return component(asked(t)); }, time); };
    return {.pose = asked(time),
            .velocity = {rate([](Pose q) { return q.position.x; }), rate([](Pose q) { return q.position.y; })},
            .angular_velocity = rate([](Pose q) { return q.angle; })};
}

void put(const OnCurve& on, std::size_t row, State& state) {
    state.x.linear[row] = on.pose.position, state.x.angular[row] = on.pose.angle;
    state.v.linear[row] = on.velocity, state.v.angular[row] = on.angular_velocity;
}

void Dynamics::place_driven(State& state) const {
    for (const PlacedRow& p : placed_) put(on_curve(p.curve, state.time), p.row, state);
}

namespace {

/// Flows{} would be filled by an instruction that takes longer than a force (with g++ 12).
void clear_wrenches(Flows& flow) {
    for (Wrench& wrench : flow.wrench) wrench = {};
}
void clear(Flows& flow) {
    for (double& power : flow.power) power = 0;
    clear_wrenches(flow);
}

void add(const NetworkPowers& powers, Flows& flow) {
    flow[Account::spring] += powers.elastic;
    flow[Account::damping] += powers.damping;
}

}  // namespace

template <class Sum, class Work>
void Dynamics::add_over(const RowRanges* some, std::size_t rows, Sum& total, const Work& work) const {
    if (!some) return add_over_rows(threads_, rows, total, work);
    const int threads = some->count() > rows_at_once ? threads_ : 1;
    add_over_rows(threads, rows, total, [&](std::size_t first, std::size_t last, Sum& sum) {
        some->within(first, last, [&](std::size_t from, std::size_t to) { work(from, to, sum); });
    });
}

void Dynamics::evaluate_many(State& state, Rates& rates, const RowRanges* some, Wanted wanted) const {
    if (others_) {
        add_up(state, rates, wanted, some);
        return accelerate(state, rates, wanted, some);
    }
    // What acts on a block of rows alone is done with while the block is in the cache.
    begin(state, rates, wanted);
    add_over(some, state.size(), rates.flow, [&](std::size_t first, std::size_t last, Flows& flow) {
        const Block block = block_of(rates.acceleration, first, last);
        write_forces_between(state, block, flow);
        accelerate(state, block, flow, wanted);
    });
}

Dynamics::Kicked Dynamics::evaluate_and_kick(double h, State& state, Rates& rates, Keep keep) const {
    if (others_ || needs_velocity_ || guidance_) {
        evaluate(state, rates);
        return kick(rates.acceleration, h, state);
    }
    struct Sum {
        Flows flow, gained;
        bool finite = true;
        Motion scratch;
        void operator+=(const Sum& other) { flow += other.flow, gained += other.gained, finite &= other.finite; }
    };
    look_around(state);
    const bool kept = keep == Keep::accelerations || state.size() <= rows_at_once;
    if (kept) rates.acceleration.resize(state.size());
    Sum sum;
    add_over(some_, state.size(), sum, [&](std::size_t first, std::size_t last, Sum& part) {
        if (!kept) part.scratch.linear.resize(rows_at_once);
        Motion& motion = kept ? rates.acceleration : part.scratch;
        const std::size_t start = kept ? first : 0, size = last - first;
        if (kept) std::fill_n(motion.angular.begin() + first, size, 0.0);
        const Block block{first, last, motion.linear.data() + start, nullptr};  // springs of the network turn nobody
        write_forces_between(state, block, part.flow);
        accelerate(state, block, part.flow);
        part.finite &= kick(first, last, block.linear, {}, h, state, part.gained);
    });
    rates.flow = sum.flow;
    return {sum.gained, sum.finite};
}

[[gnu::always_inline]] inline void Dynamics::begin(State& state, Rates& rates, Wanted wanted) const {
    if (!placed_.empty()) place_driven(state);
    if (!soft_discs_.empty()) look_around(state);
    if (rates.acceleration.size() != state.size()) rates.acceleration.resize(state.size());
    if (wanted == Wanted::all) clear(rates.flow);
    if (wanted == Wanted::wrenches) clear_wrenches(rates.flow);
}

void Dynamics::add_up(State& state, Rates& rates, Wanted wanted, const RowRanges* some) const {
    begin(state, rates, wanted);
    add_over(some, state.size(), rates.flow, [&](std::size_t first, std::size_t last, Flows& flow) {
        write_forces_between(state, block_of(rates.acceleration, first, last), flow);
    });
    if (others_) add_others(state, rates, some);
}

void Dynamics::add_others(const State& state, Rates& rates, const RowRanges* some) const {
    Loads loads{rates.acceleration.linear, rates.acceleration.angular, rates.flow, some};
    if (!springs_.empty()) add_loads(springs_, state, loads);
    if (!torsion_springs_.empty()) add_loads(torsion_springs_, state, loads);
    if (!drags_.empty()) add_loads(drags_, inverse_mass_, state, loads);
    if (!attractions_.empty()) add_loads(attractions_, threads_, state, loads);
    if (!constant_forces_.empty()) add_loads(constant_forces_, state, loads);
    if (!fields_.empty()) add_loads(fields_, mass_, inverse_mass_, state, loads, doubt_);
    if (user_forces_.empty()) return;
    std::vector<Vec2> user_force(state.size());
    std::vector<double> user_torque(state.size());
    const Snapshot now{state.time, state.x.linear, state.x.angular, state.v.linear, state.v.angular, given_mass_};
    for (const UserForce& f : user_forces_) f.add(now, user_force, user_torque);
    for (std::size_t i = 0; i < state.size(); ++i) {
        loads.force[i] += user_force[i];
        loads.torque[i] += user_torque[i];
        loads.flow[Account::user] += dot(user_force[i], state.v.linear[i]) + user_torque[i] * state.v.angular[i];
        loads.flow[Giver::user].add(user_force[i], cross(state.x.linear[i], user_force[i]) + user_torque[i]);
    }
}

/// The network writes where the others add.
void Dynamics::write_forces_between(const State& state, const Block& load, Flows& flow,
                                    SpringNetwork::Pass* pass) const {
    const std::span<Vec2> force{load.linear, load.size()};
    const std::size_t rows = load.size();
    for (std::size_t i = 0; load.angular && i < rows; ++i) load.angular[i] = 0;
    if (network_.empty()) {
        for (std::size_t i = 0; i < rows; ++i) load.linear[i] = {};
    } else {
        add(network_.write_forces(state, load.first, load.last, force, pass), flow);
    }
    add_soft_discs(state, load, flow);
}

void Dynamics::add_soft_discs(const State& state, const Block& load, Flows& flow) const {
    for (const SoftDiscRows& discs : soft_discs_) {
        const SoftPowers powers = discs.add_forces(state, load.first, load.last, {load.linear, load.size()});
        flow[Account::field] += powers.elastic;
        flow[Account::impact] += powers.damping;
    }
}

void Dynamics::accelerate(const State& state, Rates& rates, Wanted wanted, const RowRanges* some) const {
    add_over(some, state.size(), rates.flow, [&](std::size_t first, std::size_t last, Flows& flow) {
        accelerate(state, block_of(rates.acceleration, first, last), flow, wanted);
    });
}

// Whoever drives a body holds against the forces on it, and so works on those that exert them. A point has no inertia
// that torques could act on: it turns as it was told to, as a driven body does.
[[gnu::always_inline]] inline void Dynamics::book(const AccelerationSums& sum, const Turning& turning,
                                                  Flows& flow) const {
    flow[Account::driven] -= sum.held_power + turning.held_power;
    if (gravity_ != Vec2{}) flow[Account::gravity] += dot(gravity_, Vec2{sum.momentum_x, sum.momentum_y});
    flow[Account::method] -= sum.power + turning.power;
    book_wrenches(sum, turning, flow);
}
[[gnu::always_inline]] inline void Dynamics::book_wrenches(const AccelerationSums& sum, const Turning& turning,
                                                           Flows& flow) const {
    flow[Giver::held].add(-Vec2{sum.held_force_x, sum.held_force_y}, -(sum.held_torque + turning.held));
    if (gravity_ != Vec2{})
        flow[Giver::gravity].add(sum.mass * gravity_, cross(Vec2{sum.moment_x, sum.moment_y}, gravity_));
    flow[Giver::method].add(-Vec2{sum.force_x, sum.force_y}, -(sum.torque + turning.torque));
}

void Dynamics::accelerate(const State& state, const Block& load, Flows& flow, Wanted wanted) const {
    const RowArrays rows = arrays(state);
    double* const force = &load.linear->x;
    const bool turned = turns_ && load.angular;
    if (wanted == Wanted::accelerations) {
        rows_kernel().accelerate_alone(rows, gravity_.x, gravity_.y, force, load.first, load.last);
        if (turned) turn(state, load);
        return;
    }
    const AccelerationSums sum = rows_kernel().accelerate(rows, gravity_.x, gravity_.y, force, load.first, load.last);
    book(sum, turned ? turn(state, load) : Turning{}, flow);
}

template <Dynamics::Wanted wanted>
void Dynamics::evaluate_few(State& state, Rates& rates) const {
    begin(state, rates, wanted);
    const std::size_t rows = state.size();
    if (rows == 0) return;
    using WrenchSum = std::conditional_t<wanted == Wanted::accelerations, NoSum, SingleSum>;
    using PowerSum = std::conditional_t<wanted == Wanted::all, SingleSum, NoSum>;
    const RowArrays in = arrays(state);
    double* const force = &rates.acceleration.linear.data()->x;
    for (std::size_t i = 0; i < rows; ++i) rates.acceleration.angular[i] = 0;
    const NetworkPowers powers = forces_on_few<PowerSum>(network_.few(), in.x, in.v, force);
    if (wanted == Wanted::all) add(powers, rates.flow);
    const Block block = block_of(rates.acceleration, 0, rows);
    if (!soft_discs_.empty()) add_soft_discs(state, block, rates.flow);
    if (others_) add_others(state, rates, nullptr);
    const AccelerationSums sum = accelerate_few<WrenchSum, PowerSum>(in, gravity_.x, gravity_.y, force, 0, rows);
    const Turning turning = turns_ ? turn(state, block) : Turning{};
    if (wanted == Wanted::all) book(sum, turning, rates.flow);
    if (wanted == Wanted::wrenches) book_wrenches(sum, turning, rates.flow);
}
template void Dynamics::evaluate_few<Dynamics::Wanted::all>(State&, Rates&) const;
template void Dynamics::evaluate_few<Dynamics::Wanted::wrenches>(State&, Rates&) const;
template void Dynamics::evaluate_few<Dynamics::Wanted::accelerations>(State&, Rates&) const;

Dynamics::Turning Dynamics::turn(const State& state, const Block& load) const {
    Turning sum;
    for (std::size_t i = load.first; i < load.last; ++i) {
        double& torque = load.angular[i - load.first];
        if (torque == 0) continue;
        if (inverse_inertia_[i] == 0) sum.held += torque, sum.held_power += torque * state.v.angular[i];
        torque *= inverse_inertia_[i];
        sum.torque += inertia_[i] * torque;
        sum.power += inertia_[i] * torque * state.v.angular[i];
    }
    return sum;
}

bool Dynamics::kick(std::size_t first, std::size_t last, const Vec2* linear, std::span<const double> turning, double h,
                    State& state, Flows& gained) const {
    const KickSums sum = rows_kernel().kick(arrays(state), h, &linear->x, &state.v.linear.data()->x, first, last);
    double energy = 0, angular = 0;
    bool finite = sum.finite;
    for (std::size_t i = first; i < first + (turns_ ? turning.size() : 0); ++i) {
        const double dw = h * turning[i - first];
        if (dw == 0) continue;
        energy += inertia_[i] * dw * (state.v.angular[i] + 0.5 * dw);
        angular += inertia_[i] * dw;
        state.v.angular[i] += dw;
        finite &= std::isfinite(state.v.angular[i]);
    }
    gained[Account::method] += sum.energy + energy;
    gained[Giver::method].add({sum.momentum_x, sum.momentum_y}, sum.angular + angular);
    return finite;
}

Dynamics::Kicked Dynamics::kick(const Motion& acceleration, double h, State& state) const {
    return kick_and_drift(acceleration, h, 0, state);
}

Dynamics::Kicked Dynamics::kick_and_drift(const Motion& acceleration, double kick_time, double drift_time,
                                          State& state) const {
    struct Sum : Kicked {
        void operator+=(const Sum& other) { gained += other.gained, finite &= other.finite; }
    } all;
    add_over(some_, state.size(), all, [&](std::size_t first, std::size_t last, Sum& part) {
        part.finite &= kick(first, last, acceleration.linear.data() + first,
                            {acceleration.angular.data() + first, last - first}, kick_time, state, part.gained);
        if (drift_time != 0) part.finite &= drift(first, last, drift_time, state);
    });
    return all;
}

bool Dynamics::drift(double h, State& state) const {
    struct Moved {
        bool finite = true;
        void operator+=(Moved other) { finite &= other.finite; }
    } all;
    add_over(some_, state.size(), all,
             [&](std::size_t first, std::size_t last, Moved& part) { part.finite &= drift(first, last, h, state); });
    return all.finite;
}

bool Dynamics::drift(std::size_t first, std::size_t last, double h, State& state) {
    if (first == last) return true;
    const RowsKernel& kernel = rows_kernel();
    const bool finite = kernel.drift(h, &state.v.linear[first].x, &state.x.linear[first].x, 2 * (last - first));
    const double* const turning = &state.v.angular[first];
    return (kernel.zero(turning, last - first) || kernel.drift(h, turning, &state.x.angular[first], last - first)) &&
           finite;
}

bool Dynamics::is_finite(std::size_t first, std::size_t last, const State& state) {
    const auto all_of = [&kernel = rows_kernel(), first, last](const Motion& m) {
        return kernel.finite(&m.linear[first].x, 2 * (last - first)) && kernel.finite(&m.angular[first], last - first);
    };
    return all_of(state.x) && all_of(state.v);
}

bool Dynamics::is_finite(const State& state, const RowRanges* some) const {
    struct Bad {
        bool any = false;
        void operator+=(Bad other) { any |= other.any; }
    };
    if (state.size() == 0) return true;
    Bad found;
    add_over(some, state.size(), found,
             [&](std::size_t first, std::size_t last, Bad& bad) { bad.any |= !is_finite(first, last, state); });
    return !found.any;
}

RowArrays Dynamics::arrays(const State& state) const {
    return {&state.x.linear.data()->x, &state.v.linear.data()->x, mass_.data(), inverse_mass_.data(), state.size()};
}

Springs Dynamics::springs() const {
    Springs all = springs_;
    for (const Link& l : network_.links())
        all.push_back({l.a, l.b, l.stiffness, l.rest_length, l.damping, DampingLaw::along, {}, {}});
    return all;
}

double Dynamics::gravity_potential(const State& state) const {
    double sum = 0;
    for (std::size_t i = 0; i < state.size(); ++i)
        if (inverse_mass_[i] != 0) sum -= mass_[i] * dot(gravity_, state.x.linear[i]);
    return sum;
}

double Dynamics::spring_potential(const State& state) const {
    const auto add_network = [&](std::size_t first, std::size_t last, double& sum) {
        sum += network_.potential(state, first, last);
    };
    const double of_network = network_.empty() ? 0 : sum_over_rows<double>(threads_, state.size(), add_network);
    return of_network + potential(springs_, state) + potential(torsion_springs_, state);
}

double Dynamics::field_potential(const State& state) const {
    double of_discs = 0;
    for (const SoftDiscRows& discs : soft_discs_) of_discs += discs.potential(state);
    return of_discs + potential(attractions_, state) + potential(constant_forces_, state) +
           potential(fields_, mass_, inverse_mass_, state);
}

}  // namespace carom
