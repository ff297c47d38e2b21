/// The cells of MED (the format of Salome and Code_Aster) that our shapes are.
#pragma once

#include <med.h>

#include <vector>

namespace solidus::mesh {

/// MED's node i of a cell is VTK's node order[i]: the bases of MED's solids go round the other way, seen from
/// their tops (MED 4.1, "Numérotation locale des nœuds").
struct MedCell {
  int vtk;  ///< VTK's number of the type
  med_geometry_type med;
  int dimension;
  const char* name;  ///< as MED calls it, for messages
  std::vector<int> order;
};

/// Those of elements of a body and of its faces and edges.
inline const std::vector<MedCell>& med_cells() {
  static const std::vector<MedCell> k_cells = {
      {3, MED_SEG2, 1, "SEG2", {0, 1}},
      {21, MED_SEG3, 1, "SEG3", {0, 1, 2}},
      {5, MED_TRIA3, 2, "TRIA3", {0, 1, 2}},
      {9, MED_QUAD4, 2, "QUAD4", {0, 1, 2, 3}},
      {22, MED_TRIA6, 2, "TRIA6", {0, 1, 2, 3, 4, 5}},
      {23, MED_QUAD8, 2, "QUAD8", {0, 1, 2, 3, 4, 5, 6, 7}},
      {10, MED_TETRA4, 3, "TETRA4", {0, 2, 1, 3}},
      {14, MED_PYRA5, 3, "PYRA5", {0, 3, 2, 1, 4}},
      {13, MED_PENTA6, 3, "PENTA6", {0, 2, 1, 3, 5, 4}},
      {12, MED_HEXA8, 3, "HEXA8", {0, 3, 2, 1, 4, 7, 6, 5}},
      {24, MED_TETRA10, 3, "TETRA10", {0, 2, 1, 3, 6, 5, 4, 7, 9, 8}},
      {25, MED_HEXA20, 3, "HEXA20", {0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17}}};
  return k_cells;
}

}  // namespace solidus::mesh
