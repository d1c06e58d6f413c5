#pragma once
// The matrix of a mechanism's rows, S = J M⁻¹ Jᵀ, and when its factor serves again.

#include <optional>

#include "solvers/desk.hpp"
#include "solvers/parts.hpp"

namespace carom {

/// The slack where the rows of the matrix are rounded: what they lack in redundancy is below it then.
inline constexpr double slack_of_rounded = 1e-8;
/// To what part of a joint's size its rows are rounded then.
inline constexpr double coarseness = 1.0 / (1 << 17);

/// A row as it is in the matrix of what is dear and lies as good as still: so rounded that the matrix stays the same,
/// whatever happened before, and its factor serves on.
inline JointRow rounded(const Member& k, JointRow j) {
    constexpr double whole = 1.5 * (1LL << 52) * coarseness;  // what is added to it loses the rest
    for (int i = 0; i < 3; ++i) {
        j.a[i] = ((j.a[i] * k.per_size + whole) - whole) * k.size;
        j.b[i] = ((j.b[i] * k.per_size + whole) - whole) * k.size;
    }
    return j;
}

/// The slack of a mechanism's rows that are not rounded.
inline double slack_of(const Mechanism& m) { return m.is_redundant ? slack_of_redundant : slack; }

template <int N>
DeskShape shape_of(const Mechanism& m, const BlockMatrix<N>& matrix, const Mechanism::Rows& rows) {
    const Mechanism::Shape& s = *m.shape;
    return {.parts = m.parts.size(),
            .joints = rows.joints.size(),
            .lines = rows.line_of.size(),
            .bounds = rows.bounds.size(),
            .couplings = s.couplings.size(),
            .blocks = matrix.below_count(),
            .joint = rows.joints.data(),
            .bound = rows.bounds.data(),
            .bound_of = rows.bound_of.data(),
            .line_of = rows.line_of.data(),
            .spring_of = s.spring_of.data(),
            .coupling = s.couplings.data(),
            .order = matrix.order(),
            .has_pairs = s.has_pairs,
            .is_simple = s.bounds.empty(),
            .is_plain = N == 2 && m.is_hinged};
}
template <int N>
DeskShape shape_of(const Mechanism& m, const BlockMatrix<N>& matrix) {
    return shape_of(m, matrix, *m.shape);
}

/// The rows as one of the two looks left them.
inline auto rows_at(JointRow JointLine::*which) {
    return [which](const JointLine& line) -> const JointRow& { return line.*which; };
}

/// The part of a body in what S has on its diagonal for a row, and all of it.
inline double yield_of(const double* ease, const double* j) {
    return ease[0] * j[0] * j[0] + ease[1] * j[1] * j[1] + ease[2] * j[2] * j[2];
}
inline double own_of(const Mechanism& m, const Member& k, const JointRow& row) {
    return yield_of(m.parts[k.a].ease, row.a) + yield_of(m.parts[k.b].ease, row.b);
}
/// The most that it has for rows of ways, and of angles.
struct MostOwn {
    double of_ways = 0, of_angles = 0;

    template <class Rows>
    MostOwn(const Mechanism& m, Rows row_of) {
        for (const Member& k : m.members)
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                const JointLine& line = m.lines[k.line + r];
                double& most = line.law->turns ? of_angles : of_ways;
                most = std::max(most, own_of(m, k, row_of(line)));
            }
    }
};

/// A mechanism's rows as `assemble` sees them.
template <class Rows, class Softness>
struct MatrixSource {
    const Mechanism& m;
    Rows row_of;
    Softness softness_of;
    DeskShape shape;
    bool is_rounded;
    std::optional<MostOwn> most{};

