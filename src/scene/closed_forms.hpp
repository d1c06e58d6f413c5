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
    };
    const char* name;
    const char* text;    ///< what it is
    const char* source;  ///< the formula, and where it is from
    std::vector<Parameter> parameters;
    double (*value)(const double* arguments);
};

/// The one table: expressions, the reference page and the tests are made from it.
std::span<const ClosedForm> closed_forms();

}  // namespace carom
