/// Surfaces become kinematics here: fixed partners for small sliding, a master that is searched for large
/// sliding, cells for segments. What does not go together is refused before anything is searched.
#include "contact/points/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "contact/laws/contact_law.hpp"
#include "contact/points/fixed_kinematics.hpp"
#include "contact/points/penalty.hpp"
#include "contact/points/segment_kinematics.hpp"
#include "contact/points/sliding_kinematics.hpp"
#include "contact/surfaces/master_mesh.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {

namespace {

constexpr double k_rounding = 1e-6;  ///< of coordinates, of the mean size of the slave's faces
constexpr double k_mostly = 0.5;     ///< of a point is a fit (FacetGap::fits)
constexpr double k_scatter = 0.25;   ///< of the heights of facets, which follow from those around them

ContactPoints find_points(const mesh::Mesh& mesh, AnalysisKind kind, const ContactParameters& spec,
                          double reach, const ContactSurface& slave, const ContactSurface& master) {
  IntegrationOptions options;
  options.rule = spec.integration;
  options.gauss_degree = spec.gauss_degree;
  options.search_distance = reach;
  ContactPoints points = integrate(mesh, kind, slave, master, options);
  // A pair that meets nowhere is a slip of the input, by a wrong name or a gap that is wider than
  // the search.
  if (points.paired_measure <= 0)
    throw InputError(spec.where,
                     fmt::format("contact '{}': no part of surface '{}' faces surface '{}' within {:.3g} m",
                                 spec.name, spec.slave, spec.master, options.search_distance),
                     "two surfaces that look at each other; or a larger search distance");
  return points;
}

bool has_linear_faces(const ContactSurface& surface) {
  for (Index face = 0; face < surface.n_faces(); ++face)
    if (mesh::order(surface.shape(face)) > 1) return false;
  return true;
}

/// A surface that folds on itself is no pair: a point would find its own face as its partner.
void require_apart(const mesh::Mesh& mesh, const ContactParameters& spec, const ContactSurface& slave,
                   const ContactSurface& master) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(spec.where, fmt::format("contact '{}': {}", spec.name, what),
                     "two surfaces that have no node in common: contact of a surface with itself is not "
                     "computed, and bodies that touch have nodes of their own ([[interface]] splits them)");
  };
  // Two names of one surface first, since the common nodes of that would be all of them.
  if (spec.slave == spec.master)
    refuse(fmt::format("slave and master are the same surface '{}'", spec.slave));
  const std::vector<Index>&of_slave = slave.all_nodes(), &of_master = master.all_nodes();
  std::vector<Index> both;
  std::set_intersection(of_slave.begin(), of_slave.end(), of_master.begin(), of_master.end(),
                        std::back_inserter(both));
  // Each shared node is counted by its owner, so that the number does not depend on the processes.
  const double shared = parallel::global_sum(static_cast<double>(
      std::ranges::count_if(both, [&](Index node) { return node < mesh.n_owned_nodes; })));
  if (shared > 0)
    refuse(fmt::format("the surfaces '{}' and '{}' share {:.0f} node{}", spec.slave, spec.master, shared,
                       shared > 1 ? "s" : ""));
}

std::vector<Index> owned_nodes(const mesh::Mesh& mesh, const PairSurfaces& surfaces) {
  std::vector<Index> nodes = surfaces.slave.all_nodes();
  if (surfaces.master)
    nodes.insert(nodes.end(), surfaces.master->all_nodes().begin(), surfaces.master->all_nodes().end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::erase_if(nodes, [&](Index node) { return node >= mesh.n_owned_nodes; });
  return nodes;
}

}  // namespace

PairSurfaces::PairSurfaces(const mesh::Mesh& mesh, const ContactParameters& spec) : slave(mesh, spec.slave) {
  if (spec.rigid_master) return;
  master.emplace(mesh, spec.master);
  require_apart(mesh, spec, slave, *master);
}

bool PairSurfaces::linear() const {
  return has_linear_faces(slave) && (!master || has_linear_faces(*master));
}

