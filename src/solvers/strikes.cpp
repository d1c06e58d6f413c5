// The impact phase of SoftStep: bounces at their instants, one pair after the other, the earliest first and of those at
// one instant the hardest. So momentum runs through a row of touching bodies as it does through Newton's cradle
// (solvers.md 5.3), and the rest of the substep is spent and not dropped.

#include <algorithm>
#include <array>
#include <queue>

#include "forces/gains.hpp"
#include "solvers/soft_step.hpp"
#include "solvers/time_of_impact.hpp"

namespace carom {

namespace {

struct Strike {
    double time, approach;
    std::uint32_t contact, version;

    /// std::priority_queue has the largest on top.
    bool operator<(const Strike& other) const {
        if (time != other.time) return time > other.time;
        if (approach != other.approach) return approach < other.approach;
        return contact > other.contact;
    }
};

/// A point of a contact at some time, and how its gap changes.
struct Gap {
    double width, rate, acceleration;

    /// When it closes from now on, if it does.
    std::optional<double> closes() const {
        const double square = rate * rate - 2 * width * acceleration;
        if (square < 0) return std::nullopt;
        if (rate < 0) return std::max(0.0, 2 * width / (-rate + std::sqrt(square)));
        if (acceleration < 0) return std::max(0.0, (rate + std::sqrt(square)) / -acceleration);
        return std::nullopt;
    }
};

/// One of the two of a contact.
struct Side {
    std::uint32_t row;
    double inverse_mass = 0, inverse_inertia = 0;
    Vec2 x{}, v{}, a{};
    double angle = 0, w = 0;

    Vec2 velocity_at(Vec2 lever) const { return v + cross(w, lever); }
    void push(Vec2 lever, Vec2 impulse) {
        v += inverse_mass * impulse;
        w += inverse_inertia * cross(lever, impulse);
    }
};

class Strikes {
  public:
    Strikes(const SoftScene& scene, State& start, State& end, double h, SoftContacts& contacts)
        : scene_(scene), start_(start), end_(end), h_(h), contacts_(contacts), version_(contacts.all.size(), 0) {
        leans_.assign(start.size() + 1, false);
        for (const SoftContact& c : contacts.all)
            if (c.rests) leans_[c.a] = c.a < start.size(), leans_[c.b] = true;
        acceleration_.resize(start.size());
        for (std::size_t i = 0; i < start.size(); ++i) {
            acceleration_.linear[i] = (2 / (h * h)) * (end.x.linear[i] - start.x.linear[i] - h * start.v.linear[i]);
            acceleration_.angular[i] = (2 / (h * h)) * (end.x.angular[i] - start.x.angular[i] - h * start.v.angular[i]);
        }
    }

    void run() {
        for (std::uint32_t i = 0; i < contacts_.all.size(); ++i)
            if (bounces(contacts_.all[i])) predict(i, 0);
        if (queue_.empty()) return;
        list_by_body();
        while (!queue_.empty()) {
            const Strike next = queue_.top();
            queue_.pop();
            if (next.version == version_[next.contact]) strike(next);
        }
    }

    /// Those that do not bounce need it if they might meet elsewhere than it seems at the start of the substep.
    static bool bounces(const SoftContact& c) { return !c.rests && (c.restitution > 0 || c.fast); }

  private:
    Side side(std::uint32_t row, double t) const {
        Side s{row};
        if (row >= start_.size()) return s;
        const double back = t - h_, squares = 0.5 * (t * t - h_ * h_);
        s.inverse_mass = scene_.bodies.inverse_mass[row], s.inverse_inertia = scene_.bodies.inverse_inertia[row];
        s.a = acceleration_.linear[row];
        s.x = end_.x.linear[row] + back * start_.v.linear[row] + squares * s.a;
        s.angle = end_.x.angular[row] + back * start_.v.angular[row] + squares * acceleration_.angular[row];
        s.v = start_.v.linear[row] + (t / h_) * (end_.v.linear[row] - start_.v.linear[row]);
        s.w = start_.v.angular[row] + (t / h_) * (end_.v.angular[row] - start_.v.angular[row]);
        return s;
    }

