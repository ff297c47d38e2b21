/// The fields of one moment, which field files and probes read. They are views of data that other objects
/// own, or are computed whenever they are read, so that they need not be stored.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linear/active_set.hpp"
#include "mesh/field_place.hpp"
#include "mesh/mesh.hpp"

namespace solidus::results {

/// Values in SI. Shapes by place and number of components (1 scalar, 2 or 3 vector, 6 symmetric tensor in the
/// order xx, yy, zz, xy, yz, xz):
///   node  [local node][component]; ghosts hold their owner's value;
///   cell  [block of Mesh::blocks][element, counted or not][component], the blocks one behind the other.
struct Field {
  std::string name;  ///< "temperature"
  std::string unit;  ///< of the values, SI: "K"; "1" for a fraction
  int components = 1;
  mesh::FieldPlace place = mesh::FieldPlace::node;
  std::span<const double> values;                     ///< empty where they are computed
  std::function<std::vector<double>()> compute = {};  ///< local to this process; empty: there are values
  /// The part of the surface around a node that its value holds for, [local node]: what means and integrals
  /// over a group count it with. Empty: all of it.
  std::span<const double> covered = {};
  bool on_request = false;  ///< written to files only where it is named
  /// The values that one of Mesh::bodies has at its nodes, where bodies that share them differ; empty: they
  /// do not. Collective, as `compute` is then.
  std::function<std::vector<double>(int body)> compute_of = {};
  /// Tensors have the components rr, zz, hoop and rz, where others have xx, yy, zz and xy.
  bool cylindrical = false;

  /// Returns the values; computed ones are put into `storage`. They are computed at every call, so a caller
  /// that needs them several times stores them. Of fields with compute_of collective.
  /// @param body  whose values they are; −1: of all
  std::span<const double> read(std::vector<double>& storage, int body = -1) const;
};

class FieldSet {
 public:
  /// Fields that are added later are of an axisymmetric analysis, whose tensors have cylindrical components.
  void set_cylindrical(bool on) { cylindrical_ = on; }
  /// Throws std::invalid_argument for a second field of the same name.
  void add(Field field);
  /// Null when there is no such field.
  const Field* find(std::string_view name) const;
  const std::vector<Field>& all() const { return fields_; }
  /// Only the fields named, in this set's order; an empty list means all but those on request. Throws
  /// InputError for a name that is not there.
  FieldSet select(const std::vector<std::string>& names) const;

  /// Sets the active bodies. Cells of other bodies are hidden, and take no part in minima and maxima. Null:
  /// all bodies are active. Must outlive the set.
  void set_active(const linear::ActiveSet* active) { active_ = active; }
  const linear::ActiveSet* active() const { return active_; }
  /// Says of elements, by their numbers in the input, whether they are there; empty: all of active bodies
  /// are.
  using There = std::function<bool(std::int64_t input_element)>;
  void set_there(There there) { there_ = std::move(there); }
  bool there(std::int64_t input_element) const { return !there_ || there_(input_element); }

 private:
  std::vector<Field> fields_;
  bool cylindrical_ = false;
  const linear::ActiveSet* active_ = nullptr;
  There there_;
};

/// Number of values a field of this place and number of components has on this process.
std::size_t value_count(const mesh::Mesh& mesh, mesh::FieldPlace place, int components);

/// Throws std::invalid_argument when the number of values that a field has does not fit the mesh (our bug).
void check_size(const mesh::Mesh& mesh, const Field& field, std::size_t n_values);

}  // namespace solidus::results
