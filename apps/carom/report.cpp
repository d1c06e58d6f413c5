#include "report.hpp"

#include <fmt/format.h>

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
            {"heat", {{"damping", e.heat.damping}, {"drag", e.heat.drag}, {"impact", e.heat.impact}, {"friction", e.heat.friction}}},
            {"work", {{"driven", e.work.driven}, {"wind", e.work.wind}, {"user", e.work.user}, {"overlap", e.work.overlap}}},
            {"residual", e.residual()}};
}

std::string words(const Expectation& e) {
    std::string out = e.quantity;
    for (const auto& choice : choices(&e.statistic))
        if (choice.value == e.statistic && e.statistic != Statistic::end) out = fmt::format("{} of {}", choice.name, out);
    if (e.statistic == Statistic::zero && e.number > 1) out = fmt::format("{} no. {}", out, e.number);
    if (e.at) out += fmt::format(" at t = {} s", *e.at);
    return out;
}

}  // namespace

std::string report_json(const std::string& name, const Scene& source, const Result& r) {
    const Vec2 p = momentum(r.world);
    Json verdicts = Json::array();
    for (const Verdict& v : r.verdicts)
        verdicts.push_back({{"quantity", words(v.expectation)},
                            {"value", v.value},
                            {"expected", v.expectation.value},
                            {"tolerance", v.expectation.tolerance},
                            {"relative", v.expectation.relative},
                            {"ok", v.ok},
                            {"source", v.expectation.source}});
    const Json out{{"scene", name},
                   {"version", CAROM_VERSION},
                   {"seed", source.seed()},
                   {"time", r.world.time()},
                   {"steps", r.world.steps()},
                   {"bodies", r.world.size()},
                   {"collisions", r.world.collisions()},
                   {"energy", to_json(energy(r.world))},
                   {"momentum", {p.x, p.y}},
                   {"angular_momentum", angular_momentum(r.world)},
                   {"state_hash", fmt::format("{:016x}", state_hash(r.world))},
                   {"expectations", verdicts},
                   {"interrupted", r.interrupted},
                   {"wall_seconds", r.wall_seconds}};
    return out.dump(2);
}

void print_report(const Scene& source, const Result& r) {
    const Energy e = energy(r.world);
    const auto line = [](const char* name, double value, const char* unit) {
        if (value != 0) fmt::print("  {:<22}{:>16.9g} {}\n", name, value, unit);
    };
    if (!source.title().empty()) fmt::print("{}\n", source.title());
    fmt::print("{} {}, {} steps to t = {:.6g} s in {:.2f} s, {} collisions, seed {}{}\n", r.world.size(), r.world.size() == 1 ? "body" : "bodies", r.world.steps(),
               r.world.time(), r.wall_seconds, r.world.collisions(), source.seed(), r.interrupted ? ", interrupted" : "");
    fmt::print("energy\n");
    line("kinetic", e.kinetic, "J");
    line("rotational", e.rotational, "J");
    line("gravity", e.gravity, "J");
    line("spring", e.spring, "J");
    line("field", e.field, "J");
    fmt::print("  {:<22}{:>16.9g} J (at the start {:.9g})\n", "total", e.total(), e.initial_total);
    line("heat of damping", e.heat.damping, "J");
    line("heat of drag", e.heat.drag, "J");
    line("heat of impacts", e.heat.impact, "J");
    line("heat of friction", e.heat.friction, "J");
    line("work of driven bodies", e.work.driven, "J");
    line("work of wind", e.work.wind, "J");
    line("work of user forces", e.work.user, "J");
    line("work against overlap", e.work.overlap, "J");
    fmt::print("  {:<22}{:>16.3g} J\n", "numerical residual", e.residual());
    fmt::print("state hash {:016x}\n", state_hash(r.world));
    if (!r.verdicts.empty()) fmt::print("expected\n");
    for (const Verdict& v : r.verdicts) {
        const Expectation& x = v.expectation;
        fmt::print("  {} {:<34}{:>18.12g}  expected {:.12g} ± {:.3g}{}, off by {:.2g}{}\n", v.ok ? "ok  " : "FAIL", x.text.empty() ? words(x) : x.text, v.value,
                   x.value, x.tolerance, x.relative ? " (relative)" : "", v.value - x.value,
                   x.source.empty() ? "" : "   [" + x.source + "]");
    }
}

}  // namespace carom::app
