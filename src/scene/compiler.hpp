#pragma once
// The language of expressions: its words, and their translation for the stack machine of scene/expression.hpp.

#include "scene/expression.hpp"

namespace carom {

/// The program of a formula: it leaves its value on the stack, on which no more than Expression::deepest ever wait.
std::vector<Expression::Instruction> compiled(const std::string& text, const Expression::Resolve& resolve);

/// The constants of mathematics.
std::vector<std::string> constant_names();

}  // namespace carom
