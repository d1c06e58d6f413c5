#include "scene/compiler.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <carom/error.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "math/elementary.hpp"
#include "scene/closed_forms.hpp"
#include "scene/hints.hpp"
#include "scene/json.hpp"

namespace carom {

namespace {

using Instruction = Expression::Instruction;
using Op = Instruction::Op;

// Never libm's own elementary functions: they differ between machines.
double square_root(double x) { return std::sqrt(x); }
double absolute(double x) { return std::abs(x); }
double floor_of(double x) { return std::floor(x); }
double ceiling_of(double x) { return std::ceil(x); }
double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
double add(double a, double b) { return a + b; }
double subtract(double a, double b) { return a - b; }
double multiply(double a, double b) { return a * b; }
double divide(double a, double b) { return a / b; }
double smaller(double a, double b) { return a < b ? a : b; }
double larger(double a, double b) { return a > b ? a : b; }
double less(double a, double b) { return a < b; }
double less_equal(double a, double b) { return a <= b; }
double greater(double a, double b) { return a > b; }
double greater_equal(double a, double b) { return a >= b; }
double equal(double a, double b) { return a == b; }
double unequal(double a, double b) { return a != b; }
double both(double a, double b) { return a != 0 && b != 0; }
double either(double a, double b) { return a != 0 || b != 0; }
/// The square is exact to the last bit as a product, and by far the commonest power.
double power(double a, double b) { return b == 2 ? a * a : portable::pow(a, b); }

/// What is left of a by whole multiples of b, between 0 and b, exact but where signs differ. Doubles of b are exact,
/// and so is a difference from what is less than twice as large.
double modulus(double a, double b) {
    if (!std::isfinite(a) || std::isnan(b) || b == 0) return std::numeric_limits<double>::quiet_NaN();
    const double whole = std::abs(b);
    double rest = std::abs(a), part = whole;
    while (part <= 0.5 * rest) part *= 2;
    for (; part >= whole && rest >= whole; part *= 0.5)
        if (rest >= part) rest -= part;
    if (rest != 0 && (a < 0) != (b < 0)) rest = whole - rest;
    return b < 0 ? -rest : rest;
}

template <class F>
struct Named {
    const char* name;
    F value;
    const char* text;
};
using Unary = double (*)(double);
using Binary = double (*)(double, double);

constexpr Named<Unary> functions[] = {{"sin", portable::sin, "sine of an angle [rad]"},
                                      {"cos", portable::cos, "cosine"},
                                      {"tan", portable::tan, "tangent"},
                                      {"asin", portable::asin, "the angle of this sine, from −π/2 to π/2"},
                                      {"acos", portable::acos, "the angle of this cosine, from 0 to π"},
                                      {"atan", portable::atan, "the angle of this tangent, from −π/2 to π/2"},
                                      {"sinh", portable::sinh, "hyperbolic sine"},
                                      {"cosh", portable::cosh, "hyperbolic cosine"},
                                      {"tanh", portable::tanh, "hyperbolic tangent"},
                                      {"exp", portable::exp, "e to a power"},
                                      {"ln", portable::log, "natural logarithm"},
                                      {"log", portable::log, "the same as ln: natural, to the base e"},
                                      {"sqrt", square_root, "square root"},
                                      {"abs", absolute, "without its sign"},
                                      {"floor", floor_of, "the largest whole number that is not above"},
                                      {"ceil", ceiling_of, "the smallest whole number that is not below"},
                                      {"sign", sign, "1, 0 or −1"}};
constexpr Named<Binary> functions2[] = {
    {"atan2", portable::atan2, "of y and x: the angle of (x, y), from −π to π"},
    {"hypot", portable::hypot, "of x and y: the length of (x, y)"},
    {"pow", power, "of a and b: a^b"},
    {"mod", modulus, "of a and b: a − b floor(a/b), from 0 to b and with its sign: mod(−1, 3) is 2"},
    {"min", smaller, "the smallest of two numbers or more"},
    {"max", larger, "the largest of two numbers or more"}};
constexpr Named<double> constants[] = {{"pi", 3.14159265358979323846, "π"},
                                       {"deg", 3.14159265358979323846 / 180, "π/180: an angle of 30° is 30*deg"}};
// Of one precedence each, from the loosest; those of two characters before those they begin with.
constexpr Named<Binary> disjunction[] = {{"||", either, "1 if one of the two is not 0, else 0"}};
constexpr Named<Binary> conjunction[] = {{"&&", both, "1 if neither of the two is 0, else 0"}};
constexpr Named<Binary> comparisons[] = {
    {"<=", less_equal, "1 if a is not larger than b, else 0; a < b < c is no expression"},
    {">=", greater_equal, "1 if a is not smaller, else 0"},
    {"==", equal, "1 if they are equal to the last bit, else 0"},
    {"!=", unequal, "1 if they are not, else 0"},
    {"<", less, "1 if a is smaller, else 0"},
    {">", greater, "1 if a is larger, else 0"}};
constexpr Named<Binary> sums[] = {{"+", add, "sum"}, {"-", subtract, "difference"}};
constexpr Named<Binary> products[] = {{"*", multiply, "product"}, {"/", divide, "quotient"}};

template <class Table>
auto find(const Table& table, const std::string& name) {
    return std::find_if(std::begin(table), std::end(table), [&](const auto& entry) { return entry.name == name; });
}

bool is_function(const std::string& name) {
    return find(functions, name) != std::end(functions) || find(functions2, name) != std::end(functions2) ||
           find(closed_forms(), name) != closed_forms().end();
}

bool begins_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '\'' || static_cast<signed char>(c) < 0;
}
bool continues_name(char c) { return begins_name(c) || is_digit(c) || c == '.' || c == '[' || c == ']'; }

/// Recursive descent: a rule of the grammar is a function that leaves its value on top of the stack.
class Compiler {
  public:
    Compiler(const std::string& text, const Expression::Resolve& resolve) : text_(text), resolve_(resolve) {}

