#include "output/hdf5.hpp"

#include <algorithm>
#include <carom/error.hpp>
#include <limits>

namespace carom::hdf5 {

namespace {

/// The system's reason, if the list of errors has one; else what HDF5 could not do.
herr_t find_reason(unsigned n, const H5E_error2_t* error, void* found) {
    std::string& reason = *static_cast<std::string*>(found);
    const std::string words = error->desc ? error->desc : "";
    constexpr std::string_view before = "error message = '";
    if (const auto at = words.find(before); at != words.npos) {
        const auto start = at + before.size();
        reason = words.substr(start, words.find('\'', start) - start);
        return 1;
    }
    if (n == 0) reason = words;
    return 0;
}

Object space_of(const std::vector<hsize_t>& shape) {
    if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
    return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
}

/// Without the time of day, so that equal contents are equal files.
Object properties() {
    Object list{H5Pcreate(H5P_DATASET_CREATE), H5Pclose};
    checked(H5Pset_obj_track_times(list, false));
    return list;
}
void compress(hid_t list, const std::vector<hsize_t>& chunk) {
    checked(H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data()));
    checked(H5Pset_shuffle(list));
    checked(H5Pset_deflate(list, 1));  // more costs time and gains little: these are measured bits, not words
}

constexpr hsize_t most_in_chunk = 1 << 14;

/// All texts in fields of one length.
std::string joined(std::span<const std::string> texts, std::size_t size) {
    std::string all;
    for (const std::string& one : texts) (all += one).append(size - one.size(), '\0');
    return all;
}
std::size_t longest(std::span<const std::string> texts) {
    std::size_t most = 1;
    for (const std::string& one : texts) most = std::max(most, one.size());
    return most;
}

void write_attribute(hid_t object, const char* name, hid_t type, const std::vector<hsize_t>& shape, const void* data) {
    const Object space = space_of(shape);
    const Object attribute{H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
    checked(H5Awrite(attribute, type, data));
}

}  // namespace

void fail() {
    std::string reason = "HDF5 failed";
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_reason, &reason);
    throw Error(reason, Error::Cause::run);
}

template <class T>
T checked(T result) {
    if (result < 0) fail();
    return result;
}
template herr_t checked(herr_t);
template hid_t checked(hid_t);

Object string_type(std::size_t size) {
    Object type{H5Tcopy(H5T_C_S1), H5Tclose};
    checked(H5Tset_size(type, std::max<std::size_t>(size, 1)));
    checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
    checked(H5Tset_cset(type, H5T_CSET_UTF8));
    return type;
}

Object group(hid_t parent, const std::string& name) {
    return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose};
}

void attribute(hid_t object, const char* name, const std::string& text) {
    write_attribute(object, name, string_type(text.size()), {}, text.c_str());
}
void attribute(hid_t object, const char* name, std::span<const std::string> texts) {
    const std::size_t size = longest(texts);
    write_attribute(object, name, string_type(size), {texts.size()}, joined(texts, size).data());
}
void attribute(hid_t object, const char* name, std::span<const int> numbers) {
    write_attribute(object, name, H5T_NATIVE_INT,
                    numbers.size() == 1 ? std::vector<hsize_t>{} : std::vector<hsize_t>{numbers.size()},
                    numbers.data());
}

void attribute(hid_t object, const char* name, double number) {
    write_attribute(object, name, H5T_NATIVE_DOUBLE, {}, &number);
}

