/// Times of birth follow from the centres of elements; the thermal phase is told when some are due.
#include "setup/deposition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "cases/roles.hpp"
#include "coupling/phases.hpp"
#include "coupling/scheme_kind.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "linear/birth_groups.hpp"
#include "material/external_law.hpp"
#include "mechanics/elements/simplices.hpp"
#include "mechanics/growing_bodies.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/assembly.hpp"
#include "setup/criteria_input.hpp"
#include "setup/deposition_checks.hpp"
#include "setup/heat_input.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/place_input.hpp"
#include "setup/section_names.hpp"
#include "setup/source_input.hpp"
#include "system/common_failure.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

using Kind = cases::DepositionSpec::Kind;

[[noreturn]] void refuse(const cases::DepositionSpec& d, const std::string& what,
                         const std::string& allowed) {
  throw InputError(d.where, fmt::format("the deposition '{}' {}", d.name, what), allowed);
}

Position place(const std::vector<double>& x) {
  Position position{};
  std::copy_n(x.begin(), std::min<std::size_t>(x.size(), 3), position.begin());
  return position;
}

double dot(const Position& a, const Position& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Position unit(Position d) {
  const double length = std::sqrt(dot(d, d));
  for (double& c : d) c /= length;
  return d;
}

void check_kind(const cases::DepositionSpec& d, std::size_t dimension) {
  if (d.kind == Kind::front) {
    const Position n = place(d.normal);
    if (d.from.size() != dimension || d.normal.size() != dimension || !d.speed || !(dot(n, n) > 0))
      refuse(d, "has no complete front",
             fmt::format("from and normal with {} components, and speed", dimension));
  } else if (d.kind == Kind::path) {
    if (!d.width || !d.depth) refuse(d, "has no 'width' and 'depth'", "width = \"6 mm\", depth = \"2 mm\"");
    if (const Position n = place(d.direction); !d.direction.empty() && !(dot(n, n) > 0))
      refuse(d, "has a 'direction' without a length", "direction = [0, 0, -1]");
    check_path(d.path, "the deposition '" + d.name + "'", d.where, static_cast<int>(dimension));
  } else if (!d.time) {
    refuse(d, "has no 'time'", "time = { formula = \"z/0.002\" }");
  }
}

/// When a plane that moves reaches a place; what is behind it at its start is there from the start.
double birth_by_front(const cases::DepositionSpec& d, const Position& x) {
  Position ahead = x;
  const Position from = place(d.from);
  for (std::size_t k = 0; k < 3; ++k) ahead[k] -= from[k];
  const double distance = dot(ahead, unit(place(d.normal)));
  return distance <= 0 ? -HUGE_VAL : d.start + distance / *d.speed;
}

/// When the point of a path passes a place that lies in its bead, on which move and how far along it;
/// infinite where it never does.
struct Passing {
  double time = HUGE_VAL;
  std::size_t move = 0;
  double along = 0;  ///< [m]
};

Passing passing(const cases::DepositionSpec& d, const TravelPath& path, int dimension, const Position& x) {
  constexpr double k_margin = 1e-6;  // of the bead
  Position down{};
  down[as_size(dimension) - 1] = -1;
  if (!d.direction.empty()) down = unit(place(d.direction));
  const std::vector<TravelPoint>& points = path.points();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (points[i].on == 0) continue;
    // Distances from the begin of the move: along it, into the bead, and across.
    Position move{}, r{};
    for (std::size_t k = 0; k < 3; ++k) {
      move[k] = points[i + 1].x[k] - points[i].x[k];
      r[k] = x[k] - points[i].x[k];
    }
    const double length = std::sqrt(dot(move, move));
    if (length == 0) continue;
    const double along = dot(r, move) / length, into = dot(r, down);
    const double across = std::sqrt(std::max(0.0, dot(r, r) - along * along - into * into));
    if (along < -k_margin * length || along > (1 + k_margin) * length || across > 0.5 * *d.width ||
        into < -k_margin * *d.depth || into > *d.depth)
      continue;
    return {points[i].time + std::max(0.0, along) / length * (points[i + 1].time - points[i].time), i, along};
  }
  return {};
}

