/// Each node keeps its time of freezing and the share of its gas; the step is evaluated at the pressure of
/// the surroundings.
#include "criteria/gas_pores.hpp"

#include <algorithm>
#include <utility>

#include "criteria/gather.hpp"
#include "criteria/quantities.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

namespace {

enum GasColumns : std::size_t { k_gas_share, k_gas_time };

}  // namespace

std::unique_ptr<GasPores> GasPores::make(const mesh::Mesh& mesh, const heat::NodalEnthalpy& storage,
                                         const std::vector<char>& followed, const GasOptions& options) {
  std::vector<std::optional<GasLaw>> laws;
  for (std::size_t b = 0; b < followed.size(); ++b)
    laws.push_back(followed[b] != 0 ? GasLaw::of(storage.material(static_cast<int>(b)), options)
                                    : std::nullopt);
  if (std::ranges::none_of(laws, [](const auto& law) { return law.has_value(); })) return nullptr;
  return std::make_unique<GasPores>(mesh, storage, std::move(laws));
}

GasPores::GasPores(const mesh::Mesh& mesh, const heat::NodalEnthalpy& storage,
                   std::vector<std::optional<GasLaw>> laws)
    : mesh_(mesh), laws_(std::move(laws)), ghosts_(mesh) {
  for (Index i = 0; i < mesh.n_owned_nodes; ++i) {
    Node node{i, -1, 0};
    // A node belongs to the body with gas that has the most of it.
    for (std::size_t b = 0; b < laws_.size(); ++b) {
      const double room = laws_[b] ? storage.volume(i, static_cast<int>(b)) : 0.0;
      if (room <= node.room) continue;
      node = {i, static_cast<int>(b), room};
    }
    if (node.body >= 0) nodes_.push_back(node);
  }
}

CriterionRecord GasPores::initial(const CriterionInput& /*start*/) const {
  return {"gas",
          {make_column(mesh_, "pores", mesh::FieldPlace::node),
           make_column(mesh_, "time", mesh::FieldPlace::node)},
          {}};
}

void GasPores::step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) {
  std::vector<double>&pores = record.columns[k_gas_share].values, &times = record.columns[k_gas_time].values;
  constexpr double k_mean = 0.5;  // of a step in which metal begins to freeze
  for (const Node& who : nodes_) {
    const auto i = as_size(who.node);
    // The time of freezing counts from the step in which freezing begins, of which half is taken.
    const double before = old.solid_fraction[i], after = next.solid_fraction[i];
    // Solid metal makes no more pores.
    if (before >= 1 && after >= 1) continue;
    times[i] = after > 0 ? times[i] + (before > 0 ? 1 : k_mean) * (next.time - old.time) : 0;
    pores[i] = laws_[as_size(who.body)]->pores({next.heat.temperature[i], after, times[i]}, 0);
  }
  // Fields show ghosts' values too.
  ghosts_.update(pores, 1);
  ghosts_.update(times, 1);
}

std::span<const quantities::Quantity* const> GasPores::fields() const {
  return fields::k_of_gas;
}

void GasPores::fill(const CriterionInput& /*now*/, const CriterionRecord& record,
                    std::span<const std::span<double>> values) const {
  std::ranges::copy(record.columns[k_gas_share].values, values[0].begin());
}

std::vector<CriterionResult> GasPores::findings(const CriterionRecord& record) const {
  std::vector<double> room(as_size(mesh_.n_owned_nodes), 0.0);
  for (const Node& who : nodes_) room[as_size(who.node)] = who.room;
  return gas_findings(mesh_, record.columns[k_gas_share].values, room);
}

std::vector<CriterionResult> gas_findings(const mesh::Mesh& mesh, std::span<const double> pores,
                                          std::span<const double> room) {
  // The mean over the own nodes and the densest own place, then the densest of all processes.
  double volume = 0, all = 0;
  std::vector<double> own{-1, 0, 0, 0};  // densest: share, place
  for (std::size_t i = 0; i < room.size(); ++i) {
    if (!(room[i] > 0)) continue;
    volume += room[i] * pores[i];
    all += room[i];
    if (pores[i] > own[0]) own = {pores[i], mesh.x[i][0], mesh.x[i][1], mesh.x[i][2]};
  }
  const std::vector<double> of_all = gathered(std::span<const double>(own));
  CriterionResult densest{largest_of(fields::k_gas_pores), "1", 0, false, {}};
  for (std::size_t k = 0; k + own.size() <= of_all.size(); k += own.size()) {
    if (of_all[k] <= densest.value) continue;
    densest.value = of_all[k];
    densest.where = {of_all[k + 1], of_all[k + 2], of_all[k + 3]};
    densest.somewhere = true;
  }
  return {{"gas_pores_volume", "m3", parallel::global_sum(volume), false, {}},
          {"gas_pores_room", "m3", parallel::global_sum(all), false, {}},
          densest};
}

}  // namespace solidus::criteria
