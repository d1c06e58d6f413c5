#pragma once
// One description of every public field: name, unit, range and meaning. The checks in World::add, the scene files and
// their JSON Schema, the command line and the reference pages all read it, so that none of them can disagree.
//
// A struct S is described by two functions beside it:
//     constexpr std::string_view describe(const S*);    what it is, in one line
//     template <std::same_as<S> T>
//     constexpr auto fields(const T*);                  a tuple of Field; a template, so that only those pay for it
//                                                       who read it, and not whoever includes the header
// and an enumeration E by
//     constexpr auto choices(const E*);                 an array of Choice<E>

#include <concepts>
#include <limits>
#include <string_view>
#include <tuple>

namespace carom {

/// The values a number may take. Infinity and NaN are never allowed.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false;  ///< low itself is not allowed
    const char* words = "a finite number";

    constexpr bool contains(double value) const {
        return value >= low && value <= high && (!low_open || value > low) && value - value == 0;
    }
};

inline constexpr Range any{};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), true, "a number > 0"};
inline constexpr Range non_negative{0, std::numeric_limits<double>::infinity(), false, "a number >= 0"};
inline constexpr Range fraction{0, 1, false, "a number from 0 to 1"};

template <class S, class T>
struct Field {
    const char* name;
    T S::*member;
    const char* unit;  ///< "" for a pure number
    Range range;
    const char* text;
    const char* needed = "";  ///< what errors say a scene lacks that leaves it out; "" if it may
};

template <class S, class T>
constexpr Field<S, T> field(const char* name, T S::*member, const char* unit, Range range, const char* text) {
    return {name, member, unit, range, text};
}
/// A field that is no number: a name, a choice, a switch, a body.
template <class S, class T>
constexpr Field<S, T> field(const char* name, T S::*member, const char* text) {
    return {name, member, "", any, text};
}

/// A field that a scene has to have; one that is a body always is.
template <class S, class T>
constexpr Field<S, T> needed(Field<S, T> described, const char* what) {
    described.needed = what;
    return described;
}

/// A variant whose chosen one's fields stand beside the struct's own, and whose name stands under this field's name:
/// {"type": "box", "width": 2, ...}. A struct has at most one.
template <class S, class T>
struct Flat : Field<S, T> {
    using Variant = T;
};

template <class S, class T>
constexpr Flat<S, T> flat(const char* name, T S::*member, const char* text) {
    return {{name, member, "", any, text}};
}
template <class F>
inline constexpr bool is_flat = false;
template <class S, class T>
inline constexpr bool is_flat<Flat<S, T>> = true;

template <class E>
struct Choice {
    const char* name;
    E value;
    const char* text;
};

}  // namespace carom
