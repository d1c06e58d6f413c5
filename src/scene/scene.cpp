#include <algorithm>
#include <carom/scene.hpp>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#include "collision/grid.hpp"
#include "scene/checks.hpp"
#include "scene/document.hpp"
#include "scene/expression.hpp"
#include "scene/memory.hpp"
#include "scene/quantity.hpp"
#include "scene/typed.hpp"
#include "state/nearest.hpp"

namespace carom {

namespace {

constexpr int format_version = 1;

std::vector<std::string> known_keys() {
    std::vector<std::string> names;
    for (const TopKey& key : top_keys) names.push_back(key.name);
    return names;
}

bool has_shape(const Json& value, TopKey::Shape shape) {
    switch (shape) {
        case TopKey::Shape::text:
            return value.is_string();
        case TopKey::Shape::object:
            return value.is_object();
        case TopKey::Shape::list:
            return value.is_array();
        default:
            return true;  // seed and version are read elsewhere
    }
}

/// "; did you mean 'run.duration'?" of a field, or another's word for one, that the part of a document has which is one
/// struct; else "".
template <Described T>
std::string field_of(const char* key, const std::string& name) {
    const std::vector<std::string> known = Reader::keys(T{});
    const std::string word = in_small_letters(name);
    const bool is_field = std::find(known.begin(), known.end(), word) != known.end();
    const std::string field = is_field ? word : here_called(word, known);
    return field.empty() ? "" : fmt::format("; did you mean '{}.{}'?", key, field);
}
std::string place_of_field(const std::string& name) {
    const std::string place = field_of<Plan>("run", name);
    return place.empty() ? field_of<Settings>("world", name) : place;
}

void check_top(const Json& root, const Place& top) {
    if (!root.is_object()) throw top.expected("an object", root);
    const auto known = known_keys();
    for (const auto& [key, value] : root.items())
        if (const std::string place = place_of_field(key);
            !place.empty() && std::find(known.begin(), known.end(), key) == known.end())
            throw top.error(fmt::format("has no field {}{}", shown(key), place));
    Reader::check_known(root, top, known);
    const std::string version = fmt::format("{}, the version of the format", format_version);
    if (!root.contains("carom")) throw top.error(fmt::format("must have the field \"carom\": {}", version));
    if (root["carom"] != format_version) throw(top / "carom").expected(version, root["carom"]);
    for (const TopKey& key : top_keys) {
        if (!root.contains(key.name) || has_shape(root[key.name], key.shape)) continue;
        const char* allowed = key.shape == TopKey::Shape::text   ? "a text"
                              : key.shape == TopKey::Shape::list ? "a list"
                                                                 : "an object";
        throw(top / std::string(key.name)).expected(allowed, root[key.name]);
    }
}

void check_parameter_name(const std::string& name, const Place& place) {
    const bool word =
        !name.empty() && (name[0] < '0' || name[0] > '9') &&
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
    if (!word)
        throw place.error(
            fmt::format("has the name {}, and a parameter's name is of letters, digits and _", shown(name)));
    if (is_of_world(name) || Expression::knows(name))
        throw place.error(fmt::format("has the name {}, which means something else in an expression", shown(name)));
}

/// The struct under a key of the document, or a default one.
template <class T>
T one(const Json& root, const Place& top, const char* key, const Names& names) {
    T out;
    if (const Json& given = part(root, key); !given.is_null()) Reader(names).read(given, top / std::string(key), out);
    return out;
}

template <class T>
std::vector<T> list(const Json& root, const Place& top, const char* key, const Names& names) {
    std::vector<T> out;
    for_each_item(root, top, key, [&](const Json& item, const Place& place) {
        Reader(names).read(item, place, out.emplace_back());
        check(out.back(), place);
    });
    return out;
}

}  // namespace

Names Scene::Document::names(const World* world) const {
    Names out{{}, world};
    const Json& given = part(root, "parameters");
    const Place place = top / "parameters";
    if (given.size() > most_parameters)
        throw place.error(fmt::format("must be at most {}, got {}", most_parameters, given.size()));
    for (const auto& [name, value] : given.items()) out.later.push_back(name);
    for (const auto& [name, value] : given.items()) {
        check_parameter_name(name, place);
        out.later.erase(out.later.begin());
        out.parameters.emplace_back(name, Reader(out).number(value, place / name));
    }
    return out;
}

Settings Scene::Document::settings() const {
    Settings settings = one<Settings>(root, top, "world", names());
    if (auto* gas = std::get_if<Events>(&settings.solver); gas && !part(part(root, "world"), "solver").contains("seed"))
        gas->seed = seed();
    return settings;
}

Plan Scene::Document::plan() const {
    const Plan plan = one<Plan>(root, top, "run", names());
    constexpr double most_steps = 1e15;
    if (plan.duration / plan.step > most_steps)
        throw(top / "run" / "duration")
            .error(fmt::format("must be at most {:.0e} steps of {} s, got {} s", most_steps, plan.step, plan.duration));
    return plan;
}

int Scene::Document::seed() const {
    const Json& given = part(root, "seed");
    if (given.is_null() && !root.contains("seed")) return 1;
    if (!given.is_number_unsigned() || given.get<std::uint64_t>() > 2147483647)
        throw(top / "seed").expected(seed_range.words, given);
    return given.get<int>();
}

std::vector<Expectation> Scene::Document::expectations() const {
    return list<Expectation>(root, top, "expects", names());
}
std::vector<Twin> Scene::Document::twins() const { return list<Twin>(root, top, "twins", names()); }
std::vector<Picture> Scene::Document::pictures() const { return list<Picture>(root, top, "pictures", names()); }

void Scene::Document::check() const {
    check_top(root, top);
    settings();
    plan();
    seed();
    expectations();
    twins();
    pictures();
}

void Scene::Document::check_times(double end) const {
    const Plan run = plan();
    end = std::max(end, run.duration);
    const auto within = [&](double at, const Place& place) {
        if (at > end + 1e-9 * run.step)
            throw place.error(fmt::format("must be within the run, whose duration is {} s, got {} s", end, at));
    };
    const auto expected = expectations();
    for (std::size_t i = 0; i < expected.size(); ++i)
        if (expected[i].at) within(*expected[i].at, top / "expects" / i / "at");
    const auto drawn = pictures();
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        if (drawn[i].from) within(*drawn[i].from, top / "pictures" / i / "from");
        for (std::size_t k = 0; k < drawn[i].at.size(); ++k) within(drawn[i].at[k], top / "pictures" / i / "at" / k);
    }
}

