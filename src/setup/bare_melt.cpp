/// The faces that a leaving body held are looked up in the mesh; metal there that is not coherent by then
/// is an error, or a warning where heat alone is computed.
#include "setup/bare_melt.hpp"

#include <fmt/format.h>

#include "cases/roles.hpp"
#include "heat/thermal_phase.hpp"
#include "mesh/block_geometry.hpp"
#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

/// Share of the area that may be bare while it is liquid: points where the last skin of a hot spot breaks
/// through, or a few faces behind a shell that is coherent all around.
constexpr double k_allowed = 0.1;

struct Skin {
  double all = 0, liquid = 0;  ///< [m²], 2-D: of one metre or radian
};

/// Adds the faces of a surface that lie on a body.
void add_faces(const Assembly& a, AnalysisKind kind, const std::string& surface, int body,
               const std::vector<double>& solid, Skin& skin) {
  const auto group = a.mesh.surfaces.find(surface);
  if (group == a.mesh.surfaces.end()) return;
  // A skin that is not coherent yet cannot hold the melt behind it.
  const double coherency = a.materials[as_size(body)].casting.coherency_fraction;
  for (const mesh::ElementBlock& faces : group->second.faces) {
    if (faces.body != body) continue;
    const mesh::FaceGeometry geometry(a.mesh, faces, kind, mesh::stiffness_rule(faces.shape));
    for (Index f = 0; f < faces.n_counted; ++f) {
      // The area of a face, by the weights of its quadrature points.
      double area = 0;
      for (int p = 0; p < geometry.n_points; ++p) area += geometry.weight[as_size(f * geometry.n_points + p)];
      const auto nodes = faces.element(f);
      const int vertices = mesh::vertex_count(faces.shape);
      // Its solid fraction is the mean of its vertices; nodes on its edges would count these twice.
      double fraction = 0;
      for (int n = 0; n < vertices; ++n) fraction += solid[as_size(nodes[n])] / vertices;
      skin.all += area;
      if (fraction < coherency) skin.liquid += area;
    }
  }
}

}  // namespace

void check_no_bare_melt(const cases::CaseSpec& spec, const Assembly& a, std::size_t number,
                        const coupling::State& begins) {
  // A stage that takes a contact away from metal which is still melt lets it run out. Only bodies that melt,
  // and that are there in both stages, are looked at.
  if (number == 0 || !a.heat) return;
  const cases::StageRun &now = a.stages[number], &before = a.stages[number - 1];
  std::vector<double> solid;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::BodySpec& body = spec.bodies[b];
    if (a.materials[b].solidification() == nullptr) continue;
    if (!cases::holds(body.stages, &before) || !cases::holds(body.stages, &now)) continue;
    // The skin that is freed is that of contacts which hold in the stage before and not in this one.
    Skin skin;
    std::string released;
    for (const cases::ContactSpec& contact : spec.contacts) {
      if (!holds(spec, contact, a.mesh, &before) || holds(spec, contact, a.mesh, &now)) continue;
      // The solid fraction is computed when the first such contact is found; most stages have none.
      if (solid.empty()) {
        solid = a.heat->states().solid_fraction(begins.heat);
        parallel::GhostExchange(a.mesh).update(solid, 1);
      }
      const double area = skin.all;
      for (const std::string& side : contact.sides())
        add_faces(a, spec.analysis.kind, side, static_cast<int>(b), solid, skin);
      if (parallel::global_sum(skin.all - area) > 0)
        released += (released.empty() ? "'" : ", '") + contact.name + "'";
    }
    const double all = parallel::global_sum(skin.all), liquid = parallel::global_sum(skin.liquid);
    // A small share of liquid skin is allowed. With mechanics it would flow, so the case is refused; with
    // heat alone it is a warning.
    if (!(liquid > k_allowed * all)) continue;
    const std::string text = fmt::format(
        "the stage '{}' frees body '{}' of its contact {} at t = {:g} s, while {:.0f} % of that skin is "
        "below coherency ({:.0f} % solid): the metal would run out",
        now.stage->name, body.name, released, now.start, 100 * liquid / all,
        100 * a.materials[b].casting.coherency_fraction);
    if (spec.has_mechanics() && !cases::only_conducts(body))
      throw InputError(now.stage->where, text,
                       fmt::format("a longer stage '{}', until that skin is solid", before.stage->name));
    logging::warn("{}", text);
  }
}

}  // namespace solidus::setup
