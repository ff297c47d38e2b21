/// One way of meshing after the other is tried in a process of its own, cheap ones first, until a mesh has
/// no element below the bound of quality.
#include "mesh/making/casting_geometry.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <optional>
#include <utility>

#include "mesh/files/file_format.hpp"
#include "mesh/making/kept_mesh.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/making/meshing_ways.hpp"
#include "mesh/making/poor_tetrahedra.hpp"
#include "mesh/making/reader_message.hpp"
#include "mesh/making/reader_process.hpp"
#include "mesh/making/smoothing.hpp"
#include "mesh/making/worst_tetrahedron.hpp"
#include "mesh/quality.hpp"
#include "mesh/shape.hpp"
#include "numbers/index_casts.hpp"
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
      const auto n = as_size(node_count(block.shape));
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

/// Ways of meshing one after the other, and the best mesh of those that gave one.
class MeshingInTurn {
 public:
  /// @param kept  knows the way that was best for nearly the same mesh, which then comes first; may be null
  MeshingInTurn(const MeshSource& source, CastingGeometry geometry, double enough, KeptMesh* kept)
      : source_(source),
        geometry_(std::move(geometry)),
        enough_(enough),
        kept_(kept),
        solids_(file_format(source.path).holds == FileHolds::shapes) {
    if (kept != nullptr) direct_time_ = kept->search().time_of_direct_ways;
    for (std::size_t way = 0; solids_ && way < solid_ways().size(); ++way)
      order_.push_back(static_cast<int>(way));
    if (!solids_) order_.assign(faceted_order().begin(), faceted_order().end());
    const auto n_ways = static_cast<int>(order_.size());
    if (geometry_.only_way.value_or(0) >= n_ways)
      throw InputError({source.path},
                       "there is no way " + std::to_string(*geometry_.only_way + 1) + " of meshing it",
                       "1 to " + std::to_string(n_ways));
  }

  /// @param same  the mesh of this request that the kept way gave before; may be null
  RawMesh mesh(const RawMesh* same) {
    double sufficient = enough_;
    std::optional<int> first = geometry_.only_way;
    if (const std::optional<KeptMesh::Way> before = kept_ != nullptr ? kept_->search().way : std::nullopt;
        before && !first) {
      // Where no way was good enough none will be now: then about as good as the best is all that one can
      // have.
      constexpr double k_about = 0.7;
      if (before->best_of_all) sufficient = std::min(enough_, k_about * before->quality);
      first = before->number;
    }
    if (same != nullptr) {
      best_ = *same;
      quality_ = kept_->search().way->quality;
      way_ = kept_->search().way->number;
      tried_ = 1;
    } else if (first) {
      attempt(*first);
    }
    const bool decided = geometry_.only_way && best_;
    for (const int way : order_) {
      if (decided || (best_ && quality_ >= sufficient)) break;
      if (solids_ && too_long_ == k_most_too_long) break;
      if (solids_ && !is_cheap(way_of(solid_ways(), way)) && quality_ >= k_usable_quality) break;
      if (way != first) attempt(way);
    }
    return finish();
  }

 private:
  std::string text_of(int way) const {
    return solids_ ? way_of(solid_ways(), way).what : way_of(faceted_ways(), way).what;
  }

  /// Whether Gmsh makes a new skin of facets in this way, or takes them as they are.
  bool is_direct(int way) const { return !solids_ && way_of(faceted_ways(), way).skin == SkinOf::gmsh; }

  /// A way that the case asks for, or a user with a limit of his own, has all the time that readers have.
  TimeOfWay time_of(int way) const {
    constexpr double k_solids = 140, k_new_skin = 60, k_a_node = 1e-3;  // [s]: several times what is usual
    TimeOfWay time{text_of(way)};
    if (way == geometry_.only_way || std::getenv("SOLIDUS_MESH_TIME") != nullptr) return time;
    time.processor = solids_ ? k_solids : is_direct(way) ? direct_time_ : k_new_skin;
    time.processor_a_node = is_direct(way) ? 0 : k_a_node;
    return time;
  }

