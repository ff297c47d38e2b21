#include "new_case/new_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <petscsys.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numeric>

#include "build/case_file.hpp"
#include "build/geometry_bodies.hpp"
#include "build/mesh_input.hpp"
#include "case/case_materials.hpp"
#include "case/roles.hpp"
#include "input/keys.hpp"
#include "input/units.hpp"
#include "material/library.hpp"
#include "mesh/casting_geometry.hpp"
#include "mesh/file_format.hpp"
#include "mesh/hot_spots.hpp"
#include "new_case/casting_processes.hpp"
#include "new_case/new_case_text.hpp"
#include "run/run.hpp"
#include "system/log.hpp"

namespace solidus::model {

namespace {

namespace fs = std::filesystem;

double rounded_up(double value, double to) {
  return to * std::ceil(value / to - 1e-9);
}

/// The thickness of a wall of the mould in whole millimetres, below a centimetre in tenths of them.
double of_wall(double least) {
  return rounded_up(least, least < 0.01 ? 1e-4 : 1e-3);
}

/// A value with two digits.
double two_digits(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return digit * std::round(value / digit);
}

/// A cylinder with 1.2 times the modulus of the thickest place, and metal enough for the shrinkage of all.
DraftRiser riser_on(const mesh::RawMesh& mesh, const std::vector<std::string>& metal,
                    const mesh::InscribedSphere& hot, double modulus, double volume, double shrinkage) {
  constexpr double k_safety = 1.2, k_slender = 1.5;
  // Of an upright cylinder that is 1.5 diameters high, cooled at side and top: V/A = 0.214 D.
  constexpr double k_modulus = 0.375 / 1.75;
  double diameter = k_safety * std::max(modulus, hot.radius / 3) / k_modulus;
  // It may give 14 % of its volume (Wlodawer's figure for open cylinders), and feeds itself as well.
  constexpr double k_yield = 0.14;
  const double needed = shrinkage * volume / std::max(k_yield - shrinkage, 0.02);
  diameter = std::max(diameter, std::cbrt(needed / (0.25 * 3.14159265358979 * k_slender)));
  DraftRiser riser;
  riser.diameter = rounded_up(diameter, 1e-3);
  riser.height = rounded_up(k_slender * riser.diameter, 1e-3);
  const double top = mesh::top_above(mesh, metal, hot.centre);
  riser.foot = {hot.centre[0], hot.centre[1], top - 0.05 * riser.diameter};
  riser.height += 0.05 * riser.diameter;
  return riser;
}

class NewCase {
 public:
  explicit NewCase(const NewCaseOptions& options)
      : options_(options), process_(process_named(options.process)) {}

  NewCaseReport make() {
    check_options();
    measure();
    choose();
    write();
    refine_draft();
    NewCaseReport report;
    report.file = draft_.folder / "case.toml";
    report.text = text();
    return report;
  }

 private:
  void check_options() {
    int n_processes = 1;
    MPI_Comm_size(PETSC_COMM_WORLD, &n_processes);
    if (n_processes > 1) throw InputError({}, "`solidus new` works on one process", "no mpirun");
    if (options_.alloy.empty())
      throw InputError({"--alloy"}, "what is cast?", "--alloy NAME, of those that `solidus materials` lists");
    alloy_ = material::find_material(options_.alloy, material_folders(), {"--alloy"});
    if (alloy_.solidification() == nullptr)
      throw InputError({"--alloy"}, fmt::format("'{}' does not solidify", options_.alloy),
                       "an alloy; `solidus materials` lists them");
    if (!options_.symmetry.empty() && options_.symmetry != "x" && options_.symmetry != "y" &&
        options_.symmetry != "z")
      throw InputError({"--symmetry"}, fmt::format("'{}' is no axis", options_.symmetry), "x, y or z");
    if (options_.shots > 0 && process_.mould != Role::die)
      throw InputError({"--shots"},
                       fmt::format("the mould of the process '{}' is lost with its casting", process_.name),
                       "--process gravity_die or high_pressure, or no --shots");
    draft_.folder = options_.folder.empty() ? fs::path(options_.geometry.stem().string()) : options_.folder;
    if (fs::exists(draft_.folder / "case.toml"))
      throw InputError({(draft_.folder / "case.toml").string()}, "there is a case already",
                       "another folder: -o FOLDER");
  }

  /// Riser and symmetry cut solids, and triangles cannot be cut.
  void refuse_cuts(bool solids) const {
    const char* allowed = "a STEP, BREP or IGES file";
    if (!solids && options_.riser)
      throw InputError({"--riser"}, "a riser can be joined to solids of a CAD program only", allowed);
    if (!solids && !options_.symmetry.empty())
      throw InputError({"--symmetry"}, "only solids of a CAD program can be cut", allowed);
  }

