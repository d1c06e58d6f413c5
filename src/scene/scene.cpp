#include <carom/scene.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "scene/document.hpp"
#include "scene/memory.hpp"
#include "scene/typed.hpp"

namespace carom {

namespace {

const std::vector<std::string> top_keys{"$schema", "carom", "title", "teaches", "seed",   "parameters", "world",   "walls",
                                        "bodies", "builders", "forces", "run", "expects",    "pictures"};
constexpr int format_version = 1;

void check_top(const Json& root, const Place& top) {
    if (!root.is_object()) throw top.expected("an object", root);
    Reader::check_known(root, top, top_keys);
    const Json& version = part(root, "carom");
    if (version.is_null()) throw top.error(fmt::format("must begin with \"carom\": {}, the version of the format", format_version));
    if (version != format_version)
        throw (top / "carom").expected(fmt::format("{}, the version of the format", format_version), version);
    for (const char* key : {"title", "teaches"})
        if (const Json& text = part(root, key); !text.is_null() && !text.is_string()) throw (top / std::string(key)).expected("a text", text);
    if (const Json& seed = part(root, "seed"); !seed.is_null() && !(seed.is_number_unsigned() && seed.get<std::uint64_t>() < 0x80000000))
        throw (top / "seed").expected("a whole number from 0 to 2147483647", seed);
}

}  // namespace

Names Scene::Document::names(const World* world) const {
    Names out{{}, world};
    const Json& given = part(root, "parameters");
    if (given.is_null()) return out;
    const Place place = top / "parameters";
    if (!given.is_object()) throw place.expected("an object", given);
    for (const auto& [name, value] : given.items()) {
        if (name.empty() || name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") != std::string::npos ||
            (name[0] >= '0' && name[0] <= '9') || name == "t")
            throw place.error(fmt::format("has the name \"{}\"; a parameter's name is of letters, digits and _, and not t", name));
        out.parameters.emplace_back(name, Reader(out).number(value, place / name));
    }
    return out;
}

template <class T>
std::vector<T> Scene::Document::list(const char* key) const {
    const Names known = names(nullptr);
    std::vector<T> out;
    for_each_item(root, top, key, [&](const Json& item, const Place& place) { Reader(known).read(item, place, out.emplace_back()); });
    return out;
}

namespace {

void add_force(World& world, const FieldExpression& f, const Names& names) {
    const std::vector<std::string> all{"x", "y", "vx", "vy", "m", "t"};
    const Function fx(f.x, all, names.parameters), fy(f.y, all, names.parameters);
    ForceField field{.name = f.name, .body = f.body};
    field.force = [fx, fy](Vec2 x, Vec2 v, double m, double t) {
        return Vec2{fx(x.x, x.y, v.x, v.y, m, t), fy(x.x, x.y, v.x, v.y, m, t)};
    };
    if (!f.potential.empty()) {
        const Function u(f.potential, {"x", "y", "m", "t"}, names.parameters);
        field.potential = [u](Vec2 x, double m, double t) { return u(x.x, x.y, m, t); };
    }
    world.add(std::move(field));
}

void add_force(World& world, const CurveExpression& c, const Names& names) {
    const Function x(c.x, {"t"}, names.parameters), y(c.y, {"t"}, names.parameters), angle(c.angle, {"t"}, names.parameters);
    world.drive(c.body, [x, y, angle](double t) { return Pose{{x(t), y(t)}, angle(t)}; });
}

template <class T>
void add_force(World& world, const T& force, const Names&) {
    world.add(force);
}

}  // namespace

World Scene::world() const {
    const auto& [root, top] = *document_;
    const Names parameters = document_->names(nullptr);
    Settings settings;
    if (const Json& given = part(root, "world"); !given.is_null()) Reader(parameters).read(given, top / "world", settings);
    World world(settings);
    const Names names = document_->names(&world);
    const Reader reader(names);

    // Before the builders: a gas wants to know whether its box is periodic.
    for_each_item(root, top, "walls", [&](const Json& item, const Place& place) {
        read_typed(reader, item, place, wall_types, [&](const auto& wall) { world.add(wall); });
    });
    if (const Json& bodies = part(root, "bodies"); bodies.is_array())
        require_memory_for(static_cast<double>(bodies.size()), top / "bodies");
    for_each_item(root, top, "bodies", [&](const Json& item, const Place& place) {
        Body body;
        reader.read(item, place, body);
        at_place(place, [&] { world.add(body); });
    });
    build_all(world, reader, root, top, seed());
    for_each_item(root, top, "forces", [&](const Json& item, const Place& place) {
        read_typed(reader, item, place, force_types, [&](const auto& force) { add_force(world, force, names); });
    });
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
    check_top(document->root, document->top);
    Scene scene(std::move(document));
    scene.plan();
    scene.expectations();
    scene.pictures();
    return scene;
}

Scene Scene::load(const std::filesystem::path& file) {
    std::error_code failed;
    if (std::filesystem::is_directory(file, failed)) throw Error(fmt::format("{}: is a directory, and must be a scene file", file.string()));
    std::ifstream in(file, std::ios::binary);
    if (!in) throw Error(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    if (const auto size = std::filesystem::file_size(file, failed); !failed) require_memory_for_text(static_cast<double>(size), {file.string(), ""});
    std::ostringstream text;
    text << in.rdbuf();
    return parse(text.str(), file.string());
}

void Scene::set(const std::string& name, const std::string& value) {
    Json& root = document_->root;
    Json parsed = Json::parse(value, nullptr, false);
    if (parsed.is_discarded()) parsed = value;
    if (root.contains("parameters") && root["parameters"].contains(name)) {
        root["parameters"][name] = parsed;
    } else if (name.find('.') != std::string::npos || std::find(top_keys.begin(), top_keys.end(), name) != top_keys.end()) {
        *find_place(root, name, document_->top) = parsed;
    } else {
        std::vector<std::string> known;
        if (root.contains("parameters"))
            for (const auto& [key, ignored] : root["parameters"].items()) known.push_back(key);
        throw Error(fmt::format("{}: has no parameter \"{}\"{}", document_->top.file, name,
                                !did_you_mean(name, known).empty() ? did_you_mean(name, known)
                                : known.empty() ? "; it has none (a place like world.gravity can be set too)"
                                                : fmt::format("; it has {}", fmt::join(known, ", "))));
    }
    check_top(root, document_->top);
    plan();
}

std::string Scene::title() const { return part(document_->root, "title").is_string() ? part(document_->root, "title").get<std::string>() : ""; }
std::string Scene::teaches() const { return part(document_->root, "teaches").is_string() ? part(document_->root, "teaches").get<std::string>() : ""; }
int Scene::seed() const {
    const Json& seed = part(document_->root, "seed");
    return seed.is_null() ? 1 : seed.get<int>();
}

Plan Scene::plan() const {
    Plan plan;
    const Names names = document_->names(nullptr);
    if (const Json& given = part(document_->root, "run"); !given.is_null()) Reader(names).read(given, document_->top / "run", plan);
    return plan;
}
std::vector<Expectation> Scene::expectations() const { return document_->list<Expectation>("expects"); }
std::vector<Picture> Scene::pictures() const { return document_->list<Picture>("pictures"); }
std::map<std::string, double> Scene::parameters() const {
    const Names names = document_->names(nullptr);
    return {names.parameters.begin(), names.parameters.end()};
}
std::string Scene::text() const { return pretty(document_->root); }

}  // namespace carom
