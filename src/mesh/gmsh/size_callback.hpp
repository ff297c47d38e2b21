/// Sizes of elements that Gmsh asks for while it meshes.
#pragma once

#include <gmsh.h>

#include <algorithm>

namespace solidus::mesh {

/// Has Gmsh take the smaller one of its own size and `size(dimension, tag, x, y, z)`, in every version.
///
/// Gmsh before 4.9 takes the smaller one by itself and asks with these five arguments. Later versions add the
/// size that they would take without being told, and use the answer as it is.
template <class Size>
void set_size_callback(const Size& size) {
  gmsh::model::mesh::setSizeCallback(
      [size](int dimension, int tag, double x, double y, double z, auto... size_of_gmsh) {
        return std::min({size(dimension, tag, x, y, z), size_of_gmsh...});
      });
}

}  // namespace solidus::mesh
