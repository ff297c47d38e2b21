// A checkpoint knows that it is whole, and a folder that a run is in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <petscsys.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "results/checkpoint/checkpoint_tables.hpp"
#include "results/formats/file_checksum.hpp"
#include "results/formats/hdf5_file.hpp"
#include "results/output/output_error.hpp"
#include "results/output/run_lock.hpp"
#include "sample.hpp"
#include "system/processes.hpp"

namespace {

using namespace solidus;
using namespace solidus::results;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

int this_process() {
  return processes::rank();
}

class CheckpointFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = shared_.path / std::to_string(this_process());
    fs::create_directories(folder_);
    file_ = folder_ / "state.h5";
  }
  static std::string text(const fs::path& path) {
    std::ostringstream all;
    all << std::ifstream(path, std::ios::binary).rdbuf();
    return all.str();
  }
  static void write(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
  }
  void make(const fs::path& path) const {
    Hdf5File file(path, Hdf5File::Mode::create);
    file.write_text("format", "a test");
    file.create_table<double>("temperature", 3, 2);
    file.write_rows<double>("temperature", 0, std::vector<double>{1, 2, 3, 4, 5, 6});
    file.create_table<std::int64_t>("node", 3, 1);
    file.write_rows<std::int64_t>("node", 0, std::vector<std::int64_t>{7, 8, 9});
    file.close();
    write_checksum(path);
  }
  static std::string complaint(const std::function<void()>& work) {
    try {
      work();
    } catch (const OutputError& error) {
      return error.what();
    }
    return "nothing";
  }

  test::SharedFolder shared_;
  fs::path folder_, file_;  ///< of this process
};

TEST_F(CheckpointFile, IsReadBackAndAcceptedWhole) {
  make(file_);
  EXPECT_NO_THROW(check_checksum(file_));
  const Hdf5File file(file_, Hdf5File::Mode::read);
  EXPECT_EQ(file.read_text("format"), "a test");
  std::vector<double> values(6);
  file.read_rows<double>("temperature", 0, values);
  EXPECT_EQ(values.back(), 6);
}

TEST_F(CheckpointFile, NoFlippedBitNoCutAndNoTailIsAccepted) {
  make(file_);
  const std::string good = text(file_);
  int accepted = 0;
  for (std::size_t at = 0; at < good.size(); at += at < k_user_block ? 1 : 3) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ (1 << (at % 8)));
    write(file_, bad);
    if (complaint([&] { check_checksum(file_); }) == "nothing") ++accepted;
  }
  EXPECT_EQ(accepted, 0) << "of " << good.size();
  for (const std::size_t length : {std::size_t{0}, std::size_t{100}, good.size() / 2, good.size() - 1}) {
    write(file_, good.substr(0, length));
    EXPECT_NE(complaint([&] { check_checksum(file_); }), "nothing") << length;
  }
  write(file_, good + "x");
  EXPECT_THAT(complaint([&] { check_checksum(file_); }), HasSubstr("damaged"));
}

// As many bits as `./dev flips` asks for, of the checkpoint of a whole run that it names.
TEST_F(CheckpointFile, NoFlippedBitOfTheNamedFileIsAccepted) {
  const char *named = std::getenv("SOLIDUS_CHECKPOINT"), *count = std::getenv("SOLIDUS_FLIPS"),
             *seed = std::getenv("SOLIDUS_FLIP_SEED");
  if (named == nullptr || count == nullptr) GTEST_SKIP() << "./dev flips names a checkpoint";
  std::string bytes = text(named);
  write(file_, bytes);
  ASSERT_EQ(complaint([&] { check_checksum(file_); }), "nothing");
  std::mt19937_64 random(seed != nullptr ? std::strtoull(seed, nullptr, 10) : 1);
  std::uniform_int_distribution<std::size_t> bit(0, 8 * bytes.size() - 1);
  int accepted = 0;
  const auto flip = [&](std::size_t at) {
    bytes[at / 8] = static_cast<char>(bytes[at / 8] ^ (1 << (at % 8)));
    std::fstream file(file_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(at / 8)).put(bytes[at / 8]);
  };
  const int flips = std::atoi(count);
  for (int i = 0; i < flips; ++i) {
    const std::size_t at = bit(random);
    flip(at);
    if (complaint([&] { check_checksum(file_); }) == "nothing") ++accepted;
    flip(at);
  }
  EXPECT_EQ(complaint([&] { check_checksum(file_); }), "nothing") << "the bits are back";
  EXPECT_EQ(accepted, 0);
  std::printf("%d flipped bits of %zu bytes, %d accepted\n", flips, bytes.size(), accepted);
}

