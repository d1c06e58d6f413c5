#include "sweep.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <carom/output.hpp>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "build.hpp"
#include "products.hpp"
#include "report.hpp"
#include "sweep_picture.hpp"
#include "sweep_remarks.hpp"

namespace carom::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_runs = 1000000;

Error wrong(const std::string& text) {
    return Error(
        fmt::format("--sweep {}: must be NAME=FROM:TO, NAME=FROM:TO:BY or NAME=VALUE,VALUE,..., with at most a million "
                    "values",
                    text));
}

/// The parts between separators that are in no bracket and no quotes.
std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts{""};
    int open = 0;
    bool quoted = false;
    for (const char c : text) {
        if (c == '"') quoted = !quoted;
        open += c == '[' || c == '{' || c == '(' ? 1 : c == ']' || c == '}' || c == ')' ? -1 : 0;
        if (c == separator && open == 0 && !quoted)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

std::optional<double> read_number(const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return {};
    return number;
}

/// The value of an expression of numbers and parameters alone.
std::optional<double> read_expression(const std::string& text, const std::map<std::string, double>& parameters = {}) {
    try {
        constexpr double no_time = std::numeric_limits<double>::quiet_NaN();  // what depends on it is no number
        if (const double number = closed_form(text, parameters)(no_time); std::isfinite(number)) return number;
    } catch (const Error&) {
    }
    return {};
}

/// The numbers of FROM:TO or FROM:TO:BY; nothing of any other text. An Error if some are numbers and one is not.
std::optional<std::vector<std::string>> read_range(const std::string& text) {
    const std::vector<std::string> parts = split(text, ':');
    if (parts.size() != 2 && parts.size() != 3) return {};
    std::vector<double> numbers;
    std::string other;
    int digits = 12;  // 0.3, and not 0.1 three times
    for (const std::string& part : parts)
        if (const auto number = read_number(part))
            numbers.push_back(*number);
        else if (const auto value = read_expression(part))
            numbers.push_back(*value), digits = 15;  // such as 30*deg, which has more than twelve
        else
            other = part;
    // "a ? b : c" is an expression, and so may be what is before a comma.
    if (numbers.empty() || text.find_first_of("?,") != std::string::npos) return {};
    if (numbers.size() < parts.size())
        throw Error(fmt::format(
            "must be numbers from FROM to TO in steps of BY, as in 0:1:0.25 or 0:pi:pi/4, got \"{}\"", other));
    const double from = numbers[0], to = numbers[1], by = numbers.size() == 3 ? numbers[2] : 1;
    const double steps = std::floor((to - from) / by + 1e-9);
    if (numbers.size() == 2 && !(std::abs(from + steps * by - to) <= 1e-9 * std::abs(to)))
        throw Error(fmt::format("goes from {} in steps of 1, which do not lead to {}: say by how much, as in {}:{}:{}",
                                from, to, from, to, (to - from) / 4));
    if (steps < 0)
        throw Error(fmt::format("leads away from {}: from {} to it BY is {}", to, from, to < from ? "< 0" : "> 0"));
    std::vector<std::string> values;
    if (!(steps >= 0 && steps < static_cast<double>(most_runs))) return values;
    for (double k = 0; k <= steps; ++k) values.push_back(fmt::format("{:.{}g}", from + k * by, digits));
    return values;
}

/// A number of a run, with its error if that is known.
struct Cell {
    std::string name, unit;
    double value = 0;
    std::optional<double> error{};
    std::string words{};  ///< of an expectation
    bool ok = true;
};

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

std::string in_words(const Cell& cell) {
    std::string text = cell.words.empty() ? fmt::format("{:.9g}", cell.value) : cell.words;
    if (cell.error && std::isfinite(*cell.error)) text = fmt::format("{:.5g} ± {:.2g}", cell.value, *cell.error);
    return cell.ok ? text : text + " FAIL";
}

/// What a value is as a number, if it is one.
std::optional<double> number_of(const Scene& scene, const std::string& name, const std::string& value) {
    const auto parameters = scene.parameters();
    if (const auto found = parameters.find(name); found != parameters.end()) return found->second;
    // A word alone is pi, or a method's name, whatever a parameter of that name is.
    const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; };
    const bool word = std::all_of(value.begin(), value.end(), letter);
    return read_expression(value, word ? std::map<std::string, double>{} : parameters);
}

/// A value of each parameter: those of a run.
using Point = std::vector<std::string>;

/// All of them, in the order of their runs: the last parameter's values change first.
std::vector<Point> points_of(const Sweep& sweep) {
    std::vector<Point> points{{}};
    for (const Swept& parameter : sweep.over) {
        std::vector<Point> longer;
        for (const Point& point : points)
            for (const std::string& value : parameter.values) (longer.emplace_back(point)).push_back(value);
        points = std::move(longer);
    }
    return points;
}

