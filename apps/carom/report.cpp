#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace carom::app {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Energy& e) {
    return {{"kinetic", e.kinetic},
            {"rotational", e.rotational},
            {"gravity", e.gravity},
            {"spring", e.spring},
            {"field", e.field},
            {"total", e.total()},
            {"initial_total", e.initial_total},
            {"heat",
             {{"damping", e.heat.damping},
              {"drag", e.heat.drag},
              {"impact", e.heat.impact},
              {"friction", e.heat.friction},
              {"joint_damping", e.heat.joint_damping},
              {"joint_friction", e.heat.joint_friction},
              {"limit", e.heat.limit},
              {"bath", e.heat.bath},
              {"total", e.heat.total()}}},
            {"work",
             {{"driven", e.work.driven},
              {"wind", e.work.wind},
              {"user", e.work.user},
              {"motor", e.work.motor},
              {"overlap", e.work.overlap},
              {"correction", e.work.correction},
              {"total", e.work.total()}}},
            {"residual", e.residual},
            {"unaccounted", e.unaccounted()}};
}

Json to_json(const MomentumBalance& m) {
    const auto one = [](const Momentum& p) { return Json{p.linear.x, p.linear.y, p.angular}; };
    return {{"initial", one(m.initial)}, {"gravity", one(m.gravity)},   {"walls", one(m.walls)},
            {"held", one(m.held)},       {"medium", one(m.medium)},     {"field", one(m.field)},
            {"user", one(m.user)},       {"residual", one(m.residual)}, {"unaccounted", one(m.unaccounted())}};
}

/// What stands behind numbers: their unit, and where they are from.
std::string remark(const std::string& unit, const std::string& source) {
    if (source.empty()) return unit.empty() ? "" : "  " + unit;
    return fmt::format("  {:<7} {}", unit, source);
}

double allowed(const Expectation& e) { return e.relative ? e.tolerance * std::abs(e.value) : e.tolerance; }

Json report(const Scene& scene, const Result& r) {
    const Vec2 p = momentum(r.world);
    Json verdicts = Json::array();
    for (const Verdict& v : r.verdicts)
        verdicts.push_back({{"text", v.expectation.text},
                            {"quantity", in_words(v.expectation)},
                            {"judged", v.judged},
                            {"value", v.value},
                            {"expected", v.expectation.value},
                            {"error", v.value - v.expectation.value},
                            {"allowed", allowed(v.expectation)},
                            {"tolerance", v.expectation.tolerance},
                            {"relative", v.expectation.relative},
                            {"ok", v.ok},
                            {"source", v.expectation.source}});
    Json twins = Json::array();
    for (const TwinError& t : r.twins)
        twins.push_back({{"quantity", t.twin.quantity},
                         {"formula", t.twin.formula},
                         {"max_error", t.largest},
                         {"end_error", t.end}});
    Json measures = Json::array();
    for (const GasNumber& n : r.measures) {
        measures.push_back(
            {{"quantity", n.quantity}, {"name", n.name}, {"value", n.value}, {"error", n.error}, {"unit", n.unit}});
        if (n.to > 0) measures.back()["over"] = {n.from, n.to};
    }
    Json left_out = Json::array();
    for (const GasAbsence& a : r.left_out)
        left_out.push_back({{"quantity", a.quantity}, {"name", a.name}, {"why", a.why}});
    Json notes = Json::array();
    for (const Note& note : r.notes) notes.push_back(note.text);
    return {{"scene", scene.file()},
            {"version", CAROM_VERSION},
            {"seed", scene.seed()},
            {"time", r.world.time()},
            {"steps", r.world.steps()},
            {"bodies", r.world.size()},
            {"collisions", r.world.collisions()},
            {"energy", to_json(energy(r.world))},
            {"momentum", {p.x, p.y}},
            {"angular_momentum", angular_momentum(r.world)},
            {"momentum_from", to_json(momentum_balance(r.world))},
            {"state_hash", fmt::format("{:016x}", state_hash(r.world))},
            {"expectations", verdicts},
            {"twins", twins},
            {"measures", measures},
            {"left_out", left_out},
            {"moved_apart", r.world.gas().moved_apart},
            {"notes", notes},
            {"interrupted", r.interrupted},
            {"failure", r.failure.empty() ? Json() : Json(r.failure)},
            {"wall_seconds", r.wall_seconds}};
}

