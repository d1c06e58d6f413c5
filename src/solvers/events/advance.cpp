#include "solvers/events/advance.hpp"

#include <cmath>

#include "math/compensated.hpp"
#include "solvers/events/foresee.hpp"

namespace carom {

namespace {

template <class Queue>
void make_anew(const GasScene& scene, State& state, GasOf<Queue>& gas) {
    double& moved = gas.data.tally.moved_apart;
    moved = std::max(moved, check_gas(scene, state));
    fill_gas(scene, state, gas.data, gas.whole.discs);
    gas.whole.window = gas.data.grid.all();
    gas.whole.queued = false;
    GasBooks none;
    GasRun(scene, gas.data, gas.whole, none).foresee_all();
    gas.data.fits = true;
}

/// All events from one time to another, by blocks where that is faster and by the one queue that gives the same bits.
template <class Queue>
void follow(const GasScene& scene, double from, double until, GasOf<Queue>& gas, GasBooks& books) {
    if constexpr (std::is_same_v<Queue, Calendar>)
        if (!scene.company && gas.blocks.pay(gas.data, gas.whole.discs, until - from) &&
            gas.blocks.run(scene, gas.data, gas.whole, from, until, books) >= until)
            return;
    gas.whole.window = gas.data.grid.all();
    GasRun(scene, gas.data, gas.whole, books).run(until);
}

/// The clock goes back by a power of two, so that times stay as precise as they are at the start.
template <class Queue>
void set_back(const GasScene& scene, GasOf<Queue>& gas) {
    GasDiscs& discs = gas.whole.discs;
    const double by = gas.data.set_back;
    for (GasDisc& d : discs.disc) d.clock -= by;
    for (GasEvent& e : discs.event) e.due -= by, e.hit -= by;
    for (GasSpin& s : discs.spin) s.clock -= by;
    for (GasPast& p : discs.past) p.last_hit -= by;
    for (GasObstacle& o : gas.data.obstacle) o.clock -= by;
    gas.data.now -= by;
    gas.data.begin -= by;
    if (gas.whole.queued) gas.whole.queue.shift(discs.event, by);
    if (scene.company) scene.company->set_back(by);
}

}  // namespace

template <class Queue>
void make_ready(const GasScene& scene, State& state, GasOf<Queue>& gas) {
    if (!gas.data.fits) make_anew(scene, state, gas);
}

template <class Queue>
void advance(const GasScene& scene, State& state, double h, GasOf<Queue>& gas) {
    GasData& data = gas.data;
    make_ready(scene, state, gas);
    GasBooks books;
    double from = data.begin = data.now + data.now_low;
    const DoubleDouble end = two_sum(data.now, h);
    data.now = end.high;
    data.now_low += end.low;
    const auto follow_until = [&](const auto& until) {
        while (until() >= 2 * data.set_back) {
            follow(scene, from, std::nextafter(2 * data.set_back, 0), gas, books);
            set_back(scene, gas);
            from = data.set_back;
        }
        follow(scene, from, until(), gas, books);
        from = until();
    };
    if (GasCompany* const company = scene.company) {
        gas.whole.window = data.grid.all();
        company->set_clock(from, data.now + data.now_low);
        GasRun(scene, data, gas.whole, books).meet_company();
        while (!company->stopped && company->has_kinks()) {
            follow_until([&] { return company->smooth_until(); });
            if (!company->stopped) GasRun(scene, data, gas.whole, books).kink_company();
        }
        if (!company->stopped) follow_until([&] { return company->until; });
        if (company->stopped) data.now = company->until, data.now_low = 0;
    } else {
        follow_until([&] { return data.now + data.now_low; });
    }
    GasRun(scene, data, gas.whole, books).show(state, data.now + data.now_low);
    state.account += books.account;
    data.tally += books.tally;
}

template <class Queue>
void make_hit(const GasScene& scene, State& state, GasOf<Queue>& gas) {
    GasBooks books;
    GasRun(scene, gas.data, gas.whole, books).make_hit(state);
    state.account += books.account;
    gas.data.tally += books.tally;
}

template void make_ready(const GasScene&, State&, GasOf<Calendar>&);
template void advance(const GasScene&, State&, double, GasOf<Calendar>&);
template void make_hit(const GasScene&, State&, GasOf<Calendar>&);
template void advance(const GasScene&, State&, double, GasOf<SortedQueue>&);

}  // namespace carom
