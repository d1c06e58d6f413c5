// The impact phase of SoftStep: bounces at their instants, one pair after the other, the earliest first and of those at
// one instant the hardest. So momentum runs through a row of touching bodies as it does through Newton's cradle, and
// the rest of the substep is spent and not dropped.

#include <algorithm>
#include <cmath>
#include <deque>
#include <queue>

#include "forces/gains.hpp"
#include "math/scratch.hpp"
#include "solvers/candidates.hpp"
#include "solvers/links.hpp"
#include "solvers/passage.hpp"
#include "solvers/pivots.hpp"
#include "solvers/time_of_impact.hpp"

namespace carom {

namespace {

class Strikes {
  public:
    Strikes(const SoftScene& scene, State& start, State& end, double h, SoftContacts& contacts)
        : scene_(scene),
          start_(start),
          end_(end),
          h_(h),
          contacts_(contacts),
          passage_(scene, start, end, h, contacts),
          version_(contacts.all.size(), 0),
          count_(contacts.all.size(), 0),
          known_(contacts.all.size(), unknown),
          stirred_at_(start.size() + 1, 0),
          settled_at_(contacts.all.size(), 0),
          blow_(start.size()),
          links_(scene.mechanisms, start.size()),
          patience_(std::max<std::size_t>(100000, 5 * contacts.all.size())),
          looks_(5000 + 20 * contacts.all.size()) {}

    void run() {
        for (const std::uint32_t i : contacts_.lists.strikers)
            if (!contacts_.all[i].rests) predict(i, 0);
        while (true) {
            if (queue_.empty() || queue_.top().time > instant_) settle_waiting();
            if (queue_.empty()) return;
            const NextBlow next = queue_.top();
            queue_.pop();
            if (next.version != version_[next.contact]) continue;
            waits(next.contact) ? settle(next.contact, instant_, blow_) : strike(next);
        }
    }

  private:
    /// How fast the two show other corners [rad/s].
    double turning(const SoftContact& c, const Partner& a, const Partner& b) const {
        return passage_.of_turning(c, a, b, [](const Partner& p) { return std::abs(p.w); });
    }
    /// How long gaps change as they do now: bodies that turn soon show other corners.
    double foreseeable(const SoftContact& c, const Partner& a, const Partner& b) const {
        constexpr double slight = 0.05;  // [rad]: a lever that turns so far is off its tangent by 1e-3 of its length
        const double w = turning(c, a, b);
        return w * 2 * h_ > slight ? std::max(slight / w, h_ / (attention_ > 0 ? fine : coarse)) : 2 * h_;
    }
    /// Whether the two turn so far in this substep that a contact that rests in it would be wrong about where their
    /// corners are by more than a tenth of the thinner one: for that, levers stay on their tangents.
    bool whirl(const SoftContact& c, const Partner& a, const Partner& b) const {
        if (attention_ <= 0) return false;
        const double least = 0.2 * thickness(c.candidate(), contacts_.pieces);
        return passage_.of_turning(c, a, b, [&](const Partner& p) {
            if (p.row >= start_.size()) return 0.0;
            const double so_far = std::abs(end_.x.angular[p.row] - start_.x.angular[p.row]);
            const double angle = std::max(so_far, h_ * std::abs(p.w));
            return angle * angle * contacts_.pieces.extent[p.row];
        }) > least;
    }

    bool rests_on(std::uint32_t index, const Gap& g, const Partner& a, const Partner& b) {
        return rests_on(index, -g.rate, -g.acceleration, press_of(a, b));
    }
    /// Whether what bounces falls over the corner on which it stands: the other one comes down, and not to rest.
    bool falls_over(std::uint32_t index, const Manifold& m, const Partner& a, const Partner& b) {
        const SoftContact& c = contacts_.all[index];
        if (c.restitution == 0 || m.count < 2) return false;
        const Gap first = Passage::gap(c, m, 0, a, b), second = Passage::gap(c, m, 1, a, b);
        const Gap& last = first.width < second.width ? second : first;
        return last.width > 1e-9 * c.size && !rests_on(index, last, a, b);
    }

