#include "mechanics/saddle_preconditioner.hpp"

#include <petscksp.h>

#include <vector>

#include "algebra/petsc_vectors.hpp"

namespace solidus::mechanics {

using algebra::check;

namespace {
/// Block rows of the coarsest level. In a mush, where one element melts and the next one is solid, cycles
/// over coarser levels are no match for a factorisation: 870 linear iterations of a step of the fine
/// crankshaft become 280.
constexpr GlobalIndex k_coarsest = 500;
}  // namespace

struct SaddlePreconditioner::Petsc {
  algebra::KspHandle of_schur;
  algebra::VecHandle r_p, z_p;
  std::vector<double> right;

  void create(Mat schur);
};

void SaddlePreconditioner::Petsc::create(Mat schur) {
  check(KSPCreate(PETSC_COMM_WORLD, of_schur.out()), "KSPCreate");
  check(KSPSetOptionsPrefix(of_schur, "mechanics_mixed_p_"), "KSPSetOptionsPrefix");
  check(KSPSetType(of_schur, KSPPREONLY), "KSPSetType");
  PC pc = nullptr;
  check(KSPGetPC(of_schur, &pc), "KSPGetPC");
  check(PCSetType(pc, PCBJACOBI), "PCSetType");  // within a block incomplete LU
  check(KSPSetFromOptions(of_schur), "KSPSetFromOptions");
  check(MatCreateVecs(schur, z_p.out(), r_p.out()), "MatCreateVecs");
}

bool SaddlePreconditioner::serves(const algebra::BlockMatrix& displacement) {
  const int components = displacement.block_size();
  return displacement.ties().empty() &&
         algebra::Multigrid::supports(components, algebra::rigid_body_mode_count(components));
}

SaddlePreconditioner::SaddlePreconditioner(const mesh::Mesh& mesh, int components, bool symmetric)
    : multigrid_(mesh, components, algebra::rigid_body_modes, symmetric, k_coarsest),
      petsc_(std::make_unique<Petsc>()) {}

SaddlePreconditioner::~SaddlePreconditioner() = default;

void SaddlePreconditioner::set_up(algebra::BlockMatrix& a) {
  multigrid_.set_up(a);
}

void SaddlePreconditioner::set_schur(Mat schur) {
  if (!petsc_->of_schur) petsc_->create(schur);
  check(KSPSetOperators(petsc_->of_schur, schur, schur), "KSPSetOperators");
  check(KSPSetUp(petsc_->of_schur), "KSPSetUp");
}

void SaddlePreconditioner::apply(SaddleOperator& of, std::span<const double> r, std::span<double> z) {
  Petsc& my = *petsc_;
  PetscInt n_p = 0;
  check(VecGetLocalSize(my.z_p, &n_p), "VecGetLocalSize");
  const std::size_t n_u = r.size() - static_cast<std::size_t>(n_p);
  algebra::put(r.subspan(n_u), my.r_p);
  check(KSPSolve(my.of_schur, my.r_p, my.z_p), "KSPSolve");
  algebra::get(my.z_p, z.subspan(n_u));
  my.right.resize(n_u);
  of.multiply_pressure(z.subspan(n_u), my.right);
  for (std::size_t i = 0; i < n_u; ++i) my.right[i] = r[i] - my.right[i];
  multigrid_.apply(my.right, z.first(n_u));
}

}  // namespace solidus::mechanics
