#pragma once
// Expressions of named variables, by muParser, with elementary functions that give the same bits everywhere.

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace carom {

class Expression {
  public:
    /// `resolve` is asked for every name in the text that is no function, and returns its value's place, which must
    /// outlive the expression; it throws an Error for a name it does not know.
    using Resolve = std::function<double*(const std::string& name)>;
    Expression(const std::string& text, const Resolve& resolve);
    Expression(Expression&&) noexcept;
    ~Expression();

    double operator()() const;

  private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
};

/// An expression of variables given by position; a value that copies deeply, so that worlds that hold one stay values.
class Function {
  public:
    Function(const std::string& text, std::vector<std::string> variables, std::vector<std::pair<std::string, double>> constants);
    Function(const Function& other);
    Function(Function&&) noexcept = default;
    Function& operator=(const Function&) = delete;

    template <class... Values>
    double operator()(Values... values) const {
        std::size_t i = 0;
        (((*values_)[i++] = values), ...);
        return (*expression_)();
    }

  private:
    std::string text_;
    std::vector<std::string> variables_;
    std::vector<std::pair<std::string, double>> constants_;
    std::unique_ptr<std::vector<double>> values_;
    std::unique_ptr<Expression> expression_;
};

}  // namespace carom