    /// Finds the next strike of a contact after a time, or that it rests from then on, or that nothing touches.
    void predict(std::uint32_t index, double from) {
        SoftContact& c = contacts_.all[index];
        ++version_[index];
        const double close = 1e-12 * c.size;
        double t = from;
        for (int i = 0; i < 100 + fine; ++i) {
            if (i > enough_looks) {
                if (looks_ == 0) return;  // sweeps have it as it is
                --looks_, --attention_;
            }
            const Partner a = passage_.at(c.a, t), b = passage_.at(c.b, t);
            if (i == 0 && passage_.stay_apart(c, t, a, b) > h_ - t) break;
            const Manifold m = Passage::look_at(scene_, c, a, b);
            const double beside = m.count == 0 ? passage_.gap_beside(c, a, b) : 0;
            c.seen = {m.count == 0 ? beside : least_gap(m), b.x - a.x, a.angle, b.angle};
            double next = beside > 0 ? passage_.little_way(c, a, b) : foreseeable(c, a, b);
            // Who turns so fast lifts the corner off at once on which he stands, and it is the next one that matters.
            const double lifts = whirl(c, a, b) ? 2 * slow(a, b) + 1e-9 * turning(c, a, b) * c.size : -HUGE_VAL;
            const bool falls = falls_over(index, m, a, b);
            for (int k = 0; k < m.count; ++k) {
                const Gap g = Passage::gap(c, m, k, a, b);
                // A bounce that does not end the overlap is to be held, too: what presses would only press deeper.
                const bool stuck = is_stuck(c, g, h_ - t),
                           stays = g.rate >= -lifts || (falls && rests_on(index, g, a, b));
                if (g.width <= 1e-9 * c.size && stays && !(stuck && passage_.leans(c))) continue;
                if (stuck || (g.width <= close && g.rate < 0)) return touch(index, t, m, a, b);
                if (g.width <= 1e-9 * c.size && g.rate <= slow(a, b) && (c.restitution == 0 || passage_.leans(c)))
                    return touch(index, t, m, a, b);
                if (const auto closes = g.closes()) next = std::min(next, *closes);
            }
            next = std::max(next, passage_.stay_apart(c, t, a, b));
            if (t + next > h_) break;
            t += std::max(next, 1e-15 * h_);  // and no less than what changes it
        }
        is_pulled_in(c) ? hold(index, t) : part(c);
    }

    void touch(std::uint32_t index, double t, const Manifold& m, const Partner& a, const Partner& b) {
        SoftContact& c = contacts_.all[index];
        double approach = 0, pull = 0;
        for (int k = 0; k < m.count; ++k) {
            const Gap g = Passage::gap(c, m, k, a, b);
            if (m.point[k].gap > 1e-9 * c.size) continue;
            approach = std::max(approach, -g.rate), pull = std::max(pull, -g.acceleration);
        }
        const double press = press_of(a, b);
        pull = pull_of(pull, restitution(c), press, c.size, std::max(h_, contacts_.pace.slow));
        // Momentum that runs through a row strikes each contact once or twice; discs that overlap would never be done.
        // What is elastic ends of itself, but for what hangs on joints: a light disc between a wall and a heavy one
        // strikes them thousands of times.
        const bool is_elastic = restitution(c) >= 1 && !c.rests && !links_.hold(c) && !overlaps(c, least_gap(m));
        const std::size_t most = is_elastic ? 50000 + 100 * contacts_.all.size() : 1000 + 10 * contacts_.all.size();
        // Who has no room strikes others without end. What does not move keeps in whom it can, though.
        const bool in_vain = patience_ == 0 && ((moves(scene_, c.a) && moves(scene_, c.b)) || count_[index] > enough);
        const bool too_many = struck_ > most || (c.rests && count_[index] > enough) ||
                              (c.restitution == 0 && in_vain) || (chatter_ && chatter_->is_endless(index));
        if (!too_many && !rests_on(index, approach, pull, press))
            queue_.push({t, approach, index, version_[index]});
        else if (!c.rests)
            whirl(c, a, b) ? part(c) : close(index, m, a, b);
    }
    /// Whether a contact presses from now on. If it did before, it still passes on what strikes it from behind. Where a
    /// part of the substep began for it to touch all but nothing is a blow.
    bool rests_on(std::uint32_t index, double approach, double pull, double press) {
        const SoftContact& c = contacts_.all[index];
        constexpr double all_but_nothing = 0.01;
        const double little = c.lands ? all_but_nothing : (c.rests ? 1 : 0) + least_bounce;
        if (c.restitution == 0) return approach <= little * h_ * std::max(pull, press);
        constexpr std::size_t some = 16;  // who struck less often is not of those who rattle, maybe far away
        const std::size_t blows = count_[index] > some ? struck_ : count_[index];
        return comes_to_rest({restitution(c), approach, pull, c.size}, h_, blows, least_bounce);
    }
    static constexpr std::uint32_t enough = 3;  ///< strikes of a contact among bodies that rest, or have no room

