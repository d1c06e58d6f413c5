// A hair of slack for chains that are just as long as their way: no finite force holds these straight, and what lies on
// one would sink through it (docs/theory/joints.md).

#include <algorithm>
#include <cmath>

#include "solvers/parts.hpp"

namespace carom {

namespace {

using Part = Mechanism::Part;
using Place = Mechanism::Taut::Place;

constexpr double hair = 1e-5;   ///< of the way: the chain sags by 0.2 % of that
constexpr double least = 1e-6;  ///< by so much it may be too short, for its numbers were rounded

/// A chain of hinges, rods or ropes between two that are held, or two places of one.
struct Strand {
    std::vector<std::uint32_t> members;
    std::vector<std::uint32_t> parts;  ///< between these
    std::uint32_t first, last;         ///< the parts that are held
};

bool is_rope(const Joint& joint) {
    const auto* d = std::get_if<DistanceJoint>(&joint.type);
    return d && !d->spring && d->limits.upper && !d->limits.lower;
}
/// How long a rod or rope is, and 0 of a hinge.
double length_of(const Joint& joint) {
    const auto* d = std::get_if<DistanceJoint>(&joint.type);
    return !d ? 0 : is_rope(joint) ? *d->limits.upper : d->length.value_or(0);
}

/// Finds the chains of a mechanism, with ropes as links of them or without.
class Strands {
  public:
    Strands(const Bodies& bodies, const std::vector<Joint>& joints, const Mechanism::Shape& shape, const Mechanism& m,
            bool of_ropes)
        : bodies_(bodies), joints_(joints), shape_(shape), m_(m), links_(m.parts.size()), is_link_(m.members.size()) {
        for (std::uint32_t i = 0; i < m.members.size(); ++i) {
            const Member& k = m.members[i];
            is_link_[i] = k.rigid > 0 || (of_ropes && is_rope(joints[k.joint]));
            links_[k.a] += is_link_[i], links_[k.b] += is_link_[i];
        }
        leave_out_branches();
    }
    std::vector<Strand> all() {
        std::vector<Strand> found;
        for (std::uint32_t i = 0; i < m_.members.size(); ++i) {
            const Member& k = m_.members[i];
            if (!is_link_[i] || moves(k.a) == moves(k.b)) continue;
            Strand strand = from(i, moves(k.a) ? k.b : k.a);
            // The same one begins at its other end, too.
            const bool is_first = strand.members.size() > 1 && strand.members.front() < strand.members.back();
            if (is_first && stay(strand.first, strand.last)) found.push_back(std::move(strand));
        }
        return found;
    }

  private:
    bool moves(std::uint32_t part) const { return m_.parts[part].inverse_mass != 0; }
    /// Whether two that are held stay as far from one another.
    bool stay(std::uint32_t a, std::uint32_t b) const {
        const auto is_fixed = [this](std::uint32_t part) {
            const std::uint32_t row = m_.parts[part].row;
            return row >= bodies_.size() || bodies_.kind[row] == Kind::fixed;
        };
        return a == b || (is_fixed(a) && is_fixed(b));
    }
    std::uint32_t other(std::uint32_t member, std::uint32_t part) const {
        const Member& k = m_.members[member];
        return k.a == part ? k.b : k.a;
    }
    /// A joint by which a part hangs on others, but this one; or itself if there is none.
    std::uint32_t next(std::uint32_t part, std::uint32_t member) const {
        for (std::uint32_t i = shape_.first_holder[part]; i < shape_.first_holder[part + 1]; ++i)
            if (const std::uint32_t k = shape_.holders[i].joint; is_link_[k] && k != member) return k;
        return member;
    }
    /// What hangs on a chain by one of its ends has no part in how long that is.
    void leave_out_branches() {
        for (std::uint32_t p = 0; p < links_.size(); ++p)
            for (std::uint32_t part = p; moves(part) && links_[part] == 1;) {
                const std::uint32_t member = next(part, no_member);
                is_link_[member] = false, links_[part] = 0;
                part = other(member, part), --links_[part];
            }
    }
    bool is_flexible(std::uint32_t member) const {
        const JointType& type = joints_[m_.members[member].joint].type;
        return std::holds_alternative<RevoluteJoint>(type) || std::holds_alternative<DistanceJoint>(type);
    }
    /// From a joint on what is held; of no joints if it does not end at such.
    Strand from(std::uint32_t member, std::uint32_t held) const {
        Strand strand{{}, {}, held, held};
        for (;;) {
            if (!is_flexible(member)) return {};
            strand.members.push_back(member);
            const std::uint32_t part = strand.last = other(member, strand.last);
            if (!moves(part)) return strand;
            if (links_[part] != 2) return {};
            strand.parts.push_back(part);
            member = next(part, member);
        }
    }

