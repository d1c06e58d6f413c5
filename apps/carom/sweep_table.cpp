#include "sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "build.hpp"
#include "report.hpp"

namespace carom::app {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::string in_words(const Cell& cell) {
    std::string text = cell.words.empty() ? fmt::format("{:.9g}", cell.value) : cell.words;
    if (cell.error && std::isfinite(*cell.error)) text = with_error(cell.value, *cell.error);
    return cell.ok ? text : text + " FAIL";
}

std::string in_words(const SweepMean::Column& column, std::size_t whole) {
    if (!column.mean) return "-";
    const std::string words = with_error(*column.mean, *column.error);
    return column.samples < whole ? fmt::format("{} (of {})", words, column.samples) : words;
}

/// "3 of 8 runs"
std::string in_words(const SweepMean& mean) {
    return mean.whole < mean.runs ? fmt::format("{} of {} runs", mean.whole, mean.runs)
                                  : counted(mean.runs, "run", "runs");
}

const char* in_words(Outcome outcome) {
    return outcome == Outcome::as_expected ? "yes" : outcome == Outcome::not_as_expected ? "no" : "broke off";
}

/// The parameter of a sweep that changes nothing but random numbers.
std::optional<std::size_t> seed_of(const Sweep& sweep) {
    for (std::size_t k = 0; k < sweep.over.size(); ++k)
        if (sweep.over[k].name == "seed" || sweep.over[k].name.ends_with(".seed")) return k;
    return {};
}

/// The mean of samples and its standard error, from how they scatter; nothing of less than two.
std::optional<std::pair<double, double>> mean_of(const std::vector<double>& samples) {
    const auto n = static_cast<double>(samples.size());
    if (n < 2) return {};
    double sum = 0, squares = 0;
    for (const double x : samples) sum += x;
    for (const double x : samples) squares += (x - sum / n) * (x - sum / n);
    return std::pair(sum / n, std::sqrt(squares / (n - 1) / n));
}

}  // namespace

std::vector<Cell> cells_of(const Scene& scene, const Result& r, const std::vector<std::string>& quantities) {
    std::vector<Cell> cells;
    if (!quantities.empty()) {
        const World start = scene.world();  // knows all names: joints break
        for (const std::string& q : quantities)
            cells.push_back({q, unit_of(q), Quantity(q, start, scene.parameters(), true)(r.world, r.measures)});
        return cells;
    }
    for (const Verdict& v : r.verdicts) {
        const Expectation& e = v.expectation;
        const std::string unit = e.statistic == Statistic::zero ? "s" : unit_of(e.quantity);
        cells.push_back({e.text.empty() ? in_words(e) : e.text, unit, v.value, {}, value_in_words(v, 9), v.ok});
    }
    for (const TwinError& t : r.twins)
        cells.push_back(
            {"error of " + t.twin.quantity, t.twin.unit.empty() ? unit_of(t.twin.quantity) : t.twin.unit, t.largest});
    for (const GasNumber& n : r.measures) cells.push_back({n.name, n.unit, n.value, n.error});
    if (cells.empty()) cells.push_back({"energy.total", "J", energy(r.world).total()});
    return cells;
}

Outcome outcome_of(const Result& result) {
    if (!result.failure.empty()) return Outcome::broke_off;
    return result.ok() ? Outcome::as_expected : Outcome::not_as_expected;
}

SweepTable::SweepTable(const Scene& base, const Sweep& sweep) : sweep_(sweep), title_(base.title()) {
    if (!sweep.csv.empty()) {
        provenance_ = {.version = CAROM_VERSION,
                       .build = build_words(),
                       .seed = fmt::format("{}", base.seed()),
                       .scene = base.text(),
                       .parameters = base.parameters()};
        file_.emplace(sweep.csv);
    }
    for (const Swept& parameter : sweep.over) {
        std::size_t& width = narrow_.emplace_back(std::max<std::size_t>(8, parameter.name.size()));
        for (const std::string& value : parameter.values) width = std::max(width, value.size());
    }
}

void SweepTable::add(const Point& point, const std::vector<std::optional<double>>& numbers,
                     const std::vector<Cell>& cells, Outcome outcome) {
    const std::size_t before = columns_.size();
    const std::vector<const Cell*> found = in_columns(cells);
    if (columns_.size() > before) print_heading();
    print_narrow(point);
    Row& row = rows_.emplace_back(Row{point, numbers, {}, outcome});
    for (std::size_t k = 0; k < found.size(); ++k) {
        const Cell* const cell = found[k];
        row.results.push_back(cell ? Number{cell->value, cell->error.value_or(missing)} : Number{missing, missing});
        if (!sweep_.json) fmt::print("  {:>{}}", cell ? in_words(*cell) : "-", columns_[k].width);
    }
    if (!sweep_.json) fmt::print("{}\n", outcome == Outcome::broke_off ? "  broke off" : "");
    std::fflush(stdout);
}

/// What a run has in each column, and new columns for what no run before had. Of those that have one name the first is
/// the first.
std::vector<const Cell*> SweepTable::in_columns(const std::vector<Cell>& cells) {
    constexpr std::size_t least = 14;
    std::vector<const Cell*> found(columns_.size(), nullptr);
    for (const Cell& cell : cells) {
        std::size_t k = 0;
        while (k < columns_.size() && (found[k] != nullptr || columns_[k].name != cell.name)) ++k;
        if (k == columns_.size()) {
            const std::string heading = with_unit(cell.name, cell.unit);
            columns_.push_back({cell.name, cell.unit, heading, std::max({least, heading.size(), in_words(cell).size()}),
                                cell.error.has_value()});
            found.push_back(nullptr);
        }
        found[k] = &cell;
    }
    return found;
}

