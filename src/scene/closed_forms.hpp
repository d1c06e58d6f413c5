#pragma once
// The motions that have a formula, as functions that expressions may call.

#include <span>
#include <string>
#include <vector>

namespace carom {

struct ClosedForm {
    struct Parameter {
        const char* name;
        const char* unit;
        const char* text;
        const char* allowed = "";  ///< the condition in words; without one it takes any number
        bool (*allows)(double own, const double* arguments) = nullptr;
    };
    const char* name;
    const char* text;    ///< what it is
    const char* source;  ///< the formula, and where it is from
    std::vector<Parameter> parameters;
    double (*value)(const double* arguments);

    /// The number of the first argument that the formula is not for; how many there are if it is for all of them.
    std::size_t first_refused(const double* arguments) const;
};

/// The one table: expressions, the reference page and the tests are made from it.
std::span<const ClosedForm> closed_forms();

}  // namespace carom
