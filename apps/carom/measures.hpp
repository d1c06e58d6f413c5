#pragma once
// The measures of a gas, for people: a picture, a table, data.

#include <carom/gas.hpp>
#include <carom/output.hpp>
#include <filesystem>
#include <vector>

namespace carom::app {

/// A panel for each curve, with its closed form where there is one.
Figure gas_figure(const GasMeter& meter);
/// Numbers, curves and fields as tables in a folder, each with its run inside; returns the files.
std::vector<std::filesystem::path> write_measures(const GasMeter& meter, const std::filesystem::path& folder,
                                                  Provenance run);

}  // namespace carom::app
