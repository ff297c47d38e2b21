/// Gaps and areas of contacts and conditions, measured at the start over all processes.
#include "setup/skin_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "contact/surfaces/surface.hpp"
#include "mesh/block_geometry.hpp"
#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::setup {

namespace {

/// The body behind a surface, as seen from all processes.
int body_of(const mesh::Mesh& mesh, const std::string& name) {
  const auto surface = mesh.surfaces.find(name);
  int low = std::numeric_limits<int>::max(), high = -1;
  if (surface != mesh.surfaces.end())
    for (const mesh::ElementBlock& faces : surface->second.faces)
      if (faces.size() > 0 && faces.body >= 0)
        low = std::min(low, faces.body), high = std::max(high, faces.body);
  const auto lowest = static_cast<int>(parallel::global_min(low)),
             highest = static_cast<int>(parallel::global_max(high));
  if (highest < 0) return -1;
  return lowest == highest ? lowest : k_several_bodies;
}

}  // namespace

double share_behind(const mesh::Mesh& mesh, const std::string& surface, int body) {
  double own = 0, all = 0;
  if (const auto found = mesh.surfaces.find(surface); found != mesh.surfaces.end())
    for (const mesh::ElementBlock& faces : found->second.faces) {
      all += static_cast<double>(faces.n_counted);
      if (faces.body == body) own += static_cast<double>(faces.n_counted);
    }
  own = parallel::global_sum(own);
  all = parallel::global_sum(all);
  return all > 0 ? own / all : 0.0;
}

GlobalIndex shared_nodes(const mesh::Mesh& mesh, const std::string& a, const std::string& b) {
  const auto one = mesh.surfaces.find(a), two = mesh.surfaces.find(b);
  if (one == mesh.surfaces.end() || two == mesh.surfaces.end()) return 0;
  std::vector<Index> both;
  std::set_intersection(one->second.nodes.begin(), one->second.nodes.end(), two->second.nodes.begin(),
                        two->second.nodes.end(), std::back_inserter(both));
  const auto owned = std::count_if(both.begin(), both.end(), [&](Index i) { return i < mesh.n_owned_nodes; });
  return static_cast<GlobalIndex>(std::llround(parallel::global_sum(static_cast<double>(owned))));
}

std::vector<mesh::Point> gather(const std::vector<mesh::Point>& points) {
  std::vector<double> mine;
  for (const mesh::Point& point : points) mine.insert(mine.end(), point.begin(), point.end());
  const std::vector<double> numbers = processes::gather(mine);
  std::vector<mesh::Point> all(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) all[i / 3][i % 3] = numbers[i];
  return all;
}

namespace {

/// The surfaces of a pair whose faces come and go with all of their faces, and their points as drawn.
struct WholePair {
  WholePair(const mesh::Mesh& mesh, AnalysisKind kind, contact::ContactParameters spec)
      : surfaces(mesh, spec), geometry(mesh, kind, grown(std::move(spec)), surfaces) {}
  static contact::ContactParameters grown(contact::ContactParameters spec) {
    spec.growing.clear();
    return spec;
  }
  contact::PairSurfaces surfaces;
  contact::ContactGeometry geometry;
};

}  // namespace