ContactParameters with_roles(const mesh::Mesh& mesh, ContactParameters spec,
                             std::span<const double> body_modulus) {
  if (!spec.choose_roles) return spec;
  // The slave is the side with smaller faces or, when they are alike, the softer side. Whatever is told of a
  // side changes with the roles.
  constexpr double k_alike = 0.05;  // sizes of faces
  const ContactSurface first(mesh, spec.slave), second(mesh, spec.master);
  const double ratio = first.mean_face_size() / second.mean_face_size();
  // Faces of a size decide before stiffness: pressures oscillate where the coarser side is the
  // slave.
  bool swap = ratio > 1 + k_alike;
  if (std::abs(ratio - 1) <= k_alike && body_modulus.size() == mesh.bodies.size())
    swap = local_stiffness(mesh, first, body_modulus) >
           (1 + k_alike) * local_stiffness(mesh, second, body_modulus);
  if (!swap) return spec;
  std::swap(spec.slave, spec.master);
  if (!spec.heat) return spec;
  // The share of the resistance that lies on the slave's side becomes that of the master's.
  if (spec.heat->slave_resistance) spec.heat->slave_resistance = 1 - *spec.heat->slave_resistance;
  if (spec.heat->contact_law != nullptr)
    if (std::shared_ptr<const ContactLaw> law = spec.heat->contact_law->swapped())
      spec.heat->contact_law = law;
  return spec;
}

ContactGeometry::ContactGeometry(const mesh::Mesh& mesh, AnalysisKind kind, const ContactParameters& spec,
                                 const PairSurfaces& surfaces)
    : mesh_(mesh),
      components_(displacement_components(kind)),
      face_size_(surfaces.slave.mean_face_size()),
      touching_(spec.touching.value_or(k_rounding * face_size_)),
      facets_close_(!spec.touching && spec.formulation == Formulation::small_sliding),
      surface_nodes_(owned_nodes(mesh, surfaces)) {
  make_kinematics(kind, spec, surfaces);
  if (!spec.growing.empty()) let_grow(spec);
  configuration_ = std::make_unique<CurrentConfiguration>(*kinematics_);
  graph_ = std::make_unique<ContactGraph>(*kinematics_);
  if (!facets_close_) return;
  // The bound over all points whose facets fit each other: below it a gap is rounding of the mesh,
  // not a gap of the bodies.
  double bound = 0;
  for (Index p = 0; p < n_points(); ++p)
    if (const FacetGap facets = kinematics_->facets(p); facets.fits > k_mostly)
      bound = std::max(bound, facets.bound);
  touching_ += 2 * bound;
}

void ContactGeometry::let_grow(const ContactParameters& spec) {
  const auto refuse = [&](const std::string& what, const std::string& allowed) {
    throw InputError(spec.where, fmt::format("contact '{}': {}", spec.name, what), allowed);
  };
  const bool grows = std::ranges::find(spec.growing, spec.master) != spec.growing.end();
  if (grows && spec.formulation == Formulation::large_sliding)
    refuse(fmt::format("its master '{}' grows, which large sliding cannot follow yet", spec.master),
           "the surface that grows as the slave, or formulation = \"small_sliding\"");
  if (spec.integration == IntegrationRule::mortar)
    refuse("integration = \"mortar\" where a surface grows: means around nodes are of several faces",
           "integration = \"segments\", \"gauss\" or \"nodal\"");
  // A point of small sliding keeps its faces on both sides; elsewhere the whole master is there.
  std::vector<Index> master_face;
  if (const auto* fixed = dynamic_cast<const FixedKinematics*>(kinematics_.get()))
    for (const Pairing& pairing : fixed->points().pairings)
      master_face.insert(master_face.end(), as_size(pairing.n_points), pairing.master_face);
  auto growing = std::make_unique<GrowingKinematics>(std::move(kinematics_), std::move(master_face));
  growing_ = growing.get();
  kinematics_ = std::move(growing);
}

std::vector<char> ContactGeometry::there() const {
  std::vector<char> all(as_size(n_points()));
  for (Index p = 0; p < n_points(); ++p) all[as_size(p)] = kinematics_->there(p) ? 1 : 0;
  return all;
}

void ContactGeometry::set_there(const FacesThere& faces) {
  if (growing_ != nullptr) growing_->set_there(faces);
}

double ContactGeometry::initial_offset(Index point, double penetration) const {
  if (!facets_close_) return std::abs(penetration) <= touching_ ? -penetration : 0.0;
  const FacetGap facets = kinematics_->facets(point);
  const double scatter = facets.fits > k_mostly ? k_scatter * facets.bound : 0;
  const double height = facets.fits > k_mostly ? facets.height : 0;
  return std::abs(penetration + height) <= k_rounding * face_size_ + scatter ? -penetration : height;
}