    std::vector<Instruction> compile() {
        conditional();
        const auto digit_at = [this](std::size_t k) { return k < text_.size() && is_digit(text_[k]); };
        if (at_ > 0 && at_ < text_.size() && text_[at_] == ',' && digit_at(at_ - 1) && digit_at(at_ + 1))
            fail("a number has a point and no comma");
        if (at_ < text_.size()) fail("expected an operator");
        return std::move(code_);
    }

  private:
    void conditional() {
        if (++nested_ > Expression::deepest) throw Error("it is nested too deeply");
        operators(disjunction, [this] { operators(conjunction, [this] { comparison(); }); });
        if (accept("?")) {
            conditional();
            expect(":");
            conditional();
            emit({.op = Op::choose}, -2);
        }
        --nested_;
    }

    void comparison() {
        const auto side = [this] { operators(sums, [this] { operators(products, [this] { prefixed(); }); }); };
        side();
        if (const Binary compare = accept_one_of(comparisons)) {
            side();
            call(compare);
            if (accept_one_of(comparisons)) fail("a comparison has two sides; join two with && before this");
        }
    }

    /// operand (operator operand)*, from the left.
    template <class Table, class Operand>
    void operators(const Table& table, Operand operand) {
        operand();
        while (const Binary apply = accept_one_of(table)) {
            operand();
            call(apply);
        }
    }

    void prefixed() {
        if (++nested_ > Expression::deepest) throw Error("it is nested too deeply");
        if (accept("-")) {
            prefixed();
            emit({.op = Op::negate}, 0);
        } else if (accept("!")) {
            prefixed();
            emit({.op = Op::invert}, 0);
        } else if (accept("+")) {
            prefixed();
        } else {
            primary();
            if (accept("^")) {
                prefixed();  // from the right: 2^3^2 is 2^9, and -2^2 is -4
                call(power);
            }
        }
        --nested_;
    }

    void primary() {
        skip_blanks();
        const char c = at_ < text_.size() ? text_[at_] : '\0';
        if (accept("(")) {
            conditional();
            expect(")");
        } else if (is_digit(c) || (c == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))) {
            emit({.op = Op::push, .number = number()}, 1);
        } else if (begins_name(c)) {
            const std::string word = name();
            if (accept("("))
                function(word);
            else
                variable(word);
        } else {
            if (c == '*' && at_ > 0 && text_[at_ - 1] == '*') throw Error("a power is written a^b, and not a**b");
            fail("expected a number, a name or (");
        }
    }

