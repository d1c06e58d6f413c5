#include "solvers/statics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/parts.hpp"

namespace carom {

namespace {
constexpr double rounding = 1e-12, finest = 1e-14;

/// What is left of a force that is more than allowed, and of the spring that bears it, for it to bear this part of that
/// the next time: a secant.
double eased(double force, double allowed, double part) {
    return std::abs(force) > allowed ? std::max(part * allowed / std::abs(force), rounding) : 1;
}
}  // namespace

Statics::Statics(const SoftScene& scene, const SoftContacts& contacts, const Scratch<std::uint32_t>& rows,
                 std::size_t count, Springs& springs)
    : scene_(scene),
      contacts_(contacts),
      bodies_(scene.bodies, rows),
      loads_(bodies_.size()),
      sizes_(bodies_.size()),
      v_(bodies_.size()),
      springs_(springs) {
    constexpr std::size_t points = 2;
    supports_.reserve(points * count), couplings_.reserve(points * count);
    const Motion& acceleration = contacts.motion.rates.acceleration;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Vec2 a = acceleration.linear[rows[i]];
        const double turning = acceleration.angular[rows[i]];
        for (std::size_t k = 3 * i; const double along : {a.x, a.y, turning}) {
            loads_[k] = bodies_.mass[k] * along;
            sizes_[k] = std::abs(loads_[k]), ++k;
        }
    }
}

Statics::Prop Statics::prop(const IslandRow& row, double limit, double before) const {
    constexpr double least = 1e-200;  // who has no moment of inertia is not turned
    const double inverse_mass = bodies_.inverse_mass(row);
    return {row, limit, limit > 0 && inverse_mass > least ? 1 / inverse_mass : 0, before};
}

/// Whether loads press bodies at these places together along a line, or may: who has none is pressed by others.
bool Statics::is_loaded(Vec2 along, std::uint32_t place_a, std::uint32_t place_b) const {
    constexpr double across = 0.1;  // rad
    const auto presses = [&](std::uint32_t place) {
        if (place == no_place) return false;
        const Vec2 load{loads_[3 * place], loads_[3 * place + 1]};
        return std::abs(dot(load, along)) > across * length(load) || load == Vec2{};
    };
    return presses(place_a) || presses(place_b);
}

/// Of bodies that hold others up nobody notes how long they have been at rest.
bool Statics::is_edited(std::uint32_t row, std::uint32_t place) const {
    return place != no_place && contacts_.rest.is_edited(row);
}

void Statics::add(SoftContact& c, std::uint32_t place_a, std::uint32_t place_b) {
    const Vec2 x_a = contacts_.motion.frames[c.a].position, x_b = contacts_.motion.frames[c.b].position,
               n = c.manifold.normal;
    constexpr double of_size = 1e-12, of_places = 16 * std::numeric_limits<double>::epsilon();
    const double farthest = std::max({std::abs(x_a.x), std::abs(x_a.y), std::abs(x_b.x), std::abs(x_b.y)});
    const bool is_elsewhere = is_edited(c.a, place_a) || is_edited(c.b, place_b);
    for (int i = 0; i < c.manifold.count; ++i) {
        const bool presses = !is_elsewhere && c.preload[i] > 0 && c.normal_force[i] > 0;
        if (!presses && c.manifold.point[i].gap > of_size * c.size + of_places * farthest) {
            apart_.emplace_back(&c, i);
            continue;
        }
        const auto [lever_a, lever_b] = levers(c, c.manifold, i, x_b - x_a);
        const auto push = [&, &a = lever_a, &b = lever_b](Vec2 along) {
            return IslandRow::push(place_a, place_b, along, a, b);
        };
        Stop normal{prop(push(n), 1, c.normal_force[i])};
        normal.is_closed = c.normal_force[i] > 0 || is_loaded(n, place_a, place_b);
        supports_.push_back({normal, &c, i, prop(push(perpendicular(n)), c.friction, c.tangent_force[i]),
                             prop(IslandRow::turn(place_a, place_b), c.rolling, c.rolling_moment[i])});
        if (place_a != no_place && place_b != no_place) couplings_.emplace_back(place_a, place_b);
    }
}

