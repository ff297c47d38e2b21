// Findings on properties: factors of a thousand between units.
#include <fmt/format.h>

#include <algorithm>

#include "model/findings.hpp"

namespace solidus::model {

namespace {

struct Usual {
  const char* property;
  const char* unit;
  double low, high;
};

void compare(const BodySpec& body, const Usual& usual, double low, double high, Findings& findings) {
  if (low >= usual.low && high <= usual.high) return;
  findings.push_back({false, body.where,
                      fmt::format("body '{}', material '{}': {} of {:g} {}", body.name, body.material,
                                  usual.property, high > usual.high ? high : low, usual.unit),
                      fmt::format("usual are {:g} to {:g} {}", usual.low, usual.high, usual.unit)});
}

}  // namespace

void find_in_materials(const CaseSpec& spec, const Assembly& a, Findings& findings) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const material::Material& m = a.materials[b];
    const bool metal = m.solidification() != nullptr;
    compare(spec.bodies[b], {"density", "kg/m3", metal ? 1000.0 : 10.0, 25000}, m.density, m.density,
            findings);
    if (!spec.has_heat()) continue;
    compare(spec.bodies[b], {"conductivity", "W/m/K", metal ? 3 : 0.01, 1000}, m.conductivity.min_value(),
            m.conductivity.max_value(), findings);
    compare(spec.bodies[b], {"specific heat", "J/kg/K", 80, 20000}, m.specific_heat.min_value(),
            m.specific_heat.max_value(), findings);
    if (metal)
      compare(spec.bodies[b], {"latent heat", "J/kg", 1e4, 2e6}, m.solidification()->latent_heat,
              m.solidification()->latent_heat, findings);
  }
}

}  // namespace solidus::model
