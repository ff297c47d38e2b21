/// Each parameter that may vary gets its spread: that of the case, of the card, or the usual one.
#include "check/uncertain_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "cases/case_materials.hpp"
#include "cases/interface_library.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "setup/body_input.hpp"

namespace solidus::check {

namespace {

using Group = UncertainParameter::Group;
using Origin = UncertainParameter::Origin;

material::Spread usual_share(double relative) {
  material::Spread spread;
  spread.relative = relative;
  return spread;
}
material::Spread usual_factor(double factor) {
  material::Spread spread;
  spread.factor = factor;
  return spread;
}
material::Spread usual_shift(double kelvin) {
  material::Spread spread;
  spread.shift = kelvin;
  return spread;
}

bool is_zero(const material::Spread& s) {
  return s.relative.value_or(0) == 0 && s.factor.value_or(1) == 1 && s.shift.value_or(0) == 0;
}

/// A spread and where it comes from: that of the case, else that of the card, else a usual one.
struct Known {
  material::Spread spread;
  Origin origin = Origin::usual;
  bool by_case = false;
};

Known known(const std::optional<material::Spread>& by_case, const std::optional<material::Spread>& by_card,
            material::Spread usual) {
  const std::optional<material::Spread>& given = by_case ? by_case : by_card;
  if (!given) return {std::move(usual), Origin::usual, false};
  return {*given, given->estimate ? Origin::estimate : Origin::stated, by_case.has_value()};
}

/// Parameters in the order of their first place; what several places share is one parameter.
class ParameterList {
 public:
  void add(const std::string& shared_as, UncertainParameter parameter) {
    if (is_zero(parameter.spread)) return;
    // A path of --set has its parts between dots and its value behind the first sign of equality.
    const std::string& key = parameter.places.front().key;
    if (std::count(key.begin(), key.end(), '.') != 3 || key.find('=') != std::string::npos) {
      found.fixed.push_back(parameter.label + ", for a dot or = in a name");
      return;
    }
    const auto [at, fresh] = index_.emplace(shared_as, found.list.size());
    if (fresh) {
      found.list.push_back(std::move(parameter));
      return;
    }
    auto& places = found.list[at->second].places;
    places.insert(places.end(), parameter.places.begin(), parameter.places.end());
  }
  UncertainParameters found;

 private:
  std::map<std::string, std::size_t> index_;
};

/// Parts that a body plays in the case.
struct BodyUse {
  bool cast = false, deforms = false;
  bool weighs = false;  ///< its weight or inertia loads it
};

class Collector {
 public:
  Collector(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m)
      : spec_(spec), a_(a), m_(m) {}

  UncertainParameters all() {
    for (std::size_t b = 0; b < spec_.bodies.size(); ++b) add_material(b);
    for (std::size_t c = 0; c < spec_.contacts.size(); ++c) add_contact(c);
    for (std::size_t b = 0; b < spec_.bodies.size(); ++b) add_start(b);
    for (const cases::ThermalConditionSpec& condition : spec_.thermal_conditions) add_condition(condition);
    return std::move(list_.found);
  }

 private:
  bool transient_heat() const { return spec_.has_heat() && !spec_.time.steady; }

  /// Whether an answer of the case depends on a property of such a body.
  bool uses(std::string_view key, const BodyUse& body) const {
    if (key == "conductivity") return spec_.has_heat();
    if (key == "density") return transient_heat() || body.weighs;
    if (key == "specific_heat") return transient_heat();
    if (key == "latent_heat" || key == "freezing_temperatures") return transient_heat() && body.cast;
    if (key == "volume_change") return body.deforms && body.cast;
    if (key == "arm_spacing" || key == "melt_viscosity")
      return transient_heat() && body.cast && spec_.criteria.follow;
    return body.deforms;
  }

