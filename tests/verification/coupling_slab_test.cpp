/// Weiner and Boley's slab (slab.hpp) by the coupled schemes. Structural heat changes little: the profiles of
/// the similarity solution must come out of every scheme.
///
/// The capacity of the solution is that of metal which shrinks as it cools, C_p, and so is that of the
/// material: C_p = C_v + 9α²kΘ, of which structural heat brings the second part, 4 to 6 % of it.
#include <gtest/gtest.h>

#include "coupling/block_iterative.hpp"
#include "coupling/double_pass.hpp"
#include "coupling/isentropic_split.hpp"
#include "coupling/isothermal_split.hpp"
#include "coupling/simultaneous.hpp"
#include "slab.hpp"

namespace solidus {
namespace {

using coupling::Phases;
using mechanics::Mapping;
using verification::SlabResult;
using verification::SlabRun;

/// Asserts half a megapascal, as where deformation does no heat.
SlabResult freeze(const std::string& name, Mapping mapping,
                  std::function<std::unique_ptr<coupling::CouplingScheme>(Phases)> scheme) {
  SlabRun run{verification::material_of(verification::steel()), 0.05, "coupling_slab_" + name};
  run.mapping = mapping;
  run.form = mechanics::StructuralForm::energy;
  run.scheme = std::move(scheme);
  const SlabResult result = verification::freeze(verification::disc(150), run);
  EXPECT_LT(result.rms[0], 0.5e6);
  EXPECT_LT(result.rms[1], 0.5e6);
  EXPECT_LE(result.cuts, mapping == Mapping::simultaneous ? 4 : 0) << "of 420 steps";
  // A tenth of an element. With that capacity at constant strain it is 0.1 mm behind.
  EXPECT_LT(std::abs(result.front_error), 0.02e-3);
  auto out = verification::table("coupling_slab_" + name,
                                 "stress_at_5_s[MPa],stress_at_21_s[MPa],front[mm],iterations");
  out << 1e-6 * result.rms[0] << "," << 1e-6 * result.rms[1] << "," << 1e3 * result.front_error << ","
      << result.iterations << "\n";
  return result;
}

TEST(CoupledWeinerBoley, IsothermalSplit) {
  freeze("isothermal", Mapping::isothermal,
         [](Phases phases) { return std::make_unique<coupling::IsothermalSplit>(std::move(phases)); });
}

// The wall is the coldest place and nothing is done from outside: 𝓛 falls.
TEST(CoupledWeinerBoley, IsentropicSplit) {
  const SlabResult result = freeze("isentropic", Mapping::isentropic, [](Phases phases) {
    return std::make_unique<coupling::IsentropicSplit>(std::move(phases));
  });
  EXPECT_LE(result.rise, 0);
}

TEST(CoupledWeinerBoley, DoublePass) {
  freeze("double_pass", Mapping::isentropic,
         [](Phases phases) { return std::make_unique<coupling::DoublePass>(std::move(phases)); });
}

TEST(CoupledWeinerBoley, BlockIterative) {
  freeze("block_iterative", Mapping::isentropic, [](Phases phases) {
    return std::make_unique<coupling::BlockIterative>(std::move(phases), coupling::IterationOptions{});
  });
}

/// Metal that shrinks by 4 % as it freezes: what is laid down is free of stress in the size that it then has,
/// so that the solution stays. Half as many elements, steps twice as long.
void freeze_and_shrink(const std::string& name, Mapping mapping,
                       std::function<std::unique_ptr<coupling::CouplingScheme>(Phases)> scheme) {
  material::Material metal = verification::material_of(verification::steel());
  metal.phase_changes.front().volume_change = -0.04;
  SlabRun run{metal, 0.1, ""};
  run.mapping = mapping;
  run.form = mechanics::StructuralForm::energy;
  run.scheme = std::move(scheme);
  const SlabResult result = verification::freeze(verification::disc(75), run);
  ::testing::Test::RecordProperty(name, std::to_string(1e-6 * result.rms[0]) + " " +
                                            std::to_string(1e-6 * result.rms[1]) + " MPa, front " +
                                            std::to_string(1e3 * result.front_error) + " mm, cuts " +
                                            std::to_string(result.cuts));
  EXPECT_LT(result.rms[0], 1e6);
  EXPECT_LT(result.rms[1], 0.5e6);
  EXPECT_LT(std::abs(result.front_error), 0.04e-3);
}

TEST(CoupledWeinerBoley, KeepsItsStressesWhenTheMetalShrinks) {
  freeze_and_shrink("isentropic", Mapping::isentropic, [](Phases phases) {
    return std::make_unique<coupling::IsentropicSplit>(std::move(phases));
  });
  freeze_and_shrink("block_iterative", Mapping::isentropic, [](Phases phases) {
    return std::make_unique<coupling::BlockIterative>(std::move(phases), coupling::IterationOptions{});
  });
  freeze_and_shrink("simultaneous", Mapping::simultaneous, [](Phases phases) {
    return std::make_unique<coupling::SimultaneousScheme>(std::move(phases));
  });
}

TEST(CoupledWeinerBoley, Simultaneous) {
  freeze("simultaneous", Mapping::simultaneous,
         [](Phases phases) { return std::make_unique<coupling::SimultaneousScheme>(std::move(phases)); });
}

}  // namespace
}  // namespace solidus
