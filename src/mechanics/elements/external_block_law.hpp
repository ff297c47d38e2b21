/// A law from outside (material/external_law.hpp) as the element kernels know laws: its state lies in the
/// history and is not copied, for its size is the library's.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "material/external_law.hpp"
#include "mechanics/elements/law_parts.hpp"
#include "numbers/simd.hpp"
#include "system/errors.hpp"

namespace solidus::mechanics {

class ExternalBlockLaw {
 public:
  using StateInPlace = void;
  template <class T>
  using Properties = material::ExternalLaw::Properties<T>;
  /// The numbers of ExternalLaw of a point.
  template <class T>
  struct State {
    const T* values = nullptr;

    Sym<T> tensor(std::size_t place) const {
      const T* from = values + place;
      return {{from[0], from[1], from[2], from[3], from[4], from[5]}};
    }
  };
  /// Its state lies in the workspace of the call.
  template <class T>
  struct Response : material::ExternalLaw::Response<T> {
    State<T> state;
  };
  struct Workspace : material::ExternalLaw::Workspace {
    explicit Workspace(const ExternalBlockLaw& law)
        : material::ExternalLaw::Workspace(*law.law_), state(law.size()) {}
    PackVector<Lane> state;
  };

  /// Keeps a reference to the material. Throws InputError where its law is not loaded.
  explicit ExternalBlockLaw(const material::Material& material)
      : material_(&material), law_(external_law(material)) {
    if (!law_->loaded())
      throw InputError(law_->data().where, "the law from outside of '" + material.name + "' is not loaded",
                       "--trust-laws, where you trust it");
  }

  template <class T>
  Properties<T> properties_at(const T& temperature, const T& initial_temperature,
                              const material::PhaseState<T>& phase) const {
    return {material::properties_at(*material_, temperature, initial_temperature, phase), temperature,
            initial_temperature};
  }
  Response<Lane> update(const Properties<Lane>& p, const State<Lane>& old, const Sym<Lane>& strain,
                        const material::TimeStep& step, Workspace& space) const {
    Response<Lane> r;
    law_->update(p, old.values, space.state.data(), strain, step.dt, space,
                 static_cast<material::ExternalLaw::Response<Lane>&>(r));
    r.state.values = space.state.data();
    return r;
  }

  bool symmetric() const { return law_->symmetric(); }
  const material::Material& material() const { return *material_; }
  std::size_t size() const { return law_->size(); }

 private:
  const material::Material* material_;
  const material::ExternalLaw* law_;
};

// The overloads of law_parts.hpp.

template <class T>
const material::PointProperties<T>& elastic_part(const ExternalBlockLaw&,
                                                 const ExternalBlockLaw::Properties<T>& p) {
  return p.elastic;
}
inline void set_melt_viscosity(const Lane& viscosity, ExternalBlockLaw::Properties<Lane>& p) {
  p.elastic.viscosity = viscosity;
}
inline std::vector<std::size_t> kept_lanes(const ExternalBlockLaw& law) {
  std::vector<std::size_t> lanes(law.size());
  for (std::size_t i = 0; i < lanes.size(); ++i) lanes[i] = i;
  return lanes;
}
inline Sym<Lane> inelastic_strain(const ExternalBlockLaw::State<Lane>& state) {
  using Law = material::ExternalLaw;
  return state.tensor(Law::k_viscous) + state.tensor(Law::k_inelastic);
}
inline Lane inelastic_volume(const ExternalBlockLaw::State<Lane>& state) {
  return trace(state.tensor(material::ExternalLaw::k_inelastic));
}
/// Energy that is stored besides the elastic one is in cold_work(): the library's law of hardening is not
/// known.
inline std::array<Lane, 2> hardening_of(const ExternalBlockLaw::State<Lane>&) {
  return {Lane(0.0), Lane(0.0)};
}
inline std::array<Lane, 2> hardening_change(const ExternalBlockLaw::State<Lane>&,
                                            const ExternalBlockLaw::State<Lane>&) {
  return {Lane(0.0), Lane(0.0)};
}
inline Lane inelastic_entropy(const ExternalBlockLaw::State<Lane>&) {
  return Lane(0.0);
}
inline Lane cold_work(const ExternalBlockLaw::State<Lane>& state) {
  return state.values[material::ExternalLaw::k_cold_work];
}
inline PlasticPower plastic_power(const ExternalBlockLaw&, const ExternalBlockLaw::Response<Lane>& r) {
  return {r.plastic_power, r.plastic_dissipation};
}
inline ViscoplasticValues<Lane> values_of(const ExternalBlockLaw&, const ExternalBlockLaw::Properties<Lane>&,
                                          const ExternalBlockLaw::Response<Lane>& r,
                                          const Sym<Lane>& strain) {
  using Law = material::ExternalLaw;
  ViscoplasticValues<Lane> v;
  v.stress = r.stress;
  v.strain = strain;
  v.viscous_strain = r.state.tensor(Law::k_viscous);
  v.plastic_strain = r.state.tensor(Law::k_inelastic);
  v.equivalent_plastic_strain = r.state.values[Law::k_equivalent];
  v.dissipation = r.dissipation;
  return v;
}

}  // namespace solidus::mechanics
