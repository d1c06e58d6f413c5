#include "scene/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <carom/error.hpp>
#include <carom/scene.hpp>
#include <cmath>
#include <limits>

#include "scene/closed_forms.hpp"
#include "scene/compiler.hpp"
#include "scene/hints.hpp"

namespace carom {

Expression::Expression(const std::string& text, const Resolve& resolve) {
    if (text.size() > 4096) throw Error("an expression must be at most 4096 characters long");
    code_ = compiled(text, resolve);
}

bool Expression::looks_at(std::size_t variable) const {
    return std::any_of(code_.begin(), code_.end(), [variable](const Instruction& i) {
        return i.op == Instruction::Op::load && i.variable == variable;
    });
}

namespace {

/// A closed form that was asked for what its formula is not for, and the number that it refused.
struct Refusal {
    const ClosedForm* form = nullptr;
    std::size_t parameter = 0;
    double value = 0;

    Error error() const {
        const auto& refused = form->parameters[parameter];
        return Error(fmt::format("'{}' needs {}, got {} = {}", form->name, refused.allowed, refused.name, value));
    }
};

double call_form(const ClosedForm& form, const double* arguments, Refusal& refusal) {
    const std::size_t refused = form.first_refused(arguments);
    if (refused == form.parameters.size()) return form.value(arguments);
    refusal = {&form, refused, arguments[refused]};
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double Expression::operator()(std::span<const double> variables) const {
    double stack[deepest];
    stack[0] = 0;         // no compiler knows that there is code
    double* end = stack;  // behind the top
    Refusal refusal;
    for (const Instruction& i : code_) {
        switch (i.op) {
            case Instruction::Op::push:
                *end++ = i.number;
                break;
            case Instruction::Op::load:
                *end++ = variables[i.variable];
                break;
            case Instruction::Op::negate:
                end[-1] = -end[-1];
                break;
            case Instruction::Op::invert:
                end[-1] = end[-1] == 0;
                break;
            case Instruction::Op::call:
                end[-1] = i.function(end[-1]);
                break;
            case Instruction::Op::call2:
                --end, end[-1] = i.function2(end[-1], end[0]);
                break;
            case Instruction::Op::call_form:
                end -= i.form->parameters.size() - 1, end[-1] = call_form(*i.form, end - 1, refusal);
                break;
            case Instruction::Op::choose:
                end -= 2, end[-1] = end[-1] != 0 ? end[0] : end[1];
                break;
        }
    }
    if (!std::isnan(stack[0])) return stack[0];
    // What c ? a : b leaves out may be beyond a formula.
    if (refusal.form) throw refusal.error();
    return std::numeric_limits<double>::quiet_NaN();  // one of a calculation has the sign that its processor likes
}

std::string in_expression(const std::string& name) {
    if (Expression::reads_as_name(name)) return name;
    std::string out = "'";
    for (const char c : name) out += c == '\'' ? std::string("''") : std::string(1, c);
    return out + "'";
}

Function::Function(const std::string& text, const std::vector<std::string>& variables, const Constants& parameters,
                   const std::vector<std::string>& later)
    : expression_(text, [&](const std::string& name) -> Expression::Meaning {
          const auto variable = std::find(variables.begin(), variables.end(), name);
          const auto constant =
              std::find_if(parameters.begin(), parameters.end(), [&](const auto& c) { return c.first == name; });
          if (variable != variables.end() && constant != parameters.end())
              throw Error(
                  fmt::format("'{}' is a variable here, and the parameter of that name needs another one", name));
          if (variable != variables.end()) return static_cast<std::size_t>(variable - variables.begin());
          if (constant != parameters.end()) return constant->second;
          if (std::find(later.begin(), later.end(), name) != later.end())
              throw Error(fmt::format("'{}' comes later: an expression knows the parameters before it", name));
          std::vector<std::string> known = variables;
          for (const auto& c : parameters) known.push_back(c.first);
          for (const std::string& name_of_constant : constant_names()) known.push_back(name_of_constant);
          throw Error(fmt::format("there is no '{}' here{}", name, instead_of(name, known)));
      }) {}

}  // namespace carom
