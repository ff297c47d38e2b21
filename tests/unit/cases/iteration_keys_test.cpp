/// [coupling.iteration]: its defaults, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/schemes/block_iterative_keys.hpp"
#include "setup/mechanics_input.hpp"
#include "small_case.hpp"

namespace solidus::cases {
namespace {

using ::testing::HasSubstr;

CaseSpec read(const std::string& coupling) {
  const CaseSpec spec = test::bar_case("[coupling]\n" + coupling);
  setup::check_case(spec);
  return spec;
}

std::string error(const std::string& coupling) {
  try {
    return test::refusal(test::bar_case("[coupling]\n" + coupling));
  } catch (const InputError& e) {
    return e.what();
  }
}

const coupling::IterationKeys& iteration(const CaseSpec& spec) {
  using Kind = coupling::SchemeKindOf<coupling::BlockIterativeScheme>;
  return dynamic_cast<const Kind&>(*spec.coupling.scheme).data.iteration;
}

const std::string k_scheme = "scheme = \"block_iterative\"\n", k_section = "[coupling.iteration]\n";

TEST(IterationKeys, DefaultsAreIsentropicPassesBySweepsOfGaussSeidel) {
  const CaseSpec spec = read(k_scheme);
  EXPECT_EQ(iteration(spec), coupling::IterationKeys{});
  EXPECT_EQ(setup::mechanics_options(spec).mapping, mechanics::Mapping::isentropic);
}

TEST(IterationKeys, PassesChooseTheMapping) {
  const CaseSpec spec =
      read(k_scheme + k_section + "passes = \"isothermal\"\nrelaxation = \"aitken\"\nfactor = 0.5\n");
  EXPECT_EQ(setup::mechanics_options(spec).mapping, mechanics::Mapping::isothermal);
  EXPECT_EQ(iteration(spec).factor, 0.5);
}

TEST(IterationKeys, OfAnotherSchemeAreRefused) {
  EXPECT_THAT(error(k_section + "sweep = \"jacobi\"\n"), HasSubstr("it needs scheme = block_iterative"));
}

TEST(IterationKeys, ThatMeanNothingTogetherAreRefused) {
  EXPECT_THAT(error(k_scheme + k_section + "factor = 0.5\n"), HasSubstr("means nothing without relaxation"));
  EXPECT_THAT(error(k_scheme + k_section + "relaxation = \"aitken\"\n"),
              HasSubstr("is for isothermal passes"));
}

}  // namespace
}  // namespace solidus::cases
