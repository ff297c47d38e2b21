/// Keeps the mesh of a casting for who builds its case several times in a row, as `solidus new` does: the
/// same geometry with the same sizes is then meshed once, and with others in the way that was best before.
#pragma once

#include <optional>
#include <string>

#include "mesh/casting_geometry.hpp"

namespace solidus::mesh {

/// While an object of this class lives, mesh_casting() returns the mesh that it made last once more where
/// file and request are the same. The file must not change meanwhile. One object at a time.
class KeptMesh {
 public:
  KeptMesh();
  ~KeptMesh();
  KeptMesh(const KeptMesh&) = delete;
  KeptMesh& operator=(const KeptMesh&) = delete;

  /// The object that lives; null where there is none.
  static KeptMesh* living();
  /// The mesh that was kept for this request; null where it is another one.
  const RawMesh* find(const std::string& request) const;
  void keep(std::string request, const RawMesh& mesh);

  /// One of the ways to mesh, and the least quality of elements that it gave.
  struct Way {
    int number = 0;
    double quality = 0;
  };
  /// The way of the last mesh, which had nearly the same sizes; none before the first.
  std::optional<Way> way() const { return way_; }
  void keep_way(Way way) { way_ = way; }

 private:
  std::optional<Way> way_;
  std::string request_;
  RawMesh mesh_;
};

/// Everything that a mesh of a casting depends on, but for what is in the file, as bytes.
std::string meshing_request(const MeshSource& source, const CastingGeometry& geometry, double enough);

}  // namespace solidus::mesh