    const double* ease(std::uint32_t part) const { return m.parts[part].ease; }
    const double* a(std::uint32_t line) const { return row_of(m.lines[line]).a; }
    const double* b(std::uint32_t line) const { return row_of(m.lines[line]).b; }
    bool kept(std::uint32_t line) const { return is_in(m.lines[line].step); }
    double softness(std::uint32_t line) const { return softness_of(m.lines[line]); }
    bool is_stop(std::uint32_t line) const { return m.lines[line].law->kind == Law::Kind::stop; }
    bool is_hinge(const JointShape& k) const { return k.is_hinge && !is_rounded; }
    /// What the slack of a row is a part of: of rows that say the same, those bear like forces that have like slack.
    double common(std::uint32_t line, double own) const {
        if (!most || !(own > 0)) return own;
        return m.lines[line].law->turns ? most->of_angles : most->of_ways;
    }
};
/// Another matrix of the same blocks.
template <int N>
BlockMatrix<N>& spare_matrix(Mechanism& m) {
    auto& matrix = m.spare_matrix;
    if (matrix.index() != m.matrix.index() || std::get<BlockMatrix<N>>(matrix).order().rows == 0) matrix = m.matrix;
    return std::get<BlockMatrix<N>>(matrix);
}
/// Fills the matrix for rows that are kept, with their softnesses, and factors it.
template <int N, class Rows, class Softness>
void factor(const Mechanism& m, BlockMatrix<N>& matrix, Rows row_of, double more, Softness softness,
            bool is_rounded = false) {
    MatrixSource<Rows, Softness> source{m, row_of, softness, shape_of(m, matrix), is_rounded};
    if (m.is_redundant && !m.is_dear) source.most.emplace(m, row_of);
    assemble<double, N>(source, more, matrix.diagonals(), matrix.below_diagonals());
    matrix.factor();
}

/// Whether bodies turn and move so little in a substep of h [s] that a rounded matrix stays what it is for long.
template <class VelocityOf>
bool is_still(int threads, const Mechanism& m, double h, VelocityOf velocity_of) {
    return !is_any(threads, m.parts.size(), [&](std::size_t i) {
        const Mechanism::Part& p = m.parts[i];
        const double way = h * std::max(std::abs(velocity_of(p, 0)), std::abs(velocity_of(p, 1)));
        return !(h * std::abs(velocity_of(p, 2)) < coarseness && way < coarseness * m.size);
    });
}
/// Factors the matrix as rounds of iterations want it, and notes for what; one whose rows are rounded serves more than
/// these.
template <int N, class Softness>
void factor_to_keep(Mechanism& m, BlockMatrix<N>& matrix, JointRow JointLine::*which, double h, bool rounds,
                    Softness softness) {
    Mechanism::Factored& factored = m.factored;
    factored.h = h, factored.is_rounded = rounds;
    factored.steps.resize(m.lines.size());
    for (std::size_t i = 0; i < m.lines.size(); ++i) factored.steps[i] = m.lines[i].step;
    if (!rounds) {
        factor(m, matrix, rows_at(which), slack_of(m), softness);
        return;
    }
    factored.rows.resize(m.lines.size()), factored.ease.resize(3 * m.parts.size());
    for (const Member& k : m.members)
        for (std::uint32_t i = k.line; i < k.line + k.lines; ++i) factored.rows[i] = rounded(k, m.lines[i].*which);
    for (std::size_t p = 0; p < m.parts.size(); ++p)
        std::copy(m.parts[p].ease, m.parts[p].ease + 3, &factored.ease[3 * p]);
    const auto row_of = [&](const JointLine& line) -> const JointRow& {
        return factored.rows[static_cast<std::size_t>(&line - m.lines.data())];
    };
    factor(m, matrix, row_of, slack_of_rounded, softness, true);
}
/// Whether that is of the rows as they are now, in a substep of h [s]. One that was not rounded is forgotten where it
/// is not.
inline bool has_factor_of_rows(int threads, const Mechanism& m, JointRow JointLine::*which, double h, bool rounds) {
    if (m.factored.h != h || m.factored.is_rounded != rounds || !rounds)
        return m.factored.h == h && m.factored.is_rounded == rounds;
    const auto same = [](const double* a, const double* b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; };
    const auto has_others = [&](std::size_t joint) {
        const Member& k = m.members[joint];
        for (std::uint32_t i = k.line; i < k.line + k.lines; ++i) {
            const JointRow row = rounded(k, m.lines[i].*which);
            if (!same(row.a, m.factored.rows[i].a) || !same(row.b, m.factored.rows[i].b)) return true;
        }
        return false;
    };
    const auto is_eased = [&](std::size_t p) { return !same(m.parts[p].ease, &m.factored.ease[3 * p]); };
    return !is_any(threads, m.members.size(), has_others) && !is_any(threads, m.parts.size(), is_eased);
}

}  // namespace carom
