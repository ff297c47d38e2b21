/// The format `--vtkhdf` of `solidus export`.
#include "results/formats/vtkhdf.hpp"

#include "app/export_format.hpp"
#include "app/exports/gathered_fields.hpp"

namespace solidus::app {

namespace {

std::string write(const ExportRequest& request) {
  return gathered_text(request.file, results::write_vtkhdf(collection_of(request), request.file));
}

const AddExportFormat k_vtkhdf{{.name = "vtkhdf",
                                .place = 30,
                                .help = "One file with the fields of all times, for ParaView 5.12 or newer",
                                .write = &write}};

}  // namespace

}  // namespace solidus::app
