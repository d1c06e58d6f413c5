// What the method makes of the energy of mechanisms, and what of that is taken back.

#include "solvers/parts.hpp"

namespace carom {

namespace {

using Part = Mechanism::Part;

/// Energy that a mechanism was given in a substep and no account explains [J].
class Made {
  public:
    /// Half of a spring's impulse comes before the drift and half after it. Where kicks do not come so the mean
    /// velocity is another one than that of the drift, along which a spring gives what it stored.
    Made(const SoftScene& scene, const Mechanism& m, double h, const Course& course, const std::vector<Mover>& movers,
         const MeanVelocities& means)
        : m_(m),
          h_(h),
          kicks_evenly_(gives_halves(scene)),
          course_(course),
          start_(course.start),
          movers_(movers),
          means_(means) {}

    /// By the forces, as their kicks came half before the drift and half after it, and not along it.
    double by_flight(const Bodies& bodies) const {
        double sum = 0;
        for (const Part& p : m_.parts) {
            if (p.inverse_mass == 0) continue;
            const std::uint32_t i = p.row;
            const Mover& end = movers_[i];
            const Vec2 v = start_.v.linear[i], kick = course_.proposed.v.linear[i] - v,
                       way = course_.end.x.linear[i] - start_.x.linear[i];
            const double w = start_.v.angular[i], turn = course_.end.x.angular[i] - start_.x.angular[i];
            sum += bodies.mass[i] * dot(kick, 0.5 * (v + Vec2{end.vx, end.vy}) - (1 / h_) * way) +
                   bodies.inertia[i] * (course_.proposed.v.angular[i] - w) * (0.5 * (w + end.w) - turn / h_);
        }
        return sum;
    }
    /// By the joints.
    double by_rows() const {
        double sum = 0;
        for (const Member& k : m_.members) {
            const JointLine* const lines = &m_.lines[k.line];
            std::uint32_t r = 0;
            if (k.is_hinge) {
                const JointLine &x = lines[0], &y = lines[1];
                const Vec2 first = means_.along_points(k, x.first, y.first),
                           last = means_.along_points(k, x.last, y.last);
                sum += x.before * first.x + x.after * last.x, sum += y.before * first.y + y.after * last.y;
                r = 2;
            }
            for (; r < k.lines; ++r) sum += of(k, r, lines[r]);
        }
        return sum;
    }

    /// What of that may be rounding: rows are kept to a tiny part of their size.
    double noise() const {
        double sum = 0;
        for (const Member& k : m_.members)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                const JointLine& line = m_.lines[k.line + r];
                const double hair = tiny * size_of(k, line);
                sum += hair * ((std::abs(line.before) + std::abs(line.after)) / h_ + line.law->stiffness * hair);
            }
        return sum;
    }

  private:
    double of(const Member& k, std::uint32_t r, const JointLine& line) const {
        if (line.law->kind == Law::Kind::stop || line.law->paired || (line.before == 0 && line.after == 0)) return 0;
        const bool is_rigid = line.law->kind == Law::Kind::rigid;
        if (!is_rigid && has_motor(k, line)) return 0;
        const auto along = [&](const JointRow& j) {
            return is_rigid || kicks_evenly_ ? means_.along(k, r, j) : drift_along(k, r, j);
        };
        const double first = along(line.first), last = along(line.last);
        const double work = line.before * first + line.after * last;
        if (is_rigid) return work;
        const double from = line.first.error, to = line.last.error;
        return work + taken_up(*line.law, from, to) - damping_of(&m_.lines[k.line], r, h_) * 0.5 * (first + last);
    }
    /// Whether a motor drives the joint along a spring's row: it starts the drift with a jerk if it has to.
    bool has_motor(const Member& k, const JointLine& spring) const {
        return std::any_of(&m_.lines[k.line], &m_.lines[k.line] + k.lines,
                           [&](const JointLine& l) { return l.law->turns == spring.law->turns && l.law->speed != 0; });
    }
    /// Of the bodies on their way.
    double drift_along(const Member& k, std::uint32_t r, const JointRow& j) const {
        double v[2][3]{};
        for (int side = 0; side < 2; ++side) {
            const Part& p = m_.parts[side == 0 ? k.a : k.b];
            if (p.inverse_mass == 0) continue;
            const Vec2 way = course_.end.x.linear[p.row] - start_.x.linear[p.row];
            v[side][0] = way.x / h_, v[side][1] = way.y / h_;
            v[side][2] = (course_.end.x.angular[p.row] - start_.x.angular[p.row]) / h_;
        }
        return speed(k, r, j, v[0], v[1]);
    }

    const Mechanism& m_;
    double h_;
    bool kicks_evenly_;
    const Course& course_;
    const State& start_;
    const std::vector<Mover>& movers_;
    const MeanVelocities& means_;
};

/// How the parts of a mechanism move as one: a free one like a rigid body, one that is held not at all.
struct Common {
    Vec2 centre{}, velocity{};
    double spin = 0;

