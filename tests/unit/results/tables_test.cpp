#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <map>
#include <regex>

#include "mesh/making/parametric_meshes.hpp"
#include "results/formats/pvd.hpp"
#include "results/load_balance.hpp"
#include "results/output/csv.hpp"
#include "results/output/json_document.hpp"
#include "results/summary.hpp"
#include "results/tables/step_columns.hpp"
#include "sample.hpp"
#include "system/processes.hpp"
#include "vtu_reader.hpp"

namespace solidus::results {
namespace {

const std::vector<CsvColumn> k_columns = {{"time", "s"}, {"T_center", "degC"}};

std::vector<CsvCell> row(double time, double value) {
  return {time, value};
}

TEST(CsvTable, HasUnitsInItsHeaderAndARowPerLine) {
  test::TemporaryFolder folder;
  CsvTable table(folder.path / "history.csv", k_columns);
  table.add(row(0, 670));
  table.add(row(1, 659.5));
  // Read while the table is still open: rows are there as soon as they are added.
  EXPECT_EQ(test::read_text(folder.path / "history.csv"), "time[s],T_center[degC]\n0,670\n1,659.5\n");
}

TEST(CsvTable, NumbersReadBackAsTheSameBits) {
  for (const double x : {1.0 / 3.0, 6.02214076e23, -2.3e-307, 659.85000000000002, 1e300, 0.1})
    EXPECT_EQ(std::stod(number_text(x)), x) << number_text(x);
  EXPECT_EQ(number_text(-0.0), "0");
}

TEST(CsvTable, QuotesTextThatHoldsCommasOrQuotes) {
  EXPECT_EQ(csv_text("as asked"), "as asked");
  EXPECT_EQ(csv_text("cut, because \"heat\" failed"), "\"cut, because \"\"heat\"\" failed\"");
}

TEST(CsvTable, NamesTheColumnWhoseValueIsNotANumber) {
  test::TemporaryFolder folder;
  CsvTable table(folder.path / "history.csv", k_columns);
  try {
    table.add(row(0, std::numeric_limits<double>::quiet_NaN()));
    FAIL() << "must throw";
  } catch (const NotFiniteError& error) {
    EXPECT_STREQ(error.what(), "column 'T_center[degC]' is not finite; it is not written to the results");
  }
  EXPECT_EQ(test::read_text(folder.path / "history.csv"), "time[s],T_center[degC]\n");
}

TEST(CsvTable, GoesOnAfterARestartWithoutLaterOrHalfRows) {
  test::TemporaryFolder folder;
  const auto path = folder.path / "history.csv";
  std::ofstream(path) << "time[s],T_center[degC]\n0,670\n1,660\n2,650\n3,64";
  CsvTable(path, k_columns, 5.0).add(row(6, 600));
  EXPECT_EQ(test::read_text(path), "time[s],T_center[degC]\n0,670\n1,660\n2,650\n6,600\n");
  CsvTable(path, k_columns, 1.0).add(row(2, 655));
  EXPECT_EQ(test::read_text(path), "time[s],T_center[degC]\n0,670\n1,660\n2,655\n");
  EXPECT_THROW(CsvTable(path, {{"time", "s"}, {"other", "K"}}, 1.0), OutputError);
  EXPECT_THROW(CsvTable(folder.path / "none.csv", k_columns, 1.0), OutputError);
}

TEST(CsvTable, SaysWhichFileDoesNotFitOnTheDisk) {
  // The header already fails: it is handed to the system at once.
  try {
    CsvTable table("/dev/full", k_columns);
    FAIL() << "must throw";
  } catch (const OutputError& error) {
    EXPECT_STREQ(error.what(), "/dev/full: cannot write: No space left on device");
    EXPECT_EQ(error.where().file, "/dev/full");
  }
}

TEST(CsvTable, SaysWhichFolderIsNotThere) {
  test::TemporaryFolder folder;
  try {
    CsvTable table(folder.path / "none" / "history.csv", k_columns);
    FAIL() << "must throw";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot open for writing: No such file or directory"),
              std::string::npos);
  }
}

TEST(PvdCollection, IsWholeAfterEveryAddition) {
  test::TemporaryFolder folder;
  const auto path = folder.path / "fields.pvd";
  PvdCollection collection(path);
  collection.add(0, "fields/fields_00000.vtu");
  EXPECT_NE(test::read_text(path).find("</VTKFile>"), std::string::npos);
  collection.add({{0.1, 0, "fields/fields_00001.vtu"}, {0.1, 1, "fields/surface_a_00001.vtu"}});
  EXPECT_EQ(test::read_text(path), R"(<?xml version="1.0"?>
<VTKFile type="Collection" version="0.1">
  <Collection>
    <DataSet timestep="0" part="0" file="fields/fields_00000.vtu"/>
    <DataSet timestep="0.1" part="0" file="fields/fields_00001.vtu"/>
    <DataSet timestep="0.1" part="1" file="fields/surface_a_00001.vtu"/>
  </Collection>
</VTKFile>
)");
  PvdCollection again(path, 0.05);
  ASSERT_EQ(again.entries().size(), 1U);
  again.add(0.2, "fields/fields_00001.vtu");
  EXPECT_EQ(PvdCollection(path, 1).entries()[1].time, 0.2);
}

TEST(PvdCollection, KeepsItsOldContentWhenTheDiskIsFull) {
  test::TemporaryFolder folder;
  const auto path = folder.path / "fields.pvd";
  PvdCollection collection(path);
  collection.add(0, "a.vtu");
  const std::string before = test::read_text(path);
  std::filesystem::create_symlink("/dev/full", path.string() + ".part");
  EXPECT_THROW(collection.add(1, "b.vtu"), OutputError);
  EXPECT_EQ(test::read_text(path), before);
  EXPECT_EQ(collection.entries().size(), 1U);
}

TEST(Json, WritesEveryKindOfValue) {
  Json json;
  json.add("flag", true).add("count", 3).add("x", 0.5).add("text", "a \"b\"\n\\ \x01");
  json.add("list", Json::Array{1, 2.5, "c"}).add("none", Json::Array{}).add("object", Json().add("y", 1));
  EXPECT_EQ(json.text(), R"({
  "flag": true,
  "count": 3,
  "x": 0.5,
  "text": "a \"b\"\n\\ \u0001",
  "list": [
    1,
    2.5,
    "c"
  ],
  "none": [],
  "object": {
    "y": 1
  }
}
)");
}

