/// Materials of the library by the names that standards and the trade give them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace solidus::material {

/// The materials that a person may mean by a name: those with a designation or a title that contains it, or
/// with a designation that it contains, as "A356-T6" does "A356". Case, blanks, dots, hyphens and what else
/// is neither a letter nor a digit do not count. Files that cannot be read are passed over.
/// @param names  of the materials, each found in the first of the folders that has it
/// Returns names; none for a name of fewer than two letters and digits.
std::vector<std::string> designated(std::string_view name, const std::vector<std::string>& names,
                                    std::span<const std::filesystem::path> library);

/// The designations of a material of the library, in the order of its file; none where there is no such
/// material.
std::vector<std::string> designations(const std::string& name,
                                      std::span<const std::filesystem::path> library);

/// The advice for a name that the library does not have: the materials that it designates with their titles,
/// or the nearest name and all that are there.
std::string materials_meant(std::string_view name, const std::vector<std::string>& names,
                            std::span<const std::filesystem::path> library);

}  // namespace solidus::material
