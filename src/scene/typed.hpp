#pragma once
// Lists of objects that say what they are: {"type": name, fields…}.

#include "scene/kinds.hpp"
#include "scene/reader.hpp"

namespace carom {

/// The value under a key; null if it is absent.
inline const Json& part(const Json& root, const char* key) {
    static const Json none;
    const auto found = root.find(key);
    return found == root.end() ? none : *found;
}

/// The engine's words about a struct, as an Error at a place of the scene.
Error at_field(const Place& place, const std::string& words);

/// Calls f(item, place) for every item of the list under a key.
template <class F>
void for_each_item(const Json& root, const Place& top, const char* key, F f) {
    const Json& list = part(root, key);
    if (list.is_null()) return;
    if (!list.is_array()) throw(top / std::string(key)).expected("a list", list);
    for (std::size_t i = 0; i < list.size(); ++i) f(list[i], (top / std::string(key)) / i);
}

/// Runs f; an Error it throws is given the place. What the engine calls `Rope.radius` or `Body 'b'.mass` is the field
/// of that name there.
template <class F>
void at_place(const Place& place, F f) {
    try {
        f();
    } catch (const Error& e) {
        throw at_field(place, e.what());
    }
}

/// Reads an object as the one of the types that it names, and calls f with it and its place.
template <class... T, class F>
void read_typed(const Reader& reader, const Json& item, const Place& place, const std::tuple<Type<T>...>& types, F f) {
    if (!item.is_object()) throw place.expected("an object with a \"type\"", item);
    const Json& given = part(item, "type");
    bool found = false;
    std::vector<std::string> names;
    const auto attempt = [&]<class One>(const Type<One>& type) {
        names.push_back(type.name);
        if (found || given != type.name) return;
        found = true;
        One value{};
        reader.read(item, place, value, {"type"});
        f(value, place);
    };
    std::apply([&](const auto&... type) { (attempt(type), ...); }, types);
    if (given.is_null() && !item.contains("type"))
        throw place.error(fmt::format("must have the field \"type\": one of {}", fmt::join(names, ", ")));
    if (!found) throw(place / "type").error(not_one_of(names, given));
}

}  // namespace carom