TEST(Json, NamesTheMemberThatIsNotANumber) {
  Json json;
  json.add("final", Json().add("T", std::numeric_limits<double>::infinity()));
  try {
    json.text();
    FAIL() << "must throw";
  } catch (const NotFiniteError& error) {
    EXPECT_NE(std::string(error.what()).find("'final.T'"), std::string::npos);
  }
}

TEST(Summary, SaysHowTheRunWent) {
  mesh::Mesh mesh = test::triangles_and_quad();
  const int rank = processes::rank();
  if (rank > 0) mesh.blocks.clear();  // process 0 counts all elements
  Summary summary;
  summary.case_file = "cases/a/case.toml";
  summary.outcome = "finished";
  summary.mesh = count(mesh);
  summary.steps = 90;
  summary.seconds = {{"total", 12.5}, {"heat", 3.0}};
  summary.memory = peak_memory();
  summary.final_values = {{"T_center[degC]", 312.5}};
  summary.warnings = {"aluminium was used at 950 K, its data end at 933 K"};
  const std::string text = summary_json(summary);
  for (const char* piece :
       {R"("nodes": 6)", R"("tri3": 2)", R"("quad4": 1)", R"("part": 2)", R"("mould": 1)", R"("steps": 90)",
        R"("T_center[degC]": 312.5)", R"("aluminium was used at 950 K, its data end at 933 K")"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << " in\n" << text;
  // A test program of this size needs more than a megabyte and less than four gigabytes.
  EXPECT_GT(summary.memory.largest, 1e6);
  EXPECT_LT(summary.memory.largest, 4e9);
  EXPECT_GE(summary.memory.sum, summary.memory.largest);
  EXPECT_GE(summary.memory.largest, summary.memory.first);
}

TEST(Summary, NamesStepsWhoseAugmentationsDidNotConvergeAlsoByTheirEarlierKey) {
  Summary summary;
  EXPECT_EQ(summary_json(summary).find("augmentations_that_did_not_converge"), std::string::npos);
  summary.unsettled = {{"wall", 3, 2e-4}};
  const std::string text = summary_json(summary);
  for (const char* key : {"augmentations_that_did_not_converge", "turns_that_did_not_settle"}) {
    const std::string members = fmt::format(R"(  "{}": {{
    "wall": {{
      "steps": 3,
      "largest_penetration_over_face": 0.0002
    }}
  }})",
                                            key);
    EXPECT_NE(text.find(members), std::string::npos) << members << " in\n" << text;
  }
}

