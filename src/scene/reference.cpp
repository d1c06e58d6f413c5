#include <carom/scene.hpp>

#include "scene/closed_forms.hpp"
#include "scene/expression.hpp"
#include "scene/kinds.hpp"
#include "scene/reader.hpp"
#include "scene/writer.hpp"

namespace carom {

namespace {

template <class M>
std::string kind_of() {
    if constexpr (std::is_same_v<M, bool>) {
        return "true or false";
    } else if constexpr (std::is_same_v<M, Vec2>) {
        return "[x, y]";
    } else if constexpr (std::is_arithmetic_v<M>) {
        return std::is_integral_v<M> ? "whole number" : "number";
    } else if constexpr (std::is_same_v<M, std::string>) {
        return "text";
    } else if constexpr (std::is_same_v<M, BodyId>) {
        return "body's name";
    } else if constexpr (std::is_same_v<M, Colour>) {
        return "colour";
    } else if constexpr (std::is_enum_v<M>) {
        return "choice";
    } else if constexpr (std::is_same_v<M, Integrator>) {
        return "[method](integrators.md)";
    } else if constexpr (std::is_same_v<M, Solver>) {
        return "[method](solvers.md)";
    } else if constexpr (requires(M m) { m.push_back(m.front()); }) {
        return "list of " + kind_of<typename M::value_type>();
    } else if constexpr (requires(M m) { m.has_value(); }) {
        return kind_of<typename M::value_type>() + ", or absent";
    } else {
        return "object";
    }
}

/// What is allowed for numbers; for choices their meanings.
template <class M>
std::string allowed(const Range& range) {
    if constexpr (std::is_same_v<M, bool> || std::is_same_v<M, std::string> || std::is_same_v<M, BodyId> ||
                  std::is_same_v<M, Colour>) {
        return "";
    } else if constexpr (std::is_arithmetic_v<M> || std::is_same_v<M, Vec2>) {
        return range.words;
    } else if constexpr (std::is_enum_v<M>) {
        std::string all;
        for (const auto& c : choices(static_cast<const M*>(nullptr)))
            all += fmt::format("{}`{}`: {}", all.empty() ? "" : "; ", c.name, c.text);
        return all;
    } else if constexpr (requires { typename M::value_type; }) {
        return allowed<typename M::value_type>(range);
    } else {
        return "";
    }
}

/// What stands in a cell of a table, which a bar would end.
std::string code_cell(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return text;
}
/// The same of what is not in `quotes`, where < begins a tag.
std::string cell(std::string text) {
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; ++at) text.replace(at, 1, "&lt;");
    return code_cell(std::move(text));
}

/// What a line of a table of fields says.
struct Line {
    const char* name;
    std::string kind;
    const char* unit;
    std::string allowed;
    bool required;
    const char* text;
};

std::string row(const Line& line, const Json& standard) {
    const bool empty = standard.is_null() || standard == "" || (standard.is_structured() && standard.empty());
    return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", line.name, line.kind, line.unit, cell(line.allowed),
                       line.required ? "**required**"
                       : empty       ? ""
                                     : "`" + cell(standard.dump()) + "`",
                       cell(line.text));
}
std::string choice_row(const char* name, const std::vector<std::string>& methods, const char* text) {
    return fmt::format("| `{}` | choice |  | `{}` | **required** | {}; its fields, below, stand beside these |\n", name,
                       fmt::join(methods, "`, `"), cell(text));
}

template <class S, class M>
std::string row(const Field<S, M>& f, const Json& standard) {
    return row({f.name, kind_of<M>(), f.unit, allowed<M>(f.range), is_required(f), f.text}, standard);
}
template <class S, class M>
std::string row(const Flat<S, M>& f, const Json&) {
    return choice_row(f.name, Reader::method_names<M>(), f.text);
}

template <class T>
std::string table(const std::string& heading) {
    std::string out = fmt::format("## {}\n\n{}\n\n", heading, describe(static_cast<const T*>(nullptr)));
    if constexpr (Described<T>) {
        const T standard{};
        const Json defaults = Writer([](BodyId) { return ""; }).every(standard);
        out += "| field | value | unit | allowed | default | meaning |\n| --- | --- | --- | --- | --- | --- |\n";
        std::apply([&](const auto&... f) { ((out += row(f, defaults.at(f.name))), ...); }, fields(&standard));
        out += "\n";
    }
    return out;
}

