/// Answers are found field by field, over all processes, with the place of each extreme.
#include "results/answers/answers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "contact/contact_report.hpp"
#include "contact/quantities.hpp"
#include "criteria/freezing.hpp"
#include "criteria/gather.hpp"
#include "criteria/pools.hpp"
#include "criteria/quantities.hpp"
#include "heat/quantities.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "mechanics/quantities.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"
#include "parallel/parallel.hpp"
#include "results/fields/spots.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace {

/// The largest value seen so far; of equal ones that with the least number in the input.
class Largest {
 public:
  void see(double value, double number, const mesh::Point& where) {
    if (number_ >= 0 && (value < best_.value || (value == best_.value && number >= number_))) return;
    best_ = {value, where};
    number_ = number;
  }
  /// Over all processes; nothing where none has seen any. Collective.
  std::optional<ValueAt> over_processes() const {
    const double own[] = {best_.value, number_, best_.where[0], best_.where[1], best_.where[2]};
    const std::vector<double> all = criteria::gathered(own);
    Largest largest;
    for (std::size_t k = 0; k + 4 < all.size(); k += 5)
      if (all[k + 1] >= 0) largest.see(all[k], all[k + 1], {all[k + 2], all[k + 3], all[k + 4]});
    return largest.number_ >= 0 ? std::optional(largest.best_) : std::nullopt;
  }

 private:
  ValueAt best_;
  double number_ = -1;
};

/// The owned nodes of a body.
std::vector<char> owned_nodes_of(const mesh::Mesh& mesh, int body) {
  std::vector<char> chosen(as_size(mesh.n_owned_nodes), 0);
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (block.body == body)
      for (const Index node : block.nodes)
        if (node < mesh.n_owned_nodes) chosen[as_size(node)] = 1;
  return chosen;
}

template <class See>
std::optional<ValueAt> largest_at(const mesh::Mesh& mesh, const std::vector<char>& nodes, const See& value) {
  Largest largest;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] != 0)
      if (const std::optional<double> v = value(i))
        largest.see(*v, static_cast<double>(mesh.input_node[i]), mesh.x[i]);
  return largest.over_processes();
}

/// The least Niyama value of a body that has frozen anywhere.
std::optional<ValueAt> least_niyama(const mesh::Mesh& mesh, const std::vector<char>& nodes,
                                    const FieldSet& fields) {
  const FieldValues niyama(fields, criteria::fields::k_niyama.name);
  if (niyama.empty()) return {};
  std::optional<ValueAt> least = largest_at(
      mesh, nodes, [&](std::size_t i) { return niyama[i] > 0 ? std::optional(-niyama[i]) : std::nullopt; });
  if (least) least->value = -least->value;
  return least;
}

/// Returns the volume that a body has lost by feeding, where the run follows it. Collective.
std::optional<Shrinkage> shrinkage_of(const coupling::Phases& phases, const mesh::Mesh& mesh, int body,
                                      const FieldSet& fields) {
  const FieldValues emptied(fields, criteria::fields::k_emptied.name),
      unfed(fields, criteria::fields::k_unfed_pores.name), gas(fields, criteria::fields::k_gas_pores.name);
  if (emptied.empty()) return {};
  // Melt that has risen above its room fills no hole elsewhere, so that each node counts for itself.
  std::array<double, 4> sums{};
  for (Index i = 0; i < mesh.n_owned_nodes; ++i) {
    const double room = phases.heat->storage().volume(i, body);
    const auto node = as_size(i);
    sums[0] += room;
    sums[1] += room * std::max(0.0, emptied[node]);
    if (!unfed.empty()) sums[2] += room * unfed[node];
    if (!gas.empty()) sums[3] += room * gas[node];
  }
  processes::sum(sums);
  return Shrinkage{.volume = sums[0], .holes = sums[1], .unfed = sums[2], .of_gas = sums[3]};
}

double mass_of(const coupling::Phases& phases, const mesh::Mesh& mesh, int body) {
  double volume = 0;
  for (Index i = 0; i < mesh.n_owned_nodes; ++i) volume += phases.heat->storage().volume(i, body);
  return phases.heat->storage().material(body).density * parallel::global_sum(volume);
}

