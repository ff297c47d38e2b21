/// How deep the metal behind a surface is coherent, by which a wall lets go of it.
///
/// A wall holds metal until a shell has formed. The elements at a face are coherent by their mean once the
/// shell is about half an element thick (coupling/coherency.hpp), so that by them alone thinner elements let
/// go earlier, and the time to freeze has no limit with the mesh. Therefore the shell has a least thickness
/// too, a length of the casting: k_shell_depth times its section V/A. The thickness at a node of the surface
/// is its distance d from the isotherm of the coherency fraction, found between the nodes of elements:
///
///   c = min(c_elements, d/ℓ)
///
/// Elements with edges of 4 ℓ and more reach this thickness before they are coherent as a rule; they are left
/// out.
/// Figures: docs/theory/step_and_mesh.md.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::coupling {

/// The least thickness of a shell that its wall lets go of, in sections V/A of the casting: a sixteenth of
/// the thickness of a plate.
inline constexpr double k_shell_depth = 0.125;

class SkinDepth {
 public:
  /// @param surfaces  names of surfaces in contact
  /// @param melts     [block]: whether it deforms and can melt
  /// @param length    ℓ of every body [m]; zero: no least thickness
  /// Keeps a reference to the mesh. Collective.
  SkinDepth(const mesh::Mesh& mesh, std::span<const std::string> surfaces, std::span<const char> melts,
            std::span<const double> length);

  /// Whether there is anything to limit. The same on every process.
  bool any() const { return any_; }
  /// Lowers the coherency of owned nodes of the surfaces to d/ℓ where that is less than one. Collective.
  /// @param of_nodes   f_S/f_c of the nodes themselves, [local node], ghosts up to date
  /// @param coherency  that of their elements, [local node]
  void limit(std::span<const double> of_nodes, std::span<double> coherency) const;

 private:
  /// The nearest known point of the isotherm.
  struct Nearest {
    double distance;
    mesh::Point point;
  };
  std::span<const Index> nodes_of(std::size_t element) const {
    const std::size_t first = element == 0 ? 0 : cell_ends_[element - 1];
    return std::span(cell_nodes_).subspan(first, cell_ends_[element] - first);
  }
  void find_cells(std::span<const char> melts, std::span<const double> length);
  void offer(Index node, const mesh::Point& point, std::vector<Nearest>& nearest) const;
  /// Hands points from node to node within an element until no node knows a nearer one.
  void spread(std::vector<Nearest>& nearest) const;
  /// Brings ghosts up to date.
  /// @param nodes  local numbers of what `nearest` is of; empty: of all local nodes
  void exchange(std::span<const Index> nodes, std::vector<Nearest>& nearest) const;

  const mesh::Mesh& mesh_;
  std::vector<Index> nodes_;            ///< near the surfaces, local numbers
  std::vector<double> length_;          ///< ℓ of their body, [nodes_]
  std::vector<char> on_surface_;        ///< [nodes_]
  std::vector<Index> cell_nodes_;       ///< of all elements near a surface, numbers in nodes_
  std::vector<std::size_t> cell_ends_;  ///< [element]: behind its last node in cell_nodes_
  bool has_ghosts_;                     ///< on any process
  bool any_ = false;
};

}  // namespace solidus::coupling