    /// What one of the two leans on holds it in the end, but not yet where the integrator put it: it falls with the
    /// other, and even an elastic bounce must end in time.
    double restitution(const SoftContact& c) {
        return passage_.leans(c) ? std::min(c.restitution, 0.999) : c.restitution;
    }
    double slow(const Partner& a, const Partner& b) const { return 0.5 * least_bounce * h_ * press_of(a, b); }

    void strike(const NextBlow& s) {
        instant_ = s.time;
        Blow& blow = blow_;
        blow.clear(), links_.begin();
        join(s.contact, s.time, blow);
        if (is_inelastic(s.contact))
            spread(s.time, blow);
        else
            join_level(s.time, blow), blow.bounce(contacts_.all);
        if (++struck_ > most_inelastic) count_chatter(s);
        for (const Struck& hit : blow.struck) {
            if (!hit.pushes()) continue;
            SoftContact& struck = contacts_.all[hit.index];
            ++count_[hit.index];
            book(struck, hit, blow);
            if (!struck.rests) note(struck, hit, blow, s.time);
            const Partner &a = blow.now[hit.a], &b = blow.now[hit.b];
            if (struck.restitution == 0 && !struck.rests && !whirl(struck, a, b)) close(hit.index, hit.manifold, a, b);
            struck.touched = true;
        }
        if (!blow.yields.empty()) book_joints(blow, links_.settle(blow));
        for (std::size_t k = 0; k < blow.now.size(); ++k) change(blow.before[k], blow.now[k], s.time);
        predict_again(blow, s.time);
    }

    /// In a substep of few blows nothing chatters.
    void count_chatter(const NextBlow& s) {
        if (!chatter_) chatter_.emplace(contacts_.all.size(), scene_.bodies);
        const double lightest = std::max(blow_.now[0].inverse_mass, blow_.now[1].inverse_mass);
        chatter_->goes_on(s.contact, s.approach, s.time, lightest, contacts_.all[s.contact].size);
    }

    /// Whether a blow is shared with all that touches. Bounces among bodies that lean on one another end so too, for
    /// they would go on for ever.
    bool is_inelastic(std::uint32_t index) {
        const SoftContact& c = contacts_.all[index];
        return c.restitution == 0 || (passage_.leans(c) && count_[index] > enough);
    }

