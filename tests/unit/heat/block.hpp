/// Blocks of one or two materials for the tests of the thermal phase.
#pragma once

#include <cmath>

#include "heat/thermal_phase.hpp"
#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "system/processes.hpp"

namespace solidus::test {

/// Round numbers of a metal: conductivity 100 W/(m K), heat capacity 2.5e6 J/(m³ K), latent heat of 280 times
/// the sensible heat of one kelvin (7e8 J/m³), melting ending at 900 K.
inline material::Material metal(double range, double latent_over_capacity = 280) {
  material::Material m;
  m.name = "metal";
  m.density = 2500;
  m.conductivity = Table(100.0);
  m.specific_heat = Table(1000.0);
  m.phase_changes = {{"solidification", material::PhaseFraction::linear(900 - range, 900),
                      latent_over_capacity * 1000, 0.0, true}};
  return m;
}

inline int rank() {
  return processes::rank();
}

/// A rectangle or box of one body "block" on all processes.
inline mesh::Mesh block_mesh(mesh::Shape shape, std::vector<double> size, std::vector<int> divisions,
                             const std::function<mesh::Point(mesh::Point)>& map = {}) {
  mesh::RawMesh raw;
  if (rank() == 0) {
    raw = mesh::make_block({std::move(size), {}, std::move(divisions), "block"}, shape);
    if (map)
      for (mesh::Point& x : raw.x) x = map(x);
    mesh::validate_and_orient(raw, "block");
  }
  return mesh::distribute(raw, {"block"}, {});
}

inline int processes() {
  const int size = processes::count();
  return size;
}

inline bool is_3d(mesh::Shape shape) {
  return mesh::dimension(shape) == 3;
}

}  // namespace solidus::test
