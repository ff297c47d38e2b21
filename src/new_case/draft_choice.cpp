/// Choices in the order in which they depend on each other; each leaves a line for the report.
#include "new_case/draft_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/roles.hpp"
#include "input/keys.hpp"
#include "new_case/feeders_file.hpp"
#include "new_case/riser_choice.hpp"
#include "new_case/rounding.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::new_case {

namespace {

class Choice {
 public:
  Choice(const NewCaseOptions& options, const CastingProcess& process, const material::Material& alloy,
         const PartMeasures& part)
      : options_(options), process_(process), alloy_(alloy), part_(part) {}

  Draft choose() {
    // The draft is chosen in the order in which choices depend on each other: temperatures from the alloy,
    // sizes from the walls, symmetry and riser, then bodies and mould.
    draft_.meshed = part_.meshed;
    draft_.geometry = options_.geometry;
    // The unit of the file itself is not repeated in the case, for two statements of it could disagree.
    if (!part_.file_unit) draft_.unit = options_.unit.empty() ? "mm" : options_.unit;
    draft_.process = process_.name;
    draft_.alloy = options_.alloy;
    draft_.coupled = alloy_.mechanical();
    const auto& curve = alloy_.solidification()->fraction;
    constexpr double k_celsius = 273.15;
    draft_.pouring = rounded_up(curve.liquidus() - k_celsius + process_.superheat, 5);
    draft_.liquidus = curve.liquidus() - k_celsius;
    draft_.superheat = draft_.pouring - draft_.liquidus;
    choose_sizes(1);
    // The thickest place decides how long freezing takes; a riser may be thicker still.
    thickest_ = 2 * (part_.spheres.empty() ? part_.thickness_at(0.9) / 2 : part_.spheres.front().radius);
    if (!options_.symmetry.empty()) choose_symmetry();
    if (options_.riser || !options_.feeders.empty()) choose_feeders();
    if (!options_.gating.empty()) choose_gating();
    choose_bodies();
    if (!part_.has_mould) choose_mould();
    // Hot spots become probes. They are folded to the half that is computed, and rounded so that the text is
    // short.
    constexpr std::size_t k_probes = 3;
    for (std::size_t i = 0; i < std::min(k_probes, part_.spheres.size()); ++i)
      draft_.hot_spots.push_back(part_.spheres[i]);
    for (mesh::InscribedSphere& sphere : draft_.hot_spots) {
      fold(sphere.centre);
      for (double& x : sphere.centre) x = to_micrometre(x);
    }
    if (options_.riser)
      for (DraftRiser& riser : draft_.risers) fold(riser.foot, 0);
    // Films, times and steps are first values that the estimate of freezing replaces.
    draft_.film = process_.film;
    draft_.film_source = process_.film_source;
    draft_.end = 3600;
    draft_.step = 1;
    draft_.every = 30;
    if (options_.shots > 0)
      draft_.shots = {options_.shots,
                      process_.pour,
                      600,
                      process_.open,
                      process_.eject,
                      process_.spray,
                      process_.close,
                      process_.spray_film,
                      process_.spray_source,
                      0};
    return draft_;
  }

 private:
  /// Into the half that is kept; what is near the plane of symmetry comes as near to it as a share of the
  /// thickest place.
  void fold(mesh::Point& x, double inside = 1e-3) const {
    if (!draft_.symmetry) return;
    double& c = x[as_size(draft_.symmetry->axis)];
    const double at = draft_.symmetry->at, near = 0.1 * thickest_;
    if (c > at) c = 2 * at - c;
    // A place that is nearly on the plane is moved close to it, so that a probe and its image are not two
    // points next to each other.
    if (at - c < near) c = at - inside * thickest_;
  }

  void choose_symmetry() {
    // The plane lies in the middle of the part along the axis.
    const auto axis = as_size(options_.symmetry[0] - 'x');
    const double middle = 0.5 * (part_.low[axis] + part_.high[axis]);
    // The box is that of the facets of a coarse mesh, and so is the centre of its bodies: the CAD kernel has
    // the centre of the surfaces themselves, in which the plane lies.
    double first = 0, whole = 0;
    for (const setup::GeometryBody& body : part_.bodies)
      first += body.extent.volume * body.extent.centre[axis], whole += body.extent.volume;
    const double centre = part_.mesh.centre_of_volume ? (*part_.mesh.centre_of_volume)[axis] : first / whole;
    constexpr double k_even = 2e-3;
    if (std::abs(centre - middle) > k_even * (part_.high[axis] - part_.low[axis]))
      throw InputError(
          {"--symmetry"},
          fmt::format(
              "the geometry is not symmetric in {}: its centre of volume lies at {:.4g} mm, the middle "
              "of its box at {:.4g} mm",
              options_.symmetry, 1e3 * centre, 1e3 * middle),
          "an axis normal to a plane of symmetry");
    // A cut next to the plane that faces and edges of the part lie on would leave slivers.
    draft_.symmetry = {static_cast<int>(axis), round_place(centre, part_.high[axis] - part_.low[axis])};
  }

