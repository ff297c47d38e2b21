/// Initial temperatures of bodies: uniform in a body, or a function of position.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "material/enthalpy.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::setup {

/// Lowest and highest temperature of a body at the start [K].
struct InitialTemperatureRange {
  double low = 0, high = 0;
};

/// A temperature field from a file is mapped by its enthalpy: h of the file's points is interpolated to the
/// nodes of the body, then shifted towards the file's highest or lowest value, by the same fraction α of the
/// distance at all nodes,
///   h_i ← h_i + α (h_max − h_i)  or  h_i + α (h_min − h_i),   Σ w_i h_i / Σ w_i as in the file,
/// so that the body has the file's enthalpy per volume, to rounding, within its bounds. w are the weights of
/// the quadrature at the nodes (closed rule) on either mesh. If the volumes differ by more than a hundredth
/// the body has another shape: nothing is shifted then, and a warning is given.
class InitialTemperatures {
 public:
  /// Reads the files given in the case; if [filling] gives a result, poured bodies and their moulds start
  /// with the temperatures at the end of filling. Collective. Throws InputError on every process.
  InitialTemperatures(const cases::CaseSpec& spec, const std::vector<material::Material>& materials,
                      const mesh::Mesh& mesh);
  /// Returns the initial temperature of a body at one of its nodes [K]; at the temperature of an isothermal
  /// change it is molten unless the file gives another state.
  double temperature(Index node, int body) const;
  /// The same as enthalpy per volume, from the material's curve [J/m³].
  double enthalpy(Index node, int body) const;
  /// Whether a body has a uniform temperature.
  bool uniform(int body) const { return bodies_[as_size(body)].enthalpies.empty(); }
  std::vector<InitialTemperatureRange> ranges() const;

 private:
  struct Body {
    double temperature = 0, enthalpy = 0;          ///< of a uniform one
    std::vector<double> temperatures, enthalpies;  ///< [local node], of the body's nodes; else empty
    InitialTemperatureRange range;
  };
  /// A body with given enthalpies at its nodes. Collective.
  static Body at_nodes(const mesh::Mesh& mesh, std::span<const Index> nodes,
                       std::span<const double> enthalpies, const material::EnthalpyCurve& curve);
  /// Adds to the bodies around a filled mould the heat taken up during filling (setup/filled_mould.hpp).
  void heat_moulds(const cases::CaseSpec& spec, const std::vector<material::Material>& materials,
                   const mesh::Mesh& mesh);
  Body evaluated(const PlaceSpec& place, const mesh::Mesh& mesh, int body, AnalysisKind kind,
                 const material::Material& material, const std::string& name) const;

  std::vector<Body> bodies_;
};

}  // namespace solidus::setup
