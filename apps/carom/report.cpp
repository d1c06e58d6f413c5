#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_set>

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
    for (const GasNumber& n : r.measures)
        measures.push_back(
            {{"quantity", n.quantity}, {"name", n.name}, {"value", n.value}, {"error", n.error}, {"unit", n.unit}});
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

std::string name_of(const World& world, const ShapeId& shape) {
    if (shape.body.generation == 0) {
        constexpr std::string_view sides[] = {"left", "right", "bottom", "top"};
        const std::size_t wall = shape.shape, of_rectangles = 4 * world.rectangles().size();
        if (wall < of_rectangles) return fmt::format("the {} wall", sides[wall % 4]);
        return fmt::format("half-plane {}", wall - of_rectangles);
    }
    const std::string name = world.body(shape.body).name;
    const auto ids = world.ids();
    return name.empty() ? fmt::format("body {}", std::find(ids.begin(), ids.end(), shape.body) - ids.begin())
                        : fmt::format("'{}'", name);
}

constexpr std::size_t named = 3;  // of what is in doubt

bool is_point(const World& world, const ShapeId& shape) {
    if (shape.body.generation == 0) return false;
    const Body body = world.body(shape.body);
    return body.radius == 0 && body.shapes.empty();
}

/// What is inside of one another by more than what may be meant to be pressed together.
std::vector<Overlap> deep_overlaps(const World& world) {
    constexpr double much = 0.01;  // of what is thinner
    const auto* const impulse = std::get_if<Impulse>(&world.settings().solver);
    if (!impulse && !std::holds_alternative<SoftStep>(world.settings().solver)) return {};
    std::vector<Overlap> deep = world.overlaps();
    std::erase_if(deep, [impulse](const Overlap& o) {
        return o.part < much || (impulse && !impulse->disc_collisions && !o.shapes.at_wall());
    });
    return deep;
}

/// A list of the first few overlaps.
std::string listed(const World& world, const std::vector<Overlap>& deep) {
    std::string text;
    for (std::size_t k = 0; k < std::min(named, deep.size()); ++k) {
        const auto& [a, b] = deep[k].shapes;
        const bool turned = is_point(world, a);
        text += fmt::format("{}{} is {:.3g} m inside of {}", k == 0 ? "" : ", ", name_of(world, turned ? a : b),
                            deep[k].depth, name_of(world, turned ? b : a));
    }
    return deep.size() > named ? text + fmt::format(", and {} more", deep.size() - named) : text;
}

/// What is said of bodies that are inside of one another, each empty if none are: of shapes, and of points in shapes.
std::pair<std::string, std::string> overlapping(const World& world) {
    std::vector<Overlap> deep = deep_overlaps(world), points;
    const auto* const impulse = std::get_if<Impulse>(&world.settings().solver);
    if (!impulse)  // SoftStep pushes no point out
        std::erase_if(deep, [&](const Overlap& o) {
            const bool of_point = is_point(world, o.shapes.a) || is_point(world, o.shapes.b);
            if (of_point) points.push_back(o);
            return of_point;
        });
    std::pair said{listed(world, deep), listed(world, points)};
    if (!deep.empty())
        said.first += impulse && impulse->time_of_impact
                          ? ". The solver 'impulse' knows bodies that are apart: it takes these as touching where they "
                            "are"
                          : ". They will be pushed apart, and what that takes is work against overlap";
    if (!points.empty())
        said.second +=
            ". A point is not pushed out of a shape, and stops what would bring it deeper, as if it touched the rim: a "
            "joint of type 'filter' lets the two pass one another";
    return said;
}

/// Whether a joint does not fit where its bodies are by more than hand-written numbers round.
bool gapes(const World& world, const Joint& joint, double gap) {
    constexpr double much = 1e-3, rounding = 1e-9, dust = 1e-15;  // dust: what a metre is rounded by [m]
    const Pose a = joint.a ? Pose{world.position(*joint.a), world.angle(*joint.a)} : Pose{};
    const Vec2 b = world.position(joint.b), anchor = joint.anchor_a;
    const Vec2 pivot = a.position + Vec2{std::cos(a.angle) * anchor.x - std::sin(a.angle) * anchor.y,
                                         std::sin(a.angle) * anchor.x + std::cos(a.angle) * anchor.y};
    const double reach = std::max(length(joint.anchor_b), length(b - pivot));
    return gap > much * reach && gap > dust && gap > rounding * (length(b) + length(pivot));
}

std::string name_of(const Joint& joint, std::size_t k) {
    return joint.name.empty() ? fmt::format("joint {}", k) : fmt::format("joint '{}'", joint.name);
}

