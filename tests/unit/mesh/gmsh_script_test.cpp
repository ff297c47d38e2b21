// Scripts of strangers: what a .geo may say, and that files are read as what they are.
#include "mesh/files/gmsh_script.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mesh/files/file_format.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// A folder of this process, empty at the start of each test.
class Scripts : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(SOLIDUS_BINARY_DIR) / ("scripts_" + std::to_string(rank())) / "case";
    fs::remove_all(folder_.parent_path());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_.parent_path()); }
  std::string write(const std::string& file, const std::string& text) const {
    const fs::path path = folder_ / file;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }
  /// Message of the check on a script; "nothing" if it has no objection.
  std::string said_of(const std::string& text) const {
    try {
      mesh::check_gmsh_script(write("part.geo", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  }
  bool made(const std::string& file) const { return fs::exists(folder_ / file); }
  std::string victim() const { return (folder_ / "victim").string(); }
  fs::path folder_;
};

constexpr const char* k_square = R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 10, 10};
Physical Surface("part") = {1};
)";

TEST_F(Scripts, ThoseOfTheProjectAreAllowed) {
  int scripts = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SOLIDUS_SOURCE_DIR) / "cases"))
    if (entry.path().extension() == ".geo") {
      EXPECT_NO_THROW(mesh::check_gmsh_script(entry.path().string())) << entry.path();
      ++scripts;
    }
  EXPECT_GE(scripts, 5);
}

TEST_F(Scripts, GeometrySizesFieldsMacrosLoopsAndViewsAreAllowed) {
  write("shape.geo", "Point(9) = {0, 0, 5}; // here\n");
  const std::vector<std::string> allowed = {
      k_square,
      "Include \"shape.geo\";\nMerge 'shape.geo';\n",
      "DefineConstant[ size = {8, Name \"Mesh/Size\", Min 1, Max 20, Step 0.5, Help 'in mm'} ];\n",
      "DefineNumber[ 8, Name \"size\" ];\nn = DefineNumber[ 3, Min 1 ];\n",
      "/* A comment\n of two lines: System \"rm\" */\nPoint(1) = {0,0,0};\n",
      "Macro Web\n  Point(newp) = {x, 0, 0};\nReturn\nx = 1;\nCall Web;\n",
      "For i In {0:3}\n  If (i == 2)\n    Point(newp) = {i, 0, 0};\n  ElseIf (i > 2)\n    a() += i;\n  Else\n"
      "    b = 1;\n  EndIf\nEndFor\n",
      "Field[1] = Distance;\nField[1].PointsList = {1};\nField[2] = Threshold;\nField[2].InField = 1;\n"
      "Background Field = 2;\nField[3] = MathEval;\nField[3].F = \"0.1 + x\";\n",
      "Mesh.Algorithm = 6;\nMesh.MeshSizeMax = 3;\nGeometry.Tolerance = 1e-6;\nGeneral.Terminal = 1;\n",
      "Transfinite Curve {1, 2} = 10 Using Progression 1.2;\nTransfinite Surface {1} Right;\n"
      "Recombine Surface {1};\nMesh 2;\nSetOrder 2;\nOptimizeMesh \"Netgen\";\nCoherence Mesh;\n",
      "out[] = Extrude {0, 0, 1} { Surface{1}; Layers{5}; Recombine; };\n",
      "s() = Surface In BoundingBox{0, 0, 0, 1, 1, 1};\nPhysical Curve(Sprintf(\"side %g\", 3)) = {1};\n",
      "Printf(\"%g points, 100%% of them\", 3);\nError(\"no\");\n",
      "View \"sizes\" {\n  SP(0,0,0){1};\n};\nBackground Mesh View[0];\n"};
  for (const std::string& script : allowed) EXPECT_EQ(said_of(script), "nothing") << script;
}

