// Explicit Runge-Kutta-Nystrom methods with their own step size, for forces that do not look at velocities: x'' = a(x,
// t). Dormand, El-Mikkawy, Prince, IMA J. Numer. Anal. 7, 235 and 423 (1987).
//
// Stages are places alone, and so are their sums half of a Runge-Kutta method's. The accounts of the ledger are summed
// with the weights of the velocity: what is given to walls, held bodies and who drives them depends on places and time
// alone, too. Of forces with a potential it needs no power: it would be taken off again (docs/theory/ledger.md).

#include <algorithm>
#include <utility>

#include "forces/gains.hpp"
#include "integrators/combination.hpp"
#include "integrators/nystrom_tables.hpp"
#include "integrators/propose.hpp"
#include "integrators/step_control.hpp"
#include "simd/single.hpp"

namespace carom {

namespace {

/// Weights of the stages, known when this was compiled: those of a stage, and at the end of the step.
template <const NystromTable& table, std::size_t stage>
struct StageWeights {
    static constexpr std::span<const double> all = table.row(stage);
};
template <const NystromTable& table, std::span<const double> NystromTable::*which>
struct EndWeights {
    static constexpr std::span<const double> all = table.*which;
};

/// The sums over stages of many bodies: c x' + h² Σ w a and the like, from a start or of a change alone.
class ManySums {
  public:
    ManySums(const Dynamics&, const State& start, const Memory& memory, Angles angles)
        : start_(start), memory_(memory), angles_(angles) {}

    /// Places after a time t.
    template <class Weights>
    void go(double t, double hh, Motion& out) const {
        Combination sum;
        sum.add(t, start_.v);
        add<Weights>(hh, sum);
        sum.write(start_.size(), &start_.x, angles_, out);
    }
    /// Velocities.
    template <class Weights>
    void kick(double h, Motion& out) const {
        Combination sum;
        add<Weights>(h, sum);
        sum.write(start_.size(), &start_.v, angles_, out);
    }
    /// The sum alone.
    template <class Weights>
    void change(double scale, Motion& out) const {
        Combination sum;
        add<Weights>(scale, sum);
        sum.write(start_.size(), nullptr, angles_, out);
    }
    /// The error of a step to another state, in tolerances.
    double compare(const State& error, const State& next, double tolerance) const {
        return largest_motion(error, start_, next, tolerance, angles_, 0, start_.size());
    }
    /// The last stage becomes the first.
    void exchange() {}

  private:
    template <class Weights>
    void add(double scale, Combination& sum) const {
        for (std::size_t j = 0; j < Weights::all.size(); ++j)
            sum.add(scale * Weights::all[j], memory_.stages[j].acceleration);
    }

    const State& start_;
    const Memory& memory_;
    Angles angles_;
};

/// Those of a few bodies, written out: weights are constants, and nothing is looked for that stays where it is. Rows at
/// either end that stand still are left as they are.
class FewSums {
  public:
    FewSums(const Dynamics& dynamics, const State& start, const Memory& memory, Angles angles)
        : start_(start), angles_(angles), stages_(memory.stages.size()), last_(start.size()) {
        const auto stands = [&](std::size_t i) {
            return dynamics.mass()[i] == 0 && !dynamics.places() && start.v.linear[i] == Vec2{} &&
                   start.v.angular[i] == 0;
        };
        while (first_ < last_ && stands(first_)) ++first_;
        while (first_ < last_ && stands(last_ - 1)) --last_;
        for (std::size_t j = 0; j < stages_; ++j) {
            linear_[j] = flat(memory.stages[j].acceleration);
            angular_[j] = memory.stages[j].acceleration.angular.data();
        }
    }

    template <class Weights>
    [[gnu::always_inline]] void go(double t, double hh, Motion& out) const {
        each<Weights>(
            hh, [t](auto known, auto newest, auto x, auto v) { return x + ((t * v + known) + newest); }, out, start_.x,
            start_.v);
    }
    template <class Weights>
    [[gnu::always_inline]] void kick(double h, Motion& out) const {
        each<Weights>(
            h, [](auto known, auto newest, auto v) { return v + (known + newest); }, out, start_.v);
    }
    template <class Weights>
    [[gnu::always_inline]] void change(double scale, Motion& out) const {
        each<Weights>(
            scale, [](auto known, auto newest) { return known + newest; }, out);
    }
    double compare(const State& error, const State& next, double tolerance) const {
        return largest_motion(error, start_, next, tolerance, angles_, first_, last_);
    }
    void exchange() {
        std::swap(linear_[0], linear_[stages_ - 1]);
        std::swap(angular_[0], angular_[stages_ - 1]);
    }

