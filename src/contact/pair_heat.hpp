/// Heat of a contact pair: the term of the thermal phase and the phases that it goes through, with what the
/// interface stores. Without a heat law no heat passes, and every function says so by what is zero or empty.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contact/forces/forces.hpp"
#include "contact/forces/step.hpp"
#include "contact/heat/heat.hpp"
#include "contact/heat/heat_coupling.hpp"
#include "contact/points/geometry.hpp"
#include "linear/contribution.hpp"
#include "linear/coupled_matrix.hpp"

namespace solidus::contact {

class PairHeat {
 public:
  /// Keeps references, to the pair's step and its end too.
  /// @param heat  of the points; null without a heat law
  PairHeat(std::unique_ptr<ContactHeat> heat, const ContactGeometry& geometry, ContactForces& forces,
           ContactStep& step, ContactEnd& end);

  /// The heat of the points, to which mechanical passes hand theirs; null without a heat law.
  ContactHeat* of_points() const { return heat_.get(); }
  /// The term of the thermal phase, with the configuration of the last update(); null without a heat law.
  linear::Contribution* term() const { return heat_ ? &heat_->term() : nullptr; }
  /// Whether the derivative of the term is symmetric.
  bool symmetric() const { return !heat_ || !heat_->points().interface().law.of_temperature(); }
  /// Whether the interface has a temperature Θ_c of its own: heat passes, and it rubs or stores heat.
  bool has_temperature() const { return heat_ && heat_->has_temperature(); }

  /// Begins a thermal phase over `dt`, which need not be the time step of the mechanical pass; an adiabatic
  /// phase has no fluxes. commit() ends it. Without this call the heat is that of the mechanical pass.
  void begin(double dt, bool adiabatic);
  /// Predicts the heat of the second of two equal mechanical passes of a step by that of the first. The
  /// thermal phase between them takes heat and entropy of the slip of the first pass twice, and the same
  /// amount is subtracted from those of the second pass.
  void predict();
  /// Ends the thermal phase: computes Θ_c and S^p_c of every point at the temperatures found [local node] and
  /// commits them to the state of the pair. Zero without friction or heat. Collective.
  InterfaceSums commit(std::span<const double> temperature);
  /// Holds the present deformation: the heat of friction of the last update() is dropped, so that a thermal
  /// phase that follows has none.
  void hold_deformation();
  /// Θ_c of the points if what their slip has heated flowed to the bodies in its step, at temperatures of the
  /// bodies [local node] [K]; empty where the interface has none. Between thermal phases. Local.
  std::vector<double> conducted_temperatures(std::span<const double> temperature) const;
  /// Heat that leaves the slave's and enters the master's surface around every owned node [W]: positive where
  /// the node loses heat; the sum over all is zero. [owned node].
  std::vector<double> nodal(std::span<const double> temperature) const;
  /// Adds the derivatives of the heat with respect to the displacement and of the forces with respect to the
  /// temperature, at the last update(); nothing without a heat law.
  void add_coupling(std::span<const double> temperature, linear::CoupledMatrix& matrix) const;

 private:
  std::unique_ptr<ContactHeat> heat_;
  std::unique_ptr<HeatCoupling> coupling_;  ///< null without a heat law
  const ContactGeometry& geometry_;
  ContactForces& forces_;
  ContactStep& step_;
  ContactEnd& end_;
};

}  // namespace solidus::contact