Object dataset(hid_t parent, const char* name, hid_t type, std::vector<hsize_t> shape, const void* data) {
    const Object list = properties();
    if (!shape.empty() && shape[0] > 256) {
        std::vector<hsize_t> chunk = shape;
        chunk[0] = std::min(shape[0], most_in_chunk);
        compress(list, chunk);
    }
    const Object space = space_of(shape);
    Object set{H5Dcreate2(parent, name, type, space, H5P_DEFAULT, list, H5P_DEFAULT), H5Dclose};
    if (data != nullptr) checked(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
    return set;
}

void text(hid_t parent, const char* name, const std::string& text) {
    dataset(parent, name, string_type(text.size()), {}, text.c_str());
}
void texts(hid_t parent, const char* name, const std::vector<std::string>& texts) {
    const std::size_t size = longest(texts);
    dataset(parent, name, string_type(size), {texts.size()}, joined(texts, size).data());
}

std::string read_text(hid_t parent, const char* name) {
    if (H5Lexists(parent, name, H5P_DEFAULT) <= 0) return {};
    const Object set{H5Dopen2(parent, name, H5P_DEFAULT), H5Dclose};
    const Object type{H5Dget_type(set), H5Tclose};
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) return {};
    const Object space{H5Dget_space(set), H5Sclose};
    if (H5Sget_simple_extent_npoints(space) != 1) return {};
    std::string text(H5Tget_size(type), '\0');
    checked(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()));
    return text.substr(0, text.find('\0'));
}

namespace {

std::size_t numbers_in(const std::vector<hsize_t>& row) {
    std::size_t product = 1;
    for (const hsize_t side : row) product *= side;
    return product;
}

/// A quarter of a megabyte of numbers in a chunk: many small rows, or a part of a large one.
hsize_t rows_in_chunk(const std::vector<hsize_t>& row) {
    return row.empty() ? 1024 : std::max<hsize_t>(1, most_in_chunk / std::max<hsize_t>(row[0], 1));
}

}  // namespace

Column::Column(hid_t parent, const char* name, hid_t type, std::vector<hsize_t> row, const std::string& unit)
    : type_(type),
      row_(std::move(row)),
      row_bytes_(numbers_in(row_) * H5Tget_size(type)),
      rows_in_chunk_(rows_in_chunk(row_)),
      dataset_(create(parent, name, type, row_, rows_in_chunk_)),
      buffer_(rows_in_chunk_ * row_bytes_) {
    if (!unit.empty()) attribute(dataset_, "unit", unit);
}

Object Column::create(hid_t parent, const char* name, hid_t type, const std::vector<hsize_t>& row, hsize_t rows) {
    std::vector<hsize_t> size{0}, most{H5S_UNLIMITED}, chunk{rows};
    for (const hsize_t side : row) {
        size.push_back(side), most.push_back(side);
        chunk.push_back(std::max<hsize_t>(1, std::min(side, most_in_chunk)));
    }
    const Object list = properties();
    compress(list, chunk);
    if (H5Tget_class(type) == H5T_FLOAT) {
        const double none = std::numeric_limits<double>::quiet_NaN();
        checked(H5Pset_fill_value(list, H5T_NATIVE_DOUBLE, &none));
    }
    const Object space{H5Screate_simple(static_cast<int>(size.size()), size.data(), most.data()), H5Sclose};
    return {H5Dcreate2(parent, name, type, space, H5P_DEFAULT, list, H5P_DEFAULT), H5Dclose};
}

void Column::append(const void* row) {
    std::copy_n(static_cast<const char*>(row), row_bytes_, buffer_.data() + waiting_ * row_bytes_);
    if (++waiting_ == rows_in_chunk_) flush();
}

void Column::flush() {
    if (waiting_ == 0 || row_bytes_ == 0) return;
    std::vector<hsize_t> start{written_}, count{waiting_}, size{written_ + waiting_};
    for (const hsize_t side : row_) start.push_back(0), count.push_back(side), size.push_back(side);
    checked(H5Dset_extent(dataset_, size.data()));
    const Object file{H5Dget_space(dataset_), H5Sclose};
    checked(H5Sselect_hyperslab(file, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
    const Object memory{H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose};
    checked(H5Dwrite(dataset_, type_, memory, file, H5P_DEFAULT, buffer_.data()));
    written_ += std::exchange(waiting_, 0);
}

void Column::close() {
    flush();
    dataset_.close();
}

}  // namespace carom::hdf5
