#pragma once
#include <algorithm>
#include <array>
#include <carom/field.hpp>
#include <cstdint>
#include <optional>
#include <variant>

// The contact solvers. Each is a struct of its own options; its method is in src/solvers/ and docs/theory/.

namespace carom {

struct Impulse {
    bool time_of_impact = true;
    bool disc_collisions = true;
    static constexpr const char* name = "impulse";
};
constexpr std::string_view describe(const Impulse*) {
    return "Collisions of discs and walls by impulses (the textbook's).";
}
template <std::same_as<Impulse> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field(
            "time_of_impact", &T::time_of_impact,
            "true: bounces happen at the instant of impact; false: the textbook's, discs that overlap after a step are "
            "pushed apart by half the overlap each and exchange their normal velocities, pairs in index order"),
        field("disc_collisions", &T::disc_collisions, "discs collide with one another, and not only with walls")};
}

/// Which islands of contacts SoftStep solves as a whole.
enum class Precise : std::uint8_t { never, some, all };
constexpr auto choices(const Precise*) {
    return std::array{
        Choice<Precise>{"never", Precise::never,
                        "none: every step is quick, as games need it, but heavy loads sink in"},
        Choice<Precise>{"some", Precise::some,
                        "those of up to 20 bodies in which masses of more than 10 : 1 touch; those of up to 100 in "
                        "which a load would press bodies deeper into one another than 1/1000 of their size, as long as "
                        "the solve is quick; and in a small world up to four bodies on their own"},
        Choice<Precise>{"all", Precise::all, "all of up to 100 bodies, however long it takes"}};
}

struct SoftStep {
    int substeps = 4;
    Precise precise = Precise::some;
    bool sleep = true;
    std::optional<double> sleep_speed{};
    bool statics = true;
    bool keep_energy = false;
    static constexpr const char* name = "softstep";
};
constexpr std::string_view describe(const SoftStep*) {
    return "Stacks, piles and bounces of bodies of any shape, by soft constraints in substeps.";
}
template <std::same_as<SoftStep> T>
constexpr auto fields(const T*) {
    return std::tuple{field("substeps", &T::substeps, "", Range{1, 1000, false, "a whole number from 1 to 1000"},
                            "number of substeps of every step; forces and contacts are solved in each. Where loads "
                            "would press bodies deep into one another, two or four times as many are taken, but for "
                            "crowds that are stirred"),
                      field("precise", &T::precise,
                            "which islands have all their contacts solved together, to rounding (jammed ones to 1e-6 "
                            "of the largest speed), instead of by sweeps from contact to contact"),
                      field("sleep", &T::sleep,
                            "bodies at rest on which nothing acts but gravity, constant forces and contacts are "
                            "skipped until something disturbs them"),
                      field("sleep_speed", &T::sleep_speed, "m/s", positive,
                            "bodies that are slower than this for half a second, with all that touch them, are taken "
                            "to be at rest, and the energy that they still had is booked as residual; if absent a "
                            "millionth of the speed that gravity gives in a step. With a larger value crowds that "
                            "would creep for a long time fall asleep, and so do bodies that lie still without gravity"),
                      field("statics", &T::statics,
                            "where nothing moves, the solver looks for forces in contacts and joints that hold all "
                            "bodies exactly where they are; if there are any the bodies are skipped until something "
                            "disturbs them, whether bodies sleep or not; if there are none they settle"),
                      field("keep_energy", &T::keep_energy,
                            "for bodies that hang on joints and touch nothing, the energy that the method gains or "
                            "loses in a substep is taken from their motion or given back to it, where it is small; "
                            "with integrators of order 2 and higher")};
}

struct Events {
    std::optional<double> restitution_speed{};
    double collapse = 1e-4;
    int seed = 1;
    bool relax = false;
    int substeps = 4;
    static constexpr const char* name = "events";
};
constexpr std::string_view describe(const Events*) {
    return "The exact gas: free discs move from collision to collision, whatever the step. All other bodies are moved "
           "among them in time steps.";
}
template <std::same_as<Events> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("restitution_speed", &T::restitution_speed, "m/s", positive,
              "if given, restitution e depends on the approach speed u as for viscoelastic bodies: 1 − e grows with "
              "the fifth root of u, and at this speed e is the bodies' own restitution"),
        field("collapse", &T::collapse, "", Range{1e-12, 1e-2, false, "a number from 1e-12 to 0.01"},
              "a disc that flies less than this fraction of its radius between impacts nine times in a row, or less "
              "than 1/10000 of that once, bounces elastically, with friction of its own weight alone: without such a "
              "rule inelastic discs collide infinitely often in a finite time"),
        field("seed", &T::seed, "", Range{0, 2147483647, false, "a whole number from 0 to 2147483647"},
              "seed of the random numbers of thermal walls"),
        field("relax", &T::relax,
              "true: discs that overlap at the start, or lie outside the room, are moved until none does; false: they "
              "are an error that names them"),
        field("substeps", &T::substeps, "", Range{1, 1000, false, "a whole number from 1 to 1000"},
              "number of substeps of every step for bodies that are not free discs: those with shapes, springs, joints "
              "or forces of their own, which move among the gas as under 'softstep'")};
}

/// What the solver 'events' counted since the start of the world.
struct GasTally {
    std::uint64_t disc_collisions = 0;  ///< between two discs
    std::uint64_t wall_collisions = 0;  ///< with walls and with bodies that are not discs of the gas
    std::uint64_t made_elastic = 0;     ///< how many of them the rule against inelastic collapse made elastic
    double virial = 0;        ///< Σ distance of the centres × impulse over the collisions of two discs [J s]
    double wall_impulse = 0;  ///< Σ impulse across the wall over the collisions with walls [N s]
    double moved_apart = 0;   ///< the farthest that the option `relax` moved a disc [m]

    void operator+=(const GasTally& other) {
        disc_collisions += other.disc_collisions, wall_collisions += other.wall_collisions;
        made_elastic += other.made_elastic;
        virial += other.virial, wall_impulse += other.wall_impulse;
        moved_apart = std::max(moved_apart, other.moved_apart);
    }
};

struct NoContact {
    static constexpr const char* name = "none";
};
constexpr std::string_view describe(const NoContact*) { return "Nothing collides: forces alone."; }

using Solver = std::variant<Impulse, SoftStep, Events, NoContact>;

}  // namespace carom