  void add_material(std::size_t b) {
    const cases::BodySpec& body = spec_.bodies[b];
    const std::string name = std::filesystem::path(body.material).stem().string();
    // Spreads of the case go before those of the card, and these before what is usual for the property.
    const material::MaterialSpreads card =
        material::find_spreads(body.material, cases::material_folders(), body.where);
    const auto own = spec_.spread.bodies.find(body.name);
    // What a body is used for decides which of its properties matter.
    BodyUse use;
    use.cast = m_.is_poured(b);
    use.deforms = spec_.has_mechanics() && !cases::only_conducts(body);
    use.weighs = use.deforms && (spec_.analysis.gravity > 0 || spec_.dynamics);
    // A spread for every property that the material has and the case uses.
    std::map<std::string_view, Known> spreads;
    for (const material::VariedProperty& row : material::varied_properties())
      if (row.has(a_.materials[b]) && uses(row.key, use))
        spreads.emplace(row.key,
                        known(own == spec_.spread.bodies.end() ? std::nullopt : own->second.*row.spread,
                              card.*row.spread, row.usual));
    // Density and heat capacity enter heat only as their product; where the mass matters to nothing else they
    // are one parameter.
    const bool one_capacity = join_capacity(spreads, use);
    for (const material::VariedProperty& row : material::varied_properties()) {
      const auto at = spreads.find(row.key);
      if (at == spreads.end()) continue;
      const Known& k = at->second;
      const std::string_view key = row.key;
      const std::string quantity =
          one_capacity && key == "specific_heat" ? "heat capacity per volume" : std::string(row.name);
      // Properties of heat alone do not need a run with stresses.
      const bool of_heat = key == "density" || key == "conductivity" || key == "specific_heat" ||
                           key == "latent_heat" || key == "freezing_temperatures" || key == "arm_spacing" ||
                           key == "melt_viscosity";
      // A casting and a mould of one material are off together, whatever group the first one has.
      list_.add(fmt::format("{} {} {}", quantity, body.material, k.by_case ? body.name : ""),
                {fmt::format("{} of {}", quantity, k.by_case ? body.name : name),
                 quantity,
                 k.by_case ? body.name : name,
                 use.cast ? Group::casting : Group::mould,
                 !of_heat,
                 {{fmt::format("vary.body.{}.{}", body.name, row.key), factor_of(body.name, row)}},
                 k.spread,
                 k.origin});
    }
  }

  /// Where density and specific heat count as a product only, as in a mould that conducts, they are one
  /// parameter, whose relative spread is the root of the sum of their squares.
  static bool join_capacity(std::map<std::string_view, Known>& spreads, const BodyUse& use) {
    const auto density = spreads.find("density"), heat = spreads.find("specific_heat");
    if (use.cast || use.weighs || density == spreads.end() || heat == spreads.end()) return false;
    if (!density->second.spread.relative || !heat->second.spread.relative) return false;
    Known& joined = heat->second;
    joined.spread.relative = std::hypot(*joined.spread.relative, *density->second.spread.relative);
    joined.origin = std::max(joined.origin, density->second.origin);
    joined.by_case = joined.by_case || density->second.by_case;
    if (!density->second.spread.source.empty())
      joined.spread.source += (joined.spread.source.empty() ? "" : "; ") + density->second.spread.source;
    spreads.erase(density);
    return true;
  }

  double factor_of(const std::string& body, const material::VariedProperty& row) const {
    const auto at = spec_.vary.bodies.find(body);
    return at == spec_.vary.bodies.end() ? material::MaterialFactors{}.*row.factor : at->second.*row.factor;
  }

  void add_contact(std::size_t c) {
    const cases::ContactSpec& contact = spec_.contacts[c];
    if (!spec_.has_heat() || !contact.heat) return;
    // The case goes before the card of the interface, and the card before what is usual.
    const auto own = spec_.spread.contacts.find(contact.name);
    cases::ContactSpreads by_case, by_card;
    if (own != spec_.spread.contacts.end()) by_case = own->second;
    for (const cases::InterfaceCard& card : cards_)
      if (!contact.law.empty() && card.name == contact.law) by_card = card.spread;
    constexpr double k_usual = 2, k_usual_gap = 1.5;
    // One parameter a law, not one a contact: two contacts of one law are off together.
    const auto add = [&](const char* key, const char* quantity, const Known& k, double value) {
      const std::string of = k.by_case || contact.law.empty() ? contact.name : contact.law;
      list_.add(fmt::format("{} {}", quantity, of),
                {fmt::format("{} of {}", quantity, of),
                 quantity,
                 of,
                 Group::interface,
                 false,
                 {{fmt::format("vary.contact.{}.{}", contact.name, key), value}},
                 k.spread,
                 k.origin});
    };
    add("conductance", "conductance", known(by_case.conductance, by_card.conductance, usual_factor(k_usual)),
        contact.heat->conductance_factor);
    if (opens(c))
      add("gap", "conduction of the gap", known(by_case.gap, by_card.gap, usual_factor(k_usual_gap)),
          contact.heat->gap_factor);
  }

  /// Whether a gap may be open, and conducts less than contact then.
  bool opens(std::size_t c) const {
    const cases::ContactSpec& contact = spec_.contacts[c];
    constexpr double k_rounding = 1e-9;  // [m], of coordinates
    const bool apart = m_.contacts[c].largest_gap > contact.touching.value_or(k_rounding);
    if (!spec_.has_mechanics() && !apart) return false;
    constexpr double k_gap = 1e-4, k_warm = 600, k_same = 0.01;  // [m], [K]
    const contact::HeatTransferLaw law(contact::without_bodies(*contact.heat));
    const double closed = law.at(0, 0, k_warm).value, open = law.at(-k_gap, 0, k_warm).value;
    return open > 0 && std::abs(open - closed) > k_same * closed;
  }

