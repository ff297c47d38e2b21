/// The balance of metal of a step: what each node asks for, what pools and mush give, and how the totals
/// are booked by cause. Levels and pools are found in feeding_levels.cpp and feeding_pools.cpp.
#include "criteria/feeding.hpp"

#include <algorithm>
#include <utility>

#include "criteria/criterion_kind.hpp"
#include "criteria/feeding_step.hpp"
#include "criteria/quantities.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

constexpr int k_row = 11;

CriterionColumn empty_column(const mesh::Mesh& mesh) {
  return make_column(mesh, "metal", mesh::FieldPlace::node, static_cast<int>(k_feeding_numbers));
}

/// Fields of a run with gas.
constexpr std::array k_with_gas = {&fields::k_emptied, &fields::k_unfed_pores, &fields::k_gas_pores};

FeedingRows rows_of(CriterionRecord& record) {
  return FeedingRows(record.columns[0].values);
}

void put(const FeedingTotals& t, CriterionRecord& record) {
  record.tables[0].values = {t.room,   t.melt,  t.freezing, t.solid, t.pipe, t.sink,
                             t.cavity, t.pores, t.outside,  t.gas,   t.wall};
}

}  // namespace

Feeding::Feeding(const mesh::Mesh& mesh, AnalysisKind kind, const heat::NodalEnthalpy& storage,
                 const FeedingOptions& options)
    : mesh_(mesh),
      storage_(storage),
      followed_(options.bodies),
      up_(options.upward()),
      ghosts_(mesh),
      connectivity_(mesh, ghosts_, options.bodies),
      graph_(mesh, kind, options),
      rigidity_(options.mould_rigidity),
      most_wall_(most_wall(options)),
      body_(mesh.x.size(), -1) {
  // Each body has its feeding law; followed ones also have the volume of their metal by temperature, and the
  // gas that they hold.
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    const material::Material& material = storage.material(static_cast<int>(b));
    laws_.emplace_back(material);
    metals_.push_back(followed_[b] != 0 ? std::optional<MetalVolume>(material) : std::nullopt);
    gas_.push_back(followed_[b] != 0 ? GasLaw::of(material, options.gas) : std::nullopt);
  }
  // A node of several followed bodies belongs to that of the largest volume there. Only the owner knows all
  // elements of a node, so ghosts are told.
  std::vector<double> body(mesh.x.size(), -1);
  for (Index i = 0; i < mesh.n_owned_nodes; ++i) {
    double most = 0;
    for (std::size_t b = 0; b < followed_.size(); ++b) {
      const double volume = followed_[b] != 0 ? storage.volume(i, static_cast<int>(b)) : 0.0;
      if (volume <= most) continue;
      most = volume;
      body[as_size(i)] = static_cast<double>(b);
    }
  }
  ghosts_.update(body, 1);
  std::transform(body.begin(), body.end(), body_.begin(), [](double b) { return static_cast<int>(b); });
}

bool Feeding::follows(const CriterionContext& c) {
  return c.heat != nullptr && !c.mechanics && c.feeding && has_shrinkage(c.materials, c.followed);
}

bool Feeding::has_shrinkage(const std::vector<material::Material>& materials,
                            const std::vector<char>& followed) {
  for (std::size_t b = 0; b < followed.size(); ++b)
    if (followed[b] != 0 && MetalVolume(materials[b]).changes()) return true;
  return false;
}

double Feeding::room(std::size_t node) const {
  double room = 0;
  for (std::size_t b = 0; b < followed_.size(); ++b)
    if (followed_[b] != 0) room += storage_.volume(as_index(node), static_cast<int>(b));
  return room;
}

CriterionRecord Feeding::initial(const CriterionInput& start) const {
  CriterionRecord record{k_name, {empty_column(mesh_)}, {{"feeding", k_row, {}}}};
  put({}, record);
  return restart(record, start);
}

// Metal that stays keeps what it has; what is poured next to it fills the rest of the room.
CriterionRecord Feeding::restart(const CriterionRecord& before, const CriterionInput& start) const {
  CriterionRecord record = before;
  const FeedingRows rows = rows_of(record);
  double added = 0;
  for (std::size_t i = 0; i < as_size(mesh_.n_owned_nodes); ++i) {
    if (body_[i] < 0) continue;
    const double now = room(i), had = rows(i, k_room);
    if (!(now > had)) continue;
    const VolumeParts volume = metal_of(i).at(start.heat.temperature[i], start.plateau_at(i));
    const double kept = had / now;
    if (had == 0) {
      rows(i, k_thermal) = volume.thermal;
      rows(i, k_phase) = volume.phase;
    }
    // Metal that is poured next to it takes on the volume of the metal that is there, as if it froze at once:
    // the balance has one volume a node.
    const double present = 1 + rows(i, k_thermal) + rows(i, k_phase);
    for (const FeedingNumber number :
         {k_metal, k_drained, k_pipe, k_sink, k_cavity, k_pores, k_gas, k_wall, k_poured})
      rows(i, number) *= kept;
    rows(i, k_metal) += (1 - kept) / present;
    rows(i, k_poured) += (1 - kept) / present;
    rows(i, k_room) = now;
    added += now - had;
  }
  ghosts_.update(record.columns[0].values, static_cast<int>(k_feeding_numbers));
  FeedingTotals totals = Feeding::totals(record);
  totals.room += parallel::global_sum(added);
  put(totals, record);
  return record;
}

FeedingTotals Feeding::totals(const CriterionRecord& record) {
  const std::vector<double>& v = record.tables[0].values;
  return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9], v[10]};
}

