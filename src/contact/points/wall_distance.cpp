/// The nearest face of the master is sought twice, as drawn and as it lies now; the difference of the
/// distances is how far the point has opened.
#include "contact/points/wall_distance.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

std::vector<Face> current_faces(const ContactSurface& surface, std::span<const double> displacement,
                                int components) {
  std::vector<Face> faces;
  for (Index f = 0; f < surface.n_faces(); ++f)
    faces.push_back(surface.current_face(f, displacement, components));
  return faces;
}

}  // namespace

WallDistance::WallDistance(const ContactSurface& master, std::span<const double> displacement, int components)
    : displacement_(displacement),
      components_(as_size(components)),
      reference_(reference_faces(master)),
      current_(current_faces(master, displacement, components)) {}

double WallDistance::in_front(const FaceSearch& wall, const Point& x, double reach) {
  const SurfacePoint nearest = wall.closest(x, reach);
  if (nearest.face < 0) return reach;
  const Point normal = wall.face(nearest.face).normal(nearest.projection.xi);
  return dot(normal, subtract(x, nearest.projection.y)) > 0 ? nearest.projection.distance : 0.0;
}

double WallDistance::opened(const ContactKinematics::Particle& particle, double reach) const {
  Point x = particle.position;
  for (std::size_t b = 0; b < particle.nodes.size(); ++b)
    for (std::size_t i = 0; i < components_; ++i)
      x[i] += particle.share[b] * displacement_[as_size(particle.nodes[b]) * components_ + i];
  const double before = in_front(reference_, particle.position, reach), now = in_front(current_, x, reach);
  return std::max(now - before, 0.0);
}

}  // namespace solidus::contact
