#pragma once
// The table of a sweep: a row a run.

#include <carom/output.hpp>
#include <map>
#include <utility>

#include "sweep_picture.hpp"
#include "sweep_values.hpp"

namespace carom::app {

/// A number of a run, with its error if that is known.
struct Cell {
    std::string name, unit;
    double value = 0;
    std::optional<double> error{};
    std::string words{};  ///< of an expectation
    bool ok = true;
};
/// The quantities at the end of a run; or, without any, what its scene expects and measures.
std::vector<Cell> cells_of(const Scene& scene, const Result& result, const std::vector<std::string>& quantities);

enum class Outcome { as_expected, not_as_expected, broke_off };
Outcome outcome_of(const Result& result);

/// Of runs that differ in their seeds alone, which are samples of the same.
struct SweepMean {
    struct Column {
        std::string name, unit;
        std::size_t samples = 0;                ///< runs that have this number
        std::optional<double> mean{}, error{};  ///< the standard error, from how they scatter; of less than two, none
    };
    Point point{};                    ///< with "mean" for the seed
    std::size_t runs = 0, whole = 0;  ///< those that did not break off are the samples
    std::vector<Column> columns{};
};

/// Prints a row a run as soon as it is known, and keeps all of them for a file, a picture and means.
class SweepTable {
  public:
    SweepTable(const Scene& base, const Sweep& sweep);

    /// `numbers`: what the values are, those that are numbers.
    void add(const Point& point, const std::vector<std::optional<double>>& numbers, const std::vector<Cell>& cells,
             Outcome outcome);
    /// Of runs over seeds, one for each value of another parameter.
    std::vector<SweepMean> means() const;
    /// These as the last rows.
    void add_means();
    /// A comment at the end of the file.
    void remark(std::string words);
    /// Writes the file, if one is wanted and there are rows.
    void write();
    void draw() const;

  private:
    struct Column {
        std::string name, unit, heading;
        std::size_t width;
        bool has_error;
    };
    struct Number {
        double value, error;
    };
    struct Row {
        Point point;
        std::vector<std::optional<double>> numbers;
        std::vector<Number> results;  ///< of the columns that there were
        Outcome outcome;
    };

    std::vector<const Cell*> in_columns(const std::vector<Cell>& cells);
    Number number_at(const Row& row, std::size_t column) const;
    SweepMean mean_of(const std::vector<const Row*>& rows, const Point& point) const;
    void print_narrow(const Point& point) const;
    void print_heading() const;
    void print(const SweepMean& mean) const;
    void write_row(Csv& csv, const Row& row) const;

    const Sweep& sweep_;
    std::string title_;
    Provenance provenance_{};
    std::optional<File> file_{};
    std::vector<std::size_t> narrow_{};  ///< widths of the parameters' columns
    std::vector<Column> columns_{};
    std::vector<Row> rows_{};
    std::vector<std::string> remarks_{};
};

}  // namespace carom::app
