#include <cstring>

#include "scene/document.hpp"

namespace carom {

namespace {

/// "forces[0].stiffness" → forces, 0, stiffness.
std::vector<std::string> steps_of(const std::string& path) {
    std::vector<std::string> steps(1);
    for (const char c : path) {
        if (c == '.' || c == '[')
            steps.emplace_back();
        else if (c != ']')
            steps.back() += c;
    }
    return steps;
}

Json* item_of(Json& list, const std::string& step) {
    if (step.find_first_not_of("0123456789") == std::string::npos && !step.empty() && step.size() < 10) {
        const auto index = static_cast<std::size_t>(std::stoul(step));
        return index < list.size() ? &list[index] : nullptr;
    }
    for (Json& item : list)
        if (item.is_object() && item.contains("name") && item["name"] == step) return &item;
    return nullptr;
}

}  // namespace

Json* find_place(Json& root, const std::string& path, const Place& top) {
    Json* at = &root;
    const auto steps = steps_of(path);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const bool last = k + 1 == steps.size();
        Json* next = nullptr;
        if (at->is_null()) *at = Json::object();  // a key of the document that was not given: world.integrator
        if (at->is_array())
            next = item_of(*at, steps[k]);
        else if (at->is_object() && (last || at->contains(steps[k]) || at == &root))
            next = &(*at)[steps[k]];
        if (next == nullptr || (next->is_null() && !last && at != &root))
            throw Error(fmt::format("{}: there is no \"{}\" in \"{}\" to be set", top.file, steps[k], path));
        at = next;
    }
    return at;
}

}  // namespace carom
