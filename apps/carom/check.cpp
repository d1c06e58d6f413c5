// carom check: how far can a scene's numbers be trusted?

#include <fmt/format.h>

#include <algorithm>
#include <carom/convergence.hpp>
#include <carom/output.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "commands.hpp"
#include "products.hpp"
#include "report.hpp"

namespace carom::app {

namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::string scene;
    Overrides overrides;
    std::vector<std::string> quantities;
    double tolerance = 1e-3;
    std::string out, format = "png";
    bool json = false;
};

constexpr std::size_t most_bodies = 8;

/// What is followed if nothing else is asked for: bodies, energies, and what the scene expects.
std::vector<std::string> usual_quantities(const Scene& scene, const World& world) {
    std::vector<std::string> out;
    std::set<std::string> known;
    const auto add = [&](const std::string& name) {
        if (known.insert(name).second) out.push_back(name);
    };
    std::size_t bodies = 0;
    for (const BodyId id : world.ids()) {
        const Body body = world.body(id);
        if (body.kind != Kind::dynamic || body.name.empty() || ++bodies > most_bodies) continue;
        const std::string name = in_expression(body.name);
        add(name + ".x");
        add(name + ".y");
        if (body.angular_velocity != 0) add(name + ".angle");
    }
    add("energy.kinetic");
    add("energy.total");
    for (const Expectation& e : scene.expectations())
        if (!Quantity(e.quantity, world, scene.parameters(), true).needs_measures()) add(e.quantity);
    return out;
}

/// Whether an expression is an angle as atan2 gives it, which jumps by a turn.
bool is_angle(const std::string& expression) {
    if (!expression.starts_with("atan2(") || !expression.ends_with(")")) return false;
    int open = 0;
    for (std::size_t i = 5; i + 1 < expression.size(); ++i) {
        open += expression[i] == '(' ? 1 : expression[i] == ')' ? -1 : 0;
        if (open == 0) return false;
    }
    return true;
}

bool is_account(const std::string& name) { return name.starts_with("energy.heat") || name.starts_with("energy.work"); }

/// What must be zero is judged by how near to it the scene wants it, since its range is nothing but error.
double size_of(const Scene& scene, const std::string& quantity, double tolerance) {
    double size = 0;
    for (const Expectation& e : scene.expectations())
        if (e.quantity == quantity && e.value == 0 && !e.relative) size = std::max(size, e.tolerance / tolerance);
    return size;
}

std::vector<Probe> probes_of(const Scene& scene, const World& world, const std::vector<std::string>& names,
                             double tolerance) {
    std::vector<Probe> out;
    for (const std::string& name : names) {
        auto quantity = std::make_shared<Quantity>(name, world, scene.parameters());
        out.push_back({name, [quantity](const World& now) { return (*quantity)(now); },
                       is_angle(name) ? 2 * 3.14159265358979323846 : 0, size_of(scene, name, tolerance),
                       name == "energy.total", is_account(name)});
    }
    return out;
}

const char* words(const Followed& f) {
    if (f.apart) return "from the reference, where the runs are not";
    switch (f.by) {
        case ErrorBy::rounding:
            return "exact to rounding";
        case ErrorBy::reference:
            return "from the reference";
        case ErrorBy::order:
            return "by the order";
        case ErrorBy::difference:
            return "from the finest run";
    }
    return "";
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.2g}", value) : "all of it"; }

/// An expression, cut to its column.
std::string shortened(const std::string& name) {
    constexpr std::size_t width = 34;
    return name.size() <= width ? name : name.substr(0, width - 3) + "...";
}

void print_row(const Followed& f, bool state, double duration) {
    std::string order = f.order ? fmt::format("{:.2f}", *f.order) : "-";
    std::string by = words(f);
    if (f.order && f.order_until < duration * (1 - 1e-9)) by += fmt::format(", order until {:.3g} s", f.order_until);
    if (!f.left_out.empty()) by += f.size == 0 && f.by != ErrorBy::rounding ? ", all error" : ", not judged";
    fmt::print("  {:<34} {:>15} {:>9} {:>9} {:>6}  {}\n", shortened(with_unit(f.name, unit_of(f.name))),
               state ? "" : fmt::format("{:.9g}", f.value), state ? "" : number(f.error),
               f.size > 0 ? number(f.relative()) : "-", order, by);
}