    /// A contact joins a blow if it is the first of it, or touches and does not bounce. Returns its place there, or
    /// `nowhere`.
    std::uint32_t join(std::uint32_t index, double t, Blow& blow) {
        if (known_[index] != unknown) return known_[index];
        known_[index] = nowhere;
        asked_.push_back(index);
        if (!blow.struck.empty() && !is_inelastic(index)) return nowhere;
        const SoftContact& c = contacts_.all[index];
        const auto in_flight = [&](std::uint32_t row) { return passage_.at(row, t); };
        const auto at = [&](std::uint32_t row) { return links_.held(row, in_flight); };
        const Partner a = at(c.a), b = at(c.b);
        const Manifold m = Passage::look_at(scene_, c, a, b);
        spend(2);
        // What lands flat but for a hair lands on both its corners, and not on the one and then the other.
        const double close = (is_inelastic(index) ? 1e-4 : 1e-9) * c.size;
        const bool touches = m.count > 0 && (m.point[0].gap <= close || m.point[m.count - 1].gap <= close);
        if (!touches && !blow.struck.empty()) return nowhere;
        blow.add(index, c, m, a, b, close);
        if (links_.hold(c)) links_.tie(blow, blow.struck.back(), at), links_.turn(blow, blow.struck.back(), in_flight);
        return known_[index] = static_cast<std::uint32_t>(blow.struck.size() - 1);
    }

    /// A floor of several pieces is struck as if it were one: who comes down flat on a seam would else bounce off the
    /// one and then off the other, and tumble.
    void join_level(double t, Blow& blow) {
        const std::uint32_t first = blow.struck[0].index;
        const SoftContact& c = contacts_.all[first];
        const auto is_held = [&](const SoftContact& of) { return moves(scene_, of.a) != moves(scene_, of.b); };
        if (!is_held(c) || links_.hold(c)) return;
        const std::uint32_t row = moves(scene_, c.a) ? c.a : c.b;
        const auto up = [row](const SoftContact& of, const Manifold& m) { return (row == of.b ? 1 : -1) * m.normal; };
        const Vec2 plane = up(c, blow.struck[0].manifold);
        contacts_.by_body.each(row, [&](std::uint32_t index) {
            const SoftContact& other = contacts_.all[index];
            if (index == first || !is_held(other) || other.rests || other.crowded || is_inelastic(index)) return;
            const Partner a = passage_.at(other.a, t), b = passage_.at(other.b, t);
            const Manifold m = Passage::look_at(scene_, other, a, b);
            const double close = 1e-9 * other.size;
            if (m.count == 0 || least_gap(m) > close || dot(up(other, m), plane) < 1 - 1e-12) return;
            blow.add(index, other, m, a, b, close), spend(2);
        });
    }

    /// What is pushed pushes on what it touches, until nothing comes together faster than sweeps may well end, or than
    /// a tenth of what struck; or a hundredth among few, where a row that is left so is seen to drift apart.
    void spread(double t, Blow& blow) {
        std::deque<std::uint32_t, ScratchAllocator<std::uint32_t>> waiting{0};
        const double left = (are_few(scene_) ? 0.01 : 0.1) * blow.struck[0].approach,
                     tolerated = std::max(0.5 * gentle * h_ * press_of(blow.now[0], blow.now[1]), left);
        for (std::size_t n = 0; !waiting.empty() && n < 200 + 10 * blow.struck.size() && (n == 0 || patience_ > 0);
             ++n) {
            spend(1);
            const std::uint32_t k = waiting.front();
            waiting.pop_front();
            blow.struck[k].waits = false;
            const std::uint32_t index = blow.struck[k].index;
            if (n > 0 && !blow.struck[k].pushes() && blow.approach(blow.struck[k]) <= tolerated) continue;
            if (blow.compress(contacts_.all[index], blow.struck[k], n == 0 ? 200 : 4) <= 0.3 * tolerated) continue;
            const auto push_on = [&](std::uint32_t side) {
                const std::uint32_t row = blow.now[side].row;
                if (!moves(scene_, row) || blow.most_change(side, contacts_.pieces.extent[row]) <= 0.3 * tolerated)
                    return;
                contacts_.by_body.each(row, [&](std::uint32_t other) {
                    const std::uint32_t l = other == index ? nowhere : join(other, t, blow);
                    if (l == nowhere || blow.struck[l].waits) return;
                    blow.struck[l].waits = true;
                    waiting.push_back(l);
                });
            };
            const Struck::Range linked = blow.struck[k].yields[0][0];
            if (linked.first == linked.last) push_on(blow.struck[k].a), push_on(blow.struck[k].b);
            for (std::uint32_t i = linked.first; i < linked.last; ++i) push_on(blow.yields[i].side);
        }
    }

