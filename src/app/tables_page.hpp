/// The columns of the tables that a run writes (results/tables/all_tables.hpp), as `solidus explain` shows
/// them.
#pragma once

#include <string>

namespace solidus::app {

/// A line for each column, under its table.
/// @param table  one of them; empty: all
/// Throws InputError for a table that does not exist.
std::string list_of_tables(const std::string& table);
/// The reference page, in Markdown.
std::string page_of_tables();

}  // namespace solidus::app
