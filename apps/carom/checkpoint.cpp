#include "checkpoint.hpp"

#include <fmt/format.h>

#include <charconv>
#include <map>

#include "outputs.hpp"

namespace carom::app {

namespace fs = std::filesystem;

namespace {

Error wrong(const std::string& text) {
    return Error(
        fmt::format("--checkpoint {}: must be every=N with a number of steps or a time like 60s, 5min or 1h, "
                    "and behind commas file=FILE and keep if wanted",
                    text));
}

/// "1000" steps, or "60s" of the clock.
bool read_interval(const std::string& text, Checkpointing& to) {
    static const std::map<std::string, double, std::less<>> units{{"s", 1}, {"min", 60}, {"h", 3600}};
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const std::string unit(end, text.data() + text.size());
    if (error != std::errc() || !(number > 0 && number <= 1e15)) return false;
    if (const auto known = units.find(unit); known != units.end()) {
        to.steps = 0;
        to.seconds = number * known->second;
        return true;
    }
    to.steps = static_cast<std::uint64_t>(number);
    return unit.empty() && static_cast<double>(to.steps) == number;
}

void read_checkpointing(const std::string& text, Checkpointing& to) {
    for (std::size_t start = 0; start <= text.size();) {
        const auto end = std::min(text.find(',', start), text.size());
        const std::string part = text.substr(start, end - start);
        start = end + 1;
        if (part.starts_with("file=") && part.size() > 5)
            to.file = part.substr(5);
        else if (part == "keep")
            to.keep = true;
        else if (!part.starts_with("every=") || !read_interval(part.substr(6), to))
            throw wrong(text);
    }
}

void require_ordinary(const fs::path& path) {
    if (fs::exists(path) && !fs::is_regular_file(path) && !fs::is_directory(path))
        throw Error(fmt::format("--checkpoint: {} is no ordinary file, and no run can go on with it", path.string()));
}

std::string default_file(const std::string& label, const Products& products) {
    const fs::path folder = !products.folder.empty()   ? fs::path(products.folder)
                            : !products.data.empty()   ? fs::path(products.data[0].path).parent_path()
                            : !products.tables.empty() ? fs::path(products.tables[0]).parent_path()
                                                       : fs::path();
    return (folder / (label + ".checkpoint")).string();
}

}  // namespace

void prepare_checkpoints(const std::string& text, const std::string& label, Products& products) {
    read_checkpointing(text, products.checkpoints);
    std::string& file = products.checkpoints.file;
    if (file.empty()) file = default_file(label, products);
    require_ordinary(file);
    for (const DataFile& data : products.data) require_ordinary(data.path);
    for (const std::string& table : products.tables) require_ordinary(table);
    if (!products.folder.empty()) products.folder = fs::absolute(products.folder).string();
    for (DataFile& data : products.data) data.path = fs::absolute(data.path).string();
    for (std::string& table : products.tables) table = fs::absolute(table).string();
}

namespace {

/// A few of the files of a run, as seen from here.
std::string files_of(const Products& products) {
    constexpr std::size_t named = 3;
    std::vector<std::string> files = products.tables;
    for (const DataFile& data : products.data) files.push_back(data.path);
    if (files.empty() && !products.folder.empty()) files.push_back(products.folder);
    const std::size_t more = files.size() - std::min(named, files.size());
    files.resize(files.size() - more);
    for (std::string& file : files) {
        std::error_code error;
        const fs::path near = fs::relative(file, error);
        if (!error && !near.string().starts_with("..")) file = near.string();
    }
    const std::string all = fmt::format("{}", fmt::join(files, ", "));
    return more > 0 ? fmt::format("{} and {} more", all, more) : all;
}

/// The same option with another name.
std::string elsewhere(const Checkpointing& c) {
    const std::string interval = c.steps > 0 ? fmt::format("{}", c.steps) : fmt::format("{}s", c.seconds);
    return fmt::format("give another name (--checkpoint every={},file=NAME)", interval);
}

/// An Error if a run that had not come to its end can go on from what is to be replaced. Of one that had, the
/// checkpoint is from before the last step.
void require_no_unfinished(const Checkpointing& wanted) {
    std::optional<Resumed> there;
    try {
        there = resume(wanted.file);
    } catch (const OtherVersion& e) {
        throw Error(fmt::format("{}: finish its run with that, remove it, or {}", e.what(), elsewhere(wanted)));
    } catch (const Error&) {
        return;  // there is none, or none that anybody can go on from
    }
    std::uint64_t done = 0;
    Loader(there->state)(done);
    const Plan plan = there->scene.plan();
    if (done + 1 >= steps_of(plan)) return;
    const std::string files = files_of(there->products);
    throw Error(fmt::format(
        "{} is of a run that was interrupted at t = {:.4g} s of {:.4g} s{}: go on with it (carom run --resume {}), "
        "remove it, or {}",
        wanted.file, static_cast<double>(done) * plan.step, plan.duration,
        files.empty() ? "" : fmt::format(" ({})", files), in_shell(wanted.file), elsewhere(wanted)));
}

}  // namespace

Checkpoints::Checkpoints(const Scene& scene, const std::string& label, const Products& products, Provenance provenance)
    : scene_file_(scene.file()),
      label_(label),
      products_(products),
      provenance_(std::move(provenance)),
      any_(products.resumed == products.checkpoints.file) {
    const Checkpointing& wanted = products.checkpoints;
    if (products.resumed.empty() || checkpoint_lock(products.resumed) != checkpoint_lock(wanted.file)) {
        try {
            claim_.emplace(wanted.file);
        } catch (const Error& e) {
            throw Error(fmt::format("{}: {}", e.what(), elsewhere(wanted)));
        }
        require_no_unfinished(wanted);
    }
    File(products.checkpoints.file);  // the disk is asked before the run, not after an hour of it
}

bool Checkpoints::due(std::uint64_t steps_done) {
    const Checkpointing& every = products_.checkpoints;
    if (every.steps > 0) return steps_done % every.steps == 0;
    return std::chrono::duration<double>(Clock::now() - last_).count() >= every.seconds;
}

void Checkpoints::write(const std::function<void(Saver&)>& save_state) {
    save_checkpoint(products_.checkpoints.file, provenance_, [&](Saver& to) {
        to(scene_file_, provenance_.scene, label_, products_);
        save_state(to);
    });
    last_ = Clock::now();
    any_ = true;
}

Error Checkpoints::with_way_on(const Error& error) const {
    if (!any_ || error.cause() == Error::Cause::input) return error;
    const std::string& file = products_.checkpoints.file;
    return Error(
        fmt::format("{}; carom run --resume {} goes on from the last checkpoint", error.what(), in_shell(file)),
        error.cause());
}

void Checkpoints::remove() const {
    std::error_code ignored;
    fs::remove(products_.checkpoints.file, ignored);
}

Resumed resume(const std::string& file) {
    std::string state = load_checkpoint(file);
    try {
        Loader from(state);
        std::string scene_file, scene, label;
        Products products;
        from(scene_file, scene, label, products);
        return {Scene::parse(scene, scene_file), label, products, std::string(from.rest())};
    } catch (const Error& e) {
        throw Error(fmt::format("{}: {}", file, e.what()));
    }
}

}  // namespace carom::app