TEST_F(Scripts, WhatDoesMoreThanGeometryIsRefusedWithItsPlace) {
  const std::vector<std::pair<std::string, std::string>> refused = {
      {"SystemCall \"touch x\";", "command of the system"},
      {"System \"touch x\";", "command of the system"},
      {"NonBlockingSystemCall \"touch x\";", "command of the system"},
      {"Field[1] = ExternalProcess;", "command of the system"},
      {"Field[1].CommandLine = \"touch x\";", "command of the system"},
      {"Save \"x.msh\";", "write files"},
      {"Print \"x.png\";", "write files"},
      {"CreateDir \"x\";", "write files"},
      {"Printf(\"a\") > \"x\";", "write to a file"},
      {"Printf(\"a %g\", 3) >> \"x\";", "write to a file"},
      {"Error(\"a\") > name;", "write to a file"},
      {"Exit;", "end the program"},
      {"If (1) Exit; EndIf", "end the program"},
      {"Abort;", "end the program"},
      {"OnelabRun(\"a\", \"b\");", "ONELAB"},
      {"SetNumber(\"Solver.AutoMesh\", 1);", "ONELAB"},
      {"a = GetEnv(\"HOME\");", "environment"},
      {"a = GetValue(\"size?\", 1);", "terminal"},
      {"a() = ListFromFile(\"/etc/passwd\");", "other files"},
      {"S2N[\"a\"] = 1;", "names of texts"},
      {"StringToName[\"a\"] = 1;", "names of texts"},
      {"Solver.Executable0 = \"x\";", "option"},
      {"General.ErrorFileName = \"x\";", "option"},
      {"Geometry.DoubleClickedPointCommand = \"x\";", "option"},
      {"PostProcessing.DoubleClickedGraphPointCommand = \"x\";", "option"},
      {"View[0].Format = \"x\";", "option"},
      {"Plugin(Crack).Run;", "plugin"},
      {"Plugin(HomologyComputation).Filename = \"x\";", "plugin"},
      {"Field[1] = Structured;", "size field"},
      {"Remesh 3;", "command 'Remesh'"},
      {"Frobnicate \"x\";", "command 'Frobnicate'"},
      {"name = \"rm\"; Frobnicate Str(name);", "command 'Frobnicate'"},
      {"Include \"/etc/passwd\";", "outside"},
      {"Include \"../other.geo\";", "outside"},
      {"Include StrCat(\"../\", \"other.geo\");", "in quotes"},
      {"Merge name;", "in quotes"},
      {"Include \"missing.geo\";", "no file"}};
  for (const auto& [script, reason] : refused)
    EXPECT_THAT(said_of("// first line\n  " + script + "\n"),
                AllOf(HasSubstr("part.geo:2:"), HasSubstr(reason)))
        << script;
}

// The check is a courtesy that names a place; what holds is the restriction by the system (ReaderSandbox).
// What this scanner cannot be sure to split as Gmsh does is refused whatever it says, geometry too.
TEST_F(Scripts, WhatCannotBeSplitWithCertaintyIsRefused) {
  const std::string long_text(1100, 'x');
  const std::vector<std::pair<std::string, std::string>> refused = {
      {"a = \"" + long_text + "\";", "longer than"},
      {"a = \"Else\";", "'Else'"},
      {"a = \"b//c\";", "'//'"},
      {"a = 1; /* of\n two lines */", "several lines"},
      {"a = 1; // b\rb = 2;", "carriage return"},
      {"a = \"b\nc\";", "no end"},
      {"a = 'b", "no end"},
      {"/* never closed", "no end"},
      {"a = \"%x\";", "format"},
      {"a = \"%00001f\";", "format"},
      {"a = 1;\x01", "character"}};
  for (const auto& [script, reason] : refused)
    EXPECT_THAT(said_of(script + "\n"), AllOf(HasSubstr("part.geo"), HasSubstr(reason))) << script;
}