ContactMeasures measure_contact(const mesh::Mesh& mesh, const contact::ContactPair& pair, AnalysisKind kind,
                                const mesh::Point& gravity) {
  constexpr double k_level = 0.05;  // cosine of the angle to gravity below which a face is upright
  const double weight =
      std::sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2]);
  // What check tells of a contact: areas and sizes of faces of both sides, the gaps as the bodies lie, and
  // how the faces are inclined to gravity.
  ContactMeasures m;
  m.slave = pair.parts().spec.slave;
  m.master = pair.parts().spec.master;
  m.slave_body = body_of(mesh, m.slave);
  m.master_body = body_of(mesh, m.master);
  m.area = measure_surface(mesh, m.slave, kind).area;
  m.face_size = contact::ContactSurface(mesh, m.slave).mean_face_size();
  if (mesh.surfaces.count(m.master) != 0)
    m.master_face_size = contact::ContactSurface(mesh, m.master).mean_face_size();
  m.shared_nodes = shared_nodes(mesh, m.slave, m.master);
  // Gaps are measured at the points of contact, weighted by their area; those at the start have the initial
  // offset taken away.
  double low = std::numeric_limits<double>::max(), high = -low, low_start = low, high_start = high;
  std::optional<WholePair> whole;
  if (!pair.parts().spec.growing.empty()) whole.emplace(mesh, kind, pair.parts().spec);
  const contact::ContactGeometry& geometry = whole ? whole->geometry : pair.parts().geometry;
  const contact::ContactKinematics& kinematics = geometry.kinematics();
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    if (!kinematics.particle(p).counted) continue;
    const contact::PointMotion motion =
        kinematics.motion(p, contact::ContactPointState{}, contact::ContactKinematics::Asked::motion);
    if (!motion.partnered) continue;
    m.paired += motion.weight;
    m.mean_gap += motion.weight * std::max(0.0, -motion.penetration);
    if (weight > 0) {
      const mesh::Point& n = motion.normal;  // from the slave to the master
      const double down = (n[0] * gravity[0] + n[1] * gravity[1] + n[2] * gravity[2]) / weight;
      (down > k_level ? m.below : down < -k_level ? m.above : m.beside) += motion.weight;
    }
    low = std::min(low, -motion.penetration);
    high = std::max(high, -motion.penetration);
    const double start = -motion.penetration - geometry.initial_offset(p, motion.penetration);
    m.mean_start += motion.weight * std::max(0.0, start);
    low_start = std::min(low_start, start);
    high_start = std::max(high_start, start);
  }
  // Sums and extremes are those of all processes.
  for (double* area : {&m.paired, &m.below, &m.above, &m.beside}) *area = parallel::global_sum(*area);
  m.mean_gap = m.paired > 0 ? parallel::global_sum(m.mean_gap) / m.paired : 0.0;
  m.least_gap = parallel::global_min(low);
  m.largest_gap = parallel::global_max(high);
  m.mean_start = m.paired > 0 ? parallel::global_sum(m.mean_start) / m.paired : 0.0;
  m.least_start = parallel::global_min(low_start);
  m.largest_start = parallel::global_max(high_start);
  return m;
}

SurfaceMeasures measure_surface(const mesh::Mesh& mesh, const std::string& name, AnalysisKind kind) {
  // The area is integrated; corners and centres of faces are gathered for comparisons between surfaces. Of
  // many centres every so many are kept.
  SurfaceMeasures m;
  m.body = body_of(mesh, name);
  if (m.body == -1) return m;
  std::vector<mesh::Point> corners, centres;
  if (const auto surface = mesh.surfaces.find(name); surface != mesh.surfaces.end())
    for (const mesh::ElementBlock& faces : surface->second.faces) {
      const mesh::FaceGeometry geometry(mesh, faces, kind, mesh::stiffness_rule(faces.shape));
      const int vertices = mesh::vertex_count(faces.shape);
      for (Index f = 0; f < faces.n_counted; ++f) {
        // The area is that of the mesh as it bends, by quadrature; corners and centres are for
        // distances alone.
        for (int p = 0; p < geometry.n_points; ++p)
          m.area += geometry.weight[as_size(f * geometry.n_points + p)];
        mesh::Point centre{};
        for (int n = 0; n < vertices; ++n) {
          const mesh::Point& x = mesh.x[as_size(faces.element(f)[n])];
          for (std::size_t d = 0; d < 3; ++d) centre[d] += x[d] / vertices;
          corners.push_back(x);
        }
        corners.push_back(centre);
        centres.push_back(centre);
      }
    }
  // Every process ends with the same numbers and points.
  m.area = parallel::global_sum(m.area);
  m.corners = gather(corners);
  const std::vector<mesh::Point> all = gather(centres);
  constexpr std::size_t k_most = 200;
  const std::size_t stride = 1 + all.size() / k_most;
  for (std::size_t i = 0; i < all.size(); i += stride) m.centres.push_back(all[i]);
  return m;
}

}  // namespace solidus::setup
