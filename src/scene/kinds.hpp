#pragma once
// The types a scene's lists may hold, each under the name of its "type".

#include <carom/builder.hpp>
#include <carom/force.hpp>
#include <carom/scene.hpp>
#include <carom/wall.hpp>
#include <tuple>

namespace carom {

/// A force field written as expressions; becomes a ForceField.
struct FieldExpression {
    std::string name{};
    std::optional<BodyId> body{};
    std::string x = "0", y = "0";
    std::string potential{};
};
constexpr std::string_view describe(const FieldExpression*) {
    return "A force written as expressions of x, y, vx, vy, m, t.";
}
template <std::same_as<FieldExpression> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("name", &T::name, "name, for the reader"),
        field("body", &T::body, "the body that feels it; if absent all do"),
        field("x", &T::x, "force along x in N, an expression of x, y, vx, vy, m, t and the parameters"),
        field("y", &T::y, "force along y in N"),
        field("potential", &T::potential,
              "its potential energy in J, an expression of x, y, m, t; without one its work is booked as the user's")};
}

/// A driven body's curve written as expressions; what is not given stays as the body was placed.
struct CurveExpression {
    BodyId body{};
    std::optional<std::string> x{}, y{}, angle{};
};
constexpr std::string_view describe(const CurveExpression*) { return "Moves a driven body along a curve."; }
template <std::same_as<CurveExpression> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("body", &T::body, "the driven body"),
        field("x", &T::x, "its x in m, an expression of t and the parameters; if absent that of its position"),
        field("y", &T::y, "its y in m; if absent that of its position"),
        field("angle", &T::angle, "its angle in rad; if absent as it was placed")};
}

/// A curve written as expressions; becomes a body that is a chain.
struct TrackExpression {
    Body body{};
    std::string x = "s", y = "0";
    double from = 0, to = 1;
    int segments = 200;
    bool closed = false;
};
constexpr std::string_view describe(const TrackExpression*) {
    return "A curve as a chain of lines: a slope, a bowl, a loop.";
}
template <std::same_as<TrackExpression> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("body", &T::body, "everything else about it; it is fixed unless it is driven"),
        field("x", &T::x, "its x in m in the frame of the body, an expression of s and the parameters"),
        field("y", &T::y, "its y in m; where it goes from left to right, what lies above it is on the free side"),
        field("from", &T::from, "", any, "s where it begins"),
        field("to", &T::to, "", any, "s where it ends"),
        field("segments", &T::segments, "", built_count, "number of lines, at equal steps of s"),
        field("closed", &T::closed, "whether its end is its beginning, and is not made twice")};
}

/// What a document may have at its top.
struct TopKey {
    enum class Shape { version, text, seed, object, list } shape;
    const char* name;
    const char* text;
};
inline constexpr TopKey top_keys[] = {
    {TopKey::Shape::version, "carom", "version of the format: 1"},
    {TopKey::Shape::text, "$schema", "where the schema is, for editors"},
    {TopKey::Shape::text, "title", "what the scene is"},
    {TopKey::Shape::text, "teaches", "one line: what the scene shows"},
    {TopKey::Shape::seed, "seed", "of all random numbers of the scene; 1 if absent"},
    {TopKey::Shape::object, "parameters",
     "numbers with names, for expressions and --set; each may use those before it"},
    {TopKey::Shape::object, "world", "what holds for the world as a whole"},
    {TopKey::Shape::list, "walls", "walls or a periodic box"},
    {TopKey::Shape::list, "bodies", "bodies, one by one"},
    {TopKey::Shape::list, "builders", "many bodies at once"},
    {TopKey::Shape::list, "joints", "what holds bodies together: hinges, rods, slides, motors"},
    {TopKey::Shape::list, "forces", "springs, drag and all other forces; curves of driven bodies"},
    {TopKey::Shape::object, "run", "how long the scene runs, and in what steps"},
    {TopKey::Shape::list, "expects", "numbers the run must give"},
    {TopKey::Shape::list, "twins", "quantities, and the closed forms they are held against"},
    {TopKey::Shape::list, "pictures", "what `carom plot` draws"}};
inline constexpr std::size_t most_parameters = 200;

template <class T>
struct Type {
    using type = T;
    const char* name;
};

inline constexpr std::tuple wall_types{Type<Rectangle>{"rectangle"}, Type<HalfPlane>{"half-plane"},
                                       Type<Stadium>{"stadium"}, Type<Periodic>{"periodic"}};
inline constexpr std::tuple builder_types{
    Type<Rope>{"rope"}, Type<Lattice>{"lattice"},          Type<GridOf>{"grid"},          Type<Fill>{"fill"},
    Type<Gas>{"gas"},   Type<NotebookGas>{"notebook-gas"}, Type<TrackExpression>{"track"}};
inline constexpr std::tuple force_types{
    Type<Spring>{"spring"},         Type<TorsionSpring>{"torsion-spring"}, Type<Drag>{"drag"},
    Type<Attraction>{"attraction"}, Type<SoftDiscs>{"soft-discs"},         Type<ConstantForce>{"constant"},
    Type<FieldExpression>{"field"}, Type<CurveExpression>{"drive"}};

}  // namespace carom