  void add_start(std::size_t b) {
    if (!transient_heat()) return;
    const cases::BodySpec& body = spec_.bodies[b];
    const auto own = spec_.spread.bodies.find(body.name);
    // Poured bodies have a pouring temperature each; all others share one parameter unless the case gives
    // them their own.
    const bool cast = m_.is_poured(b);
    constexpr double k_usual = 10;  // [K]
    const Known k = known(own == spec_.spread.bodies.end() ? std::nullopt : own->second.initial_temperature,
                          {}, usual_shift(k_usual));
    // A start that is given by place has no one number to shift.
    if (body.initial_temperature.place != nullptr) {
      list_.found.fixed.push_back(
          fmt::format("the temperature of {} at the start, for it is given by place", body.name));
      return;
    }
    const std::string quantity = cast ? "pouring temperature" : "temperature at the start";
    const std::string of = k.by_case ? body.name : cast ? "" : "all that is not poured";
    // The present value of the parameter is what the case varies already, or none.
    const auto by = spec_.vary.bodies.find(body.name);
    list_.add(fmt::format("{} {}", quantity, of),
              {of.empty() ? quantity : fmt::format("{} of {}", quantity, of),
               quantity,
               of,
               Group::start,
               false,
               {{fmt::format("vary.body.{}.initial_temperature", body.name),
                 by == spec_.vary.bodies.end() ? 0.0 : by->second.initial_temperature}},
               k.spread,
               k.origin});
  }

  void add_condition(const cases::ThermalConditionSpec& c) {
    using Kind = cases::ThermalConditionSpec::Kind;
    if (!spec_.has_heat()) return;
    const auto own = spec_.spread.conditions.find(c.name);
    const auto by = spec_.vary.conditions.find(c.name);
    const cases::ConditionSpreads by_case =
        own == spec_.spread.conditions.end() ? cases::ConditionSpreads{} : own->second;
    const cases::ConditionFactors now =
        by == spec_.vary.conditions.end() ? cases::ConditionFactors{} : by->second;
    // Parameters of one condition share its name and its group.
    const auto add = [&](const char* key, const std::string& quantity, const Known& k, double value) {
      list_.add(fmt::format("{} {}", quantity, c.name),
                {fmt::format("{} of {}", quantity, c.name),
                 quantity,
                 c.name,
                 Group::surroundings,
                 false,
                 {{fmt::format("vary.thermal_condition.{}.{}", c.name, key), value}},
                 k.spread,
                 k.origin});
    };
    // Its strength is a factor, whatever kind it is; held temperatures have none.
    if (c.kind != Kind::temperature) {
      const auto [what, data, usual] = strength_of(c);
      if (data != nullptr && data->place != nullptr)
        list_.found.fixed.push_back(fmt::format("{} of {}, for it is given by place", what, c.name));
      else
        add("coefficient", what, known(by_case.coefficient, {}, usual), now.coefficient);
    }
    // Ambient temperatures are varied only where the case says how well they are known.
    if (by_case.temperature)
      add("temperature", "temperature", known(by_case.temperature, {}, {}), now.temperature);
  }

  /// The strength of a condition: its name, its data and its usual spread.
  static std::tuple<std::string, const Function*, material::Spread> strength_of(
      const cases::ThermalConditionSpec& c) {
    using Kind = cases::ThermalConditionSpec::Kind;
    constexpr double k_film = 1.5, k_emissivity = 0.2, k_power = 0.1;
    switch (c.kind) {
      case Kind::film:
        return {"film coefficient", &c.coefficient, usual_factor(k_film)};
      case Kind::radiation:
        return {"emissivity", &c.emissivity, usual_share(k_emissivity)};
      case Kind::flux:
        return {"flux", &c.flux, usual_share(k_power)};
      case Kind::source:
        return {"power", &c.power, usual_share(k_power)};
      default:
        return {"heat", nullptr, usual_share(k_power)};
    }
  }

  const cases::CaseSpec& spec_;
  const setup::Assembly& a_;
  const CaseMeasures& m_;
  const std::vector<cases::InterfaceCard> cards_ = cases::interface_cards();
  ParameterList list_;
};

}  // namespace

UncertainParameters uncertain_parameters(const cases::CaseSpec& spec, const setup::Assembly& a,
                                         const CaseMeasures& m) {
  return Collector(spec, a, m).all();
}

}  // namespace solidus::check
