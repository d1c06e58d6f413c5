// carom render: a picture or a film of a run.

#include <fmt/format.h>

#include <algorithm>
#include <carom/output.hpp>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "outputs.hpp"

namespace carom::app {

namespace {

struct Arguments {
    std::string scene, file = "out.mp4";
    Overrides overrides;
    double rate = 30, speed = 1, trail = 0;
    std::string follow;
    std::optional<double> at, across;
    int width = 800;
    bool forces = false;
};

bool ends_with_one_of(const std::string& file, std::initializer_list<const char*> endings) {
    const std::string ending = std::filesystem::path(file).extension().string();
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

constexpr int least_side = 72;  // pixels: a caption, and as much above it

/// The same view, `width` pixels wide. A flat one has room above and below where it would be too low for a picture.
View scaled(View view, int width) {
    const double shape = (view.high.y - view.low.y) / (view.high.x - view.low.x);
    const double caption = view.height - view.width * shape;
    view.width = width;
    const int height = 2 * static_cast<int>(std::ceil(0.5 * (width * shape + caption)));  // films need even numbers
    view.height = std::max(least_side, height);
    return view;
}

/// A view that has a body in its middle: so wide as is asked for, or as what is seen at the start.
View following(const World& start, const Arguments& a) {
    constexpr double most_boxes = 10;  // beside each other, of a periodic room: each of them is drawn
    const auto box = start.periodic();
    if (box && a.across) {
        const double side = std::min(box->high.x - box->low.x, box->high.y - box->low.y);
        if (*a.across > most_boxes * side)
            throw Error(fmt::format("--across {}: of a periodic box of {} m allowed are {} m", *a.across, side,
                                    most_boxes * side));
    }
    const Vec2 half = a.across.value_or(0) / 2.16 * Vec2{1, 1 / 1.5};  // fit() adds 8 per cent
    View view = scaled(a.across ? fit(Bounds{-half, half}) : fit(start), a.width);
    // A box that is long and thin is seen with others above and below it.
    const Vec2 seen = view.high - view.low, of_box = box ? box->high - box->low : seen;
    if (seen.x * seen.y > most_boxes * most_boxes * of_box.x * of_box.y)
        throw Error(
            fmt::format("--follow {}: in {:.3g} x {:.3g} m the periodic box is seen too many times; --across {} "
                        "shows less",
                        a.follow, seen.x, seen.y, most_boxes * std::min(of_box.x, of_box.y)));
    try {
        view.follow = start.find(a.follow);
    } catch (const Error& e) {
        throw Error(fmt::format("--follow: {}", e.what()));
    }
    return view;
}

/// Follows bodies over the last seconds of a run, for a picture's trails.
class Trails {
  public:
    Trails(const World& start, double seconds) : seconds_(seconds) {
        for (std::size_t i = 0; i < start.size() && seconds > 0; ++i)
            if (start.kinds()[i] != Kind::fixed) bodies_.push_back(start.ids()[i]);
    }

    void observe(const World& world) {
        if (bodies_.empty()) return;
        auto& [time, places] = frames_.emplace_back(world.time(), std::vector<Vec2>{});
        for (const BodyId id : bodies_) places.push_back(world.position(id));
        while (frames_.front().first < world.time() - seconds_) frames_.pop_front();
    }

    /// In the colours of the bodies of `world`.
    std::vector<Track> tracks(const World& world) const {
        std::vector<Track> out(bodies_.size());
        for (std::size_t k = 0; k < out.size(); ++k) out[k].colour = world.body(bodies_[k]).colour;
        for (const auto& [time, places] : frames_)
            for (std::size_t k = 0; k < places.size(); ++k) out[k].points.push_back(places[k]);
        return out;
    }

  private:
    double seconds_;
    std::vector<BodyId> bodies_;
    std::deque<std::pair<double, std::vector<Vec2>>> frames_;
};

int picture(Scene& scene, const Arguments& a) {
    if (const double end = scene.plan().duration; a.at && *a.at > end)
        throw Error(fmt::format("--at {}: {} ends at {} s; --duration {} would run it so long", *a.at, scene.file(),
                                end, *a.at));
    if (a.at) scene.set("run.duration", fmt::format("{}", *a.at));
    scene.set("run.every", "1");
    const World start = scene.world();
    File(a.file);               // the disk is asked before the run, not after it
    std::optional<View> fixed;  // known before the run
    if (!a.follow.empty()) fixed = following(start, a);
    Trails trails(start, a.trail);
    Bounds seen = bounds(start);
    const auto observe = [&](const World& world) {
        trails.observe(world);
        if (a.trail > 0) seen = join(seen, bounds(world));
    };
    const Result result = run(scene, start, "render", {observe});
    if (!result.failure.empty()) return status_of(result);
    seen = join(seen, bounds(result.world));
    View view = fixed.value_or(scaled(fit(seen), a.width));
    // An arrow has so many pixels, and is longer in a view that has room for it: by less than the view's margin.
    if (a.forces && !fixed) view = scaled(fit(join(seen, bounds_of_forces(result.world, view))), a.width);
    view.contact_forces = a.forces;
    view.tracks = trails.tracks(result.world);
    draw(result.world, view, a.file);
    fmt::print("{}\n", a.file);
    say_interrupted(result, scene.plan());
    return result.interrupted ? 1 : 0;
}

/// Calls f(world) for every frame of the film, with the first step that has come to its time. Where that would be seen
/// to be late, a copy of the world goes there, and the run knows nothing of it. A step may have so many frames that
/// whoever interrupts would not wait for them.
template <class F>
Observer at_frames(const Arguments& a, const Plan& plan, F f) {
    const double apart = a.speed / a.rate;
    return [apart, plan, f, frame = 0](const World& world) mutable {
        for (bool more = true; more && has_come_to(frame * apart, world, plan); ++frame) {
            f(world);
            more = !was_interrupted();
        }
        const double next = std::min(world.time() + plan.step, plan.duration) - 1e-3 * plan.step;
        if (plan.step < apart / 4 || frame * apart >= next) return;
        for (World ahead = world; frame * apart < next && !was_interrupted(); ++frame) {
            try {
                ahead.step(frame * apart - ahead.time());
            } catch (const Error&) {
                return;  // the run will come to it as well, and say so
            }
            f(ahead);
        }
    };
}

/// Says how many frames there will be where that is hardly meant, and the speed of a film of ten seconds.
void warn_of_length(const Arguments& a, const Plan& plan) {
    const double frames = std::floor(plan.duration * a.rate / a.speed * (1 + 1e-12)) + 1;
    if (frames >= 2 && frames <= 1e5) return;
    fmt::print(stderr,
               "carom: note: {} will have {:.6g} frame{} of {:.6g} s; --speed {:.1g} makes a film of about 10 s\n",
               a.file, frames, frames == 1 ? "" : "s", plan.duration, plan.duration / 10);
}

/// Everything that is ever seen. A room or a periodic box does not change; else the scene is run for it, which costs
/// little beside the drawing.
Bounds bounds_of_film(const Scene& scene, const World& start, const Arguments& a) {
    Bounds seen = bounds(start);
    if (start.periodic() || !start.rectangles().empty() || !start.stadiums().empty()) return seen;
    constexpr double most = 16;  // looks at a step, which may have millions of frames
    Arguments looks = a;
    looks.speed = std::max(a.speed, scene.plan().step * a.rate / most);
    const Result result =
        run(scene, start, "look",
            {at_frames(looks, scene.plan(), [&seen](const World& world) { seen = join(seen, bounds(world)); })});
    if (result.interrupted) throw Error("interrupted before the first frame", Error::Cause::run);
    return seen;
}

int film(Scene& scene, const Arguments& a) {
    if (a.at) throw Error("--at is for pictures; the length of a film is set by --duration");
    check_film(a.file, a.rate);
    scene.set("run.every", "1");
    const World start = scene.world();
    File(a.file);  // a look at a whole run may come before the first frame
    warn_of_length(a, scene.plan());
    View view = a.follow.empty() ? scaled(fit(bounds_of_film(scene, start, a)), a.width) : following(start, a);
    view.trail = a.trail;
    view.contact_forces = a.forces;
    Movie movie(a.file, view, a.rate);
    const Result result =
        run(scene, start, "render", {at_frames(a, scene.plan(), [&](const World& world) { movie.add(world); })});
    movie.commit();
    fmt::print("{}\n", a.file);
    say_interrupted(result, scene.plan());
    return result.failure.empty() && !result.interrupted ? 0 : status_of(result);
}

/// What is asked for and will not be seen.
void warn_of_forces(const Scene& scene) {
    const Solver solver = scene.world().settings().solver;
    if (std::holds_alternative<SoftStep>(solver)) return;
    const std::string name = std::visit([](const auto& method) { return std::string(method.name); }, solver);
    fmt::print(
        stderr,
        "carom: note: --forces draws the forces at contacts, and the solver '{}' knows none, but blows; --solver "
        "softstep has them\n",
        name);
}

int render(const Arguments& a) {
    Scene scene = load(a.scene, a.overrides);
    if (a.forces) warn_of_forces(scene);
    check_folder(a.file);
    if (ends_with_one_of(a.file, {".png", ".svg", ".pdf"})) return picture(scene, a);
    if (ends_with_one_of(a.file, {".mp4", ".webm", ".gif"})) return film(scene, a);
    throw Error(fmt::format("--file {}: must end with .png, .svg or .pdf for a picture, .mp4, .webm or .gif for a film",
                            a.file));
}

}  // namespace

void add_render(CLI::App& program, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = program.add_subcommand("render", "Run a scene and draw it: a picture or a film");
    add_scene(*command, a->scene, a->overrides);
    for (const char* of_tables : {"--every", "--measure-from"})  // of which a picture has none
        command->remove_option(command->get_option(of_tables));
    command->add_option("-o,--file", a->file, "by its ending a picture (png, svg, pdf) or a film (mp4, webm, gif)")
        ->type_name("FILE")
        ->capture_default_str();
    command->add_option("--at", a->at, "a picture's time [s], within the run; if absent its end")
        ->check(in_range(non_negative))
        ->type_name("TIME");
    command->add_option("--trail", a->trail, "seconds of path drawn behind each body")
        ->check(CLI::Range(0.0, 1e9))
        ->type_name("TIME");
    CLI::Option* const follow =
        command->add_option("--follow", a->follow, "keep this body in the middle, before a grid of the plane")
            ->type_name("BODY");
    command->add_option("--across", a->across, "width of what is seen around it [m]; if absent that of the start")
        ->check(in_range(positive))
        ->needs(follow)
        ->type_name("LENGTH");
    command->add_flag("--forces", a->forces, "draw the forces at contacts, a mean weight by up to 40 pixels");
    command->add_option("--width", a->width, "of the picture [pixels]")
        ->check(CLI::Range(least_side, 7680))
        ->type_name("N")
        ->capture_default_str();
    command->add_option("--fps", a->rate, "frames per second of film")
        ->check(CLI::Range(1.0, 240.0))
        ->type_name("N")
        ->capture_default_str();
    command->add_option("--speed", a->speed, "seconds simulated per second of film")
        ->check(CLI::Range(1e-9, 1e9))
        ->type_name("X")
        ->capture_default_str();
    command->footer(
        "examples:\n"
        "  carom render scenes/gas.json --file gas.mp4 --speed 0.5 --trail 1\n"
        "  carom render scenes/gas.json --file gas.svg --at 3\n"
        "  carom render scenes/contacts/arch.json --file arch.png --forces\n"
        "  carom render scenes/joints/car.json --file car.mp4 --follow car --across 8");
    command->callback([a, &status] { status = render(*a); });
}

}  // namespace carom::app
