/// Newton's method for the free strains, with a loop for the temperature where the point is adiabatic.
#include "point/material_point.hpp"

#include <algorithm>
#include <cmath>

#include "material/free_energy.hpp"
#include "material/melt.hpp"
#include "numbers/index_casts.hpp"
#include "point/linear_system.hpp"

namespace solidus::point {

namespace {

using Law = material::Viscoplastic;

constexpr int k_max_iterations = 60;
constexpr int k_max_halvings = 8;
/// Tolerance as a share of the stress; Newton's last correction lies far below.
constexpr double k_tolerance = 1e-10;
/// The rounding of the pressure, k times a difference of strains, as a share of the bulk modulus.
constexpr double k_rounding = 1e-14;
/// The share of the bulk modulus that is added to the shear stiffness: a liquid without any leaves the free
/// strains open.
constexpr double k_least_stiffness = 1e-12;

std::vector<int> free_components(const Target& target) {
  std::vector<int> rows;
  for (int i = 0; i < 6; ++i)
    if (target.of[as_size(i)] == Control::stress) rows.push_back(i);
  return rows;
}

double largest_missing(const std::vector<int>& free, const Target& target, const Sym<double>& stress) {
  double worst = 0;
  for (const int i : free) worst = std::max(worst, std::abs(target.value[i] - stress[i]));
  return worst;
}

/// Newton's correction of the strain; zero in the imposed components.
bool correction(const std::vector<int>& free, const Target& target, const Answer& answer,
                Sym<double>& change) {
  const Sym4<double>& tangent = answer.tangent;
  const Law::Response<double>& r = answer.response;
  // A little stiffness keeps the equations solvable where the law has none, as for melt.
  const Sym4<double> least = Sym4<double>::isotropic(0, k_least_stiffness * r.bulk);
  Matrix6 a{};
  // Only the components whose stress is prescribed are unknowns.
  Vector6 b{}, x{};
  for (std::size_t row = 0; row < free.size(); ++row) {
    const int i = free[row];
    b[row] = target.value[i] - r.stress[i];
    for (std::size_t column = 0; column < free.size(); ++column) {
      const auto j = as_size(free[column]);
      a[row][column] = tangent[i][j] + least[i][j];
    }
  }
  if (!solve(a, b, free.size(), x)) return false;
  for (std::size_t row = 0; row < free.size(); ++row)
    change[free[row]] = free[row] < 3 ? x[row] : 0.5 * x[row];  // the tangent acts on engineering strains
  return true;
}

/// Tolerance of the temperature of an adiabatic step [K].
constexpr double k_temperature_tolerance = 1e-9;

}  // namespace

MaterialPoint::MaterialPoint(const material::Material& material, const Options& options)
    : law_(material), outside_(external_law(material)), options_(options) {
  // A law from outside must be trusted by the user before it is loaded.
  if (outside_ != nullptr) {
    const SourceLocation& where = outside_->data().where;
    if (!outside_->loaded())
      throw InputError(where, "the law from outside of '" + material.name + "' is not loaded",
                       "--trust-laws, where you trust it");
    if (options.integration == PointIntegration::two_step)
      throw InputError(where,
                       "the two-step method extrapolates state, which a law from outside does not allow",
                       "integration = \"backward_euler\"");
    now_.outside.assign(outside_->size(), 0.0);
  }
  // The strain of the free material at the start, from the temperature at which it has none.
  now_.temperature = options.temperature;
  const double thermal =
      law_.properties_at(options.temperature, options.strain_reference).elastic.thermal_strain;
  for (int i = 0; i < 3; ++i) now_.strain[i] = thermal / 3;
}

Stored MaterialPoint::stored(const MaterialPointState& s) const {
  const Sym<double> elastic = s.strain - s.history.viscous_strain - s.history.plastic_strain;
  const auto state = material::thermal_state<double>(
      law_, {elastic, s.history.hardening, s.history.back_strain}, s.temperature, strain_reference());
  const auto latent = material::latent_heat(law_.material(), strain_reference(), s.temperature);
  return {state.internal_energy + latent.heat + s.history.cold_work, state.entropy + state.latent_entropy,
          state.capacity + state.latent_capacity};
}

StepResult MaterialPoint::attempt(const Target& end, double dt) const {
  return options_.thermal == Thermal::adiabatic ? attempt_adiabatic(end, dt)
                                                : attempt_at(end.temperature, end, dt);
}

/// Newton's method in the temperature with the capacity as its slope; a bracket where latent heat bends it.
StepResult MaterialPoint::attempt_adiabatic(const Target& end, double dt) const {
  // The energy after the step must be that before it and the work done.
  const Stored before = stored(now_);
  double temperature = now_.temperature, low = 0.5 * temperature, high = 2 * temperature;
  // The bracket halves the step where Newton's would leave it.
  StepResult result;
  for (int i = 0; i < k_max_iterations; ++i) {
    result = attempt_at(temperature, end, dt);
    if (!result.converged) return result;
    const Stored now = stored(result.state);
    // Work by the mean stress, as the step itself has it.
    const double work = 0.5 * dot(now_.stress + result.state.stress, result.state.strain - now_.strain);
    const double excess = now.energy - before.energy - work;
    if (std::abs(excess) <= k_temperature_tolerance * now.capacity) return result;
    (excess > 0 ? high : low) = temperature;
    const double next = temperature - excess / now.capacity;
    temperature = next > low && next < high ? next : 0.5 * (low + high);
  }
  result.converged = false;
  return result;
}

Law::Properties<double> MaterialPoint::properties(double temperature, double effective_step) const {
  Law::Properties<double> p = law_.properties_at(temperature, strain_reference());
  if (law_.material().chooses_viscosity()) {
    const material::MeltModulus melt = material::melt_modulus(law_.material(), 0, 0, 0);
    p.elastic.viscosity = melt.mush.at(p.elastic.solid_fraction, melt.viscosity(effective_step));
  }
  return p;
}

Answer MaterialPoint::answer(const Law::Properties<double>& p, double temperature,
                             const Law::State<double>& start, const Sym<double>& strain,
                             const material::TimeStep& step) const {
  // The program's own law answers directly, with its full tangent.
  Answer a;
  if (outside_ == nullptr) {
    a.response = law_.update(p, start, strain, step);
    a.tangent = material::full_tangent(a.response);
    return a;
  }
  // A law from outside answers into its own list of numbers, from which the response is filled as far as it
  // knows it.
  using Outside = material::ExternalLaw;
  // Numbers of the law's own, then the tensors that the program knows the places of.
  a.outside.resize(outside_->size());
  const auto r = outside_->update(Outside::Properties<double>{p.elastic, temperature, strain_reference()},
                                  now_.outside.data(), a.outside.data(), strain, step.dt, &a.complaint);
  const auto tensor = [&](std::size_t place) {
    Sym<double> t;
    std::copy_n(a.outside.begin() + static_cast<std::ptrdiff_t>(place), 6, t.c.begin());
    return t;
  };
  a.tangent = r.tangent;
  a.response.stress = r.stress;
  a.response.state.viscous_strain = tensor(Outside::k_viscous);
  a.response.state.plastic_strain = tensor(Outside::k_inelastic);
  a.response.state.hardening = a.outside[Outside::k_equivalent];
  a.response.state.cold_work = a.outside[Outside::k_cold_work];
  a.response.bulk = p.elastic.bulk;
  a.response.twice_shear = 2 * p.elastic.shear;
  a.response.plastic_power = r.plastic_power;
  a.response.plastic_dissipation = r.plastic_dissipation;
  a.response.viscous_dissipation = r.dissipation - r.plastic_dissipation;
  a.response.dissipation = r.dissipation;
  a.response.status = r.status;
  return a;
}

Answer MaterialPoint::answer(double temperature, const Sym<double>& strain, double dt) const {
  return answer(properties(temperature, dt), temperature, now_.history, strain, dt);
}

StepResult MaterialPoint::attempt_at(double temperature, const Target& end, double dt) const {
  // The step is one of backward Euler, or of the two-step method with the step before.
  const bool two_step = options_.integration == PointIntegration::two_step && step_before_ > 0;
  const auto step =
      two_step ? material::TimeStep::two_step(dt, step_before_) : material::TimeStep::backward_euler(dt);
  const auto start = material::start_state(step, now_.history, history_before_);
  const auto p = properties(temperature, step.dt);
  const auto before = law_.properties_at(now_.temperature, strain_reference());

  // The first guess of the strain: prescribed components as they end, free ones with the thermal growth of
  // the step.
  StepResult result;
  result.effective_step = step.dt;
  const std::vector<int> free = free_components(end);
  Sym<double> strain = now_.strain;
  const double growth = (p.elastic.thermal_strain - before.elastic.thermal_strain) / 3;
  for (int i = 0; i < 6; ++i) {
    if (end.of[as_size(i)] == Control::strain)
      strain[i] = end.value[i];
    else if (i < 3)
      strain[i] += growth;
  }

  // Newton's method on the free components: their stresses have to be those that are asked for. The tolerance
  // is relative to the stresses, and knows the rounding of the bulk modulus.
  Answer now = answer(p, temperature, start, strain, step);
  double missing = largest_missing(free, end, now.response.stress);
  const auto tolerance = [&] {
    return k_tolerance * (norm(now.response.stress) + norm(now_.stress)) + k_rounding * p.elastic.bulk;
  };
  const auto good = [&] {
    return now.response.status == material::Status::converged && std::isfinite(missing);
  };
  for (int i = 0; good() && missing > tolerance() && i < k_max_iterations; ++i) {
    result.residuals.push_back(missing);
    Sym<double> change;
    if (!correction(free, end, now, change)) break;
    // A step that does not come nearer, or at which a law from outside has no answer, is halved.
    double part = 1;
    for (int halving = 0;; ++halving, part *= 0.5) {
      const Sym<double> next = strain + part * change;
      Answer trial = answer(p, temperature, start, next, step);
      const double left = largest_missing(free, end, trial.response.stress);
      const bool answers = outside_ == nullptr || trial.response.status == material::Status::converged;
      if ((answers && left < missing) || halving == k_max_halvings) {
        strain = next, now = std::move(trial), missing = left;
        break;
      }
    }
  }
  result.residuals.push_back(missing);
  result.converged = good() && missing <= tolerance();
  result.response = now.response;
  result.complaint = std::move(now.complaint);
  result.state = {now_.time + dt,      temperature,        strain,
                  now.response.stress, now.response.state, std::move(now.outside)};
  return result;
}

void MaterialPoint::accept(const StepResult& result) {
  history_before_ = now_.history;
  step_before_ = result.state.time - now_.time;
  now_ = result.state;
}

}  // namespace solidus::point
