/// Measured points: reading, units, deviation.
#include "point/measured.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace solidus::point {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class MeasuredPoints : public ::testing::Test {
 protected:
  Measured read(const std::string& text) {
    std::ofstream(path_) << text;
    return read_measured(path_, {});
  }
  std::string error(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& e) {
      return e.what();
    }
    return {};
  }
  ~MeasuredPoints() override { fs::remove(path_); }

  const fs::path path_ = fs::temp_directory_path() / "solidus_measured.csv";
};

TEST_F(MeasuredPoints, AreShownInTheUnitsOfTheHistory) {
  const Measured m = read("# a remark\nstrain_xx[percent], stress_xx[kPa]\n1, 2e5\r\n\n2,3e5\n");
  ASSERT_EQ(m.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(m.rows[0][0], 0.01);
  EXPECT_DOUBLE_EQ(m.rows[1][1], 300);
  EXPECT_EQ(m.columns[1]->name, "stress_xx");
}

TEST_F(MeasuredPoints, AreRefusedWithFileAndLine) {
  EXPECT_THAT(error("strain_xx[1],stres_xx[MPa]\n"), HasSubstr("solidus_measured.csv:1"));
  EXPECT_THAT(error("strain_xx[1],stres_xx[MPa]\n"), HasSubstr("did you mean 'stress_xx'"));
  EXPECT_THAT(error("strain_xx,stress_xx[MPa]\n"), HasSubstr("has no unit"));
  EXPECT_THAT(error("strain_xx[1],stress_xx[s]\n"), HasSubstr("stress_xx"));
  EXPECT_THAT(error("strain_xx[1]\n1\n"), HasSubstr("one column"));
  EXPECT_THAT(error("strain_xx[1],stress_xx[MPa]\n1,2,3\n"), HasSubstr("csv:2: there are 3 cells"));
  EXPECT_THAT(error("strain_xx[1],stress_xx[MPa]\n1,two\n"), HasSubstr("'two' is no number"));
  EXPECT_THAT(error("strain_xx[1],stress_xx[MPa]\n1,inf\n"), HasSubstr("'inf' is no number"));
  EXPECT_THAT(error("strain_xx[1],stress_xx[MPa]\n"), HasSubstr("no rows"));
}

/// σ = 100 MPa per percent, from 0 to 2 %.
std::vector<MaterialPointRecord> line() {
  std::vector<MaterialPointRecord> history(3);
  for (std::size_t i = 0; i < 3; ++i) {
    history[i].time = static_cast<double>(i);
    history[i].strain[0] = 0.01 * static_cast<double>(i);
    history[i].stress[0] = 1e8 * static_cast<double>(i);
  }
  return history;
}

TEST_F(MeasuredPoints, DeviateByTheRootMeanSquareOverThePointsWithinTheHistory) {
  const Measured m = read("strain_xx[percent],stress_xx[MPa]\n0.5,53\n1.5,146\n9,1\n");
  const auto deviation = deviations(m, line());
  ASSERT_EQ(deviation.size(), 1u);
  EXPECT_EQ(deviation[0].points, 2);
  EXPECT_NEAR(deviation[0].rms, std::sqrt((9.0 + 16.0) / 2), 1e-9);
  EXPECT_NEAR(deviation[0].largest, 146, 1e-12);
}

TEST_F(MeasuredPoints, HaveNoDeviationFromAPathThatTurns) {
  std::vector<MaterialPointRecord> history = line();
  history[2].strain[0] = 0;
  EXPECT_TRUE(deviations(read("strain_xx[1],stress_xx[MPa]\n0,1\n"), history).empty());
  EXPECT_FALSE(deviations(read("time[min],stress_xx[MPa]\n0,1\n"), history).empty());
}

}  // namespace
}  // namespace solidus::point
