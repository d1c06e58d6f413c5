#pragma once
// Measures of a gas of discs while it runs: pressure, temperature, rates and distributions, with their errors.

#include <array>
#include <carom/archive.hpp>
#include <carom/world.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// A measure of a gas that is one number.
struct GasMeasure {
    std::string_view quantity;  ///< as the expectations of a scene name it; its error is quantity.error
    std::string_view name, unit;
};
inline constexpr std::array<GasMeasure, 7> gas_measures{{{"gas.temperature", "temperature k T", "J"},
                                                         {"gas.mean_speed", "mean speed", "m/s"},
                                                         {"gas.pressure", "pressure by the virial", "N/m"},
                                                         {"gas.wall_pressure", "pressure on the walls", "N/m"},
                                                         {"gas.collision_rate", "collisions of a disc", "1/s"},
                                                         {"gas.mean_free_path", "mean free path", "m"},
                                                         {"gas.diffusion", "diffusion", "m²/s"}}};

/// A mean over a run, and its standard error: from the slowest fluctuations of averages over blocks of time
/// (Heidelberger and Welch, Commun. ACM 24, 233 (1981)); NaN if the run was too short for one.
struct GasNumber {
    std::string quantity, name, unit;
    double value = 0, error = 0;
    double from = 0, to = 0;  ///< of diffusion, the times of the ways that it is made of [s]
};

/// A measure that a run does not have, and why.
struct GasAbsence {
    std::string quantity, name, why;
};

/// A curve with the same kind of error, and the closed form beside it if there is one.
struct GasCurve {
    std::string name{}, x_label{}, y_label{};
    std::vector<double> x{}, y{}, error{};
    std::vector<double> law{};
    std::string law_name{};
};

/// Watches the dynamic discs of a world. Memory and time a frame do not grow with the run. Pressures, rates and the
/// mean free path count what the solver 'events' counted; under other solvers they are left out. A periodic box with
/// nothing else in it is measured in the frame of its centre of mass, which may fall; all others as they stand.
class GasMeter {
  public:
    /// An Error if there is no dynamic body.
    explicit GasMeter(const World& start);
    GasMeter(GasMeter&&) noexcept;
    GasMeter& operator=(GasMeter&&) noexcept;
    ~GasMeter();
    /// Forgets what was seen: the measures begin with this state, of the same world.
    void begin(const World& now);
    /// To be called at equal intervals of time. Takes the state of the world, and what was counted since the last call,
    /// as a sample. Other bodies may come and go; an Error if a disc that was there at the start was removed.
    void observe(const World& world);
    /// The same for a run whose measures begin at the time `from` [s].
    void observe(const World& world, double from) {
        if (from > 0 && world.time() <= from * (1 + 1e-12))
            begin(world);
        else
            observe(world);
    }

    /// Temperature, pressures, collision rate, mean free path, diffusion.
    std::vector<GasNumber> numbers() const;
    /// Those of them that are left out where somebody could expect them: without walls nobody expects a pressure on
    /// them.
    std::vector<GasAbsence> left_out() const;
    /// Speeds, pair correlation (in an empty box, or between walls without gravity), mean squared way, autocorrelation
    /// of the velocity, under gravity the density by height.
    std::vector<GasCurve> curves() const;

    /// Density, flow and temperature in a cell of the room, averaged over the run, and their standard errors.
    struct Field {
        Vec2 centre{};
        double density = 0, density_error = 0;          ///< discs a m²
        Vec2 flow{}, flow_error{};                      ///< velocity of the mass [m/s]
        double temperature = 0, temperature_error = 0;  ///< k T [J], of the motion relative to the flow
    };
    std::vector<Field> fields() const;

    /// What was seen so far, for a checkpoint, and back into the meter of the same world.
    void save(Saver& to) const;
    void restore(Loader& from);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Whether a run of this world is measured: ten dynamic discs or more under 'events'; fewer are no gas.
bool is_measured(const World& world);

}  // namespace carom
