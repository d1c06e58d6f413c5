// A checkpoint is: a line that says so, version of the format, provenance, what was saved, and a hash of all that.

#include <fmt/format.h>

#include <carom/version.hpp>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "output/fnv.hpp"
#include "output/provenance.hpp"

namespace carom {

namespace {

constexpr std::uint32_t format_version = 7;

Error wrong(const std::filesystem::path& file, const std::string& why) {
    return Error(fmt::format("{}: {}", file.string(), why));
}

std::string content_of(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) throw wrong(file, "is a folder, and must be a checkpoint");
    std::ifstream in(file, std::ios::binary);
    std::string bytes(checkpoint_magic.size(), '\0');
    if (!in) throw wrong(file, fmt::format("cannot be read: {}", std::strerror(errno)));
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!in || bytes != checkpoint_magic) throw wrong(file, "is no checkpoint of Carom's");
    bytes.append(std::istreambuf_iterator<char>(in), {});
    return bytes;
}

/// What is behind the provenance.
std::string_view opened(const std::filesystem::path& file, std::string_view bytes, Provenance& provenance) {
    std::uint64_t hash = 0;
    std::string_view body = bytes.substr(0, bytes.size() - std::min(bytes.size(), sizeof hash));
    std::memcpy(&hash, bytes.data() + body.size(), bytes.size() - body.size());
    if (body.size() < checkpoint_magic.size() || fnv(body) != hash)
        throw wrong(file, "the checkpoint is damaged or not whole");
    body.remove_prefix(checkpoint_magic.size());
    Loader loader(body);
    std::uint32_t version = 0;
    std::string carom;
    loader(version, carom);
    if (version != format_version || carom != CAROM_VERSION)
        throw OtherVersion(fmt::format("{}: is a checkpoint of Carom {} (format {}), and this is {} (format {})",
                                       file.string(), carom, version, CAROM_VERSION, format_version));
    loader(provenance);
    return loader.rest();
}

}  // namespace

std::filesystem::path unfinished_checkpoint(const std::filesystem::path& file) { return file.string() + ".tmp"; }

bool may_become_checkpoint(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string start(checkpoint_magic.size(), '\0');
    in.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(in.gcount()));
    return in.is_open() && checkpoint_magic.starts_with(start);
}

void save_checkpoint(const std::filesystem::path& path, const Provenance& provenance,
                     const std::function<void(Saver&)>& save) {
    File file(path, unfinished_checkpoint(path));
    std::uint64_t hash = fnv({});
    const auto write = [&](std::string_view bytes) {
        hash = fnv(bytes, hash);
        file.write(bytes);
    };
    write(checkpoint_magic);
    Saver saver(write);
    saver(format_version, std::string(CAROM_VERSION), provenance);
    save(saver);
    file.write({reinterpret_cast<const char*>(&hash), sizeof hash});
    file.sync();
    file.commit();
}

std::string load_checkpoint(const std::filesystem::path& file) {
    const std::string bytes = content_of(file);
    Provenance provenance;
    return std::string(opened(file, bytes, provenance));
}

Provenance provenance_in_checkpoint(const std::filesystem::path& file) {
    const std::string bytes = content_of(file);
    Provenance provenance;
    opened(file, bytes, provenance);
    return provenance;
}

}  // namespace carom
