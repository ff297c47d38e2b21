/// Shapes of Open CASCADE (.brep).
#include "mesh/files/file_format.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return head.find("CASCADE Topology") != std::string_view::npos ||
         head.find("DBRep_DrawableShape") != std::string_view::npos;
}

}  // namespace

FileFormat format_brep() {
  return {.name = "BREP",
          .place = 40,
          .endings = {".brep", ".brp", ".BRP"},
          .begins = &begins,
          .begins_with = "'CASCADE Topology' or 'DBRep_DrawableShape'",
          .holds = FileHolds::shapes,
          .by_gmsh = true};
}

}  // namespace solidus::mesh
