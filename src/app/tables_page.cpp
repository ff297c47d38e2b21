/// Name, unit, and what a column says, table by table.
#include "app/tables_page.hpp"

#include <fmt/format.h>

#include <vector>

#include "input/keys.hpp"
#include "results/tables/all_tables.hpp"
#include "system/errors.hpp"

namespace solidus::app {

namespace {

/// The head of a column; NAME stands for the name of the contact, channel or source.
std::string head(const quantities::Column& column) {
  const std::string name = (column.name.front() == '_' ? "NAME" : "") + std::string(column.name);
  return column.unit.empty() ? name : fmt::format("{}[{}]", name, column.unit);
}

}  // namespace

std::string list_of_tables(const std::string& table) {
  std::string text;
  std::vector<std::string> known;
  for (const results::DeclaredTable& one : results::all_tables()) {
    known.emplace_back(one.name);
    if (!table.empty() && table != one.name) continue;
    text += fmt::format("{}.csv\n", one.name);
    for (const quantities::Column* column : one.columns)
      text += fmt::format("  {:30} {}{}\n", head(*column), column->doc,
                          column->when.empty() ? "" : fmt::format(" ({})", column->when));
  }
  if (text.empty()) throw InputError({}, fmt::format("there is no table '{}'", table), one_of(known, table));
  return text;
}

std::string page_of_tables() {
  std::string text =
      "# Reference: tables\n\nFor those who read the tables of a run by a program or a spreadsheet. The head "
      "of a "
      "column is its name with its unit in brackets; NAME stands for the name of a contact, a cooling "
      "channel or a "
      "source. Numbers have enough digits to restore the exact binary value.\n";
  for (const results::DeclaredTable& table : results::all_tables()) {
    text += fmt::format("\n## {}.csv\n\n{}\n\n| column | called | what | in runs |\n|---|---|---|---|\n",
                        table.name, table.doc);
    for (const quantities::Column* column : table.columns)
      text +=
          fmt::format("| `{}` | {} | {} | {} |\n", head(*column), column->label, column->doc, column->when);
  }
  return text +
         "\nNext: [results](../guide/results.md) · [fields](fields.md) · [stresses, gaps and "
         "balances](../tutorials/stress_and_gap.md)\n";
}

}  // namespace solidus::app
