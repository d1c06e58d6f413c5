#pragma once
#include "experiment.hpp"

namespace carom::app {

/// The run as one JSON object.
std::string report_json(const Scene& scene, const Result& result);
/// The part of it that is the same whenever the scene is run, and on whatever machine: what data files say of the run.
std::string summary_json(const Scene& scene, const Result& result);
/// The run as a person reads it.
void print_report(const Scene& scene, const Result& result);
/// What an expectation looks at.
std::string in_words(const Expectation& expectation);
/// The unit of a quantity that is a single name, or a sum or difference of such of one unit; empty of any other.
std::string unit_of(const std::string& quantity);
/// "1 body", "2 bodies".
std::string counted(std::uint64_t number, const char* one, const char* many);
/// To how many digits a value is known: down to the second one of its error; `otherwise` without an error.
int digits_of(double value, double error, int otherwise);
/// "1.234 ± 0.012", and nine digits of what has no error.
std::string with_error(double value, double error);
std::string with_unit(const std::string& name, const std::string& unit);
/// One line about an expectation, in columns.
void print_verdict_heading();
/// The value, or why there is none.
std::string value_in_words(const Verdict&, int digits);
void print_verdict(const Verdict& verdict);

}  // namespace carom::app
