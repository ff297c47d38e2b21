/// The verb `point`: a material point through a history, its tables and the data of the pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "app/case_arguments.hpp"
#include "app/places.hpp"
#include "app/verb.hpp"
#include "cases/case_materials.hpp"
#include "cases/overrides.hpp"
#include "material/cards/library.hpp"
#include "material/external_law.hpp"
#include "numbers/types.hpp"
#include "point/check_law.hpp"
#include "point/point_case.hpp"
#include "results/output/csv.hpp"
#include "results/output/json_document.hpp"
#include "results/output/output_file.hpp"
#include "results/output/run_folder.hpp"
#include "system/processes.hpp"
#include "system/version.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;
using point::Curve;
using point::MaterialPointRecord;
using point::PointCase;
using results::Json;

constexpr const char* k_marker =
    "# Written by Solidus: the point file as it was run, all defaults filled in.";

/// A table as one text: a file is written whole or not at all.
std::string table(const std::vector<MaterialPointRecord>& records) {
  std::string text;
  for (const point::RecordColumn& column : point::columns())
    text += (text.empty() ? "" : ",") + column.header();
  // Every record is a row, with the columns of the heading; a number that is not finite is a bug
  // and no result.
  for (const MaterialPointRecord& record : records) {
    text += '\n';
    const char* separator = "";
    for (const point::RecordColumn& column : point::columns()) {
      const double value = column.shown(record);
      if (!std::isfinite(value)) throw results::NotFiniteError("column '" + column.header() + "'", {});
      text += separator + results::number_text(value);
      separator = ",";
    }
  }
  return text + "\n";
}

