/// A channel as a line in the elements of a body: which nodes its wall takes heat from, and by how much their
/// temperatures differ from that of the wall.
///
/// The wall is a cylinder of the diameter d around the path, seen by points on it, in stations along the
/// path. Heat that passes through a point comes from the nodes of the element there, by their shape
/// functions. Together node i gives the share w_i of a station. Where elements are larger than the channel
/// all of this happens in one or a few of them, and a node is hotter than the wall: near a line that takes
/// q' [W/m] temperatures are
///
///   Θ = Θ_w + q'/(2π k) ln(r/r_w),   r_w = d/2
///
/// of which the mesh shows what it can. What it shows is computed: u solves the discrete conduction of unit
/// conductivity that the phase itself uses, with a unit of heat per length taken out by the same shares, and
/// ln(r/r_w)/(2π) prescribed some elements away. A node whose temperature is Θ_i then stands for a wall of
/// Θ_i − q' u_i/k. With the film of the fluid in series
///
///   q_i = w_i (Θ_i − Θ_f)/(1/(h π d) + u_i/k)                                                [W/m]
///
/// is the exact heat of the field above on any mesh, for every h: the well index of reservoir simulation
/// (D. W. Peaceman, SPE J. 18, 1978, has u = ln(0.208 Δx/r_w)/(2π) for squares) node by node. u tends to zero
/// as elements become smaller than the channel. Each node gives by its own temperature alone, so that the
/// matrix keeps its sign pattern. For this field the ways go straight on behind their ends, as far as there
/// is metal: a channel that another one follows is one with it.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "numbers/place_function.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

class ChannelLine {
 public:
  struct Station {
    Position x{};       ///< the middle [m]
    double length = 0;  ///< [m]; of a ring 2π r, of a bore through the plane one metre
    double inside = 0;  ///< share of its wall that lies in the body
  };
  /// The weight with which an owned node counts for a station.
  struct Share {
    Index node = 0;
    std::size_t station = 0;
    double weight = 0;  ///< w_i
    double excess = 0;  ///< u_i
  };

  /// @param path    corners of the way [m], two at least; in two dimensions the places of bores or rings, one
  ///                after the other
  /// @param closed  whether quads and hexes conduct by the closed rule
  /// Collective.
  ChannelLine(const mesh::Mesh& mesh, AnalysisKind kind, int body, const std::vector<Position>& path,
              double diameter, bool closed);

  const std::vector<Station>& stations() const { return stations_; }
  const std::vector<Share>& shares() const { return shares_; }
  /// The length of the elements that it crosses, their mean over all processes [m]; zero: it crosses none.
  double element_size() const { return element_size_; }

 private:
  void place_stations(AnalysisKind kind, const std::vector<Position>& path, double spacing);
  void find_shares(const mesh::Mesh& mesh, int body, const std::vector<Position>& path, double diameter);
  void find_excess(const mesh::Mesh& mesh, AnalysisKind kind, int body, const std::vector<Position>& path,
                   double diameter, bool closed);
  void drop_ends(std::size_t n_segments);

  std::vector<Station> stations_;
  std::vector<std::size_t> segments_;  ///< [station]: of the path
  std::vector<Share> shares_;
  double element_size_ = 0;
};

}  // namespace solidus::heat
