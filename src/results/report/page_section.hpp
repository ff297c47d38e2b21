/// A section of report.html, below the picture, as a plug-in: texts, tables and curves from the results of a
/// run. A section describes itself in its own file:
///
///   std::vector<PageBlock> make(const SectionSource& run);
///
///   const AddPageSection k_probes{{  // at namespace scope: every report has it where `make` returns blocks
///       .id = "probes", .title = "Probes", .place = 35, .make = &make}};
///
/// Sections that a reader works with (pictures, buttons) are files of web/report/src/sections.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "input/document.hpp"
#include "results/output/json_document.hpp"
#include "results/report/report_table.hpp"

namespace solidus::results {

/// The run that a section tells of.
struct SectionSource {
  const std::filesystem::path& folder;  ///< of its results
  const Value& case_file;               ///< case.toml, fully resolved
  /// A table of the folder by its name without ending, as "history"; nothing where it is not there.
  /// Throws InputError for one that is damaged.
  std::optional<ReportTable> table(std::string_view name) const;
};

/// A paragraph.
struct PageText {
  std::string text;
};
struct PageTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::variant<double, std::string>>> rows;
};
/// Curves of one unit (as heads of tables have it, "degC") over one abscissa.
struct PageCurves {
  struct Line {
    std::string label;
    std::vector<double> values;
  };
  std::string title, unit;
  Line x = {"Time", {}};
  std::string x_unit = "s";
  std::vector<Line> lines;
};
using PageBlock = std::variant<PageText, PageTable, PageCurves>;

struct PageSection {
  std::string_view id;     ///< of links to it; no two sections share it
  std::string_view title;  ///< over it and in the list of sections
  int place = 0;  ///< sections come in the order of these numbers; built-in ones have multiples of ten
  std::vector<PageBlock> (*make)(const SectionSource& run) = nullptr;  ///< empty: the run has nothing for it
};

/// Throws std::logic_error where another section has the id.
void add_page_section(PageSection section);

/// Adds a section while the program starts, as an object at namespace scope.
struct AddPageSection {
  explicit AddPageSection(PageSection section) { add_page_section(section); }
};

/// The sections that have something to show of a run: [{"id": …, "title": …, "place": …, "blocks": […]}].
Json page_sections_json(const SectionSource& run);

}  // namespace solidus::results
