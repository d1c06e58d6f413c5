#pragma once
#include <fmt/format.h>

#include <carom/error.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace carom {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

using Json = nlohmann::ordered_json;

/// A place in a document, for errors: "gas.json: bodies[3].mass".
struct Place {
    std::string file, path;

    Place operator/(const std::string& key) const { return {file, path.empty() ? key : path + "." + key}; }
    Place operator/(std::size_t index) const { return {file, fmt::format("{}[{}]", path, index)}; }
    Error error(const std::string& what) const {
        return Error(path.empty() ? fmt::format("{}: {}", file, what) : fmt::format("{}: {} {}", file, path, what));
    }
    /// "must be …, got …", and why that is not right if it is not plain to see.
    Error expected(const std::string& allowed, const Json& value, const std::string& why = "") const;
};

/// Parses JSON with comments. Errors name line and column, or the place of a key that is given twice.
Json parse_json(std::string_view text, const std::string& file);
/// The one way a document is written: what fits stands on one line.
std::string pretty(const Json& value);
/// An Error that names the place of a text that is not UTF-8, which no document can have.
void require_utf8(const Json& value, const Place& place);
/// A value in one short line, for errors.
std::string shown(const Json& value);

}  // namespace carom