    void function(const std::string& word) {
        std::size_t arguments = 0;
        do {
            conditional();
            ++arguments;
        } while (accept(","));
        expect(")");
        const auto one = find(functions, word);
        const auto two = find(functions2, word);
        if (const auto form = find(closed_forms(), word); form != closed_forms().end()) return call(*form, arguments);
        const bool any_number = word == "min" || word == "max";
        if (one == std::end(functions) && two == std::end(functions2)) refuse_look_alike(word);
        if (one == std::end(functions) && two == std::end(functions2))
            throw Error(fmt::format(
                "there is no function '{}'{}", word,
                is_known(word) ? fmt::format("; did you mean '{}*('?", word) : instead_of(word, function_names())));
        if (one != std::end(functions) ? arguments != 1 : any_number ? arguments < 2 : arguments != 2)
            throw Error(fmt::format("'{}' takes {}, got {}", word,
                                    one != std::end(functions) ? "one number"
                                    : any_number               ? "two numbers or more"
                                                               : "two numbers",
                                    arguments));
        if (one != std::end(functions))
            emit({.op = Op::call, .function = one->value}, 0);
        else
            for (; arguments > 1; --arguments) call(two->value);
    }

    void call(const ClosedForm& form, std::size_t arguments) {
        std::vector<std::string> names;
        for (const auto& parameter : form.parameters) names.push_back(parameter.name);
        if (arguments != names.size())
            throw Error(fmt::format("'{}' takes {} numbers ({}), got {}", form.name, names.size(),
                                    fmt::join(names, ", "), arguments));
        emit({.op = Op::call_form, .form = &form}, 1 - static_cast<int>(arguments));
    }

    void variable(const std::string& word) {
        if (const auto known = find(constants, word); known != std::end(constants))
            return emit({.op = Op::push, .number = known->value}, 1);
        if (is_function(word)) throw Error(fmt::format("'{}' is a function and needs (", word));
        const Expression::Meaning meaning = meaning_of(word);
        if (const auto* constant = std::get_if<double>(&meaning))
            emit({.op = Op::push, .number = *constant}, 1);
        else
            emit({.op = Op::load, .variable = std::get<std::size_t>(meaning)}, 1);
    }

    /// A name may have any letter, and so only one that nobody knows is asked for what it looks like.
    Expression::Meaning meaning_of(const std::string& word) const {
        try {
            return resolve_(word);
        } catch (const Error&) {
            refuse_look_alike(word);
            throw;
        }
    }
    static void refuse_look_alike(std::string_view text) {
        std::size_t at = 0;
        if (const LookAlike* one = look_alike_in(text, at)) throw Error(in_words(*one));
    }

    double number() {
        const auto digits = [this] {
            const std::size_t from = at_;
            while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
            return text_.substr(from, at_ - from);
        };
        const std::size_t from = at_;
        std::string whole = digits(), fraction, exponent = "0";
        if (at_ < text_.size() && text_[at_] == '.') ++at_, fraction = digits();
        if (const std::size_t e = at_; e < text_.size() && (text_[e] == 'e' || text_[e] == 'E')) {
            const std::string sign_of =
                ++at_ < text_.size() && (text_[at_] == '-' || text_[at_] == '+') ? std::string(1, text_[at_++]) : "";
            exponent = digits();
            if (exponent.empty()) at_ = e, fail("expected the digits of an exponent after this");
            exponent = sign_of + exponent;
        }
        // JSON's own number, which no locale changes and which is rounded correctly.
        whole.erase(0, std::min(whole.find_first_not_of('0'), whole.size()));
        const auto value = nlohmann::json::parse(
            fmt::format("{}.{}0e{}", whole.empty() ? "0" : whole, fraction, exponent), nullptr, false);
        if (value.is_discarded())
            throw Error(fmt::format("the number {} is too large", text_.substr(from, at_ - from)));
        return value.get<double>();
    }

    std::string name() {
        std::string out;
        while (at_ < text_.size() && continues_name(text_[at_])) {
            if (text_[at_] != '\'') {
                out += text_[at_++];
                continue;
            }
            out += quoted();
            while (at_ < text_.size() && text_[at_] == '\'') out += '\'' + quoted();  // two are one of the name
        }
        return out;
    }

    std::string quoted() {
        const std::size_t end = text_.find('\'', at_ + 1);
        if (end == std::string::npos) fail("expected another ' after this one");
        const std::string inside = text_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
        return inside;
    }

    static std::vector<std::string> function_names() {
        std::vector<std::string> names;
        for (const auto& f : functions) names.push_back(f.name);
        for (const auto& f : functions2) names.push_back(f.name);
        for (const auto& f : closed_forms()) names.push_back(f.name);
        return names;
    }