std::vector<Position> centres(const mesh::Mesh& mesh, const mesh::ElementBlock& block) {
  const int n = mesh::vertex_count(block.shape);
  std::vector<Position> all(as_size(block.size()));
  for (Index e = 0; e < block.size(); ++e)
    for (int a = 0; a < n; ++a)
      for (std::size_t k = 0; k < 3; ++k) all[as_size(e)][k] += mesh.x[as_size(block.element(e)[a])][k] / n;
  return all;
}

/// The length of the pieces in which a path's elements are counted: no shorter than bead and elements. The
/// same on all processes. Collective.
double piece_of(const cases::DepositionSpec& d, const mesh::Mesh& mesh) {
  double reach = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (mesh.bodies[as_size(block.body)].name != d.body) continue;
    const std::vector<Position> x = centres(mesh, block);
    for (Index e = 0; e < block.size(); ++e) {
      const mesh::Point& corner = mesh.x[as_size(block.element(e)[0])];
      const Position& c = x[as_size(e)];
      reach = std::max(reach, std::hypot(corner[0] - c[0], corner[1] - c[1], corner[2] - c[2]));
    }
  }
  return std::max({*d.width, *d.depth, 2 * parallel::global_max(reach)});
}

/// Times of birth of a block's elements.
/// @param laid  counts those that a path lays down; null: there is no path
std::vector<double> births_of(const cases::CaseSpec& spec, const cases::DepositionSpec& d,
                              const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                              const std::optional<TravelPath>& path, LaidDown* laid) {
  const std::vector<Position> x = centres(mesh, block);
  std::vector<double> times(x.size());
  if (d.kind == Kind::times) {
    place_function(*d.time, cases::TimeOrigin::run, nullptr, spec.analysis.kind).values(x, 0, times);
    return times;
  }
  if (d.kind == Kind::front) {
    std::ranges::transform(x, times.begin(), [&](const Position& c) { return birth_by_front(d, c); });
    return times;
  }
  for (std::size_t e = 0; e < x.size(); ++e) {
    const Passing passed = passing(d, *path, spec.dimension(), x[e]);
    times[e] = passed.time;
    if (passed.time < HUGE_VAL) laid->count(passed.move, passed.along);
  }
  return times;
}

/// The births of all blocks, with warnings of what is never reached. Collective.
std::vector<linear::GrowingMesh::Births> all_births(const cases::CaseSpec& spec, const mesh::Mesh& mesh) {
  std::vector<linear::GrowingMesh::Births> births(mesh.blocks.size());
  for (const cases::DepositionSpec& d : spec.depositions) {
    double reached = 0, never = 0;
    std::optional<TravelPath> path;
    std::optional<LaidDown> laid;
    if (d.kind == Kind::path) {
      path = travel_path(d.path, spec.dimension(), d.where);
      laid.emplace(d, *path, piece_of(d, mesh));
    }
    run_collectively([&] {
      for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
        const mesh::ElementBlock& block = mesh.blocks[b];
        if (mesh.bodies[as_size(block.body)].name != d.body) continue;
        births[b] = births_of(spec, d, mesh, block, path, laid ? &*laid : nullptr);
        for (Index e = 0; e < block.n_counted; ++e) (births[b][as_size(e)] < HUGE_VAL ? reached : never) += 1;
      }
    });
    reached = parallel::global_sum(reached);
    never = parallel::global_sum(never);
    if (reached == 0)
      refuse(d, fmt::format("reaches none of the {:.0f} elements of '{}'", never, d.body),
             "a path through the body, in its unit of length; a width and a depth as those of its elements");
    if (never > 0)
      logging::warn("{}: the deposition '{}' never reaches {:.0f} of the {:.0f} elements of '{}'",
                    d.where.text(), d.name, never, never + reached, d.body);
    if (laid) laid->warn();
  }
  check_births(spec, mesh, births);
  return births;
}

