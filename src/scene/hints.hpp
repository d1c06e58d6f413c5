#pragma once
// What helps whoever wrote what cannot be read.

#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// A character that text processors and PDFs put where a keyboard has another one, and that looks the same.
struct LookAlike {
    std::string_view seen, name, meant;
};
/// The first of them in a text, and where; null if there is none.
const LookAlike* look_alike_in(std::string_view text, std::size_t& at);
/// What it is, and what is meant.
std::string in_words(const LookAlike& one);

/// Of a name that nobody knows: "; that is written floor(x + 0.5)" of what other languages call round, or else the
/// nearest name.
std::string instead_of(std::string_view name, const std::vector<std::string>& known);
/// The same of operators of other languages, where a text goes on with one, as with % or `and`; else "".
std::string written_for(std::string_view rest);

/// Of "2 kg", where a number is meant; empty of all else.
std::string about_units(const std::string& text);

}  // namespace carom
