// Replaces read_med.cpp where the MED library is not there.
#include "mesh/med/read_med.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

RawMesh read_med_file(const std::string& path, double) {
  throw InputError({path}, "this program was built without the MED library and reads no .med file",
                   "a program that was built where libmedc-dev is installed; or the mesh as .unv, which "
                   "Salome and FreeCAD export with its groups");
}

}  // namespace solidus::mesh
