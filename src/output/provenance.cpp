#include "output/provenance.hpp"

#include <fmt/format.h>

#include <fstream>

namespace carom {

namespace {

constexpr std::string_view comment = "# carom.", pair = " carom_";

/// "name: value" into the text of that name.
void read_comment(std::string_view line, Provenance& to) {
    for (const auto& [name, text] : provenance_texts)
        if (line.starts_with(name) && line.substr(std::string_view(name).size()).starts_with(": "))
            to.*text = line.substr(std::string_view(name).size() + 2);
}

Provenance provenance_in_comments(std::istream& in) {
    Provenance out;
    for (std::string line; in.peek() == '#' && std::getline(in, line);)
        if (line.starts_with(comment)) read_comment(std::string_view(line).substr(comment.size()), out);
    return out;
}

/// The value of `key="value"` in a comment line of extended XYZ.
std::string value_in_xyz(const std::string& line, const std::string& key) {
    const auto start = line.find(key + "=\"");
    std::string value;
    if (start == std::string::npos) return value;
    for (std::size_t k = start + key.size() + 2; k < line.size() && line[k] != '"'; ++k) {
        if (line[k] == '\\' && k + 1 < line.size()) ++k;
        value += line[k];
    }
    return value;
}

std::optional<Provenance> provenance_in_xyz(std::istream& in) {
    std::string line;
    in.ignore(24, '\n');  // the number of bodies
    std::getline(in, line);
    Provenance out;
    for (const auto& [name, text] : provenance_texts) out.*text = value_in_xyz(line, std::string(pair) + name);
    return out.scene.empty() ? std::nullopt : std::optional(out);
}

/// Whether a file may be extended XYZ: a number on the first line, and on the second a pair of ours.
bool looks_like_xyz(std::string_view start) {
    const auto end = start.find('\n');
    return end != start.npos && end > 0 && start.find_first_not_of("0123456789") == end &&
           start.find('=', end) != start.npos;
}

}  // namespace

std::string on_one_line(const std::string& json) {
    std::string out;
    bool margin = false;
    for (const char c : json) {
        margin = c == '\n' || (margin && c == ' ');
        if (!margin) out += c;
    }
    return out;
}

std::string comment_lines(const Provenance& provenance) {
    std::string out;
    for (const auto& [name, text] : provenance_texts)
        if (!(provenance.*text).empty()) out += fmt::format("{}{}: {}\n", comment, name, on_one_line(provenance.*text));
    return out;
}

std::string xyz_pairs(const Provenance& provenance) {
    std::string out;
    for (const auto& [name, text] : provenance_texts) {
        if ((provenance.*text).empty()) continue;
        out += fmt::format("{}{}=\"", pair, name);
        for (const char c : on_one_line(provenance.*text)) {
            if (c == '"' || c == '\\') out += '\\';
            out += c;
        }
        out += '"';
    }
    return out;
}

std::optional<Provenance> provenance_of(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return {};
    std::ifstream in(file, std::ios::binary);
    std::string start(4096, '\0');
    in.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(in.gcount()));
    in.clear();
    in.seekg(0);
    if (start.starts_with(hdf5_magic)) return provenance_in_hdf5(file);
    if (start.starts_with(checkpoint_magic)) return provenance_in_checkpoint(file);
    if (start.starts_with(comment)) return provenance_in_comments(in);
    return looks_like_xyz(start) ? provenance_in_xyz(in) : std::nullopt;
}

}  // namespace carom
