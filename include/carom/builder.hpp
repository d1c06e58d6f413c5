#pragma once
// Many bodies at once. A builder only calls World::add: what it makes could be written by hand, one body at a time.

#include <carom/world.hpp>
#include <vector>

namespace carom {

/// What a builder made, in the order in which it was made. A builder that throws an Error has made nothing.
struct Built {
    std::vector<BodyId> bodies;
};

inline constexpr int most_built = 10'000'000;
inline constexpr Range built_count{1, most_built, false, "a whole number from 1 to 10000000"};
inline constexpr Range seed_range{0, 2147483647, false, "a whole number from 0 to 2147483647"};

/// Beads on springs. Its stiffness and damping are those of the material, so that the number of segments may change
/// and the rope stays the same: a segment of length ℓ has k = stiffness/ℓ and c = damping/ℓ.
struct Rope {
    std::optional<BodyId> a{}, b{};
    Vec2 anchor_a{}, anchor_b{};
    bool fixed_a = true, fixed_b = true;
    int segments = 10;
    double mass = 1;
    std::optional<double> rest_length{};
    double stiffness = 1000;
    double damping = 0;
    double radius = 0;
    std::string name{};
};
constexpr std::string_view describe(const Rope*) { return "A rope of beads and springs between two ends."; }
template <std::same_as<Rope> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("name", &T::name, "its beads are called name[0], name[1], ...; may be empty"),
        field("a", &T::a, "body that holds one end; if absent the end is at anchor_a in the world"),
        field("b", &T::b, "body that holds the other end; if absent the end is at anchor_b in the world"),
        field("anchor_a", &T::anchor_a, "m", any, "point of a, in its own frame, or of the world without a"),
        field("anchor_b", &T::anchor_b, "m", any, "point of b, in its own frame, or of the world without b"),
        field("fixed_a", &T::fixed_a, "without a: whether a fixed body holds this end, or nothing does"),
        field("fixed_b", &T::fixed_b, "without b: whether a fixed body holds this end, or nothing does"),
        field("segments", &T::segments, "", built_count, "number of springs"),
        field("mass", &T::mass, "kg", positive,
              "of the whole rope; each bead has the mass of half a segment on either side, and what holds an end takes "
              "the rest"),
        field("rest_length", &T::rest_length, "m", positive,
              "of the whole rope without force; if absent the distance of its ends"),
        field("stiffness", &T::stiffness, "N", non_negative, "force per relative stretch, E A"),
        field("damping", &T::damping, "N s", non_negative, "force per rate of relative stretch"),
        field("radius", &T::radius, "m", non_negative, "of the beads; at most half a segment")};
}

enum class Held : std::uint8_t { none, top, bottom, left, right, left_right, top_corners, corners, border };
constexpr auto choices(const Held*) {
    return std::array{Choice<Held>{"none", Held::none, "no node"},
                      Choice<Held>{"top", Held::top, "the highest row"},
                      Choice<Held>{"bottom", Held::bottom, "the lowest row"},
                      Choice<Held>{"left", Held::left, "the first column"},
                      Choice<Held>{"right", Held::right, "the last column"},
                      Choice<Held>{"left-right", Held::left_right, "the first and the last column"},
                      Choice<Held>{"top-corners", Held::top_corners, "two nodes"},
                      Choice<Held>{"corners", Held::corners, "four nodes"},
                      Choice<Held>{"border", Held::border, "all nodes of the rim"}};
}

struct Lattice {
    int nx = 10, ny = 10;
    Vec2 corner{};
    double spacing = 0.1;
    double mass = 0.01;
    double radius = 0;
    double stiffness = 1000;
    double shear_stiffness = 0;
    double bend_stiffness = 0;
    double damping = 0;
    Held held = Held::none;
    std::string name{};
};
constexpr std::string_view describe(const Lattice*) { return "A square lattice of nodes and springs: cloth, jelly."; }
template <std::same_as<Lattice> T>
constexpr auto fields(const T*) {
    return std::tuple{field("name", &T::name, "its nodes are called name[column][row], from name[0][0]; may be empty"),
                      field("nx", &T::nx, "", built_count, "number of columns"),
                      field("ny", &T::ny, "", built_count, "number of rows"),
                      field("corner", &T::corner, "m", any, "position of the lower left node"),
                      field("spacing", &T::spacing, "m", positive, "distance of neighbours, at which no spring pulls"),
                      field("mass", &T::mass, "kg", positive, "of one node"),
                      field("radius", &T::radius, "m", non_negative, "of one node; at most half the spacing"),
                      field("stiffness", &T::stiffness, "N/m", non_negative, "of the springs along rows and columns"),
                      field("shear_stiffness", &T::shear_stiffness, "N/m", non_negative,
                            "of the springs along the diagonals; 0 makes none"),
                      field("bend_stiffness", &T::bend_stiffness, "N/m", non_negative,
                            "of the springs that skip a node along rows and columns; 0 makes none"),
                      field("damping", &T::damping, "N s/m", non_negative, "of every spring, along it"),
                      field("held", &T::held, "which nodes are fixed")};
}

