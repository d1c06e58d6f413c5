#pragma once
// What a run leaves on the disk.

#include <filesystem>

#include "experiment.hpp"

namespace carom::app {

struct Products {
    std::filesystem::path csv{};     ///< every body's motion; none if empty
    std::filesystem::path folder{};  ///< for pictures; none if empty
    std::string format = "png";      ///< of the pictures
    bool report = false;             ///< into the folder: motion, report, scene and the last picture too
};

struct Performance {
    Result result;
    std::vector<std::filesystem::path> files;
};
/// Runs a scene and writes what is wanted. After an interruption or a failure too: what there is, is written.
Performance perform(const Scene& scene, const std::string& label, const Products& wanted);

/// Makes the folder; an Error with the reason if that cannot be.
void make_folder(const std::filesystem::path& folder);
/// Writes a whole file.
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace carom::app
