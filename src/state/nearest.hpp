#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom {

/// Number of letters to change, insert or drop to get from one word to the other (Levenshtein 1966).
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t change = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({change, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

/// Whether a word is the first letters of another: an abbreviation, which is nearer to it than a slip.
inline bool abbreviates(std::string_view word, std::string_view name) {
    return word.size() >= 3 && name.size() > word.size() && name.substr(0, word.size()) == word;
}

/// What counts as one wrong letter: an abbreviation, and letters that changed places.
inline bool is_slip(std::string_view word, std::string_view name) {
    return abbreviates(word, name) || std::is_permutation(word.begin(), word.end(), name.begin(), name.end());
}

/// With small letters for capital ones.
inline std::string in_small_letters(std::string_view word) {
    std::string out(word);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

/// What others call a thing, and what it is called here.
constexpr std::pair<std::string_view, std::string_view> words_from_elsewhere[] = {{"body", "bodies"},
                                                                                  {"objects", "bodies"},
                                                                                  {"constraints", "joints"},
                                                                                  {"simulation", "run"},
                                                                                  {"dt", "step"},
                                                                                  {"timestep", "step"},
                                                                                  {"time_step", "step"},
                                                                                  {"time", "duration"},
                                                                                  {"t_end", "duration"},
                                                                                  {"tmax", "duration"},
                                                                                  {"static", "fixed"},
                                                                                  {"kinematic", "driven"},
                                                                                  {"type", "kind"},
                                                                                  {"omega", "angular_velocity"},
                                                                                  {"theta", "angle"},
                                                                                  {"inertia", "moment_of_inertia"},
                                                                                  {"bounciness", "restitution"},
                                                                                  {"elasticity", "restitution"},
                                                                                  {"circle", "disc"},
                                                                                  {"rectangle", "box"},
                                                                                  {"edge", "segment"},
                                                                                  {"hinge", "revolute"},
                                                                                  {"pin", "revolute"},
                                                                                  {"pivot", "revolute"},
                                                                                  {"slider", "prismatic"},
                                                                                  {"rod", "distance"},
                                                                                  {"rope", "distance"},
                                                                                  {"cable", "distance"},
                                                                                  {"strut", "distance"},
                                                                                  {"fixed", "weld"},
                                                                                  {"rack", "gear"},
                                                                                  {"mouse", "handle"},
                                                                                  {"force", "constant"},
                                                                                  {"torque", "constant"},
                                                                                  {"friction", "drag"},
                                                                                  {"damping", "drag"},
                                                                                  {"wind", "drag"},
                                                                                  {"gravitation", "attraction"},
                                                                                  {"coulomb", "attraction"},
                                                                                  {"charge", "attraction"},
                                                                                  {"leapfrog", "verlet"},
                                                                                  {"velocity-verlet", "verlet"},
                                                                                  {"yoshida", "pefrl"},
                                                                                  {"dopri5", "runge-kutta"}};

/// The known name of a thing that others call so; empty if there is none.
template <class Names>
std::string here_called(std::string_view word, const Names& known) {
    for (const auto& [there, here] : words_from_elsewhere)
        for (const auto& name : known)
            if (there == word && here == name) return std::string(here);
    return "";
}

/// "; did you mean 'gravity'?" when one of the known names is near, else "".
template <class Names>
std::string did_you_mean(std::string_view name, const Names& known) {
    std::string best;
    const std::string word = in_small_letters(name);
    if (const std::string here = here_called(word, known); !here.empty()) return "; did you mean '" + here + "'?";
    // Of a short word most letters must be right: one letter is as near to any other.
    std::size_t least = (name.size() < 2 ? 0 : name.size() < 5 ? 1 : std::max<std::size_t>(2, name.size() / 3)) + 1;
    for (const auto& candidate : known) {
        const std::string other = in_small_letters(candidate);
        const std::size_t distance = word == other ? 0 : is_slip(word, other) ? 1 : edit_distance(word, other);
        if (distance < least) least = distance, best = candidate;
    }
    return best.empty() ? "" : "; did you mean '" + best + "'?";
}

}  // namespace carom