    void spend(std::size_t work) { patience_ -= std::min(work, patience_); }

    /// Finds what comes next for all that was pushed, and notes for whom that waits.
    void predict_again(const Blow& blow, double t) {
        Scratch<std::uint32_t> stirred;
        for (std::size_t k = 0; k < blow.now.size(); ++k) {
            const Partner &was = blow.before[k], &is = blow.now[k];
            if (!moves(scene_, is.row) || (was.v == is.v && was.w == is.w)) continue;
            if (contacts_.by_body.count(is.row) > many) {
                if (stirred_at_[is.row] <= settled_) waiting_.push_back(is.row);
                stirred_at_[is.row] = struck_;
            } else {
                contacts_.by_body.each(is.row, [&](std::uint32_t index) { stirred.push_back(index); });
            }
        }
        std::sort(stirred.begin(), stirred.end());
        stirred.erase(std::unique(stirred.begin(), stirred.end()), stirred.end());
        for (const std::uint32_t index : stirred) settle(index, t, blow);
        if (blow.struck.size() > 1) spend(3 * stirred.size());
        for (const std::uint32_t index : asked_) known_[index] = unknown;
        asked_.clear();
    }
    /// Who touches more than so many is struck by many at one instant. What comes next for his other contacts waits
    /// until it is over, or until they are due in it.
    static constexpr std::uint32_t many = 32;
    /// Whether one of a contact's two was pushed since it was looked at what comes next.
    bool waits(std::uint32_t index) const {
        const SoftContact& c = contacts_.all[index];
        return std::max(stirred_at_[c.a], stirred_at_[c.b]) > settled_at_[index];
    }
    void settle_waiting() {
        Scratch<std::uint32_t> stirred;
        for (const std::uint32_t row : waiting_)
            contacts_.by_body.each(row, [&](std::uint32_t index) {
                if (waits(index)) stirred.push_back(index);
            });
        std::sort(stirred.begin(), stirred.end());
        for (const std::uint32_t index : stirred)
            if (waits(index)) settle(index, instant_, blow_);
        spend(stirred.size());
        waiting_.clear(), settled_ = struck_;
    }
    void settle(std::uint32_t index, double t, const Blow& blow) {
        settled_at_[index] = struck_;
        contacts_.all[index].crowded || lies_on(index, t, blow) ? void(++version_[index]) : predict(index, t);
    }
    /// Whether a contact that rests presses on as it did before: nothing strikes it from behind.
    bool lies_on(std::uint32_t index, double t, const Blow& blow) {
        const SoftContact& c = contacts_.all[index];
        if (!c.rests) return false;
        if (known_[index] < unknown) {
            const Struck& s = blow.struck[known_[index]];
            return blow.approach(s) <= h_ * press_of(blow.now[s.a], blow.now[s.b]);
        }
        const Partner a = passage_.at(c.a, t), b = passage_.at(c.b, t);
        const ContactBlock& block = contacts_.layout.blocks[c.block];
        const Vec2 n{block.normal_x[c.row], block.normal_y[c.row]};
        double approach = 0;
        for (int k = 0; k < static_cast<int>(block.points); ++k) {
            if (block.more[k].open[c.row] != 0) continue;
            const Vec2 v = b.velocity_at(lever_b_of(block, k, c.row)) - a.velocity_at(lever_a_of(block, k, c.row));
            approach = std::max(approach, -dot(v, n));
        }
        return approach <= h_ * press_of(a, b);
    }

