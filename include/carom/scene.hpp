#pragma once
// Scene files: versioned JSON (schema: `carom schema`), comments allowed. Any number may be an expression in quotes.

#include <carom/gas.hpp>
#include <carom/world.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace carom {

/// What an expectation looks at.
enum class Statistic : std::uint8_t { end, maximum, minimum, mean, zero };
constexpr auto choices(const Statistic*) {
    return std::array{Choice<Statistic>{"end", Statistic::end, "the value at the end of the run, or at the time given"},
                      Choice<Statistic>{"maximum", Statistic::maximum, "the largest value of the run"},
                      Choice<Statistic>{"minimum", Statistic::minimum, "the smallest value of the run"},
                      Choice<Statistic>{"mean", Statistic::mean, "the mean over time"},
                      Choice<Statistic>{"zero", Statistic::zero, "the time [s] at which the value changes its sign"}};
}

/// What a scene claims about itself.
struct Expectation {
    std::string quantity{};
    double value = 0;
    double tolerance = 0;
    bool relative = false;
    Statistic statistic = Statistic::end;
    std::optional<double> at{};
    int number = 1;
    std::string text{};
    std::string source{};
};
constexpr std::string_view describe(const Expectation*) {
    return "A number that the run must give, and with what tolerance.";
}
template <std::same_as<Expectation> T>
constexpr auto fields(const T*) {
    return std::tuple{
        needed(
            field(
                "quantity", &T::quantity,
                "expression of t, <body>.x .y .vx .vy .angle .omega .speed ('a b'.x if the name has more than letters, "
                "digits and _; a quote in it is written twice), of what a joint does to its body b <joint>.force "
                ".force.x .force.y .torque .coordinate "
                ".gap, energy.<account>, energy.heat.<cause>, energy.heat.total, energy.work.<cause>, "
                "energy.work.total, "
                "energy.total, energy.initial_total (guide/08-energy.md), "
                "momentum.x .y, angular_momentum, collisions, bodies, steps, of a gas under 'events' "
                "gas.disc_collisions, gas.wall_collisions, gas.virial, gas.wall_impulse, "
                "gas.made_elastic, gas.moved_apart, and the parameters; at the end of the run also the measures of a "
                "gas "
                "under 'events', gas.temperature, gas.mean_speed, gas.pressure, gas.wall_pressure, gas.collision_rate, "
                "gas.mean_free_path, gas.diffusion, and the standard error of each, as gas.pressure.error"),
            "what is expected to have a value"),
        needed(field("value", &T::value, "", any, "what is expected, in SI units"),
               "what the quantity is expected to be"),
        field("tolerance", &T::tolerance, "", non_negative, "largest error that is allowed"),
        field("relative", &T::relative, "the tolerance is a fraction of the value"),
        field("statistic", &T::statistic, "what is looked at"),
        field(
            "at", &T::at, "s", non_negative,
            "time within the run at which the value is taken, or up to which the other statistics look; if absent the "
            "end"),
        field("number", &T::number, "", Range{1, 1e9, false, "a whole number >= 1"},
              "which change of sign, for the statistic zero"),
        field("text", &T::text, "what the number means, in words"),
        field("source", &T::source,
              "where the value is from: a formula, a book, a paper; in Carom's own scenes a name like mech.pendulum[0] "
              "is an "
              "entry of tests/reference/truth.json (guide/09-expectations.md)")};
}

/// An expectation after the run.
struct Verdict {
    Expectation expectation;
    double value = 0;
    bool ok = false;
    bool judged = true;  ///< false: the run ended before it could be
};

enum class PictureType : std::uint8_t { trajectories, time, phase, energy, snapshots, profile, twin, gas };
constexpr auto choices(const PictureType*) {
    return std::array{
        Choice<PictureType>{"trajectories", PictureType::trajectories, "paths of bodies in the plane"},
        Choice<PictureType>{"time", PictureType::time, "quantities against time"},
        Choice<PictureType>{"phase", PictureType::phase, "the second quantity against the first"},
        Choice<PictureType>{"energy", PictureType::energy, "energy by account against time, with the residual below"},
        Choice<PictureType>{"snapshots", PictureType::snapshots, "the bodies at several times, at their true size"},
        Choice<PictureType>{
            "profile", PictureType::profile,
            "density, flow and temperature of the bodies along the longer side of the room, at several times"},
        Choice<PictureType>{
            "gas", PictureType::gas,
            "speeds beside Maxwell's, pair correlation, mean squared displacement, autocorrelation of the velocity"},
        Choice<PictureType>{"twin", PictureType::twin,
                            "the scene's twins: quantities beside their closed forms, with the errors "
                            "below; drawn if not listed, too"}};
}

