/// The draft is built, looked at and changed until it is what the report says.
#include "new_case/draft_refinement.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "cases/roles.hpp"
#include "input/keys.hpp"
#include "mesh/making/kept_mesh.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/quality.hpp"
#include "new_case/draft_choice.hpp"
#include "new_case/draft_layers.hpp"
#include "new_case/rounding.hpp"
#include "run/session.hpp"
#include "setup/case_file.hpp"
#include "setup/geometry_bodies.hpp"
#include "setup/mesh_input.hpp"
#include "system/log.hpp"

namespace solidus::new_case {

namespace fs = std::filesystem;

namespace {

/// While an object of this class lives, it keeps what meshing tells of bodies that overlap. Warnings are
/// silent then.
class OverlapListener {
 public:
  explicit OverlapListener(std::string& overlap) {
    mesh::listen_to_outlook([&overlap](const mesh::MeshingOutlook& outlook) {
      if (!outlook.overlap.empty()) overlap = outlook.overlap;
    });
  }
  ~OverlapListener() { mesh::listen_to_outlook({}); }
  OverlapListener(const OverlapListener&) = delete;
  OverlapListener& operator=(const OverlapListener&) = delete;
};

/// While an object of this class lives, nothing is printed but what meshing says of its progress.
class QuietLog {
 public:
  QuietLog() : level_(logging::level()) {
    logging::set_level(std::max(level_, logging::Level::silent));
    mesh::listen_to_progress([this](const std::string& text) { say(text); });
  }
  ~QuietLog() {
    mesh::listen_to_progress({});
    logging::set_level(level_);
  }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;

  void say(const std::string& text) const {
    const logging::Level quiet = logging::level();
    logging::set_level(level_);
    logging::info("{}", text);
    logging::set_level(quiet);
  }

 private:
  logging::Level level_;
};

class Refinement {
 public:
  Refinement(Draft& draft, const CastingProcess& process, const material::Material& alloy, double fineness,
             double time_of_direct_ways)
      : draft_(draft),
        process_(process),
        alloy_(alloy),
        fineness_(fineness),
        time_of_direct_ways_(time_of_direct_ways) {}

  DraftEstimate refine() {
    // Meshes, overlaps and messages of the many tries are kept from the user until the last one.
    mesh::KeptMesh kept;  // the case is built again and again, often with the same elements
    const OverlapListener listener(estimate_.overlap);
    // The log is quiet from here on, or each try would print the warnings of a draft that is not shown.
    const QuietLog quiet;
    kept.search().time_of_direct_ways = time_of_direct_ways_;
    try {
      // The best way of meshing is looked for when the sizes are found, not for each that is tried.
      kept.search().most_wanted = mesh::k_usable_quality;
      bool of_sizes = true;
      constexpr int k_most_tries = 6;
      for (int attempt = 0; attempt < k_most_tries; ++attempt) {
        // Each try writes the case, checks it, and adapts the sizes to what the check has found.
        if (attempt == 0) find_skins();  // sizes do not change which skins there are
        write_draft(draft_);
        const setup::Case c = setup::load_case(draft_.folder / "case.toml", {}, cases::Physics::heat);
        const bool good = adapt(run::check_run(c));
        write_draft(draft_);
        const bool sound = !kept.search().way || kept.search().way->quality >= mesh::k_sound_quality;
        if (good && (sound || !of_sizes)) break;
        // Once the sizes are right, or the tries are used up, the best way of meshing is looked
        // for.
        if (good || attempt + 2 == k_most_tries) {
          of_sizes = false;
          kept.search().most_wanted = mesh::k_sound_quality;
        }
      }
      if (!draft_.meshed) estimate_.skin_notes = kept.notes();
      // Every run would try the same ways again.
      if (const auto way = kept.search().way;
          way && (way->number > 0 || way->quality < mesh::k_sound_quality)) {
        draft_.way = way->number + 1;
        // The way that was found is written down, so that a run of the case begins with it.
        write_draft(draft_);
      }
      // A mesh that stayed poor is told in the report.
      if (const auto way = kept.search().way; way && way->quality < mesh::k_sound_quality) {
        estimate_.least_quality = way->quality;
        estimate_.worst_element = way->worst;
      }
      // The coupled case is built once too, so that its own mistakes are found here.
      if (draft_.coupled)
        run::check_run(setup::load_case(draft_.folder / "case.toml", {}, cases::Physics::thermomechanical));
    } catch (...) {
      std::error_code error;  // no case that does not run
      fs::remove(draft_.folder / "case.toml", error);
      throw;
    }
    return estimate_;
  }