bool Statics::add(const Mechanism& m, const State& state, const Scratch<std::uint32_t>& place) {
    const auto end_of = [&](std::uint32_t part) {
        return carom::end_of(m.parts[part].row, state, contacts_.motion.frames);
    };
    const std::size_t first = ties_.size();
    if (first == 0) ties_.reserve(m.lines.size()), rows_.reserve(m.lines.size()), couplings_.reserve(m.members.size());
    for (const Member& k : m.members) {
        const std::uint32_t a = place[m.parts[k.a].row], b = place[m.parts[k.b].row];
        JointRow rows[most_rows];
        rows_of(k, scene_.mechanisms.joints, end_of(k.a), end_of(k.b), rows);
        for (std::uint32_t r = 0; r < k.lines; ++r) {
            const JointLine& line = m.lines[k.line + r];
            const JointRow& j = rows[r];
            const double hair = no_gap * size_of(k, line);
            // Friction in a plane bounds the force of two rows together.
            if (is_of_speed(*line.law)) return false;
            if (!(std::abs(out_of(*line.law, j.error)) <= hair)) return false;
            IslandRow row{a, b, {}, {}};
            std::copy(j.a, j.a + 3, row.on_a), std::copy(j.b, j.b + 3, row.on_b);
            add(*line.law, j.error, hair, row, {&scene_.mechanisms.memory[k.joint], r});
        }
        if (a != no_place && b != no_place && a != b) couplings_.emplace_back(a, b);
    }
    if (m.has_loops || m.is_redundant) even_out(first);
    return true;
}

/// Of rigid ties that say the same like ones bear alike, as in a substep's factor: none is stiffer than the softest.
void Statics::even_out(std::size_t first) {
    const auto turns = [](const Tie& tie) {
        const IslandRow& row = tie.along.row;
        return row.on_a[0] == 0 && row.on_a[1] == 0 && row.on_b[0] == 0 && row.on_b[1] == 0;
    };
    double softest[2] = {HUGE_VAL, HUGE_VAL};
    const auto each = [&](auto act) {
        for (std::size_t i = first; i < ties_.size(); ++i)
            if (Tie& tie = ties_[i]; tie.along.limit == HUGE_VAL && tie.along.stiffness > 0)
                act(tie.along.stiffness, softest[turns(tie)]);
    };
    each([](double stiffness, double& least) { least = std::min(least, stiffness); });
    each([](double& stiffness, double least) { stiffness = least; });
}

/// Adds what keeps a row by this law, where it is.
void Statics::add(const Law& law, double at, double hair, const IslandRow& row, RowOfJoint own) {
    rows_.push_back(own);
    if (law.kind == Law::Kind::spring) return draw(row, law, at, own);
    const double bore = own.memory->force[own.row];
    const bool is_low = at <= law.lower + hair, is_high = at >= law.upper - hair;
    const bool is_kept = law.kind == Law::Kind::rigid || (is_low && is_high);
    const double most = is_kept ? HUGE_VAL : law.most;
    const Prop tie = prop(row, most, std::clamp(bore, -most, most));
    if (most > 0) ties_.push_back({own, tie, law.kind == Law::Kind::rigid ? HUGE_VAL : law.most});
    if (is_kept || is_low == is_high) return;
    const double sign = is_low ? 1 : -1, left = most > 0 ? bore - tie.before : bore;
    limits_.push_back({own, Stop{prop(row, 1, sign * left > 0 ? left : 0), sign}, is_low ? Step::lower : Step::upper});
}

/// A spring pulls as hard as it does where it is.
void Statics::draw(const IslandRow& row, const Law& law, double at, RowOfJoint own) {
    const double force = std::clamp(-law.stiffness * at, -law.most, law.most);
    row.push(force, loads_), row.add_sizes(force, sizes_);
    drawn_.push_back({own, force, std::abs(force) >= law.most});
}

template <class Act>
void Statics::each_prop(Act act) {
    const auto act_on = [&](Prop& p) {
        if (p.stiffness > 0) act(p);
    };
    for (Support& s : supports_)
        if (s.is_closed) act_on(s.along), act_on(s.slip), act_on(s.roll);
    for (Limit& l : limits_)
        if (l.is_closed) act_on(l.along);
    for (Tie& t : ties_) act_on(t.along);
}
template <class Act>
void Statics::each_stop(Act act) {
    for (Support& s : supports_) act(s);
    for (Limit& l : limits_) act(l);
}