void Feeding::step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) {
  Step step(mesh_, rows_of(record), old, next);
  measure(old, next, step);
  if (parallel::any_process(step.melts)) feed(step);
  FeedingTotals totals = Feeding::totals(record);
  commit(step, totals);
  ghosts_.update(record.columns[0].values, static_cast<int>(k_feeding_numbers));
  put(totals, record);
}

void Feeding::measure(const CriterionInput& old, const CriterionInput& next, Step& step) const {
  for (std::size_t i = 0; i < mesh_.x.size(); ++i) {
    // Nodes without followed metal take no part.
    if (body_[i] < 0 || !(step.rows(i, k_room) > 0)) continue;
    const bool owned = i < step.demands.size();
    const MetalVolume& metal = metal_of(i);
    // The step is described by the mean of both ends: how much is solid, what can move, what is
    // soft.
    const double before = old.solid_fraction[i], after = next.solid_fraction[i];
    const bool frozen = before >= 1 && after >= 1, stands = step.rows(i, k_drained) < 1 - k_nothing;
    // Metal that froze before the melt around it sank is solid and asks for nothing. The curve of freezing
    // does not know that, so the node takes what it asks for from the pool, without resistance.
    step.solid[i] = stands ? (before + after) / 2 : 0;
    step.mobile[i] = (metal.mobile_share(before) + metal.mobile_share(after)) / 2;
    step.soft[i] = !frozen && step.rows.fill(i) > k_nothing;
    step.inside[i] = step.soft[i] != 0 && metal.mobile_share(before) > 0 && stands;
    if (!frozen && stands) {
      constexpr double k_mean = 0.5;  // of a step in which it begins to freeze
      // The local time of freezing decides the spacing of arms and with it the permeability of
      // mush.
      double& time = step.rows(i, k_freezing);
      time = after > 0 ? time + (before > 0 ? 1 : k_mean) * step.dt : 0;
      if (step.inside[i] != 0) blow(i, step);
      step.rows(i, k_wall) += wall_yields(i, old, next, step);
    }
    // Only the owner asks for metal; ghosts need no demand.
    if (!owned) continue;
    FeedingDemand& demand = step.demands[i];
    demand.present = room(i) > 0.5 * step.rows(i, k_room);
    if (!demand.present) continue;
    // The demand: contraction from the volumes of before to those of now, of which freezing metal
    // is fed up to its end and solid metal not at all.
    demand.before = {step.rows(i, k_thermal), step.rows(i, k_phase)};
    demand.after = metal.at(next.heat.temperature[i], next.plateau_at(i));
    demand.fed = after < 1 ? demand.after : frozen ? demand.before : metal.solid();
    if (step.soft[i] == 0) continue;
    // A node that has been emptied in part asks only for what is still there.
    const double full = step.rows.fill(i);
    demand.metal = full / demand.fed.total() - step.rows(i, k_metal);
    step.melts = true;
  }
}

// Contraction up to the end of freezing is of the metal that was there, contraction after it of what is there
// now. Metal that has moved takes on the volume of the metal where it went.
void Feeding::commit(Step& step, FeedingTotals& totals) const {
  std::array<double, 10> sums{};
  auto& [melt, freezing, solid, pipe, sink, cavity, pores, outside, gas, wall] = sums;
  const FeedingRows& rows = step.rows;
  for (std::size_t i = 0; i < step.demands.size(); ++i) {
    const double v = rows(i, k_room);
    // A node may have lost its body since the last step.
    if (!(v > 0)) continue;
    const FeedingDemand& d = step.demands[i];
    if (d.present) {
      const double had = v * step.metal_before[i], has = v * rows(i, k_metal);
      // Contraction is booked by its cause: of the melt, of freezing, of the solid.
      melt += had * d.before.thermal - has * d.fed.thermal;
      freezing += had * d.before.phase - has * d.fed.phase;
      solid += has * (d.fed.total() - d.after.total());
      rows(i, k_thermal) = d.after.thermal;
      rows(i, k_phase) = d.after.phase;
    }
    // The volumes of pipe, sink, cavities, pores and gas are what they are now, not sums over
    // steps.
    pipe += v * rows(i, k_pipe);
    sink += v * rows(i, k_sink);
    cavity += v * rows(i, k_cavity);
    pores += v * rows(i, k_pores);
    gas += v * rows(i, k_gas);
    wall += v * rows(i, k_wall);
    // What is neither metal nor hole has come from outside or left.
    outside += v * (rows.fill(i) - rows(i, k_metal) * (1 + rows(i, k_thermal) + rows(i, k_phase)));
  }
  processes::sum(sums);
  // Causes add up over the steps, holes are those of the end.
  totals.melt += melt;
  totals.freezing += freezing;
  totals.solid += solid;
  totals.pipe = pipe;
  totals.sink = sink;
  totals.cavity = cavity;
  totals.pores = pores;
  totals.outside = outside;
  totals.gas = gas;
  totals.wall = wall;
}

std::span<const quantities::Quantity* const> Feeding::fields() const {
  return has_gas() ? std::span<const quantities::Quantity* const>(k_with_gas) : fields::k_of_feeding;
}

void Feeding::fill(const CriterionInput& /*now*/, const CriterionRecord& record,
                   std::span<const std::span<double>> values) const {
  CriterionRecord copy{record.name, record.columns, {}};
  const FeedingRows rows = rows_of(copy);
  for (std::size_t i = 0; i < mesh_.x.size(); ++i) {
    values[0][i] = std::clamp(rows.emptied(i), 0.0, 1.0);
    values[1][i] = rows(i, k_pores);
    if (has_gas()) values[2][i] = rows(i, k_gas);
  }
}

std::size_t Feeding::bytes() const {
  return graph_.bytes() + body_.capacity() * sizeof body_[0];
}

}  // namespace solidus::criteria
