/// Temperatures at which a table bends, and others between them, are the rows of a property's file.
#include "app/material_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "input/units.hpp"
#include "material/laws/hardening_law.hpp"
#include "material/tensile.hpp"
#include "results/output/csv.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;
using material::Flow;
using material::IsotropicHardening;
using material::KinematicHardening;
using material::Material;
using results::CsvColumn;
using results::CsvTable;

constexpr double k_zero_celsius = 273.15, k_room = 293.15;
constexpr double k_test_rate = 1e-3;      ///< strain rate of the overstress column [1/s]
constexpr int k_temperatures = 240;       ///< rows between the first and the last temperature, at least
constexpr int k_strains = 100;            ///< rows of flow_curves.csv
constexpr std::size_t k_most_curves = 7;  ///< more lines cannot be told apart in a picture

/// Every temperature at which a property changes its course, and the ends of the ranges that are stated.
std::vector<double> marked_temperatures(const Material& m) {
  std::vector<double> marks{k_room};
  for (const material::Property& p : m.properties())
    if (!p.table->constant()) marks.insert(marks.end(), p.table->x().begin(), p.table->x().end());
  for (const material::PropertyNote& note : m.notes)
    if (note.valid_to > note.valid_from) marks.insert(marks.end(), {note.valid_from, note.valid_to});
  for (const material::PhaseChange& change : m.phase_changes) {
    for (const auto& [temperature, fraction] : change.fraction.points()) marks.push_back(temperature);
    marks.push_back(change.fraction.liquidus() + 20);  // a piece of the melt
  }
  return marks;
}

/// The marks and evenly spaced temperatures between; around an isothermal phase change one just below, so
/// that a line through the rows shows the jump.
std::vector<double> sampled_temperatures(const Material& m, const material::EnthalpyCurve& enthalpy) {
  std::vector<double> samples = marked_temperatures(m);
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  const double first = *low, step = (*high - *low) / k_temperatures;
  for (int i = 1; i < k_temperatures; ++i) samples.push_back(first + i * step);
  for (const auto& jump : enthalpy.jumps()) samples.push_back(jump.temperature - 1e-3);
  std::sort(samples.begin(), samples.end());
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  return samples;
}

struct SampledColumn {
  CsvColumn column;
  std::function<double(double)> value;  ///< of the absolute temperature
};

/// A stress in MPa, anything else in SI.
SampledColumn property_column(const material::Property& p) {
  const bool stress = std::string(p.unit) == "Pa";
  const double scale = stress ? 1e-6 : 1;
  std::string name = p.name;
  name.erase(0, name.find('.') + 1);  // npos + 1 is 0
  return {{name, stress ? "MPa" : p.unit},
          [table = p.table, scale](double theta) { return scale * table->value(theta); }};
}

void write_properties(const Material& m, const fs::path& file) {
  const material::EnthalpyCurve enthalpy = m.enthalpy();
  const double at_room = enthalpy.upper(k_room);
  // Enthalpy counts from room temperature; the other columns are the properties that the material has.
  std::vector<SampledColumn> columns{
      {{"temperature", "degC"}, [](double theta) { return theta - k_zero_celsius; }},
      {{"enthalpy", "kJ/kg"},
       [&](double theta) { return 1e-3 * (enthalpy.upper(theta) - at_room) / m.density; }}};
  if (m.solidification())
    columns.push_back({{"solid_fraction", "1"}, [&](double theta) { return m.solid_fraction(theta); }});
  // Every table of the card is a column, the overstress one more where rates matter.
  const std::vector<material::Property> properties = m.properties();
  for (const material::Property& p : properties) columns.push_back(property_column(p));
  if (m.flow && !m.flow->rate_independent())
    columns.push_back({{"overstress_at_rate_1e-3", "MPa"}, [&](double theta) {
                         return 1e-6 * material::tensile_overstress(*m.flow, k_test_rate, theta);
                       }});
  // One row for each temperature that the tables have.
  std::vector<CsvColumn> header;
  for (const SampledColumn& c : columns) header.push_back(c.column);
  CsvTable table(file, header);
  std::vector<double> row(columns.size());
  for (const double theta : sampled_temperatures(m, enthalpy)) {
    std::transform(columns.begin(), columns.end(), row.begin(),
                   [theta](const SampledColumn& c) { return c.value(theta); });
    table.add(row);
  }
}

/// The temperatures of the tests, or of the flow stress's points; of many, some over the whole range.
std::vector<double> curve_temperatures(const Flow& flow) {
  const auto points = flow.flow_stress.x();
  if (flow.flow_stress.constant()) return {k_room};
  if (points.size() <= k_most_curves) return {points.begin(), points.end()};
  std::vector<double> chosen;
  for (std::size_t i = 0; i < k_most_curves; ++i)
    chosen.push_back(points[i * (points.size() - 1) / (k_most_curves - 1)]);
  return chosen;
}

/// As far as the tests went, or until the hardening has nearly saturated.
double largest_strain(const Flow& flow) {
  double strain = 0.2;
  if (flow.isotropic == IsotropicHardening::table && flow.curves.strains().back() > 0)
    strain = flow.curves.strains().back();
  strain = std::min(strain, material::hardening_law(flow.isotropic).saturation(flow.hardening));
  if (flow.isotropic == IsotropicHardening::none && flow.kinematic == KinematicHardening::armstrong_frederick)
    strain = std::min(strain, 5 / flow.recall[0].min_value());
  return strain;
}

void write_flow_curves(const Flow& flow, const fs::path& file) {
  // A column for each temperature of the curves.
  const std::vector<double> temperatures = curve_temperatures(flow);
  std::vector<CsvColumn> header{{"plastic_strain", "1"}};
  for (const double theta : temperatures)
    header.push_back({fmt::format("stress_at_{:.6g}_degC", theta - k_zero_celsius), "MPa"});
  CsvTable table(file, header);
  const double last = largest_strain(flow);
  for (int i = 0; i <= k_strains; ++i) {
    const double share = static_cast<double>(i) / k_strains;
    const double strain = last * share * share;  // closer where the curves are steep
    std::vector<double> row{strain};
    for (const double theta : temperatures)
      row.push_back(1e-6 * material::tensile_stress(flow, strain, theta));
    table.add(row);
  }
}

}  // namespace

void write_material_tables(const Material& material, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw results::OutputError(folder.string(), "cannot make this folder: " + error.message(),
                               "-o names another one");
  write_properties(material, folder / "properties.csv");
  if (material.flow) write_flow_curves(*material.flow, folder / "flow_curves.csv");
}

}  // namespace solidus::app