std::vector<SweepMean> SweepTable::means() const {
    const auto seed = seed_of(sweep_);
    if (!seed) return {};
    std::vector<std::pair<Point, std::vector<const Row*>>> groups;  // in the order of their first runs
    std::map<Point, std::size_t> known;
    for (const Row& row : rows_) {
        Point point = row.point;
        point[*seed] = "mean";
        const auto [group, is_new] = known.try_emplace(point, groups.size());
        if (is_new) groups.push_back({point, {}});
        groups[group->second].second.push_back(&row);
    }
    std::vector<SweepMean> means;
    for (const auto& [point, rows] : groups)
        if (rows.size() > 1) means.push_back(mean_of(rows, point));
    return means;
}

SweepMean SweepTable::mean_of(const std::vector<const Row*>& rows, const Point& point) const {
    SweepMean mean{.point = point, .runs = rows.size()};
    for (const Row* row : rows) mean.whole += row->outcome != Outcome::broke_off;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
        std::vector<double> samples;
        for (const Row* row : rows)
            if (const double value = number_at(*row, k).value;
                row->outcome != Outcome::broke_off && std::isfinite(value))
                samples.push_back(value);
        SweepMean::Column& column =
            mean.columns.emplace_back(SweepMean::Column{columns_[k].name, columns_[k].unit, samples.size()});
        if (const auto known = app::mean_of(samples)) column.mean = known->first, column.error = known->second;
    }
    return mean;
}

void SweepTable::add_means() {
    for (const SweepMean& mean : means()) {
        print(mean);
        std::string at, words;
        for (std::size_t k = 0; k < mean.point.size(); ++k)
            if (mean.point.size() > 1 && k != seed_of(sweep_))
                at = fmt::format(" at {}={}", sweep_.over[k].name, mean.point[k]);
        for (std::size_t k = 0; k < columns_.size(); ++k)
            words += fmt::format("{} {}: {}", k ? ";" : "", columns_[k].heading, in_words(mean.columns[k], mean.whole));
        remark(fmt::format("mean{} of {}:{}", at, in_words(mean), words));
    }
}

void SweepTable::remark(std::string words) {
    std::replace(words.begin(), words.end(), '\n', ' ');  // names may have any letter
    remarks_.push_back(std::move(words));
}

void SweepTable::write() {
    if (!file_ || rows_.empty()) return;
    file_->write(comment_lines(provenance_));
    std::vector<carom::Column> columns;
    for (const Swept& parameter : sweep_.over) columns.push_back({parameter.name});
    for (const Column& c : columns_) {
        columns.push_back({c.name, c.unit});
        if (c.has_error) columns.push_back({c.name + " standard error", c.unit});
    }
    columns.push_back({"as expected"});
    Csv csv(std::move(*file_), columns, false);
    for (const Row& row : rows_) write_row(csv, row);
    for (const std::string& words : remarks_) csv.file().write("# " + words + "\n");
    csv.commit();
}

void SweepTable::write_row(Csv& csv, const Row& row) const {
    for (std::size_t k = 0; k < row.point.size(); ++k)
        csv.cell(row.numbers[k] ? fmt::format("{}", *row.numbers[k]) : row.point[k]);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
        const auto [value, error] = number_at(row, k);
        csv.cell(value);
        if (columns_[k].has_error) csv.cell(error);
    }
    csv.cell(in_words(row.outcome));
    csv.end_row();
}

void SweepTable::draw() const {
    std::vector<std::string> headings;
    for (const Column& column : columns_) headings.push_back(column.heading);
    std::vector<SweepRow> drawn;
    for (const Row& row : rows_) {
        SweepRow& to = drawn.emplace_back(SweepRow{row.point, row.numbers});
        for (std::size_t k = 0; k < columns_.size(); ++k) {
            const Number none{missing, missing};  // where a run broke off is no result of it
            const auto [value, error] = row.outcome == Outcome::broke_off ? none : number_at(row, k);
            to.results.push_back(value), to.errors.push_back(error);
        }
    }
    Figure figure = sweep_figure(sweep_, headings, drawn);
    figure.title = title_;
    save(figure, sweep_.picture);
}

SweepTable::Number SweepTable::number_at(const Row& row, std::size_t column) const {
    return column < row.results.size() ? row.results[column] : Number{missing, missing};
}

void SweepTable::print_narrow(const Point& point) const {
    for (std::size_t k = 0; k < point.size() && !sweep_.json; ++k)
        fmt::print("{}{:<{}}", k ? "  " : "", point[k], narrow_[k]);
}

void SweepTable::print_heading() const {
    if (sweep_.json) return;
    if (rows_.empty() && !title_.empty()) fmt::print("{}\n", title_);
    Point parameters;
    for (const Swept& parameter : sweep_.over) parameters.push_back(parameter.name);
    print_narrow(parameters);
    for (const Column& column : columns_) fmt::print("  {:>{}}", column.heading, column.width);
    fmt::print("\n");
}

void SweepTable::print(const SweepMean& mean) const {
    if (sweep_.json) return;
    print_narrow(mean.point);
    for (std::size_t k = 0; k < columns_.size(); ++k)
        fmt::print("  {:>{}}", in_words(mean.columns[k], mean.whole), columns_[k].width);
    fmt::print("{}\n", mean.whole < mean.runs ? "  of " + in_words(mean) : "");
}

}  // namespace carom::app