 private:
  mesh::RawMesh drafted_mesh() const {
    Draft bare = draft_;  // conditions come when the skins are known
    bare.films.clear();
    bare.symmetric.clear();
    bare.layers.clear();
    bare.cavity.clear();
    bare.channels.clear();
    write_draft(bare);
    return setup::raw_mesh(setup::load_case(draft_.folder / "case.toml", {}, cases::Physics::heat).spec);
  }

  /// Cores in cavities are bodies that only the mesh tells of; so are the skins that nothing faces.
  void find_skins() {
    // Cores are found in the mesh with all bodies that the draft knows of, which is therefore made first.
    mesh::RawMesh mesh = drafted_mesh();
    bool more = false;
    // A body that the draft does not know is a core; with it the mesh is made again.
    for (const auto& [group, content] : mesh.groups) {
      if (draft_.meshed)
        break;  // the bodies of the file are known, and its other sets hold the same elements
      if (content.dimension != mesh.dimension || std::ranges::count(draft_.bodies, group, &DraftBody::group))
        continue;
      DraftBody& core = draft_.bodies.emplace_back();
      core.name = core.group = group;
      core.role = cases::Role::core;
      describe(draft_, process_, core);
      more = true;
    }
    if (more) mesh = drafted_mesh();
    // Then what lies on the skins: cavities of dies, heated walls, channels, free faces and symmetry.
    draft_.films.clear();
    draft_.symmetric.clear();
    draft_.cavity.clear();
    for (const DraftBody& die : draft_.bodies)
      for (const DraftBody& body : draft_.bodies)
        if (die.role == cases::Role::die && body.role != cases::Role::die &&
            body.role != cases::Role::chill && mesh.groups.contains(die.name + "_to_" + body.name))
          draft_.cavity.push_back(die.name + "_to_" + body.name);
    find_heated_walls(mesh);
    find_channels(mesh);
    // Free skins get films, and planes of symmetry supports.
    for (const DraftBody& body : draft_.bodies) {
      if (mesh.groups.contains(body.name + "_free")) draft_.films.push_back(body.name);
      if (cases::is_poured(body.role) && mesh.groups.contains(body.name + "_symmetry"))
        draft_.symmetric.push_back(body.name);
    }
  }

  void find_channels(const mesh::RawMesh& mesh) {
    draft_.channels.clear();
    for (const DraftBody& body : draft_.bodies) {
      const std::string free = body.name + "_free";
      if (body.role != cases::Role::die || !mesh.groups.contains(free)) continue;
      std::vector<std::string> shared;
      for (const auto& [group, content] : mesh.groups)
        if (content.dimension < mesh.dimension && group.starts_with(body.name + "_to_"))
          shared.push_back(group);
      for (DieChannel& channel : die_channels(mesh, body.group, free, shared)) {
        channel.die = body.name;
        draft_.channels.push_back(channel);
      }
    }
  }

  /// The walls that get layers, with their areas. The elements of a file stay as they are.
  void find_heated_walls(const mesh::RawMesh& mesh) {
    heated_.clear();
    if (draft_.meshed) return;
    const std::vector<mesh::GroupReport> groups = mesh::assess(mesh).groups;
    // Areas and volumes come from one look at the mesh, by the names of its groups.
    const auto measure = [&](const std::string& group) {
      const auto found = std::ranges::find(groups, group, &mesh::GroupReport::name);
      return found == groups.end() ? 0.0 : found->measure;
    };
    for (const DraftBody& body : draft_.bodies)
      for (const DraftBody& poured : draft_.bodies) {
        const std::string surface = body.name + "_to_" + poured.name;
        if (has_layers(body.role) && cases::is_poured(poured.role) && mesh.groups.contains(surface))
          heated_.push_back({surface, body.name, poured.name, measure(surface), measure(body.group)});
      }
  }

  std::optional<cases::Role> role_of(const std::string& body) const {
    const auto found = std::ranges::find(draft_.bodies, body, &DraftBody::name);
    return found == draft_.bodies.end() ? std::nullopt : std::optional(found->role);
  }

  /// The longest estimate of the castings of whose skin half or more is cooled [s]; zero: there is none.
  double longest_freezing(const run::CheckedRun& checked) const {
    constexpr double k_half = 0.5;
    double longest = 0;
    for (const results::PourOverview& pour : checked.overview.pours)
      for (const results::BodyOverview& body : checked.overview.bodies)
        if (body.name == pour.body && role_of(pour.body) == cases::Role::casting &&
            body.volume > k_half * body.skin * pour.modulus)
          longest = std::max(longest, pour.freezing_time.value_or(0));
    return longest;
  }

