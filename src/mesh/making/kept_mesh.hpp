/// Keeps the mesh of a casting for who builds its case several times in a row, as `solidus new` does: the
/// same geometry with the same sizes is then meshed once, and with others in the way that was best before.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/meshing_ways.hpp"

namespace solidus::mesh {

/// While an object of this class lives, mesh_casting() returns the mesh that it made last once more where
/// file and request are the same and its quality is enough, or no way gives a better one. The file must not
/// change meanwhile. One object at a time.
class KeptMesh {
 public:
  KeptMesh();
  ~KeptMesh();
  KeptMesh(const KeptMesh&) = delete;
  KeptMesh& operator=(const KeptMesh&) = delete;

  /// The object that lives; null where there is none.
  static KeptMesh* living();

  /// One of the ways to mesh, the least quality of elements that it gave, whether all ways have been tried
  /// for a better one, and where the worst element is (mesh/making/worst_tetrahedron.hpp; empty where it is
  /// sound).
  struct Way {
    int number = 0;
    double quality = 0;
    bool best_of_all = false;
    std::string worst;
  };
  /// How far the ways to mesh are tried.
  struct Search {
    /// Quality of elements that is enough, where a case asks for a better one: while its sizes are still
    /// sought, no way of meshing is tried for the quality alone.
    double most_wanted = 1;
    /// Processor time that is left for Gmsh to make new skins of facets [s].
    double time_of_direct_ways = k_time_of_direct_ways;
    /// The way of the last mesh, which had nearly the same sizes; none before the first.
    std::optional<Way> way;
  };
  Search& search() { return search_; }

  /// The notes on the last mesh (RawMesh::notes).
  const std::vector<std::string>& notes() const { return mesh_.notes; }

  /// The mesh that Search::way gave for this request; null where it was another request.
  const RawMesh* find(const std::string& request) const {
    return !request_.empty() && request == request_ ? &mesh_ : nullptr;
  }
  void keep(std::string request, const RawMesh& mesh) {
    request_ = std::move(request);
    mesh_ = mesh;
  }

 private:
  Search search_;
  std::string request_;
  RawMesh mesh_;
};

/// Everything that a mesh of a casting depends on, but for what is in the file and for the quality that is
/// enough, as bytes.
std::string meshing_request(const MeshSource& source, const CastingGeometry& geometry);

}  // namespace solidus::mesh
