#pragma once
// Expressions of named variables, with elementary functions that give the same bits everywhere.

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace carom {

struct ClosedForm;

/// A formula, compiled for a small stack machine. A value: a copy shares nothing, and any number of threads may
/// evaluate it.
///
/// Numbers, names, ( ), function(…), then by falling precedence ^, - + ! in front, * /, + -, < <= > >= == !=, &&, ||,
/// c ? a : b. A name is letters, digits and _ . [ ]; what else it may contain stands in 'single quotes', a quote twice.
class Expression {
  public:
    /// What a name stands for: a constant, or the number of a variable.
    using Meaning = std::variant<double, std::size_t>;
    /// Is asked for every name that is no function and no constant of mathematics; an Error if it knows none.
    using Resolve = std::function<Meaning(const std::string& name)>;
    /// An Error says what is wrong, and where; it does not repeat the text.
    Expression(const std::string& text, const Resolve& resolve);

    /// An Error if the value is no number since a closed form in it was asked for what its formula is not for.
    double operator()(std::span<const double> variables) const;

    /// Whether the variable of a number is in it.
    bool looks_at(std::size_t variable) const;

    /// Whether a name is that of a function or a constant.
    static bool knows(const std::string& name);
    /// What there is beside names and closed forms, and what it means, in words.
    static std::vector<std::pair<std::string, std::string>> reference();
    /// Whether a name can be written without quotes.
    static bool reads_as_name(const std::string& name);

    struct Instruction {
        enum class Op { push, load, negate, invert, call, call2, call_form, choose } op;
        double number = 0;
        std::size_t variable = 0;
        double (*function)(double) = nullptr;
        double (*function2)(double, double) = nullptr;
        const ClosedForm* form = nullptr;
    };
    /// Numbers that wait for their operator at most.
    static constexpr std::size_t deepest = 64;

  private:
    std::vector<Instruction> code_;
};

/// An expression of variables given by position.
class Function {
  public:
    using Constants = std::vector<std::pair<std::string, double>>;
    /// `later`: constants that are not known yet.
    Function(const std::string& text, const std::vector<std::string>& variables, const Constants& constants,
             const std::vector<std::string>& later = {});

    template <class... Values>
    double operator()(Values... values) const {
        const double all[] = {values..., 0};
        return expression_(all);
    }
    /// Whether the variable in this position is in it.
    bool looks_at(std::size_t variable) const { return expression_.looks_at(variable); }

  private:
    Expression expression_;
};

}  // namespace carom
