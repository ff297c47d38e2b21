/// Writes the rows that the families of findings bring, as a list for the terminal and as the reference page.
#pragma once

#include <string>

namespace solidus::app {

/// One line a row: "a chill that takes up no heat: it starts above 400 °C, … (warning)".
/// @param topic  "contacts"; empty: all
/// Throws InputError for a topic that there is none of.
std::string list_of_findings(const std::string& topic);

/// The page docs/reference/findings.md, in Markdown.
std::string page_of_findings();

}  // namespace solidus::app
