#include "products.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <carom/output.hpp>
#include <chrono>
#include <cmath>
#include <optional>

#include "build.hpp"
#include "checkpoint.hpp"
#include "drift.hpp"
#include "measures.hpp"
#include "notes.hpp"
#include "pictures.hpp"
#include "quantity_table.hpp"
#include "report.hpp"

namespace carom::app {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
    if (folder == "-") throw Error("- is standard output, and no folder to write to: name one, as out");
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (!failed && !fs::is_directory(folder, failed)) failed = std::make_error_code(std::errc::not_a_directory);
    if (failed)
        throw Error(fmt::format("the folder {} cannot be made: {}", folder.string(), failed.message()),
                    Error::Cause::run);
}

void write_file(const fs::path& path, const std::string& text) {
    File file(path);
    file.write(text);
    file.commit();
}

namespace {

Provenance provenance_of_run(const Scene& scene) {
    return {.version = CAROM_VERSION,
            .build = build_words(),
            .seed = fmt::format("{}", scene.seed()),
            .scene = scene.text(),
            .parameters = scene.parameters()};
}

/// All that is recorded while a scene runs.
class Recording {
  public:
    /// `before`: the scene of the bookmarks, if it is another one.
    Recording(const Scene& scene, const World& start, const Products& wanted, std::span<const Bookmark> bookmarks,
              const Scene* before, std::optional<Pictures> pictures)
        : wanted_(wanted), provenance_(provenance_of_run(scene)), files_(wanted.data), pictures_(std::move(pictures)) {
        if (wanted.report && wanted.data.empty())
            files_.push_back({(fs::path(wanted.folder) / "trajectory.csv").string(), DataFormat::csv});
        if (is_measured(start)) meter_.emplace(start);
        measure_from_ = scene.plan().measure_from;
        if (meter_ && measure_from_ > 0 && measure_from_ >= scene.plan().duration)
            throw Error(
                fmt::format("{}: run.measure_from must be before the end of the run at {} s, got {} s: nothing "
                            "would be measured",
                            scene.file(), scene.plan().duration, measure_from_));
        const Provenance known = before ? provenance_of_run(*before) : provenance_;
        for (std::size_t k = 0; k < files_.size(); ++k) {
            const auto& [path, format] = files_[k];
            if (k < bookmarks.size())
                data_.emplace_back(bookmarks[k], format, start, provenance_, before ? &known : nullptr);
            else
                data_.emplace_back(path, format, start, provenance_);
        }
        for (std::size_t k = 0; k < wanted.tables.size(); ++k) {
            const std::size_t place = files_.size() + k;
            const bool begun = place < bookmarks.size() && bookmarks[place].length > 0;
            const Revision revision{comment_lines(known), comment_lines(provenance_)};
            tables_.emplace_back(place < bookmarks.size() ? File(bookmarks[place], revision) : File(wanted.tables[k]),
                                 begun, scene, start, wanted.quantities, provenance_);
        }
    }

    void observe(const World& world) {
        if (pictures_) pictures_->observe(world);
        if (meter_) meter_->observe(world, measure_from_);
        stream_measures();
        for (Trajectory& data : data_) data.add(world);
        for (QuantityTable& table : tables_) table.add(world);
    }

    /// Data that are on the disk, and what pictures collected.
    void save(Saver& to) {
        std::vector<Bookmark> bookmarks;
        for (Trajectory& data : data_) bookmarks.push_back(data.sync());
        for (QuantityTable& table : tables_) bookmarks.push_back(table.sync());
        to(bookmarks);
        if (pictures_) pictures_->save(to);
        if (meter_) meter_->save(to);
    }
    void restore(Loader& from) {
        if (pictures_) pictures_->restore(from);
        if (meter_) meter_->restore(from);
    }
    void release() {
        for (Trajectory& data : data_) data.release();
        for (QuantityTable& table : tables_) table.release();
    }

    // Data before pictures, which may fail for want of gnuplot.
    void write(const Scene& scene, const World& start, Performance& out) {
        if (meter_) out.result.measures = meter_->numbers(), out.result.left_out = meter_->left_out();
        for (std::size_t k = 0; k < data_.size(); ++k) {
            data_[k].commit(summary_json(scene, out.result), meter_ ? &*meter_ : nullptr);
            out.files.emplace_back(files_[k].path);
        }
        for (std::size_t k = 0; k < tables_.size(); ++k) {
            tables_[k].commit(summary_json(scene, out.result));
            out.files.emplace_back(wanted_.tables[k]);
        }
        const fs::path folder = wanted_.folder;
        if (wanted_.report) write_report(folder, scene, start, out);
        if (pictures_)
            for (const fs::path& file : pictures_->draw(folder, wanted_.format)) out.files.push_back(file);
    }

  private:
    /// What is known so far is on the disk all the time, whatever ends the run.
    void stream_measures() {
        constexpr std::chrono::seconds now_and_then{2};
        const auto now = std::chrono::steady_clock::now();
        if (!meter_ || !wanted_.report || now - last_written_ < now_and_then) return;
        write_measures(*meter_, wanted_.folder, provenance_);
        last_written_ = now;
    }

    void write_report(const fs::path& folder, const Scene& scene, const World& start, Performance& out) {
        out.files.push_back(folder / "report.json");
        write_file(out.files.back(), report_json(scene, out.result) + "\n");
        out.files.push_back(folder / "scene.json");
        write_file(out.files.back(), scene.text());
        Provenance known = provenance_;
        known.summary = summary_json(scene, out.result);
        if (meter_)
            for (const fs::path& file : write_measures(*meter_, folder, known)) out.files.push_back(file);
        if (!out.result.failure.empty()) return;
        out.files.push_back(folder / ("end." + wanted_.format));
        draw(out.result.world, fit(join(bounds(start), bounds(out.result.world))), out.files.back());
    }

