// Checkpoints that somebody made: their checksum fits, their content does not. None is accepted. What comes
// of files on which HDF5 itself fails is the matter of hdf5_reader_test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "results/checkpoint/checkpoint.hpp"
#include "results/formats/file_checksum.hpp"
#include "results/formats/hdf5_file.hpp"
#include "results/output/output_error.hpp"
#include "sample.hpp"

namespace {

using namespace solidus;
using namespace solidus::results;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN(), k_infinite = HUGE_VAL;

class CraftedCheckpoint : public ::testing::Test {
 protected:
  void SetUp() override {
    if (processes::count() > 1) GTEST_SKIP() << "every process reads the same file by itself";
    const std::size_t n = mesh_.x.size();
    state_.time = 3;
    state_.heat = {std::vector<double>(n, 300.0), std::vector<double>(n, 1e3)};
    state_.burning = {std::vector<double>(n, k_infinite), std::vector<double>(n, 0.0)};
    state_.mechanics.displacement.assign(2 * n, 1e-6);
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      mechanics::BlockHistory history{3, 2, {}};
      history.values.assign(6, Lane(0.5));
      state_.mechanics.history.push_back(history);
    }
    contact::ContactState pair;
    pair.points.resize(2);
    pair.master.resize(2);
    for (std::size_t p = 0; p < 2; ++p) {
      pair.points[p].number = pair.master[p].number = static_cast<GlobalIndex>(p);
      pair.points[p].counted = pair.master[p].counted = true;
    }
    state_.contacts = {pair};
    state_.steady_gaps = {1};
    state_.criteria.records = {
        {"freezing", {criteria::make_column(mesh_, "at", mesh::FieldPlace::node)}, {}}};
    continuation_.control.size = 0.1;
    write();
  }
  void write() const { file_of_.write(mesh_, {}, {state_, continuation_, energy_, 0, 0, stability_}); }
  /// Changes the file by `damage`, makes its checksum fit, and returns what is reported of it.
  std::string said_of(const std::function<void(hid_t)>& damage) const {
    write();
    fs::remove(file_of_.previous());
    {
      const Hdf5Handle file(H5Fopen(file_of_.latest().c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
      damage(file);
    }
    write_checksum(file_of_.latest());
    try {
      file_of_.read(mesh_, {}, state_);
    } catch (const OutputError& error) {
      return error.what();
    }
    return "nothing";
  }
  template <class T>
  static void put(hid_t file, const std::string& table, std::size_t at, T value) {
    const hid_t type = std::is_same_v<T, double> ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
    const Hdf5Handle set(H5Dopen2(file, table.c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Handle space(H5Dget_space(set), H5Sclose);
    std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    values.at(at) = value;
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  /// Replaces a table by one of another size, type or storage.
  static void replace(hid_t file, const std::string& table, std::array<hsize_t, 2> size, hid_t type,
                      hid_t properties = H5P_DEFAULT) {
    H5Ldelete(file, table.c_str(), H5P_DEFAULT);
    const Hdf5Handle space(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
    const Hdf5Handle set(H5Dcreate2(file, table.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                         H5Dclose);
    ASSERT_GE(set, 0) << table;
  }

  test::SharedFolder folder_;
  mesh::Mesh mesh_ = test::triangles_and_quad();
  CheckpointFolder file_of_{folder_.path};
  coupling::State state_;
  coupling::RestartData continuation_;
  coupling::EnergyAudit energy_;
  coupling::StabilityAudit stability_;
};

const std::vector<std::string> k_tables = {"temperature",
                                           "enthalpy",
                                           "lit",
                                           "released",
                                           "displacement",
                                           "history/block_0_tri3/values",
                                           "contact_0/values",
                                           "criteria/freezing/at",
                                           "contact_0/master_values",
                                           "numbers"};

TEST_F(CraftedCheckpoint, AWholeOneIsRead) {
  EXPECT_EQ(said_of([](hid_t) {}), "nothing");
}

TEST_F(CraftedCheckpoint, WhatIsNoNumberIsRefusedWithItsPlace) {
  for (const std::string& table : k_tables) {
    EXPECT_THAT(said_of([&](hid_t file) { put(file, table, 1, k_nan); }),
                AllOf(HasSubstr("state.h5"), HasSubstr(table), HasSubstr("nan"), HasSubstr("row ")));
    EXPECT_THAT(said_of([&](hid_t file) { put(file, table, 1, -k_infinite); }), HasSubstr("-inf")) << table;
    if (table != "lit") {
      EXPECT_THAT(said_of([&](hid_t file) { put(file, table, 1, k_infinite); }), HasSubstr("inf")) << table;
    }
  }
}

TEST_F(CraftedCheckpoint, WhatNoStateHasIsRefused) {
  struct Damage {
    std::string table;
    std::size_t at;
    double value;
    std::string said;
  };
  const std::vector<Damage> damages = {
      {"temperature", 4, -20, "its 'temperature' has -20 in row 4, column 0 (number 104 of 'node')"},
      {"temperature", 0, 0, "its 'temperature' has 0 in row 0"},
      {"temperature", 5, 1e7, "has 10000000"},
      {"lit", 2, -1, "its 'lit' has -1"},
      {"contact_0/values", 0, 3, "the status of point 0 of 'contact_0' is 3"},
      {"contact_0/values", 0, 1e300, "the status of point 0"},
      {"contact_0/values", 1, 0.5, "the mark of a partner"},
      {"contact_0/master_values", 0, -1, "has -1"},
      {"numbers", 0, -5, "its time is -5 s"},
      {"numbers", 1, 1e300, "its 'numbers' have 1e+300 in row 1"},
      {"numbers", 1, 2.5, "its 'numbers' have 2.5 in row 1"},
      {"numbers", 1, -3, "its 'numbers' have -3 in row 1"},
  };
  for (const Damage& d : damages)
    EXPECT_THAT(said_of([&](hid_t file) { put(file, d.table, d.at, d.value); }), HasSubstr(d.said))
        << d.table << " " << d.value;
}

TEST_F(CraftedCheckpoint, NumbersOfNodesThatAreNotThereOrComeTwiceAreRefused) {
  for (const char* keys :
       {"node", "history/block_0_tri3/element", "contact_0/point", "contact_0/master_node"})
    for (const std::int64_t number : {std::numeric_limits<std::int64_t>::max(), std::int64_t{-1}}) {
      EXPECT_THAT(said_of([&](hid_t file) { put(file, keys, 1, number); }), HasSubstr("does not fit"))
          << keys << " " << number;
    }
  EXPECT_THAT(said_of([](hid_t file) { put(file, "node", 1, std::int64_t{100}); }),
              HasSubstr("does not fit"));
  EXPECT_THAT(said_of([](hid_t file) { put(file, "contact_0/point", 1, std::int64_t{0}); }),
              HasSubstr("does not fit"));
}

TEST_F(CraftedCheckpoint, SizesAndTypesAndStorageOfTablesAreChecked) {
  const hid_t number = H5T_NATIVE_DOUBLE;
  for (const std::array<hsize_t, 2> size :
       {std::array<hsize_t, 2>{6, 2}, {5, 1}, {7, 1}, {0, 1}, {6000, 1}, {6, 1000}}) {
    EXPECT_NE(said_of([&](hid_t file) { replace(file, "temperature", size, number); }), "nothing")
        << size[0] << " x " << size[1];
    EXPECT_NE(said_of([&](hid_t file) { replace(file, "numbers", size, number); }), "nothing")
        << size[0] << " x " << size[1];
  }
  for (const hid_t type : {H5T_NATIVE_FLOAT, H5T_NATIVE_INT64, H5T_C_S1})
    EXPECT_NE(said_of([&](hid_t file) { replace(file, "temperature", {6, 1}, type); }), "nothing");
  const Hdf5Handle packed(H5Pcreate(H5P_DATASET_CREATE), H5Pclose),
      elsewhere(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const std::array<hsize_t, 2> chunk{6, 1};
  H5Pset_chunk(packed, 2, chunk.data());
  H5Pset_deflate(packed, 9);
  H5Pset_external(elsewhere, "/etc/hostname", 0, H5F_UNLIMITED);
  for (const hid_t properties : {hid_t{packed}, hid_t{elsewhere}})
    EXPECT_THAT(said_of([&](hid_t file) {
                  replace(file, "temperature", {6, 1}, number, properties);
                }),
                HasSubstr("no plain table 'temperature'"));
  EXPECT_THAT(said_of([&](hid_t file) {
                H5Ldelete(file, "temperature", H5P_DEFAULT);
                H5Lcreate_external(file_of_.latest().c_str(), "enthalpy", file, "temperature", H5P_DEFAULT,
                                   H5P_DEFAULT);
              }),
              HasSubstr("holds no 'temperature'"));
}

TEST_F(CraftedCheckpoint, TextsAreChecked) {
  const auto say = [](hid_t file, const std::string& name, const std::string& text) {
    H5Ldelete(file, name.c_str(), H5P_DEFAULT);
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type, text.size() + 1);
    const Hdf5Handle set(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Dclose);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str());
  };
  EXPECT_THAT(said_of([&](hid_t file) { say(file, "format", "Solidus checkpoint 18"); }),
              HasSubstr("is no checkpoint that this version"));
  EXPECT_THAT(said_of([&](hid_t file) { say(file, "steady_gaps", "sssss"); }),
              HasSubstr("are of 5 contacts"));
  EXPECT_THAT(said_of([&](hid_t file) {
                say(file, "shots", "known");
                say(file, "shot_iterates", "18446744073709551615");
              }),
              HasSubstr("shot_"));
  EXPECT_NE(said_of([&](hid_t file) { say(file, "rates", "known"); }), "nothing");
}

}  // namespace