struct GridOf {
    Body body{};
    int nx = 10, ny = 10;
    Vec2 spacing{1, 1};
};
constexpr std::string_view describe(const GridOf*) { return "Copies of a body in rows and columns."; }
template <std::same_as<GridOf> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("body", &T::body, "the first body; the copies are called name[column][row], from name[0][0]"),
        field("nx", &T::nx, "", built_count, "number of columns"),
        field("ny", &T::ny, "", built_count, "number of rows"),
        field("spacing", &T::spacing, "m", any, "from a body to the next of its row, and of its column")};
}

struct Fill {
    Vec2 low{0, 0}, high{1, 1};
    std::optional<double> fraction{};
    std::optional<int> count{};
    double smallest_radius = 0.01, largest_radius = 0.01;
    Body body{};
    std::optional<double> density{};
    int seed = 1;
};
constexpr std::string_view describe(const Fill*) {
    return "Discs at random places of a rectangle that overlap nothing (random sequential addition, largest first).";
}
template <std::same_as<Fill> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("low", &T::low, "m", any, "lower left corner; discs lie inside"),
        field("high", &T::high, "m", any,
              "upper right corner; if the rectangle is the periodic box of the world, discs may lie across its sides"),
        field("fraction", &T::fraction, "", Range{0, 1, true, "a number > 0 and <= 1"},
              "share of the rectangle that discs cover, to the nearest disc; equal ones find places up to 0.51"),
        field("count", &T::count, "", built_count, "number of discs, in place of the fraction"),
        field("smallest_radius", &T::smallest_radius, "m", positive, "radii are uniform between this"),
        field("largest_radius", &T::largest_radius, "m", positive, "and this"),
        field("body", &T::body, "everything else about a disc; they are called name[0], name[1], ..."),
        field("density", &T::density, "kg/m²", positive, "mass per area of disc; if absent all have the body's mass"),
        field("seed", &T::seed, "", seed_range, "of the random numbers")};
}

struct Gas {
    Fill fill{};
    double temperature = 1;
    bool exact = true;
};
constexpr std::string_view describe(const Gas*) { return "Discs at random places with Maxwell's velocities."; }
template <std::same_as<Gas> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("fill", &T::fill, "the discs; the velocity of their body is added to all, as a wind"),
        field("temperature", &T::temperature, "J", non_negative,
              "kT: the mean kinetic energy of a disc, relative to the wind"),
        field("exact", &T::exact,
              "true: velocities are shifted and scaled so that, relative to the wind, the momentum is 0 and the "
              "kinetic energy N kT, or (N - 1) kT in a periodic box, where momentum is conserved; false: as drawn")};
}

struct NotebookGas {
    int count = 15;
    Vec2 low{1, 1}, high{19, 14};
    double speed = 3;
    double smallest_radius = 0.4, largest_radius = 0.8;
    Body body{};
    int seed = 99;
};
constexpr std::string_view describe(const NotebookGas*) {
    return "The gas of a numpy notebook, the same to the last bit: np.random.seed, then for each disc x = uniform, y = "
           "uniform, vx = speed randn, vy = speed randn, radius = uniform. Discs may overlap.";
}
template <std::same_as<NotebookGas> T>
constexpr auto fields(const T*) {
    return std::tuple{field("count", &T::count, "", built_count, "number of discs"),
                      field("low", &T::low, "m", any, "lower left corner of where centres are"),
                      field("high", &T::high, "m", any, "upper right corner of where centres are"),
                      field("speed", &T::speed, "m/s", non_negative, "standard deviation of each velocity component"),
                      field("smallest_radius", &T::smallest_radius, "m", positive, "radii are uniform between this"),
                      field("largest_radius", &T::largest_radius, "m", positive, "and this"),
                      field("body", &T::body, "everything else about a disc; they are called name[0], name[1], ..."),
                      field("seed", &T::seed, "", seed_range, "what the notebook gives to np.random.seed")};
}

Built build(World& world, const Rope& rope);
Built build(World& world, const Lattice& lattice);
Built build(World& world, const GridOf& grid);
Built build(World& world, const Fill& fill);
Built build(World& world, const Gas& gas);
Built build(World& world, const NotebookGas& gas);

}  // namespace carom
