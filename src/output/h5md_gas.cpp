// The measures of a gas in an H5MD file: observables that do not depend on time, each a dataset.

#include <algorithm>

#include "output/hdf5.hpp"
#include "output/hdf5_gas.hpp"

namespace carom::hdf5 {

namespace {

std::string as_name(std::string words) {
    std::replace(words.begin(), words.end(), ' ', '_');
    return words;
}

/// N/m in H5MD's way of writing units: N m-1.
std::string as_unit(std::string unit) {
    if (const auto square = unit.find("²"); square != std::string::npos) unit.replace(square, 2, "2");
    const auto slash = unit.find('/');
    if (slash == std::string::npos) return unit;
    const std::string above = unit.substr(0, slash);
    return (above == "1" ? "" : above + " ") + unit.substr(slash + 1) + "-1";
}

void column(hid_t parent, const char* name, const std::vector<double>& values, const std::string& unit = "") {
    const Object set = dataset(parent, name, H5T_NATIVE_DOUBLE, {values.size()}, values.data());
    if (!unit.empty()) attribute(set, "unit", unit);
}

/// A number of every cell.
template <class Of>
void field(hid_t parent, const char* name, const std::string& unit, const std::vector<GasMeter::Field>& all, Of of) {
    std::vector<double> values;
    for (const GasMeter::Field& f : all) values.push_back(of(f));
    column(parent, name, values, unit);
}

}  // namespace

void write_gas(hid_t parent, const GasMeter& meter) {
    for (const GasNumber& n : meter.numbers()) {
        const Object set = dataset(parent, as_name(n.name).c_str(), H5T_NATIVE_DOUBLE, {}, &n.value);
        attribute(set, "standard_error", n.error);
        attribute(set, "unit", as_unit(n.unit));
    }
    const Object curves = group(parent, "curves");
    for (const GasCurve& c : meter.curves()) {
        const Object curve = group(curves, as_name(c.name));
        attribute(curve, "x", c.x_label);
        attribute(curve, "y", c.y_label);
        column(curve, "x", c.x);
        column(curve, "y", c.y);
        column(curve, "standard_error", c.error);
        if (c.law.empty()) continue;
        column(curve, "law", c.law);
        attribute(curve, "law", c.law_name);
    }
    const auto cells = meter.fields();
    const Object fields = group(parent, "fields");
    using Field = GasMeter::Field;
    field(fields, "x", "m", cells, [](const Field& f) { return f.centre.x; });
    field(fields, "y", "m", cells, [](const Field& f) { return f.centre.y; });
    field(fields, "density", "m-2", cells, [](const Field& f) { return f.density; });
    field(fields, "density_error", "m-2", cells, [](const Field& f) { return f.density_error; });
    field(fields, "flow_x", "m s-1", cells, [](const Field& f) { return f.flow.x; });
    field(fields, "flow_x_error", "m s-1", cells, [](const Field& f) { return f.flow_error.x; });
    field(fields, "flow_y", "m s-1", cells, [](const Field& f) { return f.flow.y; });
    field(fields, "flow_y_error", "m s-1", cells, [](const Field& f) { return f.flow_error.y; });
    field(fields, "temperature", "J", cells, [](const Field& f) { return f.temperature; });
    field(fields, "temperature_error", "J", cells, [](const Field& f) { return f.temperature_error; });
}

}  // namespace carom::hdf5
