#pragma once
// The matrix of a mechanism's rows, S = J M⁻¹ Jᵀ, and when its factor serves again.

#include "solvers/parts.hpp"

namespace carom {

/// Added to the diagonal of S, as a part of it: rows that say what others say too have a solution then.
inline constexpr double slack = 1e-13;
/// The same where the rows of the matrix are rounded: what they lack in redundancy is below it then.
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

/// The rows as one of the two looks left them.
inline auto rows_at(JointRow Line::*which) {
    return [which](const Line& line) -> const JointRow& { return line.*which; };
}

/// Fills the matrix for rows that are kept, with their softnesses, and factors it. The others are rows of 1.
template <int N, class Rows, class Softness>
void factor(Mechanism& m, BlockMatrix<N>& matrix, Rows row_of, double more, Softness softness) {
    matrix.clear();
    const auto weighed = [](const Mechanism::Part& p, const double* j, double* out) {
        for (int i = 0; i < 3; ++i) out[i] = p.ease[i] * j[i];
    };
    const auto product = [](const double* x, const double* y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; };
    for (std::uint32_t i = 0; i < m.members.size(); ++i) {
        const Member& k = m.members[i];
        auto& block = matrix.diagonal(i).at;
        for (std::uint32_t r = 0; r < N; ++r) {
            const bool kept = r < k.lines && is_in(m.lines[k.line + r].step);
            if (!kept) block[r][r] = 1;
            if (!kept) continue;
            const JointRow& row = row_of(m.lines[k.line + r]);
            double a[3], b[3];
            weighed(m.parts[k.a], row.a, a), weighed(m.parts[k.b], row.b, b);
            for (std::uint32_t c = 0; c < k.lines; ++c) {
                const Line& other = m.lines[k.line + c];
                if (!is_in(other.step)) continue;
                const JointRow& column = row_of(other);
                block[r][c] = product(a, column.a) + product(b, column.b);
            }
            // A motor may contradict what is rigid: then it is to come to its bounds without pushing very hard.
            const double part = m.lines[k.line + r].law.kind == Law::Kind::stop ? std::max(more, 1e-6) : more;
            block[r][r] += part * block[r][r] + softness(m.lines[k.line + r]) + 1e-300;
        }
    }
    for (const Mechanism::Coupling& c : m.couplings) {
        const Member &k = m.members[c.k], &l = m.members[c.l];
        auto& block = matrix.block({c.index, false}).at;
        for (std::uint32_t r = 0; r < k.lines; ++r) {
            const Line& row = m.lines[k.line + r];
            if (!is_in(row.step)) continue;
            double side[3];
            const JointRow& own = row_of(row);
            weighed(m.parts[c.part], c.k_is_b ? own.b : own.a, side);
            for (std::uint32_t s = 0; s < l.lines; ++s) {
                const Line& other = m.lines[l.line + s];
                if (!is_in(other.step)) continue;
                const JointRow& column = row_of(other);
                block[r][s] += product(side, c.l_is_b ? column.b : column.a);
            }
        }
    }
    matrix.factor();
}

/// Whether bodies turn and move so little in a substep of h [s] that a rounded matrix stays what it is for long.
inline bool is_still(const Mechanism& m, double h) {
    double size = 0;
    for (const Member& k : m.members) size = std::max(size, k.size);
    return std::all_of(m.parts.begin(), m.parts.end(), [&](const Mechanism::Part& p) {
        return h * std::abs(p.v[2]) < coarseness &&
               h * std::max(std::abs(p.v[0]), std::abs(p.v[1])) < coarseness * size;
    });
}
/// Factors the matrix as rounds of iterations want it, and notes for what; one whose rows are rounded serves more than
/// these.
template <int N, class Softness>
void factor_to_keep(Mechanism& m, BlockMatrix<N>& matrix, JointRow Line::*which, double h, bool rounds,
                    Softness softness) {
    Mechanism::Factored& factored = m.factored;
    factored.h = h, factored.is_rounded = rounds;
    factored.steps.resize(m.lines.size());
    for (std::size_t i = 0; i < m.lines.size(); ++i) factored.steps[i] = m.lines[i].step;
    if (!rounds) {
        factor(m, matrix, rows_at(which), slack, softness);
        return;
    }
    factored.rows.resize(m.lines.size()), factored.ease.resize(3 * m.parts.size());
    for (const Member& k : m.members)
        for (std::uint32_t i = k.line; i < k.line + k.lines; ++i) factored.rows[i] = rounded(k, m.lines[i].*which);
    for (std::size_t p = 0; p < m.parts.size(); ++p)
        std::copy(m.parts[p].ease, m.parts[p].ease + 3, &factored.ease[3 * p]);
    const auto row_of = [&](const Line& line) -> const JointRow& {
        return factored.rows[static_cast<std::size_t>(&line - m.lines.data())];
    };
    factor(m, matrix, row_of, slack_of_rounded, softness);
}
/// Whether that is of the rows as they are now, in a substep of h [s]. One that was not rounded is forgotten where it
/// is not.
inline bool has_factor_of_rows(const Mechanism& m, JointRow Line::*which, double h, bool rounds) {
    if (m.factored.h != h || m.factored.is_rounded != rounds || !rounds)
        return m.factored.h == h && m.factored.is_rounded == rounds;
    const auto same = [](const double* a, const double* b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; };
    for (const Member& k : m.members)
        for (std::uint32_t i = k.line; i < k.line + k.lines; ++i) {
            const JointRow row = rounded(k, m.lines[i].*which);
            if (!same(row.a, m.factored.rows[i].a) || !same(row.b, m.factored.rows[i].b)) return false;
        }
    for (std::size_t p = 0; p < m.parts.size(); ++p)
        if (!same(m.parts[p].ease, &m.factored.ease[3 * p])) return false;
    return true;
}
/// And of the same rows kept.
inline bool has_factor_of_steps(const Mechanism& m) {
    for (std::size_t i = 0; i < m.lines.size(); ++i)
        if (is_in(m.factored.steps[i]) != is_in(m.lines[i].step)) return false;
    return true;
}

}  // namespace carom
