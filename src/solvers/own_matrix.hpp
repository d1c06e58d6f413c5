#pragma once
// The matrix of a mechanism that is solved alone, not abreast of others, and its rows.

#include "solvers/lay.hpp"

namespace carom {

/// The matrix of a mechanism that is alone, and its joints that are no hinges.
template <int N>
class OwnMatrix {
  public:
    OwnMatrix(Mechanism& m, BlockMatrix<N>& matrix, const Asked& asked, DeskLayout<double, N>& on)
        : m_(m), matrix_(matrix), asked_(asked), on_(on) {}

    /// Whether the factor is that of the rows as they are now.
    template <class OnDesk>
    bool fits(const OnDesk&) {
        if (!knows_rows_) {
            if (m_.is_dear) note_velocities();
            rounds_ = m_.is_dear && is_still(asked_.threads, m_, asked_.h,
                                             [](const Mechanism::Part& p, std::size_t i) { return p.v[i]; });
            has_rows_ = has_factor_of_rows(asked_.threads, m_, asked_.which(), asked_.h, rounds_), knows_rows_ = true;
        }
        const auto is_as_factored = [&](const BoundShape& b) {
            return is_in(m_.factored.steps[b.line]) == is_in(on_.lines[b.line].step);
        };
        return has_rows_ && std::all_of(m_.shape->bounds.begin(), m_.shape->bounds.end(), is_as_factored);
    }
    /// What serves the rounds of iterations.
    template <class OnDesk>
    void refactor(const OnDesk&, bool) {
        note_steps();
        factor_to_keep(m_, matrix_, asked_.which(), asked_.h, rounds_,
                       [this](const JointLine& line) { return softness_of(line); });
        knows_rows_ = has_rows_ = true;
    }
    void refactor(double more) {
        m_.factored.h = 0;
        has_rows_ = false;
        note_steps();
        factor(m_, matrix_, rows_at(asked_.which()), more, [this](const JointLine& line) { return softness_of(line); });
    }
    void solve(double* y) const { matrix_.solve_in_order(y); }
    /// The factor of the rows where the drift ends with the velocities of now; they are noted there.
    const BlockMatrix<N>& factor_of_end() {
        for (std::uint32_t p = 0; p < m_.parts.size(); ++p) m_.parts[p].now = end_of(p);
        carom::look(asked_.threads, m_, asked_.all.joints, &JointLine::last);
        note_steps();
        auto& of_end = spare_matrix<N>(m_);
        factor(m_, of_end, rows_at(&JointLine::last), slack_of(m_),
               [this](const JointLine& line) { return softness_of(line); });
        return of_end;
    }
    /// Whether rows are rounded for it, as those of what lies as good as still.
    template <class OnDesk>
    bool is_rounded(const OnDesk& desk) {
        fits(desk);
        return rounds_;
    }
    /// Where it has many parts these lie in lanes for it.
    bool looks_ahead(const DeskShape& shape, const DeskTask& task, double& worst) const {
        constexpr std::size_t many = 8;
        if (!shape.is_plain || shape.parts < many) return false;
        worst = desk_kernel().look_ahead(shape, task, on_.memory());
        return true;
    }
    template <bool whole, class OnDesk>
    void look(const OnDesk&, std::size_t joint) {
        const Member& k = m_.members[joint];
        JointRow rows[most_rows];
        rows_of(k, asked_.all.joints, end_of(k.a), end_of(k.b), rows);
        for (std::uint32_t r = 0; r < k.lines; ++r) {
            DeskLine<double>& line = on_.lines[k.line + r];
            line.last_error = rows[r].error;
            if (!whole) continue;
            std::copy(rows[r].a, rows[r].a + 3, line.a), std::copy(rows[r].b, rows[r].b + 3, line.b);
        }
    }
    End end_of(std::uint32_t part) const {
        const DeskPart<double>& p = on_.parts[part];
        End end = m_.parts[part].start;
        end.position = {p.now.x, p.now.y}, end.cosine = p.now.cosine, end.sine = p.now.sine, end.angle = p.now.angle;
        return end;
    }

  private:
    void note_velocities() {
        for (std::size_t p = 0; p < m_.parts.size(); ++p) std::copy(on_.parts[p].v, on_.parts[p].v + 3, m_.parts[p].v);
    }
    void note_steps() {
        for (const BoundShape& b : m_.shape->bounds) m_.lines[b.line].step = static_cast<Step>(on_.lines[b.line].step);
    }
    double softness_of(const JointLine& line) const {
        const std::uint32_t bound = m_.shape->bound_of[static_cast<std::size_t>(&line - m_.lines.data())];
        return line.law->kind == Law::Kind::spring ? on_.bounds[bound].softness : 0;
    }

    Mechanism& m_;
    BlockMatrix<N>& matrix_;
    const Asked asked_;  ///< of its rounds none is looked at
    DeskLayout<double, N>& on_;
    bool knows_rows_ = false, has_rows_ = false;  ///< that the factor is of the rows as they are
    bool rounds_ = false;                         ///< rows are rounded for it
};

}  // namespace carom
