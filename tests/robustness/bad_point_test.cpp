/// Broken point files given to the real program: exit code 1 and one message with the place, nothing written;
/// a path that cannot go on: exit code 2 and the curve as far as it came.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class PointProgram : public ::testing::Test {
 protected:
  PointProgram() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~PointProgram() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  /// Exit code; what it says on stderr is kept.
  int run(const std::string& arguments) {
    const std::string command = "cd '" + folder_.string() +
                                "' && SOLIDUS_MATERIALS='" SOLIDUS_SOURCE_DIR
                                "/materials' '" SOLIDUS_BINARY_DIR "/solidus' point " +
                                arguments + " 2>&1 >/dev/null";
    errors_.clear();
    std::FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return -1;
    std::array<char, 512> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe)) errors_ += buffer.data();
    const int status = pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  const fs::path folder_ = fs::temp_directory_path() / "solidus_bad_point";
  std::string errors_;
};

const std::string k_good = R"(material = "low_carbon_steel"
[[segment]]
strain = 0.01
strain_rate = "1e-3 1/s"
)";

TEST_F(PointProgram, WritesATableAndItsSummary) {
  write("good.toml", k_good);
  EXPECT_EQ(run("good.toml -o out"), 0) << errors_;
  for (const char* name : {"history.csv", "point.toml", "summary.json"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  EXPECT_EQ(run("good.toml -o out --set temperature='500 degC'"), 0) << errors_;  // again, over its own
  EXPECT_EQ(run("out/point.toml -o again"), 0) << errors_;                        // the echo is a point file
}

TEST_F(PointProgram, SaysWhereABrokenFileIsWrongAndWritesNothing) {
  write("typo.toml", k_good + "stepps = 10\n");
  EXPECT_EQ(run("typo.toml"), 1);
  EXPECT_THAT(errors_, HasSubstr("solidus: typo.toml:5:1: unknown key 'stepps'"));
  write("zero.toml", k_good + "[[segment]]\nstrain = 0.01\nstrain_rate = \"1 1/s\"\n");
  EXPECT_EQ(run("zero.toml"), 1);
  EXPECT_THAT(errors_, HasSubstr("zero.toml:5:1: the segment takes no time"));
  EXPECT_EQ(run("nowhere.toml"), 1);
  EXPECT_THAT(errors_, HasSubstr("nowhere.toml"));
  write("empty.toml", "");
  EXPECT_EQ(run("empty.toml"), 1);
  write("good.toml", k_good);
  EXPECT_EQ(run("good.toml --set segment.2.strain=1"), 1);
  EXPECT_FALSE(fs::exists(folder_ / "results"));
}

TEST_F(PointProgram, DoesNotWriteIntoTheFolderOfSomethingElse) {
  write("good.toml", k_good);
  fs::create_directories(folder_ / "out");
  std::ofstream(folder_ / "out/summary.json") << "{}";
  EXPECT_EQ(run("good.toml -o out"), 1);
  EXPECT_THAT(errors_, HasSubstr("choose another folder with -o"));
  EXPECT_EQ(run("good.toml -o /proc/none"), 1);
}

TEST_F(PointProgram, EndsWithCodeTwoAndTheCurveSoFarWhereAStressCannotBeCarried) {
  write(
      "soft.toml",
      "like = \"low_carbon_steel\"\n[plasticity]\nisotropic_hardening = \"none\"\nflow_stress = \"100 MPa\"\n"
      "rate_dependence = \"none\"\n");
  write("pull.toml",
        "material = \"soft.toml\"\n[[segment]]\nstress = \"200 MPa\"\nduration = \"1 s\"\nsteps = 20\n");
  EXPECT_EQ(run("pull.toml -o out"), 2);
  EXPECT_THAT(errors_, HasSubstr("pull.toml:2:1: segment 1 stopped at 0.5 s"));
  EXPECT_THAT(errors_, HasSubstr("prescribe the strain instead"));
  std::ifstream table(folder_ / "out/history.csv");
  std::string line;
  int rows = -1;
  while (std::getline(table, line)) ++rows;
  EXPECT_GE(rows, 11);
}

}  // namespace