TEST_F(CheckpointFile, EqualContentsAreEqualFiles) {
  make(file_);
  sleep(1);  // HDF5 notes the second in which a table was made, unless it is told not to
  make(folder_ / "again.h5");
  EXPECT_TRUE(text(file_) == text(folder_ / "again.h5"));
}

// The sizes in a crafted file must not decide how much memory is written.
TEST_F(CheckpointFile, SizesAndTypesAreCheckedBeforeTheyAreRead) {
  {
    const Hdf5Handle file(H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    const hsize_t many = 1000;
    const std::array<hsize_t, 2> table{3, 2};
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose), list(H5Screate_simple(1, &many, nullptr), H5Sclose),
        rows(H5Screate_simple(2, table.data(), nullptr), H5Sclose);
    H5Tset_size(type, 8);
    const Hdf5Handle texts(H5Dcreate2(file, "format", type, list, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Dclose),
        floats(H5Dcreate2(file, "temperature", H5T_NATIVE_FLOAT, rows, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
               H5Dclose);
  }
  const Hdf5File file(file_, Hdf5File::Mode::read);
  EXPECT_THAT(complaint([&] { file.read_text("format"); }), HasSubstr("holds no text"));
  std::vector<double> values(6);
  EXPECT_THAT(complaint([&] { file.read_rows<double>("temperature", 0, values); }),
              HasSubstr("other numbers"));
  std::vector<std::int64_t> numbers(6);
  EXPECT_THAT(complaint([&] { file.read_rows<std::int64_t>("temperature", 0, numbers); }),
              HasSubstr("other numbers"));
}

TEST_F(CheckpointFile, AFileThatCouldNotBeWrittenIsForgotten) {
  const auto attempt = [] {
    Hdf5File file("/dev/full", Hdf5File::Mode::create);
    file.create_table<double>("temperature", 100000, 2);
    file.write_rows<double>("temperature", 0, std::vector<double>(200000, 1.0));
    file.close();
  };
  EXPECT_THAT(complaint(attempt), HasSubstr("/dev/full"));
  make(file_);  // HDF5 goes on working
  EXPECT_NO_THROW(check_checksum(file_));
}

// On one process and on two: none waits for another, and no part of the file stays.
TEST(CheckpointTables, WhatDoesNotFitIsAnErrorOnEveryProcess) {
  const test::SharedFolder folder;
  const fs::path file = folder.path / "too_large.h5";
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1 << 20, before.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const auto save = [&](std::size_t n) -> std::string {
    try {
      TableWriter out(file);
      out.text("format", "a test");
      out.rows<double>("temperature", 2, std::vector<double>(n, 1.0));
      out.numbers("time", {1.0, 2.0});
      out.finish([] {});
    } catch (const OutputError& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_THAT(save(200000), AllOf(HasSubstr("File too large"), HasSubstr("room on the disk")));
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_FALSE(fs::exists(file));
  MPI_Barrier(PETSC_COMM_WORLD);     // before another process makes it
  EXPECT_EQ(save(1000), "nothing");  // and the next one is written
  EXPECT_NO_THROW(check_checksum(file));
  setrlimit(RLIMIT_FSIZE, &before);
}

std::string complaint_of_lock(const fs::path& folder) {
  try {
    const RunLock lock(folder);
  } catch (const OutputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(RunLock, HoldsAFolderUntilItEnds) {
  const test::SharedFolder folder;  // every process locks the same one
  {
    const RunLock lock(folder.path / ".");
    EXPECT_THAT(complaint_of_lock(folder.path), HasSubstr("a run is under way"));
    if (this_process() == 0) {
      EXPECT_THAT(complaint_of_lock(folder.path), HasSubstr(std::to_string(getpid())));
    } else {
      complaint_of_lock(folder.path);
    }
  }
  EXPECT_EQ(complaint_of_lock(folder.path), "nothing");
  MPI_Barrier(PETSC_COMM_WORLD);  // the first process has taken its lock away
  EXPECT_FALSE(fs::exists(folder.path / "lock"));
}

TEST(RunLock, OfAProcessThatDiedIsTakenOverOfAnotherHostIsNot) {
  const test::SharedFolder folder;  // every process locks the same one
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  if (this_process() == 0)
    std::ofstream(folder.path / "lock") << "process 4194304 on " << host.data() << "\n";
  EXPECT_EQ(complaint_of_lock(folder.path), "nothing");
  MPI_Barrier(PETSC_COMM_WORLD);
  if (this_process() == 0) std::ofstream(folder.path / "lock") << "process 17 on elsewhere\n";
  const std::string complaint = complaint_of_lock(folder.path);
  EXPECT_THAT(complaint, HasSubstr("process 17 on elsewhere"));
  EXPECT_THAT(complaint, HasSubstr("remove"));
}

}  // namespace
