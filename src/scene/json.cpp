#include "scene/json.hpp"

#include <algorithm>
#include <array>

#include "scene/hints.hpp"

namespace carom {

namespace {

constexpr std::size_t line_width = 110;
// Far more than a scene needs: what is beyond is a mistake or an attack (keys are searched one by one).
constexpr std::size_t deepest = 64, most_keys = 1000;

/// One line of printable characters, not too long, for the terminal.
std::string in_one_line(std::string text, std::size_t most) {
    if (text.size() > most) {
        text.resize(most - 3);
        while (!text.empty() && (text.back() & 0xc0) == 0x80) text.pop_back();  // no half of a character in UTF-8
        if (!text.empty() && (text.back() & 0x80) != 0) text.pop_back();
        text += "...";
    }
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
    return text;
}

std::string line_and_column(std::string_view text, std::size_t byte) {
    std::size_t line = 1, column = 1;
    for (std::size_t i = 0; i + 1 < byte && i < text.size(); ++i) {
        ++column;
        if (text[i] == '\n') ++line, column = 1;
    }
    return fmt::format("{}:{}", line, column);
}

/// nlohmann's message without its own name, number and place, and without what it has read, which may be anything.
std::string plain(const nlohmann::json::exception& e, std::string_view text, std::size_t byte) {
    std::string what = e.what();
    if (const auto number = what.find("number overflow parsing "); number != std::string::npos)
        return "the number is too large: " + in_one_line(what.substr(number + 24), 60);
    if (const auto name = what.find("] "); name != std::string::npos) what.erase(0, name + 2);
    if (what.starts_with("parse error at"))
        if (const auto colon = what.find(": "); colon != std::string::npos) what.erase(0, colon + 2);
    if (const auto read = what.find("; last read: '"); read != std::string::npos) {
        std::string token = what.substr(read + 14);
        for (char& c : token)
            if ((c & 0x80) != 0) c = '?';
        what = what.substr(0, read + 14) + in_one_line(token, 40);
    }
    if (what.find("control character") != what.npos && byte > 0 && byte <= text.size()) {
        const char found = text[byte - 1];
        if (found == '\n' || found == '\r')
            return "a text ends on its line, with a \"; a line break within one is written \\n";
        if (found == '\t') return "a tab within a text is written \\t";
    }
    for (const std::string_view word : {"NaN", "nan", "Infinity", "inf", "-Infinity", "-inf"})
        // nlohmann counts the end of the text as a character, or two.
        for (std::size_t back = 1; back <= 2 && back <= byte; ++back)
            if (byte - back < text.size() && text.substr(byte - back).starts_with(word))
                return fmt::format("numbers are finite here, and {} is none", word);
    return in_one_line(what, 200);
}

/// The word, mark or text that reaches so far, and the two before it; empty where there is none.
std::array<std::string_view, 3> tokens_at(std::string_view text, std::size_t byte) {
    constexpr std::string_view blanks = " \t\r\n", marks = "{}[],:", ends = " \t\r\n{}[],:\"/";
    std::array<std::string_view, 3> last{};
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view rest = text.substr(at);
        std::size_t size = 1;
        if (blanks.find(rest[0]) != blanks.npos) {
            ++at;
            continue;
        }
        if (rest.starts_with("//") || rest.starts_with("/*")) {
            const std::size_t end = rest.find(rest[1] == '/' ? "\n" : "*/", 2);
            at = end == rest.npos ? text.size() : at + end + (rest[1] == '/' ? 1 : 2);
            continue;
        }
        if (rest[0] == '"') {
            while (size < rest.size() && rest[size] != '"') size += rest[size] == '\\' ? 2 : 1;
            size = std::min(size + 1, rest.size());
        } else if (marks.find(rest[0]) == marks.npos) {
            size = std::min(rest.find_first_of(ends, 1), rest.size());
        }
        last = {last[1], last[2], rest.substr(0, size)};
        at += size;
        if (at >= byte) return last;
    }
    return {last[1], last[2], {}};
}

bool is_one_of(std::string_view token, std::string_view marks) {
    return token.size() == 1 && marks.find(token) != marks.npos;
}

/// The mistakes that people make, in their words; empty of any other. `at` becomes the place of the mistake, which is
/// before what cannot be read.
std::string mistake(std::string_view text, std::size_t& at, std::string_view what) {
    const auto [older, before, token] = tokens_at(text, at);
    if (!what.starts_with("syntax error")) return "";
    for (const char* close : {"]", "}"})
        if (what.ends_with(fmt::format("unexpected end of input; expected '{}'", close)))
            return fmt::format("the text ends here, and a {} is missing", close);
    if (token.empty()) return "";
    const auto begin_of = [&](std::string_view t) { return static_cast<std::size_t>(t.data() - text.data()) + 1; };
    const std::size_t here = begin_of(token);
    const auto said = [&](std::size_t place, std::string words) {
        at = place;
        return words;
    };
    for (const std::string_view quote : {"“", "”", "„", "‘", "’", "«", "»", "'"})
        if (token.starts_with(quote))
            return said(here, fmt::format("texts stand in quotes like \"these\", and not in {}", quote));
    std::size_t within = 0;
    if (const LookAlike* one = token[0] == '"' ? nullptr : look_alike_in(token, within)) {
        const bool of_number = one->meant == "-" || one->meant == " ";
        return said(here + within, in_words(*one) + (of_number ? "" : "; expressions stand in quotes like \"2*pi\""));
    }
    if (token[0] == '+') return said(here, "a number has no + before it");
    if (token[0] == '.') return said(here, "a number begins with a digit, as 0.5 does");
    if (token[0] == '#') return said(here, "a comment begins with //");
    if (token[0] == '/' && !before.empty() && is_digit(before.back()))
        return said(begin_of(before), fmt::format("an expression stands in quotes, like \"{}{}\"", before, token));
    const bool is_key = what.find("expected string literal") != what.npos;
    const std::string word = in_one_line(std::string(token), 40);
    if (what.ends_with("expected end of input")) return said(here, fmt::format("{} stands behind the end", word));
    // The first word of all need not be meant to be a scene's.
    const bool is_no_literal = is_one_of(before, "{[,:") && what.find("invalid literal") != what.npos;
    if (is_no_literal && is_digit(token[0]))
        return said(here, fmt::format("an expression stands in quotes, like \"{}\"", word));
    if (is_no_literal && is_letter(token[0]))
        return said(here, word == "True" || word == "False"
                              ? "true and false have small letters"
                              : fmt::format("{} in quotes, like \"{}\"",
                                            is_key ? "a name stands" : "texts and expressions stand", word));
    if (before == ",") {
        if (is_one_of(token, "}]"))
            return said(begin_of(before), fmt::format("nothing stands between this comma and {}", token));
        if (is_key && is_digit(token[0]) && !older.empty() && is_digit(older.back()))
            return said(begin_of(before), "a number has a point and no comma");
    }
    if (before.empty() || is_one_of(before, "{[,:") || is_one_of(token, ",:}]")) return "";
    for (const auto& [wanted, name] :
         {std::pair{"expected ':'", "colon"}, {"expected '}'", "comma"}, {"expected ']'", "comma"}})
        if (what.find(wanted) != what.npos)
            return said(begin_of(before) + before.size(),
                        fmt::format("a {} is missing after {}{}", name, in_one_line(std::string(before), 40),
                                    about_units(fmt::format("{}{}", before, token))));
    return "";
}

/// Takes nlohmann's events and makes the document, which knows at any time what it is at.
class Builder {
  public:
    Builder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    bool null() { return put(nullptr); }
    bool boolean(bool value) { return put(value); }
    bool number_integer(std::int64_t value) { return put(value); }
    bool number_unsigned(std::uint64_t value) { return put(value); }
    bool number_float(double value, const std::string&) { return put(value); }
    bool string(std::string& value) { return put(std::move(value)); }
    bool binary(Json::binary_t&) { return false; }
    bool start_object(std::size_t) { return open(Json::object()); }
    bool start_array(std::size_t) { return open(Json::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }

    bool key(std::string& name) {
        Json& object = *open_.back();
        if (object.size() >= most_keys) throw here().error(fmt::format("must have at most {} keys", most_keys));
        if (object.contains(name)) throw here().error(fmt::format("has the key {} twice", shown(name)));
        next_ = &object[name];
        return true;
    }

    bool parse_error(std::size_t byte, const std::string&, const nlohmann::json::exception& e) {
        std::string words = plain(e, text_, byte);
        if (const std::string known = mistake(text_, byte, words); !known.empty()) words = known;
        throw Error(fmt::format("{}:{}: {}", file_, line_and_column(text_, byte), words));
    }

    Json document;

  private:
    bool put(Json&& value) {
        if (open_.empty())
            next_ = &document;
        else if (open_.back()->is_array())
            next_ = &open_.back()->emplace_back();
        *next_ = std::move(value);
        return true;
    }

    bool open(Json&& empty) {
        if (open_.size() == deepest)
            throw Error(fmt::format("{}: objects and lists must be nested at most {} deep", file_, deepest));
        put(std::move(empty));
        open_.push_back(next_);
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    Place here() const {
        Place place{file_, ""};
        for (std::size_t k = 0; k + 1 < open_.size(); ++k)
            place = open_[k]->is_array() ? place / (open_[k]->size() - 1)
                                         : place / open_[k]->get_ref<const Json::object_t&>().back().first;
        return place;
    }

    std::string_view text_;
    const std::string& file_;
    std::vector<Json*> open_;  // parents of what comes next; none of them grows while a child of it is open
    Json* next_ = nullptr;
};

void write(const Json& value, std::size_t indent, std::string& out) {
    const std::string flat = value.dump();
    if (!value.is_structured() || flat.size() + indent <= line_width || value.empty()) {
        out += flat;
        return;
    }
    const std::string margin(indent + 2, ' ');
    out += value.is_object() ? "{" : "[";
    bool first = true;
    for (const auto& [key, item] : value.items()) {
        out += (first ? "\n" : ",\n") + margin;
        first = false;
        if (value.is_object()) out += Json(key).dump() + ": ";
        write(item, indent + 2, out);
    }
    out += "\n" + std::string(indent, ' ') + (value.is_object() ? "}" : "]");
}

}  // namespace

Error Place::expected(const std::string& allowed, const Json& value, const std::string& why) const {
    return error(fmt::format("must be {}, got {}{}{}", allowed, shown(value), why.empty() ? "" : ": ", why));
}

void require_utf8(const Json& value, const Place& place) {
    try {
        (void)value.dump();
        return;
    } catch (const Json::type_error&) {
    }
    if (value.is_object())
        for (const auto& [key, item] : value.items()) require_utf8(item, place / key);
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i) require_utf8(value[i], place / i);
    throw place.expected("a text in UTF-8", value);
}

std::string shown(const Json& value) {
    if (value.is_structured() && value.size() > 30) return value.is_array() ? "a long list" : "a large object";
    return in_one_line(value.dump(-1, ' ', false, Json::error_handler_t::replace), 60);
}

Json parse_json(std::string_view text, const std::string& file) {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        throw Error(fmt::format("{}: is empty, and must be a scene", file));
    if (text.find('\0') != std::string_view::npos)
        throw Error(fmt::format("{}: is not a text, and must be a scene in JSON", file));
    Builder builder(text, file);
    Json::sax_parse(text.begin(), text.end(), &builder, Json::input_format_t::json, true, true);
    return std::move(builder.document);
}

std::string pretty(const Json& value) {
    std::string out;
    write(value, 0, out);
    return out + "\n";
}

}  // namespace carom
