// Whatever becomes of the process in which HDF5 reads is an error of the file.
#include "results/formats/hdf5_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "../../sanitized.hpp"
#include "results/formats/hdf5_file.hpp"
#include "results/output/output_error.hpp"
#include "sample.hpp"

namespace {

using namespace solidus::results;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Hdf5ReaderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::vector<double> values{1, 2, 3, 4, 5, 6};
    const std::vector<std::int64_t> numbers{7, 8, 9};
    Hdf5File file(path_, Hdf5File::Mode::create);
    file.create_table<double>("values", 3, 2);
    file.write_rows<double>("values", 0, values);
    file.create_table<std::int64_t>("numbers", 3, 1);
    file.write_rows<std::int64_t>("numbers", 0, numbers);
    file.write_text("title", "as it was");
    file.close();
  }
  static std::string said_of(const std::function<void()>& work) {
    try {
      work();
    } catch (const OutputError& error) {
      return error.what();
    }
    return "nothing";
  }

  solidus::test::TemporaryFolder folder_;
  fs::path path_ = folder_.path / "state.h5";
};

TEST_F(Hdf5ReaderTest, ReadsWhatTheFileHolds) {
  Hdf5Reader file(path_);
  EXPECT_EQ(file.rows("values"), 3);
  EXPECT_EQ(file.width("values"), 2);
  std::vector<double> values(4);
  file.read_rows<double>("values", 1, values);
  EXPECT_THAT(values, ElementsAre(3, 4, 5, 6));
  std::vector<std::int64_t> numbers(3);
  file.read_rows<std::int64_t>("numbers", 0, numbers);
  EXPECT_THAT(numbers, ElementsAre(7, 8, 9));
  EXPECT_EQ(file.read_text("title"), "as it was");
}

TEST_F(Hdf5ReaderTest, ErrorsAreThoseOfTheFileAndLeaveItOpen) {
  Hdf5Reader file(path_);
  std::vector<double> values(6);
  EXPECT_THAT(said_of([&] { file.read_text("author"); }),
              AllOf(HasSubstr("state.h5"), HasSubstr("holds no 'author'")));
  EXPECT_THAT(said_of([&] { file.read_rows<double>("numbers", 0, values); }),
              HasSubstr("holds other numbers in 'numbers'"));
  EXPECT_THAT(said_of([&] { file.read_rows<double>("values", 2, values); }),
              HasSubstr("cannot read 'values'"));
  EXPECT_EQ(file.rows("values"), 3);
  EXPECT_THAT(said_of([&] { Hdf5Reader(folder_.path / "none.h5"); }), HasSubstr("is not a whole HDF5 file"));
}

TEST_F(Hdf5ReaderTest, ACrashIsAnErrorOfTheFile) {
  Hdf5Reader file(path_);
  ::kill(file.process(), SIGSEGV);
  const std::string crash = said_of([&] { file.rows("values"); });
  EXPECT_THAT(crash, AllOf(HasSubstr("state.h5"), HasSubstr("HDF5 crashed (signal 11"),
                           HasSubstr("while reading 'values'")));
  EXPECT_THAT(said_of([&] { file.rows("values"); }), HasSubstr("has ended"));
}

TEST_F(Hdf5ReaderTest, AnAnswerThatDoesNotComeIsAnErrorOfTheFile) {
  Hdf5Reader file(path_, 0.5);
  ::kill(file.process(), SIGSTOP);
  EXPECT_THAT(said_of([&] { file.rows("values"); }),
              AllOf(HasSubstr("state.h5"), HasSubstr("came to no end"), HasSubstr("while reading 'values'")));
  EXPECT_LT(file.process(), 0) << "it is ended";
}

#ifndef SOLIDUS_ADDRESS_SANITIZER  // with which no memory is limited
TEST_F(Hdf5ReaderTest, MemoryOfTheProcessIsLimited) {
  Hdf5Reader file(path_);
  rlimit limit{};
  ASSERT_EQ(::prlimit(file.process(), RLIMIT_DATA, nullptr, &limit), 0);
  EXPECT_LT(limit.rlim_max, rlim_t{1} << 40);
}
#endif

// Its rights, which the test of the sandbox tries one by one (ReaderSandbox).
TEST_F(Hdf5ReaderTest, TheProcessIsRestrictedBeforeItAnswers) {
  const Hdf5Reader file(path_);
  std::ifstream status("/proc/" + std::to_string(file.process()) + "/status");
  std::string filter, line;
  while (std::getline(status, line))
    if (line.starts_with("Seccomp:")) filter = line;
  if (filter.empty()) GTEST_SKIP() << "the kernel has no filters of system calls";
  EXPECT_EQ(filter, "Seccomp:\t2");
}

TEST_F(Hdf5ReaderTest, TheProcessEndsWithTheReader) {
  pid_t reads = -1;
  {
    const Hdf5Reader file(path_);
    reads = file.process();
    ASSERT_EQ(::kill(reads, 0), 0);
  }
  EXPECT_NE(::kill(reads, 0), 0);
}

}  // namespace
