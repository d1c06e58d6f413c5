#pragma once
#include <array>
#include <carom/field.hpp>
#include <cstdint>
#include <string_view>
#include <variant>

// The integrators. Each is a struct of its own options; its method is in src/integrators/ and docs/theory/.
// `name` is its name in scene files and on the command line.

namespace carom {

struct Euler {
    static constexpr const char* name = "euler";
};
constexpr std::string_view describe(const Euler*) {
    return "Explicit Euler, order 1. Gains energy on every orbit: to see why one does not use it.";
}
struct SymplecticEuler {
    static constexpr const char* name = "symplectic-euler";
};
constexpr std::string_view describe(const SymplecticEuler*) {
    return "Kick, then drift (Euler-Cromer), order 1, symplectic: the textbook's and the game engines'.";
}
struct Verlet {
    static constexpr const char* name = "verlet";
};
constexpr std::string_view describe(const Verlet*) {
    return "Velocity Verlet (kick-drift-kick), order 2, symplectic, one force evaluation: the default.";
}
struct Pefrl {
    static constexpr const char* name = "pefrl";
};
constexpr std::string_view describe(const Pefrl*) {
    return "Position-extended Forest-Ruth-like, order 4, symplectic, four force evaluations (Omelyan, Mryglod, Folk "
           "2002).";
}
struct Rk4 {
    static constexpr const char* name = "rk4";
};
constexpr std::string_view describe(const Rk4*) { return "The classical Runge-Kutta method, order 4."; }

enum class Tableau : std::uint8_t { midpoint, heun, ralston, kutta3, kutta38, dormand_prince5, dormand_prince8 };
constexpr auto choices(const Tableau*) {
    return std::array{Choice<Tableau>{"midpoint", Tableau::midpoint, "order 2, explicit midpoint"},
                      Choice<Tableau>{"heun", Tableau::heun, "order 2, trapezoid"},
                      Choice<Tableau>{"ralston", Tableau::ralston, "order 2, least error"},
                      Choice<Tableau>{"kutta3", Tableau::kutta3, "order 3"},
                      Choice<Tableau>{"kutta38", Tableau::kutta38, "order 4, the 3/8 rule"},
                      Choice<Tableau>{"dormand-prince5", Tableau::dormand_prince5, "order 5, seven stages"},
                      Choice<Tableau>{"dormand-prince8", Tableau::dormand_prince8, "order 8, twelve stages"}};
}
struct RungeKutta {
    Tableau tableau = Tableau::dormand_prince5;
    static constexpr const char* name = "runge-kutta";
};
constexpr std::string_view describe(const RungeKutta*) {
    return "An explicit Runge-Kutta method by its tableau, fixed step.";
}
template <std::same_as<RungeKutta> T>
constexpr auto fields(const T*) {
    return std::tuple{field("tableau", &T::tableau, "which method")};
}

enum class Pair : std::uint8_t { dormand_prince54, dormand_prince853 };
constexpr auto choices(const Pair*) {
    return std::array{
        Choice<Pair>{"dormand-prince54", Pair::dormand_prince54, "order 5 with an error estimate of order 4"},
        Choice<Pair>{"dormand-prince853", Pair::dormand_prince853, "order 8 with error estimates of order 5 and 3"}};
}
struct Adaptive {
    Pair pair = Pair::dormand_prince853;
    double tolerance = 1e-9;
    static constexpr const char* name = "adaptive";
};
constexpr std::string_view describe(const Adaptive*) {
    return "Dormand-Prince with its own step size and dense output (Hairer, Norsett, Wanner, Solving ODEs I).";
}
template <std::same_as<Adaptive> T>
constexpr auto fields(const T*) {
    return std::tuple{field("pair", &T::pair, "which pair of methods"),
                      field("tolerance", &T::tolerance, "", positive,
                            "error allowed in one step, relative to the size of each coordinate and absolute below 1")};
}

enum class NystromPair : std::uint8_t { dormand_prince64, dormand_prince86, dormand_prince1210 };
constexpr auto choices(const NystromPair*) {
    return std::array{Choice<NystromPair>{"dormand-prince64", NystromPair::dormand_prince64,
                                          "order 6 with an error estimate of order 4, five force evaluations"},
                      Choice<NystromPair>{"dormand-prince86", NystromPair::dormand_prince86,
                                          "order 8 with an error estimate of order 6, eight force evaluations"},
                      Choice<NystromPair>{"dormand-prince1210", NystromPair::dormand_prince1210,
                                          "order 12 with an error estimate of order 10, seventeen force evaluations"}};
}
struct Nystrom {
    NystromPair pair = NystromPair::dormand_prince86;
    double tolerance = 1e-9;
    static constexpr const char* name = "nystrom";
};
constexpr std::string_view describe(const Nystrom*) {
    return "Runge-Kutta-Nystrom with its own step size (Dormand, El-Mikkawy, Prince 1987), where no force depends on "
           "velocity: fewer evaluations than adaptive.";
}
template <std::same_as<Nystrom> T>
constexpr auto fields(const T*) {
    return std::tuple{field("pair", &T::pair, "which pair of methods"),
                      field("tolerance", &T::tolerance, "", positive,
                            "error allowed in one step, relative to the size of each coordinate and absolute below 1")};
}

struct GaussRadau {
    double tolerance = 1e-9;
    static constexpr const char* name = "gauss-radau";
};
constexpr std::string_view describe(const GaussRadau*) {
    return "Order 15 with its own step size and compensated sums, for reference runs (Rein, Spiegel 2015; Everhart "
           "1985).";
}
template <std::same_as<GaussRadau> T>
constexpr auto fields(const T*) {
    return std::tuple{field("tolerance", &T::tolerance, "", positive,
                            "size of the last coefficient against the acceleration; 1e-9 is machine precision")};
}

struct Implicit {
    double tolerance = 1e-12;
    static constexpr const char* name = "implicit";
};
constexpr std::string_view describe(const Implicit*) {
    return "Implicit midpoint, order 2: keeps the energy of springs of any stiffness, is not symplectic, takes one "
           "sparse factorisation per step.";
}
template <std::same_as<Implicit> T>
constexpr auto fields(const T*) {
    return std::tuple{field("tolerance", &T::tolerance, "", positive,
                            "change of the velocities in the last Newton iteration, relative to the largest")};
}

using Integrator =
    std::variant<Euler, SymplecticEuler, Verlet, Pefrl, Rk4, RungeKutta, Adaptive, Nystrom, GaussRadau, Implicit>;

/// What happens when a step is longer than is stable.
enum class LongStep : std::uint8_t { substep, refuse };
constexpr auto choices(const LongStep*) {
    return std::array{Choice<LongStep>{"substep", LongStep::substep, "the step is divided into equal stable parts"},
                      Choice<LongStep>{"refuse", LongStep::refuse, "it is an error that says how long a step may be"}};
}

}  // namespace carom
