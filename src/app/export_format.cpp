/// The list of formats that have described themselves.
#include "app/export_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "results/formats/pvd.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::app {

namespace {

/// Made when it is first asked for: objects at namespace scope add to it before main() begins.
std::vector<ExportFormat>& formats() {
  static std::vector<ExportFormat> all;
  return all;
}

}  // namespace

const std::vector<ExportFormat>& export_formats() {
  return formats();
}

void add_export_format(const ExportFormat& format) {
  for (const ExportFormat& other : formats())
    if (other.name == format.name || other.place == format.place)
      throw std::logic_error(
          fmt::format("the export formats '{}' at place {} and '{}' at place {}: one of both is taken",
                      format.name, format.place, other.name, other.place));
  formats().insert(std::ranges::upper_bound(formats(), format.place, {}, &ExportFormat::place), format);
}

std::filesystem::path collection_of(const ExportRequest& request) {
  if (processes::count() > 1) throw InputError({}, "the export works on one process", "without mpirun");
  const std::filesystem::path collection = request.folder / results::k_collection;
  if (!std::filesystem::exists(collection))
    throw InputError({request.folder.string()}, "the folder has no " + std::string(results::k_collection),
                     "the folder of a run's results");
  return collection;
}

}  // namespace solidus::app
