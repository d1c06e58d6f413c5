#pragma once
// What a run leaves on the disk.

#include <algorithm>
#include <carom/output.hpp>
#include <filesystem>

#include "experiment.hpp"

namespace carom::app {

struct DataFile {
    std::string path;
    DataFormat format;
    bool operator==(const DataFile&) const = default;
};
auto members(Maybe_const<DataFile> auto& d) {
    auto& [path, format] = d;
    return std::tie(path, format);
}

/// What --checkpoint asks for.
struct Checkpointing {
    std::string file{};       ///< if empty there are none
    std::uint64_t steps = 0;  ///< from one to the next; or, if 0,
    double seconds = 60;      ///< of the clock
    bool keep = false;        ///< at the end, too, what .h5 data need beside it to be made longer
};
auto members(Maybe_const<Checkpointing> auto& c) {
    auto& [file, steps, seconds, keep] = c;
    return std::tie(file, steps, seconds, keep);
}

struct Products {
    std::vector<DataFile> data{};           ///< every body's motion
    std::vector<std::string> tables{};      ///< files of the quantities over time
    std::vector<std::string> quantities{};  ///< expressions: columns of these, or only to be noted
    std::string folder{};                   ///< for pictures; none if empty
    std::string format = "png";             ///< of the pictures
    bool report = false;                    ///< into the folder: motion, report, scene and the last picture too
    Checkpointing checkpoints{};
    std::string resumed{};  ///< the checkpoint from which the run goes on, which is claimed already
    std::function<void(const Note&)>
        note{};                   ///< is told of what is most likely a mistake; without, nobody looks for it
    bool check_pictures = false;  ///< what is wrong with them is an error, drawn or not
    bool alone = true;            ///< else on one thread, beside other runs, and without a progress bar

    /// Whether a run that came to its end can be made longer with what it leaves. The frames of HDF5 are left as plain
    /// numbers, too, if that is asked for: they may be large.
    bool can_be_longer() const {
        const auto is_h5 = [](const DataFile& file) { return file.format == DataFormat::h5md; };
        return !checkpoints.file.empty() && (checkpoints.keep || std::none_of(data.begin(), data.end(), is_h5));
    }
};
auto members(Maybe_const<Products> auto& p) {
    auto& [data, tables, quantities, folder, format, report, checkpoints, resumed, note, check_pictures, alone] = p;
    return std::tie(data, tables, quantities, folder, format, report, checkpoints);
}

struct Performance {
    Result result;
    std::vector<std::filesystem::path> files;
};
/// Runs a scene and writes what is wanted. After an interruption or a failure too: what there is, is written. `state`
/// is that of a checkpoint from which the run goes on, and `before` the scene there, if this one has another end.
Performance perform(const Scene& scene, const std::string& label, const Products& wanted, const std::string& state = "",
                    const Scene* before = nullptr);

/// Makes the folder; an Error with the reason if that cannot be.
void make_folder(const std::filesystem::path& folder);
/// Writes a whole file.
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace carom::app
