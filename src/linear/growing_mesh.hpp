/// A mesh of which elements come one after the other: those that are there, with the faces that they leave
/// bare, in addition to the whole of it.
///
/// The present mesh has all nodes, numbered as in the whole one, and of each block the elements that are
/// born, in their order. Of a named surface it has the faces that bound exactly one of its elements: faces
/// that are covered leave it. Faces inside the whole mesh that belong to no named surface are bare as long as
/// there are elements on one of their sides alone; they join the surface that is named for it.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/surfaces/faces.hpp"

namespace solidus::linear {

class GrowingMesh {
 public:
  /// Times at which the elements of a block are born [s], [element]; empty: all are there from the start.
  using Births = std::vector<double>;
  /// @param whole  must outlive this object
  /// @param births  [block], the same for an element on all processes that hold it; +∞: never
  /// @param bare    [body]: the surface that its bare faces join; empty: none
  /// Times are rounded up to multiples of `interval` from the first one on where it is above zero. More than
  /// k_most_times different ones are rounded to so many. Collective.
  GrowingMesh(const mesh::Mesh& whole, std::vector<Births> births, std::vector<std::string> bare,
              double interval = 0);

  static constexpr int k_most_times = 400;
  const mesh::Mesh& present() const { return present_; }
  double time() const { return time_; }
  /// The different times of birth, rising, the same on all processes.
  const std::vector<double>& times() const { return times_; }
  /// Makes the present mesh that of a time. Returns whether it has changed on any process. Not backward.
  bool advance(double time);
  /// Whether an element of the whole mesh is there, by its number in the input.
  bool there(std::int64_t input_element) const;

 private:
  /// An element of a block that grows, or the fact that one of another block lies there.
  struct Side {
    std::int32_t block = -1;
    Index element = -1;
    int face = -1;
  };
  struct Face {
    std::vector<Side> sides;  ///< one or two
    bool named = false;       ///< it belongs to a surface of the whole mesh
  };
  void round_times(double interval);
  void find_faces();
  bool born(const Side& side) const;
  int present_sides(const Face& face) const;
  void fill_blocks();
  void fill_surfaces();
  void add_bare_faces();

  const mesh::Mesh& whole_;
  std::vector<Births> births_;
  std::vector<std::string> bare_;
  std::vector<double> times_;
  double time_;
  mesh::Mesh present_;
  std::unordered_map<mesh::FaceKey, Face, mesh::FaceKeyHash> faces_;  ///< of elements that are born
  std::vector<mesh::FaceKey> order_;                                  ///< of faces_, the same in every run
  std::vector<std::pair<std::int64_t, double>> births_of_;            ///< by number in the input, rising
};

}  // namespace solidus::linear