Function function_of(const std::string& text, const Place& place, const std::vector<std::string>& variables,
                     const Names& names) {
    try {
        return Function(text, variables, names.parameters);
    } catch (const Error& e) {
        throw place.expected(fmt::format("an expression of {} and the parameters", fmt::join(variables, ", ")), text,
                             e.what());
    }
}

namespace {

/// A force that is no number where a body starts would be said of the body alone, after the first step, and a potential
/// after the last.
void check_start(const World& world, const FieldExpression& f, const Place& place, const Function& fx,
                 const Function& fy, const std::function<double(Vec2, double, double)>& potential) {
    for (std::size_t i = 0; i < world.size(); ++i) {
        if (world.kinds()[i] != Kind::dynamic || (f.body && *f.body != world.ids()[i])) continue;
        const Vec2 x = world.positions()[i], v = world.velocities()[i];
        const double m = world.masses()[i];
        const auto look = [&](const char* field, const char* unit, const std::string& text, const auto& here) {
            double value = std::nan("");
            std::string why;  // a closed form says
            try {
                value = here();
            } catch (const Error& e) {
                why = fmt::format(": {}", e.what());
            }
            if (std::isfinite(value)) return;
            const std::string name = world.body(world.ids()[i]).name;
            throw(place / std::string(field))
                .expected(fmt::format("a finite number in {} where bodies start", unit), text,
                          fmt::format("it is {} for body {} at ({}, {}) m with velocity ({}, {}) m/s, at 0 s{}",
                                      std::isnan(value) ? "no number" : fmt::format("{}", value),
                                      name.empty() ? fmt::format("{}", i) : fmt::format("'{}'", name), x.x, x.y, v.x,
                                      v.y, why));
        };
        look("x", "N", f.x, [&] { return fx(x.x, x.y, v.x, v.y, m, 0.0); });
        look("y", "N", f.y, [&] { return fy(x.x, x.y, v.x, v.y, m, 0.0); });
        if (potential) look("potential", "J", f.potential, [&] { return potential(x, m, 0.0); });
    }
}

void add_force(World& world, const FieldExpression& f, const Place& place, const Names& names) {
    if (f.x == "0" && f.y == "0" && !f.potential.empty())
        throw place.error("must have the field \"x\" or \"y\": the force, which is not made from its potential");
    const std::vector<std::string> all{"x", "y", "vx", "vy", "m", "t"};
    const Function fx = function_of(f.x, place / "x", all, names), fy = function_of(f.y, place / "y", all, names);
    ForceField field{.name = f.name, .body = f.body};
    const auto looks_at_v = [vx = 2, vy = 3](const Function& of) { return of.looks_at(vx) || of.looks_at(vy); };
    field.sees_velocity = looks_at_v(fx) || looks_at_v(fy);
    field.force = [fx, fy](Vec2 x, Vec2 v, double m, double t) {
        return Vec2{fx(x.x, x.y, v.x, v.y, m, t), fy(x.x, x.y, v.x, v.y, m, t)};
    };
    if (!f.potential.empty()) {
        const Function u = function_of(f.potential, place / "potential", {"x", "y", "m", "t"}, names);
        field.potential = [u](Vec2 x, double m, double t) { return u(x.x, x.y, m, t); };
    }
    check_start(world, f, place, fx, fy, field.potential);
    world.add(std::move(field));
}

void add_force(World& world, const CurveExpression& c, const Place& place, const Names& names) {
    const auto coordinate = [&](const std::optional<std::string>& text, const char* field, const char* unit,
                                double placed) -> std::function<double(double)> {
        if (!text) return [placed](double) { return placed; };
        const Function curve = function_of(*text, place / std::string(field), {"t"}, names);
        // Its velocity at the start is a difference of what is before and after.
        for (const double t : {0.0, -2.0 / 1024})
            if (const double value = curve(t); !std::isfinite(value))
                throw(place / std::string(field))
                    .expected(fmt::format("a finite number in {} from 2 ms before the start on", unit), *text,
                              fmt::format("it is {} at {:.2g} s",
                                          std::isnan(value) ? "no number" : fmt::format("{}", value), t));
        return curve;
    };
    if (world.follows_curve(c.body))
        throw(place / std::string("body")).expected("a body that follows no curve yet", world.body(c.body).name);
    const Vec2 at = world.position(c.body);
    const auto x = coordinate(c.x, "x", "m", at.x), y = coordinate(c.y, "y", "m", at.y),
               angle = coordinate(c.angle, "angle", "rad", world.angle(c.body));
    at_place(place, [&] { world.drive(c.body, [x, y, angle](double t) { return Pose{{x(t), y(t)}, angle(t)}; }); });
}

template <class T>
void add_force(World& world, const T& force, const Place& place, const Names&) {
    at_place(place, [&] { world.add(force); });
}

/// A body that starts outside of a room would fly on there for ever, or be thrown about: nobody means that.
void check_rooms(const World& world, const Json& root, const Place& top) {
    if (std::holds_alternative<NoContact>(world.settings().solver)) return;
    if (const auto* gas = std::get_if<Events>(&world.settings().solver); gas && gas->relax) return;
    const std::size_t listed = part(root, "bodies").size();
    for (const Rectangle& room : world.rectangles())
        for (std::size_t i = 0; i < world.size(); ++i) {
            const Vec2 x = world.positions()[i];
            const bool inside = x.x >= room.low.x && x.x <= room.high.x && x.y >= room.low.y && x.y <= room.high.y;
            if (inside || world.kinds()[i] != Kind::dynamic) continue;
            const std::string what = fmt::format("outside of the walls from ({}, {}) to ({}, {}) m", room.low.x,
                                                 room.low.y, room.high.x, room.high.y);
            if (i < listed)
                throw(top / "bodies" / i / "position")
                    .error(fmt::format("must not be {}, got [{}, {}]", what, x.x, x.y));
            throw(top / "builders").error(fmt::format("make a body {}, at ({}, {}) m", what, x.x, x.y));
        }
}

/// A disc that starts inside of a net is held by springs against blows from all sides: it takes energy from the
/// overlap, and a step without end. Discs in heaps that nothing holds are only pushed apart.
void check_nets(const World& world, const Json& root, const Place& top) {
    const auto* impulse = std::get_if<Impulse>(&world.settings().solver);
    if (!impulse || !impulse->disc_collisions || world.springs().empty() || world.periodic()) return;
    std::vector<bool> held(world.size());
    for (const Spring& s : world.springs())
        for (const BodyId id : {s.a, s.b})
            if (id.index < held.size()) held[id.index] = true;  // nobody was removed yet: an index is a row
    const auto x = world.positions();
    const auto r = world.radii();
    Grid grid;
    grid.build(x, r, {});
    std::vector<std::uint32_t> near;
    const std::size_t listed = part(root, "bodies").size();
    for (std::size_t i = 0; i < world.size(); ++i) {
        if (held[i] || r[i] == 0) continue;
        near.clear();
        grid.near(x[i], r[i], near);
        for (const std::uint32_t j : near) {
            if (!held[j] || r[j] == 0 || length(x[j] - x[i]) >= std::max(r[i], r[j])) continue;
            if (world.kinds()[i] != Kind::dynamic && world.kinds()[j] != Kind::dynamic) continue;
            const std::string what =
                fmt::format("inside of discs that springs hold, as one at ({:.6g}, {:.6g}) m", x[j].x, x[j].y);
            if (i < listed)
                throw(top / "bodies" / i / "position")
                    .error(fmt::format("must not be {}, got [{}, {}]", what, x[i].x, x[i].y));
            throw(top / "builders").error(fmt::format("make a disc {}", what));
        }
    }
}

/// A scene that names no solver gets softstep where the default cannot do what it holds: joints, and shapes that meet.
void choose_solver(World& world, const Json& root) {
    if (const Json& settings = part(root, "world"); settings.is_object() && settings.contains("solver")) return;
    try {
        world.check();
    } catch (const Error&) {
        Settings settings = world.settings();
        settings.solver = SoftStep{};
        world.configure(settings);
    }
}

}  // namespace

