// The impact of a disc of the gas and a body that is moved in steps, as algebra of impulses.

#include <algorithm>
#include <cmath>

#include "solvers/events/company.hpp"
#include "solvers/hodograph.hpp"

namespace carom {

namespace {

/// A direction in which the disc pushes and is pushed, and how all that yields to 1 N s.
struct Way {
    Vec2 along;
    double arm;  ///< of the point of contact about the disc's centre [m]
    Account heat;
    std::vector<GasYield> yields{};
    std::vector<double> held{};  ///< by touches that hold meanwhile [N s]
    double ease = 0;             ///< inverse of the effective mass [1/kg]
    double given = 0;
};

class Strike {
  public:
    Strike(GasCompany& company, const Party& disc, Vec2 lever, Flows& account)
        : company_(company), disc_(disc), lever_(lever), account_(account) {}

    void prepare(std::uint32_t struck, double time, Way& way) {
        company_.find_yields(struck, time, lever_, way.along, way.yields);
        way.held.clear();
        company_.keep_touches(way.yields, way.held);
        const GasYield& own = way.yields[0];
        way.ease = disc_.inverse_mass + way.arm * way.arm * disc_.inverse_inertia +
                   dot(own.v + cross(own.w, lever_), way.along);
    }
    /// Of the disc's point over the body's.
    double speed(const Way& way) const {
        const GasMover& body = company_.mover[way.yields[0].mover];
        return dot(*disc_.v - body.velocity_at(lever_), way.along) + way.arm * disc_.spin();
    }
    /// An impulse on the disc, and the opposite one on the body. Its work on both, a loss, is heat; `method` has what
    /// the disc gains, as it has in the end what the others do.
    void push(Way& way, double impulse) {
        const double before = speed(way);
        const Vec2 dv = disc_.inverse_mass * impulse * way.along;
        double gain = impulse * dot(way.along, *disc_.v + 0.5 * dv);
        *disc_.v += dv;
        total_.add_at(disc_.x, impulse * way.along);
        if (disc_.w && disc_.inverse_inertia != 0) {
            const double turn = way.arm * impulse, dw = disc_.inverse_inertia * turn;
            gain += turn * (*disc_.w + 0.5 * dw);
            *disc_.w += dw;
            total_.torque += turn;
        }
        for (const GasYield& yield : way.yields) {
            GasMover& m = company_.mover[yield.mover];
            const Vec2 change = -impulse * yield.v;
            Wrench given;
            given.add_at(m.x, m.mass * change);
            given.torque -= m.inertia * impulse * yield.w;
            m.v += change, m.w -= impulse * yield.w, m.kick += change;
            m.gained += change, m.gained_spin -= impulse * yield.w;
            const double left = company_.until - m.clock;
            m.pushed += left * change, m.pushed_turn -= left * impulse * yield.w;
            m.given.add(given.force, given.torque), total_.add(given.force, given.torque);
            m.hit = true;
        }
        way.given += impulse;
        const double heat = -0.5 * impulse * (before + speed(way));
        account_[way.heat] += heat;
        account_[Account::method] += gain + heat;
    }
    /// Sliding ends, as far as friction goes.
    void rub(Way& across, double pressed, double friction) {
        const double most = friction * pressed, so_far = across.given;
        push(across, std::clamp(so_far - speed(across) / across.ease, -most, most) - so_far);
    }
    /// How a point parts and slips, with the yields of either way.
    Hodograph hodograph(const Way& normal, const Way& across, double friction) const {
        const auto crossed = [this](const Way& given, const Way& felt) {
            const GasYield& own = given.yields[0];
            return dot(own.v + cross(own.w, lever_), felt.along);
        };
        return {.coupling = {{normal.ease, crossed(across, normal)}, {crossed(normal, across), across.ease}},
                .speed = {speed(normal), speed(across)},
                .friction = friction};
    }
    /// False where the impulse would grow for ever.
    bool follow(Way& normal, Way& across, const GasCompany::Impact& impact) {
        Hodograph point = hodograph(normal, across, impact.friction);
        if (!point.follow(HUGE_VAL)) return false;
        const double pressed = point.given[Hodograph::pressing];
        point.follow(std::max(impact.restitution * pressed, impact.least / normal.ease));
        push(normal, across, point);
        return true;
    }
    /// Gives the impulses that it came to. What friction took on the way to them is not what they did at once.
    void push(Way& normal, Way& across, const Hodograph& end) {
        const double before = account_[Account::friction];
        push(normal, end.given[Hodograph::pressing]), push(across, end.given[Hodograph::rubbing]);
        const double more = -end.rubbed - (account_[Account::friction] - before);
        account_[Account::friction] += more, account_[Account::impact] -= more;
    }
    /// By sweeps from one way to the other, where friction jams the two: what they give one another is bounded by
    /// these.
    void sweep(Way& normal, Way& across, const GasCompany::Impact& impact) {
        constexpr int sweeps = 100;
        for (int k = 0; k < sweeps; ++k) {
            const double pressed = normal.given, rubbed = across.given;
            push(normal, std::max(-pressed, -speed(normal) / normal.ease));
            rub(across, normal.given, impact.friction);
            if (std::abs(normal.given - pressed) + std::abs(across.given - rubbed) <= 1e-15 * normal.given) break;
        }
        push(normal, std::max(impact.restitution * normal.given, impact.least / normal.ease));
        rub(across, normal.given, impact.friction);
    }
    /// Books what others gave. Joints pass what they are given on to the ground, and who does not turn is kept from it.
    void book_held(const Way& normal, const Way& across) {
        std::vector<double> held = normal.held;
        held.resize(std::max(held.size(), across.held.size()));
        for (double& h : held) h *= -normal.given;
        for (std::size_t k = 0; k < across.held.size(); ++k) held[k] -= across.given * across.held[k];
        const auto is_held = [this](const GasYield& yield) {
            const GasMover& m = company_.mover[yield.mover];
            return m.mechanism != GasMover::none || m.inverse_inertia == 0;
        };
        const bool others = std::any_of(normal.yields.begin(), normal.yields.end(), is_held);
        company_.book_held(held, others, total_, account_);
    }