  /// Sizes for about 3500 nodes of metal, with two elements through walls where those suffice. Of a part that
  /// is thin throughout the skin alone must not have more than 6000.
  void choose_sizes(double scale) {
    constexpr double k_nodes = 3500, k_nodes_per_cube = 3, k_nodes_of_skin = 6000, k_nodes_per_square = 1.15;
    const double half = options_.symmetry.empty() ? 1 : 0.5;
    // The number of elements falls with the cube of their size and that of the skin with its square; a
    // fineness of two halves the size.
    const double by_number = std::cbrt(k_nodes_per_cube * half * part_.volume / k_nodes) / options_.fineness;
    const double by_skin =
        std::sqrt(k_nodes_per_square * half * part_.area / k_nodes_of_skin) / options_.fineness;
    const double least = std::max(0.6 * by_number, by_skin), largest = std::max(by_number, least);
    draft_.size = two_digits(scale * largest);
    draft_.smallest = two_digits(scale * std::clamp(0.5 * part_.thickness_at(0.1), least, largest));
    draft_.mould_size = two_digits(std::max(
        2.5 * draft_.size, 0.6 * (part_.high[0] - part_.low[0] + part_.high[1] - part_.low[1]) / 20));
  }

  void choose_bodies() {
    int castings = 0;
    // A single casting without a name of its own is called so; others keep the names of the geometry.
    for (const setup::GeometryBody& body : part_.bodies) castings += body.role == cases::Role::casting;
    for (const setup::GeometryBody& body : part_.bodies) {
      DraftBody& draft = draft_.bodies.emplace_back();
      draft.group = body.name;
      draft.name = castings == 1 && body.role == cases::Role::casting && body.name.starts_with("body_")
                       ? "casting"
                       : body.name;
      draft.role = body.role;
      describe(draft_, process_, draft);
    }
    const auto add = [&](const std::string& name, cases::Role role) {
      DraftBody& body = draft_.bodies.emplace_back();
      body.name = body.group = name;
      body.role = role;
      describe(draft_, process_, body);
    };
    // Risers, gating, sleeves and chills follow the bodies of the file, each as a body with a role of its
    // own.
    for (const DraftRiser& riser : draft_.risers) add(riser.name, cases::Role::riser);
    for (const mesh::GatingSystem& gating : draft_.gatings) add(gating.name, cases::Role::gating);
    for (const DraftRiser& riser : draft_.risers)
      if (riser.sleeve > 0) add(riser.name + "_sleeve", cases::Role::sleeve);
    for (const DraftChill& chill : draft_.chills) add(chill.name, cases::Role::chill);
  }

  void choose_mould() {
    DraftMould& mould = draft_.mould.emplace();
    // A part of a few millimetres has no walls of the usual least thickness: nearly all nodes would be
    // theirs.
    constexpr double k_small_part = 4;
    const double least = std::min(process_.least_wall, k_small_part * thickest_);
    constexpr double k_room_of_shell = 1.25;
    const double shell = options_.shell > 0 ? options_.shell : process_.shell;
    const double wall =
        of_wall(shell > 0 ? k_room_of_shell * shell : std::max(least, process_.walls * thickest_));
    mould.walls.fill(wall);
    // At the plane of symmetry and at an open top there is no wall, because the mould ends there.
    if (draft_.symmetry) mould.walls[2 * as_size(draft_.symmetry->axis) + 1] = 0;
    if (opens_on_top() || ends_in_a_riser()) mould.walls[5] = 0;  // open at the top
    DraftBody& body = draft_.bodies.emplace_back();
    body.name = body.group = process_.mould == cases::Role::die ? "die" : "mould";
    mould.name = body.name;
    body.role = process_.mould;
    describe(draft_, process_, body);
    draft_.law = process_.law;
    // The shell replaces the block in the draft, after which the size of the block's elements is that of the
    // shell.
    if (shell > 0) choose_shell(shell, body);
    // Away from the metal elements grow with the wall that they fill, not with the part.
    if (!draft_.shell)
      draft_.mould_size = std::clamp(draft_.mould_size, two_digits(wall / 4),
                                     two_digits(std::max(wall / 1.5, std::max(draft_.size, wall / 4))));
  }

  /// The shell is cut out of the block, whose elements are no thicker than it is.
  void choose_shell(double thickness, DraftBody& body) {
    constexpr double k_elements_through = 1.3;
    draft_.shell = {.thickness = thickness};
    draft_.mould->name = "block";
    body.name = body.group = draft_.shell->name;
    draft_.mould_size = two_digits(thickness / k_elements_through);
  }

  /// Chosen here, or given in a file.
  void choose_feeders() {
    // A second riser for a thick place that has one would stand in the first.
    if (part_.has_riser()) throw InputError({"--riser"}, "the geometry has a riser already", "no --riser");
    if (options_.riser) {
      RiserChoice choice = choose_risers(part_, std::abs(alloy_.solidification()->volume_change),
                                         feeding_distance(alloy_), draft_.symmetry);
      draft_.risers = std::move(choice.risers);
      draft_.riser_notes = std::move(choice.notes);
      end_at_one_height();
    } else {
      Feeders given = read_feeders(options_.feeders);
      draft_.risers = std::move(given.risers);
      draft_.chills = std::move(given.chills);
    }
    // A riser that is thicker than the part freezes last, and the mould has to be as wide as heat gets until
    // then.
    for (const DraftRiser& riser : draft_.risers) thickest_ = std::max(thickest_, riser.diameter);
  }

