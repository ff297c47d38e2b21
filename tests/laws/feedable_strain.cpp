/// A criterion, and a key of material cards, that no file of the sources names: the strain rate that the melt
/// can still feed, after M. Rappaz, J.-M. Drezet, M. Gremaud, A new hot-tearing criterion, Metall. Mater.
/// Trans. A 30 (1999) 449–455.
///
/// Melt flows through the mush towards its root against a drop of pressure. It replaces what shrinkage and
/// straining across the front take away, from the root (f_s = 0.98 unless the card says otherwise, where
/// grains bridge) to the liquidus:
///
///   ΔP = 180 μ/(λ₂² G) [ v_T β A + (1 + β) ε̇ B/G ]
///   A = ∫ f_s²/(1 − f_s)² dT,   B = ∫ f_s² F_s/(1 − f_s)³ dT,   F_s(T) = ∫ f_s dT from the root
///
/// G [K/m] gradient, v_T = Ṫ/G [m/s] speed of the isotherms, λ₂ [m] arm spacing, μ [Pa s] viscosity of the
/// melt, β [1] shrinkage. The field is the ε̇ [1/s] at which ΔP is the critical drop of the card: where it is
/// low, a pore opens between the grains and the casting tears. Validity: columnar freezing, strain across the
/// direction of growth.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "criteria/criterion_kind.hpp"
#include "criteria/freezing.hpp"
#include "criteria/quantities.hpp"
#include "material/added_property.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {
namespace {

constexpr double k_unknown = -1;

constexpr quantities::Quantity k_feedable_strain_rate{
    .name = "feedable_strain_rate",
    .unit = "1/s",
    .label = "Strain rate that melt feeds",
    .doc = "Largest strain rate that melt can feed near the end of freezing: low values tear",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = k_unknown,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::least,
    .headline = "Least feedable strain",
    .answer = "least strain rate that melt feeds",
    .compared = true,
    .pictured = true,
    .shown_as = {"1/s", "1/s"}};

const material::AddProperty k_bridged(
    {.key = "bridged_fraction",
     .unit = "1",
     .least = 0.3,
     .greatest = 1,
     .doc = "Solid fraction at which grains bridge and no melt passes any more; 0.98 where it is left out."});

/// What a material says of the mush.
struct Mush {
  bool known = false;
  double shrinkage = 0, viscosity = 0, pressure_drop = 0;
  double a = 0, b = 0;  ///< A [K], B [K²]
};

Mush mush_of(const material::Material& material) {
  const material::PhaseChange* freezing = material.solidification();
  if (freezing == nullptr || !material.casting.melt_viscosity || freezing->volume_change >= 0) return {};
  Mush mush{true, -freezing->volume_change / (1 + freezing->volume_change), *material.casting.melt_viscosity,
            material.casting.critical_pressure_drop};
  constexpr int k_pieces = 2000;
  const double solidus = freezing->fraction.solidus(), range = freezing->fraction.liquidus() - solidus;
  const Table* const given = k_bridged.of(material);
  const double bridged = given != nullptr ? given->value(solidus) : 0.98;
  double taken = 0;  // F_s
  for (int i = 0; i < k_pieces; ++i) {
    const double f = freezing->fraction.value(solidus + (i + 0.5) * range / k_pieces), dt = range / k_pieces;
    if (f > bridged) continue;
    taken += f * dt;
    mush.a += f * f / ((1 - f) * (1 - f)) * dt;
    mush.b += f * f * taken / std::pow(1 - f, 3) * dt;
  }
  mush.known = mush.b > 0;
  return mush;
}

double feedable_rate(const Mush& mush, double gradient, double rate, double spacing) {
  if (!mush.known || gradient <= 0 || spacing <= 0) return k_unknown;
  const double resistance = 180 * mush.viscosity / (spacing * spacing * gradient);
  const double shrinkage = rate / gradient * mush.shrinkage * mush.a;
  return std::max(0.0,
                  gradient * (mush.pressure_drop / resistance - shrinkage) / ((1 + mush.shrinkage) * mush.b));
}

class FeedableStrain final : public Criterion {
 public:
  explicit FeedableStrain(const CriterionContext& c)
      : mesh_(c.mesh),
        freezing_(c.mesh, c.kind, c.heat->storage(), {.evaluation = c.evaluation, .bodies = c.followed}),
        mush_of_node_(c.mesh.x.size()) {
    std::vector<Mush> of_body;
    for (const material::Material& material : c.materials) of_body.push_back(mush_of(material));
    for (const mesh::ElementBlock& block : c.mesh.blocks)
      if (c.followed[static_cast<std::size_t>(block.body)] != 0)
        for (const Index node : block.nodes)
          mush_of_node_[static_cast<std::size_t>(node)] = of_body[static_cast<std::size_t>(block.body)];
  }

  CriterionRecord initial(const CriterionInput& start) const override {
    CriterionRecord record = freezing_.initial(start);
    record.name = k_feedable_strain_rate.name;
    return record;
  }
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override {
    freezing_.step(old, next, record);
  }
  std::span<const quantities::Quantity* const> fields() const override { return k_fields; }
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override {
    const std::vector<double> rates = rates_at_nodes(now, record);
    std::copy(rates.begin(), rates.end(), values[0].begin());
  }
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override {
    const heat::ThermalState none;
    const mechanics::MechanicalState nothing;
    const std::vector<double> rates = rates_at_nodes({0, none, nothing}, record);
    double least = std::numeric_limits<double>::max();
    CriterionResult found{least_of(k_feedable_strain_rate), "1/s", 0, true, {}};
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
      const auto node = static_cast<std::size_t>(i);
      if (rates[node] == k_unknown || rates[node] >= least) continue;
      least = rates[node];
      found.where = mesh_.x[node];
    }
    const processes::Largest most = processes::find_largest(-least);
    processes::broadcast(found.where, most.rank);
    found.value = -most.value;
    if (found.value == std::numeric_limits<double>::max()) return {};
    return {found};
  }

  static constexpr std::array k_fields = {&k_feedable_strain_rate};

 private:
  std::vector<double> rates_at_nodes(const CriterionInput& now, const CriterionRecord& record) const {
    const std::span<const quantities::Quantity* const> shown = freezing_.fields();
    std::vector<std::vector<double>> columns(shown.size(), std::vector<double>(mesh_.x.size()));
    freezing_.fill(now, record, std::vector<std::span<double>>(columns.begin(), columns.end()));
    const auto column = [&](const quantities::Quantity& wanted) -> const std::vector<double>& {
      return columns[static_cast<std::size_t>(std::ranges::find(shown, &wanted) - shown.begin())];
    };
    const std::vector<double>&gradient = column(fields::k_thermal_gradient),
          &rate = column(fields::k_cooling_rate), &spacing = column(fields::k_secondary_arm_spacing);
    std::vector<double> rates(mesh_.x.size());
    for (std::size_t i = 0; i < rates.size(); ++i)
      rates[i] = feedable_rate(mush_of_node_[i], gradient[i], rate[i], spacing[i]);
    return rates;
  }

  const mesh::Mesh& mesh_;
  Freezing freezing_;
  std::vector<Mush> mush_of_node_;  ///< [local node]
};

struct FeedableStrainKind {
  static constexpr auto fields = FeedableStrain::k_fields;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (c.heat == nullptr) return nullptr;
    return std::make_unique<FeedableStrain>(c);
  }
};

const AddCriterion<FeedableStrainKind> k_added;

}  // namespace
}  // namespace solidus::criteria
