#pragma once
// The laboratory's output: data files, figures, frames, films, a progress bar.
//
// Whatever is written appears under its name only when it is whole: until commit() (or the return of save and draw) it
// grows under a temporary name beside the target, and a file that was there before stays untouched. Every failure
// (no such directory, no permission, disk full, no gnuplot) is an Error with Cause::run in one line.

#include <carom/archive.hpp>
#include <carom/query.hpp>
#include <carom/world.hpp>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom {

class GasMeter;

// ---- Files ----------------------------------------------------------------------------------------------------------

/// How far a file had been written, for another process to go on with it.
struct Bookmark {
    std::string target{}, temporary{};  ///< absolute
    std::uint64_t length = 0;
    std::uint64_t tail = 0;  ///< hash of the last bytes up to there, by which the file is known again
};
auto members(Maybe_const<Bookmark> auto& b) {
    auto& [target, temporary, length, tail] = b;
    return std::tie(target, temporary, length, tail);
}

/// What a file says of its run near its start, and what it is to say from now on, for the run has become another one.
struct Revision {
    std::string before{}, after{};
};

/// A file that appears under its name when it is whole. A device or a pipe as target (/dev/stdout) is written directly.
class File {
  public:
    /// An Error if nothing can be written there. The temporary gets a name that no other process uses, unless one is
    /// given: then it is that, and what a killed process left there is overwritten.
    explicit File(const std::filesystem::path& target, const std::filesystem::path& temporary = {});
    /// Goes on where a file was bookmarked; what was written later is cut off. Works until commit() and after it, for
    /// then a copy goes on, and so it does if the start is to be revised: what was bookmarked stays until commit(). An
    /// Error if there is no such file any more.
    explicit File(const Bookmark& bookmark, const Revision& revision = {});
    File(File&& other) noexcept;
    File& operator=(File&&) = delete;
    /// Without commit(): removes what was written.
    ~File();

    /// Appends. After an Error nothing is left on the disk and the file takes no more.
    void write(std::string_view bytes);
    /// Gives the file its name. Nothing can be written afterwards.
    void commit();

    /// Itself, when all that was written can be read from the temporary.
    const File& flushed() {
        flush();
        return *this;
    }
    /// Waits until the disk has all that was written. From now on the bytes outlive this File without commit() too, and
    /// this process, for a checkpoint may hold the bookmark; until release().
    Bookmark sync();
    /// No bookmark is needed any more.
    void release() { kept_ = false; }

    /// Whether the target is a device or a pipe.
    bool is_direct() const { return direct_; }
    const std::filesystem::path& target() const { return target_; }
    /// Where the bytes are until commit(), for another program that writes them itself.
    const std::filesystem::path& temporary() const { return temporary_; }

  private:
    void open();
    void open_temporary();
    void flush();
    std::uint64_t tail(std::uint64_t length);
    bool reopen(const Bookmark& bookmark, const std::filesystem::path& path);
    void take_over();
    void go_on_in(const Bookmark& bookmark);
    void copy_from(int source, std::uint64_t length, const Revision& revision);
    std::string revised_start(int source, std::uint64_t& length, const Revision& revision);
    void discard() noexcept;
    void unlist();
    [[noreturn]] void fail(int error);
    std::filesystem::path target_, destination_, temporary_;
    std::filesystem::path superseded_;  ///< another unfinished file, which this one is needed instead of
    std::string buffer_;
    int descriptor_ = -1;
    bool direct_ = false;  ///< the target is no ordinary file: no temporary, no renaming
    bool kept_ = false;    ///< the temporary is not removed
    int listed_ = -1;      ///< where, among the unfinished
};

/// Removes the temporaries of all Files that are being written, but those that a bookmark may need, and ends the
/// programs that draw and film: for a handler of signals, before it ends the process at once. It calls nothing else
/// than unlink(2) and kill(2).
void remove_unfinished() noexcept;
/// Ends the drawing of a figure: save() throws an Error that says so. For a handler of signals, too.
void interrupt_figures() noexcept;

/// One column of a table. A unit of "" is a pure number or a text.
struct Column {
    std::string name;
    std::string unit{};
};

