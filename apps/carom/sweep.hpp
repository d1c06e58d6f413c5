#pragma once
// A scene, run once for each of many values of one of its parameters.

#include "experiment.hpp"

namespace carom::app {

struct Sweep {
    std::string name{};                     ///< a parameter or a place of the scene, as of --set
    std::vector<std::string> values{};      ///< as they are written
    std::vector<std::string> quantities{};  ///< at the end of each run; if empty what the scene expects and measures
    std::string csv{};                      ///< file of the table; none if empty
    bool json = false;                      ///< one object, instead of a table
};
/// What `--sweep n=1:7`, `e=0:1:0.1` or `world.integrator=verlet,rk4` asks for.
Sweep read_sweep(const std::string& text);
/// A row a run, and the table as a file; the exit status.
int run_sweep(const std::string& file, const Overrides& overrides, const Sweep& sweep);

}  // namespace carom::app