    Manifold look_at(const SoftContact& c, const Side& a, const Side& b) const {
        constexpr double anywhere = 1e300;
        return look(scene_, c, frame_at(a.x, a.angle), frame_at(b.x, b.angle), anywhere);
    }
    /// Levers of a point: from each body to the middle between the surfaces.
    std::array<Vec2, 2> levers(const SoftContact& c, const Manifold& m, int point, const Side& a, const Side& b) const {
        const double radius_a = c.at_wall ? 0 : scene_.pieces[c.piece_a].outline.radius;
        const double radius_b = scene_.pieces[c.piece_b].outline.radius;
        const Vec2 between = b.x - a.x;
        const Vec2 core_a = c.at_wall ? between + m.point[point].core_a : m.point[point].core_a;
        const Vec2 middle =
            0.5 * (core_a + radius_a * m.normal + between + m.point[point].core_b - radius_b * m.normal);
        return {middle, middle - between};
    }
    Gap gap(const SoftContact& c, const Manifold& m, int point, const Side& a, const Side& b) const {
        const auto [ra, rb] = levers(c, m, point, a, b);
        return {m.point[point].gap, dot(b.velocity_at(rb) - a.velocity_at(ra), m.normal), dot(b.a - a.a, m.normal)};
    }

    /// How long gaps change as they do now: bodies that turn soon show other corners.
    double foreseeable(const SoftContact& c, const Side& a, const Side& b) const {
        constexpr double slight = 0.05;  // [rad]: a lever that turns so far is off its tangent by 1e-3 of its length
        const auto turning = [](const Convex& outline, double w) {
            return outline.count == 1 && outline.corner[0] == Vec2{} ? 0 : std::abs(w);
        };
        double w = turning(scene_.pieces[c.piece_b].outline, b.w);
        if (!c.at_wall) w = std::max(w, turning(scene_.pieces[c.piece_a].outline, a.w));
        return w * 2 * h_ > slight ? std::max(slight / w, h_ / 50) : 2 * h_;
    }

    /// Finds the next strike of a contact after a time, or that it rests from then on, or that nothing touches.
    void predict(std::uint32_t index, double from) {
        SoftContact& c = contacts_.all[index];
        ++version_[index];
        const double close = 1e-12 * c.size;
        double t = from;
        for (int i = 0; i < 100; ++i) {
            const Side a = side(c.a, t), b = side(c.b, t);
            const Manifold m = look_at(c, a, b);
            double next = foreseeable(c, a, b);
            for (int k = 0; k < m.count; ++k) {
                const Gap g = gap(c, m, k, a, b);
                if (g.width <= close && g.rate < 0) return touch(index, t, m, a, b);
                if (g.width <= 1e-9 * c.size && g.rate <= slow(a, b) && c.restitution > 0 && leans(c))
                    return touch(index, t, m, a, b);
                if (const auto closes = g.closes()) next = std::min(next, *closes);
            }
            if (t + next > h_) break;
            t += std::max(next, 1e-16 * h_);
        }
        if (!c.rests && c.restitution > 0) open(c, true);
    }

    void touch(std::uint32_t index, double t, const Manifold& m, const Side& a, const Side& b) {
        SoftContact& c = contacts_.all[index];
        double approach = 0, pull = 0;
        for (int k = 0; k < m.count; ++k) {
            const Gap g = gap(c, m, k, a, b);
            if (m.point[k].gap > 1e-9 * c.size) continue;
            approach = std::max(approach, -g.rate), pull = std::max(pull, -g.acceleration);
        }
        const double press = press_of(a, b);
        pull = pull_of(pull, restitution(c), press, c.size, h_);
        // Momentum that runs through a row strikes each contact once or twice; discs that overlap would never be done.
        const bool too_many = struck_ > 1000 + 10 * contacts_.all.size();
        if (!too_many && !rests_on(c, approach, pull))
            queue_.push({t, approach, index, version_[index]});
        else if (!c.rests)
            close(c, m, a, b);
    }
    /// Whether a contact presses from now on. If it did before, it still passes on what strikes it from behind.
    bool rests_on(const SoftContact& c, double approach, double pull) const {
        if (c.restitution == 0) return c.rests && approach <= shortest * h_ * pull;
        return comes_to_rest(restitution(c), approach, pull, h_, struck_, shortest);
    }
    static constexpr double shortest = 0.25;  ///< of a substep: what bounces less is one of the contacts that press

