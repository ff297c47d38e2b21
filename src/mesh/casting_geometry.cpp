#include "mesh/casting_geometry.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <set>
#include <utility>

#include "mesh/file_format.hpp"
#include "mesh/kept_mesh.hpp"
#include "mesh/meshing_ways.hpp"
#include "mesh/poor_tetrahedra.hpp"
#include "mesh/quality.hpp"
#include "mesh/reader_message.hpp"
#include "mesh/reader_process.hpp"
#include "mesh/shape.hpp"
#include "mesh/smoothing.hpp"
#include "mesh/worst_tetrahedron.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::mesh {

namespace {

KeptMesh* g_living = nullptr;

/// The least quality of the elements of all bodies, inverted ones turned.
double least_quality(const RawMesh& mesh) {
  double least = 1;
  for (const auto& [name, group] : mesh.groups) {
    if (group.dimension != mesh.dimension) continue;
    for (const RawBlock& block : group.blocks) {
      const auto n = static_cast<std::size_t>(node_count(block.shape));
      for (std::size_t e = 0; e < block.nodes.size(); e += n)
        least = std::min(least, std::abs(element_quality(mesh, block.shape, block.nodes.data() + e)));
    }
  }
  return least;
}

/// Returns the message of the reader without the file, which already precedes the whole message.
std::string complaint_of(const InputError& error, const std::string& path) {
  std::string text = error.what();
  if (const std::size_t at = text.find(path); at == 0) text = text.substr(path.size());
  while (!text.empty() && (text.front() == ':' || text.front() == ' ')) text.erase(0, 1);
  return text.substr(0, text.find('\n'));
}

/// @param kept  knows the way that was best for nearly the same mesh, which then comes first; may be null
/// @param same  the mesh of this request that this way gave before; may be null
RawMesh mesh_in_turn(const MeshSource& source, CastingGeometry geometry, double enough, KeptMesh* kept,
                     const RawMesh* same) {
  const bool solids = is_cad(file_format(source.path));
  const auto n_attempts = static_cast<int>(solids ? solid_ways().size() : faceted_ways().size());
  const auto attempt_text = [&](int way) {
    return std::string(solids ? way_of(solid_ways(), way).what : way_of(faceted_ways(), way).what);
  };
  constexpr double k_repaired = 1.2 * k_sound_quality;  // nothing is left that is hardly sound
  std::optional<RawMesh> best;
  double best_quality = 0;
  int best_way = 0, tried = same != nullptr ? 1 : 0;
  std::vector<std::string> complaints;
  const auto attempt = [&](int way) {
    geometry.attempt = way;
    ++tried;
    try {
      RawMesh mesh = read_in_one_way(source, &geometry);
      if (enough > 0 && source.element_order == 1) {
        smooth_poor_tetrahedra(mesh);
        repair_poor_tetrahedra(mesh, k_repaired);
      }
      const double quality = least_quality(mesh);
      // Later ways have more elements, which a quality that is hardly better is not worth.
      constexpr double k_better = 1.1;
      if (quality >= enough || quality > k_better * best_quality) {
        best = std::move(mesh);
        best_quality = quality;
        best_way = way;
      }
      if (best_quality >= enough) return;
      complaints.push_back(attempt_text(way) + ": least quality " + std::to_string(quality).substr(0, 5));
    } catch (const UnusableGeometry&) {
      throw;
    } catch (const InputError& error) {
      complaints.push_back(attempt_text(way) + ": " + complaint_of(error, source.path));
    }
    logging::debug("meshing '{}', {}", source.path, complaints.back());
  };
  if (geometry.only_way.value_or(0) >= n_attempts)
    throw InputError({source.path},
                     "there is no way " + std::to_string(*geometry.only_way + 1) + " of meshing it",
                     "1 to " + std::to_string(n_attempts));
  double sufficient = enough;
  std::optional<int> first = geometry.only_way;
  if (const std::optional<KeptMesh::Way> before = kept != nullptr ? kept->way() : std::nullopt;
      before && !first) {
    // Where no way was good enough none will be now: then about as good as the best is all that one can have.
    constexpr double k_about = 0.7;
    if (before->best_of_all) sufficient = std::min(enough, k_about * before->quality);
    first = before->number;
  }
  if (same != nullptr) {
    best = *same;
    best_quality = kept->way()->quality;
    best_way = kept->way()->number;
  } else if (first) {
    attempt(*first);
  }
  const bool decided = geometry.only_way && best;
  for (int way = 0; way < n_attempts && !decided && !(best && best_quality >= sufficient); ++way) {
    if (solids && !is_cheap(way_of(solid_ways(), way)) && best_quality >= k_usable_quality) break;
    if (way != first) attempt(way);
  }
  const std::string worst = best && best_quality < k_sound_quality ? worst_tetrahedron_text(*best) : "";
  if (best && kept != nullptr) kept->keep_way({best_way, best_quality, best_quality < enough, worst});
  if (!best) {
    std::string all;
    for (const std::string& complaint : complaints) all += "\n    " + complaint;
    throw InputError({source.path}, "the geometry could not be meshed in any of these ways:" + all,
                     "a geometry whose faces neither cross nor nearly touch there; other element sizes");
  }
  if (best_quality < enough && geometry.only_way == best_way)
    logging::warn("meshing '{}' in way {} ({}) gives elements of quality {:.2g}, the worst {}; 0.15 is sound",
                  source.path, best_way + 1, attempt_text(best_way), best_quality, worst);
  else if (best_quality < enough)
    logging::warn(
        "the best of {} ways to mesh '{}' has elements of quality {:.2g}, the worst {}; 0.15 is sound", tried,
        source.path, best_quality, worst);
  else if (best_way > 0 && enough > 0 && !complaints.empty())
    logging::info("meshed in way {} ({}), after: {}", best_way + 1, attempt_text(best_way),
                  complaints.back());
  return std::move(*best);
}

}  // namespace

KeptMesh::KeptMesh() {
  assert(g_living == nullptr);
  g_living = this;
}

KeptMesh::~KeptMesh() {
  g_living = nullptr;
}

KeptMesh* KeptMesh::living() {
  return g_living;
}

std::string meshing_request(const MeshSource& source, const CastingGeometry& geometry) {
  std::string bytes;
  const PutBytes put = [&](const void* data, std::size_t n) {
    bytes.append(static_cast<const char*>(data), n);
  };
  put_source(source, put);
  put_casting(geometry, put);
  return bytes;
}

RawMesh mesh_casting(const MeshSource& source, CastingGeometry geometry, double enough) {
  check_readable(source.path);
  KeptMesh* kept = KeptMesh::living();
  if (kept == nullptr) return mesh_in_turn(source, std::move(geometry), enough, nullptr, nullptr);
  enough = std::min(enough, kept->most_wanted());
  std::string request = meshing_request(source, geometry);
  const RawMesh* same = kept->find(request);
  if (same != nullptr && (kept->way()->best_of_all || kept->way()->quality >= enough)) return *same;
  RawMesh mesh = mesh_in_turn(source, std::move(geometry), enough, kept, same);
  kept->keep(std::move(request), mesh);
  return mesh;
}

}  // namespace solidus::mesh
