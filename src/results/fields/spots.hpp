/// Places of single values in the fields of a run, and what is around them.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"
#include "results/fields/field.hpp"

namespace solidus::results {

/// A field as it reads now; empty if the run has no such field.
class FieldValues {
 public:
  FieldValues(const FieldSet& fields, std::string_view name) {
    const Field* field = fields.find(name);
    if (field == nullptr) return;
    values_ = field->read(storage_);
    components_ = as_size(field->components);
  }
  FieldValues(const FieldValues&) = delete;
  FieldValues& operator=(const FieldValues&) = delete;

  bool empty() const { return values_.empty(); }
  double operator[](std::size_t i) const { return values_[i]; }
  std::span<const double> all() const { return values_; }
  std::size_t components() const { return components_; }
  /// The length of the vector at a node or in an element.
  double length(std::size_t i) const {
    double square = 0;
    for (std::size_t k = 0; k < components_; ++k)
      square += values_[i * components_ + k] * values_[i * components_ + k];
    return std::sqrt(square);
  }

 private:
  std::vector<double> storage_;
  std::span<const double> values_;
  std::size_t components_ = 1;
};

/// The place of a value in a field on the process that owns it, and those of the values around it.
struct Spot {
  std::size_t at = 0;
  std::vector<std::size_t> around;
};

/// Mean of the corners and edge nodes of an element [m].
mesh::Point centre(const mesh::Mesh& mesh, const mesh::ElementBlock& block, Index element);
/// The nodes of chosen bodies, [local node].
std::vector<char> nodes_of(const mesh::Mesh& mesh, const std::vector<char>& bodies);
/// The owned node of these that lies exactly there; around it are those of them that share an element with
/// it. Nothing where this process has none.
/// @param counts  [local node]
std::optional<Spot> node_spot(const mesh::Mesh& mesh, const mesh::Point& where,
                              const std::vector<char>& counts);
/// The counted element with exactly this centre; around it are the elements of its body that share a node
/// with it. Nothing where this process has none.
std::optional<Spot> element_spot(const mesh::Mesh& mesh, const mesh::Point& where);

/// |a − mean around| at a spot; zero where nothing is around it.
template <class Value>
double difference_to_around(const Spot& spot, const Value& value) {
  if (spot.around.empty()) return 0;
  double sum = 0;
  for (const std::size_t i : spot.around) sum += value(i);
  return std::abs(value(spot.at) - sum / static_cast<double>(spot.around.size()));
}

}  // namespace solidus::results
