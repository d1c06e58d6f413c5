#pragma once
// Broyden's method: Newton's, with what its own steps show of a Jacobian that nobody has factored.

#include "math/scratch.hpp"

namespace carom {

/// Betters the steps S⁻¹ r that bring what is missing, r, to nothing, where S is a symmetric and positive matrix that
/// is near the Jacobian: each step has shown what S had wrong along it (C. G. Broyden, Math. Comp. 19, 577, 1965, the
/// first method; without a matrix as in C. T. Kelley, Iterative Methods for Linear and Nonlinear Equations, 1995, ch.
/// 7). Steps are compared by sᵀ S s, an energy, and not by a sum of newtons and newton metres.
class Secants {
  public:
    /// To be called when the equations or S have changed.
    void forget() { steps_.clear(); }

    /// Makes S⁻¹ r the next step, which is to be taken then.
    void improve(const double* missing, double* step, std::size_t rows) {
        Step next{{step, step + rows}, {missing, missing + rows}};
        for (std::size_t k = 0; k + 1 < steps_.size(); ++k) next.add(next.along(steps_[k]), steps_[k + 1]);
        if (!steps_.empty()) next.scale(1 / (1 - next.along(steps_.back())));
        next.size = product(next.step, next.of_step);
        std::copy(next.step.begin(), next.step.end(), step);
        steps_.push_back(std::move(next));
    }

  private:
    static double product(const Scratch<double>& a, const Scratch<double>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    }
    struct Step {
        Scratch<double> step, of_step;  ///< s and S s
        double size = 0;                ///< sᵀ S s

        double along(const Step& s) const { return s.size > 0 ? product(s.step, of_step) / s.size : 0; }
        void add(double part, const Step& s) {
            for (std::size_t i = 0; i < step.size(); ++i)
                step[i] += part * s.step[i], of_step[i] += part * s.of_step[i];
        }
        void scale(double part) {
            for (std::size_t i = 0; i < step.size(); ++i) step[i] *= part, of_step[i] *= part;
        }
    };
    Scratch<Step> steps_;
};

}  // namespace carom