    Twist at(const Part& p) const { return {velocity + cross(spin, p.now.position - centre), spin}; }
};

template <class TwistOf>
Common common(const SoftScene& scene, const Mechanism& m, TwistOf twist_of) {
    const auto held = [](const Member& k) { return k.outside; };
    if (std::any_of(m.members.begin(), m.members.end(), held)) return {};
    Common c;
    double mass = 0, inertia = 0, turning = 0;
    const auto each = [&](auto act) {
        for (const Part& p : m.parts)
            act(scene.bodies.mass[p.row], scene.bodies.inertia[p.row], p.now.position, twist_of(p.row));
    };
    each([&](double part, double, Vec2 x, const Twist& b) {
        mass += part, c.centre += part * x, c.velocity += part * b.velocity;
    });
    c.centre = (1 / mass) * c.centre, c.velocity = (1 / mass) * c.velocity;
    each([&](double part, double own, Vec2 x, const Twist& b) {
        const Vec2 r = x - c.centre;
        inertia += own + part * dot(r, r);
        turning += own * b.angular_velocity + part * cross(r, b.velocity - c.velocity);
    });
    c.spin = inertia > 0 ? turning / inertia : 0;
    return c;
}

/// In motion and in springs when the substep began; of a free one as it is seen by who flies along with its centre of
/// mass: what is much of it may not depend on who looks.
double energy_before(const SoftScene& scene, const Mechanism& m, const State& start) {
    const Common c = common(scene, m, [&](std::size_t i) { return Twist{start.v.linear[i], start.v.angular[i]}; });
    double sum = stored_in_springs(m);
    for (const Part& p : m.parts) {
        if (p.inverse_mass == 0) continue;
        const Vec2 v = start.v.linear[p.row] - c.velocity;
        const double w = start.v.angular[p.row];
        sum += 0.5 * scene.bodies.mass[p.row] * dot(v, v) + 0.5 * scene.bodies.inertia[p.row] * w * w;
    }
    return sum;
}

bool has_springs(const Mechanism& m) {
    const auto& bounds = m.shape->bounds;
    return std::any_of(bounds.begin(), bounds.end(), [](const BoundShape& b) { return b.is_spring; });
}
bool is_driven(const SoftScene& scene, const Mechanism& m, const std::vector<Mover>& movers) {
    return std::any_of(m.parts.begin(), m.parts.end(), [&](const Part& p) {
        const Mover& b = movers[p.row];
        return !moves(scene, p.row) && (b.vx != 0 || b.vy != 0 || b.w != 0);
    });
}

void take_back(const SoftScene& scene, double made, const Common& c, Mechanism& m, std::vector<Mover>& movers) {
    double energy = 0;  // of the motion in one another
    const auto each = [&](auto act) {
        for (Part& p : m.parts) {
            if (p.inverse_mass == 0) continue;
            Mover& b = movers[p.row];
            const Twist all = c.at(p);
            act(p, b, Vec2{b.vx, b.vy} - all.velocity, b.w - all.angular_velocity);
        }
    };
    each([&](const Part& p, const Mover&, Vec2 v, double w) {
        energy += 0.5 * scene.bodies.mass[p.row] * dot(v, v) + 0.5 * scene.bodies.inertia[p.row] * w * w;
    });
    if (!(energy > 0) || made < -energy) return;  // it hardly moves
    const double lost = 1 - std::sqrt(std::max(0.0, 1 - made / energy));
    each([&](Part& p, Mover& b, Vec2 v, double w) {
        const double mass = scene.bodies.mass[p.row];
        b.vx -= lost * v.x, b.vy -= lost * v.y;
        if (p.inverse_inertia != 0) b.w -= lost * w;  // else it keeps the spin that it has
        p.given[0] -= mass * lost * v.x, p.given[1] -= mass * lost * v.y;
        p.given[2] -= scene.bodies.inertia[p.row] * lost * w;
    });
}

}  // namespace

double stored_in_springs(const Mechanism& m) {
    double sum = 0;
    for (const BoundShape& b : m.shape->bounds)
        if (b.is_spring) sum += taken_up(*m.lines[b.line].law, 0, m.lines[b.line].first.error);
    return sum;
}

double given_to_springs(const Mechanism& m) {
    constexpr double far = 0.01;
    double sum = 0;
    for (const BoundShape& b : m.shape->bounds) {
        if (!b.is_spring) continue;
        const JointLine& line = m.lines[b.line];
        const double from = line.first.error, to = line.last.error;
        if (std::abs(to - from) > far * size_of(m.members[b.joint], line)) sum += 2 * taken_up(*line.law, from, to);
    }
    return sum;
}

void curb(const SoftScene& scene, double h, const Course& course, std::vector<Mover>& movers, Mechanism& m,
          MeanVelocities& means) {
    constexpr double much = 1e-3;  // of the mechanism's energy, in a substep
    const bool keeps = scene.keep_energy && !m.is_touched, springs = has_springs(m);
    if (!(keeps || springs) || is_driven(scene, m, movers)) return;
    const Made made(scene, m, h, course, movers, means);
    const double by_rows = made.by_rows();
    if (!keeps && !(by_rows > 0)) return;
    const double most = much * energy_before(scene, m, course.start),
                 all = keeps ? by_rows + made.by_flight(scene.bodies) : by_rows;
    const auto take = [&](double energy) {
        const auto twist_of = [&](std::size_t i) { return Twist{{movers[i].vx, movers[i].vy}, movers[i].w}; };
        take_back(scene, energy, common(scene, m, twist_of), m, movers);
        means.take(1, m, course.start.v, movers);
    };
    if (keeps && std::abs(all) <= most)
        take(all);
    else if (springs && by_rows > most && by_rows > most + made.noise())
        take(by_rows);
}

}  // namespace carom