void print_drifts(const Convergence& c) {
    const auto line = [&](const char* name, const char* unit, auto value) {
        fmt::print("  {:<34}", name);
        for (const StudyRun& run : c.runs) fmt::print(" {:>12.3g}", value(run));
        fmt::print("  {}\n", unit);
    };
    fmt::print("\n  {:<34} {:>12} {:>12} {:>12}\n", "made or lost by the method", c.own_step ? "tolerance" : "dt",
               c.own_step ? "tolerance/10" : "dt/2", c.own_step ? "…/100" : "dt/4");
    line("energy", "J", [](const StudyRun& r) { return r.energy_drift; });
    line("momentum", "kg m/s", [](const StudyRun& r) { return r.momentum_drift; });
    if (c.runs[0].angular_drift)
        line("angular momentum", "kg m²/s", [](const StudyRun& r) { return *r.angular_drift; });
    if (c.first_impact) line("impacts", "", [](const StudyRun& r) { return static_cast<double>(r.collisions); });
}

/// Who takes a method of higher order is told where it brings nothing.
void print_solver(const World& world, const Convergence& c) {
    const Integrator& method = world.settings().integrator;
    const bool as_good = std::holds_alternative<Verlet>(method) || std::holds_alternative<SymplecticEuler>(method) ||
                         std::holds_alternative<Euler>(method);
    if (c.solved_in_steps)
        fmt::print(
            "joints and contacts are solved in parts of dt, to second order at most under any method: with dt the "
            "tolerance is "
            "refined,\n{:.3g}, {:.3g} and {:.3g}\n",
            c.runs[0].tolerance, c.runs[1].tolerance, c.runs[2].tolerance);
    else if (c.bound_by_step)
        fmt::print(
            "the method's own steps are bound by dt, and a finer tolerance alone changes too little: with dt it is "
            "refined,\n{:.3g}, {:.3g} and {:.3g}\n",
            c.runs[0].tolerance, c.runs[1].tolerance, c.runs[2].tolerance);
    else if (!as_good && !world.joints().empty())
        fmt::print("joints are solved in parts of dt, to second order at most under any method\n");
}

void print_study(const Scene& scene, const World& world, const Convergence& c) {
    if (!scene.title().empty()) fmt::print("{}\n", scene.title());
    const std::string method =
        std::visit([](const auto& m) { return std::string(m.name); }, world.settings().integrator);
    const auto value = [&](const StudyRun& r) { return c.own_step ? r.tolerance : r.step; };
    fmt::print("{}, {} = {:.6g}, {:.6g} and {:.6g}{} over {:.6g} s\n", method, c.own_step ? "tolerance" : "dt",
               value(c.runs[0]), value(c.runs[1]), value(c.runs[2]), c.own_step ? "" : " s", c.duration);
    if (c.parts > 1)
        fmt::print("the step of {:.6g} s is cut into {} for the springs' stability\n", scene.plan().step, c.parts);
    if (!c.reference.empty()) fmt::print("reference: {}\n", c.reference);
    print_solver(world, c);
    fmt::print("\n");
    fmt::print("  {:<34} {:>15} {:>9} {:>9} {:>6}\n", "quantity", "at the end", "error", "relative", "order");
    print_row(c.state, true, c.duration);
    for (const Followed& f : c.quantities) print_row(f, false, c.duration);
    print_drifts(c);
    if (c.first_impact)
        fmt::print("\nImpacts from t = {:.3g} s on: an order is printed only where the runs have one.\n",
                   *c.first_impact);
    for (const StudyRun& run : c.runs)
        if (!run.failure.empty()) fmt::print("\nAt dt = {:.6g} s: {}\n", run.step, run.failure);
    fmt::print("\n{}\n", c.sentence());
}

Json json_of(const Followed& f) {
    return {{"quantity", f.name},
            {"value", f.value},
            {"error", f.error},
            {"end_error", f.end_error},
            {"size", f.size},
            {"relative", f.relative()},
            {"order", f.order ? Json(*f.order) : Json()},
            {"order_until", f.order ? Json(f.order_until) : Json()},
            {"by", words(f)},
            {"left_out", f.left_out.empty() ? Json() : Json(f.left_out)}};
}

