#include "sweep.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <carom/output.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "jobs_in_order.hpp"
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

/// What is wrong with a value is known before the first run. Returns the threads of the scene.
int check(const Scene& scene, const Sweep& sweep, const Point& point) {
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
    return start.settings().threads;
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

using SceneAt = std::function<Scene(const Point&)>;

/// Before the first run, or until Ctrl-C: the points that are likely to tell, and of few all others, as long as that
/// takes no time to speak of. The rest is checked as it comes: to build a hundred thousand worlds takes minutes.
/// Returns the threads that there are for the runs.
int check_first(const Sweep& sweep, const std::vector<Point>& points, const SceneAt& with) {
    std::vector<SweepRow> rows;
    const std::vector<std::size_t> telling = telling_points_of(sweep);
    const auto start = std::chrono::steady_clock::now();
    Progress progress(telling.size(), "reading", STDERR_FILENO, "scenes");
    int threads = 1;
    for (std::size_t read = 0; const std::size_t k : telling) {
        if (was_interrupted()) return threads;
        progress.update(read++);
        const Scene scene = with(points[k]);
        threads = std::max(threads, check(scene, sweep, points[k]));
        if (!sweep.picture.empty()) rows.push_back({points[k], numbers_of(scene, sweep, points[k])});
    }
    if (!sweep.picture.empty()) check_sweep_picture(sweep, rows);
    constexpr std::size_t few = 1000;
    constexpr std::chrono::seconds patience{1};
    const auto told = [&](std::size_t k) { return std::binary_search(telling.begin(), telling.end(), k); };
    for (std::size_t k = 0; points.size() <= few && k < points.size(); ++k) {
        if (was_interrupted() || std::chrono::steady_clock::now() - start > patience) break;
        if (!told(k)) check(with(points[k]), sweep, points[k]);
    }
    return threads;
}

/// The table with what is noted of its runs, which is said as well.
void write(SweepTable& table, const Noted& noted, std::size_t runs) {
    table.add_means();
    std::fflush(stdout);
    for (const std::string& note : noted.words(runs)) {
        fmt::print(stderr, "carom: note: {}\n", note);
        table.remark("note: " + note);
    }
    table.write();
}

/// A run that was made, or why it could not be.
struct Made {
    std::size_t job;
    std::optional<Scene> scene{};
    std::optional<Result> result{};
    std::exception_ptr error{};
};

class SweepRuns {
  public:
    SweepRuns(const Sweep& sweep, std::vector<Point> points, SceneAt with, int threads)
        : sweep_(sweep),
          points_(std::move(points)),
          with_(std::move(with)),
          // Fewer runs than threads share the threads one after another.
          abreast_(points_.size() < static_cast<std::size_t>(threads) ? 1 : static_cast<std::size_t>(threads)),
          first_(with_(points_[0])),
          table_(first_, sweep),
          // On a terminal its rows are to be seen.
          progress_(points_.size(), "sweep", ::isatty(STDOUT_FILENO) == 1 ? -1 : STDERR_FILENO, "runs") {}

    int run() {
        JobsInOrder<Made> runs(points_.size(), abreast_);
        runs.run([this](std::size_t job) { return make(job); }, [this](Made made) { return take(std::move(made)); });
        progress_.finish();
        if (!error_) return report();
        if (done_ > 0) report();  // what was computed is kept
        std::rethrow_exception(error_);
    }

  private:
    Made make(std::size_t job) const {
        Made made{job};
        if (was_interrupted()) return made;
        const Point& point = points_[job];
        try {
            made.scene = with_(point);
            const Products looked_at{
                .quantities = sweep_.quantities, .note = [](const Note&) {}, .alone = abreast_ == 1};
            const std::string label = fmt::format("{}/{} {}", job + 1, points_.size(), in_words(sweep_, point));
            made.result = at_point(sweep_, point, [&] { return perform(*made.scene, label, looked_at).result; });
        } catch (...) {
            made.error = std::current_exception();
        }
        return made;
    }

    bool take(Made made) {
        if (was_interrupted() && (!made.result || made.result->interrupted)) return false;  // half of a run is no row
        try {
            if (made.error) std::rethrow_exception(made.error);
            add(points_[made.job], *made.scene, *made.result);
        } catch (...) {
            error_ = std::current_exception();
            interrupt_runs();
            return false;
        }
        progress_.update(++done_);
        return true;
    }
    void add(const Point& point, const Scene& scene, const Result& result) {
        const auto cells = cells_of(scene, result, sweep_.quantities);
        table_.add(point, numbers_of(scene, sweep_, point), cells, outcome_of(result));
        if (sweep_.json) runs_.push_back(json_of(scene, result, point, cells, sweep_));
        status_ = std::max(status_, status_of(result, in_words(sweep_, point)));
        noted_.add(in_words(sweep_, point), result.notes);
        if (sweep_.quantities.empty()) noted_.add(in_words(sweep_, point), notes_of(result.left_out));
        if (!sweep_.quantities.empty()) missed_.add(fmt::format("{}", fmt::join(point, " ")), result);
    }

    int report() {
        const bool interrupted = done_ < points_.size();
        const std::string words =
            fmt::format("{} after {} of {} runs", error_ ? "ended by an error" : "interrupted", done_, points_.size());
        if (interrupted) status_ = 1, table_.remark(words);
        write(table_, noted_, done_);
        if (sweep_.json)
            print_json(sweep_, first_, runs_, table_, interrupted);
        else if (!sweep_.csv.empty() && done_ > 0)
            fmt::print("wrote {}\n", sweep_.csv);
        if (!sweep_.picture.empty() && done_ > 0) {
            table_.draw();
            if (!sweep_.json) fmt::print("wrote {}\n", sweep_.picture);
        }
        std::fflush(stdout);
        if (!missed_.words().empty()) fmt::print(stderr, "carom: {}\n", missed_.words());
        if (interrupted && !error_) fmt::print(stderr, "carom: {}\n", words);  // an error is said by who catches it
        return status_;
    }

    const Sweep& sweep_;
    const std::vector<Point> points_;
    const SceneAt with_;
    const std::size_t abreast_;
    const Scene first_;
    SweepTable table_;
    Progress progress_;
    Json runs_ = Json::array();
    Missed missed_{};
    Noted noted_{};
    int status_ = 0;
    std::size_t done_ = 0;
    std::exception_ptr error_{};
};

}  // namespace

int run_sweep(const std::string& file, const Overrides& overrides, const Sweep& sweep) {
    const auto with = [&](const Point& point) {
        Overrides all = overrides;
        for (std::size_t k = 0; k < point.size(); ++k)
            all.push_back({"--sweep", "", sweep.over[k].name + "=" + point[k]});
        return load(file, all);
    };
    std::vector<Point> points = points_of(sweep);
    const int threads = check_first(sweep, points, with);
    return SweepRuns(sweep, std::move(points), with, threads).run();
}

}  // namespace carom::app