/// A list of what is said of some joints, the first few of them; empty if it is of none.
template <class Say>
std::string of_joints(const World& world, Say say) {
    std::string text;
    std::size_t found = 0;
    for (std::size_t k = 0; k < world.joints().size(); ++k) {
        const std::string said = say(world.joints()[k], world.joint_ids()[k], k);
        if (said.empty() || ++found > named) continue;
        text += (found == 1 ? "" : ", ") + said;
    }
    return found > named ? text + fmt::format(", and {} more", found - named) : text;
}

/// Joints that do not fit where their bodies are; empty if all do.
std::string gaping(const World& world) {
    const std::string text = of_joints(world, [&world](const Joint& joint, JointId id, std::size_t k) {
        const double gap = world.reaction(id).gap;
        return gapes(world, joint, gap) ? fmt::format("{} gapes by {:.3g} m", name_of(joint, k), gap) : "";
    });
    if (text.empty()) return "";
    return text + ". The first step puts the bodies where it closes: is 'at' right, or the anchors and lengths?";
}

/// Joints that do not allow the velocities of their bodies by more than hand-written numbers round; empty if all do.
std::string breaking(const World& world) {
    constexpr double much = 1e-3;
    const std::string text = of_joints(world, [&world](const Joint& joint, JointId id, std::size_t k) -> std::string {
        double speed = length(world.velocity(joint.b)), spin = std::abs(world.angular_velocity(joint.b));
        double around = spin * length(joint.anchor_b);
        if (joint.a) {
            const double own = std::abs(world.angular_velocity(*joint.a));
            speed += length(world.velocity(*joint.a)), spin += own;
            // What holds b along an axis of a is seen from a where b is.
            around +=
                own * std::max(length(joint.anchor_a), length(world.position(joint.b) - world.position(*joint.a)));
        }
        const Breach breach = world.breach(id);
        const bool moves = breach.speed > much * (speed + around), turns = breach.spin > much * spin;
        if (!moves && !turns) return "";
        const std::string by = moves ? fmt::format("{:.3g} m/s", breach.speed) : "",
                          about = turns ? fmt::format("{:.3g} rad/s", breach.spin) : "";
        return fmt::format("{} by {}{}{}", name_of(joint, k), by, moves && turns ? " and " : "", about);
    });
    if (text.empty()) return "";
    return "the velocities break " + text +
           ". The first step stops that, and the energy this takes is residual: do velocity and angular_velocity fit?";
}

/// Points on which a torque acts, which has nothing to turn there; empty if there are none.
std::string unturned(const World& world) {
    std::vector<BodyId> turned;
    for (const ConstantForce& force : world.constant_forces())
        if (force.torque != 0 || force.point != Vec2{}) turned.push_back(force.body);
    for (const TorsionSpring& spring : world.torsion_springs()) turned.insert(turned.end(), {spring.a, spring.b});
    for (const BodyId id : turned) {
        const Body body = world.body(id);
        if (body.kind == Kind::dynamic && body.moment_of_inertia.value_or(body.radius) == 0)
            return name_of(world, ShapeId{.body = id}) +
                   " is a point, which no torque turns: it needs a radius, shapes or a moment_of_inertia";
    }
    return "";
}

/// A free point among lines, which do not stop it; empty if there is none.
std::string unstopped(const World& world) {
    const auto is_line = [](const Shape& s) {
        return !s.sensor && (std::holds_alternative<Segment>(s.geometry) || std::holds_alternative<Chain>(s.geometry));
    };
    const auto has_line = [&](const std::vector<Shape>& of) { return std::any_of(of.begin(), of.end(), is_line); };
    const auto shapes = world.shapes();
    if (!std::holds_alternative<SoftStep>(world.settings().solver) ||
        std::none_of(shapes.begin(), shapes.end(), has_line))
        return "";
    std::unordered_set<BodyId> held;
    for (const Spring& spring : world.springs()) held.insert({spring.a, spring.b});
    for (const Joint& joint : world.joints()) {
        if (joint.a) held.insert(*joint.a);
        held.insert(joint.b);
    }
    for (std::size_t i = 0; i < world.size(); ++i) {
        const BodyId id = world.ids()[i];
        const bool is_point = shapes[i].empty() && world.radii()[i] == 0;
        if (is_point && world.kinds()[i] == Kind::dynamic && !held.contains(id))
            return name_of(world, ShapeId{.body = id}) +
                   " is a point, which passes through segments and chains: to be stopped by them it needs a radius";
    }
    return "";
}