TEST(Balance, IsTheLargestOverTheMean) {
  const int rank = processes::rank(), n_processes = processes::count();
  EXPECT_DOUBLE_EQ(largest_over_mean(0), 1);
  EXPECT_DOUBLE_EQ(largest_over_mean(2.5), 1);
  // 1, 2, … n: n over (n + 1)/2.
  EXPECT_DOUBLE_EQ(largest_over_mean(1.0 + rank), 2.0 * n_processes / (n_processes + 1));
}

TEST(Balance, CountsTheElementsThatSeveralProcessesCompute) {
  const int n_processes = processes::count();
  mesh::RawMesh raw = mesh::make_block({{1, 0.1}, {0, 0}, {40, 2}}, mesh::Shape::quad4);
  const mesh::Mesh mesh = mesh::distribute(raw, {"block"}, {});
  const Balance even = balance(mesh, {{"assembly", 2.0}});
  EXPECT_DOUBLE_EQ(even.largest_over_mean.back().second, 1);
  // A strip is cut across: each seam is a column of two elements.
  EXPECT_NEAR(even.computed_again, (n_processes - 1) * 2 / 80.0, 1.5 * (n_processes - 1) / 80);
}

coupling::StepRecord sample_step() {
  coupling::StepRecord record;
  record.number = 3;
  record.time = 3;
  record.dt = 1;
  record.reason = "as asked";
  record.solid_fraction = 0.25;
  record.min_temperature = 473.15;
  record.max_temperature = 943.15;
  record.energy.stored_heat = -10;
  record.energy.heat_in = -9;
  record.energy.work = 0.5;
  record.energy.heat_exchanged = 30;
  record.contacts = {{3, 4, 100.0, 2.0}, {0, 4, 5.0, 0.0}};
  return record;
}

TEST(StepColumns, FitTheRow) {
  const auto columns = step_columns();
  const auto cells = step_row(sample_step());
  ASSERT_EQ(columns.size(), cells.size());
  EXPECT_EQ(columns.front().header(), "time[s]");
  EXPECT_EQ(columns.back().header(), "energy_defect[J]");
  EXPECT_DOUBLE_EQ(std::get<double>(cells.back()), -1.5);
}

TEST(StepColumns, LeaveTheFirstLawOutWhereHeatIsNotFollowed) {
  const auto columns = step_columns({.heat = false});
  ASSERT_EQ(columns.size(), step_row(sample_step(), {.heat = false}).size());
  EXPECT_EQ(columns.size(), step_columns().size() - 5);
  GlobalHistory history({.heat = false});
  for (const auto& shown : {columns, history.columns()})
    for (const CsvColumn& column : shown)
      for (const char* name : {"energy_defect[J]", "stored_heat[J]", "heat_in[J]", "structural_energy[J]"})
        EXPECT_NE(column.header(), name);
}

TEST(GlobalHistory, GivesTheHeatOfAPairByItsSides) {
  GlobalHistory::Options options;
  options.pairs.push_back({.name = "pad", .friction = true, .heat = true});
  GlobalHistory history(options);
  coupling::StepRecord step = sample_step();
  step.contacts = {{.heat = 100, .heat_to_slave = -70, .heat_to_master = 130}};
  history.add(step);
  std::map<std::string, double> by_header;
  const auto columns = history.columns();
  for (std::size_t i = 0; i < columns.size(); ++i) by_header[columns[i].header()] = history.values()[i];
  EXPECT_DOUBLE_EQ(by_header.at("pad_conducted_heat[W]"), 100);
  EXPECT_DOUBLE_EQ(by_header.at("pad_frictional_heat[W]"), 60);
  EXPECT_DOUBLE_EQ(by_header.at("pad_heat_to_slave[W]"), -70);
  EXPECT_DOUBLE_EQ(by_header.at("pad_heat_to_master[W]"), 130);
}