CastAnswer cast_answer(const mesh::Mesh& mesh, const coupling::Phases& phases, const coupling::State& state,
                       const CastBody& cast, const FieldSet& fields) {
  // The answer of one cast body: how much is solid, when and where the last of it froze, or where it is
  // hottest now. Each part needs a field that was followed; without it the part stays empty.
  CastAnswer answer;
  answer.cast = cast;
  answer.solid_fraction = phases.heat->states().mean_solid_fraction(state.heat, cast.body);
  const std::vector<char> nodes = owned_nodes_of(mesh, cast.body);
  const auto last_melt = [&] {
    const FieldValues frozen(fields, criteria::fields::k_solidified_at.name);
    return largest_at(mesh, nodes, [&](std::size_t i) {
      return frozen.empty() || frozen[i] < 0 ? std::nullopt : std::optional(frozen[i]);
    });
  };
  // A body that has left has no volume, so its fraction is not a number; what it froze with is still known.
  if (!std::isfinite(answer.solid_fraction)) {  // without volume: the body has left
    answer.there = false;
    answer.solid_fraction = 0;
    if (time_to_solidify(mesh, fields, {cast})) answer.froze = last_melt();
    return answer;
  }
  answer.mass = mass_of(phases, mesh, cast.body);
  answer.least_niyama = least_niyama(mesh, nodes, fields);
  answer.shrinkage = shrinkage_of(phases, mesh, cast.body, fields);
  // A share that rounding alone keeps from one is solid.
  constexpr double k_rounding = 1e-12;
  const auto before_the_last_pour = [&]() -> std::optional<ValueAt> {
    for (const criteria::Freezing::LastMelt& last : criteria::Freezing::frozen_before(state.criteria))
      if (last.body == cast.body) return ValueAt{last.time, last.where};
    return std::nullopt;
  };
  // A solid body tells its last melt, or that of the pour before if it was solid when the record began.
  if (answer.solid_fraction >= 1 - k_rounding) {
    answer.solid_fraction = 1;
    answer.froze = last_melt();
    if (!answer.froze) answer.froze = before_the_last_pour();
    return answer;
  }
  // What is still partly melt tells its hottest node among those with the least solid fraction.
  const FieldValues solid(fields, heat::fields::k_solid_fraction.name),
      temperature(fields, heat::fields::k_temperature.name);
  const std::optional<ValueAt> softest =
      largest_at(mesh, nodes, [&](std::size_t i) { return std::optional(-solid[i]); });
  if (softest)
    answer.hottest = largest_at(mesh, nodes, [&](std::size_t i) {
      return -solid[i] < softest->value ? std::nullopt : std::optional(temperature[i]);
    });
  return answer;
}

std::optional<Answers::CutOffPools> cut_off_pools(const criteria::CriteriaState& state) {
  for (const criteria::CriterionRecord& record : state.records) {
    if (record.name != criteria::Pools::k_name) continue;
    Answers::CutOffPools found;
    for (const criteria::Pool& pool : criteria::Pools::pools(record)) {
      if (pool.closed_off < 0) continue;
      ++found.number;
      if (pool.largest <= found.largest && found.number > 1) continue;
      found.largest = pool.largest;
      found.where = pool.where;
      found.frozen = pool.frozen >= 0 ? std::optional(pool.frozen) : std::nullopt;
    }
    return found;
  }
  return {};
}

/// The largest value of each contact at the nodes of its slave.
/// @param value  of a contact, by its index and an owned node: nothing where it is of no interest
template <class Value>
std::vector<GapAnswer> largest_of_contacts(const mesh::Mesh& mesh, const coupling::Phases& phases,
                                           const Value& value) {
  std::vector<GapAnswer> found;
  for (std::size_t k = 0; k < phases.contacts.size(); ++k) {
    const contact::ContactParameters& pair = phases.contacts[k]->parts().spec;
    std::vector<char> nodes(as_size(mesh.n_owned_nodes), 0);
    if (const auto slave = mesh.surfaces.find(pair.slave); slave != mesh.surfaces.end())
      for (const Index node : slave->second.nodes)
        if (node < mesh.n_owned_nodes) nodes[as_size(node)] = 1;
    const std::optional<ValueAt> largest =
        largest_at(mesh, nodes, [&](std::size_t i) { return value(k, i); });
    if (largest) found.push_back({pair.name, *largest});
  }
  return found;
}

