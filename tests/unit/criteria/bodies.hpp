/// Blocks whose states are given, not solved for, for the tests of thermal criteria.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "criteria/criterion.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::test {

/// Round numbers: ρ = 1000 kg/m³, C = 1000 J/(kg K), L = 2e5 J/kg, freezing ends at 900 K − range.
inline material::Material metal(double range) {
  material::Material m;
  m.name = "metal";
  m.density = 1000;
  m.conductivity = Table(100.0);
  m.specific_heat = Table(1000.0);
  m.phase_changes = {{"solidification", material::PhaseFraction::linear(900 - range, 900), 2e5, -0.05, true}};
  m.casting.arm_spacing = 10e-6;
  m.casting.arm_spacing_exponent = 0.5;
  m.casting.melt_viscosity = 1e-3;
  m.casting.critical_pressure_drop = 1e5;
  return m;
}

inline mesh::Mesh block_mesh(mesh::Shape shape, std::vector<double> size, std::vector<int> divisions) {
  mesh::RawMesh raw;
  const int rank = processes::rank();
  if (rank == 0) {
    raw = mesh::make_block({std::move(size), {}, std::move(divisions), "block"}, shape);
    mesh::validate_and_orient(raw, "block");
  }
  return mesh::distribute(raw, {"block"}, {});
}

/// A body of one metal and a criterion that follows states of it.
class Casting {
 public:
  Casting(mesh::Mesh mesh_, double range)
      : mesh(std::move(mesh_)),
        kind(mesh.dimension == 3 ? AnalysisKind::solid : AnalysisKind::plane_strain),
        storage(mesh, kind, {metal(range)}),
        ghosts_(mesh) {}

  using Field = std::function<double(const mesh::Point&)>;
  /// Temperatures alone, as with the open rule.
  void start(const criteria::Criterion& criterion, double time, const Field& temperature) {
    next_ = with_temperature(temperature);
    time_ = time;
    record = criterion.initial({time_, next_.heat, mechanics_, next_.fraction});
  }
  void step(criteria::Criterion& criterion, double time, const Field& temperature) {
    go(criterion, time, with_temperature(temperature));
  }
  /// With heat contents: `melt` is the heat above that of the solid at 900 K, per volume [J/m³].
  void start_heat(const criteria::Criterion& criterion, double time, const Field& melt) {
    next_ = with_heat(melt);
    time_ = time;
    record = criterion.initial({time_, next_.heat, mechanics_, next_.fraction});
  }
  void step_heat(criteria::Criterion& criterion, double time, const Field& melt) {
    go(criterion, time, with_heat(melt));
  }
  /// The fields by name, [local node].
  std::map<std::string, std::vector<double>> fields(const criteria::Criterion& criterion) const {
    std::map<std::string, std::vector<double>> result;
    std::vector<std::vector<double>> values;
    for (std::size_t f = 0; f < criterion.fields().size(); ++f) values.emplace_back(mesh.x.size(), 99.0);
    const std::vector<std::span<double>> spans(values.begin(), values.end());
    criterion.fill({time_, next_.heat, mechanics_, next_.fraction}, record, spans);
    for (std::size_t f = 0; f < values.size(); ++f)
      result[std::string(criterion.fields()[f]->name)] = values[f];
    return result;
  }

  mesh::Mesh mesh;
  AnalysisKind kind;
  heat::NodalEnthalpy storage;
  criteria::CriterionRecord record;

 private:
  struct Snapshot {
    heat::ThermalState heat;
    std::vector<double> fraction;
  };
  Snapshot with_temperature(const Field& temperature) {
    Snapshot s;
    for (const mesh::Point& x : mesh.x) s.heat.temperature.push_back(temperature(x));
    set_fraction(s);
    return s;
  }
  Snapshot with_heat(const Field& melt) {
    Snapshot s;
    s.heat.temperature.resize(mesh.x.size());
    s.heat.enthalpy.resize(mesh.x.size());
    for (Index i = 0; i < mesh.n_owned_nodes; ++i) {
      const auto k = static_cast<std::size_t>(i);
      s.heat.enthalpy[k] = storage.lower(i, 900) + storage.volume(i, 0) * melt(mesh.x[k]);
      s.heat.temperature[k] = storage.temperature(i, s.heat.enthalpy[k]);
    }
    ghosts_.update(s.heat.enthalpy, 1);
    ghosts_.update(s.heat.temperature, 1);
    set_fraction(s);
    return s;
  }
  void set_fraction(Snapshot& s) const {
    s.fraction.assign(mesh.x.size(), 0.0);
    for (Index i = 0; i < mesh.n_owned_nodes; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double t = s.heat.temperature[k];
      const double heat = s.heat.enthalpy.empty() ? storage.upper(i, t) : s.heat.enthalpy[k];
      s.fraction[k] = storage.solid_fraction(i, heat, t);
    }
    ghosts_.update(s.fraction, 1);
  }
  void go(criteria::Criterion& criterion, double time, Snapshot next) {
    const Snapshot old = std::move(next_);
    next_ = std::move(next);
    criterion.step({time_, old.heat, mechanics_, old.fraction},
                   {time, next_.heat, mechanics_, next_.fraction}, record);
    time_ = time;
  }

  parallel::GhostExchange ghosts_;
  mechanics::MechanicalState mechanics_;
  Snapshot next_;
  double time_ = 0;
};

}  // namespace solidus::test