  /// Gating of a file. A thick runner freezes late, as a thick riser does.
  void choose_gating() {
    draft_.gatings = read_gating(options_.gating);
    for (const mesh::GatingSystem& gating : draft_.gatings)
      thickest_ = std::max({thickest_, std::min(gating.runner_width, gating.runner_height),
                            0.5 * (gating.foot_diameter + gating.top_diameter)});
  }

  /// Lets the risers end where the highest does, so that all are open, but for those that would become half
  /// as high again, which are closed.
  void end_at_one_height() {
    constexpr double k_longer = 1.5;
    double top = -1e300;
    for (const DraftRiser& riser : draft_.risers) top = std::max(top, riser.foot[2] + riser.height);
    for (DraftRiser& riser : draft_.risers)
      if (top - riser.foot[2] < k_longer * riser.height) riser.height = top - riser.foot[2];
  }

  /// Whether a riser or a sprue that was put onto the parts reaches above all of them.
  bool opens_on_top() const {
    const auto above = [&](double top) { return top > part_.high[2]; };
    return std::ranges::any_of(
               draft_.risers, [&](const DraftRiser& riser) { return above(riser.foot[2] + riser.height); }) ||
           std::ranges::any_of(draft_.gatings,
                               [&](const mesh::GatingSystem& gating) { return above(gating.top[2]); });
  }

  /// Whether a riser or the gating of the file is what reaches highest of all metal: a pouring cup is open;
  /// under pressure nothing is.
  bool ends_in_a_riser() const {
    double riser = -1e300, other = -1e300;
    for (const setup::GeometryBody& body : part_.bodies) {
      double& high = body.role == cases::Role::riser || body.role == cases::Role::gating ? riser : other;
      if (cases::is_poured(body.role)) high = std::max(high, body.extent.high[2]);
    }
    // Tops that differ by a thousandth of the height count as equal, since the extents are those of facets.
    const double top = part_.high[2], near = 1e-3 * (top - part_.low[2]);
    return process_.mould == cases::Role::mould && riser > top - near && other < riser - near;
  }

  const NewCaseOptions& options_;
  const CastingProcess& process_;
  const material::Material& alloy_;
  const PartMeasures& part_;
  double thickest_ = 0;  ///< diameter of the largest sphere in the metal [m]
  Draft draft_;
};

/// Shells are poured hot, some 350 degC for aluminium and 900 degC for steel.
double shell_start(const Draft& draft, const CastingProcess& process) {
  constexpr double k_step = 50;
  return k_step * std::round(process.preheat * draft.liquidus / k_step);
}

/// A die or mould is warm by its process, but a die for tin takes up heat too: it is well below the liquidus.
double mould_start(const Draft& draft, const CastingProcess& process) {
  constexpr double k_below = 120, k_step = 10, k_cold = 20;
  const double highest = k_step * std::floor((draft.liquidus - k_below) / k_step);
  return std::max(std::min(process.mould_start, highest), k_cold);
}

}  // namespace

void describe(const Draft& draft, const CastingProcess& process, DraftBody& body) {
  // Material, initial temperature and comment of a body follow from its role. Materials are the first of a
  // list that the library has.
  switch (body.role) {
    case cases::Role::casting:
    case cases::Role::riser:
    case cases::Role::gating:
      body.material = draft.alloy;
      body.start = draft.pouring;
      body.comment =
          fmt::format("{:.0f} K above the liquidus of {:.0f} degC", draft.superheat, draft.liquidus);
      break;
    case cases::Role::chill:
      body.material = first_known({"iron_chill"});
      body.start = 20;
      body.heat_only = true;
      break;
    case cases::Role::sleeve:
    case cases::Role::insulation:
      body.material = first_known({"insulating_sleeve", "ceramic_fibre", "green_sand"});
      body.start = 20;
      break;
    case cases::Role::core:
      body.material = first_known({"furan_sand", "green_sand"});
      body.start = process.mould == cases::Role::die ? 80 : 20;
      if (process.shell > 0) {  // a core that is fired with the shell
        body.material = first_known(process.materials);
        body.start = shell_start(draft, process);
      }
      break;
    case cases::Role::mould:
    case cases::Role::die:
      body.material = first_known(process.materials);
      body.start = process.shell > 0 ? shell_start(draft, process) : mould_start(draft, process);
      if (process.shell > 0) body.comment = "poured hot from the furnace: an estimate, by the liquidus";
      body.heat_only = process.mould == cases::Role::die;
      if (body.heat_only) body.comment = "physics = \"all\" gives its stresses too, at the price of time";
      break;
  }
  body.heat_only = body.heat_only && draft.coupled;
}

Draft choose_draft(const NewCaseOptions& options, const CastingProcess& process,
                   const material::Material& alloy, const PartMeasures& part) {
  return Choice(options, process, alloy, part).choose();
}

}  // namespace solidus::new_case