    /// What one of the two leans on holds it in the end, but not yet where the integrator put it: it falls with the
    /// other, and even an elastic bounce must end in time.
    bool leans(const SoftContact& c) const { return leans_[c.a] || leans_[c.b]; }
    double restitution(const SoftContact& c) const { return leans(c) ? std::min(c.restitution, 0.999) : c.restitution; }
    static double press_of(const Side& a, const Side& b) { return std::max(length(a.a), length(b.a)); }
    double slow(const Side& a, const Side& b) const { return 0.5 * shortest * h_ * press_of(a, b); }

    void strike(const Strike& s) {
        SoftContact& c = contacts_.all[s.contact];
        Side a = side(c.a, s.time), b = side(c.b, s.time);
        const Manifold m = look_at(c, a, b);
        bounce(c, m, a, b, s.time);
        if (c.restitution == 0 && !c.rests) close(c, m, a, b);
        contacts_.bounces.back().approach = s.approach;
        c.touched = true;
        ++struck_, ++contacts_.strikes;
        for (const std::uint32_t row : {c.a, c.b})
            if (moves(scene_, row))
                for (const std::uint32_t other : contacts_.of_body[row]) predict(other, s.time);
    }

    /// The impulses of an impact at the points of its contact, while they are found.
    struct Blow {
        const SoftContact& contact;
        const Manifold& manifold;
        Side a, b;
        std::array<Vec2, 2> lever[2]{};
        bool active[2]{};
        double normal[2]{}, tangent[2]{};

        Vec2 n() const { return manifold.normal; }
        Vec2 t() const { return perpendicular(manifold.normal); }
        Vec2 velocity(int k) const { return b.velocity_at(lever[k][1]) - a.velocity_at(lever[k][0]); }
        double easiness(int k, Vec2 along) const {
            const double ra = cross(lever[k][0], along), rb = cross(lever[k][1], along);
            return a.inverse_mass + b.inverse_mass + a.inverse_inertia * ra * ra + b.inverse_inertia * rb * rb;
        }
        void apply(int k, Vec2 impulse) {
            a.push(lever[k][0], -impulse);
            b.push(lever[k][1], impulse);
        }
        void push(int k, double impulse) {
            normal[k] += impulse;
            apply(k, impulse * n());
        }
        void rub(int k) {
            const double most = contact.friction * normal[k], before = tangent[k];
            const double slip = dot(velocity(k), t()) - contact.surface_speed;
            tangent[k] = std::clamp(before - slip / easiness(k, t()), -most, most);
            apply(k, (tangent[k] - before) * t());
        }
        /// The impulses that end the approach of all points together.
        void compress() {
            for (int sweep = 0; sweep < 200; ++sweep) {
                double change = 0;
                for (int k = 0; k < manifold.count; ++k) {
                    if (!active[k]) continue;
                    const double before = normal[k];
                    push(k, std::max(-before, -dot(velocity(k), n()) / easiness(k, n())));
                    change = std::max(change, std::abs(normal[k] - before) / (normal[k] + before + 1e-300));
                    if (contact.friction > 0) rub(k);
                }
                if (change < 1e-15 || (manifold.count == 1 && contact.friction == 0)) break;
            }
        }
    };

    /// Poisson's impact: the impulses that end the approach, and then e times those once more, with Coulomb's friction
    /// in both. It never makes energy, which Newton's rule does with friction.
    void bounce(const SoftContact& c, const Manifold& m, const Side& a, const Side& b, double time) {
        Blow blow{.contact = c, .manifold = m, .a = a, .b = b};
        for (int k = 0; k < m.count; ++k) {
            blow.lever[k] = levers(c, m, k, a, b);
            blow.active[k] = m.point[k].gap <= 1e-9 * c.size;
        }
        blow.compress();
        const double compressed[2] = {blow.normal[0], blow.normal[1]};
        for (int k = 0; k < m.count; ++k) blow.push(k, c.restitution * compressed[k]);
        for (int k = 0; c.friction > 0 && k < m.count; ++k) blow.rub(k);
        for (int k = 0; k < m.count; ++k) book(blow, k, a, b);
        change(a, blow.a, time);
        change(b, blow.b, time);
        note(blow, time);
    }

