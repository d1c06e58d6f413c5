#include "pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <carom/analysis.hpp>
#include <cctype>
#include <cmath>
#include <set>

#include "experiment.hpp"
#include "measures.hpp"
#include "report.hpp"

namespace carom::app {

namespace {

/// Calls f with all that a recorder collects.
template <class F>
void collected(F& f, auto& r) {
    f(r.time, r.energies, r.moments, r.profiles, r.around.lines);
    for (auto& track : r.tracks) f(track.points, track.shapes);
    for (auto& series : r.series) f(series.values);
    if constexpr (std::is_same_v<F, Saver>) {
        if (r.meter) r.meter->save(f);
    } else {
        if (r.meter) r.meter->restore(f);
    }
}

constexpr std::size_t most_bodies = 20;

const char* name_of(PictureType type) {
    for (const auto& choice : choices(&type))
        if (choice.value == type) return choice.name;
    return "";
}

/// A file for each, without ending. A name that is another's already gets a number, and so does `end`, as a run calls
/// what it draws of its end.
std::vector<std::string> files_of(const std::vector<Picture>& pictures) {
    std::vector<std::string> files(pictures.size());
    std::set<std::string> taken{"end"};
    // First what the scene names: what goes without a name makes way for that.
    for (std::size_t i = 0; i < files.size(); ++i)
        if (!pictures[i].name.empty() && taken.insert(pictures[i].name).second) files[i] = pictures[i].name;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (!files[i].empty()) continue;
        const std::string name = pictures[i].name.empty() ? name_of(pictures[i].type) : pictures[i].name;
        files[i] = name;
        for (int number = 2; !taken.insert(files[i]).second; ++number) files[i] = fmt::format("{}-{}", name, number);
    }
    return files;
}

std::vector<BodyId> moving_bodies(const World& world) {
    std::vector<BodyId> ids;
    for (std::size_t i = 0; i < world.size(); ++i)
        if (world.kinds()[i] != Kind::fixed) ids.push_back(world.ids()[i]);
    return ids;
}

/// Those the picture names, or all; of many some from the first to the last, as neighbours have one way.
std::vector<BodyId> shown_bodies(const Picture& picture, const World& world) {
    std::vector<BodyId> ids;
    for (const std::string& name : picture.bodies) ids.push_back(world.find(name));
    if (!ids.empty()) return ids;
    const std::vector<BodyId> all = moving_bodies(world);
    if (all.size() <= most_bodies) return all;
    for (std::size_t k = 0; k < most_bodies; ++k) ids.push_back(all[k * (all.size() - 1) / (most_bodies - 1)]);
    return ids;
}

/// The unit that the scene names, or that all the quantities have.
std::string axis_unit(const Picture& picture) {
    if (!picture.unit.empty() || picture.quantities.empty()) return picture.unit;
    const std::string unit = unit_of(picture.quantities[0]);
    for (const std::string& quantity : picture.quantities)
        if (unit_of(quantity) != unit) return "";
    return unit;
}

/// What several quantities of one unit have in common.
std::string kind_of(const std::vector<std::string>& quantities, const std::string& unit) {
    const auto is_speed = [](const std::string& quantity) { return quantity.ends_with(".speed"); };
    if (std::all_of(quantities.begin(), quantities.end(), is_speed)) return "speed";
    constexpr std::pair<const char*, const char*> kinds[] = {{"m", "position"}, {"m/s", "velocity"},
                                                             {"rad", "angle"},  {"rad/s", "angular velocity"},
                                                             {"J", "energy"},   {"kg m/s", "momentum"}};
    for (const auto& [known, kind] : kinds)
        if (unit == known) return kind;
    return "";
}

/// A point once in a period is one of the frames.
void require_frames(double period, const Plan& plan) {
    const double frame = plan.step * plan.every, frames = period / frame;
    if (std::round(frames) >= 1 && std::abs(frames - std::round(frames)) <= 1e-9 * frames) return;
    throw Error(fmt::format(
        "period must be a whole number of frames, which come every {} s, got {} s, which are {:.6g}: with the "
        "run.step \"PERIOD/100\" it is",
        frame, period, frames));
}

/// Whether some number of whole periods is over now, to a thousandth of a step.
bool is_at_period(double period, const World& now, const Plan& plan) {
    return std::abs(now.time() - std::round(now.time() / period) * period) <= 1e-3 * plan.step;
}

/// A quantity without the quotes that a name with blanks has in an expression.
std::string unquoted(const std::string& quantity) {
    std::string out;
    for (std::size_t i = 0; i < quantity.size(); ++i) {
        const bool doubled = quantity.compare(i, 2, "''") == 0;
        if (quantity[i] != '\'' || doubled) out += quantity[i];
        if (doubled) ++i;  // two are one of the name
    }
    return out;
}

bool in_name(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return std::isalnum(byte) != 0 || byte >= 0x80 || c == '_' || c == '[' || c == ']';
}

/// Where a name ends that starts there.
std::size_t end_of_name(const std::string& text, std::size_t start) {
    std::size_t end = start + 1;
    if (text[start] != '\'') {
        while (end < text.size() && in_name(text[end])) ++end;
        return end;
    }
    while (end < text.size() && (text[end] != '\'' || text.compare(end, 2, "''") == 0))
        end += text[end] == '\'' ? 2 : 1;
    return std::min(end + 1, text.size());
}

/// The body, or what else there is with a dot behind it, that a quantity is about: "A" of "2*A.vx". All of it if there
/// are several or none.
std::string subject_of(const std::string& quantity) {
    std::string subject;
    for (std::size_t i = 0; i < quantity.size(); ++i) {
        if (quantity[i] != '\'' && !in_name(quantity[i])) continue;
        const std::size_t end = end_of_name(quantity, i);
        const std::string name = unquoted(quantity.substr(i, end - i));
        const bool dotted =
            end < quantity.size() && quantity[end] == '.' && !std::isdigit(static_cast<unsigned char>(quantity[i]));
        i = end;
        while (i < quantity.size() && (quantity[i] == '.' || in_name(quantity[i]))) ++i;  // .heat.impact
        if (!dotted) continue;
        if (!subject.empty() && subject != name) return quantity;
        subject = name;
    }
    return subject.empty() ? quantity : subject;
}

}  // namespace

