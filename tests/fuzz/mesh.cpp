/// Any bytes as a mesh that Solidus reads itself: .msh, .inp, .bdf, .unv, .mesh, .vtk or .vtu, which the
/// first byte chooses.
#include "input.hpp"
#include "mesh/files/abaqus_input.hpp"
#include "mesh/files/gmsh_mesh_file.hpp"
#include "mesh/files/medit_file.hpp"
#include "mesh/files/nastran_input.hpp"
#include "mesh/files/universal_file.hpp"
#include "mesh/files/vtk_legacy.hpp"
#include "mesh/files/vtu_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  if (size == 0) return 0;
  const auto file = fuzz::as_file("mesh", data + 1, size - 1).string();
  switch (*data) {
    case 'a':
      return fuzz::answer([&] { mesh::read_abaqus_input(file, 0.001); });
    case 'n':
      return fuzz::answer([&] { mesh::read_nastran(file, 0.001); });
    case 'm':
      return fuzz::answer([&] { mesh::read_medit_file(file, 0.001); });
    case 'u':
      return fuzz::answer([&] { mesh::read_universal_file(file, 0.001); });
    case 'l':
      return fuzz::answer([&] { mesh::read_legacy_vtk(file, 0.001); });
    case 'v':
      return fuzz::answer([&] { mesh::read_vtu_mesh(file, 0.001); });
    default:
      return fuzz::answer([&] { mesh::read_gmsh_mesh_file(file, 0.001); });
  }
}
