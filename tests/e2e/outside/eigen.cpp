// Somebody else's use of a template that Carom uses, too, compiled as they like it.
#include <Eigen/SparseLU>

double solve() {
    Eigen::SparseMatrix<double> matrix(3, 3);
    for (int i = 0; i < 3; ++i) matrix.insert(i, i) = 2 + i;
    matrix.insert(0, 1) = 0.3;
    matrix.makeCompressed();
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(3, 1, 3), x = factors.solve(right);
    return x.sum();
}