  private:
    GasCompany& company_;
    const Party& disc_;
    const Vec2 lever_;
    Flows& account_;
    Wrench total_{};
};

}  // namespace

/// Without friction Newton's rule; with it Poisson's, which never makes energy (see Blow).
bool GasCompany::strike(const Impact& impact, const Party& disc, Flows& account) {
    const GasMover& body = mover[impact.struck];
    const Vec2 n = impact.normal;
    Strike blow(*this, disc, disc.x - disc.radius * n - body.x, account);
    Way normal{n, 0, Account::impact}, across{perpendicular(n), -disc.radius, Account::friction};
    blow.prepare(impact.struck, impact.time, normal);
    const double approach = -blow.speed(normal);
    const bool at_stop = hold_stops(impact.struck, -approach / normal.ease);
    if (at_stop) blow.prepare(impact.struck, impact.time, normal);
    if (hold_touches(impact.time, approach / normal.ease, normal.yields))
        blow.prepare(impact.struck, impact.time, normal);
    const double impulse = (approach + std::max(impact.restitution * approach, impact.least)) / normal.ease;
    const bool lets = !leads_astray(impact.time, impulse, normal.yields);
    if (lets && impact.friction == 0) blow.push(normal, impulse);
    if (lets && impact.friction != 0) {
        blow.prepare(impact.struck, impact.time, across);
        if (!blow.follow(normal, across, impact)) blow.sweep(normal, across, impact);
    }
    if (at_stop) let_stops_go(impact.struck);
    if (lets) blow.book_held(normal, across);
    let_touches_go();
    return lets;
}

}  // namespace carom
