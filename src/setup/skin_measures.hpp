/// Measures of the skins of the bodies at the start: contacts with their gaps, and the surfaces of thermal
/// conditions. Over all processes.
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "contact/pair.hpp"
#include "mesh/mesh.hpp"

namespace solidus::setup {

/// Measures of a contact as it was built, with the bodies at their place in the mesh. Body −1: a rigid tool;
/// −2: several.
struct ContactMeasures {
  std::string slave, master;  ///< as the program chose them
  int slave_body = -1, master_body = -1;
  double area = 0, paired = 0;            ///< of the slave: all of it, and the part with a partner [m²]
  double least_gap = 0, largest_gap = 0;  ///< over points with a partner, negative: overlap [m]
  double mean_gap = 0;                    ///< of the gaps above zero, over points with a partner [m]
  /// The same as a run begins with: facets and gaps that count as touching are taken out [m].
  double least_start = 0, largest_start = 0, mean_start = 0;
  double face_size = 0;         ///< mean of the slave's faces [m]
  double master_face_size = 0;  ///< of the master's; zero: a rigid tool [m]
  /// Parts of the paired area where the master lies below the slave, as gravity acts, above it or next to it;
  /// zero without gravity [m²].
  double below = 0, above = 0, beside = 0;
  GlobalIndex shared_nodes = 0;  ///< nodes that lie on both surfaces
};

/// Measures of a named surface.
struct SurfaceMeasures {
  int body = -1;                     ///< −1: it has no faces; −2: several bodies
  double area = 0;                   ///< [m²]
  std::vector<mesh::Point> corners;  ///< of its faces, and their centres: all processes', the same on each
  std::vector<mesh::Point> centres;  ///< of at most some hundred of its faces [m]
};

inline constexpr int k_several_bodies = -2;

/// Collective.
/// @param gravity  of any length; zero: none acts
ContactMeasures measure_contact(const mesh::Mesh& mesh, const contact::ContactPair& pair, AnalysisKind kind,
                                const mesh::Point& gravity);
/// Collective. A group that is no surface has no faces.
SurfaceMeasures measure_surface(const mesh::Mesh& mesh, const std::string& name, AnalysisKind kind);

/// Share of the faces of a surface that lie on a body: a riser and its casting, which share nodes, may share
/// the surface toward their mould. Collective.
double share_behind(const mesh::Mesh& mesh, const std::string& surface, int body);

/// Nodes that lie on both of two surfaces. Collective.
GlobalIndex shared_nodes(const mesh::Mesh& mesh, const std::string& a, const std::string& b);

/// Points of all processes, in the order of the processes. Collective.
std::vector<mesh::Point> gather(const std::vector<mesh::Point>& points);

}  // namespace solidus::setup
