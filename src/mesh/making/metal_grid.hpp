/// Metal on a grid of cubes: how deep each lies below the skin, how wide ways through metal are and how long.
/// Rank 0 only.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Ways in metal from several places to each cube.
struct WaysInMetal {
  std::vector<double>
      length;             ///< [cube] of the shortest, from the edge of its place [m]; huge: there is none
  std::vector<int> from;  ///< [cube] the place that it comes from; −1: none
};

/// A place from which ways begin: a disc normal to z, as the foot of a riser.
struct WayStart {
  Point centre{};
  double radius = 0, below = 0;  ///< of the disc, and how far above and below it cubes count [m]
};

class MetalGrid {
 public:
  /// @param bodies  that are one piece of metal
  /// @param number  of cubes in the metal, about
  MetalGrid(const RawMesh& mesh, const std::vector<std::string>& bodies, std::size_t number);

  std::size_t size() const { return cubes_.size(); }
  /// Edge of a cube [m].
  double edge() const { return edge_; }
  Point centre(std::size_t cube) const;
  /// Distance of its centre from the skin [m], to half an edge.
  double depth(std::size_t cube) const { return depth_[cube]; }
  /// Whether no neighbour is deeper.
  bool on_ridge(std::size_t cube) const;
  /// The cube that holds a point, or the nearest one. There is one at least.
  std::size_t cube_at(const Point& point) const;
  /// The volume of the metal in a ball [m³].
  double volume_in(const Point& centre, double radius) const;
  /// The depth that the way to each cube has at its narrowest, of the way on which that is the largest [m];
  /// 0: there is none.
  std::vector<double> widest_ways(std::size_t from) const;
  /// Whether a neighbour is nearer to another place.
  bool between_places(std::size_t cube, const WaysInMetal& ways) const;
  WaysInMetal shortest_ways(const std::vector<WayStart>& starts) const;

 private:
  std::size_t cell(int x, int y, int z) const;
  void fill(const RawMesh& mesh, const std::vector<std::string>& bodies);
  void measure_depth();
  std::vector<int> neighbours(std::size_t cube) const;
  /// The cubes from which ways begin, with ways of no length.
  WaysInMetal beginnings(const std::vector<WayStart>& starts) const;

  double edge_ = 0;
  Point low_{};
  int n_[3] = {0, 0, 0};
  std::vector<int> cube_of_;        ///< [cell] −1: no metal
  std::vector<std::size_t> cubes_;  ///< [cube] its cell
  std::vector<double> depth_;       ///< [cube]
};

}  // namespace solidus::mesh
