// H5MD 1.1, https://www.nongnu.org/h5md/h5md.html: the frames of a run as HDF5.

#include <fmt/format.h>

#include <cmath>
#include <list>
#include <system_error>

#include "collision/periodic.hpp"
#include "output/frames.hpp"
#include "output/hdf5.hpp"
#include "output/hdf5_gas.hpp"
#include "output/provenance.hpp"
#include "output/signals.hpp"

namespace carom {

namespace {

using hdf5::checked;
using hdf5::Object;

/// What there is to be seen before the first number is written.
struct Preview {
    std::size_t slots = 1;  ///< places for bodies in a frame
    bool changes = false;   ///< bodies came, went or are others: each has the place of its index, or it is empty
    std::size_t longest_name = 0;
    Cast cast{};  ///< of the first frame
};

Preview preview_of(const std::filesystem::path& raw) {
    RawFrames frames(raw);
    Preview preview;
    RawFrame::Head head;
    Cast cast;
    std::size_t most = 0, last = 0;
    for (bool first = true; frames.skip(head, cast); first = false) {
        if (first) preview.cast = cast;
        if (head.cast_bytes > 0) preview.changes = preview.changes || cast != preview.cast;
        most = std::max<std::size_t>(most, head.bodies);
        if (head.cast_bytes > 0)
            for (const std::string& name : cast.name)
                preview.longest_name = std::max(preview.longest_name, name.size());
        for (const BodyId id : cast.id) last = std::max<std::size_t>(last, id.index + 1);
    }
    preview.changes = preview.changes || most == 0;
    preview.slots = std::max<std::size_t>(1, preview.changes ? last : most);
    return preview;
}

/// How many boxes away, as a whole number. An Error beyond those there are: long before, a place in a box has no
/// digits.
std::int64_t whole(double boxes) {
    constexpr double end = 9223372036854775808.0;  // 2⁶³
    if (!(std::abs(boxes) < end))
        throw Error(fmt::format("a body is {:.2g} boxes away, and 'image' counts up to {:.2g}", boxes, end));
    return static_cast<std::int64_t>(boxes);
}

Object species_type() {
    Object type{H5Tenum_create(H5T_NATIVE_INT8), H5Tclose};
    constexpr Kind* none = nullptr;
    for (const auto& choice : choices(none)) {
        const auto value = static_cast<std::int8_t>(choice.value);
        checked(H5Tenum_insert(type, choice.name, &value));
    }
    const std::int8_t nobody = -1;
    checked(H5Tenum_insert(type, "none", &nobody));
    return type;
}

/// The file, and how frames are put into it.
class Document {
  public:
    /// `error` as in create_file().
    Document(const std::filesystem::path& path, int& error, Preview preview, const std::optional<Room>& room,
             const Provenance& provenance);
    void add(const RawFrame& frame, const Cast& cast);
    void add(const GasMeter& measures) { hdf5::write_gas(hdf5::group(observables_, "gas"), measures); }
    void close();

  private:
    /// A group with step, time and value: H5MD's element that depends on time.
    void element(hid_t parent, const char* name, hid_t type, std::vector<hsize_t> row, const char* unit,
                 std::function<const void*()> data);
    /// The same of a number of every body that changes only with the bodies.
    template <class T>
    void property(const char* name, hid_t type, const char* unit, T none,
                  std::function<T(const Cast&, std::size_t)> of);
    template <class T>
    void per_body(const char* name, hid_t type, std::vector<hsize_t> row, const char* unit, T none,
                  std::function<T(std::size_t)> of);
    void describe(const Provenance& provenance);
    void describe_bodies();
    void describe_names();
    void describe_box(const std::optional<Room>& room);
    Vec2 wrapped(std::size_t i, Vec2& image) const;
    std::size_t slot(std::size_t i) const { return preview_.changes ? cast_->id[i].index : i; }