bool Statics::find_forces() {
    constexpr int most_rounds = 60, most_in_vain = 15, patience = 2, long_in_vain = 7, some = 2, many = 30;
    constexpr double collapses = 1e-3, hardly_less = 0.5, somewhat = 0.8, nearer = 0.7;
    Scratch<double> accelerations = sizes_;
    for (std::size_t k = 0; k < accelerations.size(); ++k) accelerations[k] /= bodies_.mass[k];
    fastest_ = fastest(accelerations);
    if (!(fastest_ > 0)) return false;  // without a load nothing has to be held
    analyse();
    // As stiff as rounding allows, for sheets of joints and tall piles are soft: what they leave of the loads is left
    // to another round. Where contacts open and close, by how much springs give way says who is in the way.
    constexpr double stiff = 1e6, very_stiff = 1e11;
    stiffness_ = very_stiff;
    double part = 0.5, bears = somewhat;
    const std::size_t all = supports_.size() + limits_.size() + ties_.size() + 1;
    std::size_t fewest = all;
    for (int i = 0, in_vain = 0; i < most_rounds && in_vain < most_in_vain; ++i) {
        factor();
        balance(some);
        const bool falls = fastest(v_) > std::max(collapses * fastest_, hardly_less * fastest(bent_));
        const std::size_t over = count_over();
        if (!falls) in_vain = over < fewest ? 0 : in_vain + 1;
        if (!falls) fewest = std::min(fewest, over);
        if (over == 0 && !falls && balance(many) && count_over() == 0) return true;
        if ((falls || in_vain > patience) && close_all()) {
            in_vain = 0, fewest = all;
            continue;
        }
        const Given given = give_way(part, falls, bears);
        // Where many have to bear nearly what they can, none may bear much less.
        bears = in_vain > long_in_vain ? 1 - nearer * (1 - bears) : somewhat;
        const bool is_soft = !given.way && !falls && stiffness_ < very_stiff;  // and nothing else is in the way
        if (!is_soft && (!given.way || (falls && !given.closes))) return false;
        stiffness_ = is_soft || supports_.empty() ? very_stiff : stiff;
        if (falls) part = (1 + part) / 2;
    }
    return false;
}

bool Statics::explains_overlaps(double h) const {
    const double give = softness(h, h).give;
    return std::all_of(supports_.begin(), supports_.end(), [&](const Support& s) {
        const double force = std::max(s.bears(), s.contact->normal_force[s.point]);
        return -s.contact->manifold.point[s.point].gap <=
               explained_overlap(spring_depth(*s.contact), give * force / s.along.mass);
    });
}

/// What the springs would have to give to take these velocities away is impulses of theirs. What friction cannot give
/// of it, beside the force that it bears, goes on.
bool Statics::can_stop(Scratch<double> v, double most, double dt) {
    constexpr double hardly_any = 0.01;
    double energy = 0, goes_on = 0;
    for (std::size_t k = 0; k < v_.size(); ++k) {
        const double momentum = v[k] == 0 ? 0 : bodies_.mass[k] * v[k];
        energy += momentum * v[k], v[k] = momentum;
    }
    if (energy == 0) return true;
    springs_.matrix.solve(v);
    const auto look = [&](const Prop& p, double allowed) {
        if (p.stiffness == 0) return;
        const double impulse = stiffness_ * p.stiffness * std::abs(p.row.speed(v));
        const double missing = impulse - dt * (allowed - std::abs(p.force));
        if (missing > 0) goes_on += missing * missing / p.mass;
    };
    for (const Support& s : supports_)
        if (s.is_closed) look(s.slip, s.slip.limit * s.bears()), look(s.roll, s.roll.limit * s.bears());
    for (const Tie& t : ties_) look(t.along, t.along.limit);
    return fastest(v) <= most && goes_on <= hardly_any * energy;
}

double Statics::fastest(const Scratch<double>& v) const {
    double most = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const double arm = i % 3 == 2 ? std::sqrt(bodies_.mass[i] / bodies_.mass[i - 1]) : 1;
        most = std::max(most, v[i] == 0 ? 0 : arm * std::abs(v[i]));
    }
    return most;
}

