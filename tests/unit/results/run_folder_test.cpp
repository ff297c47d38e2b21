#include "results/run_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "results/csv.hpp"
#include "results/field_output.hpp"
#include "results/output_error.hpp"
#include "sample.hpp"
#include "vtu_reader.hpp"

namespace solidus::results {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, IsNamedAfterCaseAndVariant) {
  EXPECT_EQ(default_run_folder("cases/aluminium_cylinder/case.toml"), "results/aluminium_cylinder/default");
  EXPECT_EQ(default_run_folder("cases/aluminium_cylinder/quad.toml"), "results/aluminium_cylinder/quad");
  EXPECT_EQ(default_run_folder("/a/b/../c/h_const.toml"), "results/c/h_const");
}

TEST(RunFolder, HoldsTheResolvedCaseAtOnce) {
  test::TemporaryFolder folder;
  const RunFolder run(folder.path / "results" / "a" / "default", "title = \"A\"\n");
  const std::string text = test::read_text(run.root() / "case.toml");
  EXPECT_EQ(text.front(), '#');
  EXPECT_NE(text.find("\ntitle = \"A\"\n"), std::string::npos);
  EXPECT_TRUE(fs::is_directory(run.fields()));
}

TEST(RunFolder, ReplacesAnEarlierRunAndKeepsForeignFiles) {
  test::TemporaryFolder folder;
  const fs::path root = folder.path / "run";
  RunFolder(root, "");
  const std::vector<std::string> ours = {"history.csv",
                                         "summary.json",
                                         "fields.pvd",
                                         "fields/fields_00003.vtu",
                                         "fields/fields_00003_p1.vtu",
                                         "fields/surface_wall_00003.pvtu",
                                         "fields/fields_00004.vtu.part"};
  const std::vector<std::string> foreign = {"notes.txt", "plots.png", "fields/mine.vtu",
                                            "fields/mine_00001.vtu"};
  for (const auto& name : ours) std::ofstream(root / name) << "old";
  for (const auto& name : foreign) std::ofstream(root / name) << "keep";
  RunFolder(root, "");
  for (const auto& name : ours) EXPECT_FALSE(fs::exists(root / name)) << name;
  for (const auto& name : foreign) EXPECT_EQ(test::read_text(root / name), "keep") << name;
}

TEST(RunFolder, NeverTakesACaseFolderForAResultsFolder) {
  test::TemporaryFolder folder;
  std::ofstream(folder.path / "case.toml") << "title = \"mine\"\n";
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

TEST(RunFolder, KeepsTablesThatSomebodyElseWrote) {
  test::TemporaryFolder folder;
  std::ofstream(folder.path / "history.csv") << "mine";
  EXPECT_THROW(RunFolder(folder.path, ""), OutputError);
  EXPECT_EQ(test::read_text(folder.path / "history.csv"), "mine");
}

TEST(RunFolder, SaysWhenItCannotBeMade) {
  test::TemporaryFolder folder;
  std::ofstream(folder.path / "file") << "";
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
  test::TemporaryFolder folder;
  fs::create_symlink("/dev/full", folder.path / "history.csv");
  const RunFolder run(folder.path, "");
  EXPECT_THROW(CsvTable(run.history(), {{"time", "s"}}), OutputError) << "goes to the full device";
}

TEST(FieldOutput, NumbersFilesAndCollectsThem) {
  test::TemporaryFolder folder;
  const RunFolder run(folder.path, "");
  mesh::Mesh mesh = test::triangles_and_quad();
  mesh.surfaces["part/wall"] = {};
  FieldOutput output(run, mesh);
  output.write(0, {});
  output.write(1.5, {}, {{"part/wall", {}}});
  EXPECT_EQ(output.written(), 2);
  for (const char* name : {"fields_00000.vtu", "fields_00001.vtu", "surface_part_wall_00001.vtu"})
    EXPECT_TRUE(fs::exists(run.fields() / name)) << name;
  const std::string pvd = test::read_text(run.collection());
  EXPECT_NE(pvd.find("timestep=\"1.5\" part=\"1\" file=\"fields/surface_part_wall_00001.vtu\""),
            std::string::npos)
      << pvd;
}

TEST(FieldOutput, KeepsTheCollectionWhenAFileFails) {
  test::TemporaryFolder folder;
  const RunFolder run(folder.path, "");
  const mesh::Mesh mesh = test::triangles_and_quad();
  FieldOutput output(run, mesh);
  output.write(0, {});
  const std::string before = test::read_text(run.collection());
  fs::create_symlink("/dev/full", run.fields() / "fields_00001.vtu.part");
  EXPECT_THROW(output.write(1, {}), OutputError);
  EXPECT_EQ(test::read_text(run.collection()), before);
  EXPECT_FALSE(fs::exists(run.fields() / "fields_00001.vtu"));
}

TEST(Together, ThrowsOnEveryProcessWhenOneFails) {
  int rank = 0, size = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  const int failing = size - 1;
  try {
    together([&] {
      if (rank == failing) throw OutputError("x.vtu", "cannot write: No space left on device");
    });
    FAIL() << "must throw";
  } catch (const OutputError& error) {
    EXPECT_STREQ(error.what(), "x.vtu: cannot write: No space left on device");
  }
  EXPECT_NO_THROW(together([] {}));
}

}  // namespace
}  // namespace solidus::results