Pictures::Pictures(const Scene& scene, const World& start)
    : title_(scene.title()), plan_(scene.plan()), twins_(scene.twins()), parameters_(scene.parameters()) {
    if (!start.rectangles().empty()) room_ = start.rectangles()[0];
    space_ = room_;
    if (const auto box = start.periodic()) space_ = Rectangle{.low = box->low, .high = box->high};
    // So many bodies in each that their mean says something.
    slices_ = std::clamp<std::size_t>(start.size() / 100, 4, 60);
    walls_.assign(start.half_planes().begin(), start.half_planes().end());
    std::vector<Picture> wanted = scene.pictures();
    // Paths of many discs are a tangle; what is to be seen of a gas is its measures.
    const bool gas = std::holds_alternative<Events>(start.settings().solver) && start.size() > most_bodies;
    if (wanted.empty())
        wanted = {{.type = gas ? PictureType::gas : PictureType::trajectories}, {.type = PictureType::energy}};
    const auto is_twin = [](const Picture& picture) { return picture.type == PictureType::twin; };
    if (!twins_.empty() && std::none_of(wanted.begin(), wanted.end(), is_twin))
        wanted.push_back({.type = PictureType::twin});
    const std::vector<std::string> files = files_of(wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        try {
            recorders_.push_back(prepare(wanted[i], start));
        } catch (const Error& e) {
            throw Error(fmt::format("{}: pictures[{}] is wrong: {}", scene.file(), i, e.what()));
        }
        recorders_.back().file = files[i];
    }
    choose_colours(start);
}

