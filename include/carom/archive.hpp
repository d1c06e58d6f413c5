#pragma once
// Values as bytes and back, bit by bit: what checkpoints are made of. The bytes are for the same version of Carom on
// the same kind of machine; data files are for everybody else.
//
// A struct that is more than plain bytes says what it consists of by `members(s)`, a tuple of references made by a
// structured binding over all of it, so that a member nobody thought of does not compile.

#include <carom/error.hpp>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace carom {

/// S or const S, so that one `members` serves for writing and for reading.
template <class T, class S>
concept Maybe_const = std::same_as<std::remove_const_t<T>, S>;

template <class A, class B>
auto members(std::pair<A, B>& pair) {
    return std::tie(pair.first, pair.second);
}
template <class A, class B>
auto members(const std::pair<A, B>& pair) {
    return std::tie(pair.first, pair.second);
}

/// Whether it is written byte by byte: what says what it consists of may have gaps in between.
template <class T>
inline constexpr bool is_saved_as_bytes = std::is_trivially_copyable_v<T> && !requires(T & value) {
    members(value);
};

class Saver {
  public:
    explicit Saver(std::function<void(std::string_view)> sink) : sink_(std::move(sink)) {}

    template <class... T>
    void operator()(const T&... values) {
        (put(values), ...);
    }

  private:
    template <class T>
    void put(const T& value) {
        if constexpr (is_saved_as_bytes<T>)
            bytes(&value, sizeof value);
        else
            std::apply(*this, members(value));
    }
    template <class T>
    void put(const std::vector<T>& values) {
        put(std::uint64_t{values.size()});
        if constexpr (is_saved_as_bytes<T>)
            bytes(values.data(), values.size() * sizeof(T));
        else
            for (const T& value : values) put(value);
    }
    template <class K, class V>
    void put(const std::map<K, V>& values) {
        put(std::uint64_t{values.size()});
        for (const auto& [key, value] : values) put(key), put(value);
    }
    template <class T>
    void put(const std::optional<T>& value) {
        put(value.has_value());
        if (value) put(*value);
    }
    template <class... T>
    void put(const std::variant<T...>& value) {
        put(static_cast<std::uint8_t>(value.index()));
        std::visit([this](const auto& chosen) { this->put(chosen); }, value);
    }
    void put(const std::string& text) {
        put(std::uint64_t{text.size()});
        bytes(text.data(), text.size());
    }
    void bytes(const void* data, std::size_t size) { sink_({static_cast<const char*>(data), size}); }

    std::function<void(std::string_view)> sink_;
};

/// Reads what a Saver wrote, in the same order; an Error where it ends too early.
class Loader {
  public:
    explicit Loader(std::string_view bytes) : left_(bytes) {}

    template <class... T>
    void operator()(T&... values) {
        (get(values), ...);
    }
    bool at_end() const { return left_.empty(); }
    std::string_view rest() const { return left_; }
    [[noreturn]] static void fail() { throw Error("the bytes end too early, or are not what was saved"); }

  private:
    template <class T>
    void get(T& value) {
        static_assert(!std::is_pointer_v<T>);
        if constexpr (std::is_same_v<T, bool>) {
            std::uint8_t byte;
            get(byte);
            if (byte > 1) fail();
            value = byte == 1;
        } else if constexpr (is_saved_as_bytes<T>) {
            bytes(&value, sizeof value);
        } else {
            const auto all = members(value);
            std::apply([this](auto&... each) { (this->get(each), ...); }, all);
        }
    }
    template <class T>
    void get(std::vector<T>& values) {
        values.clear();
        if constexpr (is_saved_as_bytes<T>) {
            values.resize(count(sizeof(T)));
            bytes(values.data(), values.size() * sizeof(T));
        } else {
            // One by one: a wrong count fails before it takes memory.
            for (std::size_t n = count(1); n > 0; --n) get(values.emplace_back());
        }
    }
    template <class K, class V>
    void get(std::map<K, V>& values) {
        values.clear();
        for (std::size_t n = count(1); n > 0; --n) {
            K key{};
            get(key);
            get(values[key]);
        }
    }
    template <class T>
    void get(std::optional<T>& value) {
        bool given = false;
        get(given);
        value.reset();
        if (given) get(value.emplace());
    }
    template <class... T>
    void get(std::variant<T...>& value) {
        std::uint8_t index = 0;
        get(index);
        if (index >= sizeof...(T)) fail();
        [&]<std::size_t... k>(std::index_sequence<k...>) {
            ((k == index ? get(value.template emplace<k>()) : void()), ...);
        }
        (std::index_sequence_for<T...>{});
    }
    void get(std::string& text) {
        text.resize(count(1));
        bytes(text.data(), text.size());
    }
    /// How many items of at least so many bytes come next.
    std::size_t count(std::size_t size) {
        std::uint64_t n = 0;
        get(n);
        if (n > left_.size() / size) fail();
        return static_cast<std::size_t>(n);
    }
    void bytes(void* to, std::size_t size) {
        if (size > left_.size()) fail();
        if (size > 0) std::memcpy(to, left_.data(), size);
        left_.remove_prefix(size);
    }

    std::string_view left_;
};

}  // namespace carom
