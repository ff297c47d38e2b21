/// The tree of a run: summary, tables, bodies, fields, each with the names of its blocks.
#include "results/report/run_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#define BOOST_BIND_GLOBAL_PLACEHOLDERS  // boost 1.74 warns of its own header otherwise
#include <boost/property_tree/json_parser.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "coupling/all_fields.hpp"
#include "input/document.hpp"
#include "mechanics/quantities.hpp"
#include "numbers/index_casts.hpp"
#include "results/formats/pvd.hpp"
#include "results/output/output_error.hpp"
#include "results/output/quantity_json.hpp"
#include "results/report/moments.hpp"
#include "results/report/page_section.hpp"
#include "results/report/report_table.hpp"
#include "results/tables/all_tables.hpp"
#include "system/errors.hpp"
#include "system/input_file.hpp"

namespace solidus::results {

namespace fs = std::filesystem;
using results::Json;

namespace {

constexpr std::uintmax_t k_most_filling = 8'000'000;  ///< bytes of the files of a filling

std::string text_at(const Value& table, std::string_view section, std::string_view key) {
  const Value* inner = section.empty() ? &table : table.find(section);
  const Value* value = inner == nullptr ? nullptr : inner->find(key);
  return value != nullptr && value->is_text() ? value->text() : std::string();
}

Json point(const mesh::Point& x) {
  return Json::Array{x[0], x[1], x[2]};
}

/// The places of a body's nodes, axis by axis.
Json points(const std::vector<mesh::Point>& x, Blocks& blocks) {
  Json::Array axes;
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<float> along;
    along.reserve(x.size());
    for (const mesh::Point& p : x) along.push_back(static_cast<float>(p[i]));
    const Packed16 q = pack16({along});
    axes.push_back(q.words.empty() ? Json::Array{-1, q.low}
                                   : Json::Array{blocks.add(q.words), q.low, q.high});
  }
  return axes;
}

Json table_data(const ReportTable& table, Blocks& blocks) {
  Json out;
  out.add("rows", table.n_rows).add("rows_in_file", table.n_in_file);
  Json::Array columns;
  // Numbers go into the binary blocks, texts as they are.
  for (const TableColumn& column : table.columns) {
    Json c;
    c.add("header", column.header);
    if (column.texts.empty()) {
      c.add("block", blocks.add(double_bytes(column.numbers)));
    } else {
      Json::Array texts;
      for (const std::string& text : column.texts) texts.emplace_back(text);
      c.add("texts", std::move(texts));
    }
    columns.push_back(std::move(c));
  }
  out.add("columns", std::move(columns));
  return out;
}

/// Whether brackets outside of texts lie deeper in each other than `most`.
bool nested_deeper(std::string_view json, int most) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < json.size() && depth <= most; ++i) {
    const char c = json[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted)
      depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
  }
  return depth > most;
}

/// The text of summary.json, or of another file of JSON, where it is one.
std::string checked_summary(const fs::path& file) {
  const std::string text = read_text_file(file, {file.string(), 0, 0});
  constexpr int k_deepest = 64;  // the parser calls itself for each
  if (nested_deeper(text, k_deepest))
    throw InputError({file.string(), 0, 0}, "the JSON of the file is nested too deep");
  try {
    std::istringstream in(text);
    boost::property_tree::ptree tree;
    boost::property_tree::read_json(in, tree);
  } catch (const boost::property_tree::json_parser_error& error) {
    throw InputError({file.string(), static_cast<int>(error.line()), 0},
                     fmt::format("the file is no JSON: {}", error.message()));
  }
  return text;
}

/// The moments of fields.pvd whose files are there, and the files of surfaces at the last of them.
struct Collection {
  std::vector<ReportMoment> moments;
  std::vector<fs::path> surfaces;
};