    Preview preview_;
    std::optional<Room> room_;
    Object file_, bodies_, observables_, species_;
    std::optional<Object> clock_;      ///< the group whose step and time all others link to
    std::optional<Object> name_type_;  ///< of names over time
    struct Stream {
        hdf5::Column column;
        std::function<const void*()> data;
    };
    std::list<Stream> streams_;
    const RawFrame* frame_ = nullptr;  ///< the one that is being added
    const Cast* cast_ = nullptr;
};

Document::Document(const std::filesystem::path& path, int& error, Preview preview, const std::optional<Room>& room,
                   const Provenance& provenance)
    : preview_(std::move(preview)),
      room_(room && room->periodic ? room : std::nullopt),
      file_(hdf5::create_file(path.string(), error)),
      bodies_(hdf5::group(hdf5::group(file_, "particles"), "bodies")),
      observables_(hdf5::group(file_, "observables")),
      species_(species_type()) {
    describe(provenance);
    describe_box(room);
    describe_bodies();
    for (std::size_t k = 0; k < observables.size(); ++k)
        element(observables_, observables[k].name, H5T_NATIVE_DOUBLE, {}, observables[k].unit,
                [this, k] { return &frame_->head.observed[k]; });
}

void Document::describe(const Provenance& provenance) {
    const int version[] = {1, 1}, units[] = {1, 0};
    const Object root = hdf5::group(file_, "h5md"), creator = hdf5::group(root, "creator"),
                 author = hdf5::group(root, "author"), modules = hdf5::group(root, "modules"),
                 system = hdf5::group(modules, "units");
    hdf5::attribute(root, "version", version);
    hdf5::attribute(creator, "name", "Carom");
    hdf5::attribute(creator, "version", provenance.version);
    hdf5::attribute(author, "name", "unknown");  // a machine's user name is nobody's business
    hdf5::attribute(system, "version", units);
    hdf5::attribute(system, "system", "SI");
    const Object parameters = hdf5::group(file_, "parameters");
    for (const auto& [name, value] : provenance.parameters)
        hdf5::dataset(parameters, name.c_str(), H5T_NATIVE_DOUBLE, {}, &value);
    const Object ours = hdf5::group(file_, "carom");
    for (const auto& [name, words] : provenance_texts)
        if (!(provenance.*words).empty()) hdf5::text(ours, name, provenance.*words);
}

void Document::describe_box(const std::optional<Room>& room) {
    const Object box = hdf5::group(bodies_, "box");
    const int dimension[] = {2};
    const std::string boundary = room_ ? "periodic" : "none";
    hdf5::attribute(box, "dimension", dimension);
    hdf5::attribute(box, "boundary", std::vector{boundary, boundary});
    if (!room) return;
    const Vec2 size = room->high - room->low;
    hdf5::attribute(hdf5::dataset(box, "edges", H5T_NATIVE_DOUBLE, {2}, &size), "unit", "m");
    hdf5::attribute(hdf5::dataset(box, "offset", H5T_NATIVE_DOUBLE, {2}, &room->low), "unit", "m");
}

void Document::describe_bodies() {
    const double none = std::nan("");
    const Vec2 nowhere{none, none};
    per_body<Vec2>("position", H5T_NATIVE_DOUBLE, {2}, "m", nowhere, [this](std::size_t i) {
        Vec2 image;
        return wrapped(i, image);
    });
    if (room_)
        per_body<std::array<std::int64_t, 2>>("image", H5T_NATIVE_INT64, {2}, "", {}, [this](std::size_t i) {
            Vec2 image;
            wrapped(i, image);
            return std::array{whole(image.x), whole(image.y)};
        });
    per_body<Vec2>("velocity", H5T_NATIVE_DOUBLE, {2}, "m s-1", nowhere,
                   [this](std::size_t i) { return frame_->velocity[i]; });
    per_body<double>("angle", H5T_NATIVE_DOUBLE, {}, "rad", none, [this](std::size_t i) { return frame_->angle[i]; });
    per_body<double>("angular_velocity", H5T_NATIVE_DOUBLE, {}, "rad s-1", none,
                     [this](std::size_t i) { return frame_->angular_velocity[i]; });
    property<std::int64_t>("id", H5T_NATIVE_INT64, "", -1,
                           [](const Cast& c, std::size_t i) { return number_of(c.id[i]); });
    property<std::int8_t>("species", species_, "", -1,
                          [](const Cast& c, std::size_t i) { return static_cast<std::int8_t>(c.kind[i]); });
    property<double>("mass", H5T_NATIVE_DOUBLE, "kg", none, [](const Cast& c, std::size_t i) { return c.mass[i]; });
    property<double>("radius", H5T_NATIVE_DOUBLE, "m", none, [](const Cast& c, std::size_t i) { return c.radius[i]; });
    property<double>("charge", H5T_NATIVE_DOUBLE, "C", none, [](const Cast& c, std::size_t i) { return c.charge[i]; });
    describe_names();
}

void Document::describe_names() {
    const std::size_t longest = preview_.longest_name;
    if (longest == 0) return;
    if (!preview_.changes) return hdf5::texts(bodies_, "name", preview_.cast.name);
    name_type_.emplace(hdf5::string_type(longest));
    element(bodies_, "name", *name_type_, {preview_.slots}, "", [this, longest, all = std::string()]() mutable {
        all.assign(preview_.slots * longest, '\0');
        for (std::size_t i = 0; i < frame_->head.bodies; ++i)
            cast_->name[i].copy(all.data() + slot(i) * longest, longest);
        return static_cast<const void*>(all.data());
    });
}

void Document::element(hid_t parent, const char* name, hid_t type, std::vector<hsize_t> row, const char* unit,
                       std::function<const void*()> data) {
    Object group = hdf5::group(parent, name);
    streams_.push_back({hdf5::Column(group, "value", type, std::move(row), unit), std::move(data)});
    if (clock_) {
        checked(H5Lcreate_hard(*clock_, "step", group, "step", H5P_DEFAULT, H5P_DEFAULT));
        checked(H5Lcreate_hard(*clock_, "time", group, "time", H5P_DEFAULT, H5P_DEFAULT));
        return;
    }
    streams_.push_back({hdf5::Column(group, "step", H5T_NATIVE_UINT64, {}), [this] { return &frame_->head.step; }});
    streams_.push_back(
        {hdf5::Column(group, "time", H5T_NATIVE_DOUBLE, {}, "s"), [this] { return &frame_->head.time; }});
    clock_.emplace(std::move(group));
}

template <class T>
void Document::per_body(const char* name, hid_t type, std::vector<hsize_t> row, const char* unit, T none,
                        std::function<T(std::size_t)> of) {
    row.insert(row.begin(), preview_.slots);
    element(bodies_, name, type, std::move(row), unit, [this, none, of, places = std::vector<T>()]() mutable {
        places.assign(preview_.slots, none);
        for (std::size_t i = 0; i < frame_->head.bodies; ++i) places[slot(i)] = of(i);
        return static_cast<const void*>(places.data());
    });
}

template <class T>
void Document::property(const char* name, hid_t type, const char* unit, T none,
                        std::function<T(const Cast&, std::size_t)> of) {
    if (preview_.changes)
        return per_body<T>(name, type, {}, unit, none, [this, of](std::size_t i) { return of(*cast_, i); });
    std::vector<T> values;
    for (std::size_t i = 0; i < preview_.slots; ++i) values.push_back(of(preview_.cast, i));
    const Object set = hdf5::dataset(bodies_, name, type, {values.size()}, values.data());
    if (*unit != '\0') hdf5::attribute(set, "unit", unit);
}

/// The place in the box, and how many boxes away the body is.
Vec2 Document::wrapped(std::size_t i, Vec2& image) const {
    const Vec2 x = frame_->position[i];
    if (!room_) return x;
    const PlaceInBox along_x = place_in_box(x.x, room_->low.x, room_->high.x),
                     along_y = place_in_box(x.y, room_->low.y, room_->high.y);
    image = {along_x.boxes, along_y.boxes};
    return {along_x.place, along_y.place};
}

void Document::add(const RawFrame& frame, const Cast& cast) {
    frame_ = &frame;
    cast_ = &cast;
    for (Stream& stream : streams_) stream.column.append(stream.data());
}

void Document::close() {
    for (Stream& stream : streams_) stream.column.close();
    checked(H5Fflush(file_, H5F_SCOPE_GLOBAL));
}

}  // namespace

void write_h5md(const File& target, const std::filesystem::path& raw, const std::optional<Room>& room,
                const Provenance& provenance, const GasMeter* measures) {
    const QuietWrites no_signals;
    const hdf5::Quiet quiet;
    int error = 0;
    try {
        Document document(target.temporary(), error, preview_of(raw), room, provenance);
        RawFrames frames(raw);
        RawFrame frame;
        Cast cast;
        while (error == 0 && frames.next(frame, cast)) document.add(frame, cast);
        if (measures != nullptr) document.add(*measures);
        document.close();
    } catch (const Error& e) {
        if (error == 0)
            throw Error(fmt::format("cannot write {}: {}", target.target().string(), e.what()), Error::Cause::run);
    }
    if (error != 0)
        throw Error(
            fmt::format("cannot write {}: {}", target.target().string(), std::generic_category().message(error)),
            Error::Cause::run);
}

std::optional<Provenance> provenance_in_hdf5(const std::filesystem::path& path) {
    const hdf5::Quiet quiet;
    Provenance out;
    try {
        const Object file{H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
        if (H5Lexists(file, "carom", H5P_DEFAULT) > 0) {
            const Object ours{H5Gopen2(file, "carom", H5P_DEFAULT), H5Gclose};
            for (const auto& [name, words] : provenance_texts) out.*words = hdf5::read_text(ours, name);
        }
    } catch (const Error& e) {
        throw Error(fmt::format("{}: cannot be read: {}", path.string(), e.what()));
    }
    if (out.scene.empty()) throw Error(fmt::format("{}: is HDF5, and has no scene of Carom's in it", path.string()));
    return out;
}

}  // namespace carom
