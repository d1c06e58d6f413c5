#include <carom/analysis.hpp>
#include <carom/scene.hpp>
#include <deque>

#include <fmt/format.h>

#include "scene/expression.hpp"
#include "state/nearest.hpp"

namespace carom {

namespace {

/// A world with its energy, worked out at most once.
struct Observed {
    const World& world;
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
    {"residual", [](const Energy& e) { return e.residual(); }},
    {"heat.damping", [](const Energy& e) { return e.heat.damping; }},
    {"heat.drag", [](const Energy& e) { return e.heat.drag; }},
    {"heat.impact", [](const Energy& e) { return e.heat.impact; }},
    {"heat.friction", [](const Energy& e) { return e.heat.friction; }},
    {"heat.total", [](const Energy& e) { return e.heat.total(); }},
    {"work.driven", [](const Energy& e) { return e.work.driven; }},
    {"work.wind", [](const Energy& e) { return e.work.wind; }},
    {"work.user", [](const Energy& e) { return e.work.user; }},
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

Getter of_world(const std::string& name) {
    if (name == "t") return [](const Observed& o) { return o.world.time(); };
    if (name == "bodies") return [](const Observed& o) { return static_cast<double>(o.world.size()); };
    if (name == "steps") return [](const Observed& o) { return static_cast<double>(o.world.steps()); };
    if (name == "collisions") return [](const Observed& o) { return static_cast<double>(o.world.collisions()); };
    if (name == "momentum.x") return [](const Observed& o) { return momentum(o.world).x; };
    if (name == "momentum.y") return [](const Observed& o) { return momentum(o.world).y; };
    if (name == "angular_momentum") return [](const Observed& o) { return angular_momentum(o.world); };
    for (const Account& a : accounts)
        if (name == std::string("energy.") + a.name) return [value = a.value](const Observed& o) { return value(o.energy()); };
    return nullptr;
}

Getter of_body(const std::string& name, const World& world) {
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) return nullptr;
    for (const Coordinate& c : coordinates)
        if (name.substr(dot + 1) == c.name)
            return [value = c.value, id = world.find(name.substr(0, dot))](const Observed& o) { return value(o.world, id); };
    return nullptr;
}

std::string nearest_known(const std::string& name, const World& world, const std::map<std::string, double>& parameters) {
    std::vector<std::string> known{"t", "bodies", "steps", "collisions", "momentum.x", "momentum.y", "angular_momentum"};
    for (const Account& a : accounts) known.push_back(std::string("energy.") + a.name);
    for (const auto& [parameter, value] : parameters) known.push_back(parameter);
    const auto dot = name.rfind('.');
    for (std::size_t i = 0; i < std::min<std::size_t>(world.size(), 1000) && dot != std::string::npos; ++i)
        for (const Coordinate& c : coordinates) known.push_back(world.body(world.ids()[i]).name + "." + c.name);
    return did_you_mean(name, known);
}

}  // namespace

struct Quantity::Compiled {
    std::deque<std::pair<double, Getter>> terms;  // a deque: the expression holds on to the places
    std::map<std::string, double> parameters;
    std::optional<Expression> expression;
};

Quantity::Quantity(const std::string& text, const World& world, const std::map<std::string, double>& parameters)
    : compiled_(std::make_unique<Compiled>()) {
    compiled_->parameters = parameters;
    const auto resolve = [&](const std::string& name) -> double* {
        if (const auto found = compiled_->parameters.find(name); found != compiled_->parameters.end()) return &found->second;
        Getter getter = of_world(name);
        if (!getter) getter = of_body(name, world);
        if (!getter) throw Error(fmt::format("in \"{}\": there is no '{}'{}", text, name, nearest_known(name, world, parameters)));
        return &compiled_->terms.emplace_back(0, std::move(getter)).first;
    };
    compiled_->expression.emplace(text, resolve);
}
Quantity::Quantity(Quantity&&) noexcept = default;
Quantity::~Quantity() = default;

double Quantity::operator()(const World& world) const {
    const Observed observed{world};
    for (auto& [value, getter] : compiled_->terms) value = getter(observed);
    return (*compiled_->expression)();
}

std::function<double(double)> closed_form(const std::string& text, const std::map<std::string, double>& parameters) {
    const Function f(text, {"t"}, {parameters.begin(), parameters.end()});
    return [f](double t) { return f(t); };
}

}  // namespace carom