  void measure() {
    mesh::MeshSource source{options_.geometry.string(), units::convert(1, options_.unit, "m")};
    mesh::check_readable(source.path);
    const mesh::FileFormat format = mesh::file_format(source.path);
    const bool solids = mesh::is_cad(format), meshed = !solids && format != mesh::FileFormat::stl;
    refuse_cuts(solids);
    mesh_ = meshed ? mesh::read_mesh(source) : mesh::mesh_casting(source, {}, 0);
    if (mesh_.dimension != 3)
      throw InputError({source.path}, "the mesh is plane",
                       "a solid: STEP, BREP, IGES, STL, or a mesh of one");
    bodies_ = bodies_of(mesh_, options_.as);
    for (const GeometryBody& body : bodies_) {
      if (body.role == Role::mould || body.role == Role::die) has_mould_ = true;
      if (is_metal(body.role)) metal_.push_back(body.name);
    }
    draft_.meshed = meshed && has_mould_;
    for (std::size_t i = 0; i < 3; ++i) {
      low_[i] = 1e300, high_[i] = -1e300;
      for (const GeometryBody& body : bodies_)
        low_[i] = std::min(low_[i], body.extent.low[i]), high_[i] = std::max(high_[i], body.extent.high[i]);
    }
    for (const GeometryBody& body : bodies_)
      if (is_metal(body.role)) {
        volume_ += body.extent.volume;
        area_ += body.extent.area;
        const std::vector<double> one = mesh::thickness_by_area(mesh_, body.name);
        thickness_.insert(thickness_.end(), one.begin(), one.end());
      }
    std::sort(thickness_.begin(), thickness_.end());
    if (thickness_.empty()) thickness_ = {std::cbrt(volume_)};
    spheres_ = mesh::inscribed_spheres(mesh_, metal_, 3);
  }

  double thickness(double share) const {
    return thickness_[static_cast<std::size_t>(share * static_cast<double>(thickness_.size() - 1))];
  }

  void choose() {
    draft_.geometry = options_.geometry;
    draft_.unit = options_.unit;
    draft_.process = process_.name;
    draft_.alloy = options_.alloy;
    draft_.coupled = alloy_.mechanical();
    const auto& curve = alloy_.solidification()->fraction;
    constexpr double k_celsius = 273.15;
    draft_.pouring = rounded_up(curve.liquidus() - k_celsius + process_.superheat, 5);
    draft_.liquidus = curve.liquidus() - k_celsius;
    draft_.superheat = draft_.pouring - draft_.liquidus;
    choose_sizes(1);
    thickest_ = 2 * (spheres_.empty() ? thickness(0.9) / 2 : spheres_.front().radius);
    if (!options_.symmetry.empty()) choose_symmetry();
    if (options_.riser) {
      if (has_riser()) throw InputError({"--riser"}, "the geometry has a riser already", "no --riser auto");
      draft_.riser = riser_on(mesh_, metal_, place_to_feed(), volume_ / area_, volume_,
                              std::abs(alloy_.solidification()->volume_change));
      thickest_ = std::max(thickest_, draft_.riser->diameter);
    }
    choose_bodies();
    if (!has_mould_) choose_mould();
    for (const mesh::InscribedSphere& sphere : spheres_) draft_.hot_spots.push_back(sphere);
    for (mesh::InscribedSphere& sphere : draft_.hot_spots) fold(sphere.centre);
    if (draft_.riser) fold(draft_.riser->foot, 0);
    draft_.film = process_.film;
    draft_.film_source = process_.film_source;
    draft_.end = 3600;
    draft_.step = 1;
    draft_.every = 30;
    if (options_.shots > 0)
      draft_.shots = {options_.shots, process_.pour,       600,
                      process_.open,  process_.eject,      process_.spray,
                      process_.close, process_.spray_film, process_.spray_source};
  }

  /// Of the thick places that are nearly the thickest the one with the least metal above its centre.
  const mesh::InscribedSphere& place_to_feed() const {
    constexpr double k_nearly = 0.8;
    const mesh::InscribedSphere* best = &spheres_.front();
    double least = 1e300;
    for (const mesh::InscribedSphere& s : spheres_) {
      const double above = mesh::top_above(mesh_, metal_, s.centre) - s.centre[2];
      if (s.radius >= k_nearly * spheres_.front().radius && above < least) least = above, best = &s;
    }
    return *best;
  }

