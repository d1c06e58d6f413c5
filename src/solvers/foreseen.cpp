// Mechanisms for which what the substep before lets expect is enough, or nearly so: sheets that hang still.

#include "solvers/lay.hpp"

namespace carom {

namespace {

using Part = Mechanism::Part;

/// Solves that begin with what the substep before lets expect, and find it enough or nearly so: nothing is laid out for
/// them. All rows are rigid.
class Foreseen {
  public:
    Foreseen(Mechanism& m, const Asked& asked) : m_(m), asked_(asked), ahead_(asked.is_exact()), per_h_(1 / asked.h) {}

    /// Whether that keeps all rows, if need be with one round more: then they have it.
    bool run() {
        const bool foresees = asked_.foresees(m_), may_correct = foresees || !asked_.drifts;
        each_part(asked_.threads, m_, [](Part& p) { std::copy(p.given, p.given + 3, p.known); });
        if (foresees) foresee();
        constexpr double near = 10;  // times what is enough: then a round is
        const bool keeps = keeps_rows(1) || (may_correct && keeps_rows(near) && correct() && keeps_rows(1));
        if (keeps && !(asked_.drifts && m_.is_slow && makes_energy())) {
            feel(asked_.threads, m_);
            return true;
        }
        each_part(asked_.threads, m_, [](Part& p) { std::copy(p.known, p.known + 3, p.given); });
        for (JointLine& line : m_.lines)
            if (foresees) line.before = 0;
        return false;
    }

  private:
    void foresee() {
        give([this](const Member& k, std::uint32_t r) { return asked_.expected(m_.lines[k.line + r]); });
    }
    template <class ImpulseOf>
    void give(ImpulseOf impulse_of) {
        const auto note = [&](const Member& k) {
            for (std::uint32_t r = 0; r < k.lines; ++r) m_.lines[k.line + r].*asked_.impulse() += impulse_of(k, r);
        };
        each_joint(asked_.threads, m_, note, [&](const Member& k, auto sides) {
            push_all(m_, k, asked_.which(), sides, [&](std::uint32_t r) { return impulse_of(k, r); });
        });
    }
    /// What a row lacks of its speed; where the drift ends, if it is to be kept there and has been looked at.
    double missing_of(const Member& k, std::uint32_t r) const {
        const JointLine& line = m_.lines[k.line + r];
        return ahead_ ? (line.aim - line.last.error) * per_h_ : wanted_of(line) - speed(m_, k, r, line.*asked_.which());
    }
    double wanted_of(const JointLine& line) const {
        return asked_.drifts ? (line.aim - line.first.error) * per_h_ : 0.0;
    }
    /// The same of a plain hinge, which need not have been looked at.
    Vec2 missing_of_points(const Member& k) const {
        const JointLine* const lines = &m_.lines[k.line];
        if (!ahead_) {
            const Vec2 u =
                speed_of_points(lines[0].*asked_.which(), lines[1].*asked_.which(), m_.parts[k.a].v, m_.parts[k.b].v);
            return {wanted_of(lines[0]) - u.x, wanted_of(lines[1]) - u.y};
        }
        const Vec2 gap = Levers(k, m_.parts[k.a].now, m_.parts[k.b].now).between;
        return {(lines[0].aim - gap.x) * per_h_, (lines[1].aim - gap.y) * per_h_};
    }
    /// Whether no row misses more than so many times what is taken for none.
    bool keeps_rows(double times) {
        if (ahead_)
            each_part(asked_.threads, m_, [h = asked_.h](Part& p) {
                p.now = p.start;
                p.now.position += h * Vec2{felt(p, 0), felt(p, 1)};
                turn_on(p.now, h * felt(p, 2));
            });
        // What is left of a speed adds up to a gap.
        const double enough = times * (ahead_ ? tiny : 0.1 * tiny);
        return !is_any(asked_.threads, m_.members.size(), [&](std::size_t i) { return misses(m_.members[i], enough); });
    }
    bool misses(const Member& k, double enough) {
        if (k.is_plain()) {
            const Vec2 missing = missing_of_points(k);
            const double size = k.per_size * asked_.h;
            return !(std::abs(missing.x) * size <= enough && std::abs(missing.y) * size <= enough);
        }
        if (ahead_) look<false>(m_, k, asked_.all.joints, &JointLine::last);
        for (std::uint32_t r = 0; r < k.lines; ++r) {
            const double size = per_size_of(k, r, m_.lines[k.line + r]) * asked_.h;
            if (!(std::abs(missing_of(k, r)) * size <= enough)) return true;
        }
        return false;
    }
    /// A round with the matrix of rounded rows, where bodies lie as good as still. It is made as if none were slowed
    /// down: one factor serves before the drift and after it, and a gap that has just become more than rounding need
    /// not be closed to the last bit.
    bool correct() {
        if (!is_still(asked_.threads, m_, asked_.h, felt)) return false;
        std::visit([this](auto& matrix) { correct(matrix); }, m_.matrix);
        return true;
    }
    template <int N>
    void correct(BlockMatrix<N>& matrix) {
        each_part(asked_.threads, m_,
                  [](Part& p) { p.ease[0] = p.ease[1] = p.inverse_mass, p.ease[2] = p.inverse_inertia; });
        if (!has_factor_of_rows(asked_.threads, m_, asked_.which(), asked_.h, true))
            factor_to_keep(m_, matrix, asked_.which(), asked_.h, true, [](const JointLine&) { return 0.0; });
        each_part(asked_.threads, m_, [](Part& p) { set_ease(p); });
        const auto note_missing = [&](const Member& k) {
            if (ahead_) look<false>(m_, k, asked_.all.joints, &JointLine::last);
            for (std::uint32_t r = 0; r < N; ++r) m_.unknowns[N * k.place + r] = r < k.lines ? missing_of(k, r) : 0;
        };
        each_joint(asked_.threads, m_, note_missing, [](const Member&, auto) {});
        matrix.solve_in_order(m_.unknowns.data());
        give([this](const Member& k, std::uint32_t r) { return m_.unknowns[N * k.place + r]; });
        if (!asked_.drifts) feel(asked_.threads, m_);
    }
    bool makes_energy() const {
        struct Energies {
            double before = 0, after = 0;
            void operator+=(const Energies& more) { before += more.before, after += more.after; }
        };
        const auto sum_up = [this](std::size_t first, std::size_t last, Energies& sum) {
            for (std::size_t k = first; k < last; ++k) {
                const Part& p = m_.parts[k];
                sum += {energy_of(p, [&p](std::size_t i) { return p.v[i]; }),
                        energy_of(p, [&p](std::size_t i) { return felt(p, i); })};
            }
        };
        const auto [before, after] = sum_over_rows<Energies>(asked_.threads, m_.parts.size(), sum_up);
        return !(after <= most_made * before);
    }

    Mechanism& m_;
    const Asked& asked_;
    const bool ahead_;
    const double per_h_;
};

}  // namespace

bool hold_as_foreseen(Mechanism& m, const Asked& asked) { return Foreseen(m, asked).run(); }

}  // namespace carom
