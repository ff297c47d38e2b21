/// [coupling.iteration]: its defaults, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/case_file.hpp"
#include "model/case_keys.hpp"
#include "model/mechanics_input.hpp"

namespace solidus::model {
namespace {

using ::testing::HasSubstr;

CaseSpec read(const std::string& coupling) {
  const CaseSpec spec = case_keys().read(parse_document(R"(title = "A block"
[analysis]
kind = "plane_strain"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["1 m", "1 m"]
divisions = [1, 1]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "block"
material = "steel"
initial_temperature = "20 degC"
[coupling]
)" + coupling,
                                                        "case.toml"));
  check_case(spec);
  return spec;
}

std::string error(const std::string& coupling) {
  try {
    read(coupling);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no InputError";
}

const std::string k_scheme = "scheme = \"block_iterative\"\n", k_section = "[coupling.iteration]\n";

TEST(IterationKeys, DefaultsAreIsentropicPassesBySweepsOfGaussSeidel) {
  const CaseSpec spec = read(k_scheme);
  EXPECT_EQ(spec.coupling.iteration, IterationSpec{});
  EXPECT_EQ(mechanics_options(spec).mapping, mechanics::Mapping::isentropic);
}

TEST(IterationKeys, PassesChooseTheMapping) {
  const CaseSpec spec =
      read(k_scheme + k_section + "passes = \"isothermal\"\nrelaxation = \"aitken\"\nfactor = 0.5\n");
  EXPECT_EQ(mechanics_options(spec).mapping, mechanics::Mapping::isothermal);
  EXPECT_EQ(spec.coupling.iteration.factor, 0.5);
}

TEST(IterationKeys, OfAnotherSchemeAreRefused) {
  EXPECT_THAT(error(k_section + "sweep = \"jacobi\"\n"), HasSubstr("is of the block-iterative scheme"));
}

TEST(IterationKeys, ThatMeanNothingTogetherAreRefused) {
  EXPECT_THAT(error(k_scheme + k_section + "factor = 0.5\n"), HasSubstr("means nothing without relaxation"));
  EXPECT_THAT(error(k_scheme + k_section + "relaxation = \"aitken\"\n"),
              HasSubstr("is for isothermal passes"));
}

}  // namespace
}  // namespace solidus::model