    /// The work of an impulse is that on the mean of the velocities before and after.
    void book(const SoftContact& c, const Struck& hit, const Blow& blow) {
        const Vec2 n = hit.manifold.normal, t = perpendicular(n);
        const auto mean_of = [&](std::uint32_t k, Vec2 lever) {
            return Twist{0.5 * (blow.before[k].velocity_at(lever) + blow.now[k].velocity_at(lever)), 0};
        };
        for (int k = 0; k < hit.manifold.count; ++k) {
            const Twist mean_a = mean_of(hit.a, hit.lever[k][0]), mean_b = mean_of(hit.b, hit.lever[k][1]);
            const Vec2 mean = mean_b.velocity - mean_a.velocity;
            // Of a slip that ended or turned on the way the mean says nothing.
            const double pressed = hit.normal[k] * dot(mean, n),
                         rubbed = hit.tangent[k] * (dot(mean, t) - c.surface_speed),
                         followed = hit.is_followed && k == hit.lone() ? hit.rubbed : rubbed;
            end_.account[Account::impact] -= pressed + (rubbed - followed);
            end_.account[Account::friction] -= followed;
            end_.account[Account::driven] += hit.tangent[k] * c.surface_speed;
            const Vec2 impulse = hit.normal[k] * n + hit.tangent[k] * t;
            book_held(scene_, c, blow.now[hit.b].x + hit.lever[k][1], impulse, 0, mean_a, mean_b, end_.account);
            book_driven_spin(scene_, end_, c, {hit.lever[k][0], hit.lever[k][1]}, impulse, 0, end_.account);
        }
    }

    /// Rigid rows do no work but for what the bodies were not as they hold them.
    void book_joints(const Blow& blow, double on_kept_spins) {
        end_.account[Account::driven] -= on_kept_spins;
        double work = on_kept_spins;
        for (std::size_t k = 0; k < blow.now.size(); ++k) {
            const Partner &was = blow.before[k], &is = blow.now[k];
            if (was.inverse_mass == 0) continue;
            work += 0.5 * scene_.bodies.mass[was.row] * dot(is.v - was.v, is.v + was.v) +
                    0.5 * scene_.bodies.inertia[was.row] * (is.w - was.w) * (is.w + was.w);
        }
        for (const Struck& hit : blow.struck)
            for (int k = 0; k < hit.manifold.count; ++k) {
                const Vec2 n = hit.manifold.normal, impulse = hit.normal[k] * n + hit.tangent[k] * perpendicular(n);
                // A spin that nothing changes has its work on the account of who keeps it.
                const auto moved = [](const Partner& p, Vec2 lever) {
                    return p.inverse_inertia == 0 ? p.v : p.velocity_at(lever);
                };
                const auto given = [&](std::uint32_t side, Vec2 lever) {
                    const Partner &was = blow.before[side], &is = blow.now[side];
                    return was.inverse_mass == 0 ? 0 : 0.5 * dot(impulse, moved(was, lever) + moved(is, lever));
                };
                work += given(hit.a, hit.lever[k][0]) - given(hit.b, hit.lever[k][1]);
            }
        end_.account[Account::method] += work;
    }

    /// For those who listen to events.
    void note(const SoftContact& c, const Struck& hit, const Blow& blow, double time) {
        Impact impact{.shapes = c.shapes(), .time = start_.time + time, .normal = hit.manifold.normal};
        const double first = hit.normal[0], second = hit.normal[1];
        impact.approach = hit.approach, impact.impulse = first + second;
        impact.point = blow.now[hit.b].x + (first * hit.lever[0][1] + second * hit.lever[1][1]) / impact.impulse;
        contacts_.events.bounces.push_back(impact);
        ++contacts_.strikes;
    }

