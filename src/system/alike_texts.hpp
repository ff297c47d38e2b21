/// Texts that say the same of several things: a message for each of eight nuts hides the one that matters.
#pragma once

#include <string>
#include <vector>

namespace solidus::logging {

/// Texts that differ in numbers and in names 'in quotes' alone, told once: the first of them in full,
/// followed by the names of the others. Texts that differ in numbers alone stay apart, since nothing would
/// say where the second one holds; texts that are equal are one.
/// @return  in the order in which the first of each kind came
std::vector<std::string> told_once(const std::vector<std::string>& texts);

}  // namespace solidus::logging