struct Picture {
    PictureType type = PictureType::trajectories;
    std::string name{};
    std::string title{};
    std::vector<std::string> bodies{};
    std::vector<std::string> quantities{};
    std::vector<double> at{};
    std::optional<double> from{};
    std::optional<double> until{};
    std::string unit{};
    bool change = false;
    std::optional<double> period{};
};
constexpr std::string_view describe(const Picture*) { return "A picture that `carom plot` draws of the run."; }
template <std::same_as<Picture> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("type", &T::type, "what it shows"),
        field(
            "name", &T::name,
            "file name without ending; if absent that of the type. A second one of a name gets -2, and so does `end`, "
            "which a run has of its own"),
        field("title", &T::title, "title above the picture; if absent the scene's"),
        field("bodies", &T::bodies, "names of the bodies shown; if absent all, or twenty from among more"),
        field("quantities", &T::quantities,
              "expressions shown, as in an expectation; of a twin picture, those of the "
              "scene's twins that are shown, all if absent"),
        field("at", &T::at, "s", non_negative, "times of the snapshots or profiles, within the run"),
        field("from", &T::from, "s", positive, "of a time or phase picture: what comes earlier is not shown"),
        field("until", &T::until, "s", positive, "what comes later is not shown"),
        field("unit", &T::unit, "unit of the quantities, for the axis"),
        field("change", &T::change,
              "of an energy or time picture: show the change since its start, for where it is small beside the whole"),
        field("period", &T::period, "s", positive,
              "of a phase picture: show a point each time that this has passed, as the period of a drive, and no curve "
              "(a Poincaré section); a whole number of frames")};
}

/// A quantity whose motion has a formula.
struct Twin {
    std::string quantity{};
    std::string formula{};
    std::optional<double> until{};
    std::string unit{};
    std::string source{};
};
constexpr std::string_view describe(const Twin*) { return "A quantity, and the closed form it is held against."; }
template <std::same_as<Twin> T>
constexpr auto fields(const T*) {
    return std::tuple{needed(field("quantity", &T::quantity, "expression of the world, as in an expectation"),
                             "what is held against a formula"),
                      needed(field("formula", &T::formula,
                                   "its closed form: an expression of t and the parameters; there are functions for "
                                   "many (closed-forms.md)"),
                             "the quantity's closed form"),
                      field("until", &T::until, "s", positive, "what comes later is not compared"),
                      field("unit", &T::unit, "of both, for the picture"),
                      field("source", &T::source, "where the formula is from")};
}

/// A twin after the run.
struct TwinError {
    Twin twin;
    double largest = 0;  ///< difference of quantity and formula at any time
    double end = 0;      ///< the last
};

struct Plan {
    double duration = 10;
    double step = 1.0 / 60;
    int every = 1;
    double measure_from = 0;
};
constexpr std::string_view describe(const Plan*) { return "How long the scene runs, and in what steps."; }
template <std::same_as<Plan> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("duration", &T::duration, "s", non_negative, "time that is simulated"),
        field("step", &T::step, "s", positive, "length of a step"),
        field("every", &T::every, "", Range{1, 1e9, false, "a whole number >= 1"},
              "number of steps from one row of data, or frame, to the next"),
        field("measure_from", &T::measure_from, "s", non_negative,
              "time at which the measures of a gas under 'events' begin, after it has forgotten its start")};
}

