/// Runs a case of the repository in process and reads its tables back.
#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "run/session.hpp"
#include "system/log.hpp"

namespace solidus::testing {

using Columns = std::map<std::string, std::vector<double>>;

/// The next cell of a row; a text in quotation marks may hold commas.
inline bool next_cell(std::istringstream& row, std::string& cell) {
  if (row.peek() != '"') return static_cast<bool>(std::getline(row, cell, ','));
  row.get();
  std::getline(row, cell, '"');
  std::string rest;
  std::getline(row, rest, ',');
  return true;
}

/// Columns of numbers by header; texts read as zero.
inline Columns read_csv(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line, cell;
  std::vector<std::string> header;
  std::getline(in, line);
  for (std::istringstream row(line); std::getline(row, cell, ',');) header.push_back(cell);
  Columns columns;
  while (std::getline(in, line)) {
    std::istringstream row(line);
    for (std::size_t i = 0; i < header.size() && next_cell(row, cell); ++i)
      columns[header[i]].push_back(std::strtod(cell.c_str(), nullptr));
  }
  return columns;
}

struct CaseRun {
  bool finished = false;
  std::string reason;
  Columns history, steps;
};

/// Checks on the way that the isentropic split never raises the functional 𝓛 where the conditions are
/// admissible (2.26; run/audit_watch.hpp).
/// @param case_path relative to the repository
inline CaseRun run(const std::string& case_path, const std::string& name,
                   const std::vector<std::string>& overrides = {}) {
  const std::filesystem::path folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / "case_runs" / name;
  const setup::Case c = setup::load_case(std::filesystem::path(SOLIDUS_SOURCE_DIR) / case_path, overrides);
  run::RunOptions options;
  options.folder = folder;
  logging::clear_warnings();
  const run::RunResult result = run::run_case(c, options);
  if (c.spec.coupling.scheme->name() == "isentropic") {
    EXPECT_THAT(logging::warnings(),
                ::testing::Not(::testing::Contains(::testing::HasSubstr("functional L of stability grew"))))
        << name;
  }
  return {result.finished, result.reason, read_csv(folder / "history.csv"), read_csv(folder / "steps.csv")};
}

/// The value of a column at a time, linear between rows.
inline double at(const Columns& columns, const std::string& name, double time) {
  const std::vector<double>&t = columns.at("time[s]"), &y = columns.at(name);
  for (std::size_t i = 1; i < t.size(); ++i)
    if (t[i] >= time) return y[i - 1] + (y[i] - y[i - 1]) * (time - t[i - 1]) / (t[i] - t[i - 1]);
  return y.back();
}

}  // namespace solidus::testing
