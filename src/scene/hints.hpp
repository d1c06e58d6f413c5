#pragma once
// What helps whoever wrote what cannot be read.

#include <string>
#include <string_view>

namespace carom {

/// A character that text processors and PDFs put where a keyboard has another one, and that looks the same.
struct LookAlike {
    std::string_view seen, name, meant;
};
/// The first of them in a text, and where; null if there is none.
const LookAlike* look_alike_in(std::string_view text, std::size_t& at);
/// What it is, and what is meant.
std::string in_words(const LookAlike& one);

/// Of "2 kg", where a number is meant; empty of all else.
std::string about_units(const std::string& text);

}  // namespace carom
