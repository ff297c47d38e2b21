/// Castings that freeze from given walls at one temperature, for the tests of feeding.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "criteria/feeding.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::test {

inline constexpr double k_shrinks = 0.066;  ///< (ρ_s − ρ_l)/ρ_l

/// Freezes between two temperatures, or at one: no contraction of melt or solid.
inline material::Material shrinking_metal(double solidus = 900, double liquidus = 900) {
  material::Material m;
  m.name = "metal";
  m.density = 1000;
  m.conductivity = Table(100.0);
  m.specific_heat = Table(1000.0);
  m.phase_changes = {{"solidification", material::PhaseFraction::linear(solidus, liquidus), 2e5,
                      -k_shrinks / (1 + k_shrinks), true}};
  m.casting.arm_spacing = 10e-6;
  m.casting.arm_spacing_exponent = 0.5;
  m.casting.melt_viscosity = 1e-3;
  m.casting.critical_pressure_drop = 1e5;
  return m;
}

inline mesh::Mesh feeding_block(mesh::Shape shape, std::vector<double> size, std::vector<int> divisions) {
  mesh::RawMesh raw;
  if (processes::rank() == 0) {
    raw = mesh::make_block({std::move(size), {}, std::move(divisions), "block"}, shape);
    mesh::validate_and_orient(raw, "block");
  }
  return mesh::distribute(raw, {"block"}, {});
}

/// A casting whose solid fractions are given at every moment.
class FreezingBody {
 public:
  using Solid = std::function<double(const mesh::Point&)>;

  FreezingBody(mesh::Mesh mesh_, AnalysisKind kind, material::Material material,
               criteria::FeedingOptions options = {})
      : mesh(std::move(mesh_)),
        material_(std::move(material)),
        storage(mesh, kind, {material_}),
        ghosts_(mesh) {
    options.bodies = {1};
    options.risers = {0};
    if (mesh.dimension == 3) options.up = {0, 0, 1};
    feeding = std::make_unique<criteria::Feeding>(mesh, kind, storage, options);
  }

  void start(const Solid& solid) {
    now_ = snapshot(solid);
    record = feeding->initial(input(0, now_));
  }
  void step(double time, const Solid& solid) {
    const Snapshot old = std::move(now_);
    now_ = snapshot(solid);
    feeding->step(input(time_, old), input(time, now_), record);
    time_ = time;
  }
  criteria::FeedingTotals totals() const { return criteria::Feeding::totals(record); }
  criteria::FeedingRows rows() { return criteria::FeedingRows(record.columns[0].values); }
  double found(const std::string& name) const {
    for (const criteria::CriterionResult& result : feeding->findings(record))
      if (result.name == name) return result.value;
    return -1;
  }

  mesh::Mesh mesh;

 private:
  material::Material material_;
  mechanics::MechanicalState mechanics_;
  struct Snapshot {
    heat::ThermalState heat;
    std::vector<double> solid, plateau;
  };
  Snapshot snapshot(const Solid& solid) const {
    const material::PhaseFraction& fraction = material_.solidification()->fraction;
    const double solidus = fraction.solidus(), range = fraction.liquidus() - solidus;
    Snapshot s;
    for (const mesh::Point& x : mesh.x) {
      const double f = solid(x);
      s.solid.push_back(std::clamp(f, 0.0, 1.0));
      s.plateau.push_back(range > 0 ? 1 : 1 - s.solid.back());
      s.heat.temperature.push_back(range > 0 ? solidus + (1 - f) * range
                                   : f <= 0  ? solidus + 1
                                   : f >= 1  ? solidus - 1
                                             : solidus);
    }
    return s;
  }
  criteria::CriterionInput input(double time, const Snapshot& s) const {
    return {time, s.heat, mechanics_, s.solid, s.plateau};
  }

 public:
  heat::NodalEnthalpy storage;
  std::unique_ptr<criteria::Feeding> feeding;
  criteria::CriterionRecord record;

 private:
  parallel::GhostExchange ghosts_;
  Snapshot now_;
  double time_ = 0;
};

}  // namespace solidus::test