std::vector<GapAnswer> largest_gaps(const mesh::Mesh& mesh, const coupling::Phases& phases,
                                    const FieldSet& fields) {
  const FieldValues gap(fields, contact::fields::k_gap.name);
  return largest_of_contacts(mesh, phases, [&](std::size_t, std::size_t i) {
    return !gap.empty() && gap[i] > 0 ? std::optional(gap[i]) : std::nullopt;
  });
}

/// With what soft skins have sunk in, which the field of the gaps leaves out.
std::vector<GapAnswer> deepest_overlaps(const mesh::Mesh& mesh, const coupling::Phases& phases,
                                        std::span<const double> temperature) {
  std::vector<std::vector<double>> overlap(phases.contacts.size());
  for (std::size_t k = 0; k < overlap.size(); ++k) {
    overlap[k].resize(as_size(mesh.n_owned_nodes), 0.0);
    const contact::ContactNodalFields here = contact::nodal_fields(phases.contacts[k]->view(), temperature);
    for (std::size_t a = 0; a < here.nodes.size(); ++a) overlap[k][as_size(here.nodes[a])] = here.overlap[a];
  }
  return largest_of_contacts(mesh, phases, [&](std::size_t k, std::size_t i) {
    return overlap[k][i] > 0 ? std::optional(overlap[k][i]) : std::nullopt;
  });
}

/// The largest von Mises stress in some bodies, and which of them has it.
void add_stress(const mesh::Mesh& mesh, const FieldSet& fields, const std::vector<char>& bodies,
                Answers& answers) {
  const FieldValues stress(fields, mechanics::fields::k_von_mises.name);
  // A run without mechanics has no stress.
  if (stress.empty()) return;
  std::vector<Largest> of_body(mesh.bodies.size());
  std::size_t first = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    const auto body = as_size(block.body);
    if (bodies[body] != 0)
      for (Index e = 0; e < block.n_counted; ++e)
        of_body[body].see(stress[first + as_size(e)], static_cast<double>(block.input_element[as_size(e)]),
                          centre(mesh, block, e));
    first += as_size(block.size());
  }
  // The largest of each body over all processes, then of all bodies, with the body's name.
  for (std::size_t b = 0; b < of_body.size(); ++b) {
    const std::optional<ValueAt> largest = of_body[b].over_processes();
    if (!largest || largest->value <= 0 || (answers.stress && largest->value <= answers.stress->value))
      continue;
    answers.stress = largest;
    answers.stressed_body = mesh.bodies[b].name;
  }
}

/// The pores of some bodies, where any have opened.
std::optional<Pores> pores_in(const mesh::Mesh& mesh, AnalysisKind kind, const FieldSet& fields,
                              const std::vector<char>& bodies) {
  const FieldValues fraction(fields, mechanics::fields::k_pore_fraction.name);
  if (fraction.empty()) return {};
  // The densest element and the volume of all pores; the whole volume, of which that is a share.
  Largest densest;
  double volume = 0, whole = 0;
  std::size_t first = 0;
  // Fractions weighted by volume, and the densest element; over all processes in the end.
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (bodies[as_size(block.body)] != 0) {
      const PackVector<Lane> integrals = mesh::basis_integrals(mesh, block, kind);
      const auto n_nodes = as_size(mesh::node_count(block.shape));
      for (Index e = 0; e < block.n_counted; ++e) {
        double of_element = 0;
        for (std::size_t a = 0; a < n_nodes; ++a)
          of_element += integrals[as_size(e / k_lanes) * n_nodes + a][e % k_lanes];
        const double value = fraction[first + as_size(e)];
        whole += of_element;
        volume += value * of_element;
        densest.see(value, static_cast<double>(block.input_element[as_size(e)]), centre(mesh, block, e));
      }
    }
    first += as_size(block.size());
  }
  // A run in which no pore has opened has no answer.
  const std::optional<ValueAt> largest = densest.over_processes();
  volume = parallel::global_sum(volume);
  whole = parallel::global_sum(whole);
  if (!largest || !(largest->value > 0)) return {};
  return Pores{.volume = volume, .share = volume / whole, .densest = *largest};
}

}  // namespace

