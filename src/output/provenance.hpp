#pragma once
#include <array>
#include <carom/output.hpp>
#include <utility>

namespace carom {

/// The texts of a provenance, by the names they have in files.
inline constexpr std::array provenance_texts{
    std::pair{"version", &Provenance::version}, std::pair{"build", &Provenance::build},
    std::pair{"seed", &Provenance::seed}, std::pair{"scene", &Provenance::scene},
    std::pair{"summary", &Provenance::summary}};

/// JSON on one line. Within its texts there are no line breaks.
std::string on_one_line(const std::string& json);

// The ways in which files have it, and how it is read again.
/// CSV: `# carom.seed: 1`, a line for each text that there is: comment_lines.
/// Extended XYZ: ` carom_seed="1"`, for each text that there is.
std::string xyz_pairs(const Provenance& provenance);

inline constexpr std::string_view hdf5_magic = "\x89HDF\r\n\x1a\n";
std::optional<Provenance> provenance_in_hdf5(const std::filesystem::path& file);

inline constexpr std::string_view checkpoint_magic = "carom checkpoint\n";
Provenance provenance_in_checkpoint(const std::filesystem::path& file);

}  // namespace carom