  /// Film outside of the dies without channels of their own that takes as much heat in a shot as the castings
  /// bring to them until they are well solid, less what spray and air take from the cavity, while the die is
  /// as warm as it was preheated; spread over all of their outside [W/(m² K)].
  double cooling_of_die(const run::CheckedRun& checked) const {
    constexpr double k_below_solidus = 100, k_ambient = 20, k_cavity_film = 20;  // [K], [°C], [W/(m² K)]
    const DraftShots& shots = *draft_.shots;
    const material::EnthalpyCurve curve = alloy_.enthalpy();
    double heat = 0, outside = 0, warmer = 0;
    for (const DraftBody& body : draft_.bodies)
      if (body.role == cases::Role::die) warmer = body.start - k_ambient;
    // Heat is counted from the pouring temperature down to well below the solidus, where the casting leaves
    // the die; the cavity gives off some of it while the die is open.
    for (const results::PourOverview& pour : checked.overview.pours)
      for (const results::BodyOverview& body : checked.overview.bodies)
        if (body.name == pour.body)
          heat += body.volume * (curve.upper(pour.pouring) - curve.upper(pour.solidus - k_below_solidus)) -
                  body.skin * warmer *
                      (shots.spray_film * shots.spray + k_cavity_film * (shots.eject + shots.close));
    double cavity = 0, own = 0;
    for (const results::SkinOverview& skin : checked.overview.skins) {
      if (skin.surface == skin.body + "_free" && role_of(skin.body) == cases::Role::die &&
          !has_channels(draft_, skin.body))
        outside += skin.area;
      for (const DraftBody& die : draft_.bodies)
        if (die.role == cases::Role::die && skin.surface == skin.body + "_to_" + die.name) {
          cavity += skin.area;
          own += has_channels(draft_, die.name) ? 0 : skin.area;
        }
    }
    // Dies with channels of their own take the share of heat that goes with their part of the cavity.
    if (cavity > 0) heat *= own / cavity;
    if (heat <= 0 || outside <= 0 || warmer <= 0) return 0;
    return two_digits(heat / (shots.cycle() * outside * warmer));
  }

  /// @return whether sizes and walls may stay
  bool adapt(const run::CheckedRun& checked) {
    double time = 0, reach = 0;
    estimate_.nodes = estimate_.metal_nodes = estimate_.longest_edge = 0;
    estimate_.shortest_edge = std::numeric_limits<double>::max();
    // The estimate errs long for a riser in a sleeve, and for a casting that others enclose.
    constexpr double k_outlives = 2;
    const double of_castings = longest_freezing(checked);
    // Times and depths of all castings: the longest of either decides.
    std::vector<PouredTime> times;
    for (const results::PourOverview& pour : checked.overview.pours) {
      double own = pour.freezing_time.value_or(0), deep = pour.mould_reach;
      // A body that would freeze much later than the castings counts with twice their time, and its depth
      // falls with the square root, as heat spreads.
      const double most = k_outlives * of_castings;
      if (of_castings > 0 && own > most) deep *= std::sqrt(most / own), own = most;
      times.push_back({pour.body, own, pour.solidus});
      time = std::max(time, own);
      reach = std::max(reach, deep);
    }
    // Nodes and edges in metal, and of all.
    for (const results::BodyOverview& body : checked.overview.bodies) {
      estimate_.nodes += static_cast<double>(body.nodes);
      for (const DraftBody& draft : draft_.bodies)
        if (draft.name == body.name && cases::is_poured(draft.role)) {
          estimate_.metal_nodes += static_cast<double>(body.nodes);
          estimate_.shortest_edge = std::min(estimate_.shortest_edge, body.shortest_edge);
          estimate_.longest_edge = std::max(estimate_.longest_edge, body.longest_edge);
        }
    }
    // The estimate is of one dimension: the run ends when all is solid, well before this where it is right.
    constexpr double k_latest = 6, k_usual = 1.8, k_margin_of_shots = 2.5;
    estimate_.freezing = time;
    // A step is a six-hundredth of the usual time to freeze, an output a twentieth.
    if (time > 0) {
      draft_.end = two_digits(std::max(k_latest * time, 1.0));
      draft_.step = two_digits(std::max(k_usual * time, 1.0) / 600);
      draft_.every = two_digits(std::max(k_usual * time, 1.0) / 20);
      // Shots have their own times, from the process and the estimate.
      if (draft_.shots) {
        draft_.shots->solidify = two_digits(std::max(k_margin_of_shots * time, 1.0));
        draft_.shots->cooling = cooling_of_die(checked);
        constexpr double k_steps_of_shot = 300, k_outputs_of_shot = 12;  // as many shots, as many fields
        draft_.step = two_digits(draft_.shots->solidify / k_steps_of_shot);
        draft_.every = two_digits(draft_.shots->cycle() / k_outputs_of_shot);
      }
    }
    bool good = true;
    if (std::vector<DraftLayers> layers = choose_layers(draft_, heated_, times, fineness_);
        layers != draft_.layers) {
      draft_.layers = std::move(layers);
      good = false;
    }
    // Layers or sizes that change want another try.
    good = may_keep_sizes() && good;
    // Walls of moulds reach twice as far as heat does, else they grow.
    constexpr double k_reaches = 2;
    if (draft_.mould && process_.walls > 0 && process_.mould == cases::Role::mould)
      for (double& wall : draft_.mould->walls)
        if (wall > 0 && wall < k_reaches * reach) {
          wall = of_wall(k_reaches * reach);
          draft_.mould_size = std::max(draft_.mould_size, two_digits(wall / 4));
          good = false;
        }
    return good;
  }

