#pragma once
// Exact results from elsewhere, by their id. No number of theirs is typed twice.

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace carom {

inline nlohmann::json reference_file(const std::string& name) {
    std::ifstream in(std::string(CAROM_SOURCE_DIR) + "/tests/reference/" + name);
    return nlohmann::json::parse(in);
}

inline const nlohmann::json& truth_entry(const std::string& id) {
    static const nlohmann::json all = reference_file("truth.json");
    for (const auto& entry : all)
        if (entry["id"] == id) return entry;
    throw std::runtime_error("truth.json has no entry " + id);
}

inline const nlohmann::json& truth(const std::string& id) { return truth_entry(id)["value"]; }

}  // namespace carom