/// A table as comma-separated values (RFC 4180, lines end in \n), row by row: memory does not grow with the rows. The
/// first line is `name [unit],…`. Numbers are the shortest that read back as the same double. Lines that begin with `#
/// ` are comments.
class Csv {
  public:
    Csv(const std::filesystem::path& path, std::span<const Column> columns);
    Csv(const std::filesystem::path& path, std::initializer_list<Column> columns);
    /// In a file that may have something in it already: comments, or the first part of such a table.
    Csv(File file, std::span<const Column> columns, bool has_header);

    /// One row, of as many numbers and texts as there are columns; an Error otherwise.
    template <class... Cells>
    void row(const Cells&... cells) {
        (cell(cells), ...);
        end_row();
    }
    /// A row of numbers whose count is known only at run time.
    void row_of(std::span<const double> numbers);

    // The same, cell by cell.
    void cell(double number);
    void cell(std::signed_integral auto number) { integer(number); }
    void cell(std::unsigned_integral auto number) { natural(number); }
    void cell(std::string_view text);
    void cell(const char* text) { cell(std::string_view(text)); }
    void cell(const std::string& text) { cell(std::string_view(text)); }
    void end_row();

    /// The file gets its name. If a run fails half-way, commit() keeps the rows it made; without it they are removed.
    void commit();
    /// For comments between the rows, and for sync().
    File& file() { return file_; }

  private:
    void header(std::span<const Column> columns);
    void integer(long long number);
    void natural(unsigned long long number);
    void separate();
    void text(std::string_view words);
    File file_;
    std::string line_;
    std::size_t columns_ = 0, cells_ = 0;
};

/// What goes with the numbers of a run, so that the file alone can repeat it.
struct Provenance {
    std::string version{};                       ///< of Carom
    std::string build{};                         ///< compiler, settings and sources
    std::string seed{};                          ///< of all random numbers of the scene
    std::string scene{};                         ///< the document that was run, in JSON
    std::string summary{};                       ///< how it came out, in JSON; known at the end
    std::map<std::string, double> parameters{};  ///< of the scene
};
auto members(Maybe_const<Provenance> auto& p) {
    auto& [version, build, seed, scene, summary, parameters] = p;
    return std::tie(version, build, seed, scene, summary, parameters);
}
/// The lines of comments that say it in a CSV file, one for each text that there is: the summary's go to the end of the
/// table, all others before it.
std::string comment_lines(const Provenance& provenance);
/// The provenance in a file of Carom's: data in any format, or a checkpoint; none in any other file. An Error if the
/// file is damaged, or data of another program in such a format.
std::optional<Provenance> provenance_of(const std::filesystem::path& file);

enum class DataFormat : std::uint8_t { csv, xyz, h5md };
/// By the path's ending: .csv, .xyz or .extxyz, .h5 or .h5md; an Error for any other.
DataFormat data_format(const std::filesystem::path& path);

/// Every body's motion in a file, a frame for every add(); memory does not grow with the frames.
///
/// CSV: one row a body and frame, with time t [s], body, position x, y [m], angle [rad], velocity vx, vy [m/s] and
/// angular velocity omega [rad/s]. `body` is the name; of a nameless body its index, and .generation behind it if
/// another body of that index was removed. Positions are not wrapped into a periodic box.
/// XYZ: extended XYZ for OVITO, ASE and others; bodies in the plane z = 0.
/// H5MD 1.1: HDF5 with particles, observables and parameters; the measures of a gas are observables/gas. Written at
/// commit() from a temporary file beside it.
class Trajectory {
  public:
    Trajectory(const std::filesystem::path& path, DataFormat format, const World& world, Provenance provenance = {});
    /// Goes on at a bookmark. `before`: the provenance that the file has there, if it is to be another one.
    Trajectory(const Bookmark& bookmark, DataFormat format, const World& world, Provenance provenance = {},
               const Provenance* before = nullptr);
    Trajectory(Trajectory&&) noexcept;
    ~Trajectory();

