/// The pictures of a run, drawn by python/solidus_plots from files that the library wrote.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "results/formats/field_output.hpp"
#include "results/output/csv.hpp"
#include "results/summary.hpp"
#include "results/tables/step_columns.hpp"
#include "sample.hpp"
#include "system/processes.hpp"
#include "vtu_reader.hpp"

namespace solidus::results {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_plots = R"(
[[curves]]
file = "wall"
quantity = "Temperature"
lines = [{ column = "T_wall[degC]", label = "wall" }]
levels = [{ value = 15, label = "liquidus" }]

[[maps]]
file = "temperature"
field = "temperature"
unit = "degC"
times = [0, 2]
mirror = true
magnification = 10

[[maps]]
file = "late"
field = "temperature"
times = [2, 99]

[[curves]]
file = "no_column"
lines = [{ column = "T[K]" }]

[[maps]]
file = "no_field"
field = "pressure"
times = [0]

[[deformed]]
file = "mesh"
mirror = true
magnification = 10
)";

struct Plots : ::testing::Test {
  test::SharedFolder folder;
  int code = -1;
  std::string said;

  Plots() {
    const int rank = processes::rank();
    const RunFolder run(folder.path, "");
    mesh::RawMesh raw;
    if (rank == 0) raw = mesh::make_block({{3, 2}, {}, {6, 4}, "part"}, mesh::Shape::quad4);
    const mesh::Mesh mesh = mesh::distribute(raw, {"part"}, {});
    std::vector<double> temperature, displacement;
    for (const mesh::Point& x : mesh.x) {
      temperature.push_back(300 + 10 * x[0]);
      displacement.insert(displacement.end(), {0.01 * x[0], -0.01 * x[1]});
    }
    FieldSet fields;
    fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
    fields.add({"displacement", "m", 2, mesh::FieldPlace::node, displacement});
    FieldOutput output(run, mesh);
    output.write(0, fields);
    output.write(2, fields);
    Summary summary;
    summary.mesh = count(mesh);
    test::on_first([&] {
      CsvTable history(run.history(), {{"time", "s"}, {"T_wall", "degC"}, {"heat_in", "J"}});
      CsvTable steps(run.steps(), step_columns());
      coupling::StepRecord record;
      for (int i = 1; i <= 3; ++i) {
        history.add(std::vector<double>{1.0 * i, 20.0 - i, 5.0 * i});
        record.time = i;
        record.dt = 1;
        record.heat.iterations = i;
        steps.add(step_row(record));
      }
      write_summary(run.summary(), summary);
    });
  }

  void draw(const std::string& plots) {
    const fs::path spec = folder.path / "spec.toml", log = folder.path / "log";
    std::ofstream(spec) << "automatic.draw = false\n" << plots;
    code =
        std::system(fmt::format("PYTHONPATH='{}/python' PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -W error "
                                "-m solidus_plots '{}' --plots '{}' >'{}' 2>&1",
                                SOLIDUS_SOURCE_DIR, folder.path.string(), spec.string(), log.string())
                        .c_str());
    said = test::read_text(log);
  }
};

TEST_F(Plots, AreDrawnAndWhatIsMissingIsNamed) {
  test::on_first([&] {
    draw(k_plots);
    EXPECT_EQ(code, 0) << said;
    for (const char* name : {"history_degC.png", "history_degC.svg", "history_J.png", "steps.png", "wall.svg",
                             "temperature.png", "late.png", "mesh.png"})
      EXPECT_GT(fs::exists(folder.path / "plots" / name) ? fs::file_size(folder.path / "plots" / name) : 0,
                5000U)
          << name << "\n"
          << said;
    EXPECT_NE(said.find("no fields were written at 99 s; there are those of 0, 2 s"), std::string::npos)
        << said;
  });
}

TEST_F(Plots, LayOverTheVariantsThatWereRunAndCutOffWhatBlewUp) {
  test::on_first([&] {
    const fs::path other = folder.path.string() + "_blown_up";
    fs::create_directories(other);
    {
      CsvTable history((other / "history.csv").string(), {{"time", "s"}, {"T_wall", "degC"}});
      for (int i = 1; i <= 3; ++i) history.add(std::vector<double>{1.0 * i, std::pow(-1e3, i)});
    }
    draw(R"(
[[curves]]
file = "wall"
only = ["nothing_like_this", "*"]
lines = [{ column = "T_wall[degC]", label = "wall" }]
name = "stable"
compare = [{ variant = "*_blown_up", label = "blown up" }, "*_never_run"]

[[curves]]
file = "of_others"
only = ["*_of_others"]
lines = [{ column = "T_wall[degC]" }]
)");
    fs::remove_all(other);
    EXPECT_EQ(code, 0) << said;
    const std::string picture = test::read_text(folder.path / "plots" / "wall.svg");
    for (const char* text : {">stable<", ">blown up<", ">wall<", ">18.0<"})
      EXPECT_NE(picture.find(text), std::string::npos) << text;
    EXPECT_EQ(picture.find(">never_run"), std::string::npos);
    EXPECT_EQ(picture.find("000<"), std::string::npos);  // the axis is that of 17 to 19 degC
    EXPECT_FALSE(fs::exists(folder.path / "plots" / "of_others.svg"));
  });
}

TEST_F(Plots, GraphsShowATableOverAColumnWithALineForEachCycle) {
  test::on_first([&] {
    {
      CsvTable table((folder.path / "cycles.csv").string(), {{"pass", ""}, {"way", "mm"}, {"force", "N"}});
      for (int pass = 1; pass <= 3; ++pass)
        for (int i = 0; i <= 4; ++i) table.add(std::vector<double>{1.0 * pass, 1.0 * i, 10.0 * pass + i});
    }
    draw(R"(
[[graphs]]
file = "within"
table = "cycles.csv"
x = "way[mm]"
lines = [{ column = "force[N]" }]
each = "pass"
values = [1, 3]
keep = { column = "way[mm]", share = 0.5 }

[[graphs]]
file = "over_passes"
table = "cycles.csv"
x = "pass"
x_quantity = "Passes"
part = "way[mm]"
lines = [{ column = "force[N]" }]

[[graphs]]
file = "no_column"
table = "cycles.csv"
x = "way"
lines = [{ column = "force[N]" }]
)");
    EXPECT_EQ(code, 0) << said;
    const std::string within = test::read_text(folder.path / "plots" / "within.svg");
    EXPECT_NE(within.find(">pass 1<"), std::string::npos);
    EXPECT_EQ(within.find(">pass 2<"), std::string::npos);
    EXPECT_NE(within.find(">pass 3<"), std::string::npos);
    EXPECT_EQ(within.find(">0.0<"), std::string::npos);  // the first half of the way was not kept
    EXPECT_NE(test::read_text(folder.path / "plots" / "over_passes.svg").find(">Passes<"), std::string::npos);
    EXPECT_NE(said.find("graphs 'no_column': no column way in cycles.csv; it has pass, way[mm], force[N]"),
              std::string::npos)
        << said;
  });
}

TEST_F(Plots, SaysWhichKeyItDoesNotKnow) {
  test::on_first([&] {
    draw("[[maps]]\nfile = \"a\"\nfeld = \"temperature\"\n");
    EXPECT_NE(code, 0);
    EXPECT_TRUE(
        fs::exists(folder.path / "plots" / "history_degC.png"));  // what is right is drawn all the same
    EXPECT_NE(said.find("unknown key 'feld' in [[maps]]; there are bodies, component"), std::string::npos)
        << said;
  });
}

}  // namespace
}  // namespace solidus::results
