#pragma once
#include "experiment.hpp"

namespace carom::app {

/// The run as one JSON object.
std::string report_json(const std::string& scene, const Scene& source, const Result& result);
/// The run as a person reads it.
void print_report(const Scene& source, const Result& result);

}  // namespace carom::app