TEST_F(Scripts, AnIncludedFileIsCheckedAsItsIncluder) {
  write("inner.geo", "Point(1) = {0,0,0};\nSystem \"touch x\";\n");
  EXPECT_THAT(said_of("Include \"inner.geo\";\n"), AllOf(HasSubstr("inner.geo:2:1"), HasSubstr("command")));
  write("sizes.pos", "View \"a\" {};\nSave \"x\";\n");
  EXPECT_THAT(said_of("Merge \"sizes.pos\";\n"), AllOf(HasSubstr("sizes.pos:2:1"), HasSubstr("write files")));
  EXPECT_EQ(said_of("Include \"part.geo\";\n"), "nothing") << "a circle is Gmsh's to report";
  fs::create_symlink("/etc/passwd", folder_ / "link.geo");
  EXPECT_THAT(said_of("Include \"link.geo\";\n"), HasSubstr("outside"));
}

TEST_F(Scripts, NothingIsRunByReadingAMesh) {
  const std::string square = k_square;
  EXPECT_THROW(mesh::read_mesh(write("a.geo", square + "SystemCall \"touch " + victim() + "\";\n"), 1),
               InputError);
  EXPECT_FALSE(made("victim"));
  for (const char* file : {"a.msh", "a.txt", "a.pos", "a", "a.MSH", "a.Step", "a.opt", "a.py"})
    EXPECT_THROW(mesh::read_mesh(write(file, square), 1), InputError) << file << " is read as a script";

  write("b.geo", square);
  EXPECT_NO_THROW(mesh::read_mesh((folder_ / "b.geo").string(), 1));
  write("b.geo.opt", "Mesh.MeshSizeMax = 2;\n");
  EXPECT_THROW(mesh::read_mesh((folder_ / "b.geo").string(), 1), InputError);
}

TEST_F(Scripts, ATrustedScriptRuns) {
  mesh::MeshSource source;
  source.path = write("a.geo", std::string(k_square) + "SystemCall \"touch " + victim() + "\";\n");
  source.trust_script = true;
  EXPECT_EQ(mesh::read_mesh(source).dimension, 2);
  EXPECT_TRUE(made("victim"));
}

TEST_F(Scripts, OneLineWithoutItsEndIsReadLikeAnyOther) {
  const std::string one_line =
      "SetFactory('OpenCASCADE'); Rectangle(1) = {0, 0, 0, 10, 10}; Physical Surface('part') = {1};";
  const mesh::RawMesh open = mesh::read_mesh(write("a.geo", one_line), 1),
                      closed = mesh::read_mesh(write("b.geo", one_line + "\n"), 1);
  EXPECT_EQ(open.x.size(), closed.x.size());
  EXPECT_TRUE(open.groups.contains("part"));
}

TEST_F(Scripts, AFileIsWhatItsNameAndItsFirstBytesSay) {
  const auto said = [&](const std::string& file, const std::string& content) {
    try {
      mesh::file_format(write(file, content));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("known");
  };
  EXPECT_EQ(said("a.msh", "$MeshFormat\n4.1 0 8\n"), "known");
  EXPECT_EQ(said("a.stp", "ISO-10303-21;\nHEADER;\n"), "known");
  EXPECT_EQ(said("a.unv", "    -1\n  2411\n"), "known");
  EXPECT_THAT(said("a.msh", "Point(1) = {0,0,0};\n"),
              AllOf(HasSubstr("not what its name says"), HasSubstr(".msh")));
  EXPECT_THAT(said("a.geo", "$MeshFormat\n4.1 0 8\n"), HasSubstr("not what its name says"));
  EXPECT_THAT(said("a.med", "Point(1) = {0,0,0};\n"), HasSubstr("HDF5"));
  EXPECT_THAT(said("a.xyz", "1 2 3\n"), AllOf(HasSubstr("'.xyz'"), HasSubstr(".msh, .geo")));
  EXPECT_THAT(said("mesh", "1 2 3\n"), HasSubstr("no ending"));
}

}  // namespace
