// The precise solve of an island where the impulses of the substep before are the solution still, as where all is at
// rest.

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/islands.hpp"

namespace carom {

double speed_apart(const ContactBlock& block, int point, std::uint32_t k, const Aim& aim) {
    constexpr double recovered = 0.2;  // of an overlap in a substep
    const double gap = block.point[point].gap[k];
    // A lever that is not the block's throws nobody, and deep ones are parted.
    const double most = gap < -block.shallow[k] ? 0 : block.recovery[k];
    const double turned = std::clamp(block.more[point].turned_normal[k], -most, most);
    if (gap > 0) return -gap / aim.h - turned;
    return (aim.recovers ? std::min(-gap * recovered / aim.h, aim.undoes * block.recovery[k]) : 0) - turned;
}

double speed_of_slip(const ContactBlock& block, int point, std::uint32_t k) {
    return block.surface_speed[k] - block.more[point].turned_tangent[k];
}

namespace {

/// Friction's bound and the impulses at it are as good as equal.
constexpr double rounded = 1e-8;
bool is_at(double bound, double impulse) { return std::abs(impulse) >= (1 - rounded) * bound; }

/// An island under the impulses that the forces before give.
class Standstill {
  public:
    Standstill(const Island& island, const PreciseIslands& islands, const std::vector<Mover>& free, const Aim& aim,
               SoftContacts& contacts)
        : island_(island), islands_(islands), aim_(aim), contacts_(contacts) {
        double farthest = 0;  // from the origin, along an axis [m]
        double fastest = 0;   // without contacts, along an axis [m/s]
        for (const std::uint32_t row : island.bodies) {
            const Vec2 x = contacts.motion.frames[row].position;
            farthest = std::max({farthest, std::abs(x.x), std::abs(x.y)});
            movers_.push_back(without_contacts(island, free, contacts, row));
            fastest = std::max({fastest, std::abs(movers_.back().vx), std::abs(movers_.back().vy)});
            holds_.push_back({});
        }
        // Places are rounded too by which gaps are closed.
        constexpr double rounding = 1e-10, of_places = 16 * std::numeric_limits<double>::epsilon();
        hair_ = rounding * fastest, wide_ = hair_ + of_places * farthest / aim.h;
    }

    /// Whether these are the solution still, as those of bodies at rest are: then they are taken. What is left of the
    /// velocities of bodies that are held would add up, be taken back by other forces, and these by others for ever.
    bool lasts() {
        for (const std::uint32_t index : island_.contacts) push(contacts_.all[index]);
        for (const std::uint32_t index : island_.contacts)
            if (!fits(contacts_.all[index])) return false;
        const auto is_held = [](const Holds& h) { return h.pressing > 1 && h.sticking > 0; };
        const bool held = !moves_ && std::all_of(holds_.begin(), holds_.end(), is_held);
        for (std::size_t i = 0; i < movers_.size(); ++i) {
            Mover& m = contacts_.motion.movers[island_.bodies[i]] = movers_[i];
            if (held) m.vx = m.vy = m.w = 0;
        }
        return true;
    }

  private:
    /// The points that press on a body. By the least force it may turn on one alone, and slip where all friction is at
    /// its bound.
    struct Holds {
        int pressing = 0, sticking = 0;
        void add(bool sticks) { ++pressing, sticking += sticks; }
    };

    Mover mover(std::uint32_t row) const {
        const std::uint32_t place = islands_.place_of(row);
        return place != no_place ? movers_[place] : contacts_.motion.movers[row];
    }
    void put(std::uint32_t row, const Mover& m) {
        if (m.inverse_mass > 0) movers_[islands_.place[row]] = m;
    }

