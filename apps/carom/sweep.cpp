#include "sweep.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <carom/output.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "products.hpp"
#include "report.hpp"
#include "sweep_picture.hpp"
#include "sweep_remarks.hpp"
#include "sweep_table.hpp"
#include "sweep_values.hpp"

namespace carom::app {

namespace {

using Json = nlohmann::ordered_json;

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

Json names_of(const Sweep& sweep) {
    Point names;
    for (const Swept& parameter : sweep.over) names.push_back(parameter.name);
    return json_of(names);
}

/// The mean of a quantity that too few runs have is null.
Json json_of(const std::vector<SweepMean>& means) {
    Json all = Json::array();
    for (const SweepMean& mean : means) {
        Json columns = Json::array();
        for (const SweepMean::Column& c : mean.columns) {
            const auto number = [](std::optional<double> x) { return x ? Json(*x) : Json(); };
            columns.push_back({{"name", c.name},
                               {"unit", c.unit},
                               {"mean", number(c.mean)},
                               {"standard_error", number(c.error)},
                               {"samples", c.samples}});
        }
        all.push_back(
            {{"value", json_of(mean.point)}, {"runs", mean.runs}, {"whole", mean.whole}, {"columns", columns}});
    }
    return all;
}

void print_json(const Sweep& sweep, const Scene& scene, const Json& runs, const SweepTable& table, bool interrupted) {
    const Json all{{"scene", scene.file()},
                   {"sweep", names_of(sweep)},
                   {"interrupted", interrupted},
                   {"runs", runs},
                   {"means", json_of(table.means())}};
    fmt::print("{}\n", all.dump(2, ' ', false, Json::error_handler_t::replace));
}

/// Why a row lacks what others may have.
std::vector<Note> notes_of(const std::vector<GasAbsence>& left_out) {
    std::vector<Note> notes;
    for (const GasAbsence& a : left_out)
        notes.push_back({"left out: " + a.quantity, fmt::format("{} is left out: {}", a.name, a.why)});
    return notes;
}

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
void finish(SweepTable& table, const Noted& noted, std::size_t runs) {
    table.add_means();
    std::fflush(stdout);
    for (const std::string& note : noted.words(runs)) {
        fmt::print(stderr, "carom: note: {}\n", note);
        table.remark("note: " + note);
    }
    table.write();
}

}  // namespace

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
    SweepTable table(first, sweep);
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
        table.add(point, numbers_of(scene, sweep, point), cells, outcome_of(result));
        if (sweep.json) runs.push_back(json_of(scene, result, point, cells, sweep));
        status = std::max(status, status_of(result, in_words(sweep, point)));
        noted.add(in_words(sweep, point), result.notes);
        if (sweep.quantities.empty()) noted.add(in_words(sweep, point), notes_of(result.left_out));
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
        print_json(sweep, first, runs, table, interrupted);
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
