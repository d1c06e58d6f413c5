#include "scene/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <carom/error.hpp>
#include <cmath>

#include "math/elementary.hpp"
#include "state/nearest.hpp"

namespace carom {

struct Expression::Parser {
    mu::Parser parser;
    const Resolve* resolve = nullptr;
};

namespace {

double* create_variable(const char* name, void* self) {
    return (*static_cast<const Expression::Resolve*>(self))(name);
}

double square_root(double x) { return std::sqrt(x); }
double absolute(double x) { return std::abs(x); }
double floor_of(double x) { return std::floor(x); }
double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Never libm's own: they differ between machines.
void define_functions(mu::Parser& p) {
    p.ClearFun();
    p.DefineFun("sin", portable::sin);
    p.DefineFun("cos", portable::cos);
    p.DefineFun("tan", portable::tan);
    p.DefineFun("asin", portable::asin);
    p.DefineFun("acos", portable::acos);
    p.DefineFun("atan", portable::atan);
    p.DefineFun("atan2", portable::atan2);
    p.DefineFun("sinh", portable::sinh);
    p.DefineFun("cosh", portable::cosh);
    p.DefineFun("tanh", portable::tanh);
    p.DefineFun("exp", portable::exp);
    p.DefineFun("ln", portable::log);
    p.DefineFun("log", portable::log);
    p.DefineFun("pow", portable::pow);
    p.DefineFun("hypot", portable::hypot);
    p.DefineFun("sqrt", square_root);
    p.DefineFun("abs", absolute);
    p.DefineFun("floor", floor_of);
    p.DefineFun("sign", sign);
    p.DefineFun("min", [](double a, double b) { return a < b ? a : b; });
    p.DefineFun("max", [](double a, double b) { return a > b ? a : b; });
    p.ClearConst();
    p.DefineConst("pi", 3.14159265358979323846);
    p.DefineConst("deg", 3.14159265358979323846 / 180);
}

}  // namespace

Expression::Expression(const std::string& text, const Resolve& resolve) : parser_(std::make_unique<Parser>()) {
    if (text.size() > 4096) throw Error("an expression must be at most 4096 characters long");
    mu::Parser& p = parser_->parser;
    try {
        p.DefineNameChars("0123456789_.[]abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
        define_functions(p);
        p.SetVarFactory(create_variable, const_cast<Resolve*>(&resolve));
        p.SetExpr(text);
        p.Eval();  // compiles; later calls run the byte code
        p.SetVarFactory(create_variable, nullptr);
    } catch (const mu::ParserError& e) {
        std::string what = e.GetMsg();
        while (!what.empty() && (what.back() == '.' || what.back() == '\n')) what.pop_back();
        throw Error(fmt::format("in \"{}\": {}", text, what));
    }
}
Expression::Expression(Expression&&) noexcept = default;
Expression::~Expression() = default;

double Expression::operator()() const { return parser_->parser.Eval(); }

Function::Function(const std::string& text, std::vector<std::string> variables,
                   std::vector<std::pair<std::string, double>> constants)
    : text_(text),
      variables_(std::move(variables)),
      constants_(std::move(constants)),
      values_(std::make_unique<std::vector<double>>(variables_.size() + constants_.size())) {
    for (std::size_t k = 0; k < constants_.size(); ++k) (*values_)[variables_.size() + k] = constants_[k].second;
    const auto resolve = [this](const std::string& name) -> double* {
        std::vector<std::string> known = variables_;
        for (std::size_t k = 0; k < variables_.size(); ++k)
            if (variables_[k] == name) return &(*values_)[k];
        for (std::size_t k = 0; k < constants_.size(); ++k) {
            if (constants_[k].first == name) return &(*values_)[variables_.size() + k];
            known.push_back(constants_[k].first);
        }
        throw Error(fmt::format("in \"{}\": there is no '{}' here{}", text_, name, did_you_mean(name, known)));
    };
    expression_ = std::make_unique<Expression>(text_, resolve);
}

Function::Function(const Function& other) : Function(other.text_, other.variables_, other.constants_) {}

}  // namespace carom