World Scene::world() const {
    const auto& [root, top] = *document_;
    World world(document_->settings());
    const Names names = document_->names(&world);
    const Reader reader(names);

    if (const Json& bodies = part(root, "bodies"); bodies.is_array())
        require_memory_for({.bodies = static_cast<double>(bodies.size()), .named = true}, top / "bodies");
    for_each_item(root, top, "bodies", [&](const Json& item, const Place& place) {
        Body body;
        reader.read(item, place, body);
        at_place(place, [&] { world.add(body); });
        check_mass(reader, item, place, world.masses().last(1));
    });
    // Walls before builders: a gas in a periodic box has another heat than one between walls.
    for_each_item(root, top, "walls", [&](const Json& item, const Place& place) {
        read_typed(reader, item, place, wall_types,
                   [&](const auto& wall, const Place& at) { at_place(at, [&] { world.add(wall); }); });
    });
    build_all(world, reader, root, top, seed());
    for_each_item(root, top, "joints", [&](const Json& item, const Place& place) {
        Joint joint;
        reader.read(item, place, joint);
        at_place(place, [&] { world.add(joint); });
    });
    for_each_item(root, top, "forces", [&](const Json& item, const Place& place) {
        if (item.is_object() && part(item, "type") == "gravity")
            throw(place / "type")
                .error(
                    "\"gravity\" is none: what all bodies fall with is world.gravity, and between bodies it is "
                    "\"attraction\"");
        read_typed(reader, item, place, force_types,
                   [&](const auto& force, const Place& at) { add_force(world, force, at, names); });
    });
    choose_solver(world, root);
    check_rooms(world, root, top);
    check_nets(world, root, top);
    at_place(top / "world", [&] { world.check(); });
    return world;
}

