/// Stresses at nodes: a linear field is reproduced to round-off up to the boundary, on any shape; the hoop
/// stress at the bore of a thick tube is one.
#include "results/fields/recovered_stress.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "results/fields/heat_flux.hpp"
#include "system/processes.hpp"

namespace solidus::results {
namespace {

using mesh::Point;
using mesh::Shape;

mesh::Mesh block(Shape shape, std::vector<int> divisions, std::vector<double> size,
                 std::vector<double> origin = {}) {
  const int rank = processes::rank();
  mesh::RawMesh raw;
  if (rank == 0) raw = mesh::make_block({std::move(size), std::move(origin), std::move(divisions)}, shape);
  return mesh::distribute(raw, {"block"}, {});
}

int corner_count(Shape shape) {
  switch (shape) {
    case Shape::tri3:
    case Shape::tri6:
      return 3;
    case Shape::hex8:
    case Shape::hex20:
      return 8;
    default:
      return 4;
  }
}

double linear(const Point& x, std::size_t k) {
  return 1 + static_cast<double>(k) + 2 * x[0] - (3 + static_cast<double>(k)) * x[1] + 5 * x[2];
}

/// The function at the centroids, which for these shapes are the means of the corners.
template <class F>
std::vector<double> at_cells(const mesh::Mesh& mesh, F f) {
  std::vector<double> values;
  for (const mesh::ElementBlock& b : mesh.blocks)
    for (Index e = 0; e < b.size(); ++e) {
      const int corners = corner_count(b.shape);
      Point centre{};
      for (int a = 0; a < corners; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          centre[i] += mesh.x[static_cast<std::size_t>(b.element(e)[a])][i] / corners;
      for (std::size_t k = 0; k < 6; ++k) values.push_back(f(centre, k));
    }
  return values;
}

TEST(StressRecovery, ReproducesALinearStressAtEveryNode) {
  for (const Shape shape :
       {Shape::tri3, Shape::quad4, Shape::quad8, Shape::tet4, Shape::hex8, Shape::hex20}) {
    const bool solid = mesh::dimension(shape) == 3;
    const mesh::Mesh mesh = solid ? block(shape, {4, 3, 3}, {2, 1, 0.5}) : block(shape, {4, 3}, {2, 1});
    const StressRecovery recovery(mesh, solid ? AnalysisKind::solid : AnalysisKind::plane_strain);
    const std::vector<double> nodal = recovery.at_nodes(at_cells(mesh, linear));
    double worst = 0;
    for (std::size_t i = 0; i < mesh.x.size(); ++i)
      for (std::size_t k = 0; k < 6; ++k)
        worst = std::max(worst, std::abs(nodal[6 * i + k] - linear(mesh.x[i], k)));
    EXPECT_LT(worst, 1e-11) << static_cast<int>(shape);
  }
}

// One row of elements knows nothing of a second direction, and says nothing of it.
TEST(StressRecovery, OfOneRowOfElementsGoesAlongTheRow) {
  const mesh::Mesh mesh = block(Shape::quad4, {6, 1}, {1, 0.1});
  const StressRecovery recovery(mesh, AnalysisKind::plane_strain);
  const auto along = [](const Point& x, std::size_t) { return 1 + 7 * x[0]; };
  const std::vector<double> nodal = recovery.at_nodes(at_cells(mesh, along));
  for (std::size_t i = 0; i < mesh.x.size(); ++i) EXPECT_NEAR(nodal[6 * i], along(mesh.x[i], 0), 1e-12);
}

// Lamé: σ_θ = A + B/r². The mean of the innermost of ten elements is 10 % below the value at the bore.
TEST(StressRecovery, FindsTheHoopStressAtTheBoreOfATube) {
  const mesh::Mesh mesh = block(Shape::quad4, {10, 1}, {1, 0.1}, {1, 0});
  const auto hoop = [](const Point& x, std::size_t) { return 1 + 4 / (x[0] * x[0]); };
  const std::vector<double> cells = at_cells(mesh, hoop),
                            nodal = StressRecovery(mesh, AnalysisKind::axisymmetric).at_nodes(cells);
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    if (mesh.x[i][0] == 1) {
      EXPECT_NEAR(nodal[6 * i], 5, 0.07);
    }
}

// A hoop stress jumps where two metals meet.
TEST(StressRecovery, AtANodeOfTwoBodiesIsThatOfTheOneAskedForOrTheirMean) {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  mesh::RawMesh raw;
  if (rank == 0) {
    raw = mesh::make_block({{2, 1}, {}, {8, 3}}, Shape::quad4);
    const mesh::RawBlock all = raw.groups.at("block").blocks.at(0);
    for (const std::string body : {"left", "right"}) {
      mesh::RawBlock part{all.shape, {}, {}};
      for (std::size_t e = 0; e < all.input_element.size(); ++e) {
        const auto nodes = std::span(all.nodes).subspan(4 * e, 4);
        const bool left = std::ranges::all_of(
            nodes, [&](Index node) { return raw.x[static_cast<std::size_t>(node)][0] <= 1; });
        if (left != (body == "left")) continue;
        part.nodes.insert(part.nodes.end(), nodes.begin(), nodes.end());
        part.input_element.push_back(all.input_element[e]);
      }
      raw.groups[body] = {2, {part}};
    }
    raw.groups.erase("block");
  }
  const mesh::Mesh mesh = mesh::distribute(raw, {"left", "right"}, {});
  const auto jumps = [](const Point& x, std::size_t) { return x[0] < 1 ? 5 + x[0] : -3 - 2 * x[0]; };
  const std::vector<double> cells = at_cells(mesh, jumps);
  const StressRecovery recovery(mesh, AnalysisKind::plane_strain);
  const std::vector<double> both = recovery.at_nodes(cells), left = recovery.at_nodes(cells, 0),
                            right = recovery.at_nodes(cells, 1);
  int between = 0;
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    if (mesh.x[i][0] != 1) continue;
    ++between;
    EXPECT_NEAR(left[6 * i], 6, 1e-11);
    EXPECT_NEAR(right[6 * i], -5, 1e-11);
    EXPECT_NEAR(both[6 * i], 0.5, 1e-11);
  }
  EXPECT_GT(parallel::global_sum(static_cast<double>(between)), 3.5);
}

TEST(StressRecovery, PrincipalValuesAndVonMisesOfATensor) {
  // 3 and 1 in a plane turned by 45 degrees, 5 across it
  const std::vector<double> tensor{2, 2, 5, 1, 0, 0};
  EXPECT_NEAR(principal_values(tensor, 0)[0], 5, 1e-14);
  EXPECT_NEAR(principal_values(tensor, 1)[0], 3, 1e-14);
  EXPECT_NEAR(principal_values(tensor, 2)[0], 1, 1e-14);
  EXPECT_NEAR(von_mises_values(tensor)[0], std::sqrt(12.), 1e-14);
}

TEST(HeatFlux, IsThatOfFouriersLawWithTheConductivityOfThePlace) {
  const mesh::Mesh mesh = block(Shape::hex8, {3, 2, 2}, {1, 1, 1});
  material::Material m;
  m.conductivity = Table({200, 400}, {10, 30});
  std::vector<double> temperature;
  for (const Point& x : mesh.x) temperature.push_back(300 + 60 * x[0] - 30 * x[2]);
  const std::vector<double> flux = element_heat_flux(
      mesh, AnalysisKind::solid, [&](int) -> const material::Material& { return m; }, temperature);
  const std::vector<double> centre =
      at_cells(mesh, [](const Point& x, std::size_t) { return x[0] - 0.5 * x[2]; });
  for (std::size_t c = 0; c < flux.size() / 3; ++c) {
    const double k = 20 + 6 * centre[6 * c];
    EXPECT_NEAR(flux[3 * c], -60 * k, 1e-9);
    EXPECT_NEAR(flux[3 * c + 1], 0, 1e-9);
    EXPECT_NEAR(flux[3 * c + 2], 30 * k, 1e-9);
  }
}

TEST(ConductionDissipation, IsConductivityTimesTheSquareOfTheGradientOverTheTemperature) {
  const mesh::Mesh mesh = block(Shape::quad4, {200, 1}, {1, 0.1});
  material::Material m;
  m.conductivity = 25.0;
  std::vector<double> temperature;
  for (const Point& x : mesh.x) temperature.push_back(300 + 300 * x[0]);
  const std::vector<double> dissipation = element_conduction_dissipation(
      mesh, AnalysisKind::plane_strain, [&](int) -> const material::Material& { return m; }, temperature);
  const std::vector<double> centre = at_cells(mesh, [](const Point& x, std::size_t) { return x[0]; });
  for (std::size_t c = 0; c < dissipation.size(); ++c) {
    const double exact = 25 * 300 * 300 / (300 + 300 * centre[6 * c]);
    EXPECT_NEAR(dissipation[c], exact, 1e-5 * exact);
  }
}

}  // namespace
}  // namespace solidus::results
