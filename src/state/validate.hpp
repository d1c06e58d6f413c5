#pragma once
// The one check of every public struct against its description.

#include <fmt/format.h>

#include <algorithm>
#include <carom/error.hpp>
#include <carom/field.hpp>
#include <carom/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace carom {

inline Error out_of_range(const std::string& name, const std::string& value, const char* unit, const Range& range) {
    return Error(fmt::format("{} must be {}{}{}, got {}", name, range.words, *unit ? " in " : "", unit, value));
}

/// What an Error calls a value: by a name, or as a part of what has one. It is put together only when there is one.
struct ValueName {
    std::string_view name{};
    const ValueName* whole = nullptr;
    const char* field = "";              ///< of the whole, if any
    std::optional<std::size_t> place{};  ///< in the whole, a list

    ValueName(const char* its_name) : name(its_name) {}
    ValueName(const std::string& its_name) : name(its_name) {}
    ValueName(const ValueName& of, const char* its_field) : whole(&of), field(its_field) {}
    ValueName(const ValueName& of, std::size_t its_place) : whole(&of), place(its_place) {}
    std::string text() const {
        if (!whole) return std::string(name);
        if (place) return fmt::format("{}[{}]", whole->text(), *place);
        return *field ? fmt::format("{}.{}", whole->text(), field) : whole->text();
    }
};

template <class T>
concept Described = requires(const T* t) {
    fields(t);
};

template <class T>
concept Chosen = requires(const T* t) {
    choices(t);
};

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

template <class T>
void validate(const T& value, const ValueName& where);

template <class T>
void validate_field(const T& value, const ValueName& name, const char* unit, const Range& range) {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) {
        const double number = value;
        if (!range.contains(number)) throw out_of_range(name.text(), fmt::format("{}", number), unit, range);
    } else if constexpr (std::is_same_v<T, Vec2>) {
        if (!range.contains(value.x)) throw out_of_range(name.text() + ".x", fmt::format("{}", value.x), unit, range);
        if (!range.contains(value.y)) throw out_of_range(name.text() + ".y", fmt::format("{}", value.y), unit, range);
    } else if constexpr (Chosen<T>) {
        const auto all = choices(&value);
        if (std::none_of(all.begin(), all.end(), [&](const auto& one) { return one.value == value; }))
            throw Error(fmt::format("{} must be a choice that there is, got number {}", name.text(),
                                    static_cast<long long>(value)));
    } else if constexpr (requires {
                             *value;
                             value.has_value();
                         }) {
        if (value) validate_field(*value, name, unit, range);
    } else if constexpr (requires { std::visit([](auto&) {}, value); }) {
        std::visit([&](const auto& chosen) { validate(chosen, name); }, value);
    } else if constexpr (is_list<T>) {
        for (std::size_t i = 0; i < value.size(); ++i) validate_field(value[i], ValueName(name, i), unit, range);
    } else if constexpr (Described<T>) {
        validate(value, name);
    }
}

/// Throws an Error that names the first field outside its range.
template <class T>
void validate(const T& value, const ValueName& where) {
    if constexpr (Described<T>) {
        const auto check = [&]<class F>(const F& f) {
            validate_field(value.*f.member, ValueName(where, is_flat<F> ? "" : f.name), f.unit, f.range);
        };
        std::apply([&](const auto&... f) { (check(f), ...); }, fields(&value));
    }
}

}  // namespace carom
