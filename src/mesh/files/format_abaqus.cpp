/// Input files of Abaqus and CalculiX (.inp).
#include "mesh/files/abaqus_input.hpp"
#include "mesh/files/file_format.hpp"
#include "mesh/files/format_signs.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return is_text(head);
}

std::optional<RawMesh> read(const std::string& path, double unit_in_metres) {
  return read_abaqus_input(path, unit_in_metres);
}

}  // namespace

FileFormat format_abaqus() {
  return {.name = "Abaqus",
          .place = 60,
          .endings = {".inp", ".INP", ".Inp"},
          .begins = &begins,
          .begins_with = "text",
          .told = "Abaqus .inp",
          .read = &read};
}

}  // namespace solidus::mesh
