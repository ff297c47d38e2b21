/// The folder for temporary files, where the one that the environment names cannot be written.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "system/temporary_folder.hpp"

namespace solidus {
namespace {

/// TMPDIR as a test wants it, until the test ends.
class TemporaryFolder : public testing::Test {
 protected:
  void SetUp() override {
    if (const char* value = std::getenv("TMPDIR")) before_ = value;
  }
  void TearDown() override {
    if (before_.empty())
      unsetenv("TMPDIR");
    else
      setenv("TMPDIR", before_.c_str(), 1);
  }

 private:
  std::string before_;
};

TEST_F(TemporaryFolder, IsWhatTheEnvironmentNamesWhereThatCanBeWritten) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "temporary_folder_test";
  std::filesystem::create_directories(folder);
  setenv("TMPDIR", folder.c_str(), 1);
  EXPECT_EQ(temporary_folder(), folder.string());
  EXPECT_EQ(writable_temporary_folder(), folder.string());
  std::filesystem::remove_all(folder);
}

TEST_F(TemporaryFolder, IsAnotherWhereThatCannotBeWritten) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "temporary_folder_test_file";
  std::ofstream(file) << "no folder";
  setenv("TMPDIR", (file / "below").c_str(), 1);
  EXPECT_EQ(temporary_folder(), (file / "below").string());
  EXPECT_TRUE(std::filesystem::is_directory(writable_temporary_folder())) << writable_temporary_folder();
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace solidus