// A file may be called anything.
std::string words(const Json& report) { return report.dump(2, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string report_json(const Scene& scene, const Result& r) { return words(report(scene, r)); }

std::string summary_json(const Scene& scene, const Result& r) {
    Json summary = report(scene, r);
    for (const char* passing : {"scene", "version", "seed", "wall_seconds"}) summary.erase(passing);
    return words(summary);
}

namespace {

/// The unit of a quantity that is a single name.
std::string unit_of_name(const std::string& quantity) {
    // A name in quotes may have anything in it; what follows it says what it is.
    std::size_t name_end = quantity.starts_with('\'') ? quantity.find('\'', 1) : 0;
    while (name_end != 0 && name_end != std::string::npos && quantity.compare(name_end, 2, "\'\'") == 0)
        name_end = quantity.find('\'', name_end + 2);  // two are one of the name
    if (name_end == std::string::npos || quantity.find_first_of(" +-*/^(", name_end) != std::string::npos) return "";
    if (quantity.starts_with("energy.")) return "J";
    if (quantity.starts_with("momentum.")) return "kg m/s";
    if (quantity == "angular_momentum") return "kg m²/s";
    for (const GasMeasure& m : gas_measures)
        if (quantity == m.quantity || quantity == std::string(m.quantity) + ".error") return std::string(m.unit);
    for (const char* force : {".force", ".force.x", ".force.y"})
        if (quantity.ends_with(force)) return "N";
    const std::string coordinate = quantity.substr(quantity.rfind('.') + 1);
    if (coordinate == quantity) return quantity == "t" ? "s" : "";
    if (coordinate == "x" || coordinate == "y" || coordinate == "gap") return "m";
    if (coordinate == "torque") return "N m";
    if (coordinate == "vx" || coordinate == "vy" || coordinate == "speed") return "m/s";
    return coordinate == "angle" ? "rad" : coordinate == "omega" ? "rad/s" : "";
}

/// What is added in a sum or taken away, in turn: its parts between signs that are in no brackets and no quotes.
std::vector<std::string> terms_of(const std::string& quantity) {
    std::vector<std::string> terms(1);
    int depth = 0;
    bool quoted = false;
    for (const char c : quantity) {
        if (c == '\'') quoted = !quoted;  // two in a name are one, and change nothing
        if (!quoted && c == '(') ++depth;
        if (!quoted && c == ')') --depth;
        if (!quoted && depth == 0 && (c == '+' || c == '-'))
            terms.emplace_back();
        else if (c != ' ' || quoted)
            terms.back() += c;
    }
    if (terms.size() > 1 && terms.front().empty()) terms.erase(terms.begin());  // a sign before the first
    return terms;
}

}  // namespace

std::string unit_of(const std::string& quantity) {
    const std::vector<std::string> terms = terms_of(quantity);
    const std::string unit = unit_of_name(terms.front());
    const auto like = [&](const std::string& term) { return unit_of_name(term) == unit; };
    return std::all_of(terms.begin(), terms.end(), like) ? unit : "";
}

std::string with_unit(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : fmt::format("{}{}[{}]", name, name.empty() ? "" : " ", unit);
}

std::string in_words(const Expectation& e) {
    std::string out = e.quantity;
    for (const auto& choice : choices(&e.statistic))
        if (choice.value == e.statistic && e.statistic != Statistic::end)
            out = fmt::format("{} of {}", choice.name, out);
    if (e.statistic == Statistic::zero && e.number > 1) out = fmt::format("{} no. {}", out, e.number);
    if (e.at) out += fmt::format(" at t = {} s", *e.at);
    return out;
}

namespace {

/// The first column of a table; numbers stand below a text that is longer, or they would not stand below each other.
std::string in_column(const std::string& text) {
    constexpr std::ptrdiff_t before = 7, width = 40;
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return letters <= width ? fmt::format("{:<{}}", text, width) : fmt::format("{}\n{:{}}", text, "", before + width);
}

}  // namespace

void print_verdict_heading() {
    fmt::print("  {:<4} {} {:>18} {:>18} {:>9} {:>9}\n", "", in_column("expectation"), "came out", "expected", "off by",
               "allowed");
}

std::string value_in_words(const Verdict& v, int digits) {
    if (!v.judged) return "not reached";
    if (std::isnan(v.value)) return v.expectation.statistic == Statistic::zero ? "never" : "no number";
    return fmt::format("{:.{}g}", v.value, digits);
}

void print_verdict(const Verdict& v) {
    const Expectation& x = v.expectation;
    const std::string what = x.text.empty() ? in_words(x) : x.text;
    const std::string value = value_in_words(v, 12);
    const std::string error = std::isnan(v.value) ? "" : fmt::format("{:.2g}", std::abs(v.value - x.value));
    const std::string unit = x.statistic == Statistic::zero ? "s" : unit_of(x.quantity);
    fmt::print("  {:<4} {} {:>18} {:>18.12g} {:>9} {:>9.2g}{}\n",
               v.ok       ? "ok"
               : v.judged ? "FAIL"
                          : "",
               in_column(what), value, x.value, error, allowed(x), remark(unit, x.source));
}

int digits_of(double value, double error, int otherwise) {
    if (!(error > 0) || !std::isfinite(error) || !std::isfinite(value)) return otherwise;
    constexpr double most = 12;  // that a person reads; files have all
    const auto decade = [](double x) { return std::floor(std::log10(std::abs(x))); };
    return static_cast<int>(std::clamp(decade(value) - decade(error) + 2, 1.0, most));
}

std::string with_error(double value, double error) {
    return fmt::format("{:.{}g} ± {:.2g}", value, digits_of(value, error, 9), error);
}

void print_measures(const std::vector<GasNumber>& measures) {
    for (const GasNumber& n : measures) {
        fmt::print("  {:<24}{:>18.{}g} {}", n.name, n.value, digits_of(n.value, n.error, 6), n.unit);
        fmt::print("{}", std::isnan(n.error) ? ", too few for an error" : fmt::format(" ± {:.2g}", n.error));
        fmt::print("{}\n", n.to > 0 ? fmt::format(", over {:.3g} to {:.3g} s", n.from, n.to) : "");
    }
}

namespace {

void print_energies(const Energy& e) {
    const auto line = [](const char* name, double value) {
        if (value != 0) fmt::print("  {:<24}{:>18.9g} J\n", name, value);
    };
    line("kinetic energy", e.kinetic);
    line("rotational energy", e.rotational);
    line("gravity", e.gravity);
    line("springs", e.spring);
    line("fields", e.field);
    fmt::print("  {:<24}{:>18.9g} J, at the start {:.9g} J\n", "total energy", e.total(), e.initial_total);
    line("heat of damping", e.heat.damping);
    line("heat of drag", e.heat.drag);
    line("heat of impacts", e.heat.impact);
    line("heat of friction", e.heat.friction);
    line("heat of joint springs", e.heat.joint_damping);
    line("heat of joint friction", e.heat.joint_friction);
    line("heat of limits", e.heat.limit);
    line("heat to thermal walls", e.heat.bath);
    line("work of driven bodies", e.work.driven);
    line("work of wind", e.work.wind);
    line("work of user forces", e.work.user);
    line("work of motors", e.work.motor);
    line("work against overlap", e.work.overlap);
    line("work of closing joints", e.work.correction);
    fmt::print("  {:<24}{:>18.3g} J\n", "numerical residual", e.residual);
    fmt::print("  {:<24}{:>18.3g} J\n", "unaccounted", e.unaccounted());
}

}  // namespace

std::string counted(std::uint64_t number, const char* one, const char* many) {
    return fmt::format("{} {}", number, number == 1 ? one : many);
}

void print_report(const Scene& scene, const Result& r) {
    const Energy e = energy(r.world);
    if (!scene.title().empty()) fmt::print("{}\n", scene.title());
    fmt::print("{}, {} to t = {:.6g} s in {:.2f} s, {}, seed {}{}\n", counted(r.world.size(), "body", "bodies"),
               counted(r.world.steps(), "step", "steps"), r.world.time(), r.wall_seconds,
               counted(r.world.collisions(), "collision", "collisions"), scene.seed(),
               r.interrupted ? ", interrupted" : "");
    if (std::isfinite(e.unaccounted())) print_energies(e);
    fmt::print("  {:<24}{:>18}\n", "state hash", fmt::format("{:016x}", state_hash(r.world)));
    if (const double moved = r.world.gas().moved_apart; moved > 0)
        fmt::print("  {:<24}{:>18.4g} m, the farthest of the discs that overlapped at the start\n", "moved apart by",
                   moved);
    print_measures(r.measures);
    for (const GasAbsence& a : r.left_out) fmt::print("  {:<24} is left out: {}\n", a.name, a.why);
    if (!r.verdicts.empty()) print_verdict_heading();
    for (const Verdict& v : r.verdicts) print_verdict(v);
    if (!r.twins.empty())
        fmt::print("       {} {:>18} {:>18}\n", in_column("closed form of"), "largest error", "at the end");
    for (const TwinError& t : r.twins)
        fmt::print("       {} {:>18.2g} {:>18.2g}{}\n", in_column(t.twin.quantity), t.largest, t.end,
                   remark(t.twin.unit.empty() ? unit_of(t.twin.quantity) : t.twin.unit, t.twin.source));
}

}  // namespace carom::app