  /// Makes the elements of the metal larger where there are too many. Where features of the part ask for them
  /// whatever the size is, larger elements elsewhere save little and resolve nothing: then sizes stay.
  /// @return whether the sizes may stay
  bool may_keep_sizes() {
    constexpr double k_most = 6000, k_wanted = 3500;
    const double finer = fineness_ * fineness_ * fineness_;
    if (estimate_.metal_nodes <= k_most * finer || draft_.meshed || coarsening_is_vain_) return true;
    // A coarser mesh that has hardly fewer nodes shows that features of the part decide their number: the
    // finer sizes are put back.
    if (finer_ && estimate_.metal_nodes > finer_->nodes / finer_->scale) {
      draft_.size = finer_->size;
      draft_.smallest = finer_->smallest;
      draft_.mould_size = finer_->mould_size;
      coarsening_is_vain_ = true;
      return false;
    }
    // The number of nodes falls with the cube of the size.
    const double scale = std::cbrt(estimate_.metal_nodes / (k_wanted * finer));
    finer_ = {draft_.size, draft_.smallest, draft_.mould_size, estimate_.metal_nodes, scale};
    draft_.size = two_digits(draft_.size * scale);
    draft_.smallest = std::min(draft_.size, two_digits(draft_.smallest * scale));
    draft_.mould_size = two_digits(draft_.mould_size * std::sqrt(scale));
    return false;
  }

  /// Sizes before they were made larger by `scale`, and the nodes of the metal with them.
  struct Sizes {
    double size, smallest, mould_size, nodes, scale;
  };

  Draft& draft_;
  const CastingProcess& process_;
  const material::Material& alloy_;
  double fineness_, time_of_direct_ways_;
  std::vector<HeatedWall> heated_;
  std::optional<Sizes> finer_;
  bool coarsening_is_vain_ = false;
  DraftEstimate estimate_;
};

}  // namespace

void write_draft(const Draft& draft) {
  const auto require = [&](bool written, const std::string& reason) {
    if (!written)
      throw InputError({draft.folder.string()}, "the case cannot be written there: " + reason,
                       "-o names another folder");
  };
  // The geometry is copied into the folder, so that the case can be moved, unless it lies there.
  std::error_code error;
  fs::create_directories(draft.folder, error);
  require(!error, error.message());
  const fs::path copy = draft.folder / draft.geometry.filename();
  if (!fs::exists(copy) || !fs::equivalent(copy, draft.geometry, error))
    fs::copy_file(draft.geometry, copy, fs::copy_options::overwrite_existing, error);
  require(!error, error.message());
  // The number of the last error is cleared, and the text is written out to the end, as a full disk is
  // noticed only then.
  errno = 0;
  std::ofstream file(draft.folder / "case.toml");
  file << case_text(draft);
  file.flush();
  require(static_cast<bool>(file), std::strerror(errno));
}

DraftEstimate refine_draft(Draft& draft, const CastingProcess& process, const material::Material& alloy,
                           double fineness, double time_of_direct_ways) {
  return Refinement(draft, process, alloy, fineness, time_of_direct_ways).refine();
}

}  // namespace solidus::new_case
