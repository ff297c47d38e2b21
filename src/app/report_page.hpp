/// The page of runs, as `report` and `run --report` write it.
#pragma once

#include <string>
#include <vector>

namespace solidus::app {

/// Not collective: one process reads and writes, and prints where the page is.
/// @param folders  of runs
/// @param output   the page; empty: report.html in the first folder
void write_report(const std::vector<std::string>& folders, const std::string& output);

}  // namespace solidus::app