  bool has_riser() const {
    return std::ranges::any_of(bodies_, [](const GeometryBody& b) { return b.role == Role::riser; });
  }

  /// Into the half that is kept; what is near the plane of symmetry comes as near to it as a share of the
  /// thickest place.
  void fold(mesh::Point& x, double inside = 1e-3) const {
    if (!draft_.symmetry) return;
    double& c = x[static_cast<std::size_t>(draft_.symmetry->axis)];
    const double at = draft_.symmetry->at, near = 0.1 * thickest_;
    if (c > at) c = 2 * at - c;
    if (at - c < near) c = at - inside * thickest_;
  }

  void choose_symmetry() {
    const auto axis = static_cast<std::size_t>(options_.symmetry[0] - 'x');
    const double middle = 0.5 * (low_[axis] + high_[axis]);
    double first = 0, whole = 0;
    for (const GeometryBody& body : bodies_)
      first += body.extent.volume * body.extent.centre[axis], whole += body.extent.volume;
    constexpr double k_even = 2e-3;
    if (std::abs(first / whole - middle) > k_even * (high_[axis] - low_[axis]))
      throw InputError(
          {"--symmetry"},
          fmt::format(
              "the geometry is not symmetric in {}: its centre of volume lies at {:.4g} mm, the middle "
              "of its box at {:.4g} mm",
              options_.symmetry, 1e3 * first / whole, 1e3 * middle),
          "an axis normal to a plane of symmetry");
    draft_.symmetry = {static_cast<int>(axis), middle};
  }

  /// Sizes for about 3500 nodes of metal, with two elements through walls where those suffice.
  void choose_sizes(double scale) {
    constexpr double k_nodes = 3500, k_nodes_per_cube = 3;
    const double volume = volume_ * (options_.symmetry.empty() ? 1 : 0.5);
    const double by_number = std::cbrt(k_nodes_per_cube * volume / k_nodes) / options_.fineness;
    draft_.size = two_digits(scale * by_number);
    draft_.smallest = two_digits(scale * std::clamp(0.5 * thickness(0.1), 0.6 * by_number, by_number));
    draft_.mould_size =
        two_digits(std::max(2.5 * draft_.size, 0.6 * (high_[0] - low_[0] + high_[1] - low_[1]) / 20));
  }

  void choose_bodies() {
    int castings = 0;
    for (const GeometryBody& body : bodies_) castings += body.role == Role::casting;
    for (const GeometryBody& body : bodies_) {
      DraftBody& draft = draft_.bodies.emplace_back();
      draft.group = body.name;
      draft.name = castings == 1 && body.role == Role::casting && body.name.starts_with("body_") ? "casting"
                                                                                                 : body.name;
      draft.role = body.role;
      describe(draft);
    }
    if (draft_.riser) {
      DraftBody& riser = draft_.bodies.emplace_back();
      riser.name = riser.group = draft_.riser->name;
      riser.role = Role::riser;
      describe(riser);
    }
  }

  void describe(DraftBody& body) const {
    switch (body.role) {
      case Role::casting:
      case Role::riser:
        body.material = options_.alloy;
        body.start = draft_.pouring;
        body.comment =
            fmt::format("{:.0f} K above the liquidus of {:.0f} degC", draft_.superheat, draft_.liquidus);
        break;
      case Role::chill:
        body.material = first_known({"iron_chill"});
        body.start = 20;
        body.heat_only = true;
        break;
      case Role::sleeve:
      case Role::insulation:
        body.material = first_known({"insulating_sleeve", "ceramic_fibre", "green_sand"});
        body.start = 20;
        break;
      case Role::core:
        body.material = first_known({"furan_sand", "green_sand"});
        body.start = process_.mould == Role::die ? 80 : 20;
        break;
      case Role::mould:
      case Role::die:
        body.material = first_known(process_.materials);
        body.start = process_.mould_start;
        body.heat_only = process_.mould == Role::die;
        if (body.heat_only) body.comment = "physics = \"all\" gives its stresses too, at the price of time";
        break;
    }
    body.heat_only = body.heat_only && draft_.coupled;
  }

