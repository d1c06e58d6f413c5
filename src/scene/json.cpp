#include "scene/json.hpp"

#include <set>

namespace carom {

namespace {

constexpr std::size_t line_width = 110;
constexpr int deepest = 64;

/// nlohmann's message without its own name and number.
std::string plain(const nlohmann::json::parse_error& e) {
    std::string what = e.what();
    if (const auto colon = what.find("column"); colon != std::string::npos)
        if (const auto text = what.find(": ", colon); text != std::string::npos) what = what.substr(text + 2);
    for (char& c : what)
        if (static_cast<unsigned char>(c) < 32) c = ' ';
    return what;
}

std::string line_and_column(std::string_view text, std::size_t byte) {
    std::size_t line = 1, column = 1;
    for (std::size_t i = 0; i + 1 < byte && i < text.size(); ++i) {
        ++column;
        if (text[i] == '\n') ++line, column = 1;
    }
    return fmt::format("{}:{}", line, column);
}

void write(const Json& value, std::size_t indent, std::string& out) {
    const std::string flat = value.dump();
    if (!value.is_structured() || flat.size() + indent <= line_width || value.empty()) {
        out += flat;
        return;
    }
    const std::string margin(indent + 2, ' ');
    out += value.is_object() ? "{" : "[";
    bool first = true;
    for (const auto& [key, item] : value.items()) {
        out += (first ? "\n" : ",\n") + margin;
        first = false;
        if (value.is_object()) out += Json(key).dump() + ": ";
        write(item, indent + 2, out);
    }
    out += "\n" + std::string(indent, ' ') + (value.is_object() ? "}" : "]");
}

}  // namespace

Error Place::expected(const std::string& allowed, const Json& value) const {
    return error(fmt::format("must be {}, got {}", allowed, shown(value)));
}

std::string shown(const Json& value) {
    std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return text;
}

Json parse_json(std::string_view text, const std::string& file) {
    std::vector<std::set<std::string>> keys;
    std::string twice;
    const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
        if (depth > deepest) throw Error(fmt::format("{}: objects and lists must be nested at most {} deep", file, deepest));
        if (event == Json::parse_event_t::object_start) keys.emplace_back();
        if (event == Json::parse_event_t::object_end) keys.pop_back();
        if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second && twice.empty())
            twice = value.get<std::string>();
        return true;
    };
    try {
        Json document = Json::parse(text, watch, true, true);
        if (!twice.empty()) throw Error(fmt::format("{}: the key \"{}\" is given twice in one object", file, twice));
        return document;
    } catch (const nlohmann::json::parse_error& e) {
        throw Error(fmt::format("{}:{}: {}", file, line_and_column(text, e.byte), plain(e)));
    } catch (const nlohmann::json::exception& e) {  // a number that no double holds
        throw Error(fmt::format("{}: {}", file, e.what()));
    }
}

std::string pretty(const Json& value) {
    std::string out;
    write(value, 0, out);
    return out + "\n";
}

}  // namespace carom
