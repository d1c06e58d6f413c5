#include <fmt/format.h>
#include <sys/stat.h>

#include "output/frames.hpp"

namespace carom {

namespace {

template <class T>
void write(File& file, std::span<const T> values) {
    file.write({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
}
template <class T>
void read(std::ifstream& in, std::vector<T>& values, std::size_t count) {
    values.resize(count);
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

}  // namespace

Cast cast_of(const World& world) {
    Cast cast;
    const auto copy = [](auto& to, auto from) { to.assign(from.begin(), from.end()); };
    copy(cast.id, world.ids());
    copy(cast.kind, world.kinds());
    copy(cast.mass, world.masses());
    copy(cast.radius, world.radii());
    for (const BodyId id : world.ids()) {
        const Body body = world.body(id);
        cast.charge.push_back(body.charge);
        cast.name.push_back(body.name);
    }
    return cast;
}

H5mdFrames::H5mdFrames(File file, bool, const World& world, const Provenance&)
    : file_(std::move(file)), room_(room_of(world)) {
    if (file_.is_direct())
        throw Error(fmt::format("cannot write {}: HDF5 needs an ordinary file", file_.target().string()),
                    Error::Cause::run);
}

void H5mdFrames::add(const World& world) {
    RawFrame::Head head{
        .step = world.steps(), .time = world.time(), .bodies = world.size(), .observed = observe(world)};
    std::string cast;
    // Whole, for the same body may have been given another mass or name.
    if (Cast now = cast_of(world); known_.id.empty() || now != known_) {
        Saver saver([&](std::string_view bytes) { cast += bytes; });
        saver(now);
        known_ = std::move(now);
    }
    head.cast_bytes = cast.size();
    write(file_, std::span<const RawFrame::Head>(&head, 1));
    file_.write(cast);
    write(file_, world.positions());
    write(file_, world.velocities());
    write(file_, world.angles());
    write(file_, world.angular_velocities());
}

void H5mdFrames::commit(const Provenance& provenance, const GasMeter* measures) {
    const File& raw = file_.flushed();
    File target(raw.target(), raw.temporary().string() + ".tmp");
    write_h5md(target, raw.temporary(), room_, provenance, measures);
    target.commit();
}

RawFrames::RawFrames(const std::filesystem::path& path) : in_(path, std::ios::binary) {}

bool RawFrames::begin(RawFrame::Head& head, Cast& cast) {
    if (in_.peek() == std::ifstream::traits_type::eof()) return false;
    in_.read(reinterpret_cast<char*>(&head), sizeof head);
    if (head.cast_bytes == 0) return true;
    std::string bytes(head.cast_bytes, '\0');
    in_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    Loader loader(bytes);
    loader(cast);
    return true;
}

bool RawFrames::next(RawFrame& frame, Cast& cast) {
    if (!begin(frame.head, cast)) return false;
    const std::size_t n = frame.head.bodies;
    read(in_, frame.position, n);
    read(in_, frame.velocity, n);
    read(in_, frame.angle, n);
    read(in_, frame.angular_velocity, n);
    if (!in_) throw Error("a frame could not be read back", Error::Cause::run);
    return true;
}

bool RawFrames::skip(RawFrame::Head& head, Cast& cast) {
    if (!begin(head, cast)) return false;
    in_.seekg(static_cast<std::streamoff>(head.bodies * (2 * sizeof(Vec2) + 2 * sizeof(double))), std::ios::cur);
    return true;
}

}  // namespace carom
