/// The fields of a state under the names that users know, ready for files and probes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "coupling/phases.hpp"
#include "parallel/parallel.hpp"
#include "quantities/quantity.hpp"
#include "results/fields/field.hpp"
#include "results/fields/recovered_stress.hpp"

namespace solidus::results {

/// Those fields of coupling/all_fields.hpp exist that the analysis has. Fields of elements and what is
/// computed on request (quantities::Written) are computed when they are read; stress at nodes is recovered
/// (recovered_stress.hpp). A node of several contacts shows the one with the closest partner, and what
/// friction accumulates as the largest of all.
class StateFields {
 public:
  StateFields(const mesh::Mesh& mesh, const coupling::Phases& phases, AnalysisKind kind);

  /// Takes the values of a committed state; gaps are those of the pairs as they are, which must be at that
  /// state. Fields of elements are computed from the state when they are read. Collective.
  void update(const coupling::State& state);
  /// The same for the fields of criteria, which cost more and are needed less often. Collective.
  void update_criteria(const coupling::State& state);
  /// Frees the memory of the fields of criteria, up to 90 bytes a node; it reads as zero until the next
  /// update.
  void release_criteria();

  /// Fields of the bodies, and of each contact surface by its name. They can be read until this object or the
  /// phases go.
  const FieldSet& bodies() const { return bodies_; }
  const std::map<std::string, FieldSet>& surfaces() const { return surfaces_; }

 private:
  struct Values {
    std::string name, unit;
    int components = 1;
    mesh::FieldPlace place = mesh::FieldPlace::node;
    std::vector<double> values = {};
    bool of_contact = false;
    std::function<std::vector<double>()> compute = {};             ///< instead of values
    bool on_request = false;                                       ///< Field::on_request
    std::function<std::vector<double>(int body)> compute_of = {};  ///< Field::compute_of
  };
  Values& add_values(const quantities::Quantity& quantity);
  /// A field that is stored, zero.
  std::vector<double>& add(const quantities::Quantity& quantity);
  /// Of a field that is stored.
  std::vector<double>& values_of(const quantities::Quantity& quantity);
  void find_side_areas(AnalysisKind kind);
  void add_elements();
  void add_heat_flux();
  void add_nodal_stress();
  void add_criteria();
  /// The fields of contact, on bodies and on the surfaces of contacts.
  /// @param n_of_phases  the first fields, whose nodal ones surfaces show too
  void add_contact_fields(std::size_t n_of_phases);
  void update_contacts(std::span<const double> temperature);
  /// @param closest  of each node of the fields: it shows this pair
  void update_heat(const contact::ContactNodalFields& fields, std::span<const char> closest);
  void update_friction(const contact::ContactNodalFields& fields, std::span<const char> closest);

  const mesh::Mesh& mesh_;
  const coupling::Phases& phases_;
  AnalysisKind kind_;
  std::unique_ptr<StressRecovery> recovery_;  ///< from its first use on
  parallel::GhostExchange ghosts_;
  std::vector<std::unique_ptr<Values>> values_;  // stable addresses: the sets hold views
  std::map<std::string, std::vector<double>*, std::less<>> by_name_;
  /// Nodal areas of the sides of each pair, slave and master: ∫ N_a dA, [local node], owned ones complete
  /// [m²].
  std::vector<std::array<std::vector<double>, 2>> side_area_;
  mechanics::MechanicalState shown_;  ///< of the state of the last update(), its values of elements alone
  std::vector<double> covered_;       ///< Field::covered of tractions and fluxes of contact
  FieldSet bodies_;
  std::map<std::string, FieldSet> surfaces_;
};

}  // namespace solidus::results