TEST(StepColumns, GiveTheIncrementsOfTheFunctionalWhereItIsFollowed) {
  coupling::StepRecord step = sample_step();
  step.stability = {.mechanical = -2, .thermal = 0.5, .entropy = 7, .tolerance = 1e-3};
  step.energy.entropy_in = 2;
  const auto columns = step_columns({.stability = true});
  const auto cells = step_row(step, {.stability = true});
  ASSERT_EQ(columns.size(), cells.size());
  std::map<std::string, double> by_header;
  for (std::size_t i = columns.size() - 5; i < columns.size(); ++i)
    by_header[columns[i].header()] = std::get<double>(cells[i]);
  const std::map<std::string, double> expected = {{"lyapunov_mechanical[J]", -2},
                                                  {"lyapunov_thermal[J]", 0.5},
                                                  {"lyapunov_tolerance[J]", 1e-3},
                                                  {"entropy[J/K]", 7},
                                                  {"entropy_production[J/K]", 5}};
  EXPECT_EQ(by_header, expected);
}

TEST(GlobalHistory, SumsTheFunctionalAndGivesItsLastIncrements) {
  GlobalHistory history({.stability = true});
  coupling::StepRecord step = sample_step();
  step.stability = {.mechanical = -2, .thermal = 0.5, .entropy = 7};
  step.energy.entropy_in = 2;
  history.start({}, {}, {.mechanical = -10, .thermal = 1, .entropy = 3});  // a run that goes on
  history.add(step);
  history.add(step);
  const auto columns = history.columns();
  const auto values = history.values();
  std::map<std::string, double> by_header;
  for (std::size_t i = 0; i < columns.size(); ++i) by_header[columns[i].header()] = values[i];
  EXPECT_DOUBLE_EQ(by_header.at("lyapunov[J]"), -12.0);
  EXPECT_DOUBLE_EQ(by_header.at("lyapunov_mechanical[J]"), -2.0);
  EXPECT_DOUBLE_EQ(by_header.at("lyapunov_thermal[J]"), 0.5);
  EXPECT_DOUBLE_EQ(by_header.at("entropy[J/K]"), 17.0);
  EXPECT_DOUBLE_EQ(by_header.at("entropy_production[J/K]"), 13.0);
  EXPECT_EQ(history.columns().size(), GlobalHistory({}).columns().size() + 5);
}

TEST(GlobalHistory, SumsTheFirstLawOverTheSteps) {
  GlobalHistory history({true, true, true});
  history.start({});
  history.add(sample_step());
  history.add(sample_step());
  const auto columns = history.columns();
  const auto values = history.values();
  ASSERT_EQ(columns.size(), values.size());
  const auto value = [&](const std::string& header) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].header() == header) return values[i];
    ADD_FAILURE() << header;
    return 0.0;
  };
  EXPECT_DOUBLE_EQ(value("solid_fraction[1]"), 0.25);
  EXPECT_DOUBLE_EQ(value("closed_fraction[1]"), 3.0 / 8.0);
  EXPECT_DOUBLE_EQ(value("contact_heat[W]"), 105.0);
  EXPECT_DOUBLE_EQ(value("stored_heat[J]"), -20.0);
  EXPECT_DOUBLE_EQ(value("energy_defect[J]"), -3.0);
  EXPECT_DOUBLE_EQ(value("T_min[degC]"), 200.0);
  EXPECT_DOUBLE_EQ(history.relative_defect(), 3.0 / 60.0);
}

