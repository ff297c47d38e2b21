/// The verb `report`: the results of runs as one page for the browser, or as four printed ones.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <span>
#include <utility>

#include "app/case_arguments.hpp"
#include "app/python_tools.hpp"
#include "app/report_page.hpp"
#include "app/verb.hpp"
#include "cases/case_materials.hpp"
#include "material/cards/library.hpp"
#include "results/output/output_error.hpp"
#include "results/report/report_page.hpp"
#include "system/errors.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;
using results::Json;

Json numbers(std::span<const double> values) {
  Json::Array out;
  for (const double value : values) out.emplace_back(value);
  return out;
}

/// A material card for the report: tables as they are used, with their sources and ranges.
Json card(const material::Material& m) {
  Json out;
  // Title and density at the head, in SI units with their names.
  out.add("title", m.title).add("density[kg/m3]", m.density);
  Json::Array properties, changes, sources;
  // Tables of all properties, phase changes, and where each property comes from.
  for (const material::Property& p : m.properties()) {
    Json property;
    property.add("name", p.name).add("unit", p.unit);
    property.add("temperature[K]", numbers(p.table->x())).add("values", numbers(p.table->y()));
    properties.push_back(std::move(property));
  }
  for (const material::PhaseChange& change : m.phase_changes) {
    Json c;
    c.add("name", change.name).add("solidus[K]", change.fraction.solidus());
    c.add("liquidus[K]", change.fraction.liquidus()).add("latent_heat[J/kg]", change.latent_heat);
    c.add("volume_change[1]", change.volume_change);
    changes.push_back(std::move(c));
  }
  for (const material::PropertyNote& note : m.notes) {
    Json source;
    source.add("property", note.property).add("source", note.source);
    if (note.valid_to > note.valid_from)
      source.add("valid_from[K]", note.valid_from).add("valid_to[K]", note.valid_to);
    sources.push_back(std::move(source));
  }
  out.add("properties", std::move(properties)).add("phase_changes", std::move(changes));
  out.add("sources", std::move(sources));
  return out;
}

/// One card a body. A material that is not there any more is no reason to have no report.
Json::Array cards(const fs::path& folder) {
  Json::Array out;
  for (const auto& [body, name] : results::body_materials(folder)) {
    Json entry;
    entry.add("body", body).add("material", fs::path(name).stem().string());
    try {
      entry.add("card", card(material::find_material(name, cases::material_folders())));
    } catch (const InputError& error) {
      entry.add("missing", std::string(error.what()));
    }
    out.push_back(std::move(entry));
  }
  return out;
}

}  // namespace

/// One page of all folders; materials are looked up where the folder holds its case.
void write_report(const std::vector<std::string>& folders, const std::string& output) {
  std::vector<results::ReportedRun> runs;
  for (const std::string& folder : folders) {
    runs.push_back({folder});
    if (fs::exists(fs::path(folder) / "case.toml")) runs.back().materials = cards(folder);
  }
  const fs::path page = output.empty() ? fs::path(folders.front()) / "report.html" : fs::path(output);
  const results::WrittenReport written = results::write_report(runs, page);
  for (const std::string& note : written.notes) std::cerr << "solidus: " << note << "\n";
  print(fmt::format("Report in {} ({:.1f} MB); it opens in any browser\n", page.lexically_normal().string(),
                    1e-6 * static_cast<double>(written.bytes)));
}

namespace {

/// A file with the cards of a run's bodies for Python, which goes with this object.
class CardsFile {
 public:
  explicit CardsFile(const fs::path& folder) {
    int handle = mkstemp(path_.data());
    if (handle < 0) throw results::OutputError(path_, std::strerror(errno));
    ::close(handle);
    Json out;
    out.add("bodies", cards(folder));
    std::ofstream(path_) << out.text();
  }
  CardsFile(const CardsFile&) = delete;
  CardsFile& operator=(const CardsFile&) = delete;
  ~CardsFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_ = (fs::temp_directory_path() / "solidus-cards-XXXXXX").string();
};

class Report final : public Verb {
 public:
  explicit Report(CLI::App& program)
      : Verb(program, "report", "Write what runs left as one page that opens in any browser") {
    command().add_option("RUN", folders_, "Folders of results; two are shown side by side")->required();
    command().add_option("-o,--output", output_,
                         "The page; default report.html, or report.pdf, in the first folder");
    command().add_flag("--pdf", pdf_, "Four printed pages of one run for a customer, by a headless Chromium");
    command()
        .add_option("--template", template_,
                    "Logo and words of --pdf; default customer.toml next to the case")
        ->type_name("FILE");
  }
  ExitCode run() override {
    if (!template_.empty() && !pdf_)
      throw InputError({}, "--template is the template of --pdf, which is not asked for", "--pdf");
    if (pdf_) return write_pdf();
    write_report(folders_, output_);
    return k_done;
  }

 private:
  /// Python draws the pictures and puts the pages together.
  ExitCode write_pdf() const {
    if (folders_.size() != 1)
      throw InputError({}, "--pdf tells of one run, not of several", "one folder of results");
    const fs::path folder = folders_.front();
    if (!fs::exists(folder / "case.toml"))
      throw InputError({folder.string(), 0, 0}, "the folder has no case.toml: it is none of results",
                       "the folder that `solidus run` names at its end, for example results/CASE/default");
    const CardsFile cards_file(folder);
    PythonArguments arguments = {folder.string()};
    arguments.add("--cards", cards_file.path());
    arguments.add("--template", template_);
    arguments.add("--output", output_);
    return run_python("customer", arguments.words());
  }

  std::vector<std::string> folders_;
  std::string output_, template_;
  bool pdf_ = false;
};

}  // namespace

std::unique_ptr<Verb> report_verb(CLI::App& program) {
  return std::make_unique<Report>(program);
}

}  // namespace solidus::app