Collection collection(const fs::path& folder, std::vector<std::string>& notes) {
  Collection found;
  // A run may have left no fields; then the page has tables only.
  const fs::path file = folder / results::k_collection;
  if (!fs::exists(file)) return found;
  require_readable(file, {file.string(), 0, 0});
  std::vector<results::PvdCollection::Entry> entries;
  try {
    entries = results::PvdCollection(file, std::numeric_limits<double>::infinity()).entries();
  } catch (const results::OutputError&) {
    throw InputError({file.string(), 0, 0}, "the collection of fields was not written by Solidus");
  }
  std::size_t missing = 0;
  std::map<double, std::vector<fs::path>> surfaces;
  // Volumes by time, surfaces of contact along with them; what is gone is counted and told.
  for (const auto& entry : entries) {
    const fs::path path = folder / entry.file;
    if (!fs::exists(path))
      missing += entry.part == 0;
    else if (entry.part == 0)
      found.moments.push_back({entry.time, path});
    else
      surfaces[entry.time].push_back(path);
  }
  // Missing files are told on the page.
  if (missing > 0)
    notes.push_back(
        fmt::format("{} of the field files that fields.pvd lists are not there any more.", missing));
  if (!surfaces.empty()) found.surfaces = surfaces.rbegin()->second;
  return found;
}

/// Fields and nodes of contact surfaces: what the bodies' files show as zero elsewhere.
struct ContactParts {
  std::set<std::string> fields;
  std::set<std::int64_t> nodes;
};

ContactParts contact_parts(const std::vector<fs::path>& files) {
  ContactParts parts;
  // Which fields of contact the files have, and which nodes.
  for (const fs::path& path : files) {
    const FieldFile file(path);
    for (const FieldFile::Piece& piece : file.pieces()) {
      for (const std::string& name : mesh::array_names(*piece.tree, "PointData")) {
        const quantities::Quantity* known = coupling::find_field(name);
        if (known != nullptr && known->of_contact()) parts.fields.insert(name);
      }
      // Files without numbers of nodes have nothing that the page could match.
      const auto* array = mesh::find_array(*piece.tree, "PointData", "node");
      if (array == nullptr) continue;
      for (const double number : piece.file->numbers(*array, piece.n_points))
        parts.nodes.insert(mesh::whole_number(number));
    }
  }
  return parts;
}

Json body_data(const BodyMesh& body, const std::vector<BodyMaterial>& names, const ReportOptions& options,
               Blocks& blocks, std::vector<std::string>& notes) {
  // Names and materials come from the summary, by the body's number.
  const auto number = as_size(body.number);
  const std::string name = number < names.size() ? names[number].body : fmt::format("body {}", number);
  Json out;
  out.add("name", name).add("nodes", body.x.size());
  if (number < names.size()) out.add("material", names[number].material);
  out.add("points", points(body.x, blocks)).add("numbers", blocks.add(rising_bytes(body.input_node)));
  const std::size_t n_cells = body.cells.size() / as_size(body.corners);
  out.add("corners", body.corners).add("simplices", n_cells);
  if (!body.triangles.empty()) {
    out.add("triangles", body.triangles.size() / 3).add("skin", blocks.add(rising_bytes(body.triangles)));
  }
  if (body.corners == 4 && n_cells > options.most_cells) {
    notes.push_back(fmt::format(
        "The body '{}' has {} tetrahedra: the page has its skin alone and cannot cut it.", name, n_cells));
    return out;
  }
  // Corner by corner: the first ones rise, each other one lies near the corner before it.
  const auto n = as_size(body.corners);
  std::vector<std::int32_t> first, others;
  for (std::size_t c = 0; c < n_cells; ++c) first.push_back(body.cells[n * c]);
  for (std::size_t k = 1; k < n; ++k)
    for (std::size_t c = 0; c < n_cells; ++c)
      others.push_back(body.cells[n * c + k] - body.cells[n * c + k - 1]);
  out.add("cells", Json::Array{blocks.add(rising_bytes(first)), blocks.add(small_bytes(others))});
  return out;
}

Json packed(const PackedValues& v) {
  if (v.block == -2) return Json::Array{-2};
  if (v.block == -1) return Json::Array{-1, v.low};
  return Json::Array{v.block, v.low, v.high, v.mask};
}