/// A body has its own colour in all pictures, if that is no other's; or else each quantity has one, where some picture
/// shows two of the same body. No other one of the same picture has that colour, as far as there are enough.
void Pictures::choose_colours(const World& start) {
    std::set<std::string> subjects, shared;
    for (const Recorder& r : recorders_) {
        std::set<std::string> here;
        for (const Series& series : r.series)
            if (const auto subject = subject_of(series.label);
                !here.insert(subject).second && r.picture.type == PictureType::time)
                shared.insert(subject);
        subjects.merge(here);
    }
    const auto key = [&](const Series& series) {
        const std::string subject = subject_of(series.label);
        return shared.contains(subject) ? series.label : subject;
    };
    std::map<std::string, Colour> chosen;
    std::vector<Colour> own;
    for (std::size_t i = 0; !subjects.empty() && i < start.size(); ++i) {
        const Body body = start.body(start.ids()[i]);
        if (!subjects.contains(body.name) || shared.contains(body.name) || !body.colour) continue;
        if (std::find(own.begin(), own.end(), *body.colour) != own.end()) continue;
        own.push_back(*body.colour);
        chosen.emplace(body.name, own.back());
    }
    for (Recorder& r : recorders_) {
        std::vector<Colour> taken;
        for (const Series& series : r.series)
            if (const auto known = chosen.find(key(series)); known != chosen.end()) taken.push_back(known->second);
        for (Series& series : r.series) {
            auto [known, is_new] = chosen.try_emplace(key(series));
            constexpr std::size_t enough = 7;  // colours in the palette
            for (std::size_t i = chosen.size() - 1; is_new && i < chosen.size() - 1 + enough; ++i) {
                known->second = palette(i);
                if (std::find(taken.begin(), taken.end(), palette(i)) == taken.end()) break;
            }
            taken.push_back(known->second);
            series.colour = known->second;
        }
    }
}

/// Those the picture names, or all.
void Pictures::choose_twins(Recorder& r) const {
    auto& named = r.picture.quantities;
    for (const Twin& twin : twins_)
        if (named.empty() || std::find(named.begin(), named.end(), twin.quantity) != named.end())
            r.twins.push_back(twin);
    if (r.twins.empty()) throw Error("the scene has no twins that it could show");
    named.clear();
    for (const Twin& twin : r.twins) named.push_back(twin.quantity);
}

Pictures::Recorder Pictures::prepare(const Picture& picture, const World& start) const {
    Recorder r{.picture = picture};
    if (r.picture.title.empty()) r.picture.title = title_;
    if (picture.type == PictureType::trajectories) {
        r.bodies = shown_bodies(picture, start);
        if (const std::size_t all = moving_bodies(start).size(); picture.bodies.empty() && all > r.bodies.size())
            r.part = fmt::format("{} of {} bodies", r.bodies.size(), all);
        for (const BodyId id : r.bodies) {
            const Body body = start.body(id);
            r.tracks.push_back({.label = body.name, .radius = body.radius, .colour = body.colour});
        }
        r.around = surroundings_of(start, r.named());
    }
    if (picture.type == PictureType::twin) choose_twins(r);
    if (picture.type == PictureType::gas) r.meter.emplace(start);
    if (picture.type == PictureType::profile && !space_)
        throw Error("a profile is one of a room, and the scene has neither a rectangle nor a periodic box");
    if (picture.period) require_frames(*picture.period, plan_);
    for (const std::string& text : r.picture.quantities) {
        r.quantities.emplace_back(text, start, parameters_);
        r.series.push_back({.label = text});
    }
    auto& at = r.picture.at;
    if (at.empty())
        for (const double part : {0.0, 1.0, 2.0, 3.0}) at.push_back(part / 3 * plan_.duration);
    std::sort(at.begin(), at.end());
    // A run that was made shorter shows its end in their place.
    for (double& time : at) time = std::min(time, plan_.duration);
    at.erase(std::unique(at.begin(), at.end()), at.end());
    return r;
}