std::string top_table() {
    std::string out = "| field | meaning |\n| --- | --- |\n";
    for (const TopKey& key : top_keys) out += fmt::format("| `{}` | {} |\n", key.name, cell(key.text));
    return out +
           "\nOf these `carom` is required. In the tables, here and on the other pages, a field has its default, or is "
           "required, or may be left out.\n\n";
}

template <class... T>
std::string tables(const std::tuple<Type<T>...>& types) {
    std::string out;
    std::apply([&](const auto&... type) { ((out += table<T>(fmt::format("`\"type\": \"{}\"`", type.name))), ...); },
               types);
    return out;
}

/// Of each of a variant's, under a heading with its name.
template <class V>
std::string methods(const char* heading = "`{}`") {
    return [heading]<std::size_t... k>(std::index_sequence<k...>) {
        return (table<std::variant_alternative_t<k, V>>(
                    fmt::format(fmt::runtime(heading), std::variant_alternative_t<k, V>::name)) +
                ...);
    }
    (std::make_index_sequence<std::variant_size_v<V>>{});
}

/// What an expression may be made of, from the tables that read it.
std::string expression_table() {
    std::string out =
        "Any number of a scene may be one, in quotes; by falling precedence. A name, of a parameter or a body, is "
        "letters, digits and `_ . [ ]`; any other stands in single quotes, and a quote in it is written twice: "
        "`'Newton''s apple'.x`. There are [closed forms](closed-forms.md), too.\n\n"
        "| function, operator | what it is |\n| --- | --- |\n";
    for (const auto& [form, text] : Expression::reference())
        out += fmt::format("| `{}` | {} |\n", code_cell(form), cell(text));
    return out;
}

/// The motions that have a formula, from the table that expressions use.
std::string closed_form_table() {
    std::string out =
        "Functions that any expression may call; a scene's `twins` hold a run against them. A number that a formula is "
        "not for, as an eccentricity of 2, is an error, unless `c ? a : b` leaves its value out.\n\n"
        "| function | what it is | formula, source | numbers it takes |\n| --- | --- | --- | --- |\n";
    for (const ClosedForm& form : closed_forms()) {
        std::string call, numbers;
        for (const auto& p : form.parameters) {
            call += fmt::format("{}{}", call.empty() ? "" : ", ", p.name);
            numbers += fmt::format("{}`{}`: {}{}{}{}", numbers.empty() ? "" : "; ", p.name, p.text,
                                   *p.unit ? fmt::format(" [{}]", p.unit) : "", *p.allowed ? ", " : "", p.allowed);
        }
        out +=
            fmt::format("| `{}({})` | {} | {} | {} |\n", form.name, call, form.text, cell(form.source), cell(numbers));
    }
    return out;
}

std::string page(const std::string& title, const std::string& body) {
    return fmt::format(
        "# {}\n\n<!-- made by `carom schema --reference docs/reference` from the field descriptions -->\n\n{}", title,
        body);
}

}  // namespace

std::map<std::string, std::string> reference_pages() {
    return {{"scene.md", page("Scenes", top_table() + table<Settings>("`world`") + table<Plan>("`run`") +
                                            table<Expectation>("`expects`") + table<Twin>("`twins`") +
                                            table<Picture>("`pictures`"))},
            {"expressions.md", page("Expressions", expression_table())},
            {"closed-forms.md", page("Closed forms", closed_form_table())},
            {"bodies.md", page("Bodies", table<Body>("`bodies`"))},
            {"shapes.md", page("Shapes", table<Shape>("`shapes`") + methods<Geometry>("`\"type\": \"{}\"`") +
                                             table<Filter>("`filter`"))},
            {"walls.md", page("Walls", tables(wall_types) + table<Side>("Side"))},
            {"joints.md", page("Joints", table<Joint>("`joints`") + methods<JointType>("`\"type\": \"{}\"`") +
                                             table<JointSpring>("`spring`") + table<JointMotor>("`motor`") +
                                             table<JointLimits>("`limits`"))},
            {"forces.md", page("Forces", tables(force_types))},
            {"builders.md", page("Builders", tables(builder_types))},
            {"integrators.md", page("Integrators", methods<Integrator>())},
            {"solvers.md", page("Contact solvers", methods<Solver>())}};
}

}  // namespace carom
