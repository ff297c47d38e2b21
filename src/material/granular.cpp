/// One step of a point: the binder burns, a trial stress is brought back to the cone, and grains in contact
/// keep their share of the stiffness.
#include "material/granular.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "material/material.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::material {

namespace {

/// A cohesion above this part of Young's modulus is a slip of units.
constexpr double k_largest_strain = 0.1;
/// Rounding that the cut-off may lie above the apex.
constexpr double k_rounding = 1e-9;
/// Components of Sym in the order 11, 22, 33, 12, 13, 23 of a library.
constexpr std::array<int, 6> k_component{0, 1, 2, 3, 5, 4};

/// K tr e 1 + 2G dev e.
Sym<double> elastic_stress(const GranularStrength& m, const Sym<double>& strain) {
  Sym<double> stress = (2 * m.shear_modulus) * dev(strain);
  const double mean = m.bulk * trace(strain);
  for (int i = 0; i < 3; ++i) stress[i] += mean;
  return stress;
}

/// σ_n as far as moduli that have fallen leave it.
Sym<double> kept_stress(const Sym<double>& old, const GranularStrength& before, const GranularStrength& now) {
  const double of_shear = std::min(1.0, now.shear_modulus / before.shear_modulus);
  const double mean = std::min(1.0, now.bulk / before.bulk) * trace(old) / 3;
  Sym<double> stress = of_shear * dev(old);
  for (int i = 0; i < 3; ++i) stress[i] += mean;
  return stress;
}

std::string kilopascal(double pascal) {
  return fmt::format("{:.5g} kPa", 1e-3 * pascal);
}

double degrees(double radian) {
  return radian * 180 / std::acos(-1.0);
}

/// All arguments at which one of the tables has a point, or a constant one's only value.
std::vector<double> points(std::initializer_list<const Table*> tables) {
  std::vector<double> x{k_zero_celsius + 20};
  for (const Table* table : tables) x.insert(x.end(), table->x().begin(), table->x().end());
  return x;
}

/// The tables must stay within the cone at all their temperatures, between which they are straight.
void check_strength(const Material& material, const GranularData& data) {
  const Table &cohesion = data.cohesion.table, &tension = data.tension_cutoff.table;
  for (const double temperature : points({&cohesion, &tension, &material.young_modulus})) {
    const double c = cohesion.value(temperature), apex = c / std::tan(data.friction_angle);
    if (tension.value(temperature) > apex * (1 + k_rounding))
      throw InputError(
          data.tension_cutoff.where,
          fmt::format("at {:.5g} degC tension_cutoff of '{}' is {}, above the apex of its cone, cohesion "
                      "cot(friction_angle) = {}",
                      temperature - k_zero_celsius, material.name, kilopascal(tension.value(temperature)),
                      kilopascal(apex)),
          "a mean stress of at most " + kilopascal(apex));
    if (c > k_largest_strain * material.young_modulus.value(temperature))
      throw InputError(data.cohesion.where,
                       fmt::format("at {:.5g} degC the cohesion of '{}' is {}, more than a tenth of its "
                                   "young_modulus ({})",
                                   temperature - k_zero_celsius, material.name, kilopascal(c),
                                   kilopascal(material.young_modulus.value(temperature))),
                       "no sand is so strong: is a unit wrong?");
    if (data.residual_cohesion > c)
      throw InputError(data.where,
                       fmt::format("residual_cohesion of '{}' is {}, above the cohesion at {:.5g} degC ({})",
                                   material.name, kilopascal(data.residual_cohesion),
                                   temperature - k_zero_celsius, kilopascal(c)),
                       "what loose grains have at most: less than with their binder");
  }
}

/// Every number that an answer depends on, for the fingerprint of a run.
std::vector<double> numbers_of(const GranularData& data) {
  std::vector<double> numbers{
      data.friction_angle,     data.dilatancy_angle, data.residual_cohesion,           data.burnt_stiffness,
      data.residual_stiffness, data.relaxation_time, data.softening_strain.value_or(0)};
  const auto add = [&numbers](const Table& table) {
    numbers.insert(numbers.end(), table.x().begin(), table.x().end());
    numbers.insert(numbers.end(), table.y().begin(), table.y().end());
  };
  add(data.cohesion.table);
  add(data.tension_cutoff.table);
  if (data.burnout_rate) add(data.burnout_rate->table);
  if (data.crushing_pressure) add(data.crushing_pressure->table);
  return numbers;
}

}  // namespace