  private:
    using Arrays = std::array<const double*, 17>;
    static const double* flat(const Motion& motion) { return &motion.linear.data()->x; }

    /// f(scale Σ w a over all stages but the newest, that of the newest, numbers...) for every vector, and angle if
    /// anybody turns. A processor that waits for the newest stage knows all others meanwhile.
    template <class Weights, class F, class... In>
    [[gnu::always_inline]] void each(double scale, F f, Motion& out, const In&... in) const {
        constexpr std::size_t newest = newest_of(Weights::all);
        const double weight = scale * Weights::all[newest];
        double* const to = &out.linear.data()->x;
        for (std::size_t i = 2 * first_; i < 2 * last_; i += 2)
            store(to + i, f(scale * sum<Weights, newest, Two>(linear_, i), weight * load<Two>(linear_[newest] + i),
                            load<Two>(flat(in) + i)...));
        if (angles_ == Angles::left) return;
        for (std::size_t i = first_; i < last_; ++i)
            out.angular[i] =
                f(scale * sum<Weights, newest, double>(angular_, i), weight * angular_[newest][i], in.angular[i]...);
    }
    static constexpr std::size_t newest_of(std::span<const double> weights) {
        std::size_t newest = weights.size() - 1;
        while (weights[newest] == 0) --newest;
        return newest;
    }
    template <class Number>
    static Number load(const double* from) {
        return load_numbers<Number>(from);
    }
    static void store(double* to, Two pair) { __builtin_memcpy(to, &pair, sizeof pair); }
    /// Of the first stages.
    template <class Weights, std::size_t stages, class Number>
    [[gnu::always_inline]] static Number sum(const Arrays& a, std::size_t i) {
        Number total{};
        const auto add = [&]<std::size_t j>(std::integral_constant<std::size_t, j>) {
            constexpr double weight = Weights::all[j];
            if constexpr (weight != 0) total += weight * load<Number>(a[j] + i);
        };
        [&]<std::size_t... j>(std::index_sequence<j...>) { (add(std::integral_constant<std::size_t, j>{}), ...); }
        (std::make_index_sequence<stages>{});
        return total;
    }

    const State& start_;
    Angles angles_;
    std::size_t stages_, first_ = 0, last_;
    Arrays linear_, angular_;
};

/// A method, and sums for many bodies or a few.
template <const NystromTable& table, class Sums>
class Method {
  public:
    Method(double tolerance, const Dynamics& dynamics, double wanted, State& state, Memory& memory)
        : tolerance_(tolerance),
          dynamics_(dynamics),
          wanted_(wanted),
          state_(state),
          memory_(memory),
          angles_(dynamics.turns() ? Angles::summed : Angles::left),
          flows_(dynamics.needs_velocity() || dynamics.turns_points() ? Wanted::all : Wanted::wrenches),
          sums_(dynamics, state, memory, angles_) {}

    /// Moves the state by a step of at most `most` [s]; returns how long it was.
    double step(double most) {
        double h = std::min(memory_.step, most);
        const bool shortened = h < memory_.step;
        if (flows_ == Wanted::all) memory_.trial.v = state_.v;
        for (bool rejected = false;; rejected = true) {
            require_step(Nystrom::name, h, rejected, state_.time, wanted_, tolerance_);
            const double error = attempt(h), proposed = next_step(table.order, h, error, memory_.error);
            if (error <= 1) {
                remember_step(h, proposed, error, rejected, shortened, memory_);
                accept(h);
                return h;
            }
            h = std::min(proposed, 0.9 * h);
        }
    }

  private:
    using Wanted = Dynamics::Wanted;
    template <std::span<const double> NystromTable::*which>
    using End = EndWeights<table, which>;
    static constexpr std::size_t stages = table.stages();

    /// Evaluates the stages but the first, and leaves the end in memory.next. Its error in tolerances.
    double attempt(double h) {
        [&]<std::size_t... i>(std::index_sequence<i...>) { (evaluate<i + 1>(h), ...); }
        (std::make_index_sequence<stages - 1>{});
        State &next = memory_.next, &error = memory_.coarse;
        if constexpr (table.ends_at_a_stage())
            swap(next.x, memory_.trial.x);
        else
            sums_.template go<End<&NystromTable::place>>(h, h * h, next.x);
        sums_.template kick<End<&NystromTable::velocity>>(h, next.v);
        sums_.template change<End<&NystromTable::place_error>>(h * h, error.x);
        sums_.template change<End<&NystromTable::velocity_error>>(h, error.v);
        return sums_.compare(error, next, tolerance_);
    }