Answers answers(const mesh::Mesh& mesh, const coupling::Phases& phases, const coupling::State& state,
                const std::vector<CastBody>& castings, const FieldSet& fields, bool mechanical) {
  // Castings are asked one by one. Without a casting named, all bodies count for the stress.
  Answers a;
  a.time = state.time;
  a.poured = state.poured;
  std::vector<char> stressed(mesh.bodies.size(), castings.empty() ? 1 : 0);
  std::vector<char> cast_nodes(as_size(mesh.n_owned_nodes), 0);
  for (const CastBody& cast : castings) {
    if (phases.heat != nullptr) a.castings.push_back(cast_answer(mesh, phases, state, cast, fields));
    stressed[as_size(cast.body)] = 1;
    const std::vector<char> own = owned_nodes_of(mesh, cast.body);
    for (std::size_t i = 0; i < own.size(); ++i) cast_nodes[i] |= own[i];
  }
  if (!castings.empty()) a.pools = cut_off_pools(state.criteria);
  // Gaps, pores, distortion and stress need mechanics and the fields of its last state.
  if (phases.mechanics == nullptr || !mechanical) return a;
  std::vector<char> parts(mesh.bodies.size(), 0);
  for (CastAnswer& cast : a.castings) {
    std::vector<char> own(mesh.bodies.size(), 0);
    own[as_size(cast.cast.body)] = 1;
    cast.pores = pores_in(mesh, phases.mechanics->bodies().kind, fields, own);
    if (cast.cast.is_part()) parts[as_size(cast.cast.body)] = 1;
  }
  // Pores of the whole are those of the parts; risers and gating are cut off and count only where there is no
  // part.
  const bool any_part = std::ranges::find(parts, 1) != parts.end();
  if (!castings.empty())
    a.pores = pores_in(mesh, phases.mechanics->bodies().kind, fields, any_part ? parts : stressed);
  a.gaps = largest_gaps(mesh, phases, fields);
  a.overlaps = deepest_overlaps(mesh, phases, state.heat.temperature);
  // The largest distortion is sought at nodes of castings alone.
  if (const FieldValues distortion(fields, criteria::fields::k_distortion.name);
      !distortion.empty() && !castings.empty()) {
    a.distortion = largest_at(mesh, cast_nodes, [&](std::size_t i) {
      const double length = distortion.length(i);
      return length > 0 ? std::optional(length) : std::nullopt;
    });
  }
  add_stress(mesh, fields, stressed, a);
  for (const CastBody& cast : castings)  // the mesh knows the body by its group
    if (mesh.bodies[as_size(cast.body)].name == a.stressed_body) a.stressed_body = cast.name;
  return a;
}

std::optional<double> poured_share_of_parts(const Answers& answers) {
  double parts = 0, all = 0;
  bool others = false;
  for (const CastAnswer& cast : answers.castings) {
    if (!cast.there) return {};
    all += cast.mass;
    if (cast.cast.is_part()) parts += cast.mass;
    others = others || !cast.cast.is_part();
  }
  return others && parts > 0 ? std::optional(parts / all) : std::nullopt;
}

double solid_fraction(const coupling::Phases& phases, const coupling::State& state,
                      const std::vector<CastBody>& castings, const mesh::Mesh& mesh) {
  double solid = 0, whole = 0;
  for (const CastBody& cast : castings) {
    double own = 0;
    for (Index i = 0; i < mesh.n_owned_nodes; ++i) own += phases.heat->storage().volume(i, cast.body);
    const double volume = parallel::global_sum(own);
    if (volume == 0) continue;  // it has left
    whole += volume;
    solid += volume * phases.heat->states().mean_solid_fraction(state.heat, cast.body);
  }
  return whole > 0 ? solid / whole : 1.0;
}

}  // namespace solidus::results
