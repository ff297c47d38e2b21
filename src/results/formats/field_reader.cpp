/// The ending of the file chooses the reader.
#include "results/formats/field_reader.hpp"

#include "results/formats/openfoam_reader.hpp"
#include "results/formats/vtu_reader.hpp"

namespace solidus::results {

ReadField read_field(const std::filesystem::path& path, const std::string& field, int body, double length,
                     const SourceLocation& where) {
  if (!std::filesystem::is_directory(path)) return read_vtu(path, field, body, length, where);
  if (body >= 0)
    throw InputError(where, "'body' chooses cells of a file of VTK; '" + path.string() + "' is a folder",
                     "no 'body'");
  return read_openfoam(path, field, length, where);
}

}  // namespace solidus::results