void ContactGeometry::make_kinematics(AnalysisKind kind, const ContactParameters& spec,
                                      const PairSurfaces& surfaces) {
  const bool slides = spec.formulation == Formulation::large_sliding;
  // Combinations that no kinematics has are refused here, before anything is built.
  if (!surfaces.master && !slides)
    throw InputError(spec.where, fmt::format("contact '{}': a rigid surface with small sliding", spec.name),
                     "formulation = \"large_sliding\"");
  if (slides && spec.integration == IntegrationRule::mortar)
    throw InputError(
        spec.where, fmt::format("contact '{}': integration = \"mortar\" with large sliding", spec.name),
        "formulation = \"small_sliding\", or integration = \"segments\", \"gauss\" or \"nodal\"");
  // Without a distance of the user's, partners are searched up to a tenth of the slave's extent.
  const ContactSurface& slave = surfaces.slave;
  const double reach = spec.search_distance.value_or(0.1 * slave.extent());
  // Small sliding finds all partners once, in the reference configuration.
  if (!slides) {
    kinematics_ = std::make_unique<FixedKinematics>(
        find_points(mesh_, kind, spec, reach, slave, *surfaces.master), components_);
    return;
  }
  // Large sliding meets a mesh or an exact surface; segments cut faces of the slave at those of the master,
  // other rules keep their points.
  const bool cut = spec.integration == IntegrationRule::segments;
  std::unique_ptr<Master> met;
  if (surfaces.master)
    met = std::make_unique<MeshMaster>(
        components_, *surfaces.master,
        MeshMasterOptions{
            .search_distance = reach, .smoothing = spec.smoothing, .rim = cut ? k_rim : k_fading_rim});
  else
    met = std::make_unique<AnalyticMaster>(components_, *spec.rigid_master, reach);
  // A rigid surface has no faces to cut at.
  if (cut && surfaces.master) {
    kinematics_ =
        std::make_unique<SegmentKinematics>(mesh_, kind, slave, *surfaces.master, std::move(met), reach);
    return;
  }
  const bool nodal = spec.integration == IntegrationRule::nodal;
  kinematics_ = std::make_unique<SlidingKinematics>(
      mesh_, kind, slave, std::move(met),
      SlidingOptions{.rule = nodal ? IntegrationRule::nodal : IntegrationRule::gauss,
                     .gauss_degree = spec.gauss_degree});
}

std::vector<double> ContactGeometry::no_displacement() const {
  return std::vector<double>(mesh_.x.size() * as_size(components_), 0.0);
}

std::vector<SurfaceCurvature> slave_curvatures(const ContactGeometry& geometry, AnalysisKind kind,
                                               const ContactSurface& slave) {
  const std::vector<SurfaceCurvature> of_face =
      surface_curvatures(slave, kind, MeshMasterOptions{}.feature_angle);
  if (std::ranges::all_of(of_face, [](const auto& c) { return c.first == 0 && c.second == 0; })) return {};
  std::vector<SurfaceCurvature> of_point(as_size(geometry.n_points()));
  for (Index p = 0; p < geometry.n_points(); ++p)
    of_point[as_size(p)] = of_face[as_size(geometry.kinematics().particle(p).number / k_points_of_a_face)];
  return of_point;
}

std::vector<SurfaceCurvature> master_curvatures(const mesh::Mesh& mesh, AnalysisKind kind,
                                                const PairSurfaces& surfaces) {
  if (!surfaces.master) return {};
  const std::vector<SurfaceCurvature> of_face =
      surface_curvatures(*surfaces.master, kind, MeshMasterOptions{}.feature_angle);
  // Plane surfaces need no table at all.
  if (std::ranges::all_of(of_face, [](const auto& c) { return c.first == 0 && c.second == 0; })) return {};
  std::vector<SurfaceCurvature> at_node(mesh.x.size());
  std::vector<double> faces(mesh.x.size(), 0.0);
  // At a node the mean of the curvatures of its faces.
  for (Index f = 0; f < surfaces.master->n_faces(); ++f)
    for (const Index node : surfaces.master->nodes(f)) {
      at_node[as_size(node)].first += of_face[as_size(f)].first;
      at_node[as_size(node)].second += of_face[as_size(f)].second;
      faces[as_size(node)] += 1;
    }
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (faces[i] > 0) at_node[i] = {at_node[i].first / faces[i], at_node[i].second / faces[i]};
  return at_node;
}

}  // namespace solidus::contact
