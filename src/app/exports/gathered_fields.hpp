/// Tells the user how many fields, times, points and cells an export has written.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

namespace solidus::app {

/// @param report  with the numbers of times, points, cells and fields, as results::VtkHdfReport
template <class Report>
std::string gathered_text(const std::filesystem::path& file, const Report& report) {
  return fmt::format("{}: {} fields at {} times, {} points and {} cells\n", file.string(), report.fields,
                     report.times, report.points, report.cells);
}

}  // namespace solidus::app
