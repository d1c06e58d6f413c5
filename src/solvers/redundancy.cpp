// Whether some of a mechanism's rigid rows say what others say. Where they are counted to be more than its bodies have
// ways to move, some do. But three cranks of one length on a coupler have no more than that, and still move.

#include "solvers/factor.hpp"

namespace carom {

namespace {

/// The rows that are always kept.
template <class Rows, class Softness>
struct RigidSource : MatrixSource<Rows, Softness> {
    bool kept(std::uint32_t) const { return false; }
};

/// What elimination has left of the diagonal of S, the least part: the square of the sine of the angle between a row
/// and those before it.
template <int N>
double least_left(const Mechanism& m, BlockMatrix<N>& factor) {
    double least = 1;
    for (const Member& k : m.members)
        for (std::uint32_t r = 0; r < k.rigid; ++r) {
            const double own = own_of(m, k, m.lines[k.line + r].first);
            const double part = 1 / (own * factor.diagonals()[k.place].at[r][r]);
            if (own > 0 && !(part >= least)) least = part > 0 ? part : 0;
        }
    return least;
}

template <int N>
bool is_redundant(Mechanism& m, BlockMatrix<N>& kept, double h) {
    constexpr double hardly_any = 1e-11, plenty = 1e-8;
    // The factor of the end of the substep before is of these rows, but for the slack.
    if (m.is_simple && !m.is_redundant && m.factored.h == h && least_left(m, kept) > plenty) return false;
    BlockMatrix<N>& matrix = spare_matrix<N>(m);
    const auto row_of = rows_at(&JointLine::first);
    const auto no_softness = [](const JointLine&) { return 0.0; };
    const RigidSource<decltype(row_of), decltype(no_softness)> source{
        {m, row_of, no_softness, shape_of(m, matrix), false}};
    assemble<double, N>(source, 0, matrix.diagonals(), matrix.below_diagonals());
    matrix.factor();
    return least_left(m, matrix) < hardly_any;
}

}  // namespace

void note_redundancy(double h, Mechanism& m) {
    const bool is_one = std::visit([&]<int N>(BlockMatrix<N>& matrix) { return is_redundant(m, matrix, h); }, m.matrix);
    if (is_one != m.is_redundant) m.factored.h = 0;
    m.is_redundant = is_one;
}

}  // namespace carom