    void add(const World& world);
    /// The file gets its name. It says of the run what is known now; H5MD has the measures of a gas, too.
    void commit(const std::string& summary = "", const GasMeter* measures = nullptr);
    /// As those of File.
    Bookmark sync();
    void release();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// ---- Checkpoints ----------------------------------------------------------------------------------------------------

/// Writes a checkpoint: it replaces the one before when all of it is on the disk.
void save_checkpoint(const std::filesystem::path& file, const Provenance& provenance,
                     const std::function<void(Saver&)>& save);
/// The temporary under which a checkpoint is written. Its name is always the same: who was killed leaves only one.
std::filesystem::path unfinished_checkpoint(const std::filesystem::path& file);
/// Whether a file is a checkpoint, whole or not, or the empty beginning of one: else to write one there would destroy
/// something.
bool may_become_checkpoint(const std::filesystem::path& file);
/// Why a checkpoint that is whole cannot be read.
class OtherVersion : public Error {
    using Error::Error;
};
/// What was saved, for a Loader. An Error in one line if the file is none, or damaged; OtherVersion.
std::string load_checkpoint(const std::filesystem::path& file);

/// Keeps a checkpoint to this process as long as it lives: it locks an empty file beside it, and removes that at the
/// end. An Error if another process has claimed it. Where nothing can be written nothing is claimed. One at a time: a
/// process does not see its own.
class CheckpointClaim {
  public:
    explicit CheckpointClaim(const std::filesystem::path& checkpoint);
    CheckpointClaim(const CheckpointClaim&) = delete;
    CheckpointClaim& operator=(const CheckpointClaim&) = delete;
    ~CheckpointClaim();

