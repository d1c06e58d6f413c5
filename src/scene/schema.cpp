#include <carom/scene.hpp>

#include "scene/colours.hpp"
#include "scene/kinds.hpp"
#include "scene/reader.hpp"

namespace carom {

namespace {

std::string text_of(const char* text, const char* unit) { return *unit ? fmt::format("{} [{}]", text, unit) : text; }

Json number_schema(const Range& range, const char* type = "number") {
    Json number{{"type", type}};
    if (std::isfinite(range.low)) number[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
    if (std::isfinite(range.high)) number["maximum"] = range.high;
    return {{"anyOf", Json::array({number, Json{{"type", "string"},
                                                {"minLength", 1},
                                                {"description", "an expression of the parameters"}}})}};
}

void add_property(Json& properties, const char* name, Json schema, const std::string& description) {
    schema["description"] = description;
    properties[name] = std::move(schema);
}

/// An object of these properties; beside them stand those of `one_of`, if there are any.
Json object_of(std::string_view description, const Json& properties, const Json& needed, Json one_of) {
    Json out{{"type", "object"}, {"description", std::string(description)}, {"properties", properties}};
    if (one_of.is_null()) {
        out["additionalProperties"] = false;
    } else {
        // Each knows which fields may stand beside its own; what these may be is said once.
        for (Json& one : one_of)
            for (const auto& [name, schema] : properties.items()) one["properties"][name] = true;
        out["oneOf"] = one_of;
    }
    if (!needed.empty()) out["required"] = needed;
    return out;
}

template <class T>
Json object_schema(const char* type_key = nullptr, const char* type_name = nullptr);

/// An object for each of a variant's, told apart by a key.
template <class V>
Json alternatives(const char* key) {
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
        Json all = Json::array();
        (all.push_back(object_schema<std::variant_alternative_t<k, V>>(key, std::variant_alternative_t<k, V>::name)),
         ...);
        return all;
    }
    (std::make_index_sequence<std::variant_size_v<V>>{});
}

template <class M>
Json value_schema(const Range& range) {
    if constexpr (std::is_same_v<M, bool>) {
        return {{"type", "boolean"}};
    } else if constexpr (std::is_arithmetic_v<M>) {
        return number_schema(range, std::is_integral_v<M> ? "integer" : "number");
    } else if constexpr (std::is_same_v<M, std::string> || std::is_same_v<M, BodyId>) {
        return {{"type", "string"}};
    } else if constexpr (std::is_same_v<M, Colour>) {
        Json names = Json::array();
        for (const ColourName& c : colour_names) names.push_back(std::string(c.name));
        const Json hex{{"type", "string"}, {"pattern", "^#([0-9a-fA-F]{3,4}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})$"}};
        return {{"anyOf", Json::array({hex, {{"enum", names}}})}};
    } else if constexpr (std::is_same_v<M, Vec2>) {
        return {{"type", "array"}, {"items", number_schema(range)}, {"minItems", 2}, {"maxItems", 2}};
    } else if constexpr (std::is_enum_v<M>) {
        Json names = Json::array();
        for (const auto& c : choices(static_cast<const M*>(nullptr))) names.push_back(c.name);
        return {{"enum", names}};
    } else if constexpr (requires(M m) { std::visit([](auto&) {}, m); }) {
        Json any_of = alternatives<M>("method");
        any_of.insert(any_of.begin(), Json{{"enum", Reader::method_names<M>()}});
        return {{"anyOf", any_of}};
    } else if constexpr (requires(M m) { m.push_back(m.front()); }) {
        return {{"type", "array"}, {"items", value_schema<typename M::value_type>(range)}};
    } else if constexpr (requires(M m) { m.has_value(); }) {
        return value_schema<typename M::value_type>(range);
    } else {
        return object_schema<M>();
    }
}

template <class T>
Json object_schema(const char* type_key, const char* type_name) {
    Json properties = Json::object(), needed = Json::array(), one_of;
    if (type_key) {
        properties[type_key] = {{"const", type_name}};
        needed.push_back(type_key);
    }
    const auto add = [&]<class S, class M>(const Field<S, M>& field) {
        add_property(properties, field.name, value_schema<M>(field.range), text_of(field.text, field.unit));
        if (is_required(field)) needed.push_back(field.name);
    };
    const auto add_any = [&]<class F>(const F& field) {
        if constexpr (is_flat<F>)
            one_of = alternatives<typename F::Variant>(field.name);
        else
            add(field);
    };
    if constexpr (Described<T>)
        std::apply([&](const auto&... f) { (add_any(f), ...); }, fields(static_cast<const T*>(nullptr)));
    return object_of(describe(static_cast<const T*>(nullptr)), properties, needed, one_of);
}

template <class... T>
Json list_schema(const std::tuple<Type<T>...>& types) {
    Json one_of = Json::array();
    std::apply([&](const auto&... type) { (one_of.push_back(object_schema<T>("type", type.name)), ...); }, types);
    return {{"type", "array"}, {"items", {{"oneOf", one_of}}}};
}

template <class T>
Json list_schema() {
    return {{"type", "array"}, {"items", object_schema<T>()}};
}

}  // namespace

std::string scene_schema() {
    Json expects = list_schema<Expectation>();
    expects["items"]["properties"]["quantity"]["minLength"] = 1;
    Json twins = list_schema<Twin>();
    for (const char* text : {"quantity", "formula"}) twins["items"]["properties"][text]["minLength"] = 1;
    const Json parts{{"carom", {{"const", 1}}},
                     {"$schema", {{"type", "string"}}},
                     {"title", {{"type", "string"}}},
                     {"teaches", {{"type", "string"}}},
                     {"seed", {{"type", "integer"}, {"minimum", seed_range.low}, {"maximum", seed_range.high}}},
                     {"parameters",
                      {{"type", "object"},
                       {"additionalProperties", number_schema(any)},
                       {"propertyNames", {{"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"}}},
                       {"maxProperties", most_parameters}}},
                     {"world", object_schema<Settings>()},
                     {"walls", list_schema(wall_types)},
                     {"bodies", list_schema<Body>()},
                     {"builders", list_schema(builder_types)},
                     {"joints", list_schema<Joint>()},
                     {"forces", list_schema(force_types)},
                     {"run", object_schema<Plan>()},
                     {"expects", expects},
                     {"twins", twins},
                     {"pictures", list_schema<Picture>()}};
    Json properties = Json::object();
    for (const TopKey& key : top_keys) {
        properties[key.name] = parts.at(key.name);
        properties[key.name]["description"] = key.text;
    }
    return pretty({{"$schema", "http://json-schema.org/draft-07/schema#"},
                   {"title", "Carom scene"},
                   {"type", "object"},
                   {"required", {"carom"}},
                   {"properties", properties},
                   {"additionalProperties", false}});
}

}  // namespace carom