std::vector<std::string> bare_surfaces(const cases::CaseSpec& spec, const mesh::Mesh& mesh) {
  std::vector<std::string> names(mesh.bodies.size());
  for (const cases::DepositionSpec& d : spec.depositions)
    for (std::size_t b = 0; b < names.size(); ++b)
      if (mesh.bodies[b].name == d.body) names[b] = d.bare;
  return names;
}

double interval_of(const cases::CaseSpec& spec) {
  double shortest = 0;
  for (const cases::DepositionSpec& d : spec.depositions)
    if (d.interval && (shortest == 0 || *d.interval < shortest)) shortest = *d.interval;
  return shortest;
}

}  // namespace

namespace {

/// Refuses options that are not available for growing bodies with stress.
void check_mechanics(const cases::CaseSpec& spec, const cases::DepositionSpec& d) {
  if (spec.simultaneous())
    refuse(d, "grows, which the simultaneous scheme cannot yet",
           fmt::format("coupling.scheme = \"{}\", or any other", coupling::k_stable_scheme));
  if (spec.dynamics) refuse(d, "grows, which inertia does not know yet", "no [dynamics]");
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions)
    if (c.relative)
      throw InputError(
          c.where,
          fmt::format("the condition '{}' counts from where nodes are when its stage begins, which "
                      "nodes that come with '{}' do not know",
                      c.name, d.name),
          "relative = false");
  for (const cases::BodySpec& body : spec.bodies)
    if (body.initial_stress)
      throw InputError(body.where,
                       fmt::format("the body '{}' starts with a stress while '{}' grows: not possible yet",
                                   body.name, d.name),
                       "no [body.initial_stress]");
}

}  // namespace

void check_depositions(const cases::CaseSpec& spec) {
  check_names(spec.depositions, "[[deposition]]");
  std::set<std::string> bodies;
  for (const cases::DepositionSpec& d : spec.depositions) {
    if (!spec.has_heat())
      refuse(d, "grows, which brings heat that mechanics alone does not follow",
             "physics = \"thermomechanical\" or \"heat\" in [analysis]");
    if (spec.has_mechanics()) check_mechanics(spec, d);
    if (spec.time.steady) refuse(d, "grows, and a steady analysis has no time for it", "steady = false");
    if (spec.heat.integration != heat::HeatIntegration::closed)
      refuse(d, "grows, which the open rule cannot yet", "heat.integration = \"closed\"");
    if (!spec.cycles.empty()) refuse(d, "grows, which cycles of stages cannot yet", "no [[cycle]]");
    if (!bodies.insert(d.body).second)
      refuse(d, fmt::format("is the second one of the body '{}'", d.body), "one deposition for each body");
    check_kind(d, as_size(spec.dimension()));
  }
  for (const cases::BodySpec& body : spec.bodies)
    if (!spec.depositions.empty() && !body.stages.empty())
      throw InputError(
          body.where,
          fmt::format("the body '{}' leaves while others grow, which is not possible yet", body.name),
          "no 'stages' of bodies together with a [[deposition]]");
}

namespace {

/// Checks that the elements of bodies that grow can have a stress.
void check_stress_of_growth(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                            const std::vector<material::Material>& materials) {
  for (const cases::DepositionSpec& d : spec.depositions)
    for (const mesh::ElementBlock& block : mesh.blocks) {
      const auto body = as_size(block.body);
      if (mesh.bodies[body].name != d.body || cases::only_conducts(spec.bodies[body])) continue;
      if (mechanics::is_mixed(block, materials[body], spec.mechanics.simplices))
        refuse(d, "grows in mixed triangles or tetrahedra, whose pressure old and new metal would share",
               "quadrilaterals or hexahedra, elements of second order, or mechanics.simplices = "
               "\"displacement\"");
      if (material::external_law(materials[body]) != nullptr)
        refuse(d, fmt::format("grows with the law of '{}', which is not the program's", materials[body].name),
               "a material of the built-in laws");
    }
}

/// The births of all blocks. Where bodies deform the blocks of the mesh are divided, so that each comes
/// whole: nothing may refer to them yet.
std::vector<linear::GrowingMesh::Births> births_of_blocks(const cases::CaseSpec& spec, Assembly& a) {
  std::vector<linear::GrowingMesh::Births> births = all_births(spec, a.mesh);
  if (!spec.has_mechanics()) return births;
  check_stress_of_growth(spec, a.mesh, a.materials);
  linear::divide_by_birth(a.mesh, births, interval_of(spec));
  return births;
}

}  // namespace