std::string table(const point::Measured& measured) {
  std::string text;
  for (const point::RecordColumn* column : measured.columns)
    text += (text.empty() ? "" : ",") + column->header();
  for (const std::vector<double>& row : measured.rows) {
    text += '\n';
    for (std::size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + results::number_text(row[i]);
  }
  return text + "\n";
}

/// Makes the folder, unless it holds files that Solidus did not write.
void prepare(const fs::path& folder, const PointCase& point_case, const std::string& file) {
  // A folder that has such a file from elsewhere is left alone.
  const fs::path echo = folder / "point.toml";
  std::string first_line;
  std::ifstream in(echo);
  const bool ours = static_cast<bool>(std::getline(in, first_line)) && first_line == k_marker;
  if (!ours)
    for (const char* name : {"point.toml", "case.toml", "summary.json"})
      if (fs::exists(folder / name))
        throw results::OutputError(folder.string(),
                                   fmt::format("this folder holds a {} of something else", name),
                                   "choose another folder with -o");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw results::OutputError(folder.string(), "cannot make the results folder: " + error.message(),
                               "choose another folder with -o");
  // The point file itself goes into the folder, with defaults filled in.
  results::write_file(
      echo, fmt::format("{}\n# from {}\n{}", k_marker, fs::absolute(file).lexically_normal().string(),
                        to_toml(point_case.document)));
}

/// Returns a warning about properties whose data do not hold at the temperatures of the history; empty: there
/// are none. Throws InputError for a table whose extrapolation is an error.
std::string warning(const Curve& curve, const std::vector<MaterialPointRecord>& records) {
  // The coldest and the hottest state of the history decide.
  const auto [coldest, hottest] = std::minmax_element(
      records.begin(), records.end(), [](const MaterialPointRecord& a, const MaterialPointRecord& b) {
        return a.temperature < b.temperature;
      });
  constexpr double k_rounding = 1e-6;  // [K], of a conversion from degC
  const auto celsius = [](double kelvin) { return fmt::format("{:.6g}", kelvin - k_zero_celsius); };
  std::string properties;
  for (const auto& range : material::left_ranges(curve.material, coldest->temperature + k_rounding,
                                                 hottest->temperature - k_rounding)) {
    const std::string text =
        fmt::format("{} ({} to {})", range.property, celsius(range.valid_from), celsius(range.valid_to));
    // The table itself may forbid what lies outside of it.
    if (range.refused)
      throw InputError(
          {}, fmt::format("{}: outside the data of '{}': {} degC", curve.name, curve.material.name, text),
          "its table has extrapolation = \"error\"");
    properties += (properties.empty() ? "" : ", ") + text;
  }
  if (properties.empty()) return {};
  return fmt::format("{}: from {} to {} degC, outside the data of {}", curve.name,
                     celsius(coldest->temperature), celsius(hottest->temperature), properties);
}

Json list(const std::vector<std::string>& texts) {
  Json::Array array;
  for (const std::string& text : texts) array.emplace_back(text);
  return array;
}

Json picture_entry(const point::PictureSpec& picture) {
  Json entry;
  entry.add("file", picture.file).add("title", picture.title).add("x", picture.x);
  entry.add("y", list(picture.y)).add("logarithmic", list(picture.logarithmic));
  return entry;
}

/// One line of the overview on the terminal.
std::string line(const Curve& curve, const point::History& history) {
  double peak = 0;
  int iterations = 0;
  for (const MaterialPointRecord& r : history.records) {
    peak = std::max(peak, von_mises(r.stress));
    iterations = std::max(iterations, r.iterations);
  }
  const MaterialPointRecord& last = history.records.back();
  return fmt::format("  {:<24} {:>6} {:>12.6g} {:>10.5g} {:>14.5g} {:>12.4g} {:>12.4g} {:>10}\n", curve.name,
                     history.records.size() - 1, last.time, last.temperature - k_zero_celsius, 1e-6 * peak,
                     1e-6 * von_mises(last.stress), last.equivalent_plastic, iterations);
}

struct Summary {
  Json::Array curves;
  std::string lines, notes, failures;
};

void write_curve(const Curve& curve, const point::History& history, const fs::path& folder,
                 Summary& summary) {
  // One curve gives a table, an entry of the summary, and its lines on the terminal. A history that stopped
  // is written as far as it came.
  const std::string outside = warning(curve, history.records);
  results::write_file(folder / (curve.name + ".csv"), table(history.records));
  // The summary has an entry for each curve, of the same numbers as the table.
  Json entry;
  entry.add("name", curve.name).add("label", curve.label).add("material", curve.material.name);
  entry.add("file", curve.name + ".csv").add("steps", history.records.size() - 1);
  entry.add("finished", history.finished);
  if (!history.finished) {
    entry.add("reason", history.reason);
    summary.failures += fmt::format("{}: {}\n", curve.name, history.reason);
  }
  if (!outside.empty()) {
    entry.add("warning", outside);
    summary.notes += "  warning: " + outside + "\n";
  }
  summary.lines += line(curve, history);
  // Measured curves are written next to the computed one, with the deviation of each column.
  if (curve.measured) {
    const std::string file = curve.name + "_measured.csv";
    results::write_file(folder / file, table(*curve.measured));
    entry.add("measured", file);
    Json::Array fits;
    for (const point::Deviation& d : point::deviations(*curve.measured, history.records)) {
      Json fit;
      fit.add("column", d.column->header()).add("rms", d.rms).add("largest_measured", d.largest);
      fits.emplace_back(std::move(fit.add("points", d.points)));
      summary.notes +=
          fmt::format("  {}: {} deviates by {:.4g} {} (rms of {} points, largest measured {:.4g})\n",
                      curve.name, d.column->name, d.rms, d.column->unit, d.points, d.largest);
    }
    entry.add("deviations", std::move(fits));
  }
  summary.curves.emplace_back(std::move(entry));
}

/// Reads the point file, and loads the laws from outside of its materials.
struct PointArguments {
  std::string path;              ///< a point file, or a folder with a point.toml
  std::vector<std::string> set;  ///< "path=value"
  std::string output;            ///< results folder; empty: by the file
};

PointCase load_point_case(const PointArguments& arguments, const fs::path& file) {
  if (processes::count() > 1)
    throw InputError({}, "a point runs on one process", "solidus point without mpirun");
  Value document = load_document(file);
  for (const std::string& assignment : arguments.set) cases::apply_override(document, assignment);
  const auto library = cases::material_folders();
  PointCase point_case = point::make_point_case(std::move(document), library);
  for (Curve& curve : point_case.curves)
    if (const material::ExternalLaw* law = external_law(curve.material))
      set_external_law(curve.material, material::load_external_law(curve.material, *law));
  return point_case;
}

fs::path point_file(const PointArguments& arguments) {
  const fs::path file = arguments.path;
  return fs::is_directory(file) ? file / "point.toml" : file;
}

ExitCode run_point(const PointArguments& arguments) {
  const fs::path file = point_file(arguments);
  const PointCase point_case = load_point_case(arguments, file);
  const fs::path folder = arguments.output.empty() ? results_root() / results::default_run_folder(file)
                                                   : fs::path(arguments.output);
  // All are computed first, so that a mistake in one leaves no half folder.
  std::vector<point::History> histories;  // all of them before anything is written
  for (const Curve& curve : point_case.curves) histories.push_back(point::run(curve.material, curve.program));
  prepare(folder, point_case, file.string());
  Summary summary;
  for (std::size_t i = 0; i < histories.size(); ++i)
    write_curve(point_case.curves[i], histories[i], folder, summary);

  Json json;
  // The summary holds the same numbers as the table printed, for programs.
  json.add("kind", "point").add("program", "Solidus " + program_version()).add("title", point_case.title);
  json.add("curves", std::move(summary.curves));
  Json::Array pictures;
  for (const auto& picture : point_case.pictures) pictures.push_back(picture_entry(picture));
  json.add("pictures", std::move(pictures));
  results::write_file(folder / "summary.json", json.text());
  print(fmt::format("{}\n  {:<24} {:>6} {:>12} {:>10} {:>14} {:>12} {:>12} {:>10}\n{}{}",
                    point_case.title.empty() ? file.string() : point_case.title, "curve", "steps", "end [s]",
                    "[degC]", "peak Mises[MPa]", "end [MPa]", "plastic [1]", "iterations", summary.lines,
                    summary.notes));
  note_folder(folder);
  print("Results in " + folder.lexically_normal().string() + "\n");
  // Curves that stopped are told at the end, after their tables are written.
  if (summary.failures.empty()) return k_done;
  std::fputs(("solidus: " + summary.failures).c_str(), stderr);
  return k_cannot_continue;
}

/// The laws of a point file, checked along its histories (point/check_law.hpp); exit code 1 where one fails.
ExitCode check_point_laws(const PointArguments& arguments) {
  const fs::path file = point_file(arguments);
  const PointCase point_case = load_point_case(arguments, file);
  bool passed = true;
  std::string text;
  for (const Curve& curve : point_case.curves) {
    text += fmt::format("{}: the law of '{}'\n", curve.name, curve.material.name);
    for (const point::LawCheck& check : point::check_law(curve.material, curve.program)) {
      passed = passed && check.passed;
      text +=
          fmt::format("  {:<6} {:<12} {}\n", check.passed ? "passed" : "FAILED", check.name, check.finding);
    }
  }
  print(text);
  return passed ? k_done : k_bad_input;
}

class Point final : public Verb {
 public:
  explicit Point(CLI::App& program)
      : Verb(program, "point",
             "Take a point of a material through a history of strain, stress and temperature") {
    command().add_option("CASE", arguments_.path, "A point file, or a folder with a point.toml")->required();
    command()
        .add_option("--set", arguments_.set, "Change a key, for example --set temperature=\"300 degC\"")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command()
        .add_option("-o,--output", arguments_.output, "Folder of the results; default results/FOLDER/FILE")
        ->type_name("FOLDER");
    add_trust_laws(command());
    command().add_flag("--check-law", check_law_,
                       "Check the law along the history instead: tangent, energy, isotropy, repetition");
  }
  ExitCode run() override { return check_law_ ? check_point_laws(arguments_) : run_point(arguments_); }

 private:
  PointArguments arguments_;
  bool check_law_ = false;
};

}  // namespace

std::unique_ptr<Verb> point_verb(CLI::App& program) {
  return std::make_unique<Point>(program);
}

}  // namespace solidus::app