  void choose_mould() {
    DraftMould& mould = draft_.mould.emplace();
    // A part of a few millimetres has no walls of the usual least thickness: nearly all nodes would be
    // theirs.
    constexpr double k_small_part = 4;
    const double least = std::min(process_.least_wall, k_small_part * thickest_);
    const double wall = of_wall(std::max(least, process_.walls * thickest_));
    mould.walls.fill(wall);
    if (draft_.symmetry) mould.walls[2 * static_cast<std::size_t>(draft_.symmetry->axis) + 1] = 0;
    if (draft_.riser) mould.walls[5] = 0;  // open at the top
    DraftBody& body = draft_.bodies.emplace_back();
    body.name = body.group = process_.mould == Role::die ? "die" : "mould";
    mould.name = body.name;
    body.role = process_.mould;
    describe(body);
    draft_.law = process_.law;
    draft_.layers = process_.layers;
    // Away from the metal elements grow with the wall that they fill, not with the part.
    draft_.mould_size = std::clamp(draft_.mould_size, two_digits(wall / 4),
                                   two_digits(std::max(wall / 1.5, std::max(draft_.size, wall / 4))));
  }

  void write() const { write(draft_); }

  void write(const Draft& draft) const {
    std::error_code error;
    fs::create_directories(draft_.folder, error);
    const fs::path copy = draft_.folder / draft_.geometry.filename();
    if (!fs::exists(copy) || !fs::equivalent(copy, draft_.geometry, error))
      fs::copy_file(draft_.geometry, copy, fs::copy_options::overwrite_existing, error);
    std::ofstream file(draft_.folder / "case.toml");
    file << case_text(draft);
    file.flush();
    if (error || !file)
      throw InputError({draft_.folder.string()}, "the case cannot be written there", "a folder with room");
  }

  /// Refines the draft by building it: the built case shows cores and free skins, the number of nodes and the
  /// freezing time, from which bodies, films, sizes, walls and the end of the run follow.
  void refine_draft() {
    const logging::Level level = logging::level();
    logging::set_level(std::max(level, logging::Level::silent));
    try {
      constexpr int k_turns = 4;
      for (int turn = 0; turn < k_turns; ++turn) {
        find_skins();
        write();
        const Case c = load_case(draft_.folder / "case.toml", {}, Physics::heat);
        const bool good = adapt(check_run(c)) || turn + 1 == k_turns;
        write();
        if (good) break;
      }
      if (draft_.coupled) check_run(load_case(draft_.folder / "case.toml", {}, Physics::thermomechanical));
    } catch (...) {
      logging::set_level(level);
      std::error_code error;  // no case that does not run
      fs::remove(draft_.folder / "case.toml", error);
      throw;
    }
    logging::set_level(level);
  }

  mesh::RawMesh drafted_mesh() const {
    Draft bare = draft_;  // conditions come when the skins are known
    bare.films.clear();
    bare.symmetric.clear();
    bare.layers = false;
    bare.cavity.clear();
    write(bare);
    return raw_mesh(load_case(draft_.folder / "case.toml", {}, Physics::heat).spec);
  }

  /// Cores in cavities are bodies that only the mesh tells of; so are the skins that nothing faces.
  void find_skins() {
    mesh::RawMesh mesh = drafted_mesh();
    bool more = false;
    for (const auto& [group, content] : mesh.groups) {
      if (content.dimension != mesh.dimension || std::ranges::count(draft_.bodies, group, &DraftBody::group))
        continue;
      DraftBody& core = draft_.bodies.emplace_back();
      core.name = core.group = group;
      core.role = Role::core;
      describe(core);
      more = true;
    }
    if (more) mesh = drafted_mesh();
    draft_.films.clear();
    draft_.symmetric.clear();
    draft_.cavity.clear();
    for (const DraftBody& die : draft_.bodies)
      for (const DraftBody& body : draft_.bodies)
        if (die.role == Role::die && body.role != Role::die && body.role != Role::chill &&
            mesh.groups.contains(die.name + "_to_" + body.name))
          draft_.cavity.push_back(die.name + "_to_" + body.name);
    for (const DraftBody& body : draft_.bodies) {
      if (mesh.groups.contains(body.name + "_free")) draft_.films.push_back(body.name);
      if (is_metal(body.role) && mesh.groups.contains(body.name + "_symmetry"))
        draft_.symmetric.push_back(body.name);
    }
  }