Scene::Scene(std::unique_ptr<Document> document) : document_(std::move(document)) {}
Scene::Scene(const Scene& other) : document_(std::make_unique<Document>(*other.document_)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene other) noexcept {
    document_ = std::move(other.document_);
    return *this;
}
Scene::~Scene() = default;

Scene Scene::parse(std::string_view text, const std::string& name) {
    auto document = std::make_unique<Document>(Document{parse_json(text, name), {name, ""}});
    document->check();
    return Scene(std::move(document));
}

namespace {

std::string content_of(const std::filesystem::path& file) {
    const Place place{file.string(), ""};
    std::error_code failed;
    if (std::filesystem::is_directory(file, failed)) throw place.error("is a folder, and must be a scene file");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw place.error(fmt::format("cannot be read: {}", std::strerror(errno)));
    std::string text, block(1 << 20, '\0');
    while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
        text.append(block, 0, static_cast<std::size_t>(in.gcount()));
        if (block.find('\0') < static_cast<std::size_t>(in.gcount()))
            throw place.error("is not a text, and must be a scene in JSON");
        require_memory_for_text(static_cast<double>(text.size()), place);
    }
    if (in.bad()) throw place.error(fmt::format("cannot be read: {}", std::strerror(errno)));
    return text;
}

}  // namespace