void Pictures::save(Saver& to) const {
    for (const Recorder& recorder : recorders_) collected(to, recorder);
}
void Pictures::restore(Loader& from) {
    for (Recorder& recorder : recorders_) collected(from, recorder);
}

void Pictures::require_same_until(const World& now, const Pictures& before, const Plan& plan_before) const {
    const auto shown = [&now](const Recorder& r, const Plan& plan) {
        std::vector<double> at = r.picture.at;
        std::erase_if(at, [&](double time) { return !has_come_to(time, now, plan); });
        return at;
    };
    for (std::size_t k = 0; k < recorders_.size(); ++k) {
        const Recorder& r = recorders_[k];
        const bool moments = r.picture.type == PictureType::snapshots || r.picture.type == PictureType::profile;
        if (moments && shown(r, plan_) != shown(before.recorders_[k], plan_before))
            throw Error(
                fmt::format("the picture '{}' has no 'at', and thirds of {} s are not those of {} s, of which some are "
                            "past at t = {:.6g} s: give it 'at' in the scene and run that anew",
                            r.file, plan_.duration, plan_before.duration, now.time()));
    }
}

void Pictures::observe(const World& world) {
    for (Recorder& recorder : recorders_) record(recorder, world);
}

void Pictures::record(Recorder& r, const World& world) const {
    if (r.picture.from && world.time() < *r.picture.from * (1 - 1e-12)) return;
    if (r.picture.until && world.time() > *r.picture.until * (1 + 1e-12)) return;
    if (r.picture.period && !is_at_period(*r.picture.period, world, plan_)) return;
    // The first frame at or after each time that was asked for.
    const auto catch_up = [&](auto& shown, const auto& now) {
        const auto& at = r.picture.at;
        while (shown.size() < at.size() && has_come_to(at[shown.size()], world, plan_)) shown.push_back(now());
    };
    if (r.picture.type == PictureType::snapshots) return catch_up(r.moments, [&] { return moment_of(world); });
    if (r.picture.type == PictureType::profile)
        return catch_up(r.profiles, [&] { return profile_of(world, *space_, slices_); });
    if (r.meter) return r.meter->observe(world, plan_.measure_from);
    r.time.push_back(world.time());
    if (r.picture.type == PictureType::trajectories) r.around.lines = lines_of(world, r.named());
    for (std::size_t k = 0; k < r.bodies.size(); ++k) {
        r.tracks[k].points.push_back(world.position(r.bodies[k]));
        r.tracks[k].shapes = shapes_of(world, r.bodies[k]);
    }
    for (std::size_t k = 0; k < r.quantities.size(); ++k) r.series[k].values.push_back(r.quantities[k](world));
    if (r.picture.type == PictureType::energy) r.energies.push_back(energy(world));
}

Figure Pictures::twin(const Recorder& r) const {
    Figure all;
    for (std::size_t k = 0; k < r.series.size(); ++k) {
        const Twin& twin = r.twins[k];
        const auto exact = closed_form(twin.formula, parameters_);
        std::vector<double> time, simulated, analytic;
        for (std::size_t i = 0; i < r.time.size(); ++i) {
            if (twin.until && r.time[i] > *twin.until * (1 + 1e-12)) break;
            time.push_back(r.time[i]);
            simulated.push_back(r.series[k].values[i]);
            analytic.push_back(exact(r.time[i]));
        }
        const std::string unit = twin.unit.empty() ? unit_of(twin.quantity) : twin.unit;
        Figure one = comparison_figure(time, simulated, analytic, with_unit(unquoted(twin.quantity), unit));
        one.panels.back().y_label = with_unit("error", unit);
        if (k > 0)
            for (Curve& curve : one.panels.front().curves) curve.label.clear();  // one legend is enough
        // Two side by side, where all of them below one another would be no page; an odd one has none beside it.
        all.columns = r.series.size() > 2 ? 2 : 1;
        all.shared_x = true;
        const auto beside = all.panels.end() - static_cast<std::ptrdiff_t>(k % all.columns);
        all.panels.insert(beside, std::move(one.panels.front()));
        if (k + 1 == r.series.size() && k % all.columns == 0 && all.columns > 1) all.panels.push_back({.empty = true});
        all.panels.push_back(std::move(one.panels.back()));
    }
    return all;
}

