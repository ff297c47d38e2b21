/// A report: what one or several runs left, as one page for the browser.
///
/// The page is the viewer (web/report, built by `./dev viewer`) with the data of the runs behind it, each
/// block deflated and in base64. It needs no net and no other file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "results/output/json_document.hpp"

namespace solidus::results {

struct ReportedRun {
  std::filesystem::path folder;
  /// The present text of the library on the material of each body (the results folder does not keep it).
  results::Json::Array materials = {};
};

struct ReportOptions {
  /// The text of the page stays below this many bytes where thinning out the moments can do it.
  std::size_t most_bytes = 24'000'000;
  /// Bodies of more cells than this are shown by their skin and cannot be cut.
  std::size_t most_cells = 3'000'000;
};

struct WrittenReport {
  std::size_t bytes = 0;
  std::vector<std::string> notes;  ///< what the page lacks and why, full sentences
};

struct ReportText {
  std::string text;                ///< of the page
  std::vector<std::string> notes;  ///< as of WrittenReport
};
/// The page itself. Throws InputError as write_report does.
ReportText report_text(const std::vector<ReportedRun>& runs, const ReportOptions& options = {});

/// Throws InputError for a folder without results, damaged files, and OutputError where the page cannot be
/// written. A run that goes on or was stopped gives a page of what there is.
WrittenReport write_report(const std::vector<ReportedRun>& runs, const std::filesystem::path& page,
                           const ReportOptions& options = {});

/// Names of the materials in a results folder's case.toml, one a body in their order, as the case has them.
struct BodyMaterial {
  std::string body, material;
};
std::vector<BodyMaterial> body_materials(const std::filesystem::path& folder);

}  // namespace solidus::results
