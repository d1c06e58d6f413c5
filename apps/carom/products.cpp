#include "products.hpp"

#include <fmt/format.h>

#include <carom/output.hpp>
#include <optional>

#include "pictures.hpp"
#include "report.hpp"

namespace carom::app {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (!failed && !fs::is_directory(folder, failed)) failed = std::make_error_code(std::errc::not_a_directory);
    if (failed)
        throw Error(fmt::format("the folder {} cannot be made: {}", folder.string(), failed.message()),
                    Error::Cause::run);
}

void write_file(const fs::path& path, const std::string& text) {
    File file(path);
    file.write(text);
    file.commit();
}

Performance perform(const Scene& scene, const std::string& label, const Products& wanted) {
    const World start = scene.world();
    const fs::path csv_path = !wanted.csv.empty() ? wanted.csv : wanted.report ? wanted.folder / "trajectory.csv" : "";
    std::optional<TrajectoryCsv> csv;
    std::optional<Pictures> pictures;
    std::vector<Observer> observers;
    if (!wanted.folder.empty()) {
        pictures.emplace(scene, start);
        make_folder(wanted.folder);
        observers.push_back([&](const World& world) { pictures->observe(world); });
    }
    if (!csv_path.empty()) {
        csv.emplace(csv_path, start);
        observers.push_back([&](const World& world) { csv->add(world); });
    }

    Performance out{run(scene, start, label, observers), {}};
    // Data before pictures, which may fail for want of gnuplot.
    if (csv) {
        csv->commit();
        out.files.push_back(csv_path);
    }
    if (wanted.report) {
        out.files.push_back(wanted.folder / "report.json");
        write_file(out.files.back(), report_json(scene, out.result) + "\n");
        out.files.push_back(wanted.folder / "scene.json");
        write_file(out.files.back(), scene.text());
        if (out.result.failure.empty()) {
            out.files.push_back(wanted.folder / ("end." + wanted.format));
            draw(out.result.world, fit(join(bounds(start), bounds(out.result.world))), out.files.back());
        }
    }
    if (pictures)
        for (const fs::path& file : pictures->draw(wanted.folder, wanted.format)) out.files.push_back(file);
    return out;
}

}  // namespace carom::app
