#include "results/output/run_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <petscsys.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "results/formats/field_output.hpp"
#include "results/formats/hdf5_file.hpp"
#include "results/formats/pvd.hpp"
#include "results/formats/temperature_history.hpp"
#include "results/formats/vtkhdf.hpp"
#include "results/output/csv.hpp"
#include "results/output/output_error.hpp"
#include "sample.hpp"
#include "system/processes.hpp"
#include "vtu_reader.hpp"

namespace solidus::results {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, IsNamedAfterCaseAndVariant) {
  EXPECT_EQ(default_run_folder("cases/aluminium_cylinder/case.toml"), "results/aluminium_cylinder/default");
  EXPECT_EQ(default_run_folder("cases/aluminium_cylinder/quad.toml"), "results/aluminium_cylinder/quad");
  EXPECT_EQ(default_run_folder("/a/b/../c/h_const.toml"), "results/c/h_const");
  EXPECT_EQ(default_run_folder("/a/c/case.toml", "hot"), "results/c/hot");
}

TEST(RunFolder, HoldsTheResolvedCaseAtOnce) {
  test::SharedFolder folder;
  const RunFolder run(folder.path / "results" / "a" / "default", "title = \"A\"\n");
  const std::string text = test::read_text(run.root() / "case.toml");
  EXPECT_EQ(text.front(), '#');
  EXPECT_NE(text.find("\ntitle = \"A\"\n"), std::string::npos);
  EXPECT_TRUE(fs::is_directory(run.fields()));
}

TEST(RunFolder, ReplacesAnEarlierRunAndKeepsForeignFiles) {
  test::SharedFolder folder;
  const fs::path root = folder.path / "run";
  RunFolder(root, "");
  const std::vector<std::string> ours = {"history.csv",
                                         "summary.json",
                                         "fields.pvd",
                                         "fields/fields_00003.vtu",
                                         "fields/fields_00003_p1.vtu",
                                         "fields/surface_wall_00003.pvtu",
                                         "fields/fields_00004.vtu.part",
                                         "fields/fields_00004.vtu.spool"};
  const std::vector<std::string> foreign = {"notes.txt", "plots.png", "fields/mine.vtu",
                                            "fields/mine_00001.vtu"};
  test::on_first([&] {
    for (const auto& name : ours) std::ofstream(root / name) << "old";
    for (const auto& name : foreign) std::ofstream(root / name) << "keep";
  });
  RunFolder(root, "");
  for (const auto& name : ours) EXPECT_FALSE(fs::exists(root / name)) << name;
  for (const auto& name : foreign) EXPECT_EQ(test::read_text(root / name), "keep") << name;
}

TEST(RunFolder, NeverTakesACaseFolderForAResultsFolder) {
  test::SharedFolder folder;
  test::on_first([&] { std::ofstream(folder.path / "case.toml") << "title = \"mine\"\n"; });
  try {
    RunFolder(folder.path, "");
    FAIL() << "must throw";
  } catch (const OutputError& error) {
    EXPECT_EQ(std::string(error.what()), folder.path.string() +
                                             ": this folder holds a case.toml that Solidus did not write\n"
                                             "  choose another folder with -o, or move that file away");
  }
  EXPECT_EQ(test::read_text(folder.path / "case.toml"), "title = \"mine\"\n");
}

// NAME.csv of a [[profile]] is Solidus's where the case of the last run has that profile.
TEST(RunFolder, ReplacesOwnTablesOfProfilesAndNoOthers) {
  test::SharedFolder folder;
  const fs::path root = folder.path / "run";
  const std::vector<std::string> wear{"wear.csv"}, both{"wear.csv", "mine.csv"};
  RunFolder(root, "[[profile]]\nname = \"wear\"\n[[probe]]\nname = \"mine\"\n", false, wear);
  test::on_first([&] {
    for (const auto& name : both) std::ofstream(root / name) << "old";
  });
  for (const bool continued : {true, false}) {
    EXPECT_THROW(RunFolder(root, "", continued, both), OutputError);
    EXPECT_EQ(test::read_text(root / "mine.csv"), "old");
    EXPECT_EQ(test::read_text(root / "wear.csv"), "old");
  }
  MPI_Barrier(PETSC_COMM_WORLD);  // all have read it before one takes it away
  RunFolder(root, "", false, wear);
  EXPECT_FALSE(fs::exists(root / "wear.csv"));
  EXPECT_EQ(test::read_text(root / "mine.csv"), "old");
}

TEST(RunFolder, KeepsTablesThatSomebodyElseWrote) {
  test::SharedFolder folder;
  test::on_first([&] { std::ofstream(folder.path / "history.csv") << "mine"; });
  EXPECT_THROW(RunFolder(folder.path, ""), OutputError);
  EXPECT_EQ(test::read_text(folder.path / "history.csv"), "mine");
}

