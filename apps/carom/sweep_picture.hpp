#pragma once
#include <carom/output.hpp>
#include <optional>

#include "sweep.hpp"

namespace carom::app {

/// A run of a sweep, for a picture.
struct SweepRow {
    std::vector<std::string> words;              ///< its values of the parameters, as they were written,
    std::vector<std::optional<double>> numbers;  ///< and as numbers, those that are
    std::vector<double> results{}, errors{};     ///< an error that is not known is not a number
};

/// An Error if the picture's file cannot be one, or if no parameter has numbers for an axis. Of the rows words and
/// numbers are there.
void check_sweep_picture(const Sweep& sweep, const std::vector<SweepRow>& rows);
/// A panel for each result: its curve over the one parameter; of two a curve for each value of one of them if those are
/// few or no numbers, and else a heat map. `labels`: of the results, with units.
Figure sweep_figure(const Sweep& sweep, const std::vector<std::string>& labels, const std::vector<SweepRow>& rows);

}  // namespace carom::app