Figure Pictures::time(const Recorder& r) const {
    const std::string unit = axis_unit(r.picture);
    std::vector<Series> series = r.series;
    for (Series& one : series) {
        // Quantities of different kinds say their units themselves.
        one.label = with_unit(unquoted(one.label), unit.empty() ? unit_of(one.label) : "");
        const double from = r.picture.change && !one.values.empty() ? one.values.front() : 0;
        for (double& value : one.values) value -= from;
    }
    std::string what = series.size() == 1 ? unquoted(r.series[0].label) : kind_of(r.picture.quantities, unit);
    if (r.picture.change) what = what.empty() ? "change" : "change of " + what;
    return time_figure(r.time, series, with_unit(what, unit));
}

Figure Pictures::trajectories(const Recorder& r) const {
    Figure paths = trajectory_figure(r.tracks, room_, walls_, r.around);
    paths.panels[0].title = r.part;
    return paths;
}

Figure Pictures::phase(const Recorder& r, const std::string& x_label, const std::string& y_label) {
    Figure all = phase_figure({&r.series[0], 1}, {&r.series[1], 1}, x_label, y_label);
    if (!r.picture.period) return all;
    Curve& points = all.panels[0].curves[0];
    points.stroke = Stroke::points;
    constexpr double few = 100;  // more of them are to be told from one another, too
    points.width = std::clamp(std::sqrt(few / static_cast<double>(points.x.size())), 0.3, 1.0);
    return all;
}

Figure Pictures::figure(const Recorder& r) const {
    // The scene's unit is that of what has none of its own.
    const auto label = [&](std::size_t k) {
        const std::string own = unit_of(r.series[k].label);
        return with_unit(unquoted(r.series[k].label), own.empty() ? r.picture.unit : own);
    };
    switch (r.picture.type) {
        case PictureType::trajectories:
            return trajectories(r);
        case PictureType::time:
            return time(r);
        case PictureType::phase:
            return phase(r, label(0), label(1));
        case PictureType::energy:
            return energy_figure(r.time, r.energies, r.picture.change);
        case PictureType::snapshots:
            return snapshot_figure(r.moments, room_, walls_);
        case PictureType::profile:
            return profile_figure(r.profiles, *space_);
        case PictureType::twin:
            return twin(r);
        case PictureType::gas:
            return gas_figure(*r.meter);
    }
    return {};
}

std::vector<std::filesystem::path> Pictures::draw(const std::filesystem::path& folder,
                                                  const std::string& format) const {
    std::vector<std::filesystem::path> files;
    std::optional<Error> failed;                  // the first: the others are drawn all the same
    const bool is_cut_short = was_interrupted();  // of a run that was, there is what there is
    for (const Recorder& r : recorders_) {
        if (failed && was_interrupted() && !is_cut_short) break;
        const bool is_late =
            r.picture.type == PictureType::snapshots ? r.moments.empty() : r.picture.from && r.time.empty();
        if (is_late) continue;  // the run ended before the first
        if (r.meter && r.meter->curves().empty()) continue;
        files.push_back(folder / (r.file + "." + format));
        try {
            Figure picture = figure(r);
            picture.title = r.picture.title;
            carom::save(picture, files.back());
        } catch (const Error& e) {
            const std::string why = e.what(), file = files.back().string();
            const bool names_it = why.find(file) != why.npos;  // as what the disk refuses does
            if (!failed) failed = Error(names_it ? why : fmt::format("{} ({})", why, file), e.cause());
        }
    }
    if (failed) throw *failed;
    return files;
}

}  // namespace carom::app
