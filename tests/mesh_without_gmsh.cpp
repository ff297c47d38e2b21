// Reads meshes as a build with -DSOLIDUS_GMSH=OFF does: by our own readers; a geometry is refused with the
// reason.
#include <dlfcn.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "mesh/gmsh/import.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/reader_process.hpp"
#include "mesh/raw_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;

int failures = 0;

void expect(bool holds, const char* what) {
  if (holds) return;
  std::printf("failed: %s\n", what);
  ++failures;
}

std::string write(const std::filesystem::path& file, const char* text) {
  std::ofstream(file) << text;
  return file.string();
}

template <class F>
std::string complaint_of(const F& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

int main(int, char** argv) {
  const std::filesystem::path folder = std::filesystem::path(argv[1]) / "without_gmsh";
  std::filesystem::create_directories(folder);
  expect(dlsym(RTLD_DEFAULT, "gmshInitialize") == nullptr, "no Gmsh is linked");
  mesh::read_in_this_process(&mesh::read_mesh_here);

  const std::string msh =
      write(folder / "square.msh",
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"plate\"\n"
            "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
            "$Elements\n1\n1 3 2 7 1 1 2 3 4\n$EndElements\n");
  expect(mesh::read_mesh(msh, 0.001).groups.contains("plate"), ".msh is read");
  const std::string inp = write(folder / "square.inp",
                                "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n"
                                "*ELEMENT, TYPE=CPE4, ELSET=plate\n1, 1, 2, 3, 4\n");
  expect(mesh::read_mesh(inp, 0.001).groups.contains("plate"), ".inp is read");

  for (const char* name : {"part.step", "part.geo"}) {
    const std::string file =
        write(folder / name, name[5] == 's' ? "ISO-10303-21;\n" : "Point(1) = {0, 0, 0};\n");
    const std::string said = complaint_of([&] { mesh::read_mesh(file, 1); });
    expect(said.find(name) != std::string::npos && said.find("built without") != std::string::npos &&
               said.find(".msh") != std::string::npos,
           "a geometry is refused with the reason");
  }
  const std::string said =
      complaint_of([&] { mesh::mesh_casting({.path = (folder / "part.step").string()}, {}); });
  expect(said.find("built without") != std::string::npos, "a casting's geometry is refused too");
  return failures;
}