/// Whether runs differ in their random numbers alone, and so are samples of the same.
bool is_over_seeds(const Sweep& sweep) {
    return sweep.over.size() == 1 && (sweep.over[0].name == "seed" || sweep.over[0].name.ends_with(".seed"));
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

/// "g=1 h=2"
std::string in_words(const Sweep& sweep, const Point& point) {
    std::string words;
    for (std::size_t k = 0; k < point.size(); ++k)
        words += fmt::format("{}{}={}", k ? " " : "", sweep.over[k].name, point[k]);
    return words;
}

std::vector<std::optional<double>> numbers_of(const Scene& scene, const Sweep& sweep, const Point& point) {
    std::vector<std::optional<double>> numbers;
    for (std::size_t k = 0; k < point.size(); ++k) numbers.push_back(number_of(scene, sweep.over[k].name, point[k]));
    return numbers;
}

/// A row a run, as soon as it is known. Which columns there are the first run says.
class Table {
  public:
    Table(const Scene& base, const Sweep& sweep) : sweep_(sweep), title_(base.title()) {
        if (!sweep.csv.empty())
            provenance_ = {.version = CAROM_VERSION,
                           .build = build_words(),
                           .seed = fmt::format("{}", base.seed()),
                           .scene = base.text(),
                           .parameters = base.parameters()};
        for (const Swept& parameter : sweep.over) {
            std::size_t& width = narrow_.emplace_back(std::max<std::size_t>(8, parameter.name.size()));
            for (const std::string& value : parameter.values) width = std::max(width, value.size());
        }
    }

    /// `numbers`: what the values are, those that are numbers.
    void add(const Point& point, const std::vector<std::optional<double>>& numbers, const std::vector<Cell>& cells,
             bool is_as_expected) {
        if (names_.empty()) begin(cells);
        print_narrow(point);
        for (std::size_t k = 0; k < names_.size(); ++k) {
            const Cell* cell = find(cells, k);
            if (!sweep_.json) fmt::print("  {:>{}}", cell ? in_words(*cell) : "-", widths_[k]);
        }
        if (!sweep_.json) fmt::print("\n");
        std::fflush(stdout);
        if (csv_) write(point, numbers, cells, is_as_expected);
        if (!sweep_.picture.empty() || is_over_seeds(sweep_)) remember(point, numbers, cells);
    }
    /// Of runs over seeds, a last row: what their numbers are in the mean.
    void add_mean() {
        if (!is_over_seeds(sweep_) || rows_.size() < 2) return;
        print_narrow({"mean"});
        std::string words;
        for (std::size_t k = 0; k < names_.size(); ++k) {
            std::vector<double> samples;
            for (const SweepRow& row : rows_)
                if (std::isfinite(row.results[k])) samples.push_back(row.results[k]);
            const auto mean = mean_of(samples);
            const std::string cell = mean ? fmt::format("{:.6g} ± {:.2g}", mean->first, mean->second) : "-";
            if (!sweep_.json) fmt::print("  {:>{}}", cell, widths_[k]);
            words += fmt::format("{} {}: {}", k ? ";" : "", headings_[k], cell);
        }
        if (!sweep_.json) fmt::print("\n");
        remark(fmt::format("mean of {} runs:{}", rows_.size(), words));
    }
    /// A comment at the end of the file.
    void remark(std::string words) {
        std::replace(words.begin(), words.end(), '\n', ' ');  // names may have any letter
        if (csv_) csv_->file().write("# " + words + "\n");
    }
    void commit() {
        if (csv_) csv_->commit();
    }
    void draw() const {
        Figure figure = sweep_figure(sweep_, headings_, rows_);
        figure.title = title_;
        save(figure, sweep_.picture);
    }

  private:
    void print_narrow(const Point& point) const {
        for (std::size_t k = 0; k < point.size() && !sweep_.json; ++k)
            fmt::print("{}{:<{}}", k ? "  " : "", point[k], narrow_[k]);
    }

    void begin(const std::vector<Cell>& cells) {
        constexpr std::size_t least = 14;
        std::vector<Column> columns;
        Point parameters;
        for (const Swept& parameter : sweep_.over)
            columns.push_back({parameter.name}), parameters.push_back(parameter.name);
        for (const Cell& c : cells) {
            names_.push_back(c.name);
            with_error_.push_back(c.error.has_value());
            const std::string& heading = headings_.emplace_back(with_unit(c.name, c.unit));
            widths_.push_back(std::max({least, heading.size(), in_words(c).size()}));
            columns.push_back({c.name, c.unit});
            if (c.error) columns.push_back({c.name + " standard error", c.unit});
        }
        columns.push_back({"as expected"});
        if (!sweep_.json && !title_.empty()) fmt::print("{}\n", title_);
        print_narrow(parameters);
        for (std::size_t k = 0; k < cells.size() && !sweep_.json; ++k) fmt::print("  {:>{}}", headings_[k], widths_[k]);
        if (!sweep_.json) fmt::print("\n");
        if (sweep_.csv.empty()) return;
        File file(sweep_.csv);
        file.write(comment_lines(provenance_));
        csv_.emplace(std::move(file), columns, false);
    }

    void write(const Point& point, const std::vector<std::optional<double>>& numbers, const std::vector<Cell>& cells,
               bool is_as_expected) {
        for (std::size_t k = 0; k < point.size(); ++k)
            csv_->cell(numbers[k] ? fmt::format("{}", *numbers[k]) : point[k]);
        for (std::size_t k = 0; k < names_.size(); ++k) {
            const Cell* cell = find(cells, k);
            csv_->cell(cell ? cell->value : missing);
            if (with_error_[k]) csv_->cell(cell ? cell->error.value_or(missing) : missing);
            is_as_expected = is_as_expected && cell && cell->ok;
        }
        csv_->cell(is_as_expected ? "yes" : "no");
        csv_->end_row();
    }

    void remember(const Point& point, const std::vector<std::optional<double>>& numbers,
                  const std::vector<Cell>& cells) {
        SweepRow& row = rows_.emplace_back(SweepRow{point, numbers});
        for (std::size_t k = 0; k < names_.size(); ++k) {
            const Cell* cell = find(cells, k);
            row.results.push_back(cell ? cell->value : missing);
            row.errors.push_back(cell ? cell->error.value_or(missing) : missing);
        }
    }

    /// Of a column: a run that ended early has not all of them, and of those that have one name the first is the first.
    const Cell* find(const std::vector<Cell>& cells, std::size_t column) const {
        const std::string& name = names_[column];
        const auto end = names_.begin() + static_cast<std::ptrdiff_t>(column);
        auto before = std::count(names_.begin(), end, name);
        const auto found =
            std::find_if(cells.begin(), cells.end(), [&](const Cell& c) { return c.name == name && before-- == 0; });
        return found == cells.end() ? nullptr : &*found;
    }

    const Sweep& sweep_;
    std::string title_;
    Provenance provenance_{};
    std::vector<std::size_t> narrow_{};  ///< widths of the parameters' columns
    std::vector<std::string> names_{}, headings_{};
    std::vector<std::size_t> widths_{};
    std::vector<bool> with_error_{};
    std::optional<Csv> csv_{};
    std::vector<SweepRow> rows_{};  ///< for the picture, or the mean
    static constexpr double missing = std::numeric_limits<double>::quiet_NaN();
};

/// What f makes of a point; an Error of its names the point.
template <class F>
auto at_point(const Sweep& sweep, const Point& point, F f) {
    try {
        return f();
    } catch (const Error& e) {
        throw Error(fmt::format("--sweep {}: {}", in_words(sweep, point), e.what()), e.cause());
    }
}

/// What is wrong with a value is known before the first run.
void check(const Scene& scene, const Sweep& sweep, const Point& point) {
    const World start = at_point(sweep, point, [&] {
        World world = scene.world();
        world.check();
        return world;
    });
    for (const std::string& q : sweep.quantities) {
        try {
            Quantity(q, start, scene.parameters(), true);
        } catch (const Error& e) {
            throw Error(fmt::format("--quantity {}: {}", q, e.what()));
        }
    }
}

/// One text, or a list of two.
Json json_of(const Point& words) { return words.size() == 1 ? Json(words[0]) : Json(words); }

Json json_of(const Scene& scene, const Result& result, const Point& point, const std::vector<Cell>& cells,
             const Sweep& sweep) {
    Json run{{"value", json_of(point)}};
    for (const Cell& c : cells)
        if (!sweep.quantities.empty()) run["quantities"][c.name] = c.value;
    run["report"] = Json::parse(report_json(scene, result));
    return run;
}

Swept read_swept(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw wrong(text);
    Swept swept{.name = text.substr(0, equals)};
    const std::string values = text.substr(equals + 1);
    try {
        swept.values = read_range(values).value_or(split(values, ','));
    } catch (const Error& e) {
        throw Error(fmt::format("--sweep {}: {}", text, e.what()));
    }
    if (swept.values.empty() || std::count(swept.values.begin(), swept.values.end(), "") > 0) throw wrong(text);
    return swept;
}

Json names_of(const Sweep& sweep) {
    Point names;
    for (const Swept& parameter : sweep.over) names.push_back(parameter.name);
    return json_of(names);
}

void print_json(const Json& all) { fmt::print("{}\n", all.dump(2, ' ', false, Json::error_handler_t::replace)); }

/// Of all points, before the first run; or until Ctrl-C.
void check_all(const Sweep& sweep, const std::vector<Point>& points, const std::function<Scene(const Point&)>& with) {
    std::vector<SweepRow> rows;
    Progress progress(points.size(), "reading", STDERR_FILENO, "scenes");
    for (std::size_t read = 0; const Point& point : points) {
        if (was_interrupted()) return;
        progress.update(read++);
        const Scene scene = with(point);
        check(scene, sweep, point);
        if (!sweep.picture.empty()) rows.push_back({point, numbers_of(scene, sweep, point)});
    }
    if (!sweep.picture.empty()) check_sweep_picture(sweep, rows);
}

/// The table with what is noted of its runs, which is said as well.
void finish(Table& table, const Noted& noted, std::size_t runs) {
    table.add_mean();
    std::fflush(stdout);
    for (const std::string& note : noted.words(runs)) {
        fmt::print(stderr, "carom: note: {}\n", note);
        table.remark("note: " + note);
    }
    table.commit();
}

}  // namespace