    void call(Binary apply) { emit({.op = Op::call2, .function2 = apply}, -1); }

    void emit(const Instruction& instruction, int growth) {
        waiting_ += static_cast<std::size_t>(growth);
        if (waiting_ > Expression::deepest) throw Error("it is nested too deeply");
        code_.push_back(instruction);
    }

    void skip_blanks() { at_ = std::min(text_.find_first_not_of(" \t\n\r", at_), text_.size()); }

    bool accept(const std::string& token) {
        skip_blanks();
        if (text_.compare(at_, token.size(), token) != 0) return false;
        at_ += token.size();
        skip_blanks();
        return true;
    }

    template <class Table>
    Binary accept_one_of(const Table& table) {
        for (const auto& entry : table)
            if (accept(entry.name)) return entry.value;
        return nullptr;
    }

    void expect(const char* token) {
        if (!accept(token)) fail(fmt::format("expected {}", token));
    }

    [[noreturn]] void fail(const std::string& what) const {
        if (at_ >= text_.size()) throw Error(what + ", and there it ends");
        std::size_t first = 0;
        if (const LookAlike* one = look_alike_in(text_.substr(at_), first); one && first == 0)
            throw Error(in_words(*one));
        throw Error(fmt::format("{} at character {}, got {}{}", what, at_ + 1, text_.substr(at_, 12), about_rest()));
    }

    /// What helps whoever wrote "2 sin(x)" or "2 kg": where a factor is, and no operator, or a unit.
    std::string about_rest() const {
        const std::size_t last = at_ == 0 ? text_.npos : text_.find_last_not_of(" \t\n\r", at_ - 1);
        if (last == text_.npos || !(continues_name(text_[last]) || text_[last] == ')')) return "";
        if (const std::string written = written_for(text_.substr(at_)); !written.empty()) return written;
        std::size_t end = at_;
        while (end < text_.size() && continues_name(text_[end])) ++end;
        const std::string word = text_.substr(at_, end - at_), units = about_units(text_);
        const bool factor = text_[at_] == '(' || is_known(word);
        if (!factor || (word == "deg" && !units.empty())) return units;
        if (text_.size() > 40) return "";
        return fmt::format("; did you mean '{}*{}'?", text_.substr(0, last + 1), text_.substr(at_));
    }
    bool is_known(const std::string& word) const {
        try {
            return Expression::knows(word) || (resolve_(word), true);
        } catch (const Error&) {
            return false;
        }
    }

    const std::string& text_;
    const Expression::Resolve& resolve_;
    std::vector<Instruction> code_;
    std::size_t at_ = 0, nested_ = 0, waiting_ = 0;
};

}  // namespace

std::vector<Expression::Instruction> compiled(const std::string& text, const Expression::Resolve& resolve) {
    return Compiler(text, resolve).compile();
}

std::vector<std::string> constant_names() {
    std::vector<std::string> names;
    for (const auto& c : constants) names.push_back(c.name);
    return names;
}

bool Expression::knows(const std::string& name) {
    return is_function(name) || find(constants, name) != std::end(constants);
}

std::vector<std::pair<std::string, std::string>> Expression::reference() {
    std::vector<std::pair<std::string, std::string>> out{
        {"( )", "first of all"},
        {"a^b", "power; from the right: 2^3^2 is 2^9"},
        {"-a, +a, !a", "in front, looser than ^: -2^2 is -4; !a is 1 if a is 0, else 0"}};
    const auto between = [&out](const auto& table) {
        for (const auto& [name, value, text] : table) out.emplace_back(fmt::format("a {} b", name), text);
    };
    between(products), between(sums), between(comparisons), between(conjunction), between(disjunction);
    out.emplace_back("c ? a : b", "a if c is not 0, else b");
    for (const auto& f : functions) out.emplace_back(fmt::format("{}(a)", f.name), f.text);
    for (const auto& f : functions2)
        out.emplace_back(fmt::format("{}(a, b{})", f.name, f.value == smaller || f.value == larger ? ", …" : ""),
                         f.text);
    for (const auto& c : constants) out.emplace_back(c.name, c.text);
    return out;
}

bool Expression::reads_as_name(const std::string& name) {
    return !name.empty() && begins_name(name[0]) && name.find('\'') == name.npos &&
           std::all_of(name.begin(), name.end(), continues_name);
}

}  // namespace carom
