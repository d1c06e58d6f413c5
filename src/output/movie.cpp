#include <fmt/format.h>

#include <carom/output.hpp>
#include <cmath>
#include <iterator>
#include <sstream>

#include "output/paint.hpp"
#include "output/process.hpp"

namespace carom {
namespace {

// The colours of the screen, told to the player; white where a side is odd, which these formats cannot have.
constexpr const char* even_and_bt709 =
    "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";
// A palette for every frame: one for all would keep all frames in memory until the last.
constexpr const char* palette_per_frame =
    "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=none";

std::string encoder(const std::filesystem::path& path) {
    const auto ending = path.extension();
    if (ending == ".gif") return fmt::format("-filter_complex {} -f gif", palette_per_frame);
    const auto picture =
        fmt::format("-vf {} -colorspace bt709 -color_primaries bt709 -color_trc bt709", even_and_bt709);
    if (ending == ".mp4") return picture + " -c:v libx264 -crf 18 -movflags +faststart -f mp4";
    if (ending == ".webm") {
        return picture + " -c:v libvpx-vp9 -crf 30 -b:v 0 -deadline realtime -cpu-used 7 -row-mt 1 -f webm";
    }
    throw Error(fmt::format("{}: a film ends with .mp4, .webm or .gif", path.string()));
}

std::vector<std::string> command(const File& file, const View& view, double rate) {
    // -xerror: or a disk that is full at the end of a film would be reported by nobody.
    std::istringstream line(
        fmt::format("ffmpeg -hide_banner -loglevel error -xerror -y -f rawvideo -pixel_format bgra "
                    "-video_size {}x{} -framerate {} -i pipe:0 -fflags +bitexact -flags +bitexact {}",
                    view.width, view.height, rate, encoder(file.target())));
    std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
    words.push_back(file.temporary().string());
    return words;
}

File checked(const std::filesystem::path& path, const View& view, double rate) {
    check(view);
    check_film(path, rate);
    return File(path);
}

}  // namespace

void check_film(const std::filesystem::path& path, double rate) {
    encoder(path);
    if (!(rate > 0) || !std::isfinite(rate)) throw Error(fmt::format("{} frames per second: must be > 0", rate));
    if (path.extension() == ".gif" && rate > 50)
        throw Error(
            fmt::format("{}: {} frames per second: a GIF has 50 at most, as it tells hundredths of a second and "
                        "players slow down what is shown for less than two; .mp4 and .webm have more",
                        path.string(), rate));
}

struct Movie::State {
    State(const std::filesystem::path& path, const View& v, double rate)
        : view(v),
          file(checked(path, v, rate)),
          surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, v.width, v.height), &cairo_surface_destroy),
          cairo(cairo_create(surface.get()), &cairo_destroy),
          ffmpeg(command(file, v, rate), "films") {}

    void check_open() const;
    void remember(const World& world);
    void send();

    View view;
    File file;  ///< before ffmpeg, which must have ended when the file is removed
    std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface;
    std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo;
    Process ffmpeg;
    std::map<BodyId, Trail> trails{};
    std::uint64_t frames = 0;
    bool whole = false;
};

void Movie::State::check_open() const {
    if (whole) throw Error(fmt::format("{}: the film is whole already", file.target().string()));
}

void Movie::State::remember(const World& world) {
    if (view.trail <= 0) return;
    const auto ids = world.ids();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        auto [place, fresh] = trails.try_emplace(ids[i]);
        Trail& trail = place->second;
        if (fresh) trail.colour = fill_of(world.body(ids[i]), ids[i]);
        trail.places.emplace_back(world.time(), world.positions()[i]);
    }
    for (auto it = trails.begin(); it != trails.end();) {
        auto& places = it->second.places;
        while (!places.empty() && places.front().first < world.time() - view.trail) places.pop_front();
        it = places.empty() ? trails.erase(it) : std::next(it);
    }
}

void Movie::State::send() {
    cairo_surface_flush(surface.get());
    const auto* bytes = reinterpret_cast<const char*>(cairo_image_surface_get_data(surface.get()));
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
    const auto row = 4 * static_cast<std::size_t>(view.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(view.height); ++y) ffmpeg.write({bytes + y * stride, row});
}

Movie::Movie(const std::filesystem::path& path, const View& view, double rate)
    : state_(std::make_unique<State>(path, view, rate)) {}
Movie::Movie(Movie&&) noexcept = default;
Movie::~Movie() = default;

void Movie::add(const World& world) {
    state_->check_open();
    state_->remember(world);
    state_->view = centred(state_->view, world);
    Painter(state_->cairo.get(), state_->view).paint(world, &state_->trails);
    state_->send();
    ++state_->frames;
}

void Movie::commit() {
    state_->check_open();
    if (state_->frames == 0) throw Error(fmt::format("{}: a film without a frame", state_->file.target().string()));
    state_->ffmpeg.finish();
    state_->file.commit();
    state_->whole = true;
}

}  // namespace carom