Sweep read_sweep(const std::vector<std::string>& texts) {
    if (texts.size() > 2) throw Error(fmt::format("--sweep {}: a sweep is over one parameter or two", texts.back()));
    Sweep sweep;
    for (const std::string& text : texts) sweep.over.push_back(read_swept(text));
    if (sweep.over.size() < 2) return sweep;
    const Swept &a = sweep.over[0], &b = sweep.over[1];
    if (a.name == b.name) throw Error(fmt::format("--sweep {}: {} is swept already", texts[1], b.name));
    if (a.values.size() * b.values.size() > most_runs)
        throw Error(fmt::format("--sweep {} --sweep {}: {} x {} runs, and a million is the most", texts[0], texts[1],
                                a.values.size(), b.values.size()));
    return sweep;
}

int run_sweep(const std::string& file, const Overrides& overrides, const Sweep& sweep) {
    const auto with = [&](const Point& point) {
        Overrides all = overrides;
        for (std::size_t k = 0; k < point.size(); ++k)
            all.push_back({"--sweep", "", sweep.over[k].name + "=" + point[k]});
        return load(file, all);
    };
    const std::vector<Point> points = points_of(sweep);
    check_all(sweep, points, with);
    const Scene first = with(points[0]);
    Table table(first, sweep);
    Json runs = Json::array();
    Missed missed;
    Noted noted;
    int status = 0;
    std::size_t done = 0;
    const auto label_of = [&](const Point& point) {
        return fmt::format("{}/{} {}", done + 1, points.size(), in_words(sweep, point));
    };
    const auto add_run = [&](const Point& point) {
        const Scene scene = with(point);
        const Products looked_at{.quantities = sweep.quantities, .note = [](const Note&) {}};
        const Result result = at_point(sweep, point, [&] { return perform(scene, label_of(point), looked_at).result; });
        if (result.interrupted) return;  // half of a run is no row
        const auto cells = cells_of(scene, result, sweep.quantities);
        table.add(point, numbers_of(scene, sweep, point), cells, result.ok());
        if (sweep.json) runs.push_back(json_of(scene, result, point, cells, sweep));
        status = std::max(status, status_of(result, in_words(sweep, point)));
        noted.add(in_words(sweep, point), result.notes);
        if (!sweep.quantities.empty()) missed.add(fmt::format("{}", fmt::join(point, " ")), result);
        ++done;
    };
    for (const Point& point : points) {
        if (was_interrupted()) break;
        try {
            add_run(point);
        } catch (const Error&) {
            finish(table, noted, done);  // what was computed is kept
            throw;
        }
    }
    const bool interrupted = done < points.size();
    const std::string words = fmt::format("interrupted after {} of {} runs", done, points.size());
    if (interrupted) status = 1, table.remark(words);
    finish(table, noted, done);
    if (sweep.json)
        print_json({{"scene", first.file()}, {"sweep", names_of(sweep)}, {"interrupted", interrupted}, {"runs", runs}});
    else if (!sweep.csv.empty() && done > 0)
        fmt::print("wrote {}\n", sweep.csv);
    if (!sweep.picture.empty() && done > 0) {
        table.draw();
        if (!sweep.json) fmt::print("wrote {}\n", sweep.picture);
    }
    std::fflush(stdout);
    if (!missed.words().empty()) fmt::print(stderr, "carom: {}\n", missed.words());
    if (interrupted) fmt::print(stderr, "carom: {}\n", words);
    return status;
}

}  // namespace carom::app
