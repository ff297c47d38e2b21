/// The solver that a linear system gets where a case says `automatic`, by its kind, dimension and size. All
/// sizes at which the choice changes are here.
#pragma once

#include <optional>

#include "linear/coupled_solver.hpp"
#include "linear/linear_solver.hpp"
#include "numbers/types.hpp"

namespace solidus::linear {

struct SystemSize {
  int dimension;           ///< of the mesh
  GlobalIndex n_unknowns;  ///< of all processes
};

/// Of one field. From 6 000 unknowns on, or 15 000 in the plane, it is multigrid: in three dimensions that is
/// as fast from 2 000 on and eight times faster at 15 000 (docs/log/benchmarks.md), but where it has trouble
/// a factorisation of so few costs nothing either. PETSc's multigrid is slower, and serves in three
/// dimensions alone.
/// @param transient_heat  a step of heat, whose matrix is diagonally strong
/// @param of_blocks       multigrid would be ours, not PETSc's
inline SolverKind solver_of_field(SolverKind kind, const SystemSize& size, bool transient_heat,
                                  bool of_blocks) {
  constexpr GlobalIndex k_direct_limit_3d = 6000, k_direct_limit_2d = 15000, k_direct_limit_of_petsc = 50000;
  if (kind != SolverKind::automatic) return kind;
  if (transient_heat) return SolverKind::incomplete;
  const bool plane = size.dimension == 2;
  if (!of_blocks && plane) return SolverKind::direct;
  const GlobalIndex limit = !of_blocks ? k_direct_limit_of_petsc
                            : plane    ? k_direct_limit_2d
                                       : k_direct_limit_3d;
  return size.n_unknowns < limit ? SolverKind::direct : SolverKind::multigrid;
}

/// Whether a factorisation takes over where multigrid has not converged for one field.
inline bool factors_rescue_field(SolverKind kind, GlobalIndex n_unknowns) {
  constexpr GlobalIndex k_rescue_limit = 300000;
  return kind == SolverKind::automatic && n_unknowns < k_rescue_limit;
}

/// Whether displacement and pressure together are factorised; nothing where the number of multiplications
/// decides. In three dimensions factors of a thin wall cost little and those of a lump fill up: between the
/// limits they are the default where they take fewer operations than k_cheap_factors (decision 0047).
inline std::optional<bool> factorises_saddle(SolverKind kind, const SystemSize& size) {
  constexpr GlobalIndex k_direct_limit_2d = 60000, k_direct_limit_3d = 8000, k_direct_limit_of_walls = 80000;
  if (kind != SolverKind::automatic) return kind == SolverKind::direct;
  if (size.dimension == 2) return size.n_unknowns < k_direct_limit_2d;
  if (size.n_unknowns < k_direct_limit_3d) return true;
  if (size.n_unknowns >= k_direct_limit_of_walls) return false;
  return {};
}
inline constexpr double k_cheap_factors = 4e9;  ///< multiplications and additions: half a second

/// Unknowns of systems with a pressure up to which a factorisation takes over where iteration fails.
inline constexpr GlobalIndex k_saddle_rescue_limit = 200000;

/// Whether displacement and temperature together are factorised. With a pressure, of 5 300 unknowns of
/// tetrahedra that flow a step takes 0.68 s with factors and 0.08 s with GMRES.
inline bool factorises_coupled(CoupledSolverKind kind, const SystemSize& size, bool with_pressure) {
  constexpr GlobalIndex k_direct_limit_3d = 20000, k_direct_limit_with_pressure = 3000;
  if (kind != CoupledSolverKind::automatic) return kind == CoupledSolverKind::direct;
  return size.dimension == 2 ||
         size.n_unknowns < (with_pressure ? k_direct_limit_with_pressure : k_direct_limit_3d);
}

}  // namespace solidus::linear
