/// The data of a case that are known within a spread only, and that its answers depend on: properties of
/// materials, heat transfer of interfaces, temperatures at the start, conditions. `solidus uncertain` varies
/// them by the keys of [vary] (cases/variation.hpp).
#pragma once

#include <string>
#include <vector>

#include "check/case_measures.hpp"
#include "material/spread.hpp"

namespace solidus::check {

struct UncertainParameter {
  /// A place where the parameter stands, and the factor or shift [K] that the case itself has there.
  struct Place {
    std::string key;  ///< "vary.body.part.density"
    double value = 0;
  };
  enum class Origin {
    stated,    ///< a spread with its source, on a card or in the case
    estimate,  ///< the same, marked as an estimate
    usual      ///< none is given: one that is usual for such data
  };
  /// Parameters of one group may be varied together where there are too many of them.
  enum class Group { casting, mould, interface, start, surroundings };

  std::string label;     ///< "conductivity of green_sand"
  std::string quantity;  ///< "conductivity"
  std::string of;        ///< the material, card, contact or condition
  Group group = Group::casting;
  bool mechanical = false;  ///< heat alone does not depend on it
  std::vector<Place> places;
  material::Spread spread;
  Origin origin = Origin::usual;
};

struct UncertainParameters {
  std::vector<UncertainParameter> list;
  std::vector<std::string> fixed;  ///< data that cannot be varied, and why, in words
};

/// Data with a spread of zero are left out, and data that this case does not use.
/// @param m  of the case, whose contacts are known
UncertainParameters uncertain_parameters(const cases::CaseSpec& spec, const setup::Assembly& a,
                                         const CaseMeasures& m);

}  // namespace solidus::check
