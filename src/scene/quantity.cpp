#include "scene/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <carom/analysis.hpp>
#include <carom/scene.hpp>
#include <cmath>
#include <limits>

#include "scene/expression.hpp"
#include "state/nearest.hpp"

namespace carom {

namespace {

/// A world with its energy, worked out at most once, and what was measured on the way.
struct Observed {
    const World& world;
    const std::vector<GasNumber>& measures;
    mutable std::optional<Energy> known{};
    const Energy& energy() const {
        if (!known) known = carom::energy(world);
        return *known;
    }
};
using Getter = std::function<double(const Observed&)>;

struct Account {
    const char* name;
    double (*value)(const Energy&);
};
constexpr Account accounts[] = {
    {"kinetic", [](const Energy& e) { return e.kinetic; }},
    {"rotational", [](const Energy& e) { return e.rotational; }},
    {"gravity", [](const Energy& e) { return e.gravity; }},
    {"spring", [](const Energy& e) { return e.spring; }},
    {"field", [](const Energy& e) { return e.field; }},
    {"total", [](const Energy& e) { return e.total(); }},
    {"initial_total", [](const Energy& e) { return e.initial_total; }},
    {"residual", [](const Energy& e) { return e.residual; }},
    {"unaccounted", [](const Energy& e) { return e.unaccounted(); }},
    {"heat.damping", [](const Energy& e) { return e.heat.damping; }},
    {"heat.drag", [](const Energy& e) { return e.heat.drag; }},
    {"heat.impact", [](const Energy& e) { return e.heat.impact; }},
    {"heat.friction", [](const Energy& e) { return e.heat.friction; }},
    {"heat.joint_damping", [](const Energy& e) { return e.heat.joint_damping; }},
    {"heat.joint_friction", [](const Energy& e) { return e.heat.joint_friction; }},
    {"heat.limit", [](const Energy& e) { return e.heat.limit; }},
    {"heat.bath", [](const Energy& e) { return e.heat.bath; }},
    {"heat.total", [](const Energy& e) { return e.heat.total(); }},
    {"work.driven", [](const Energy& e) { return e.work.driven; }},
    {"work.wind", [](const Energy& e) { return e.work.wind; }},
    {"work.user", [](const Energy& e) { return e.work.user; }},
    {"work.motor", [](const Energy& e) { return e.work.motor; }},
    {"work.correction", [](const Energy& e) { return e.work.correction; }},
    {"work.overlap", [](const Energy& e) { return e.work.overlap; }},
    {"work.total", [](const Energy& e) { return e.work.total(); }},
};

struct Coordinate {
    const char* name;
    double (*value)(const World&, BodyId);
};
constexpr Coordinate coordinates[] = {
    {"x", [](const World& w, BodyId b) { return w.position(b).x; }},
    {"y", [](const World& w, BodyId b) { return w.position(b).y; }},
    {"vx", [](const World& w, BodyId b) { return w.velocity(b).x; }},
    {"vy", [](const World& w, BodyId b) { return w.velocity(b).y; }},
    {"angle", [](const World& w, BodyId b) { return w.angle(b); }},
    {"omega", [](const World& w, BodyId b) { return w.angular_velocity(b); }},
    {"speed", [](const World& w, BodyId b) { return length(w.velocity(b)); }},
};

/// What a joint does to its body b. One that broke bears nothing, and is nowhere.
struct OfJoint {
    const char* name;
    double (*value)(const Reaction&);
    bool is_borne = true;  ///< known from the first step on
};
constexpr OfJoint of_joints[] = {
    {"force.x", [](const Reaction& r) { return r.force.x; }},
    {"force.y", [](const Reaction& r) { return r.force.y; }},
    {"force", [](const Reaction& r) { return length(r.force); }},
    {"torque", [](const Reaction& r) { return r.torque; }},
    {"coordinate", [](const Reaction& r) { return r.coordinate; }, false},
    {"gap", [](const Reaction& r) { return r.gap; }, false},
};
constexpr Reaction broken{.coordinate = std::numeric_limits<double>::quiet_NaN(),
                          .gap = std::numeric_limits<double>::quiet_NaN()};

/// What a joint bears as the motion begins, which no step has found yet: that of copies whose second step is shorter
/// and shorter, until it stays the same. The first of them takes up velocities that the joint does not allow.
double as_it_begins(const World& start, JointId id, double (*value)(const Reaction&)) {
    constexpr double longest = 1e-2, same = 1e-6;  // s, and of the value
    constexpr int tries = 12;                      // down to 1e-12 s, where rounding is all
    const Joint joint = start.joint(id);
    const Reaction now = start.reaction(id);
    // One that gapes is closed first, and what it bears there is not of this state.
    constexpr double much = 1e-3;
    const double places = length(start.position(joint.b)) + (joint.a ? length(start.position(*joint.a)) : 0);
    if (now.gap > much * (places + length(joint.anchor_a) + length(joint.anchor_b))) return value(now);
    double best = value(now), before = std::nan(""), nearest = HUGE_VAL, h = longest;
    for (int k = 0; k < tries && !(nearest <= same * std::abs(best)); ++k, h /= 8) {
        World ahead(start);
        try {
            for (int step = 0; step < 2; ++step) ahead.step(h);
        } catch (const Error&) {
            continue;  // too long for it, or for a formula
        }
        if (!ahead.contains(id)) break;
        const double then = value(ahead.reaction(id)), off = std::abs(then - before);
        before = then;
        if (off < nearest) nearest = off, best = then;
    }
    return best;
}

struct Count {
    const char* name;
    double (*value)(const GasTally&);
};
constexpr Count counts[] = {
    {"gas.virial", [](const GasTally& g) { return g.virial; }},
    {"gas.wall_impulse", [](const GasTally& g) { return g.wall_impulse; }},
    {"gas.disc_collisions", [](const GasTally& g) { return static_cast<double>(g.disc_collisions); }},
    {"gas.wall_collisions", [](const GasTally& g) { return static_cast<double>(g.wall_collisions); }},
    {"gas.made_elastic", [](const GasTally& g) { return static_cast<double>(g.made_elastic); }},
    {"gas.moved_apart", [](const GasTally& g) { return g.moved_apart; }},
};

struct OfWorld {
    const char* name;
    double (*value)(const World&);
};
constexpr OfWorld of_worlds[] = {
    {"t", [](const World& w) { return w.time(); }},
    {"bodies", [](const World& w) { return static_cast<double>(w.size()); }},
    {"steps", [](const World& w) { return static_cast<double>(w.steps()); }},
    {"collisions", [](const World& w) { return static_cast<double>(w.collisions()); }},
    {"momentum.x", [](const World& w) { return momentum(w).x; }},
    {"momentum.y", [](const World& w) { return momentum(w).y; }},
    {"angular_momentum", [](const World& w) { return angular_momentum(w); }},
};

Getter of_world(const std::string& name) {
    for (const OfWorld& w : of_worlds)
        if (name == w.name) return [value = w.value](const Observed& o) { return value(o.world); };
    for (const Account& a : accounts)
        if (name == std::string("energy.") + a.name)
            return [value = a.value](const Observed& o) { return value(o.energy()); };
    for (const Count& c : counts)
        if (name == c.name) return [value = c.value](const Observed& o) { return value(o.world.gas()); };
    return nullptr;
}

/// A measure of the run, or its standard error.
Getter of_run(const std::string& name) {
    const bool error = name.ends_with(".error");
    const std::string quantity = error ? name.substr(0, name.rfind('.')) : name;
    const auto named = [quantity](const auto& m) { return m.quantity == quantity; };
    if (std::none_of(gas_measures.begin(), gas_measures.end(), named)) return nullptr;
    return [named, error](const Observed& o) {
        const auto found = std::find_if(o.measures.begin(), o.measures.end(), named);
        if (found == o.measures.end()) return std::numeric_limits<double>::quiet_NaN();
        return error ? found->error : found->value;
    };
}

Getter of_joint(const std::string& name, const World& world) {
    for (const OfJoint& j : of_joints) {
        const std::string ending = std::string(".") + j.name;
        if (!name.ends_with(ending)) continue;
        const JointId id = world.find_joint(name.substr(0, name.size() - ending.size()));
        return [value = j.value, is_borne = j.is_borne, id](const Observed& o) {
            if (!o.world.contains(id)) return value(broken);
            return is_borne && o.world.steps() == 0 ? as_it_begins(o.world, id, value) : value(o.world.reaction(id));
        };
    }
    return nullptr;
}

Getter of_body(const std::string& name, const World& world) {
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) return nullptr;
    for (const Coordinate& c : coordinates)
        if (name.substr(dot + 1) == c.name)
            return [value = c.value, id = world.find(name.substr(0, dot))](const Observed& o) {
                return value(o.world, id);
            };
    return nullptr;
}

/// What there is of the body or joint that a name begins with.
std::string all_known(const std::string& name, const World& world) {
    const auto dot = name.rfind('.');
    const std::string whose = name.substr(0, dot);
    const auto is_named_so = [&whose](const std::string& one) { return !one.empty() && one == whose; };
    const auto listed = [](const char* what, const auto& parts) {
        std::string words = fmt::format("; {} has", what);
        for (const auto& part : parts) words += fmt::format(" .{}", part.name);
        return words;
    };
    if (dot == std::string::npos) return "";
    for (const Joint& joint : world.joints())
        if (is_named_so(joint.name)) return listed("a joint", of_joints);
    for (const BodyId id : world.ids())
        if (is_named_so(world.body(id).name)) return listed("a body", coordinates);
    return "";
}

/// Of which body a coordinate is that has none before it; empty of any other name.
std::string whose_coordinate(const std::string& name, const World& world) {
    const auto is_it = [&name](const Coordinate& c) { return name == c.name; };
    if (world.size() == 0 || std::none_of(std::begin(coordinates), std::end(coordinates), is_it)) return "";
    for (const BodyId id : world.ids())
        if (const std::string body = world.body(id).name; !body.empty())
            return fmt::format("; of the body '{}' it is {}.{}", body, in_expression(body), name);
    return fmt::format("; it is of a body, which needs a \"name\": of one that is called ball it is ball.{}", name);
}

std::string nearest_known(const std::string& name, const World& world,
                          const std::map<std::string, double>& parameters) {
    if (is_of_world(name + ".total")) return fmt::format("; did you mean '{}.total'?", name);
    if (const std::string whose = whose_coordinate(name, world); !whose.empty()) return whose;
    std::vector<std::string> known;
    for (const OfWorld& w : of_worlds) known.emplace_back(w.name);
    for (const Account& a : accounts) known.push_back(std::string("energy.") + a.name);
    for (const Count& c : counts) known.push_back(c.name);
    for (const GasMeasure& m : gas_measures) known.emplace_back(m.quantity);
    for (const auto& [parameter, value] : parameters) known.push_back(parameter);
    const auto dot = name.rfind('.');
    for (std::size_t i = 0; i < std::min<std::size_t>(world.size(), 1000) && dot != std::string::npos; ++i)
        for (const Coordinate& c : coordinates) known.push_back(world.body(world.ids()[i]).name + "." + c.name);
    for (std::size_t i = 0; i < std::min<std::size_t>(world.joints().size(), 1000); ++i)
        for (const OfJoint& j : of_joints)
            if (!world.joints()[i].name.empty()) known.push_back(world.joints()[i].name + "." + j.name);
    const std::string near = did_you_mean(name, known);
    return near.empty() ? all_known(name, world) : near;
}

/// What helps whoever wrote a body's name that has more than letters, digits and _ in it as if it had not.
std::string about_quotes(const std::string& text, const World& world) {
    for (std::size_t i = 0; i < std::min<std::size_t>(world.size(), 1000); ++i) {
        const std::string name = world.body(world.ids()[i]).name;
        const std::size_t at = name.empty() || Expression::reads_as_name(name) ? text.npos : text.find(name + ".");
        if (at != text.npos && (at == 0 || text[at - 1] != '\''))
            return fmt::format(
                "; the body '{}' is written in quotes in an expression: {}{}", name, in_expression(name),
                text.substr(at + name.size(), text.find_first_of(" +-*/^(),", at + name.size()) - at - name.size()));
    }
    return "";
}

}  // namespace