  private:
    std::filesystem::path file_;
    int descriptor_ = -1, listed_ = -1;
};
/// The file that is locked.
std::filesystem::path checkpoint_lock(const std::filesystem::path& checkpoint);

// ---- Colours --------------------------------------------------------------------------------------------------------

/// Colour number i of a palette that colour-blind readers can tell apart (Okabe and Ito 2008), from the start after 7.
Colour palette(std::size_t i);

// ---- Figures --------------------------------------------------------------------------------------------------------

enum class Stroke { line, dashed, dotted, points, line_and_points, ring };

/// A curve through (x[i], y[i]); an x or y that is not finite interrupts it.
struct Curve {
    std::string label{};  ///< its words in the legend; without one it is not mentioned there
    std::vector<double> x{}, y{};
    Stroke stroke = Stroke::line;
    Colour colour{};
    double width = 1;             ///< relative to the usual line
    std::vector<double> error{};  ///< of each y, drawn as a bar; none if empty, or where it is not finite
};

/// A disc drawn at its true size. Meant for panels of equal aspect.
struct DiscMark {
    Vec2 centre{};
    double radius = 0;  ///< in units of the axes; 0 is drawn as a dot
    Colour fill{};
    std::optional<double> angle{};  ///< of a radius that shows how it is turned [rad]
};

enum class Look : std::uint8_t { filled, line, dashed };

/// A line of points, or what it encloses, drawn at its true size. Meant for panels of equal aspect.
struct ShapeMark {
    std::vector<Vec2> points{};
    Look look = Look::filled;
    Colour colour{};
};
auto members(Maybe_const<ShapeMark> auto& m) {
    auto& [points, look, colour] = m;
    return std::tie(points, look, colour);
}

/// A straight line, in dark grey: the outline of a room, an axis.
struct Line {
    Vec2 from{}, to{};
};

struct Interval {
    double low = 0, high = 1;
};

/// A value at every point of a grid, as cells coloured by it beside a colour bar. A cell reaches half-way to its
/// neighbours.
struct HeatMap {
    std::vector<double> x{}, y{};  ///< of the columns and of the rows, each from low to high
    std::vector<double> values{};  ///< row by row; what is not finite stays white
    std::string label{};           ///< of the colour bar, with its unit
};

/// One system of axes. A label ends with its unit in brackets, `x [m]`: a common power of ten goes there, `x [10⁻⁶ m]`.
struct Panel {
    std::string title{}, x_label{}, y_label{};
    bool equal_aspect = false;                     ///< a metre is as long on both axes
    bool log_x = false, log_y = false;             ///< values that are not positive are left out
    std::optional<Interval> x_range{}, y_range{};  ///< if absent the data's
    bool empty = false;                            ///< nothing is drawn in its place
    double height = 1;                             ///< of the axes, relative to an ordinary panel's
    std::vector<Curve> curves{};
    std::vector<DiscMark> discs{};
    std::vector<ShapeMark> shapes{};
    std::vector<Line> lines{};
    std::vector<Line> endless{};  ///< drawn on beyond their two points, to the frame
    std::optional<HeatMap> map{};
};

struct Figure {
    std::string title{};
    std::vector<Panel> panels{};  ///< from left to right and then down
    std::size_t columns = 1;
    bool shared_x = false;  ///< panels of a column have one x axis, labelled below the lowest
    int width = 1000;       ///< pixels of a PNG, user units of an SVG, 1/144 inch of a PDF
    int height = 0;         ///< likewise; 0 is chosen by the panels
};

/// Draws with gnuplot to a PNG, SVG or PDF, by the path's ending; an Error if gnuplot is missing or fails, or if a
/// curve has more x than y. Text is printed as it is, whatever gnuplot might read into it.
void save(const Figure& figure, const std::filesystem::path& path);

/// The path of a body, for figures.
struct Track {
    std::string label{};
    std::vector<Vec2> points{};
    double radius = 0;                ///< of the body, drawn where it is at the end [m]
    std::vector<ShapeMark> shapes{};  ///< of the body at the end, if it is no disc
    std::optional<Colour> colour{};   ///< if absent the palette's next
};

/// Values over time, for figures.
struct Series {
    std::string label{};
    std::vector<double> values{};
    std::optional<Colour> colour{};  ///< if absent the palette's next
};

/// Bodies at an instant [s], for figures.
struct Moment {
    double time = 0;
    std::vector<DiscMark> discs{};
    std::vector<ShapeMark> shapes{};
    std::vector<Line> lines{};  ///< rods, ropes, springs, unless there are more than can be told apart, and round walls
};
auto members(Maybe_const<Moment> auto& m) {
    auto& [time, discs, shapes, lines] = m;
    return std::tie(time, discs, shapes, lines);
}

/// Averages over the bodies in each slice of a room at an instant [s], for figures; what no body tells is not a number.
struct Profile {
    double time = 0;
    std::vector<double> density{};      ///< bodies a m²
    std::vector<double> flow{};         ///< mean velocity along the room, by mass [m/s]
    std::vector<double> temperature{};  ///< k T: mean kinetic energy about the flow, a degree of freedom [J]
};
auto members(Maybe_const<Profile> auto& p) {
    auto& [time, density, flow, temperature] = p;
    return std::tie(time, density, flow, temperature);
}

// The pictures that a mechanics report needs. Lengths are in m, times in s, energies in J. Of curves of one colour the
// second is dashed and the third dotted.
/// Paths in the plane, each with an open ring at its start and the body at its end, in their room if there is one.
/// `around` is drawn with them, as what stands still and the springs at the end; of it what is larger than all paths
/// is cut off.
Figure trajectory_figure(std::span<const Track> tracks, const std::optional<Rectangle>& room = {},
                         std::span<const HalfPlane> walls = {}, const Moment& around = {});
/// Curves over time; y_label with its unit, such as `x [m]`.
Figure time_figure(std::span<const double> time, std::span<const Series> series, std::string y_label);
/// Velocity over position, one curve a body; labels with units.
Figure phase_figure(std::span<const Series> position, std::span<const Series> velocity, std::string x_label = "x [m]",
                    std::string v_label = "v [m/s]");
/// Total energy, every account that can be told from zero, and the numerical residual below. With `change` what the
/// accounts have changed since the first of the times, where that is small beside them.
Figure energy_figure(std::span<const double> time, std::span<const Energy> energy, bool change = false);
/// A panel for each moment, titled with its time, bodies at their true size.
Figure snapshot_figure(std::span<const Moment> moments, const std::optional<Rectangle>& room = {},
                       std::span<const HalfPlane> walls = {});
/// A heat map that fills its axes, which may be logarithmic.
Panel map_panel(HeatMap map, std::string x_label, std::string y_label, bool log_x = false, bool log_y = false);
/// Density, flow and temperature along the longer side of a room, a curve for each moment.
Figure profile_figure(std::span<const Profile> profiles, const Rectangle& room);
/// Simulated points on the analytic curve, their difference below; y_label with its unit.
Figure comparison_figure(std::span<const double> time, std::span<const double> simulated,
                         std::span<const double> analytic, std::string y_label);

/// The dynamic bodies of a world as they are now, in slices of one width across the longer side of a room; an Error if
/// there are no slices, or is no room.
Profile profile_of(const World& world, const Rectangle& room, std::size_t slices);
/// The bodies of a world as they are now, in the colours that draw() gives them, and hinges and pulleys.
Moment moment_of(const World& world);
/// What stays where it is while others move: fixed bodies, and hinges that do not move; lines_of the world as it is
/// now.
Moment surroundings_of(const World& world, std::span<const BodyId> shown = {});
/// Rods, ropes and springs as they are, from end to end (springs only up to 20 000 of them), and the rims of round
/// walls. If bodies are named, what joins others alone is left out, to each other or to what does not move.
std::vector<Line> lines_of(const World& world, std::span<const BodyId> shown = {});
std::vector<ShapeMark> shapes_of(const World& world, BodyId body);

// ---- Frames and films -----------------------------------------------------------------------------------------------

/// What is to be seen [m] and the size of the picture [pixels]. The rectangle is fitted in above a caption line, at the
/// same scale in x and y.
struct View {
    Vec2 low{0, 0}, high{1, 1};
    int width = 800, height = 600;
    double trail = 0;             ///< a Movie draws each body's path of the last `trail` seconds
    bool caption = true;          ///< a scale bar and the time, on a line below the scene
    bool angle_marks = true;      ///< a radius on every disc that can turn
    bool contact_forces = false;  ///< an arrow for each of two that press on one another, where they do
    std::vector<Track> tracks{};  ///< paths drawn below the bodies
    /// A body that is kept in the middle, before a grid of the plane; a periodic box goes on beyond its edges.
    std::optional<BodyId> follow{};