    void push(const SoftContact& c) {
        ContactBlock& block = contacts_.layout.blocks[c.block];
        const std::uint32_t k = c.row;
        Mover a = mover(c.a), b = mover(c.b);
        const Vec2 n{block.normal_x[k], block.normal_y[k]};
        for (int i = 0; i < static_cast<int>(block.points); ++i) {
            auto& p = block.point[i];
            auto& more = block.more[i];
            const double time = c.is_solved[i] ? aim_.share * aim_.h : 0;
            p.normal_impulse[k] = time * more.normal_force[k], p.tangent_impulse[k] = time * more.tangent_force[k];
            const double turn = more.rolling_impulse[k] = time * more.rolling_moment[k];
            const Vec2 given = p.normal_impulse[k] * n + p.tangent_impulse[k] * perpendicular(n);
            a.vx -= a.inverse_mass * given.x, a.vy -= a.inverse_mass * given.y;
            a.w -= block.inverse_inertia_a[k] * (cross(lever_a_of(block, i, k), given) + turn);
            b.vx += b.inverse_mass * given.x, b.vy += b.inverse_mass * given.y;
            b.w += block.inverse_inertia_b[k] * (cross(lever_b_of(block, i, k), given) + turn);
        }
        put(c.a, a), put(c.b, b);
    }

    /// Turning counts by the radius of gyration: who has no inertia keeps any spin.
    bool is_moving(const Mover& m, double inverse_inertia) const {
        return m.inverse_mass > 0 && (std::abs(m.vx) > wide_ || std::abs(m.vy) > wide_ ||
                                      m.w * m.w * m.inverse_mass > wide_ * wide_ * inverse_inertia);
    }
    /// Whether a contact's velocities are what they are to be.
    bool fits(const SoftContact& c) {
        const ContactBlock& block = contacts_.layout.blocks[c.block];
        const std::uint32_t k = c.row;
        const Mover a = mover(c.a), b = mover(c.b);
        moves_ = moves_ || is_moving(a, block.inverse_inertia_a[k]) || is_moving(b, block.inverse_inertia_b[k]);
        const Vec2 n{block.normal_x[k], block.normal_y[k]};
        const auto rubs = [this](double bound, double given, double lack) {
            const bool slides = is_at(bound, given) && given * lack >= 0;
            return std::abs(given) <= (1 + rounded) * bound && (slides || std::abs(lack) <= hair_);
        };
        for (int i = 0; i < static_cast<int>(block.points); ++i) {
            const auto& p = block.point[i];
            if (!c.is_solved[i]) continue;
            const Vec2 speed = Vec2{b.vx, b.vy} + cross(b.w, lever_b_of(block, i, k)) - Vec2{a.vx, a.vy} -
                               cross(a.w, lever_a_of(block, i, k));
            const double lack = speed_apart(block, i, k, aim_) - dot(n, speed), pressed = p.normal_impulse[k];
            if ((pressed > 0 ? std::abs(lack) : lack) > wide_) return false;
            const double slip = cross(n, speed) - speed_of_slip(block, i, k), roll = block.rolling[k] * (b.w - a.w);
            if (!rubs(block.friction[k] * pressed, p.tangent_impulse[k], -slip)) return false;
            if (!rubs(block.rolling[k] * pressed, block.more[i].rolling_impulse[k], -roll)) return false;
            if (pressed == 0) continue;
            const bool sticks = !is_at(block.friction[k] * pressed, p.tangent_impulse[k]);
            for (const std::uint32_t row : {c.a, c.b})
                if (islands_.place_of(row) != no_place) holds_[islands_.place[row]].add(sticks);
        }
        return true;
    }

    const Island& island_;
    const PreciseIslands& islands_;
    const Aim& aim_;
    SoftContacts& contacts_;
    Scratch<Mover> movers_;
    double hair_, wide_;  ///< of a speed [m/s]: rounding, and along normals
    bool moves_ = false;  ///< some body does
    Scratch<Holds> holds_;
};

}  // namespace

bool take_warm_solution(const Island& island, const PreciseIslands& islands, const std::vector<Mover>& free,
                        const Aim& aim, SoftContacts& contacts) {
    return Standstill(island, islands, free, aim, contacts).lasts();
}

}  // namespace carom
