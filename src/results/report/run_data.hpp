/// One run as the page wants it: a JSON tree that names the blocks of numbers.
#pragma once

#include <string>
#include <vector>

#include "results/output/json_document.hpp"
#include "results/report/pack.hpp"
#include "results/report/report_page.hpp"

namespace solidus::results {

/// @param most_bytes  of the blocks of this run
/// @param notes  gets what is missing
results::Json run_data(const ReportedRun& run, const ReportOptions& options, std::size_t most_bytes,
                       Blocks& blocks, std::vector<std::string>& notes);

}  // namespace solidus::results
