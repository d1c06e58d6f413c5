#include <fmt/format.h>

#include <carom/output.hpp>
#include <iterator>
#include <utility>

namespace carom {

Csv::Csv(const std::filesystem::path& path, std::span<const Column> columns) : file_(path) { header(columns); }
Csv::Csv(const std::filesystem::path& path, std::initializer_list<Column> columns) : file_(path) {
    header({columns.begin(), columns.size()});
}

Csv::Csv(File file, std::span<const Column> columns, bool has_header)
    : file_(std::move(file)), columns_(columns.size()) {
    if (!has_header) header(columns);
}

void Csv::header(std::span<const Column> columns) {
    columns_ = columns.size();
    for (const Column& column : columns) {
        cell(column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit));
    }
    end_row();
}

void Csv::row_of(std::span<const double> numbers) {
    for (double number : numbers) cell(number);
    end_row();
}

void Csv::cell(double number) {
    separate();
    fmt::format_to(std::back_inserter(line_), "{}", number);
}

void Csv::integer(long long number) {
    separate();
    fmt::format_to(std::back_inserter(line_), "{}", number);
}

void Csv::natural(unsigned long long number) {
    separate();
    fmt::format_to(std::back_inserter(line_), "{}", number);
}

void Csv::cell(std::string_view words) {
    separate();
    text(words);
}

void Csv::separate() {
    if (cells_++ > 0) line_ += ',';
}

void Csv::text(std::string_view words) {
    // A # begins a comment for some readers, though not within quotes.
    if (words.find_first_of(",\"\r\n#") == words.npos) {
        line_ += words;
        return;
    }
    line_ += '"';
    for (char c : words) line_.append(c == '"' ? 2 : 1, c);
    line_ += '"';
}

void Csv::end_row() {
    if (cells_ != columns_) {
        const auto cells = std::exchange(cells_, 0);
        line_.clear();
        throw Error(
            fmt::format("{}: a row of {} cells in a table of {} columns", file_.target().string(), cells, columns_));
    }
    line_ += '\n';
    file_.write(line_);
    line_.clear();
    cells_ = 0;
}

void Csv::commit() { file_.commit(); }

}  // namespace carom
