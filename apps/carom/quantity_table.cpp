#include "quantity_table.hpp"

#include <fmt/format.h>

#include "report.hpp"

namespace carom::app {

namespace {

std::vector<Column> columns_of(const std::vector<std::string>& texts) {
    std::vector<Column> columns{{"t", "s"}};
    for (const std::string& text : texts) columns.push_back({text, unit_of(text)});
    return columns;
}

File with_comments(File file, bool begun, const Provenance& provenance) {
    if (!begun) file.write(comment_lines(provenance));
    return file;
}

}  // namespace

std::vector<Quantity> quantities_of(const Scene& scene, const World& start, const std::vector<std::string>& texts) {
    std::vector<Quantity> quantities;
    for (const std::string& text : texts) {
        try {
            quantities.emplace_back(text, start, scene.parameters());
        } catch (const Error& e) {
            throw Error(fmt::format("--quantity {}: {}", text, e.what()));
        }
    }
    return quantities;
}

QuantityTable::QuantityTable(File file, bool begun, const Scene& scene, const World& start,
                             const std::vector<std::string>& texts, const Provenance& provenance)
    : quantities_(quantities_of(scene, start, texts)),
      csv_(with_comments(std::move(file), begun, provenance), columns_of(texts), begun) {}

void QuantityTable::add(const World& world) {
    row_.assign(1, world.time());
    for (const Quantity& quantity : quantities_) row_.push_back(quantity(world));
    csv_.row_of(row_);
}

void QuantityTable::commit(const std::string& summary) {
    csv_.file().write(comment_lines({.summary = summary}));
    csv_.commit();
}

}  // namespace carom::app
