#include "scene/document.hpp"
#include "scene/kinds.hpp"
#include "state/nearest.hpp"

namespace carom {

Error at_field(const Place& place, const std::string& words) {
    constexpr const char* letters = "abcdefghijklmnopqrstuvwxyz";
    constexpr const char* path = "abcdefghijklmnopqrstuvwxyz_0123456789.[]";
    // A type begins with a capital letter, and may have the name of a body behind it.
    std::size_t at = !words.empty() && words[0] >= 'A' && words[0] <= 'Z' ? words.find_first_of(". ") : words.npos;
    if (at != words.npos && words.compare(at, 2, " '") == 0) {
        at = words.find('\'', at + 2);
        if (at != words.npos) ++at;
    }
    const bool field = at != words.npos && at + 1 < words.size() && words[at] == '.' &&
                       std::string_view(letters).find(words[at + 1]) != std::string_view::npos;
    const std::size_t end = field ? words.find_first_not_of(path, at) : words.npos;
    if (end == words.npos || words[end] != ' ') return place.error("is wrong: " + words);
    return (place / words.substr(at + 1, end - at - 1)).error(words.substr(end + 1));
}

namespace {

/// Cuts the first `length` characters off a path, and what separates them from the rest.
std::string cut(std::string_view& rest, std::size_t length) {
    const std::string step(rest.substr(0, length));
    rest.remove_prefix(std::min(length, rest.size()));
    if (rest.starts_with(']')) rest.remove_prefix(1);
    if (rest.starts_with('.') || rest.starts_with('[')) rest.remove_prefix(1);
    return step;
}

std::size_t length_of_key(std::string_view rest) { return std::min(rest.find_first_of(".[]"), rest.size()); }

/// What an item of a list is called: a builder by the bodies it makes.
std::string name_of(const Json& item) {
    const Json* at = &item;
    for (const char* inside : {"", "body", "fill", "body"}) {
        if (*inside && at->is_object() && at->contains(inside)) at = &at->at(inside);
        if (at->is_object() && at->contains("name") && at->at("name").is_string())
            return at->at("name").get<std::string>();
    }
    return "";
}

bool is_index(const std::string& step) {
    return !step.empty() && step.size() < 10 && step.find_first_not_of("0123456789") == std::string::npos;
}

/// An item by its number or its name, which may itself contain dots and brackets: the longest that fits.
Json& item_of(Json& list, std::string_view& rest, const std::string& path, const Place& top) {
    std::vector<std::string> names;
    Json* best = nullptr;
    std::size_t longest = 0;
    for (Json& item : list) {
        names.push_back(name_of(item));
        const std::string& name = names.back();
        const bool whole = rest.size() == name.size() ||
                           (rest.size() > name.size() && (rest[name.size()] == '.' || rest[name.size()] == '['));
        if (name.size() > longest && rest.starts_with(name) && whole) best = &item, longest = name.size();
    }
    if (best) return cut(rest, longest), *best;
    const std::string step = cut(rest, length_of_key(rest));
    if (is_index(step) && std::stoul(step) < list.size()) return list[std::stoul(step)];
    throw Error(fmt::format("{}: \"{}\" cannot be set: the list has {} item{} and no \"{}\"{}", top.file, path,
                            list.size(), list.size() == 1 ? "" : "s", step,
                            is_index(step) ? "" : did_you_mean(step, names)));
}

/// What has a name is a part of a list, and a list that there is not has no parts.
void check_begin(const Json& root, const std::string& path, const Place& top) {
    const std::string first = path.substr(0, length_of_key(path));
    const auto is_first = [&](const TopKey& key) { return key.name == first; };
    const auto* const known = std::find_if(std::begin(top_keys), std::end(top_keys), is_first);
    if (known != std::end(top_keys)) {
        if (known->shape != TopKey::Shape::list || root.contains(first) || path.size() == first.size()) return;
        const bool are_built = first == "bodies" && root.contains("builders");
        throw Error(fmt::format("{}: \"{}\" cannot be set: the scene has no \"{}\"{}", top.file, path, first,
                                are_built ? "; what its bodies have in common its \"builders\" say" : ""));
    }
    for (const char* key : {"bodies", "builders", "joints", "forces"})
        for (const Json& item : root.contains(key) && root[key].is_array() ? root[key] : Json::array())
            if (name_of(item) == first)
                throw Error(fmt::format("{}: \"{}\" cannot be set: it is within a list; did you mean '{}.{}'?",
                                        top.file, path, key, path));
}

}  // namespace

Json& find_place(Json& root, const std::string& path, const Place& top) {
    check_begin(root, path, top);
    Json* at = &root;
    std::string_view rest = path;
    do {
        if (at->is_null()) *at = Json::object();
        // A method by its name alone becomes the object that has room for options.
        if (at->is_string()) *at = Json{{"method", *at}};
        if (!at->is_structured())
            throw Error(fmt::format("{}: \"{}\" cannot be set: \"{}\" is inside of {}, which has no parts", top.file,
                                    path, rest, shown(*at)));
        at = at->is_array() ? &item_of(*at, rest, path, top) : &(*at)[cut(rest, length_of_key(rest))];
    } while (!rest.empty());
    return *at;
}

}  // namespace carom
