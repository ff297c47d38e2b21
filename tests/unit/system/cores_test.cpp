#include "system/cores.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace solidus {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

/// Folders that stand for /proc and /sys of another machine.
class Cores : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(root_); }
  void TearDown() override { fs::remove_all(root_); }
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  fs::path proc() const { return root_ / "proc"; }
  fs::path sys() const { return root_ / "sys"; }
  std::optional<double> quota() const { return processor_quota(proc(), sys()); }

  const fs::path root_ = fs::temp_directory_path() / ("solidus_cores_test_" + std::to_string(::getpid()));
};

TEST_F(Cores, ProcessorsThatShareTheirArithmeticAreOneCore) {
  for (const int p : {0, 1, 2, 3})
    write("sys/devices/system/cpu/cpu" + std::to_string(p) + "/topology/thread_siblings_list",
          p % 2 == 0 ? "0,2\n" : "1,3\n");
  const std::vector<int> all = {0, 1, 2, 3}, some = {1, 2, 3};
  EXPECT_THAT(cores_of(all, sys()), ElementsAre(Core{0, 2}, Core{1, 3}));
  EXPECT_THAT(cores_of(some, sys()), ElementsAre(Core{1, 3}, Core{2})) << "what may not be used is left out";
  EXPECT_EQ(cores_of(all, "/nowhere").size(), 4U) << "nothing is told of them";
}

TEST_F(Cores, ThisProcessMayUseOneAtLeast) {
  EXPECT_GE(cores_of(usable_processors()).size(), 1U);
}

TEST_F(Cores, AGroupOfVersion2HasTheLeastQuotaOfThoseAroundIt) {
  write("proc/self/cgroup", "0::/user.slice/run.scope\n");
  EXPECT_FALSE(quota());
  write("sys/fs/cgroup/user.slice/run.scope/cpu.max", "max 100000\n");
  EXPECT_FALSE(quota());
  write("sys/fs/cgroup/user.slice/cpu.max", "250000 100000\n");
  EXPECT_DOUBLE_EQ(quota().value(), 2.5);
  write("sys/fs/cgroup/user.slice/run.scope/cpu.max", "150000 100000\n");
  EXPECT_DOUBLE_EQ(quota().value(), 1.5);
}

// The path is of the host, and what the container has mounted is its own group.
TEST_F(Cores, AContainerSeesItsQuotaWhereItsGroupsAreMounted) {
  write("proc/self/cgroup", "0::/../../docker/4f5a\n");
  write("sys/fs/cgroup/cpu.max", "100000 50000\n");
  EXPECT_DOUBLE_EQ(quota().value(), 2);
}

TEST_F(Cores, AGroupOfVersion1HasTheQuotaOfItsProcessorController) {
  write("proc/self/cgroup", "5:memory:/a\n4:cpu,cpuacct:/a/b\n1:name=systemd:/\n");
  write("sys/fs/cgroup/cpu,cpuacct/a/b/cpu.cfs_quota_us", "-1\n");
  write("sys/fs/cgroup/cpu,cpuacct/a/b/cpu.cfs_period_us", "100000\n");
  EXPECT_FALSE(quota());
  write("sys/fs/cgroup/cpu,cpuacct/a/cpu.cfs_quota_us", "300000\n");
  write("sys/fs/cgroup/cpu,cpuacct/a/cpu.cfs_period_us", "100000\n");
  EXPECT_DOUBLE_EQ(quota().value(), 3);
}

TEST(CoresWithin, AQuotaLeavesWholeCoresAndOneAtLeast) {
  EXPECT_EQ(cores_within(8, {}), 8);
  EXPECT_EQ(cores_within(8, 2.9), 2);
  EXPECT_EQ(cores_within(8, 0.5), 1);
  EXPECT_EQ(cores_within(2, 16.0), 2);
}

TEST_F(Cores, WhatOthersUseIsNotFreeAndWhatStandsBackIs) {
  // user nice system idle iowait irq softirq steal
  write("proc/stat",
        "cpu  0 0 0 0\ncpu0 0 0 0 0 0 0 0 0\ncpu1 0 0 0 0 0 0 0 0\ncpu2 0 0 0 0 0 0 0 0\nintr 1\n");
  const CoreLoad load({{0}, {1}, {2}}, proc());
  EXPECT_DOUBLE_EQ(load.free_cores(0), 3) << "no time has passed";
  write("proc/stat",
        "cpu  0 0 0 0\ncpu0 100 0 0 0 0 0 0 0\ncpu1 0 100 0 0 0 0 0 0\ncpu2 10 0 10 60 20 0 0 0\nintr 1\n");
  EXPECT_DOUBLE_EQ(load.free_cores(0), 1.8) << "one busy, one at a lower priority, a fifth of the third";
  EXPECT_DOUBLE_EQ(load.free_cores(0.9), 2.7) << "0.9 s of that were ours";
  EXPECT_DOUBLE_EQ(CoreLoad({{7}}, proc()).free_cores(0), 1) << "a processor that is not listed";
}

TEST_F(Cores, ACoreIsBusyWhenEitherOfItsProcessorsIs) {
  write("proc/stat", "cpu0 0 0 0 0 0 0 0 0\ncpu1 0 0 0 0 0 0 0 0\n");
  const CoreLoad load({{0, 1}}, proc());
  write("proc/stat", "cpu0 80 0 0 20 0 0 0 0\ncpu1 70 0 0 30 0 0 0 0\n");
  EXPECT_DOUBLE_EQ(load.free_cores(0), 0);
}

}  // namespace
}  // namespace solidus
