// How HDF5 reaches the disk when it writes: see create_file().

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "output/hdf5.hpp"
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace carom::hdf5 {

namespace {

/// HDF5's file with our part behind it.
struct Disk {
    H5FD_t base{};
    int descriptor = -1;
    int* error = nullptr;
    haddr_t addresses = 0;  ///< end of what HDF5 has given out
    haddr_t end = 0;        ///< of what it believes to be written

    void remember() {
        if (*error == 0) *error = errno;
    }
};
Disk& disk(H5FD_t* file) { return *reinterpret_cast<Disk*>(file); }
const Disk& disk(const H5FD_t* file) { return *reinterpret_cast<const Disk*>(file); }

H5FD_t* open(const char* name, unsigned, hid_t list, haddr_t) {
    auto* opened = new Disk{};
    opened->error = *static_cast<int* const*>(H5Pget_driver_info(list));
    opened->descriptor = ::open(name, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (opened->descriptor < 0) opened->remember();
    return &opened->base;
}

herr_t close(H5FD_t* file) {
    if (disk(file).descriptor >= 0 && ::close(disk(file).descriptor) != 0) disk(file).remember();
    delete &disk(file);
    return 0;
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, const void* data) {
    Disk& to = disk(file);
    to.end = std::max<haddr_t>(to.end, address + size);
    const auto* bytes = static_cast<const char*>(data);
    while (size > 0 && *to.error == 0) {
        const auto count = ::pwrite(to.descriptor, bytes, size, static_cast<off_t>(address));
        if (count < 0 && errno != EINTR) to.remember();
        if (count > 0) bytes += count, address += static_cast<haddr_t>(count), size -= static_cast<size_t>(count);
    }
    return 0;
}

/// What was never written, or dropped, is zeros.
herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* data) {
    auto* bytes = static_cast<char*>(data);
    while (size > 0) {
        const auto count = ::pread(disk(file).descriptor, bytes, size, static_cast<off_t>(address));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) {
            std::fill_n(bytes, size, '\0');
            break;
        }
        bytes += count, address += static_cast<haddr_t>(count), size -= static_cast<size_t>(count);
    }
    return 0;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
    Disk& to = disk(file);
    if (*to.error == 0 && ::ftruncate(to.descriptor, static_cast<off_t>(to.addresses)) != 0) to.remember();
    to.end = to.addresses;
    return 0;
}

herr_t query(const H5FD_t*, unsigned long* features) {
    *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

hid_t driver() {
    static H5FD_class_t functions{};
#if H5_VERSION_GE(1, 13, 0)
    functions.version = H5FD_CLASS_VERSION;
    functions.value = static_cast<H5FD_class_value_t>(600);
#endif
    functions.name = "carom";
    functions.maxaddr = HADDR_MAX / 4;
    functions.fc_degree = H5F_CLOSE_WEAK;
    functions.fapl_size = sizeof(int*);
    functions.open = open;
    functions.close = close;
    functions.query = query;
    functions.get_eoa = [](const H5FD_t* file, H5FD_mem_t) { return disk(file).addresses; };
    functions.set_eoa = [](H5FD_t* file, H5FD_mem_t, haddr_t end) {
        disk(file).addresses = end;
        return herr_t{0};
    };
    functions.get_eof = [](const H5FD_t* file, H5FD_mem_t) { return disk(file).end; };
    functions.read = read;
    functions.write = write;
    functions.truncate = truncate;
    static constexpr H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(map), std::end(map), functions.fl_map);
    static const hid_t id = checked(H5FDregister(&functions));
    return id;
}

}  // namespace

Object create_file(const std::string& path, int& error) {
    const Object list{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
    int* const where = &error;
    checked(H5Pset_driver(list, driver(), &where));
    return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, list), H5Fclose};
}

}  // namespace carom::hdf5
