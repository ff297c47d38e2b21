/// The format `--calculix` of `solidus export`.
#include "app/export_format.hpp"
#include "app/exports/structural_start.hpp"

namespace solidus::app {

namespace {

std::string deck(const results::StructuralDeck& of) {
  return results::structural_deck(of, results::Dialect::calculix);
}

std::string write(const ExportRequest& request) {
  return write_structural_start(request, &deck);
}

const AddExportFormat k_calculix{{.name = "calculix",
                                  .place = 10,
                                  .help = "File for CalculiX: stress at every point",
                                  .starts_analysis = true,
                                  .write = &write}};

}  // namespace

}  // namespace solidus::app
