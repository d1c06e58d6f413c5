#include "outputs.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace carom::app {

namespace fs = std::filesystem;

namespace {

/// One path for all the names of a file.
fs::path place_of(const fs::path& path) {
    std::error_code error;
    fs::path place = fs::weakly_canonical(fs::absolute(path, error), error);
    return error ? path : place;
}

/// What a run writes under names that are known before it.
std::vector<fs::path> names_of(const Products& wanted) {
    std::vector<fs::path> names;
    for (const DataFile& data : wanted.data) names.emplace_back(data.path);
    for (const std::string& table : wanted.tables) names.emplace_back(table);
    if (wanted.report) {
        const std::string end = "end." + wanted.format;
        for (const char* name : {"report.json", "scene.json", "measures.csv", "curves.csv", "fields.csv", end.c_str()})
            names.push_back(fs::path(wanted.folder) / name);
        if (wanted.data.empty()) names.push_back(fs::path(wanted.folder) / "trajectory.csv");
    }
    if (const std::string& file = wanted.checkpoints.file; !file.empty())
        names.insert(names.end(), {file, unfinished_checkpoint(file), checkpoint_lock(file)});
    return names;
}

/// A checkpoint replaces what is there, and is removed in the end where nothing can go on from it.
void check_checkpoint(const std::string& file) {
    for (const fs::path& path : {fs::path(file), unfinished_checkpoint(file)})
        if (fs::is_regular_file(path) && !may_become_checkpoint(path))
            throw Error(
                fmt::format("--checkpoint: {} is no checkpoint of Carom's and would be overwritten; name another "
                            "with file=FILE",
                            path.string()));
}

}  // namespace

std::string in_shell(const std::string& file) {
    const auto is_plain = [](char c) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        return letter || std::string_view("_-./:=@%+,").find(c) != std::string_view::npos;
    };
    if (std::all_of(file.begin(), file.end(), is_plain)) return file;
    std::string quoted = "'";
    for (const char c : file) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

void check_folder(const fs::path& file) {
    const fs::path folder = file.parent_path();
    std::error_code error;
    if (folder.empty() || fs::exists(folder, error) || error) return;
    throw Error(fmt::format("cannot write {}: No such file or directory: make the folder {} first", file.string(),
                            folder.string()),
                Error::Cause::run);
}

void check_outputs(const std::string& scene, const Products& wanted) {
    const std::vector<fs::path> names = names_of(wanted);
    std::vector<fs::path> places;
    const bool is_file = fs::is_regular_file(scene);  // and not standard input, which may be a terminal
    for (const fs::path& name : names) {
        if (name == "-")
            throw Error(
                "- is standard input, and no file to write: standard output has the report; name a file, as run.csv");
        const fs::path place = place_of(name);
        if (is_file && place == place_of(scene))
            throw Error(fmt::format("{} is the scene that is run, and would be overwritten", name.string()));
        if (std::find(places.begin(), places.end(), place) != places.end())
            throw Error(fmt::format("{} would be written twice", name.string()));
        places.push_back(place);
    }
    const fs::path made = wanted.report ? place_of(fs::path(wanted.folder) / "") : fs::path();
    const auto check = [&](const fs::path& file) {
        if (made.empty() || place_of(file.parent_path() / "") != made) check_folder(file);
    };
    for (const DataFile& data : wanted.data) check(data.path);
    for (const std::string& table : wanted.tables) check(table);
    if (!wanted.checkpoints.file.empty()) check_checkpoint(wanted.checkpoints.file);
}

}  // namespace carom::app