TEST(RunFolder, SaysWhenItCannotBeMade) {
  test::SharedFolder folder;
  test::on_first([&] { std::ofstream(folder.path / "file") << ""; });
  try {
    RunFolder(folder.path / "file" / "run", "");
    FAIL() << "must throw";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot make the results folder: Not a directory"),
              std::string::npos)
        << error.what();
  }
}

TEST(RunFolder, SaysWhenItIsNotWritable) {
  // Even root cannot make files in /proc: it stands for a folder without permission.
  try {
    RunFolder("/proc/solidus", "");
    FAIL() << "must throw";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("/proc/solidus: cannot make the results folder: "),
              std::string::npos)
        << error.what();
  }
}

TEST(RunFolder, KeepsLinksSoThatTablesCanLiveElsewhere) {
  test::SharedFolder folder;
  test::on_first([&] { fs::create_symlink("/dev/full", folder.path / "history.csv"); });
  const RunFolder run(folder.path, "");
  EXPECT_THROW(CsvTable(run.history(), {{"time", "s"}}), OutputError) << "goes to the full device";
}

// A block of 6 × 4 cells split over the processes, with a linear field at nodes and the input number in
// cells.
struct Distributed : ::testing::Test {
  test::SharedFolder folder;
  mesh::Mesh mesh;
  std::vector<double> temperature, number;
  FieldSet fields;
  int rank = 0, size = 1;

  Distributed() {
    rank = processes::rank();
    size = processes::count();
    mesh::RawMesh raw;
    if (rank == 0) raw = mesh::make_block({{3, 2}, {}, {6, 4}, "part"}, mesh::Shape::quad8);
    mesh = mesh::distribute(raw, {"part"}, {"x_max"});
    for (const mesh::Point& x : mesh.x) temperature.push_back(300 + 10 * x[0] + x[1]);
    for (const mesh::ElementBlock& b : mesh.blocks)
      for (const GlobalIndex e : b.input_element) number.push_back(static_cast<double>(e));
    fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
    fields.add({"number", "1", 1, mesh::FieldPlace::cell, number});
  }
  std::string file(const std::string& name) const { return name + (size == 1 ? ".vtu" : ".pvtu"); }
};

TEST_F(Distributed, FieldsAreNumberedAndCollected) {
  const RunFolder run(folder.path, "");
  FieldOutput output(run, mesh);
  output.write(0, fields);
  FieldSet surface;
  surface.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
  output.write(1.5, fields, {{"x_max", surface}});
  output.write(1.5, fields);
  EXPECT_FALSE(fs::exists(run.fields() / file("fields_00002"))) << "a moment is written once";
  for (const char* name : {"fields_00000", "fields_00001", "surface_x_max_00001"})
    EXPECT_TRUE(fs::exists(run.fields() / file(name))) << name;
  const std::string pvd = test::read_text(run.root() / k_collection);
  EXPECT_NE(pvd.find("timestep=\"1.5\" part=\"1\" file=\"fields/" + file("surface_x_max_00001") + "\""),
            std::string::npos)
      << pvd;
}

TEST_F(Distributed, EveryElementIsWrittenByOneProcess) {
  const RunFolder run(folder.path, "");
  FieldOutput output(run, mesh);
  output.write(0, fields);
  test::on_first([&] {
    std::vector<std::int64_t> elements;
    for (int process = 0; process < size; ++process) {
      const std::string part = size == 1 ? "fields_00000.vtu" : fmt::format("fields_00000_p{}.vtu", process);
      const test::VtuFile vtu(run.fields() / part);
      const auto mine = vtu.array<std::int64_t>("element");
      elements.insert(elements.end(), mine.begin(), mine.end());
      EXPECT_EQ(vtu.array<std::int32_t>("process"), std::vector<std::int32_t>(mine.size(), process));
      const auto x = vtu.array<double>("Points"), t = vtu.array<double>("temperature");
      for (std::size_t i = 0; i < t.size(); ++i) EXPECT_EQ(t[i], 300 + 10 * x[3 * i] + x[3 * i + 1]);
    }
    std::sort(elements.begin(), elements.end());
    EXPECT_EQ(elements.size(), 24U);
    EXPECT_EQ(std::adjacent_find(elements.begin(), elements.end()), elements.end()) << "none twice";
  });
}

/// All numbers of a table of an HDF5 file.
std::vector<double> table(hid_t file, const std::string& name) {
  const Hdf5Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (set < 0) return {};
  const Hdf5Handle space(H5Dget_space(set), H5Sclose);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  return values;
}