Json json_of(const Scene& scene, const Convergence& c) {
    static const char* const names[] = {"trust", "refine", "chaotic", "unjudged"};
    Json quantities = Json::array(), runs = Json::array();
    for (const Followed& f : c.quantities) quantities.push_back(json_of(f));
    for (const StudyRun& r : c.runs)
        runs.push_back({{"step", r.step},
                        {"tolerance", r.tolerance > 0 ? Json(r.tolerance) : Json()},
                        {"energy_drift", r.energy_drift},
                        {"momentum_drift", r.momentum_drift},
                        {"angular_momentum_drift", r.angular_drift ? Json(*r.angular_drift) : Json()},
                        {"collisions", r.collisions},
                        {"failure", r.failure.empty() ? Json() : Json(r.failure)}});
    return {{"scene", scene.file()},
            {"verdict", names[static_cast<int>(c.trust)]},
            {"sentence", c.sentence()},
            {"tolerance", c.tolerance},
            {"good_until", c.good_until},
            {"made_or_lost", c.made_or_lost},
            {c.own_step ? "refined_tolerance" : "refined_step", c.refined ? Json(*c.refined) : Json()},
            {"lyapunov_exponent", c.growth ? Json(c.growth->rate) : Json()},
            {"horizon", c.growth ? Json(c.horizon) : Json()},
            {"first_impact", c.first_impact ? Json(*c.first_impact) : Json()},
            {"state", json_of(c.state)},
            {"quantities", quantities},
            {"runs", runs}};
}

/// The error of the state against time, at the three steps.
void draw(const Scene& scene, const Convergence& c, const std::filesystem::path& file) {
    Panel panel{.x_label = "t [s]", .y_label = "error of the state, relative", .log_y = true};
    for (std::size_t k = 0; k < 3; ++k) {
        const StudyRun& run = c.runs[k];
        if (run.error.empty()) continue;
        Curve curve{.label = c.own_step ? fmt::format("tolerance = {:.3g}", run.tolerance)
                                        : fmt::format("dt = {:.4g} s", run.step),
                    .x = c.time,
                    .y = run.error,
                    .colour = palette(k)};
        panel.curves.push_back(curve);
    }
    panel.curves.push_back({.label = "tolerance",
                            .x = {0, c.duration},
                            .y = {c.tolerance, c.tolerance},
                            .stroke = Stroke::dashed,
                            .colour = palette(6)});
    save({.title = scene.title(), .panels = {panel}}, file);
}

int check_scene(const Arguments& a) {
    const Scene scene = load(a.scene, a.overrides);
    const World world = scene.world();
    const auto names = a.quantities.empty() ? usual_quantities(scene, world) : a.quantities;
    if (!a.out.empty()) make_folder(a.out);  // what cannot be made is told before a long study
    constexpr std::uint64_t parts = 1000;
    Progress progress(parts, std::filesystem::path(scene.file()).stem().string());
    const Convergence c = study(world, probes_of(scene, world, names, a.tolerance),
                                {.duration = scene.plan().duration,
                                 .step = scene.plan().step,
                                 .tolerance = a.tolerance,
                                 .judge_state = a.quantities.empty(),
                                 .progress = [&](double done) {
                                     progress.update(static_cast<std::uint64_t>(done * double(parts)));
                                     if (was_interrupted()) throw Error("interrupted", Error::Cause::run);
                                 }});
    progress.finish();
    if (a.json)
        fmt::print("{}\n", json_of(scene, c).dump(2, ' ', false, Json::error_handler_t::replace));
    else
        print_study(scene, world, c);
    if (!a.out.empty()) {
        const auto file = std::filesystem::path(a.out) / ("convergence." + a.format);
        draw(scene, c, file);
        if (!a.json) fmt::print("wrote {}\n", file.string());
    }
    return c.trust == Trust::trust ? 0 : 1;
}

}  // namespace

void add_check(CLI::App& program, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command =
        program.add_subcommand("check", "Say how far a scene's numbers can be trusted, and with which step");
    add_scene(*command, a->scene, a->overrides);
    command
        ->add_option("--quantity", a->quantities,
                     "judge this expression, such as ball.x, instead of all bodies, energies and expectations")
        ->type_name("EXPR")
        ->allow_extra_args(false);
    command
        ->add_option("--tolerance", a->tolerance,
                     "error allowed, relative to each quantity's range, of the total energy to the energies at play")
        ->type_name("NUMBER")
        ->check(in_range(positive))
        ->capture_default_str();
    CLI::Option* const out =
        command->add_option("--out", a->out, "draw the error against time into this folder")->type_name("FOLDER");
    add_format(*command, a->format)->needs(out);
    command->add_flag("--json", a->json, "print one JSON object and nothing else");
    command->footer(
        "examples:\n"
        "  carom check scenes/kepler.json --step 0.02 --tolerance 1e-4 --out out\n"
        "  carom check scenes/spring-pendulum.json --integrator rk4\n"
        "  carom check scenes/gas.json --quantity energy.kinetic\n"
        "exit status: 0 trust it, 1 refine it, chaotic or not judged, 2 wrong input");
    command->callback([a, &status] { status = check_scene(*a); });
}

}  // namespace carom::app