    template <std::size_t i>
    [[gnu::always_inline]] void evaluate(double h) {
        constexpr bool last = table.ends_at_a_stage() && i + 1 == stages;
        sums_.template go<StageWeights<table, i>>(table.c[i] * h, h * h, memory_.trial.x);
        memory_.trial.time = state_.time + table.c[i] * h;
        dynamics_.evaluate(memory_.trial, memory_.stages[i],
                           last || table.velocity[i] != 0 ? flows_ : Wanted::accelerations);
    }

    /// The state becomes memory.next.
    void accept(double h) {
        State& next = memory_.next;
        Gains gains(dynamics_);
        for (std::size_t i = 0; i < state_.size(); ++i) {
            const Vec2 x = state_.x.linear[i], v = state_.v.linear[i];
            const double w = state_.v.angular[i];
            if (angles_ == Angles::left) {
                next.x.angular[i] = state_.x.angular[i] + h * w;
                next.v.angular[i] = w;
            }
            gains.add(i, x, v, w, next.x.linear[i] - x, next.v.linear[i] - v, next.v.angular[i] - w);
        }
        gains.book(state_.account);
        book_flows(h);
        swap(state_.x, next.x);
        swap(state_.v, next.v);
        state_.time += h;
        if constexpr (table.ends_at_a_stage()) {
            swap(memory_.stages.front().acceleration, memory_.stages.back().acceleration);
            each_flow([&](auto numbers_of) {
                const auto from = numbers_of(memory_.stages.back().flow), to = numbers_of(memory_.stages.front().flow);
                for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k];
            });
            sums_.exchange();
        } else {
            dynamics_.evaluate(state_, memory_.stages.front(), flows_);
        }
    }

    /// f(numbers_of), which tells of flows the numbers that are known.
    template <class F>
    [[gnu::always_inline]] void each_flow(F f) {
        f([](Flows& flow) { return flow.wrench_numbers(); });
        if (flows_ == Wanted::all) f([](Flows& flow) { return std::span(flow.power); });
    }
    /// What flowed in the step.
    void book_flows(double h) {
        each_flow([&](auto numbers_of) {
            const auto numbers = numbers_of(state_.account);
            for (std::size_t k = 0; k < numbers.size(); ++k) {
                double sum = 0;
                for (std::size_t j = 0; j < stages; ++j)
                    if (table.velocity[j] != 0) sum += table.velocity[j] * numbers_of(memory_.stages[j].flow)[k];
                numbers[k] += h * sum;
            }
        });
    }

    const double tolerance_;
    const Dynamics& dynamics_;
    const double wanted_;
    State& state_;
    Memory& memory_;
    const Angles angles_;
    const Wanted flows_;
    Sums sums_;
};

template <const NystromTable& table>
void restart(double tolerance, const Dynamics& dynamics, State& state, Memory& memory) {
    memory.stages.resize(table.stages());
    memory.velocities.resize(2);
    for (State* storage : {&memory.next, &memory.trial, &memory.coarse, &memory.end}) *storage = state;
    for (Rates& stage : memory.stages) stage.acceleration.resize(state.size());
    memory.error = 1;
    for (Motion* errors : {&memory.coarse.x, &memory.coarse.v}) errors->fill_zero();
    dynamics.evaluate(state, memory.stages[0]);
    memory.velocities[0] = state.v;
    memory.step = first_step(table.order, tolerance, dynamics, memory);
}

template <const NystromTable& table, class Sums>
void propose_with(double tolerance, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    const double start = state.time;
    Method<table, Sums> method(tolerance, dynamics, h, state, memory);
    for (CompensatedSum left(h); left.value() > 0;) {
        state.time = start + (h - left.value());
        left.add(-method.step(left.value()));
    }
    state.time = start + h;
}

template <const NystromTable& table>
void propose(double tolerance, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    if (!memory.continues) restart<table>(tolerance, dynamics, state, memory);
    if (are_few(state.size()) && state.size() > 0)
        propose_with<table, FewSums>(tolerance, dynamics, state, h, memory);
    else
        propose_with<table, ManySums>(tolerance, dynamics, state, h, memory);
    dynamics.place_driven(state);
}

}  // namespace

void propose(const Nystrom& options, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    switch (options.pair) {
        case NystromPair::dormand_prince64:
            return propose<tables::nystrom64>(options.tolerance, dynamics, state, h, memory);
        case NystromPair::dormand_prince86:
            return propose<tables::nystrom86>(options.tolerance, dynamics, state, h, memory);
        case NystromPair::dormand_prince1210:
            return propose<tables::nystrom1210>(options.tolerance, dynamics, state, h, memory);
    }
}

}  // namespace carom