    const Products& wanted_;
    Provenance provenance_;
    std::vector<DataFile> files_;
    std::optional<Pictures> pictures_;
    std::optional<GasMeter> meter_;
    double measure_from_ = 0;
    std::chrono::steady_clock::time_point last_written_ = std::chrono::steady_clock::now();
    std::vector<Trajectory> data_;
    std::vector<QuantityTable> tables_;
};

/// Of a long run what its pictures keep is more than what the machine has.
std::optional<Note> note_of_frames(const Plan& plan) {
    constexpr double many = 2e6, enough = 1e6;  // some hundred bytes each
    const double steps = static_cast<double>(steps_of(plan)), frames = steps / plan.every;
    if (frames <= many) return {};
    return Note{"frames",
                fmt::format("the pictures of this run keep all of {:.2g} frames until they are drawn; --every "
                            "{:.0f} makes a million of them",
                            frames, std::ceil(steps / enough))};
}

/// What is left may take as long as the run did.
void say_writing(const Result& result, const Products& wanted) {
    const bool nothing = wanted.data.empty() && wanted.tables.empty() && wanted.folder.empty();
    if (!result.interrupted || nothing || ::isatty(STDERR_FILENO) == 0) return;
    fmt::print(stderr, "carom: interrupted; writes what there is (Ctrl-C again gives that up)\n");
}

/// A run gets another end after the moment of its checkpoint alone, and one that changes nothing of what was before.
void check_new_end(const Scene& scene, const Scene& before, const Course& now, const World& start,
                   const Products& wanted) {
    const Plan plan = scene.plan();
    if (now.done >= steps_of(plan))
        throw Error(fmt::format("--duration {} ends before the checkpoint, which is of t = {:.6g} s: it must be longer",
                                plan.duration, now.world.time()));
    if (!wanted.folder.empty())
        Pictures(scene, start).require_same_until(now.world, Pictures(before, start), before.plan());
}

/// Notes of how a run begins. Of one that goes on they were told then.
std::vector<Note> note_start(const Scene& scene, const World& start, const Products& wanted, bool goes_on) {
    if (!wanted.note) return {};
    std::vector<Note> notes = notes_at_start(scene, start, wanted.quantities);
    if (!wanted.folder.empty())
        if (const auto frames = note_of_frames(scene.plan())) notes.push_back(*frames);
    for (const Note& note : notes)
        if (!goes_on) wanted.note(note);
    return notes;
}

/// Notes of how a run came out; of bodies that were inside of one another from the start there is one already.
void note_end(const Drift& drift, const World& end, const Products& wanted, std::vector<Note>& notes) {
    const auto is_overlap = [](const Note& note) { return note.kind == "overlap"; };
    if (std::none_of(notes.begin(), notes.end(), is_overlap))
        for (const Note& note : notes_at_end(end)) wanted.note(notes.emplace_back(note));
    if (const Note doubt = drift.doubt(end); !doubt.text.empty()) wanted.note(notes.emplace_back(doubt));
}

World on_one_thread(World world) {
    Settings settings = world.settings();
    settings.threads = 1;
    world.configure(settings);
    return world;
}

}  // namespace

Performance perform(const Scene& scene, const std::string& label, const Products& wanted, const std::string& state,
                    const Scene* before) {
    const World start = wanted.alone ? scene.world() : on_one_thread(scene.world());
    std::vector<Note> notes = note_start(scene, start, wanted, !state.empty());
    Course course(scene, start);
    if (wanted.check_pictures && wanted.folder.empty()) Pictures(scene, start);
    std::vector<Bookmark> bookmarks;
    Loader from(state);
    if (!state.empty()) {
        course.restore(from);
        from(bookmarks);
        if (before != nullptr) check_new_end(scene, *before, course, start, wanted);
    }
    std::optional<Pictures> pictures;
    if (!wanted.folder.empty()) {
        pictures.emplace(scene, start);
        make_folder(wanted.folder);
    }
    std::optional<Checkpoints> checkpoints;  // before any data are written: it may be refused
    if (!wanted.checkpoints.file.empty()) checkpoints.emplace(scene, label, wanted, provenance_of_run(scene));
    Recording recording(scene, start, wanted, bookmarks, before, std::move(pictures));
    Drift drift(scene.plan());
    if (!state.empty()) {
        recording.restore(from);
        drift.restore(from);
    }

    Bystander bystander;
    if (checkpoints)
        bystander = [&](const Course& now, bool edge) {
            if (!edge && !checkpoints->due(now.done)) return;
            checkpoints->write([&](Saver& to) {
                now.save(to);
                recording.save(to);
                drift.save(to);
            });
        };
    const Observer observe = [&](const World& world) {
        recording.observe(world);
        if (wanted.note) drift.observe(world);
    };
    std::optional<Performance> out;
    try {
        out = Performance{run(scene, std::move(course), wanted.alone ? label : "", {observe}, bystander), {}};
        if (wanted.note && out->result.failure.empty()) note_end(drift, out->result.world, wanted, notes);
        out->result.notes = std::move(notes);
        say_writing(out->result, wanted);
        recording.write(scene, start, *out);
    } catch (const Error& e) {
        if (checkpoints) throw checkpoints->with_way_on(e);
        throw;
    }
    const bool stays = out->result.interrupted || (out->result.failure.empty() && wanted.can_be_longer());
    if (checkpoints && !stays) {
        checkpoints->remove();
        recording.release();
    }
    return std::move(*out);
}

}  // namespace carom::app