Json fields_data(const PackedMoments& packed_moments) {
  Json::Array columns;
  // Of each column its values at all times and, for elements, the extremes of each body.
  for (std::size_t k = 0; k < packed_moments.columns.size(); ++k) {
    const FieldColumn& column = packed_moments.columns[k];
    Json c;
    c.add("name", column.name).add("component", column.component).add("unit", column.unit);
    c.add("of_elements", column.of_elements).add("at_end", column.at_end);
    Json::Array values, extremes;
    for (const PackedValues& v : packed_moments.values[k]) values.push_back(packed(v));
    for (std::size_t m = 0; m < packed_moments.moments.size(); ++m) {
      Json::Array most;
      for (const Extremes& e : packed_moments.extremes[m][k])
        most.push_back(e.there ? Json(Json::Array{e.low, point(e.low_at), e.high, point(e.high_at)})
                               : Json(Json::Array{}));
      extremes.push_back(std::move(most));
    }
    c.add("values", std::move(values));
    if (column.of_elements) c.add("extremes", std::move(extremes));
    columns.push_back(std::move(c));
  }
  return columns;
}

/// The declarations of all fields that a page can show.
Json all_quantities() {
  Json::Array rows{results::json(mechanics::fields::k_first_principal_stress)};
  for (const quantities::Quantity* field : coupling::all_fields()) rows.push_back(results::json(*field));
  return rows;
}

/// What the program says of fields, columns and units.
void add_declarations(Json& out) {
  out.add("quantities", all_quantities())
      .add("units", results::shown_units_json())
      .add("unit_names", results::unit_names_json())
      .add("declared", results::tables_json());
}

void add_fields(Json& out, const fs::path& folder, const std::vector<BodyMaterial>& names,
                const ReportOptions& options, std::size_t most_bytes, Blocks& blocks,
                std::vector<std::string>& notes) {
  // The part of the page with the fields: meshes, columns, and the packed moments. Without field files the
  // page has tables alone.
  const Collection files = collection(folder, notes);
  if (files.moments.empty()) {
    notes.emplace_back("The run has written no fields: the page has its tables alone.");
    return;
  }
  const ContactParts contact = contact_parts(files.surfaces);
  const FieldFile first(files.moments.front().file);
  Bodies bodies(first);
  Json mesh;
  Json::Array all;
  for (const BodyMesh& body : bodies.all()) all.push_back(body_data(body, names, options, blocks, notes));
  mesh.add("dimension", bodies.dimension()).add("bodies", std::move(all));
  // Columns are those of the last file, since fields may begin late in a run.
  const std::vector<FieldColumn> columns =
      field_columns(FieldFile(files.moments.back().file), contact.fields);
  // As many moments are packed as the page may hold; a note says if some were left out.
  const PackedMoments moments =
      pack_moments(bodies, files.moments, columns, contact.nodes, most_bytes, blocks);
  if (moments.moments.size() < files.moments.size())
    notes.push_back(
        fmt::format("The page holds {} of the {} moments that the run has written, so that it stays small.",
                    moments.moments.size(), files.moments.size()));
  Json::Array times;
  for (std::size_t m = 0; m < moments.moments.size(); ++m) {
    Json::Array present;
    for (const bool there : moments.present[m]) present.emplace_back(there);
    times.push_back(Json().add("time", moments.moments[m].time).add("present", std::move(present)));
  }
  out.add("mesh", std::move(mesh)).add("moments", std::move(times));
  out.add("fields", fields_data(moments));
}

/// How the mould was filled, where the run began with it: the files that the driver of the flow has made for
/// the page (python/solidus_plots/filling_view.py). What they say is checked by the page, which has bytes
/// only.
void add_filling(Json& out, const fs::path& folder, Blocks& blocks, std::vector<std::string>& notes) {
  const fs::path text = folder / "report.json", numbers = folder / "report.bin";
  if (!fs::exists(text) || !fs::exists(numbers)) return;
  // The driver keeps them small; files of another origin must not make the page large.
  std::error_code error;
  if (fs::file_size(text, error) + fs::file_size(numbers, error) > k_most_filling || error) {
    notes.emplace_back("The files of the filling are too large for a page, which lacks it.");
    return;
  }
  out.add("filling_text", checked_summary(text));
  out.add("filling", blocks.add(read_text_file(numbers, {numbers.string(), 0, 0})));
}

}  // namespace