/// Forces that do nothing, whatever happens; empty if all may do something.
std::string idle(const World& world) {
    std::string text;
    const auto say = [&text](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
    const auto is_on_fixed = [&](const char* what, std::optional<BodyId> body) {
        const bool fixed = body && world.body(*body).kind == Kind::fixed;
        if (fixed) say(fmt::format("{} on {} does nothing, for it is fixed", what, name_of(world, {.body = *body})));
        return fixed;
    };
    for (const Drag& d : world.drags())
        if (!is_on_fixed("a drag", d.body) && d.linear == 0 && d.quadratic == 0 && d.angular == 0)
            say("a drag does nothing without a coefficient: linear, quadratic or angular");
    for (const ConstantForce& f : world.constant_forces())
        if (!is_on_fixed("a constant force", f.body) && f.force == Vec2{} && f.torque == 0)
            say("a constant force does nothing without a force or a torque");
    for (const ForceField& f : world.fields()) is_on_fixed("a field", f.body);
    const auto ids = world.ids();
    const auto charged = std::count_if(ids.begin(), ids.end(), [&](BodyId id) { return world.body(id).charge != 0; });
    for (const Attraction& a : world.attractions())
        if (a.couples == Couples::charge && charged < 2)
            say("an attraction between charges does nothing without two bodies that have a charge");
    return text;
}

}  // namespace

std::vector<Note> notes_at_start(const Scene& scene, const World& start) {
    const World world = start;  // the shapes that it lays out stay with a world
    const auto [shapes, points] = overlapping(world);
    std::vector<Note> all{{"overlap", shapes}, {"point", points}, {"gap", gaping(world)}, {"breach", breaking(world)}};
    std::erase_if(all, [](const Note& note) { return note.text.empty(); });
    for (Note& note : all) note.text = "at the start " + note.text;
    if (scene.plan().measure_from > 0 && !is_measured(world))
        all.push_back({"measure_from",
                       "run.measure_from is of the measures of a gas, which there are of ten dynamic discs or more "
                       "under the solver 'events': here it changes nothing"});
    if (const std::string points_alone = unturned(world); !points_alone.empty())
        all.push_back({"unturned", points_alone});
    if (const std::string points_alone = unstopped(world); !points_alone.empty())
        all.push_back({"unstopped", points_alone});
    if (const std::string forces = idle(world); !forces.empty()) all.push_back({"idle", forces});
    if (const std::string curves = scene.put_off_curves(world); !curves.empty())
        all.push_back({"curve", curves + ". A curve says where the body is from the start on: leave the place away, or "
                                         "let the curve begin there"});
    return all;
}

std::string unit_of(const std::string& quantity) {
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

void print_verdict_heading() {
    fmt::print("  {:<4} {:<40} {:>18} {:>18} {:>9} {:>9}\n", "", "expectation", "came out", "expected", "off by",
               "allowed");
}

std::string value_in_words(const Verdict& v, int digits) {
    if (!v.judged) return "not reached";
    return std::isnan(v.value) ? "never" : fmt::format("{:.{}g}", v.value, digits);
}

void print_verdict(const Verdict& v) {
    const Expectation& x = v.expectation;
    const std::string what = x.text.empty() ? in_words(x) : x.text;
    const std::string value = value_in_words(v, 12);
    const std::string error = std::isnan(v.value) ? "" : fmt::format("{:.2g}", std::abs(v.value - x.value));
    const std::string unit = x.statistic == Statistic::zero ? "s" : unit_of(x.quantity);
    fmt::print("  {:<4} {:<40} {:>18} {:>18.12g} {:>9} {:>9.2g}{}\n",
               v.ok       ? "ok"
               : v.judged ? "FAIL"
                          : "",
               what, value, x.value, error, allowed(x), remark(unit, x.source));
}

/// A value to the digits that its error leaves it.
void print_measures(const std::vector<GasNumber>& measures) {
    for (const GasNumber& n : measures) {
        const double digits = n.error > 0 ? std::ceil(std::log10(std::abs(n.value) / n.error)) + 1 : 6;
        fmt::print("  {:<24}{:>18.{}g} {}", n.name, n.value, static_cast<int>(std::clamp(digits, 1.0, 12.0)), n.unit);
        fmt::print("{}\n", std::isnan(n.error) ? ", too few for an error" : fmt::format(" ± {:.2g}", n.error));
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
    if (std::isfinite(e.total())) print_energies(e);
    fmt::print("  {:<24}{:>18}\n", "state hash", fmt::format("{:016x}", state_hash(r.world)));
    if (const double moved = r.world.gas().moved_apart; moved > 0)
        fmt::print("  {:<24}{:>18.4g} m, the farthest of the discs that overlapped at the start\n", "moved apart by",
                   moved);
    print_measures(r.measures);
    for (const GasAbsence& a : r.left_out) fmt::print("  {:<24} is left out: {}\n", a.name, a.why);
    if (!r.verdicts.empty()) print_verdict_heading();
    for (const Verdict& v : r.verdicts) print_verdict(v);
    if (!r.twins.empty()) fmt::print("       {:<40} {:>18} {:>18}\n", "closed form of", "largest error", "at the end");
    for (const TwinError& t : r.twins)
        fmt::print("       {:<40} {:>18.2g} {:>18.2g}{}\n", t.twin.quantity, t.largest, t.end,
                   remark(t.twin.unit.empty() ? unit_of(t.twin.quantity) : t.twin.unit, t.twin.source));
}

}  // namespace carom::app