void Statics::analyse() {
    const std::size_t bodies = bodies_.size() / 3;
    if (bodies == springs_.bodies && couplings_ == springs_.couplings) return;
    springs_.matrix.analyse(bodies, couplings_);
    springs_.bodies = bodies, springs_.couplings = couplings_;
}

void Statics::factor() {
    bodies_.weigh(springs_.matrix);
    each_prop([&](Prop& p) {  // others are closed each time
        p.row.locate(springs_.matrix), p.row.couple(stiffness_ * p.stiffness, springs_.matrix), p.force = p.before;
    });
    springs_.matrix.factor();
    work_ += springs_.matrix.work_per_row() * bodies_.size() / 3;
    bent_.clear();
}

/// The forces of the springs, by the method of multipliers: what springs so many times as stiff as masses leave of the
/// accelerations, the next round takes up. Whether they balance then.
bool Statics::balance(int most_rounds) {
    Scratch<double> left = loads_, size = sizes_;
    const auto bear = [&](const Prop& p) { p.row.push(p.force, left), p.row.add_sizes(p.force, size); };
    each_prop(bear);
    for (int i = 0; i < most_rounds; ++i) {
        const bool is_first = bent_.empty(), is_last = i + 1 == most_rounds;
        if (!is_first && is_small(left, size, is_last ? rounding : finest)) return true;
        v_ = left;
        springs_.matrix.solve(v_);
        if (is_first) bent_ = v_;
        left = loads_, size = sizes_;
        each_prop([&](Prop& p) { p.force -= stiffness_ * p.stiffness * p.row.speed(v_), bear(p); });
    }
    return false;
}

/// Whether what is left of the forces on each body is this part of their sizes. Torques have the rounding of forces,
/// too.
bool Statics::is_small(const Scratch<double>& left, const Scratch<double>& size, double part) const {
    for (std::size_t i = 0; i < left.size(); i += 3) {
        const double forces = part * (size[i] + size[i + 1]);
        const double torques = part * size[i + 2] + std::sqrt(bodies_.mass[i + 2] / bodies_.mass[i]) * forces;
        if (!(std::abs(left[i]) <= forces && std::abs(left[i + 1]) <= forces && std::abs(left[i + 2]) <= torques))
            return false;
    }
    return true;
}

/// What a point that bears no more than this [m/s²] of its mass bears is nothing.
double Statics::nothing() const { return rounding * fastest_; }
bool Statics::pulls(const Stop& s) const { return s.bears() <= nothing() * s.along.mass; }

namespace {
template <class Prop>
bool is_over(const Prop& p, double allowed) {
    return std::abs(p.force) > allowed;
}
}  // namespace

/// How many points would have to do what they can not.
std::size_t Statics::count_over() const {
    const auto counted = [](const auto& list, const auto& is_one) {
        return static_cast<std::size_t>(std::count_if(list.begin(), list.end(), is_one));
    };
    return counted(supports_,
                   [this](const Support& s) {
                       const auto slides = [&](const Prop& p) { return is_over(p, p.limit * s.bears()); };
                       return s.is_closed && (pulls(s) || slides(s.slip) || slides(s.roll));
                   }) +
           counted(limits_, [this](const Limit& l) { return l.is_closed && pulls(l); }) +
           counted(ties_, [](const Tie& t) { return is_over(t.along, t.along.limit); });
}

/// Closes the points that loads do not press, and that began open; whether there are any.
bool Statics::close_all() {
    bool were_any = false;
    each_stop([&were_any](Stop& s) {
        if (!s.is_closed && s.opened == 0) s.is_closed = were_any = true;
    });
    return were_any;
}

/// Gives way where one of a contact's points bears more than it can; whether one does. Both rub along one line, and
/// what they do to the bodies is their sum, of which each bears a part as it is pressed.
bool Statics::ease(const Scratch<Support*>& points, Prop Support::*of, double bears) {
    double force = 0, stiffness = 0, before = 0, presses = 0;
    bool is_too_much = false;
    for (const Support* s : points) {
        const Prop& p = s->*of;
        is_too_much = is_too_much || is_over(p, p.limit * s->bears());
        force += p.force, stiffness += p.stiffness, before += p.before, presses += s->bears();
    }
    if (!is_too_much) return false;
    const double share = eased(force, (points[0]->*of).limit * presses, bears) / presses;
    for (Support* s : points) {
        Prop& p = s->*of;
        p.stiffness = share * s->bears() * stiffness, p.before = share * s->bears() * before;
    }
    return true;
}