  /// @return whether sizes and walls may stay
  bool adapt(const CheckedRun& checked) {
    double time = 0, reach = 0;
    nodes_ = metal_nodes_ = 0;
    for (const results::PourOverview& pour : checked.overview.pours) {
      time = std::max(time, pour.freezing_time.value_or(0));
      reach = std::max(reach, pour.mould_reach);
    }
    for (const results::BodyOverview& body : checked.overview.bodies) {
      nodes_ += static_cast<double>(body.nodes);
      for (const DraftBody& draft : draft_.bodies)
        if (draft.name == body.name && is_metal(draft.role)) metal_nodes_ += static_cast<double>(body.nodes);
    }
    // The estimate is of one dimension: the run ends when all is solid, well before this where it is right.
    constexpr double k_latest = 6, k_usual = 1.8, k_margin_of_shots = 1.3;
    freezing_ = time;
    if (time > 0) {
      draft_.end = two_digits(std::max(k_latest * time, 1.0));
      draft_.step = two_digits(std::max(k_usual * time, 1.0) / 600);
      draft_.every = two_digits(std::max(k_usual * time, 1.0) / 20);
      if (draft_.shots) draft_.shots->solidify = two_digits(std::max(k_margin_of_shots * time, 1.0));
    }
    bool good = true;
    constexpr double k_most = 6000, k_wanted = 3500, k_reaches = 2;
    const double finer = options_.fineness * options_.fineness * options_.fineness;
    if (metal_nodes_ > k_most * finer && !draft_.meshed) {
      const double scale = std::cbrt(metal_nodes_ / (k_wanted * finer));
      draft_.size = two_digits(draft_.size * scale);
      draft_.smallest = std::min(draft_.size, two_digits(draft_.smallest * scale));
      draft_.mould_size = two_digits(draft_.mould_size * std::sqrt(scale));
      good = false;
    }
    if (draft_.mould && process_.walls > 0 && process_.mould == Role::mould)
      for (double& wall : draft_.mould->walls)
        if (wall > 0 && wall < k_reaches * reach) {
          wall = of_wall(k_reaches * reach);
          draft_.mould_size = std::max(draft_.mould_size, two_digits(wall / 4));
          good = false;
        }
    return good;
  }

  std::string text() const {
    std::string out = fmt::format("{}: {} at {:.0f} degC, process {}", draft_.geometry.filename().string(),
                                  draft_.alloy, draft_.pouring, draft_.process);
    for (const DraftBody& body : draft_.bodies)
      out += fmt::format("\n  {:<10}  {} of {}, {:.0f} degC", name(body.role), body.name, body.material,
                         body.start);
    out += fmt::format(
        "\n  walls       {:.3g} mm (a tenth is thinner) to {:.3g} mm (a tenth is thicker), V/A {:.3g} mm",
        1e3 * thickness(0.1), 1e3 * thickness(0.9), 1e3 * volume_ / area_);
    for (const mesh::InscribedSphere& s : draft_.hot_spots)
      out += fmt::format("\n  hot spot    a sphere of {:.3g} mm at ({:.4g}, {:.4g}, {:.4g}) mm",
                         2e3 * s.radius, 1e3 * s.centre[0], 1e3 * s.centre[1], 1e3 * s.centre[2]);
    if (draft_.riser)
      out += fmt::format("\n  riser       {:.3g} mm wide, {:.3g} mm high", 1e3 * draft_.riser->diameter,
                         1e3 * draft_.riser->height);
    if (draft_.mould)
      out += fmt::format("\n  mould       walls of {:.3g} mm",
                         1e3 * *std::ranges::max_element(draft_.mould->walls));
    out += fmt::format("\n  mesh        {:.0f} nodes, {:.0f} of them in metal; {}", nodes_, metal_nodes_,
                       draft_.meshed ? std::string("elements as the file has them")
                                     : fmt::format("elements of {:.3g} to {:.3g} mm there",
                                                   1e3 * draft_.smallest, 1e3 * draft_.size));
    if (freezing_ > 0)
      out += fmt::format(
          "\n  freezes     in about {:.2g} s by an estimate of one dimension; {}", freezing_,
          draft_.shots ? fmt::format("it leaves the die after {:.3g} s, {} times",
                                     draft_.shots->pour + draft_.shots->solidify + draft_.shots->open,
                                     draft_.shots->number)
                       : fmt::format("the run ends when it has, at {:.3g} s at the latest", draft_.end));
    if (draft_.process == "shell" && draft_.mould)
      out +=
          "\n  note        the shell is a block around the part with thin walls, not an offset of its skin";
    return out;
  }

  const NewCaseOptions& options_;
  const CastingProcess& process_;
  material::Material alloy_;
  mesh::RawMesh mesh_;
  std::vector<GeometryBody> bodies_;
  std::vector<std::string> metal_;
  bool has_mould_ = false;
  mesh::Point low_{}, high_{};
  double volume_ = 0, area_ = 0, thickest_ = 0;
  std::vector<double> thickness_;
  std::vector<mesh::InscribedSphere> spheres_;
  Draft draft_;
  double nodes_ = 0, metal_nodes_ = 0, freezing_ = 0;  ///< of the last draft; [s]
};

}  // namespace

NewCaseReport make_new_case(const NewCaseOptions& options) {
  return NewCase(options).make();
}

}  // namespace solidus::model
