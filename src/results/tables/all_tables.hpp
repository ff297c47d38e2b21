/// The tables that a run writes, with their declared columns (quantities/column.hpp).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "quantities/column.hpp"
#include "results/output/json_document.hpp"

namespace solidus::results {

struct DeclaredTable {
  std::string_view name;  ///< of the file without its ending: "history"
  std::string_view doc;   ///< sentences of the reference page
  std::vector<const quantities::Column*> columns;
};

const std::vector<DeclaredTable>& all_tables();

/// For the report and Python: {"tables": {"history": [{"name": "stored_heat", "unit": "J", "label": …,
/// "chart": "Heat"}, …]}, "charts": the titles in their order, "answers": [{"name": "yield", "unit": "1",
/// "label": …, "of": "run", "shown": {…}}, …]}. Members that a row leaves empty are left out, and what is
/// said of it.
Json tables_json();

}  // namespace solidus::results
