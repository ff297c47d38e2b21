/// Finds the elements that points lie in, for many points of one process's mesh.
#pragma once

#include <memory>

#include "mesh/locate.hpp"
#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// Keeps a reference to the mesh. Not collective: it sees the elements of this process alone.
class ElementSearch {
 public:
  /// @param body  in whose elements points are looked for; −1: in those of all
  explicit ElementSearch(const Mesh& mesh, int body = -1);
  ~ElementSearch();

  struct Found : NodalFunctional {
    double distance = 0;  ///< from the point to the mesh [m], zero inside (to rounding)
    double size = 0;      ///< mean edge of the box around that element [m]
  };
  /// The nodes and weights N_a(ξ) of the place nearest to a point; where several elements have it, of the
  /// lowest one. Not where empty().
  Found find(const Point& point) const;
  /// Whether this process has no such element.
  bool empty() const;

 private:
  struct Tree;
  const Mesh& mesh_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace solidus::mesh