// The steps are addressed as VTK's description of the format says: rows from the step's offset on.
TEST_F(Distributed, OneFileOfVtkHdfHoldsAllMoments) {
  const RunFolder run(folder.path, "");
  FieldOutput output(run, mesh);
  output.write(0, fields);
  for (double& t : temperature) t += 5;
  output.write(2.5, fields);
  test::on_first([&] {
    const fs::path path = folder.path / "fields.vtkhdf";
    const VtkHdfReport report = write_vtkhdf(run.root() / k_collection, path);
    EXPECT_EQ(report.times, 2U);
    EXPECT_EQ(report.cells, 24U);
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    ASSERT_GE(hid_t(file), 0);
    EXPECT_EQ(table(file, "VTKHDF/Steps/Values"), (std::vector<double>{0, 2.5}));
    EXPECT_EQ(table(file, "VTKHDF/Steps/PointOffsets"), (std::vector<double>{0, 0}));
    const std::vector<double> x = table(file, "VTKHDF/Points"),
                              t = table(file, "VTKHDF/PointData/temperature"),
                              offsets = table(file, "VTKHDF/Steps/PointDataOffsets/temperature");
    const std::size_t n = x.size() / 3;
    EXPECT_EQ(report.points, n);
    ASSERT_EQ(t.size(), 2 * n);
    EXPECT_EQ(offsets, (std::vector<double>{0, static_cast<double>(n)}));
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(t[i], 300 + 10 * x[3 * i] + x[3 * i + 1]);
      EXPECT_EQ(t[n + i], t[i] + 5);
    }
    // Every corner is a point of the element's own process: the box of each cell is that of the mesh.
    const std::vector<double> corners = table(file, "VTKHDF/Connectivity"),
                              ends = table(file, "VTKHDF/Offsets");
    ASSERT_EQ(ends.size(), 25U);
    EXPECT_EQ(ends.back(), static_cast<double>(corners.size()));
    double area = 0;
    for (std::size_t c = 0; c < 24; ++c) {
      std::array<double, 2> low{1e9, 1e9}, high{-1e9, -1e9};
      for (auto k = static_cast<std::size_t>(ends[c]); k < static_cast<std::size_t>(ends[c + 1]); ++k)
        for (std::size_t i = 0; i < 2; ++i) {
          const double at = x[3 * static_cast<std::size_t>(corners[k]) + i];
          low[i] = std::min(low[i], at), high[i] = std::max(high[i], at);
        }
      area += (high[0] - low[0]) * (high[1] - low[1]);
    }
    EXPECT_NEAR(area, 3 * 2, 1e-12);
    std::vector<double> elements = table(file, "VTKHDF/CellData/element");
    std::sort(elements.begin(), elements.end());
    EXPECT_EQ(std::adjacent_find(elements.begin(), elements.end()), elements.end());
    EXPECT_EQ(table(file, "VTKHDF/CellData/vtkGhostType").size(), 48U);

    if (size == 1) {
      const linear::ActiveSet active(mesh, {});
      const std::vector<TemperatureMoment> history =
          read_temperature_history(run.root() / k_collection, mesh, active);
      ASSERT_EQ(history.size(), 2U);
      EXPECT_EQ(history[1].time, 2.5);
      EXPECT_EQ(history[1].temperature, temperature);
    }

    fs::remove(run.fields() / (size == 1 ? "fields_00001.vtu" : "fields_00001_p0.vtu"));
    EXPECT_THROW(write_vtkhdf(run.root() / k_collection, folder.path / "none.vtkhdf"), InputError);
    EXPECT_FALSE(fs::exists(folder.path / "none.vtkhdf"));
  });
}

TEST_F(Distributed, PythonReadsTheSameFields) {
  const RunFolder run(folder.path, "");
  FieldOutput output(run, mesh);
  output.write(0, fields);
  output.write(2.5, fields);
  test::on_first([&] {
    const std::string command = fmt::format(
        "PYTHONPATH='{0}/python' PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "
        "'{0}/tests/unit/results/read_fields.py' '{1}' 2>&1",
        SOLIDUS_SOURCE_DIR, (run.root() / k_collection).string());
    EXPECT_EQ(std::system(command.c_str()), 0);
  });
}

TEST_F(Distributed, CollectionStaysAsItWasWhenOneProcessCannotWrite) {
  const RunFolder run(folder.path, "");
  FieldOutput output(run, mesh);
  output.write(0, fields);
  const std::string before = test::read_text(run.root() / k_collection);
  const std::string part = size == 1 ? "fields_00001.vtu" : fmt::format("fields_00001_p{}.vtu", size - 1);
  test::on_first([&] { fs::create_symlink("/dev/full", run.fields() / (part + ".part")); });
  try {
    output.write(1, fields);
    FAIL() << "must throw on every process";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot write: No space left on device"), std::string::npos);
  }
  EXPECT_EQ(test::read_text(run.root() / k_collection), before);
  EXPECT_FALSE(fs::exists(run.fields() / file("fields_00001")));
}

TEST(RunCollectively, ThrowsOnEveryProcessWhenOneFails) {
  const int rank = processes::rank(), size = processes::count();
  const int failing = size - 1;
  try {
    run_collectively([&] {
      if (rank == failing) throw OutputError("x.vtu", "cannot write: No space left on device");
    });
    FAIL() << "must throw";
  } catch (const OutputError& error) {
    EXPECT_STREQ(error.what(), "x.vtu: cannot write: No space left on device");
  }
  EXPECT_NO_THROW(run_collectively([] {}));
}

}  // namespace
}  // namespace solidus::results