std::vector<BodyMaterial> body_materials(const fs::path& folder) {
  std::vector<BodyMaterial> out;
  const Value document = load_document(folder / "case.toml");
  if (const Value* bodies = document.find("body"); bodies != nullptr && bodies->is_list())
    for (const Value& body : bodies->items())
      out.push_back({text_at(body, "", "name"), text_at(body, "", "material")});
  return out;
}

Json run_data(const ReportedRun& run, const ReportOptions& options, std::size_t most_bytes, Blocks& blocks,
              std::vector<std::string>& notes) {
  const fs::path& folder = run.folder;
  const SourceLocation where{folder.string(), 0, 0};
  const std::string allowed =
      "the folder that `solidus run` names at its end, for example results/CASE/default";
  if (!fs::is_directory(folder))
    throw InputError(where,
                     fs::exists(folder) ? "this is a file, no folder of results" : "there is no such folder",
                     allowed);
  const auto there = [&](std::string_view name) { return fs::exists(folder / name); };
  if (!there("case.toml"))
    throw InputError(where, "the folder has no case.toml: it is none of results", allowed);
  if (!there("history.csv") && !there(results::k_collection))
    throw InputError(where, "the folder has no results: neither history.csv nor fields.pvd", allowed);

  const fs::path case_file = folder / "case.toml";
  const Value document = load_document(case_file);
  std::vector<std::string> own;
  const fs::path whole = fs::absolute(folder / "").lexically_normal().parent_path();
  // What the page says of the case, then its summary if the run has ended.
  Json out;
  out.add("name", whole.parent_path().filename().string() + "/" + whole.filename().string());
  out.add("title", text_at(document, "", "title"));
  out.add("kind", text_at(document, "analysis", "kind"));
  out.add("physics", text_at(document, "analysis", "physics"));
  out.add("case_text", read_text_file(case_file, {case_file.string(), 0, 0}));
  if (there("summary.json"))
    out.add("summary_text", checked_summary(folder / "summary.json"));
  else
    own.emplace_back(
        "There is no summary.json: the run goes on, or it was killed. The page shows how far it came.");
  // The run at the values as they are of `solidus uncertain`, whose ranks lie next to its folder.
  if (const fs::path ranks = whole.parent_path() / "uncertain.json";
      whole.filename() == "best" && fs::exists(ranks))
    out.add("uncertain_text", checked_summary(ranks));
  // The run with the values that `solidus calibrate` has found, next to what it has written of the fit.
  if (const fs::path fit = whole.parent_path() / "calibrate.json";
      whole.filename() == "fitted" && fs::exists(fit))
    out.add("calibrated_text", checked_summary(fit));
  add_filling(out, folder / "filling", blocks, own);
  out.add("materials", run.materials);
  // Tables with at most so many rows, and the fields as far as there is room.
  Json tables;
  for (const char* name : {"history", "steps", "pools", "shots", "stages"}) {
    const std::string file = std::string(name) + ".csv";
    if (!there(file.c_str())) continue;
    const ReportTable table = read_table(folder / file, k_most_rows);
    if (table.n_rows < table.n_in_file)
      own.push_back(
          fmt::format("{} has {} rows; the page holds {} of them.", file, table.n_in_file, table.n_rows));
    tables.add(name, table_data(table, blocks));
  }
  out.add("tables", std::move(tables));
  add_declarations(out);
  out.add("sections", page_sections_json({folder, document}));
  add_fields(out, folder, body_materials(folder), options, most_bytes, blocks, own);
  for (const std::string& note : own) notes.push_back(folder.string() + ": " + note);
  out.add("notes", Json::Array(own.begin(), own.end()));
  return out;
}

}  // namespace solidus::results