TEST(GlobalHistory, MeasuresTheDefectOfARunAtRestAgainstItsHeatContent) {
  coupling::StepEffort rounding;
  rounding.energy.stored_heat = 2e-13;
  rounding.energy.heat_exchanged = 1e-13;
  GlobalHistory history({});
  history.start({}, {}, {}, 1e6);
  history.add(rounding);
  EXPECT_DOUBLE_EQ(history.relative_defect(), 2e-13);  // of 1e-6 of the content, 1 J
  rounding.energy.structural = 4;                      // 4 J that have gone into elastic energy
  history.add(rounding);
  EXPECT_NEAR(history.relative_defect(), 1, 1e-12);
  history.start({});  // nothing there at all
  EXPECT_EQ(history.relative_defect(), 0);
}

TEST(GlobalHistory, ShowsWhereThePlasticWorkWent) {
  GlobalHistory history({.plastic = true});
  coupling::StepRecord step = sample_step();
  step.energy.viscous_dissipation = 1;
  step.energy.plastic_dissipation = 4;
  step.energy.plastic_work = 5;
  history.add(step);
  history.add(step);
  const auto columns = history.columns();
  const auto values = history.values();
  std::map<std::string, double> by_header;
  for (std::size_t i = 0; i < columns.size(); ++i) by_header[columns[i].header()] = values[i];
  EXPECT_DOUBLE_EQ(by_header.at("viscous_dissipation[J]"), 2.0);
  EXPECT_DOUBLE_EQ(by_header.at("plastic_dissipation[J]"), 8.0);
  EXPECT_DOUBLE_EQ(by_header.at("plastic_work[J]"), 10.0);
  EXPECT_DOUBLE_EQ(by_header.at("hardening_energy[J]"), 2.0);
  EXPECT_EQ(GlobalHistory({}).columns().size(), columns.size() - 4);  // and the inelastic entropy
}

TEST(GlobalHistory, LeavesOutWhatAProbeGivesUnderTheSameHeader) {
  const GlobalHistory history({true, true, true}, {{"solid_fraction", "1"}, {"T_min", "K"}});
  EXPECT_EQ(history.columns().size(), history.values().size());
  EXPECT_EQ(history.columns().size(), GlobalHistory({true, true, true}).columns().size() - 1);
}

TEST(GlobalHistory, HasNoColumnsOfPhysicsThatIsNotThere) {
  const GlobalHistory history({false, false, false});
  EXPECT_EQ(history.columns().size(), history.values().size());
  for (const CsvColumn& column : history.columns()) {
    EXPECT_EQ(column.name.find("contact"), std::string::npos);
    EXPECT_NE(column.name, "work");
    EXPECT_NE(column.name, "solid_fraction");
  }
}

TEST(GlobalHistory, ShowsTheForcesOfEveryPair) {
  GlobalHistory history({.pairs = {{"brake", true, false, AnalysisKind::plane_strain},
                                   {"rest", false, false, AnalysisKind::solid}}});
  coupling::StepEffort step;
  coupling::ContactSummary brake;
  brake.closed_points = 8;
  brake.sticking_points = 2;
  brake.force = 100;
  brake.friction = 30;
  brake.resultant = {30, -100, 0};
  brake.moment = {0, 0, 5};
  brake.dissipation = 0.25;
  coupling::ContactSummary rest;
  rest.resultant = {1, 2, 3};
  step.contacts = {brake, rest};
  history.add(step);
  std::map<std::string, double> shown;
  for (const auto& [column, value] : history.all()) shown[column.header()] = value;
  EXPECT_EQ(shown.at("brake_normal_force[N]"), 100);
  EXPECT_EQ(shown.at("brake_friction_force[N]"), 30);
  EXPECT_EQ(shown.at("brake_sticking_fraction[1]"), 0.25);
  EXPECT_EQ(shown.at("brake_friction_dissipation[J]"), 0.25);
  EXPECT_EQ(shown.at("brake_force_y[N]"), -100);
  EXPECT_EQ(shown.at("brake_moment_z[N m]"), 5);
  EXPECT_EQ(shown.at("rest_force_z[N]"), 3);
  EXPECT_EQ(shown.count("rest_friction_force[N]"), 0u);
}

}  // namespace
}  // namespace solidus::results
