#pragma once
// A trajectory in each of its formats. All have the same four functions.

#include <carom/output.hpp>
#include <fstream>
#include <unordered_map>

#include "output/observables.hpp"

namespace carom {

/// The box that bodies live in, if there is one.
struct Room {
    Vec2 low, high;
    bool periodic;
};
std::optional<Room> room_of(const World& world);

/// What a body is called in files whose ids are whole numbers. No two bodies of a run have the same: an index is used
/// again, but not its generation.
constexpr std::int64_t number_of(BodyId id) {
    return static_cast<std::int64_t>(id.index) +
           (static_cast<std::int64_t>(id.generation) - 1) * (std::int64_t{1} << 32);
}

/// `begun`: the file has frames already.
class CsvFrames {
  public:
    CsvFrames(File file, bool begun, const World& world, const Provenance& provenance);
    void add(const World& world);
    void commit(const Provenance& provenance, const GasMeter* measures);
    Bookmark sync() { return csv_.file().sync(); }
    void release() { csv_.file().release(); }

  private:
    struct Label {
        std::uint32_t generation;
        std::string text;
    };
    const std::string& label(const World& world, BodyId id);
    Csv csv_;
    std::unordered_map<std::uint32_t, Label> labels_{};
};

class XyzFrames {
  public:
    XyzFrames(File file, bool begun, const World& world, const Provenance& provenance);
    void add(const World& world);
    void commit(const Provenance& provenance, const GasMeter* measures);
    Bookmark sync() { return file_.sync(); }
    void release() { file_.release(); }

  private:
    void comment_line(const World& world);
    File file_;
    std::string box_{};         ///< how a frame says what box it has
    std::string provenance_{};  ///< until the first frame has it
    std::string text_{};        ///< storage
};

/// What frames of the same bodies share.
struct Cast {
    std::vector<BodyId> id{};
    std::vector<Kind> kind{};
    std::vector<double> mass{}, radius{}, charge{};
    std::vector<std::string> name{};
    bool operator==(const Cast&) const = default;
};
auto members(Maybe_const<Cast> auto& c) {
    auto& [id, kind, mass, radius, charge, name] = c;
    return std::tie(id, kind, mass, radius, charge, name);
}
Cast cast_of(const World& world);

/// An HDF5 file does not survive the death of its process. So frames go into a file of their own kind, which becomes
/// HDF5 at the end, frame by frame.
class H5mdFrames {
  public:
    H5mdFrames(File file, bool begun, const World& world, const Provenance& provenance);
    void add(const World& world);
    void commit(const Provenance& provenance, const GasMeter* measures);
    Bookmark sync() { return file_.sync(); }
    void release() { file_.release(); }

  private:
    File file_;
    std::optional<Room> room_;
    Cast known_{};  ///< of the last frame
};

// ---- What lies between a world and H5MD -----------------------------------------------------------------------------

struct RawFrame {
    struct Head {
        std::uint64_t step = 0;
        double time = 0;
        std::uint64_t bodies = 0;
        std::uint64_t cast_bytes = 0;  ///< of the Cast that follows; 0 if it is that of the frame before
        Observed observed{};
    } head;
    std::vector<Vec2> position{}, velocity{};
    std::vector<double> angle{}, angular_velocity{};
};

/// Reads the frames one after another.
class RawFrames {
  public:
    explicit RawFrames(const std::filesystem::path& path);
    /// The next one; false at the end. `cast` changes when it does.
    bool next(RawFrame& frame, Cast& cast);
    /// The same without its numbers.
    bool skip(RawFrame::Head& head, Cast& cast);

  private:
    bool begin(RawFrame::Head& head, Cast& cast);
    std::ifstream in_;
};

/// Makes the H5MD file of the frames in `raw`.
void write_h5md(const File& target, const std::filesystem::path& raw, const std::optional<Room>& room,
                const Provenance& provenance, const GasMeter* measures);

}  // namespace carom
