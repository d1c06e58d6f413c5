#pragma once
// The coarsest step, or tolerance, that is fine enough: found by trying.

#include <optional>

namespace carom {

/// A run that was made, and its largest error, as a part of the error allowed.
struct Trial {
    double value;  ///< step [s] or tolerance
    double error;
};

/// Between a run that is too coarse and one that is finer than it need be, errors are taken for powers of the step.
class Refinement {
  public:
    /// `order`: of the error in the value; `finest`: nothing below is thought of.
    Refinement(Trial too_coarse, double order, double finest) : coarse_(too_coarse), order_(order), finest_(finest) {}

    /// A run that is known already.
    void know(Trial trial);
    /// What to try next, a number of two digits; nothing if what is known is near enough to the error allowed, or
    /// there is nothing between.
    std::optional<double> next() const;
    /// How the try came out.
    void learn(Trial trial) { know(trial), ++tries_; }
    /// The coarsest value that was found fine enough.
    std::optional<double> found() const { return fine_ ? std::optional(fine_->value) : std::nullopt; }

  private:
    double between() const;
    double beyond() const;

    Trial coarse_;                 // the finest that is too coarse
    std::optional<Trial> fine_{};  // the coarsest that is fine enough
    double order_, finest_;
    int tries_ = 0;
};

}  // namespace carom