Granular::Granular(const GranularData& data)
    : cohesion_(data.cohesion.table),
      tension_(data.tension_cutoff.table),
      friction_(data.friction_angle),
      dilatancy_(data.dilatancy_angle),
      residual_cohesion_(data.residual_cohesion),
      softening_strain_(data.softening_strain.value_or(0)),
      burnt_stiffness_(data.burnt_stiffness),
      residual_stiffness_(data.residual_stiffness),
      relaxation_time_(data.relaxation_time) {
  if (data.burnout_rate) burnout_ = data.burnout_rate->table;
  if (data.crushing_pressure) crushing_ = data.crushing_pressure->table;
}

GranularStrength Granular::strength(double temperature, double bulk, double shear, double burnt,
                                    double broken) const {
  const double binder = 1 - burnt;
  const double bonds =
      softening_strain_ > 0 ? binder * std::max(0.0, 1 - broken / softening_strain_) : binder;
  const double stiffness = burnt_stiffness_ + (1 - burnt_stiffness_) * binder;
  const double cohesion = residual_cohesion_ + (cohesion_.value(temperature) - residual_cohesion_) * bonds;
  return {.slope = cone_slope(friction_),
          .dilation = cone_slope(dilatancy_),
          .shear = cone_cohesion_factor(friction_) * cohesion,
          .tension = std::min(tension_.value(temperature) * bonds, cohesion / std::tan(friction_)),
          .crushing = crushing_ ? crushing_->value(temperature) : std::numeric_limits<double>::infinity(),
          .bulk = stiffness * bulk,
          .shear_modulus = stiffness * shear};
}

bool Granular::integrate(ExternalCall& call) const {
  // The binder burns with the mean rate of the step's ends, whatever the strain. Bonds that break in the step
  // are missed in the next one.
  const double* const old = call.old_internal;
  double burnt = old[k_burnt];
  if (burnout_) {
    const double rate = 0.5 * (burnout_->value(call.old_temperature) + burnout_->value(call.temperature));
    burnt = 1 - (1 - burnt) * std::exp(-rate * call.dt);
  }
  const GranularStrength now = strength(call.temperature, call.bulk, call.shear, burnt, old[k_broken]);
  GranularStrength before = now;
  if (old[k_bulk] > 0) {
    before.bulk = old[k_bulk];
    before.shear_modulus = old[k_shear];
  }

  // The share of the grains in contact is linear in the whole strain; the rest of the old stress belongs to
  // the bonded solid.
  const double grains = residual_stiffness_, bonded = 1 - grains;
  const Sym<double> old_stress =
      (1 / bonded) * (call.old_stress - grains * elastic_stress(before, call.old_strain));
  const Sym<double> trial =
      kept_stress(old_stress, before, now) + elastic_stress(now, call.strain - call.old_strain);
  const GranularReturn returned = granular_return(now, trial);
  // The share of the way back to the cone that the step goes.
  const double way = relaxation_time_ > 0 ? call.dt / (call.dt + relaxation_time_) : 1;
  call.stress =
      bonded * ((1 - way) * trial + way * returned.stress) + grains * elastic_stress(now, call.strain);
  call.internal[k_burnt] = burnt;
  call.internal[k_broken] = old[k_broken] + way * returned.broken;
  call.internal[k_bulk] = now.bulk;
  call.internal[k_shear] = now.shear_modulus;

  const Sym4<double> elastic = Sym4<double>::isotropic(now.bulk, 2 * now.shear_modulus);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      const int row = k_component[i];
      const auto column = as_size(k_component[j]);
      call.tangent[6 * i + j] =
          bonded * way * returned.tangent[row][column] + (bonded * (1 - way) + grains) * elastic[row][column];
    }
  return true;
}

std::shared_ptr<const ExternalLaw> make_granular_law(const Material& material, const GranularData& data) {
  if (data.dilatancy_angle > data.friction_angle)
    throw InputError(
        data.where,
        fmt::format("dilatancy_angle of '{}', {:.4g} degree, is above its friction_angle, {:.4g} "
                    "degree: grains would gain energy as they slide",
                    material.name, degrees(data.dilatancy_angle), degrees(data.friction_angle)),
        "an angle from 0 to friction_angle");
  check_strength(material, data);
  ExternalData law;
  law.library = "granular";
  law.behaviour = "[granular]";
  law.interface = ExternalInterface::built_in;
  law.properties = numbers_of(data);
  // Flow that does not follow the normal of the cone has a tangent without symmetry.
  law.unsymmetric = data.dilatancy_angle != data.friction_angle;
  law.dissipation = ExternalDissipation::share;
  law.heat_share = 1;
  law.coherency_fraction = material.casting.coherency_fraction;
  law.where = data.where;
  return std::make_shared<ExternalLaw>(std::move(law), std::make_shared<Granular>(data));
}

}  // namespace solidus::material
