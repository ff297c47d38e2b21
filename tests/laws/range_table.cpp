// A format of `solidus export` that no file of src/, python/ and web/ names: the range of each field over
// time, as a table for a spreadsheet.
#include <fmt/format.h>

#include <algorithm>

#include "app/export_format.hpp"
#include "results/formats/field_moments.hpp"
#include "results/output/output_file.hpp"

namespace {

using namespace solidus;
using app::ExportRequest;

std::string write(const ExportRequest& request) {
  const std::filesystem::path collection = collection_of(request);
  const auto moments = results::body_moments(collection);
  std::string table = "time[s],field,unit,least,largest\n";
  for (const results::PvdCollection::Entry& entry : moments) {
    const results::FieldMoment moment(collection.parent_path() / entry.file);
    for (const results::FieldArray& field : columns_of(moment.pieces().front())) {
      if (field.components > 1 || field.is_of_mesh()) continue;
      const std::vector<double> values = values_of(moment, field);
      const auto [least, largest] = std::ranges::minmax_element(values);
      table +=
          fmt::format("{:g},{},{},{:.9g},{:.9g}\n", entry.time, field.name, field.unit, *least, *largest);
    }
  }
  results::write_file(request.file, table);
  return fmt::format("{}: ranges at {} times\n", request.file.string(), moments.size());
}

const app::AddExportFormat k_ranges{
    {.name = "ranges",
     .place = 35,
     .help = "A table of the least and largest value of each field at each time",
     .write = &write}};

}  // namespace
