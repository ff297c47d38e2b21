/// Two blocks with curved, warped interfaces that overlap, for tests of large sliding.
#pragma once

#include <cmath>
#include <memory>

#include "bodies.hpp"
#include "contact/points/sliding_kinematics.hpp"
#include "contact/surfaces/master_mesh.hpp"

namespace solidus::test {

using contact::ContactPointState;
using contact::MeshMaster;
using contact::MeshMasterOptions;
using contact::Partner;
using contact::Point;
using contact::PointMotion;
using contact::SlidingKinematics;
using contact::SlidingOptions;
using contact::Tensor;
using Asked = contact::ContactKinematics::Asked;

inline constexpr mesh::Shape k_all_bodies[] = {mesh::Shape::quad4, mesh::Shape::quad8, mesh::Shape::tet4,
                                               mesh::Shape::tet10, mesh::Shape::hex8,  mesh::Shape::hex20};

inline AnalysisKind kind_of(const mesh::Mesh& mesh) {
  return mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
}

/// Blocks whose common interface is a wave in the reference configuration.
inline mesh::Mesh wavy_blocks(mesh::Shape shape, double amplitude = 0.01) {
  mesh::Mesh mesh = two_blocks(shape);
  const auto last = static_cast<std::size_t>(mesh.dimension - 1);
  for (Point& x : mesh.x) {
    const double y = mesh.dimension == 3 ? x[1] : 0;
    x[last] += amplitude * std::sin(9 * x[0] + 0.4) * (1 + 0.5 * std::cos(11 * y));
  }
  return mesh;
}

/// A displacement that bends both bodies and pushes the upper one into the lower, and along it.
inline std::vector<double> overlapping(const mesh::Mesh& mesh, double depth = 0.004, double shift = 0.017) {
  const auto dim = static_cast<std::size_t>(mesh.dimension);
  return nodal_field(mesh, mesh.dimension, [&](const Point& x, bool upper) {
    std::vector<double> u(dim);
    u[0] = 0.01 * std::sin(7 * x[0] + 3 * x[1]) + (upper ? shift : 0);
    if (dim == 3) u[1] = 0.008 * std::cos(6 * x[0] - 5 * x[1]) + (upper ? 0.4 * shift : 0);
    u[dim - 1] = 0.006 * std::sin(8 * x[0] - 4 * x[1] + (upper ? 0.3 : 0)) - (upper ? depth : 0);
    return u;
  });
}

/// Large sliding of "upper_bottom" on "lower_top".
struct Sliding {
  const mesh::Mesh& mesh;
  const MeshMaster* master = nullptr;
  std::unique_ptr<SlidingKinematics> kinematics;

  explicit Sliding(const mesh::Mesh& m, bool smoothing = false, SlidingOptions options = {},
                   AnalysisKind kind = AnalysisKind::solid)
      : mesh(m) {
    if (mesh.dimension == 2 && kind == AnalysisKind::solid) kind = AnalysisKind::plane_strain;
    auto owned = std::make_unique<MeshMaster>(
        mesh.dimension, contact::ContactSurface(mesh, "lower_top"),
        MeshMasterOptions{.search_distance = 0.1, .smoothing = smoothing, .feature_angle = 0.9});
    master = owned.get();
    kinematics = std::make_unique<SlidingKinematics>(
        mesh, kind, contact::ContactSurface(mesh, "upper_bottom"), std::move(owned), options);
  }
  SlidingKinematics* operator->() const { return kinematics.get(); }
};

}  // namespace solidus::test
