/// A small casting, the fixture that checks changes of it, and what is to be said of them.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "run/session.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::check::test {

inline constexpr const char* k_casting = R"(title = "An aluminium block on a steel mould"
[analysis]
kind = "plane_strain"
physics = "heat"
gravity = "9.81 m/s2"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "20 mm"]
lower_divisions = [8, 4]
upper = ["40 mm", "20 mm"]
upper_divisions = [8, 4]
[time]
end = "10 min"
step = "1 s"
[[body]]
name = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "200 degC"
[[thermal_condition]]
name = "air"
group = "lower_y_min"
kind = "film"
coefficient = "20 W/m2/K"
ambient = "20 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
contact_law = "power"
conductance = "2000 W/m2/K"
exponent = 0
gap_law = "constant"
)";

/// `text` with the first `what` replaced; a test that changes nothing would prove nothing.
inline std::string changed(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

/// The same blocks with mechanics, of triangles that open pores: the upper one shrinks on the lower one.
inline std::string deforming() {
  return changed(changed(k_casting, "quad4", "tri3"), "physics = \"heat\"",
                 "physics = \"thermomechanical\"") +
         R"(
[[mechanical_condition]]
name = "table"
group = "lower_y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
)";
}

class FindingsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    logging::set_level(logging::Level::silent);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    logging::set_level(logging::Level::info);
    std::filesystem::remove_all(folder_);
  }
  /// Result of `check` for a case: its warnings, or the message of its error.
  std::vector<std::string> said_of(const std::string& text) const {
    std::ofstream(folder_ / "case.toml") << text;
    logging::clear_warnings();
    try {
      run::check_run(setup::load_case(folder_ / "case.toml"));
    } catch (const InputError& error) {
      return {std::string("error: ") + error.what()};
    }
    return logging::warnings();
  }
  std::filesystem::path folder_ = std::filesystem::path(SOLIDUS_BINARY_DIR) / "findings";
};

/// One change of the casting, and a part of what is to be said of it.
struct Slip {
  std::string what, with, said;
};

}  // namespace solidus::check::test
