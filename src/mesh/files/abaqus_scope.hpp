/// Nodes, elements, sets and surfaces of a part, an instance or a whole deck of Abaqus, each by its own
/// numbers.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "mesh/raw_mesh.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

struct AbaqusElement {
  Shape shape = Shape::point1;
  std::vector<Index> nodes;
  GlobalIndex number = 0;
};

/// Numbers of nodes or elements: first, first + step, … up to last. They need not exist yet.
struct NumberRange {
  int scope = 0;  ///< 0: the scope that the set belongs to; k: the k-th instance of the assembly
  GlobalIndex first = 0, last = 0, step = 1;

  GlobalIndex count() const { return (last - first) / step + 1; }
};

/// Names compare without case, and keep the case of their first appearance.
struct AbaqusSet {
  std::string name;
  std::vector<NumberRange> ranges;
  SourceLocation at;      ///< where the set begins
  bool internal = false;  ///< made by a program for its own use: no group of the mesh
  bool unsorted = false;  ///< the order of the numbers counts

  void add(GlobalIndex number, int scope = 0);
};
using AbaqusSets = std::map<std::string, AbaqusSet>;  ///< by the name in upper case

AbaqusSet& set_of(AbaqusSets& sets, const std::string& name, const SourceLocation& at);

/// Elements and one face of them each.
struct AbaqusFaces {
  std::vector<NumberRange> elements;
  std::string label;  ///< S1, S2, …; SPOS or SNEG: the elements themselves
  SourceLocation at;
};
struct AbaqusSurface {
  std::string name;
  std::vector<AbaqusFaces> faces;
};

struct AbaqusScope {
  std::string name;  ///< of the part or the instance; empty: the deck or its assembly
  SourceLocation at;
  std::vector<Point> x;  ///< [m]
  std::vector<GlobalIndex> node_number;
  std::vector<AbaqusElement> elements;
  std::unordered_map<GlobalIndex, Index> node_at, element_at;
  AbaqusSets node_sets, element_sets;
  std::map<std::string, AbaqusSurface> surfaces;

  /// Throw InputError for a number that is there already.
  void add_node(GlobalIndex number, const Point& x, const SourceLocation& at);
  void add_element(AbaqusElement element, const SourceLocation& at);
  /// Throws InputError where there is no such node.
  Index node(GlobalIndex number, const SourceLocation& at) const;
};

/// The mesh of a deck, whose scopes are the deck itself and the instances of its assembly in their order.
/// @param path  for messages
RawMesh mesh_of_scopes(const std::string& path, const std::vector<AbaqusScope>& scopes,
                       std::vector<std::string> notes);

}  // namespace solidus::mesh