    /// The work of an impulse is that on the mean of the velocities before and after.
    void book(const Blow& blow, int k, const Side& a, const Side& b) {
        const auto mean_of = [&](int i, const Side& first, const Side& last) {
            return Twist{0.5 * (first.velocity_at(blow.lever[k][i]) + last.velocity_at(blow.lever[k][i])), 0};
        };
        const Twist mean_a = mean_of(0, a, blow.a), mean_b = mean_of(1, b, blow.b);
        const Vec2 mean = mean_b.velocity - mean_a.velocity;
        const double speed = blow.contact.surface_speed, rubbed = blow.tangent[k];
        end_.account[Account::impact] -= blow.normal[k] * dot(mean, blow.n());
        end_.account[Account::friction] -= rubbed * (dot(mean, blow.t()) - speed);
        end_.account[Account::driven] += rubbed * speed;
        book_held(scene_, blow.contact, b.x + blow.lever[k][1], blow.normal[k] * blow.n() + rubbed * blow.t(), 0,
                  mean_a, mean_b, end_.account);
    }

    /// For those who listen to events.
    void note(const Blow& blow, double time) {
        Impact impact{.shapes = shapes_of(scene_, blow.contact), .time = start_.time + time, .normal = blow.n()};
        const double first = blow.normal[0], second = blow.normal[1];
        impact.impulse = first + second;
        impact.point = blow.b.x + (first * blow.lever[0][1] + second * blow.lever[1][1]) / impact.impulse;
        contacts_.bounces.push_back(impact);
    }

    /// Lets a body go on from a time with other velocities, as if it had had them from the start.
    void change(const Side& before, const Side& after, double time) {
        if (before.inverse_mass == 0) return;
        const std::uint32_t i = before.row;
        const Vec2 dv = after.v - before.v;
        const double dw = after.w - before.w, left = h_ - time;
        const double m = scene_.bodies.mass[i], inertia = scene_.bodies.inertia[i];
        end_.account[Account::method] +=
            m * dot(dv, end_.v.linear[i] - before.v) + inertia * dw * (end_.v.angular[i] - before.w);
        Gains gains(scene_.flight.dynamics);
        gains.add(i, end_.x.linear[i], end_.v.linear[i], end_.v.angular[i], left * dv, dv, dw);
        end_.account[Giver::method].add(gains.momentum().force, gains.momentum().torque);
        start_.v.linear[i] += dv, end_.v.linear[i] += dv;
        start_.v.angular[i] += dw, end_.v.angular[i] += dw;
        end_.x.linear[i] += left * dv;
        end_.x.angular[i] += left * dw;
    }

    void open(const SoftContact& c, bool is) {
        for (auto& p : contacts_.blocks[c.block].point) p.open[c.row] = is ? 1 : 0;
    }
    /// From now on the contact is one that rests.
    void close(SoftContact& c, const Manifold& m, const Side& a, const Side& b) {
        c.manifold = m;
        const Mover before[2] = {contacts_.movers[c.a], contacts_.movers[c.b]};
        place(contacts_.movers[c.a], a.x, a.angle);
        place(contacts_.movers[c.b], b.x, b.angle);
        fill_row(scene_, c, contacts_);
        contacts_.movers[c.a] = before[0], contacts_.movers[c.b] = before[1];
        c.rests = true;
    }

    void list_by_body() {
        contacts_.of_body.resize(start_.size());
        for (auto& list : contacts_.of_body) list.clear();
        for (std::uint32_t i = 0; i < contacts_.all.size(); ++i)
            for (const std::uint32_t row : {contacts_.all[i].a, contacts_.all[i].b})
                if (row < start_.size()) contacts_.of_body[row].push_back(i);
    }

    const SoftScene& scene_;
    State &start_, &end_;
    double h_;
    SoftContacts& contacts_;
    Motion acceleration_;
    std::vector<std::uint32_t> version_;
    std::vector<bool> leans_;  ///< bodies that press on something since before this step
    std::priority_queue<Strike> queue_;
    std::size_t struck_ = 0;
};

}  // namespace

void strike(const SoftScene& scene, State& start, State& end, double h, SoftContacts& contacts) {
    const auto& all = contacts.all;
    if (std::none_of(all.begin(), all.end(), Strikes::bounces)) return;
    Strikes(scene, start, end, h, contacts).run();
}

}  // namespace carom
