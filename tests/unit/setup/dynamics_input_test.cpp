/// [dynamics] and initial velocities, as a user writes them.
#include "setup/dynamics_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "setup/case_file.hpp"

namespace solidus::setup {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* k_bar = R"(title = "A bar"
[analysis]
kind = "plane_strain"
physics = "mechanics"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["100 mm", "5 mm"]
divisions = [20, 1]
[time]
end = "10 us"
step = "1 us"
[[body]]
name = "bar"
group = "block"
material = "steel"
initial_temperature = "20 degC"
)";

/// A case file of its own for each test.
class Dynamics : public ::testing::Test {
 protected:
  Dynamics()
      : file_(fs::temp_directory_path() /
              (std::string("solidus_dynamics_") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml")) {}
  ~Dynamics() override { fs::remove(file_); }
  cases::CaseSpec read(const std::string& more) {
    std::ofstream(file_) << k_bar << more;
    return load_case(file_, {}).spec;
  }
  std::string error(const std::string& more) {
    try {
      read(more);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no InputError";
  }
  fs::path file_;
};

TEST_F(Dynamics, IsOffWithoutItsSection) {
  EXPECT_FALSE(dynamics_options(read("")));
}

TEST_F(Dynamics, IsGeneralisedAlphaWithConsistentMassUnlessSaidOtherwise) {
  const auto options = dynamics_options(read("[dynamics]\n"));
  ASSERT_TRUE(options);
  EXPECT_EQ(options->mass, mechanics::MassKind::consistent);
  EXPECT_DOUBLE_EQ(options->motion.alpha_f, 0.8 / 1.8);
}

TEST_F(Dynamics, ReadsEveryMethodAndTheMass) {
  const auto newmark = dynamics_options(
      read("[dynamics]\nmethod = \"newmark\"\ngamma = 0.7\nbeta = 0.4\nmass = \"lumped\"\n"));
  EXPECT_DOUBLE_EQ(newmark->motion.gamma, 0.7);
  EXPECT_DOUBLE_EQ(newmark->motion.beta, 0.4);
  EXPECT_EQ(newmark->mass, mechanics::MassKind::lumped);
  EXPECT_DOUBLE_EQ(dynamics_options(read("[dynamics]\nmethod = \"newmark\"\n"))->motion.beta, 0.3025);
  EXPECT_DOUBLE_EQ(dynamics_options(read("[dynamics]\nmethod = \"trapezoidal\"\n"))->motion.beta, 0.25);
  EXPECT_DOUBLE_EQ(dynamics_options(read("[dynamics]\nmethod = \"backward_euler\"\n"))->motion.beta, 1);
}

TEST_F(Dynamics, GivesABodyItsVelocity) {
  const auto options = dynamics_options(read("initial_velocity = [\"-10 m/s\", \"0 m/s\"]\n[dynamics]\n"));
  ASSERT_EQ(options->initial_velocity.size(), 1u);
  EXPECT_DOUBLE_EQ(options->initial_velocity[0][0], -10);
}

TEST_F(Dynamics, RefusesWhatDoesNotFitTogether) {
  EXPECT_THAT(error("initial_velocity = [\"-10 m/s\", \"0 m/s\"]\n"),
              AllOf(HasSubstr("'bar' has an initial velocity, but no inertia"), HasSubstr("[dynamics]")));
  EXPECT_THAT(error("initial_velocity = [\"-10 m/s\"]\n[dynamics]\n"),
              AllOf(HasSubstr("has 1 components"), HasSubstr("2 in this analysis")));
  EXPECT_THAT(error("[dynamics]\nmethod = \"newmark\"\ngamma = 0.6\nbeta = 0.3\n"),
              AllOf(HasSubstr("not stable for every step"), HasSubstr("beta of 0.3025")));
  EXPECT_THAT(error("[dynamics]\nmethod = \"newmark\"\ngamma = 0.4\n"), HasSubstr("gamma"));
  EXPECT_THAT(error("[dynamics]\nmethod = \"trapezoidal\"\nbeta = 0.3\n"), HasSubstr("method = newmark"));
  EXPECT_THAT(error("[dynamics]\nmethod = \"generalised_alpha\"\nspectral_radius = 1.5\n"),
              HasSubstr("spectral_radius"));
}

}  // namespace
}  // namespace solidus::setup