    /// Lets a body go on from a time with other velocities, as if it had had them from the start.
    void change(const Partner& before, const Partner& after, double time) {
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
        if (dv != Vec2{} || dw != 0) contacts_.events.kinks.push_back({i, start_.time + time, dv, dw});
    }

    /// Whether joints may press what was bouncing and overlaps back in, who are yet to act in this substep.
    bool is_pulled_in(const SoftContact& c) {
        return !c.rests && c.restitution < 1 && links_.hold(c) && overlaps(c, least_gap(c.manifold));
    }
    void hold(std::uint32_t index, double t) {
        const SoftContact& c = contacts_.all[index];
        const Partner a = passage_.at(c.a, t), b = passage_.at(c.b, t);
        const Manifold m = Passage::look_at(scene_, c, a, b);
        m.count > 0 ? close(index, m, a, b) : part(c);
    }
    /// Nothing touches in this substep.
    void part(const SoftContact& c) {
        if (c.rests) return;
        ContactBlock& block = contacts_.layout.blocks[c.block];
        for (auto& p : block.more) {
            if (p.open[c.row] == 0) block.is_measured = false;
            p.open[c.row] = 1;
        }
    }
    /// From now on the contact is one that rests.
    void close(std::uint32_t index, const Manifold& m, const Partner& a, const Partner& b) {
        passage_.close(index);
        SoftContact& c = contacts_.all[index];
        take_out(c, h_, contacts_);
        c.manifold = m;
        c.rests = true;
        if (!c.crowded && !is_looked_at_anew(c) && turns_in(h_, c, a.w, b.w)) {
            c.pivots = true;  // and not only from the next step on: what is left of this one would press its corner in
            contacts_.lists.changing.push_back(index);
        }
        fill_row(scene_.bodies, c, frame_at(a.x, a.angle), frame_at(b.x, b.angle), contacts_);
        put_in(c, h_, contacts_);
    }

    const SoftScene& scene_;
    State &start_, &end_;
    double h_;
    SoftContacts& contacts_;
    Passage passage_;
    static constexpr std::uint32_t nowhere = 0xffffffff, unknown = nowhere - 1;
    Scratch<std::uint32_t> version_;   ///< of the prediction of each contact
    Scratch<std::uint32_t> count_;     ///< how often it struck
    std::optional<Chatter> chatter_;   ///< of contacts, once there were many blows
    Scratch<std::uint32_t> known_;     ///< its place in the blow of now
    Scratch<std::uint32_t> asked_;     ///< of which that is known
    Scratch<std::size_t> stirred_at_;  ///< by row: which blow pushed him last who touches many
    Scratch<std::size_t> settled_at_;  ///< after which blow it was looked at what comes next for a contact
    std::size_t settled_ = 0;          ///< and for all of them
    Scratch<std::uint32_t> waiting_;   ///< rows of who was pushed since then and touches many
    double instant_ = 0;               ///< of the last blow
    std::priority_queue<NextBlow, Scratch<NextBlow>> queue_;
    Blow blow_;
    Links links_;
    std::size_t struck_ = 0;
    static constexpr int coarse = 50, fine = 500;  ///< looks in a substep at what turns fast
    static constexpr int enough_looks = 4;         ///< at what does not turn, to foresee a strike
    int attention_ = 10 * fine;                    ///< to what needs more, in this substep
    std::size_t patience_;  ///< for blows in this substep: those of a crowd inside one another have no end
    std::size_t looks_;     ///< left to what needs more: what spins beyond all measure strikes without end
};

}  // namespace

void strike(const SoftScene& scene, State& start, State& end, double h, SoftContacts& contacts) {
    const auto rests = [&](std::uint32_t index) { return contacts.all[index].rests; };
    if (std::all_of(contacts.lists.strikers.begin(), contacts.lists.strikers.end(), rests)) return;
    contacts.by_body.list(contacts.all, contacts.motion.movers.size());
    Strikes(scene, start, end, h, contacts).run();
}

}  // namespace carom
