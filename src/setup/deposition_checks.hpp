/// Warnings of depositions whose path lays nothing down, and of metal that comes to lie on nothing or too
/// late.
#pragma once

#include <span>
#include <vector>

#include "cases/case_spec.hpp"
#include "input/travel_path.hpp"
#include "linear/growing_mesh.hpp"
#include "mesh/mesh.hpp"

namespace solidus::setup {

/// Where a path lays elements of a body down, counted along its way.
class LaidDown {
 public:
  /// @param piece  length of the pieces of the way in which elements are counted [m], above zero
  LaidDown(const cases::DepositionSpec& deposition, const TravelPath& path, double piece);
  /// Counts an element of this process that is born when the path has come along a move.
  /// @param move   number of the move's first point
  /// @param along  distance from there [m]
  void count(std::size_t move, double along);
  /// Warns of the first two pieces in a row in which nothing is laid down. Collective.
  void warn() const;

 private:
  const cases::DepositionSpec& deposition_;
  const TravelPath& path_;
  double piece_;
  std::vector<double> way_;    ///< way with the tool on before each point of the path [m]
  std::vector<double> count_;  ///< of elements, [piece]
};

/// Warns of elements that are born after the run has ended, and of those that touch nothing that is there
/// when they are born. Collective.
/// @param births  [block][element], as GrowingMesh takes them
void check_births(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                  const std::vector<linear::GrowingMesh::Births>& births);

}  // namespace solidus::setup
