#pragma once
// The little of HDF5 that an H5MD file needs. Every failure is an Error.

#include <hdf5.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace carom::hdf5 {

/// What a call returned, unless it failed.
template <class T>
T checked(T result);
[[noreturn]] void fail();

/// HDF5 prints its errors by itself: not while this lives.
class Quiet {
  public:
    Quiet() {
        H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;

  private:
    H5E_auto2_t print_{};
    void* data_{};
};

/// Something open, closed at the end.
class Object {
  public:
    using Close = herr_t (*)(hid_t);
    Object(hid_t id, Close how) : id_(id), close_(how) {
        if (id < 0) fail();
    }
    Object(Object&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Object& operator=(Object&&) = delete;
    ~Object() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }
    /// Now, when a failure can still be told.
    void close() {
        if (close_(std::exchange(id_, -1)) < 0) fail();
    }

  private:
    hid_t id_;
    Close close_;
};

/// A new file. HDF5 does not survive a full disk: it crashes when it closes what it could not write. So what the disk
/// refuses is dropped without its knowledge, and `error` gets the reason (errno): to be looked at, at the latest when
/// all is closed.
Object create_file(const std::string& path, int& error);

/// Of texts in UTF-8 of so many bytes at most.
Object string_type(std::size_t size);
Object group(hid_t parent, const std::string& name);
void attribute(hid_t object, const char* name, const std::string& text);
void attribute(hid_t object, const char* name, std::span<const std::string> texts);
void attribute(hid_t object, const char* name, std::span<const int> numbers);
void attribute(hid_t object, const char* name, double number);
/// A dataset that is written at once, compressed if it is large.
Object dataset(hid_t parent, const char* name, hid_t type, std::vector<hsize_t> shape, const void* data);
void text(hid_t parent, const char* name, const std::string& text);
void texts(hid_t parent, const char* name, const std::vector<std::string>& texts);
/// The text of such a dataset or attribute; empty if there is none.
std::string read_text(hid_t parent, const char* name);

/// A dataset that grows by rows of one shape. It is written in whole chunks, each compressed by itself.
class Column {
  public:
    /// `type` is that of the numbers in memory; the file has the same, little-endian.
    Column(hid_t parent, const char* name, hid_t type, std::vector<hsize_t> row, const std::string& unit = "");
    void append(const void* row);
    /// Writes what is left.
    void close();
    hid_t id() const { return dataset_; }

  private:
    static Object create(hid_t parent, const char* name, hid_t type, const std::vector<hsize_t>& row, hsize_t rows);
    void flush();
    hid_t type_;
    std::vector<hsize_t> row_;
    std::size_t row_bytes_, rows_in_chunk_, waiting_ = 0;
    hsize_t written_ = 0;
    Object dataset_;
    std::vector<char> buffer_;
};

}  // namespace carom::hdf5