bool is_of_world(const std::string& name) { return of_world(name) != nullptr; }

struct Quantity::Compiled {
    std::vector<Getter> getters;
    std::vector<std::string> names;
    std::vector<double> values;  // storage only
    std::optional<Expression> expression;
    bool needs_measures = false;
};

Quantity::Quantity(const std::string& text, const World& world, const std::map<std::string, double>& parameters,
                   bool at_end)
    : compiled_(std::make_unique<Compiled>()) {
    // No structured binding: clang 14 does not let lambdas capture one.
    auto& getters = compiled_->getters;
    auto& names = compiled_->names;
    auto& values = compiled_->values;
    auto& expression = compiled_->expression;
    const auto resolve = [&](const std::string& name) -> Expression::Meaning {
        if (const auto found = parameters.find(name); found != parameters.end()) return found->second;
        if (const auto known = std::find(names.begin(), names.end(), name); known != names.end())
            return static_cast<std::size_t>(known - names.begin());
        Getter getter = of_world(name);
        if (!getter && (getter = of_run(name))) {
            if (!at_end)
                throw Error(fmt::format(
                    "'{}' is measured over a run, and known at its end: 'expects' alone may name it", name));
            if (!is_measured(world))
                throw Error(
                    fmt::format("'{}' is measured of ten dynamic discs or more under the solver 'events'", name));
            compiled_->needs_measures = true;
        }
        if (!getter) getter = of_joint(name, world);
        if (!getter) getter = of_body(name, world);
        if (!getter) throw Error(fmt::format("there is no '{}'{}", name, nearest_known(name, world, parameters)));
        getters.push_back(std::move(getter));
        names.push_back(name);
        return names.size() - 1;
    };
    try {
        expression.emplace(text, resolve);
    } catch (const Error& e) {
        throw Error(fmt::format("in \"{}\": {}{}", text, e.what(), about_quotes(text, world)));
    }
    values.resize(getters.size());
}
Quantity::Quantity(Quantity&&) noexcept = default;
Quantity::~Quantity() = default;

bool Quantity::needs_measures() const { return compiled_->needs_measures; }
const std::vector<std::string>& Quantity::names() const { return compiled_->names; }

double Quantity::operator()(const World& world, const std::vector<GasNumber>& measures) const {
    const Observed observed{world, measures};
    for (std::size_t k = 0; k < compiled_->getters.size(); ++k) compiled_->values[k] = compiled_->getters[k](observed);
    return (*compiled_->expression)(compiled_->values);
}

std::function<double(double)> closed_form(const std::string& text, const std::map<std::string, double>& parameters) {
    try {
        return Function(text, {"t"}, {parameters.begin(), parameters.end()});
    } catch (const Error& e) {
        throw Error(fmt::format("in \"{}\": {}", text, e.what()));
    }
}

}  // namespace carom
