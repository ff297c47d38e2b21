/// Element types of Abaqus and CalculiX for the shapes of Solidus: names, and positions of their integration
/// points.
#pragma once

#include <string>
#include <vector>

#include "mesh/shape.hpp"
#include "numbers/types.hpp"

namespace solidus::results {

/// "C3D8", "CPE4", "CAX4", ... with as many integration points as mesh::stiffness_rule. Throws
/// std::invalid_argument for a shape that is none of a body.
std::string deck_element_type(AnalysisKind kind, mesh::Shape shape);

/// Our point for each integration point of CalculiX, in its order. It expands plane and axisymmetric elements
/// into solid ones of one layer, whose points lie above each other.
std::vector<int> calculix_points(mesh::Shape shape);

/// A face of one of our elements as S1, S2, ... calls it.
int deck_face_label(mesh::Shape shape, int face);

}  // namespace solidus::results