/// Points that pull open, those that bodies go into where the springs give way close, and who bears more than he can
/// gives way. Of what pulls or closes the most goes first: with it much of the rest is over. Who has opened so often
/// closes only where all falls without.
Statics::Given Statics::give_way(double part, bool falls, double bears) {
    constexpr int often = 3;
    const double no_way = rounding * fastest(bent_);
    double most_pull = 0, most_near = 0;
    each_stop([&](const Stop& s) {
        if (s.is_closed)
            most_pull = std::max(most_pull, -s.bears() / s.along.mass);
        else
            most_near = std::max(most_near, s.nears(bent_));
    });
    Given given;
    /// Whether it goes on to push.
    const auto goes_on = [&](Stop& s) {
        if (!s.is_closed) {
            const bool may_close = s.opened > 0 && (falls || s.opened < often);
            if (may_close && s.nears(bent_) > std::max(no_way, part * most_near))
                s.is_closed = given.way = given.closes = true;
            return false;
        }
        if (!pulls(s)) return true;
        const double pull = -s.bears() / s.along.mass;
        if (pull > nothing() && pull < part * most_pull) return false;
        s.is_closed = false, ++s.opened, given.way = true;
        s.along.force = s.along.before = 0;
        return false;
    };
    Scratch<Support*> points;
    for (std::size_t i = 0; i < supports_.size(); ++i) {
        Support& s = supports_[i];
        if (i == 0 || supports_[i - 1].contact != s.contact) points.clear();
        if (goes_on(s)) points.push_back(&s);
        if (!s.is_closed)
            for (Prop* p : {&s.slip, &s.roll}) p->force = p->before = 0;
        const bool is_last = i + 1 == supports_.size() || supports_[i + 1].contact != s.contact;
        if (is_last && !points.empty())
            for (const auto of : {&Support::slip, &Support::roll}) given.way = ease(points, of, bears) || given.way;
    }
    for (Limit& l : limits_) goes_on(l);
    for (Tie& t : ties_)
        if (Prop& p = t.along; is_over(p, p.limit)) {
            const double share = eased(p.force, p.limit, bears);
            p.stiffness *= share, p.before *= share, given.way = true;
        }
    return given;
}

void Statics::write_forces() const {
    const auto write = [](SoftContact& c, int i, double normal, double tangent, double rolling) {
        c.preload[i] = std::max(c.preload[i] + (normal - c.normal_force[i]), 0.0);
        c.normal_force[i] = normal, c.tangent_force[i] = tangent, c.rolling_moment[i] = rolling;
        c.touched = c.touched || normal > 0;
    };
    for (const auto& [contact, point] : apart_) write(*contact, point, 0, 0, 0);
    for (const Support& s : supports_) write(*s.contact, s.point, s.bears(), s.slip.force, s.roll.force);
    for (const RowOfJoint& r : rows_) r.memory->force[r.row] = 0, r.memory->step[r.row] = Step::free;
    const auto add = [](const RowOfJoint& r, double force, Step step) {
        r.memory->force[r.row] += force, r.memory->step[r.row] = step;
    };
    for (const Drawn& d : drawn_)
        add(d, d.force, !d.is_most ? Step::held : d.force > 0 ? Step::pushing : Step::pulling);
    for (const Tie& t : ties_)
        add(t, t.along.force,
            std::abs(t.along.force) <= t.braked ? Step::held
            : t.along.force > 0                 ? Step::lower
                                                : Step::upper);
    for (const Limit& l : limits_)
        if (l.bears() > 0) add(l, l.along.force, l.step);
    for (const RowOfJoint& r : rows_) {
        r.memory->mean[r.row] = r.memory->pull[r.row] = r.memory->force[r.row];
        r.memory->half[r.row] = scene_.drift_share * r.memory->force[r.row];
        r.memory->projections = 0, r.memory->was_slow = false;
    }
}

}  // namespace carom
