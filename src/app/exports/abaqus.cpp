/// The format `--abaqus` of `solidus export`.
#include "app/export_format.hpp"
#include "app/exports/structural_start.hpp"

namespace solidus::app {

namespace {

std::string deck(const results::StructuralDeck& of) {
  return results::structural_deck(of, results::Dialect::abaqus);
}

std::string write(const ExportRequest& request) {
  return write_structural_start(request, &deck);
}

const AddExportFormat k_abaqus{{.name = "abaqus",
                                .place = 20,
                                .help = "File for Abaqus: stress of the elements",
                                .starts_analysis = true,
                                .write = &write}};

}  // namespace

}  // namespace solidus::app
