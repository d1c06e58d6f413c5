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
constexpr auto fields(const Impulse*) {
    return std::tuple{
        field(
            "time_of_impact", &Impulse::time_of_impact,
            "true: bounces happen at the instant of impact; false: the textbook's, discs that overlap after a step are "
            "pushed apart by half the overlap each and exchange their normal velocities, pairs in index order"),
        field("disc_collisions", &Impulse::disc_collisions, "discs collide with one another, and not only with walls")};
}

/// Which islands of contacts SoftStep solves as a whole.
enum class Precise : std::uint8_t { never, some, all };
constexpr auto choices(const Precise*) {
    return std::array{
        Choice<Precise>{"never", Precise::never, "none: no step takes long, as games want it, and heavy loads sink in"},
        Choice<Precise>{"some", Precise::some,
                        "those of up to 20 bodies where masses of more than 10 : 1 meet, those of up to 100 in which a "
                        "load would press bodies deeper into one another than 1/1000 of their size, while that is soon "
                        "done, and in a small world up to four bodies on their own"},
        Choice<Precise>{"all", Precise::all, "all of up to 100 bodies, whatever it takes"}};
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
constexpr auto fields(const SoftStep*) {
    return std::tuple{
        field("substeps", &SoftStep::substeps, "", Range{1, 1000, false, "a whole number from 1 to 1000"},
              "number of parts that every step is cut into; forces and contacts are solved in each. Two or "
              "four times as many where loads press deep"),
        field("precise", &SoftStep::precise,
              "of which islands all contacts are solved together, to rounding, or where they are jammed to 1e-6 of the "
              "fastest, and not by sweeps from one to the next"),
        field("sleep", &SoftStep::sleep,
              "bodies at rest on which nothing acts but gravity, constant forces and contacts are left out of the work "
              "until something stirs them"),
        field("sleep_speed", &SoftStep::sleep_speed, "m/s", positive,
              "who is slower than that for half a second, with all that touch, is at rest, and what is left of the "
              "velocities is residual; if absent a millionth of what gravity gives in a step. With a larger one crowds "
              "fall asleep that would creep for long, and what lies where nothing pulls it"),
        field(
            "statics", &SoftStep::statics,
            "where nothing moves, forces are looked for with which contacts and joints hold everything as it is; with "
            "these it is left out of the work until something stirs it, whether bodies sleep or not; else it settles"),
        field("keep_energy", &SoftStep::keep_energy,
              "what the method makes or loses of the energy of bodies that hang on joints and touch nothing is taken "
              "from their motion in every substep, or given to it, where that is little; with integrators of second "
              "order and more")};
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
    return "The exact gas: free discs from collision to collision, whatever the step. Bodies that are no free discs "
           "are "
           "moved in steps among them.";
}
constexpr auto fields(const Events*) {
    return std::tuple{
        field(
            "restitution_speed", &Events::restitution_speed, "m/s", positive,
            "if given, restitution depends on the speed u of approach as that of viscoelastic bodies: what is lost, 1 "
            "− e, grows with the fifth root of u, and is the bodies' own 1 − e at this speed"),
        field("collapse", &Events::collapse, "", Range{1e-12, 1e-2, false, "a number from 1e-12 to 0.01"},
              "a disc that flies less than this part of its radius nine times in a row from impact to impact, or less "
              "than 1/10000 of that once, bounces elastically: without such a rule inelastic discs strike infinitely "
              "often in a finite time"),
        field("seed", &Events::seed, "", Range{0, 2147483647, false, "a whole number from 0 to 2147483647"},
              "of the random numbers of thermal walls"),
        field(
            "relax", &Events::relax,
            "discs that overlap at the start, or lie outside the room, are moved apart until none does; else they are "
            "refused by name"),
        field("substeps", &Events::substeps, "", Range{1, 1000, false, "a whole number from 1 to 1000"},
              "number of parts that every step is cut into for bodies that are no free discs: those with shapes, "
              "springs, joints or forces of their own, which are moved as by 'softstep' among the gas")};
}

/// What the solver 'events' counted since the start of the world.
struct GasTally {
    std::uint64_t disc_collisions = 0;  ///< of two discs
    std::uint64_t wall_collisions = 0;  ///< with walls and with all that is no disc of the gas
    std::uint64_t made_elastic = 0;     ///< of them, by the rule against inelastic collapse
    double virial = 0;        ///< Σ distance of the centres × impulse over the collisions of two discs [J s]
    double wall_impulse = 0;  ///< Σ impulse across the wall over the collisions with walls [N s]
    double moved_apart = 0;   ///< how far the option `relax` moved the farthest disc [m]

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