Deposition::Deposition(const cases::CaseSpec& spec, Assembly& a)
    : spec_(spec),
      a_(a),
      mesh_(a.mesh, births_of_blocks(spec, a), bare_surfaces(spec, a.mesh), interval_of(spec)),
      grows_(a.mesh.bodies.size(), 0) {
  for (const cases::DepositionSpec& d : spec.depositions)
    for (std::size_t b = 0; b < grows_.size(); ++b)
      if (a.mesh.bodies[b].name == d.body) grows_[b] = 1;
  // The mechanical phase is made on the whole mesh; build() then calls grow(0).
  if (!spec.has_mechanics()) mesh_.advance(0);
}

void Deposition::begin_contacts() {
  contacts_ = std::make_unique<GrowingContacts>(a_.mesh, a_.contacts);
  contacts_->follow(present(), 0, nullptr);
  for (std::size_t i = 0; i < a_.initial.contacts.size(); ++i)
    a_.initial.contacts[i] = a_.contacts[i]->parts().history.initial();
}

bool Deposition::due(double time) const {
  return std::ranges::any_of(mesh_.times(), [&](double t) { return t > mesh_.time() && t <= time; });
}

namespace {

/// Stress begins in the new elements at the temperatures that their nodes have now.
void grow_mechanics(const cases::CaseSpec& spec, const cases::StageRun* stage, double time,
                    coupling::State* state, Assembly& a) {
  if (state == nullptr)
    return mechanics::grow(*a.mechanics, mechanical_conditions(spec, stage), {.time = time}, nullptr);
  const std::vector<double> share = coupling::plateau_share(a.phases, state->heat);
  mechanics::grow(*a.mechanics, mechanical_conditions(spec, stage),
                  {.time = time, .temperature = state->heat.temperature, .plateau_share = share},
                  &state->mechanics);
}

}  // namespace

coupling::BodyHeat Deposition::grow(double time, coupling::State* state) {
  if (!mesh_.advance(time)) return {};
  // The conditions are those of the stage in which the step has ended. At the start there is no heat yet.
  const cases::StageRun* stage = a_.first_stage();
  for (const cases::StageRun& run : a_.stages)
    if (run.start < time) stage = &run;
  coupling::BodyHeat heat;
  if (a_.heat) {
    const InitialTemperatures& initial = *a_.initial_temperatures;
    heat.poured = a_.heat->grow(
        thermal_conditions(spec_, stage), [&](Index node, int body) { return initial.enthalpy(node, body); },
        state != nullptr ? &state->heat : nullptr);
  }
  if (a_.mechanics) grow_mechanics(spec_, stage, time, state, a_);
  // New nodes have their displacement and temperature: contact begins there.
  if (contacts_) contacts_->follow(present(), time, state);
  // Criteria refer to the elements and to the storage that have just changed; their records go on.
  if (a_.criteria)
    a_.criteria->replace(std::move(
        *make_criteria(spec_, present(), a_.materials, a_.start, a_.local_laws, a_.phases, &a_.mesh)));
  return heat;
}

double Deposition::mass() const {
  const heat::NodalEnthalpy& storage = a_.heat->storage();
  double sum = 0;
  for (Index i = 0; i < storage.n_nodes(); ++i)
    for (std::size_t b = 0; b < grows_.size(); ++b)
      if (grows_[b] != 0) sum += storage.volume(i, static_cast<int>(b)) * a_.materials[b].density;
  return parallel::global_sum(sum);
}

}  // namespace solidus::setup