    /// Pixels per metre.
    double scale() const;
    /// Where a point of the world is in the picture, in pixels from the upper left corner.
    Vec2 pixel(Vec2 point) const;
};

/// Around the room if there is one, else around bodies, springs and the nearest part of the walls.
Bounds bounds(const World& world);
/// That, and around the arrows of forces as they are in a picture of that view; it shows a periodic box alone.
Bounds bounds_of_forces(const World& world, const View& view);
/// Around both: to film a motion that leaves the bounds of its start.
Bounds join(const Bounds& a, const Bounds& b);
/// A view with a little margin around the box, its longer side 800 pixels.
View fit(const Bounds& bounds);
View fit(const World& world);
/// The view with the body that it follows in its middle; as it is if it follows none, or one that is not there any
/// more.
View centred(View view, const World& world);

/// A picture of the world as it is now: PNG, SVG or PDF, by the path's ending.
void draw(const World& world, const View& view, const std::filesystem::path& path);

/// An Error if there is no such film: of another ending, or of more frames per second than its format tells.
void check_film(const std::filesystem::path& path, double rate);
/// A film, one frame per add(): .mp4, .webm or .gif by the path's ending. An Error if ffmpeg is missing or fails.
class Movie {
  public:
    /// `rate` in frames per second.
    Movie(const std::filesystem::path& path, const View& view, double rate = 30);
    Movie(Movie&&) noexcept;
    ~Movie();
    void add(const World& world);
    /// Finishes the film and gives it its name; an Error if it has no frame.
    void commit();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// ---- Progress -------------------------------------------------------------------------------------------------------

/// A line on the terminal: percent, bar, steps per second, time left. It appears after a second, only if `descriptor`
/// (standard error) is a terminal, and is gone at the end. Cheap enough to call after every step.
class Progress {
  public:
    explicit Progress(std::uint64_t total, std::string label, int descriptor = 2, std::string unit = "steps");
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { finish(); }
    /// `done` of `total` steps are done.
    void update(std::uint64_t done);
    /// Clears the line. The destructor does it too.
    void finish();

  private:
    using Clock = std::chrono::steady_clock;
    void show(std::uint64_t done, Clock::time_point now);
    std::uint64_t total_;
    std::string label_, unit_;
    int descriptor_;
    bool terminal_, shown_ = false;
    Clock::time_point start_, next_;
};

}  // namespace carom