    static constexpr std::uint32_t no_member = 0xffffffff;
    const Bodies& bodies_;
    const std::vector<Joint>& joints_;
    const Mechanism::Shape& shape_;
    const Mechanism& m_;
    std::vector<std::uint32_t> links_;  ///< so many rigid joints hold each part
    std::vector<bool> is_link_;         ///< each joint is one, and no branch
};

Vec2& anchor_on(Member& k, std::uint32_t part) { return k.a == part ? k.anchor_a : k.anchor_b; }

/// Makes a chain as long as its way and a hair, if that is what it misses.
void loosen(const Motion& places, const std::vector<Joint>& joints, const Strand& strand, Mechanism& m) {
    const Place from{strand.first, anchor_on(m.members[strand.members.front()], strand.first), false},
        to{strand.last, anchor_on(m.members[strand.members.back()], strand.last), false};
    const auto at = [&](const Place& end) {
        const std::uint32_t row = m.parts[end.part].row;
        if (strand.first == strand.last || row >= places.size()) return end.middle;
        return places.linear[row] + frame_at({}, places.angular[row]).turn(end.middle);
    };
    const auto pins_of = [&](std::size_t i) {
        return std::pair<Vec2&, Vec2&>{anchor_on(m.members[strand.members[i]], strand.parts[i]),
                                       anchor_on(m.members[strand.members[i + 1]], strand.parts[i])};
    };
    const auto rod_of = [&](std::uint32_t member) { return length_of(joints[m.members[member].joint]); };
    double reach = 0;
    std::size_t links = 0;
    const auto add = [&](double one) { reach += one, links += one > 0; };
    for (const std::uint32_t member : strand.members) add(rod_of(member));
    for (std::size_t i = 0; i < strand.parts.size(); ++i) add(length(pins_of(i).second - pins_of(i).first));
    const double way = length(at(to) - at(from)), longer = (1 + hair) * way / reach - 1;
    if (links < 2 || !(longer > 0 && longer <= hair + least)) return;
    for (const std::uint32_t member : strand.members) m.members[member].longer = longer * rod_of(member);
    Mechanism::Taut taut{from, to, {}};
    for (std::size_t i = 0; i < strand.parts.size(); ++i) {
        const auto [first, second] = pins_of(i);
        const Vec2 out = 0.5 * longer * (second - first);
        first -= out, second += out;
        taut.places.push_back({strand.parts[i], 0.5 * (first + second), out != Vec2{}});
    }
    m.taut.push_back(std::move(taut));
}

}  // namespace

void loosen(const Bodies& bodies, const Motion& places, const std::vector<Joint>& joints, const Mechanism::Shape& shape,
            Mechanism& m) {
    const auto held = std::count_if(m.members.begin(), m.members.end(), [](const Member& k) { return k.outside; });
    if (held < 2) return;
    const auto is_roped = [&](std::uint32_t member) { return is_rope(joints[m.members[member].joint]); };
    const auto loosen_all = [&](bool of_ropes) {
        for (const Strand& strand : Strands(bodies, joints, shape, m, of_ropes).all())
            if (of_ropes == std::any_of(strand.members.begin(), strand.members.end(), is_roped))
                loosen(places, joints, strand, m);
    };
    loosen_all(false);
    const auto is_rope_of = [&](const Member& k) { return is_rope(joints[k.joint]); };
    if (std::any_of(m.members.begin(), m.members.end(), is_rope_of)) loosen_all(true);
}

void bend(Vec2 gravity, Mechanism& m) {
    const double deep = std::sqrt(3.0 / 8 * hair);  // of a shallow arc, as parts of its span
    const auto at = [&m](const Place& place) {
        const End& now = m.parts[place.part].now;
        return now.position + now.turn(place.middle);
    };
    for (const Mechanism::Taut& taut : m.taut) {
        const Vec2 from = at(taut.from), whole = at(taut.to) - from;
        const double way = length(whole);
        const Vec2 along = whole / way, left = perpendicular(along), down = dot(gravity, left) > 0 ? left : -left;
        const bool is_straight = std::all_of(taut.places.begin(), taut.places.end(), [&](const Place& place) {
            return std::abs(dot(at(place) - from, left)) < 0.5 * deep * way;
        });
        for (std::size_t i = 0; i < taut.places.size() && is_straight; ++i) {
            const Place& place = taut.places[i];
            const double t = std::clamp(dot(at(place) - from, along) / way, 0.0, 1.0);
            End& now = m.parts[place.part].now;
            now.position += 4 * deep * way * t * (1 - t) * down;
            if (place.turns) turn_on(now, 4 * deep * (1 - 2 * t) * cross(along, down));
        }
    }
}

}  // namespace carom
