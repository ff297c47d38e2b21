/// The format `--med` of `solidus export`.
#include "results/formats/med.hpp"

#include <vector>

#include "app/export_format.hpp"
#include "app/exports/gathered_fields.hpp"
#include "results/report/report_page.hpp"

namespace solidus::app {

namespace {

std::string write(const ExportRequest& request) {
  const std::filesystem::path collection = collection_of(request);
  std::vector<std::string> bodies;
  for (const results::BodyMaterial& body : results::body_materials(request.folder))
    bodies.push_back(body.body);
  return gathered_text(request.file, results::write_med(collection, bodies, request.file));
}

const AddExportFormat k_med{{.name = "med",
                             .place = 40,
                             .help = "One file with the fields of all times, for Salome and code_aster",
                             .write = &write}};

}  // namespace

}  // namespace solidus::app
