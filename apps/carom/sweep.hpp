#pragma once
// A scene, run once for each of many values of one of its parameters, or of two.

#include "experiment.hpp"

namespace carom::app {

/// A parameter of a sweep.
struct Swept {
    std::string name{};                 ///< a parameter or a place of the scene, as of --set
    std::vector<std::string> values{};  ///< as they are written
    bool is_range = false;
};

struct Sweep {
    std::vector<Swept> over{};              ///< one, or two for all pairs of their values
    std::vector<std::string> quantities{};  ///< at the end of each run; if empty what the scene expects and measures
    std::string csv{};                      ///< file of the table; none if empty
    std::string picture{};                  ///< file of that; none if empty
    bool json = false;                      ///< one object, instead of a table
};
/// What `--sweep n=1:7`, `e=0:1:0.1` or `world.integrator=verlet,rk4` asks for, one or two of them.
Sweep read_sweep(const std::vector<std::string>& texts);
/// A row a run, and the table and its picture as files; the exit status.
int run_sweep(const std::string& file, const Overrides& overrides, const Sweep& sweep);

}  // namespace carom::app