Scene Scene::load(const std::filesystem::path& file, const std::string& name) {
    Scene scene = read(file, name);
    scene.check_times();
    return scene;
}
Scene Scene::read(const std::filesystem::path& file, const std::string& name) {
    return parse(content_of(file), name.empty() ? file.string() : name);
}
void Scene::check_times(double end) const { document_->check_times(end); }

namespace {

/// What a value from the command line means: JSON, or else a text, which may be an expression.
Json value_of(const std::string& text, const std::string& name) {
    const bool structured = text.starts_with('[') || text.starts_with('{') || text.starts_with('"');
    try {
        return parse_json(text, name);
    } catch (const Error&) {
        if (structured) throw;
        return text;
    }
}

/// Whether a name is that of a place in the document, and not of a parameter.
bool is_place(const std::string& name) {
    const auto keys = known_keys();
    return name.find_first_of(".[") != std::string::npos || std::find(keys.begin(), keys.end(), name) != keys.end();
}

}  // namespace

void Scene::set(const std::string& name, const std::string& value) {
    require_utf8(name, {"Scene::set", ""});
    require_utf8(value, {name, ""});
    // In a copy, so that a wrong value leaves the scene as it was.
    auto changed = std::make_unique<Document>(*document_);
    Json& root = changed->root;
    const Json& parameters = part(root, "parameters");
    const std::string inside = "parameters.", parameter = name.substr(name.starts_with(inside) ? inside.size() : 0);
    if (parameters.is_object() && parameters.contains(parameter)) {
        root["parameters"][parameter] = value_of(value, name);
    } else if (parameter == name && is_place(name)) {
        find_place(root, name, changed->top) = value_of(value, name);
    } else {
        std::vector<std::string> known;
        for (const auto& [key, ignored] : parameters.items()) known.push_back(key);
        const std::string place = place_of_field(parameter);
        const std::string near = place.empty() ? did_you_mean(parameter, known) : place;
        throw Error(fmt::format("{}: has no parameter \"{}\"{}", changed->top.file, parameter,
                                !near.empty()   ? near
                                : known.empty() ? "; it has none (a place like world.gravity can be set too)"
                                                : fmt::format("; it has {}", fmt::join(known, ", "))));
    }
    changed->check();
    document_ = std::move(changed);
}

std::string Scene::file() const { return document_->top.file; }
std::string Scene::title() const { return document_->root.value("title", ""); }
std::string Scene::teaches() const { return document_->root.value("teaches", ""); }
int Scene::seed() const { return document_->seed(); }
Plan Scene::plan() const { return document_->plan(); }
std::vector<Expectation> Scene::expectations() const { return document_->expectations(); }
std::vector<Twin> Scene::twins() const { return document_->twins(); }
std::vector<Picture> Scene::pictures() const { return document_->pictures(); }
std::map<std::string, double> Scene::parameters() const {
    const Names names = document_->names();
    return {names.parameters.begin(), names.parameters.end()};
}
std::string Scene::text() const { return pretty(document_->root); }

}  // namespace carom