/// A scene file: a document, and the world that it describes. Loading checks that it is JSON, that its top-level keys
/// are known, and its parameters, settings, run, expectations, twins and pictures. Its walls, bodies, builders, joints
/// and forces are checked by world().
class Scene {
  public:
    /// Reads a file, and checks what can be checked without making the world. An Error names the file, or what `name`
    /// calls it, the place in it, the value and what is allowed.
    static Scene load(const std::filesystem::path& file, const std::string& name = "");
    /// The same for a scene that is changed by set() before it is run: does not check that times lie within the run,
    /// which check_times() does.
    static Scene read(const std::filesystem::path& file, const std::string& name = "");
    /// The same from a text; `name` stands for the file in errors. Does not check that times lie within the run either:
    /// the text may be that of a scene whose run was made shorter by set().
    static Scene parse(std::string_view text, const std::string& name = "scene");
    /// The world as it is now, as a scene. An Error if there is anything that cannot be saved: the user's functions
    /// (C++ forces, curves), and names that are not UTF-8.
    static Scene of(const World& world, const std::string& title = "");
    Scene(const Scene&);
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene) noexcept;
    ~Scene();

    /// Gives a parameter, or any place of the document ("seed", "world.gravity", "bodies.ball.mass",
    /// "builders[0].count"), another value: JSON, or an expression, in UTF-8. After an Error the scene is as it was.
    /// What only the world can judge, such as a body's mass, is checked by world().
    void set(const std::string& name, const std::string& value);

    /// An Error if expectations or pictures look at something after the end of the run, or after the later end [s] that
    /// it had before somebody made it shorter.
    void check_times(double end = 0) const;

    /// What stands for the file in errors.
    std::string file() const;
    std::string title() const;
    std::string teaches() const;
    int seed() const;
    Plan plan() const;
    std::vector<Expectation> expectations() const;
    std::vector<Twin> twins() const;
    std::vector<Picture> pictures() const;
    std::map<std::string, double> parameters() const;
    /// Makes the world. An Error if the document does not make sense, naming the place.
    World world() const;
    /// The bodies that the scene puts elsewhere than where the curves that drive them begin, in words; empty if it puts
    /// none. `start` is its world.
    std::string put_off_curves(const World& start) const;
    /// The document, in canonical form: parse(text()).text() == text().
    std::string text() const;

  private:
    struct Document;
    explicit Scene(std::unique_ptr<Document> document);
    std::unique_ptr<Document> document_;
};

/// JSON Schema (draft 7) of scene files.
std::string scene_schema();
/// Reference pages in Markdown, by file name: every field of every public struct with unit, range and meaning.
std::map<std::string, std::string> reference_pages();

/// How many steps a run of this plan makes; the last one may be shorter.
std::uint64_t steps_of(const Plan& plan);

/// An expression of a world's bodies and accounts.
class Quantity {
  public:
    /// Names that are no body, account or parameter are an Error with the nearest name. Those of a gas's measures are
    /// one, too: they are of a run and not of a moment. `at_end`: of the run, where they are known.
    Quantity(const std::string& expression, const World& world, const std::map<std::string, double>& parameters = {},
             bool at_end = false);
    Quantity(Quantity&&) noexcept;
    ~Quantity();
    /// A measure that is not among those given is NaN.
    double operator()(const World& world, const std::vector<GasNumber>& measures = {}) const;
    /// Whether a measure is named.
    bool needs_measures() const;
    /// What it names, but parameters: "ball.x", without quotes, each once.
    const std::vector<std::string>& names() const;

  private:
    struct Compiled;
    std::unique_ptr<Compiled> compiled_;
};

/// The name of a body or a joint as an expression takes it: in 'single quotes', and a quote in it twice, if it has more
/// than letters, digits and _ . [ ] or begins with a digit.
std::string in_expression(const std::string& name);

/// A closed form: an expression of t and the parameters.
std::function<double(double t)> closed_form(const std::string& expression,
                                            const std::map<std::string, double>& parameters);

/// Watches a run beside its closed forms.
class Twins {
  public:
    Twins(const Scene& scene, const World& start);
    Twins(Twins&&) noexcept;
    ~Twins();
    /// To be called after every step.
    void observe(const World& world);
    std::vector<TwinError> errors() const;
    /// What was seen so far, for checkpoints.
    void save(Saver& to) const;
    void restore(Loader& from);

  private:
    struct Pair;
    std::vector<std::unique_ptr<Pair>> pairs_;
};

/// Watches a run and judges it by what its scene expects.
class Judge {
  public:
    Judge(const Scene& scene, const World& start);
    Judge(Judge&&) noexcept;
    ~Judge();
    /// To be called after every step.
    void observe(const World& world);
    /// Of a run that was cut short, only what was decided by then is judged.
    std::vector<Verdict> verdicts(bool cut_short = false) const;

    /// What was seen so far, for a checkpoint, and back into the judge of the same scene.
    void save(Saver& to) const;
    void restore(Loader& from);

  private:
    struct Watch;
    std::vector<std::unique_ptr<Watch>> watches_;
    Plan plan_;
    std::optional<GasMeter> meter_{};  ///< if a measure is expected
    std::uint64_t seen_ = 0;           ///< steps
};

}  // namespace carom
