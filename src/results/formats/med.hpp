/// The fields of a run as a MED file, which Salome and code_aster read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace solidus::results {

struct MedReport {
  std::size_t times = 0, points = 0, cells = 0, fields = 0;
};

/// Whether the program was built with the MED library (Debian: libmedc-dev).
bool has_med();

/// Writes the moments that the collection of a run lists with the MED library: the mesh `solidus` once, with
/// a family and a group for each body; the fields of nodes and elements once a moment. Values are those of
/// the files, coordinates in m. Where bodies have left, the field `absent` is 1 in their elements. Nodes that
/// parts of several processes share are there once a part.
/// @param collection  fields.pvd
/// @param bodies      their names, in the order of the case
/// One process. Throws InputError where a file is missing or damaged, or the program has no MED library;
/// OutputError where the new file cannot be written; then there is none.
MedReport write_med(const std::filesystem::path& collection, const std::vector<std::string>& bodies,
                    const std::filesystem::path& file);

}  // namespace solidus::results
