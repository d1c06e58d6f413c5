#include "solvers/links.hpp"

#include <algorithm>
#include <array>

#include "solvers/factor.hpp"

namespace carom {

void keep_rigid_rows(Mechanism& m) {
    for (JointLine& line : m.lines) line.step = line.law->kind == Law::Kind::rigid ? Step::held : Step::free;
    for (Mechanism::Part& p : m.parts) p.slow[0] = p.slow[1] = 1;
    set_ease(m);
}

namespace {

/// Of what rounding leaves of the joints' speeds the second round takes most.
template <int N>
void pass_on(Mechanism& m, BlockMatrix<N>& matrix) {
    for (int round = 0; round < 2; ++round) {
        std::fill(m.unknowns.begin(), m.unknowns.end(), 0.0);
        const auto each_held = [&](auto act) {
            for (std::uint32_t i = 0; i < m.members.size(); ++i)
                for (std::uint32_t r = 0; r < m.members[i].lines; ++r)
                    if (JointLine& line = m.lines[m.members[i].line + r]; line.step == Step::held)
                        act(m.members[i], r, line, m.unknowns[N * i + r]);
        };
        each_held([&](const Member& k, std::uint32_t row, const JointLine& line, double& missing) {
            missing = -speed(m, k, row, line.last);
        });
        matrix.solve(m.unknowns);
        each_held([&](const Member& k, std::uint32_t row, JointLine& line, double impulse) {
            line.after += impulse;
            push(m, k, row, line.last, impulse);
        });
        feel(1, m);
    }
}

/// The same for the velocities of the parts as they are.
void keep_rows(Mechanism& m, const std::vector<Joint>& joints, bool elsewhere) {
    if (elsewhere) look(1, m, joints, &JointLine::last);
    const auto run = [&](auto& matrix) {
        if (elsewhere) factor(m, matrix, rows_at(&JointLine::last), slack, [](const JointLine&) { return 0.0; });
        pass_on(m, matrix);
    };
    std::visit(run, m.matrix);
}

}  // namespace

void pass_on(Mechanism& m, const std::vector<Joint>& joints, bool elsewhere) {
    for (JointLine& line : m.lines) line.after = 0;
    for (Mechanism::Part& p : m.parts)
        for (int i = 0; i < 3; ++i) p.v[i] = p.known[i] = 0;
    feel(1, m);
    keep_rows(m, joints, elsewhere);
}

namespace {

/// Whether a row is at its limit in this way, the lower one below 0.
bool is_at_limit(const Member& k, const JointLine& line, double way) {
    constexpr double near = 1e-6;  // [rad], or of its size
    if (line.law->kind != Law::Kind::stop) return false;
    const double hair = near * (line.law->turns ? 1 : k.size);
    return way < 0 ? line.last.error <= line.law->lower + hair : line.last.error >= line.law->upper - hair;
}
/// Whether any is.
bool is_at_limit(const Mechanism& m) {
    return std::any_of(m.members.begin(), m.members.end(), [&](const Member& k) {
        const auto is_one = [&k](const JointLine& line) { return is_at_limit(k, line, -1) || is_at_limit(k, line, 1); };
        return std::any_of(&m.lines[k.line], &m.lines[k.line] + k.lines, is_one);
    });
}

}  // namespace

bool hold_stops(Mechanism& m, double push, const Before& before) {
    const auto was = [&](std::uint32_t part) -> std::array<double, 3> {
        const auto [v, w] = before(part);
        return {v.x, v.y, w};
    };
    bool are_held = false;
    for (const Member& k : m.members)
        for (std::uint32_t r = 0; r < k.lines; ++r) {
            JointLine& line = m.lines[k.line + r];
            if (line.law->kind != Law::Kind::stop) continue;
            const double gains = push * speed(m, k, r, line.last);
            const double goes = gains + speed(k, r, line.last, was(k.a).data(), was(k.b).data());
            if (gains * goes > 0 && is_at_limit(k, line, gains)) line.step = Step::held, are_held = true;
        }
    return are_held;
}

void Links::index_rows() {
    of_row_.assign(bodies_, 0);
    for (std::uint32_t i = 0; i < all_.all.size(); ++i)
        for (const Mechanism::Part& p : all_.all[i].parts)
            if (p.inverse_mass != 0) of_row_[p.row] = i;
}

bool Links::hold(std::uint32_t row) {
    constexpr std::size_t most = 200;  // joints: through more of them a blow would cost more than a substep
    if (row >= bodies_ || all_.empty() || !all_.holds[row]) return false;
    if (of_row_.empty()) index_rows();
    return all_.all[of_row_[row]].members.size() <= most;
}

Links::Linked& Links::linked(std::uint32_t row) {
    const std::uint32_t index = of_row_[row];
    const auto found = std::find_if(linked_.begin(), linked_.end(), [=](const Linked& l) { return l.index == index; });
    if (found != linked_.end()) return *found;
    linked_.push_back({index, false, all_.all[index]});
    keep_rigid_rows(linked_.back().mechanism);
    return linked_.back();
}

void Links::place_parts(Linked& l, const Look& look_at) const {
    for (Mechanism::Part& p : l.mechanism.parts) {
        if (l.is_placed || p.row >= bodies_) continue;
        const Partner body = look_at(p.row);
        const auto turn = portable::sincos(body.angle);
        p.now = {body.x, turn.cos, turn.sin, body.angle};
    }
}

void Links::begin() {
    for (Linked& l : linked_) {
        l.held.clear();
        if (!l.holds_stops) continue;
        keep_rigid_rows(l.mechanism);
        l.holds_stops = l.is_placed = false;
    }
}

void Links::keep_on_rows(Linked& l, const Look& look_at) {
    Mechanism& m = l.mechanism;
    place_parts(l, look_at);
    for (Mechanism::Part& p : m.parts) {
        const Partner body = p.row < bodies_ ? look_at(p.row) : Partner{p.row};
        p.v[0] = body.v.x, p.v[1] = body.v.y, p.v[2] = body.w;
        for (int i = 0; i < 3; ++i) p.given[i] = p.known[i] = 0;
    }
    keep_rows(m, all_.joints, !l.is_placed);
    l.is_placed = true;
    for (const Mechanism::Part& p : m.parts) l.held.push_back({{p.v[0], p.v[1]}, p.v[2]});
}

Partner Links::held(std::uint32_t row, const Look& look_at) {
    Partner body = look_at(row);
    if (!hold(row) || body.inverse_mass == 0) return body;
    const Linked& l = linked(row);
    for (std::size_t p = 0; p < l.held.size(); ++p)
        if (l.mechanism.parts[p].row == row) body.v = l.held[p].velocity, body.w = l.held[p].angular_velocity;
    return body;
}

bool Links::are_of_account(const Linked& l, const Struck& s) {
    constexpr double of_one = 0.5, of_several = 0.9;
    const auto moves = [](const Mechanism::Part& p) { return p.inverse_mass != 0; };
    const bool is_one = std::count_if(l.mechanism.parts.begin(), l.mechanism.parts.end(), moves) == 1;
    return s.freedom < (is_one ? of_one : of_several);
}

void Links::turn(Blow& blow, Struck& s, const Look& look_at) {
    for (const std::uint32_t row : {blow.now[s.a].row, blow.now[s.b].row}) {
        if (!hold(row) || !linked(row).held.empty() || !are_of_account(linked(row), s)) continue;
        keep_on_rows(linked(row), look_at);
        for (std::size_t k = 0; k < blow.now.size(); ++k) {
            const std::uint32_t other = blow.now[k].row;
            if (!hold(other) || of_row_[other] != of_row_[row]) continue;
            const Partner flies = look_at(other), is_held = held(other, look_at);
            for (Partner* body : {&blow.before[k], &blow.now[k]})
                body->v += is_held.v - flies.v, body->w += is_held.w - flies.w;
        }
    }
    s.approach = blow.approach(s);
}

/// Momentum that a contact gives to a body.
void Links::give(const Given& given, const Look& look_at) {
    Linked& l = linked(given.row);
    Mechanism& m = l.mechanism;
    const auto place = static_cast<std::uint32_t>(&l - linked_.data());
    if (std::find(stirred_.begin(), stirred_.end(), place) == stirred_.end()) {
        stirred_.push_back(place);
        for (Mechanism::Part& p : m.parts) p.given[0] = p.given[1] = p.given[2] = 0;
        place_parts(l, look_at);
    }
    for (Mechanism::Part& p : m.parts)
        if (p.row == given.row)
            for (int i = 0; i < 3; ++i) p.given[i] += given.momentum[i];
}

void Links::take_gains(Linked& l) {
    pass_on(l.mechanism, all_.joints, !l.is_placed);
    l.is_placed = true;
    for (const Mechanism::Part& p : l.mechanism.parts)
        if (p.inverse_mass != 0) gains_.push_back({p.row, {p.v[0], p.v[1]}, p.v[2]});
}

void Links::find_gains(const Blow& blow, const Struck& s, int point, int way, const Look& look_at) {
    gains_.clear(), stirred_.clear();
    for (const int side : {0, 1}) {
        const Vec2 u = (side == 0 ? -1 : 1) * s.direction(way);
        const Given g{blow.now[side == 0 ? s.a : s.b].row, {u.x, u.y, cross(s.lever[point][side], u)}};
        if (hold(g.row)) {
            give(g, look_at);
            continue;
        }
        const Partner body = look_at(g.row);
        const double m = body.inverse_mass;
        if (m != 0)
            gains_.push_back({g.row, {m * g.momentum[0], m * g.momentum[1]}, body.inverse_inertia * g.momentum[2]});
    }
    for (const std::uint32_t place : stirred_) take_gains(linked_[place]);
}

void Links::find_yields(Blow& blow, Struck& s, const Look& look_at) {
    for (int k = 0; k < s.manifold.count; ++k)
        for (int way = 0; way < 2; ++way) {
            find_gains(blow, s, k, way, look_at);
            s.yields[k][way] = {static_cast<std::uint32_t>(blow.yields.size()), 0};
            for (const Gain& gain : gains_) blow.yields.push_back({blow.side(look_at(gain.row)), gain.v, gain.w});
            s.yields[k][way].last = static_cast<std::uint32_t>(blow.yields.size());
        }
    blow.couple(s);
}

bool Links::hold_stops(const Blow& blow, const Struck& s, const Look& look_at) {
    const int point = s.lone(), way = Struck::number(point, Struck::pressing);
    if (!(s.approach > 0 && s.coupling[way][way] > 0)) return false;
    const auto may_hold = [this](std::uint32_t place) { return is_at_limit(linked_[place].mechanism); };
    if (std::none_of(stirred_.begin(), stirred_.end(), may_hold)) return false;
    find_gains(blow, s, point, Struck::pressing, look_at);
    const double push = s.approach / s.coupling[way][way];
    bool are_pressed = false;
    for (const std::uint32_t place : stirred_) {
        Linked& l = linked_[place];
        const auto flies = [&](std::uint32_t part) {
            const std::uint32_t row = l.mechanism.parts[part].row;
            const Partner body = row < bodies_ ? look_at(row) : Partner{row};
            return Twist{body.v, body.w};
        };
        if (!carom::hold_stops(l.mechanism, push, flies)) continue;
        l.holds_stops = are_pressed = true, l.is_placed = false;  // another factor
    }
    return are_pressed;
}

void Links::tie(Blow& blow, Struck& s, const Look& look_at) {
    find_yields(blow, s, look_at);
    if (blow.struck.size() > 1 || !hold_stops(blow, s, look_at)) return;
    blow.yields.clear();
    find_yields(blow, s, look_at);
}

double Links::settle(const Blow& blow) {
    stirred_.clear(), gains_.clear();
    const Look no_look = [](std::uint32_t row) { return Partner{row}; };
    for (const Struck& s : blow.struck)
        for (int k = 0; k < s.manifold.count; ++k) {
            const Vec2 p = s.normal[k] * s.manifold.normal + s.tangent[k] * perpendicular(s.manifold.normal);
            const std::uint32_t a = blow.now[s.a].row, b = blow.now[s.b].row;
            if (hold(a)) give({a, {-p.x, -p.y, -cross(s.lever[k][0], p)}}, no_look);
            if (hold(b)) give({b, {p.x, p.y, cross(s.lever[k][1], p)}}, no_look);
        }
    const auto spins = [&blow](const Mechanism& m) {
        double work = 0;
        for (const Mechanism::Part& p : m.parts)
            for (const Partner& body : blow.now)
                if (p.inverse_inertia == 0 && p.inverse_mass != 0 && body.row == p.row) work += p.given[2] * body.w;
        return work;
    };
    double kept = 0;
    for (const std::uint32_t place : stirred_) {
        Linked& l = linked_[place];
        kept -= spins(l.mechanism);  // what contacts gave is booked with them
        take_gains(l);
        kept += spins(l.mechanism);
        Mechanism& m = all_.all[l.index];
        for (std::size_t i = 0; i < m.lines.size(); ++i) m.lines[i].blow += l.mechanism.lines[i].after;
    }
    return kept;
}

}  // namespace carom
