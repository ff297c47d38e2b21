/// The heat of every point is added to the residual and the matrix of the thermal phase.
#include "contact/heat/heat_term.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "contact/heat/heat_run.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

void HeatTerm::bind(const linear::BlockMatrix& matrix) {
  slots_.bind(matrix, n_owned_, points_.interface().partners.n_points());
  ++bindings_;
}

// Θ* of S^e_c* = S^e_c,n + carried (S^e_c − S^e_c,n); of the slip every stage has its part.
void HeatTerm::begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> before) {
  if (!points_.stages().running()) return;
  if (stage.carried == 0) return points_.stages().begin_stage(stage.dt, {});
  // A later stage starts from where the stage before it has led: temperature by the entropy carried over, and
  // the heat and dissipation that were exchanged on the way.
  const PartnerList& partners = points_.interface().partners;
  const std::size_t n = points_.list().size();
  FirstStage first{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  const double stage_dt = points_.stages().stage(0), span = points_.stages().span(0);
  for (Index p = 0; p < partners.n_points(); ++p) {
    const HeatPoint& point = points_.list()[as_size(p)];
    first.temperature[as_size(p)] = point.step.temperature;
    // A point that stores nothing has no history to carry: its temperature follows from the fluxes of the
    // stage.
    if (!points_.interface().active || !point.has_temperature || partners.partnered[as_size(p)] == 0)
      continue;
    const HeatAtPoint s = points_.see(p, before);
    first.temperature[as_size(p)] *=
        std::pow(s.interface.temperature / point.step.temperature, stage.carried);
    first.flux[as_size(p)] = stage.carried * stage_dt * (s.interface.flux[0] + s.interface.flux[1]);
    first.dissipation[as_size(p)] = stage.carried * s.dissipation * stage_dt / span;
  }
  points_.stages().begin_stage(stage.dt, std::move(first));
}

void HeatTerm::add_residual(std::span<const double> x, std::span<double> r) {
  if (!points_.interface().active) return;
  const PartnerList& partners = points_.interface().partners;
  std::vector<double> heat;
  for (Index p = 0; p < partners.n_points(); ++p) {
    if (partners.partnered[as_size(p)] == 0) continue;
    const HeatAtPoint s = points_.see(p, x);
    heat.assign(s.nodes.size(), 0.0);
    add_point_heat(s, x, partners.weight[as_size(p)], heat);
    for (std::size_t a = 0; a < s.nodes.size(); ++a)
      if (s.nodes[a] < n_owned_) r[as_size(s.nodes[a])] += heat[a];
  }
}

void HeatTerm::add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) {
  if (!points_.interface().active) return;
  const PartnerList& partners = points_.interface().partners;
  HeatRun run;
  std::vector<double> per_h;
  // Entries go to the matrix run by run: neighbouring points share their nodes, and a sum in a
  // small array is cheaper than one in the matrix.
  const auto flush = [&] {
    if (run.first < 0) return;
    const auto slots = slots_.slots(run.first, run.nodes);
    for (std::size_t e = 0; e < run.values.size(); ++e) *matrix.block(slots[e]) += run.values[e];
  };
  // Successive points of the same nodes are summed before they go into the matrix.
  for (Index p = 0; p < partners.n_points(); ++p) {
    if (partners.partnered[as_size(p)] == 0) continue;
    const HeatAtPoint s = points_.see(p, x);
    if (!run.holds(s.nodes)) {
      flush();
      run.start(p, s.nodes, s.nodes.size() * s.nodes.size());
    }
    add_point_tangent(s, x, partners.weight[as_size(p)], run.values, per_h);
  }
  flush();
}

}  // namespace solidus::contact
