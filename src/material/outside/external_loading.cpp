/// Loads laws from shared objects.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "material/external_law.hpp"
#include "material/material.hpp"
#include "material/outside/external_trial.hpp"
#include "material/outside/mfront_library.hpp"
#include "material/outside/umat_library.hpp"
#include "numbers/types.hpp"

namespace solidus::material {

namespace {

constexpr double k_trial_seconds = 60;
constexpr double k_trial_strain = 1e-6, k_trial_step = 1;  // [1], [s]
constexpr std::size_t k_trial_temperatures = 8;

std::shared_ptr<const ExternalLaw> open(const ExternalData& data) {
  const SharedObject object(data.path(), data.where);
  auto library = data.interface == ExternalInterface::umat ? make_umat_library(object, data)
                                                           : make_mfront_library(object, data);
  if (!data.initial_state.empty() && data.initial_state.size() != library->n_internal())
    throw InputError(data.where,
                     fmt::format("initial_state has {} numbers, the state of '{}' {}",
                                 data.initial_state.size(), data.behaviour, library->n_internal()),
                     "as many, or none");
  return std::make_shared<ExternalLaw>(data, std::move(library));
}

/// Throws InputError where the law has no answer for a solid that is hardly deformed.
void evaluate(const Material& material, const ExternalLaw& law, double temperature) {
  const ExternalLaw::Properties<double> p{
      properties_at(material, temperature, temperature, PhaseState<double>{1.0, 0.0}), temperature,
      temperature};
  const std::vector<double> old(law.size(), 0.0);
  std::vector<double> now(law.size());
  // A uniaxial strain far below any yield strain: an elastic answer is the least that a law must
  // give.
  std::string reason;
  Sym<double> strain;
  strain[0] = k_trial_strain;
  const auto answer = law.update(p, old.data(), now.data(), strain, k_trial_step, &reason);
  if (answer.status != Status::converged)
    throw InputError(law.data().where,
                     fmt::format("'{}' of '{}' finds no answer for a strain of {:g} at {:.4g} degC: {}",
                                 law.data().behaviour, law.data().path(), k_trial_strain,
                                 temperature - k_zero_celsius, reason),
                     "a law that holds at the temperatures of the material file's young_modulus");
}

}  // namespace

std::vector<double> temperatures_of_law(const Material& material) {
  constexpr double k_room = k_zero_celsius + 20;
  const PhaseChange* const freezing = material.solidification();
  // Room temperature and those of the table of Young's modulus up to the solidus, where the law acts.
  std::vector<double> temperatures{k_room};
  for (const double at : material.young_modulus.x())
    if (at > 0 && (freezing == nullptr || at <= freezing->fraction.solidus())) temperatures.push_back(at);
  std::sort(temperatures.begin(), temperatures.end());
  temperatures.erase(std::unique(temperatures.begin(), temperatures.end()), temperatures.end());
  // So many trials would take too long for long tables.
  while (temperatures.size() > k_trial_temperatures) {  // every other one, with both ends
    std::vector<double> fewer;
    for (std::size_t i = 0; i < temperatures.size(); i += 2) fewer.push_back(temperatures[i]);
    if (fewer.back() < temperatures.back()) fewer.push_back(temperatures.back());
    temperatures = std::move(fewer);
  }
  return temperatures;
}

std::shared_ptr<const ExternalLaw> load_external_law(const Material& material, const ExternalLaw& law) {
  const ExternalData& data = law.data();
  // What is part of the program is there already.
  if (law.built_in()) return material.external;
  // A shared object runs its own code at once when it is loaded: that needs the user's word.
  if (!external_laws_are_trusted())
    throw InputError(
        data.where,
        fmt::format("'{}' has its law from '{}', and what a shared object does cannot be checked: "
                    "loading it is as if you ran a program of its author",
                    material.name, data.library),
        "--trust-laws, where you trust it");
  // The library is tried with a small strain at several temperatures before it is trusted with a run.
  const auto try_out = [&](const std::function<void(const std::string&)>& note) {
    note("loading");
    const auto loaded = open(data);
    for (const double temperature : temperatures_of_law(material)) {
      note(fmt::format("computing a small strain at {:.4g} degC", temperature - k_zero_celsius));
      evaluate(material, *loaded, temperature);
    }
  };
  // The trial runs in a copy of the process; only what has come through it is loaded here.
  if (const std::string fault = fault_of(try_out, k_trial_seconds); !fault.empty())
    throw InputError(
        data.where,
        fmt::format("'{}' of '{}' cannot be used: in a trial {}", data.behaviour, data.path(), fault),
        "a library for this interface, with the properties and state variables that it expects");
  std::shared_ptr<const ExternalLaw> loaded = open(data);
  for (const double temperature : temperatures_of_law(material)) evaluate(material, *loaded, temperature);
  return loaded;
}

}  // namespace solidus::material