  void attempt(int way) {
    const TimeOfWay time = time_of(way);
    // The direct ways have one budget of time together.
    if (is_direct(way) && direct_time_ <= 0 && way != geometry_.only_way) return;
    geometry_.attempt = way;
    ++tried_;
    double spent = 0;
    // Complaints are kept for the message, should no way go through; a geometry that none can mesh ends the
    // search.
    try {
      // The mesh is kept if it is better than the best so far.
      RawMesh mesh = read_in_one_way(source_, &geometry_, time, &spent);
      take(std::move(mesh), way);
      if (quality_ < enough_) note(text_of(way) + ": least quality " + std::to_string(last_).substr(0, 5));
    } catch (const UnusableGeometry&) {
      throw;
    } catch (const MeshingTooLong& error) {
      note(text_of(way) + ": " + complaint_of(error, source_.path));
      spent = std::max(spent, time.processor);
      ++too_long_;
      tell_progress("'" + source_.path + "': " + complaints_.back() + "; another way is tried");
    } catch (const InputError& error) {
      note(text_of(way) + ": " + complaint_of(error, source_.path));
    }
    // What was spent counts also where the way has failed.
    if (is_direct(way) && time.processor > 0) direct_time_ = std::max(0.0, direct_time_ - spent);
    if (kept_ != nullptr) kept_->search().time_of_direct_ways = direct_time_;
  }

  /// Keeps a mesh where it is better than the best before.
  void take(RawMesh mesh, int way) {
    constexpr double k_repaired = 1.2 * k_sound_quality;  // nothing is left that is hardly sound
    if (enough_ > 0 && source_.element_order == 1) {
      smooth_poor_tetrahedra(mesh);
      repair_poor_tetrahedra(mesh, k_repaired);
    }
    last_ = least_quality(mesh);
    // Later ways have more elements, which a quality that is hardly better is not worth.
    constexpr double k_better = 1.1;
    if (last_ < enough_ && last_ <= k_better * quality_) return;
    best_ = std::move(mesh);
    quality_ = last_;
    way_ = way;
  }

  void note(std::string complaint) {
    complaints_.push_back(std::move(complaint));
    logging::debug("meshing '{}', {}", source_.path, complaints_.back());
  }

  RawMesh finish() {
    // The way that was best is remembered, so that the same geometry is not tried in all ways
    // again.
    const std::string worst = best_ && quality_ < k_sound_quality ? worst_tetrahedron_text(*best_) : "";
    if (best_ && kept_ != nullptr) kept_->search().way = {way_, quality_, quality_ < enough_, worst};
    // Without a mesh all complaints are told; a mesh of poor quality gets a warning with its worst element.
    if (!best_) {
      std::string all;
      for (const std::string& complaint : complaints_) all += "\n    " + complaint;
      const std::string allowed =
          "a geometry whose faces neither cross nor nearly touch there; other element sizes";
      throw InputError(
          {source_.path}, "the geometry could not be meshed in any of these ways:" + all,
          too_long_ == 0 ? allowed : allowed + "; more time for each way: SOLIDUS_MESH_TIME=\"1 h\"");
    }
    // One way that the case asks for, the best of several, or the first that was good enough: each
    // is told in its words.
    if (quality_ < enough_ && geometry_.only_way == way_)
      logging::warn(
          "meshing '{}' in way {} ({}) gives elements of quality {:.2g}, the worst {}; 0.15 is sound",
          source_.path, way_ + 1, text_of(way_), quality_, worst);
    else if (quality_ < enough_)
      logging::warn(
          "the best of {} ways to mesh '{}' has elements of quality {:.2g}, the worst {}; 0.15 is sound",
          tried_, source_.path, quality_, worst);
    else if (way_ > 0 && enough_ > 0 && !complaints_.empty())
      logging::info("meshed in way {} ({}), after: {}", way_ + 1, text_of(way_), complaints_.back());
    return std::move(*best_);
  }

  const MeshSource& source_;
  CastingGeometry geometry_;
  double enough_;
  KeptMesh* kept_;
  bool solids_;
  static constexpr int k_most_too_long = 2;  ///< of solids: other ways take as long
  std::vector<int> order_;                   ///< numbers of the ways
  double direct_time_ = k_time_of_direct_ways;
  std::optional<RawMesh> best_;
  double quality_ = 0, last_ = 0;  ///< least quality of the best mesh and of the last one
  int too_long_ = 0;               ///< ways that took longer than they may
  int way_ = 0, tried_ = 0;        ///< the way of the best mesh, and how many have been tried
  std::vector<std::string> complaints_;
};

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
  if (kept == nullptr) return MeshingInTurn(source, std::move(geometry), enough, nullptr).mesh(nullptr);
  enough = std::min(enough, kept->search().most_wanted);
  std::string request = meshing_request(source, geometry);
  const RawMesh* same = kept->find(request);
  if (same != nullptr && (kept->search().way->best_of_all || kept->search().way->quality >= enough))
    return *same;
  RawMesh mesh = MeshingInTurn(source, std::move(geometry), enough, kept).mesh(same);
  kept->keep(std::move(request), mesh);
  return mesh;
}

}  // namespace solidus::mesh
