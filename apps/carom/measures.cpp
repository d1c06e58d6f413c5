#include "measures.hpp"

#include <limits>
#include <utility>

namespace carom::app {

namespace {

/// The points with a bar of twice the standard error each.
void add_points(Panel& panel, const GasCurve& curve) {
    const Colour colour = palette(0);
    Curve bars{.colour = colour, .width = 0.7};
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
        if (!(curve.error[k] > 0)) continue;
        for (const double y : {curve.y[k] - 2 * curve.error[k], curve.y[k] + 2 * curve.error[k], gap}) {
            bars.x.push_back(curve.x[k]);
            bars.y.push_back(y);
        }
    }
    panel.curves.push_back({.label = curve.law.empty() ? "" : "measured",
                            .x = curve.x,
                            .y = curve.y,
                            .stroke = Stroke::line_and_points,
                            .colour = colour,
                            .width = 0.7});
    if (!bars.x.empty()) panel.curves.push_back(std::move(bars));
}

}  // namespace

Figure gas_figure(const GasMeter& meter) {
    Figure figure{.columns = 2};
    for (const GasCurve& curve : meter.curves()) {
        Panel panel{.x_label = curve.x_label, .y_label = curve.y_label};
        if (!curve.law.empty())
            panel.curves.push_back(
                {.label = curve.law_name, .x = curve.x, .y = curve.law, .colour = palette(1), .width = 2});
        add_points(panel, curve);
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

std::vector<std::filesystem::path> write_measures(const GasMeter& meter, const std::filesystem::path& folder,
                                                  Provenance run) {
    std::vector<std::filesystem::path> files;
    const std::string summary = comment_lines({.summary = std::exchange(run.summary, "")});
    const auto table = [&](const char* name, std::initializer_list<Column> columns, const auto& write) {
        files.push_back(folder / name);
        File file(files.back());
        file.write(comment_lines(run));
        Csv csv(std::move(file), {columns.begin(), columns.size()}, false);
        write(csv);
        csv.file().write(summary);
        csv.commit();
    };
    table("measures.csv", {{"measure"}, {"value"}, {"standard error"}, {"unit"}}, [&](Csv& csv) {
        for (const GasNumber& n : meter.numbers()) csv.row(n.name, n.value, n.error, n.unit);
    });
    table("curves.csv", {{"curve"}, {"x"}, {"y"}, {"standard error"}, {"law"}, {"what x is"}, {"what y is"}},
          [&](Csv& csv) {
              for (const GasCurve& c : meter.curves())
                  for (std::size_t k = 0; k < c.x.size(); ++k)
                      csv.row(c.name, c.x[k], c.y[k], c.error[k],
                              c.law.empty() ? std::numeric_limits<double>::quiet_NaN() : c.law[k], c.x_label,
                              c.y_label);
          });
    table("fields.csv",
          {{"x", "m"},
           {"y", "m"},
           {"density", "1/m²"},
           {"density error", "1/m²"},
           {"flow x", "m/s"},
           {"flow x error", "m/s"},
           {"flow y", "m/s"},
           {"flow y error", "m/s"},
           {"k T", "J"},
           {"k T error", "J"}},
          [&](Csv& csv) {
              for (const GasMeter::Field& f : meter.fields())
                  csv.row(f.centre.x, f.centre.y, f.density, f.density_error, f.flow.x, f.flow_error.x, f.flow.y,
                          f.flow_error.y, f.temperature, f.temperature_error);
          });
    return files;
}

}  // namespace carom::app
