/// The columns of a record with their names, units and values, in the order of the file.
#include "point/record.hpp"

#include <array>
#include <utility>

#include "input/units.hpp"

namespace solidus::point {

namespace {

template <Sym<double> MaterialPointRecord::*member, int component>
double component_of(const MaterialPointRecord& r) {
  return (r.*member)[component];
}

template <Sym<double> MaterialPointRecord::*member, int... component>
constexpr std::array<double (*)(const MaterialPointRecord&), 6> components(
    std::integer_sequence<int, component...>) {
  return {component_of<member, component>...};
}

class Columns {
 public:
  void add(std::string name, const std::string& si, const std::string& unit,
           double (*of)(const MaterialPointRecord&)) {
    const units::Conversion c = units::conversion(si, unit);
    list.push_back({std::move(name), unit, si, c.scale, c.offset, of});
  }
  template <Sym<double> MaterialPointRecord::*member>
  void add_tensor(const std::string& name, const std::string& si, const std::string& unit) {
    const auto of = components<member>(std::make_integer_sequence<int, 6>{});
    for (std::size_t i = 0; i < 6; ++i) add(name + "_" + k_component_names[i], si, unit, of[i]);
  }
  std::vector<RecordColumn> list;
};

std::vector<RecordColumn> make_columns() {
  // The columns of a curve's table in their order: SI unit, unit that is shown, and the value of a record.
  Columns c;
  c.add("time", "s", "s", [](const MaterialPointRecord& r) { return r.time; });
  c.add("temperature", "K", "degC", [](const MaterialPointRecord& r) { return r.temperature; });
  c.add_tensor<&MaterialPointRecord::strain>("strain", "1", "1");
  c.add_tensor<&MaterialPointRecord::stress>("stress", "Pa", "MPa");
  c.add("von_mises", "Pa", "MPa", [](const MaterialPointRecord& r) { return von_mises(r.stress); });
  c.add("pressure", "Pa", "MPa", [](const MaterialPointRecord& r) { return -trace(r.stress) / 3; });
  c.add("flow_stress", "Pa", "MPa", [](const MaterialPointRecord& r) { return r.flow_stress; });
  c.add("equivalent_plastic_strain", "1", "1",
        [](const MaterialPointRecord& r) { return r.equivalent_plastic; });
  c.add_tensor<&MaterialPointRecord::plastic_strain>("plastic_strain", "1", "1");
  c.add_tensor<&MaterialPointRecord::viscous_strain>("viscous_strain", "1", "1");
  c.add_tensor<&MaterialPointRecord::back_stress>("back_stress", "Pa", "MPa");
  c.add("thermal_strain", "1", "1", [](const MaterialPointRecord& r) { return r.thermal_strain; });
  c.add("solid_fraction", "1", "1", [](const MaterialPointRecord& r) { return r.solid_fraction; });
  c.add("viscous_dissipation", "W/m3", "W/m3",
        [](const MaterialPointRecord& r) { return r.viscous_dissipation; });
  c.add("plastic_dissipation", "W/m3", "W/m3",
        [](const MaterialPointRecord& r) { return r.plastic_dissipation; });
  c.add("thermal_dissipation", "W/m3", "W/m3",
        [](const MaterialPointRecord& r) { return r.thermal_dissipation; });
  c.add("plastic_power", "W/m3", "W/m3", [](const MaterialPointRecord& r) { return r.plastic_power; });
  c.add("work", "J/m3", "kJ/m3", [](const MaterialPointRecord& r) { return r.work; });
  c.add("dissipated", "J/m3", "kJ/m3", [](const MaterialPointRecord& r) { return r.dissipated; });
  c.add("isotropic_energy", "J/m3", "kJ/m3", [](const MaterialPointRecord& r) { return r.isotropic_energy; });
  c.add("kinematic_energy", "J/m3", "kJ/m3", [](const MaterialPointRecord& r) { return r.kinematic_energy; });
  c.add("internal_energy", "J/m3", "kJ/m3", [](const MaterialPointRecord& r) { return r.internal_energy; });
  c.add("heat", "J/m3", "kJ/m3", [](const MaterialPointRecord& r) { return r.heat; });
  c.add("entropy", "J/m3/K", "kJ/m3/K", [](const MaterialPointRecord& r) { return r.entropy; });
  c.add("iterations", "1", "1",
        [](const MaterialPointRecord& r) { return static_cast<double>(r.iterations); });
  c.add("cuts", "1", "1", [](const MaterialPointRecord& r) { return static_cast<double>(r.cuts); });
  return std::move(c.list);
}

}  // namespace

const std::vector<RecordColumn>& columns() {
  static const std::vector<RecordColumn> list = make_columns();
  return list;
}

const RecordColumn* find_column(std::string_view name) {
  for (const RecordColumn& column : columns())
    if (column.name == name) return &column;
  return nullptr;
}

}  // namespace solidus::point
