/// Each part of the case becomes a short text or a hash; a difference then names the part.
#include "setup/fingerprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "material/external_law.hpp"
#include "material/laws/liquid_law.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "results/summary.hpp"
#include "setup/body_input.hpp"
#include "setup/dynamics_input.hpp"
#include "system/processes.hpp"

namespace solidus::setup {

namespace {

// Describes the formulation of triangles and tetrahedra, on which their history depends; by default the
// material decides.
std::string simplices_text(const cases::MechanicsSpec& m) {
  const char* const formulation[] = {"", ", mixed simplices", ", displacement simplices"};
  return std::string(formulation[static_cast<std::size_t>(m.simplices)]) +
         (m.stabilisation == mechanics::Stabilisation::algebraic ? ", algebraic sub-scales" : "");
}

std::string analysis_text(const cases::CaseSpec& spec) {
  constexpr std::array<const char*, 3> k_physics = {"heat", "mechanics", "thermomechanical"};
  constexpr std::array<const char*, 3> k_kinds = {"plane strain", "axisymmetric", "3D"};
  return fmt::format("{}, {}, {} rule{}{}{}", k_kinds.at(static_cast<std::size_t>(spec.analysis.kind)),
                     k_physics.at(static_cast<std::size_t>(spec.analysis.physics)),
                     spec.heat.integration == heat::HeatIntegration::closed ? "closed" : "open",
                     spec.isentropic() ? ", isentropic" : (spec.simultaneous() ? ", simultaneous" : ""),
                     spec.dynamics ? ", with inertia by " + method_name(*spec.dynamics) : "",
                     simplices_text(spec.mechanics));
}

// Describes the physics and the stages of a body, on which the contents of a state depend.
std::string body_text(const cases::BodySpec& body) {
  std::string text = body.name + (cases::only_conducts(body) ? " that only conducts" : "");
  for (std::size_t i = 0; i < body.stages.size(); ++i) text += (i == 0 ? " in " : " + ") + body.stages[i];
  return text;
}

// FNV-1a over the texts of numbers.
class Hash {
 public:
  void add(std::string_view text) {
    for (const char c : text) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  void add(double number) { add(fmt::format("{} ", number)); }
  /// Bit by bit, which is much faster.
  template <class T>
  void add_bits(T number) {
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &number, sizeof(T));
    add(std::string_view(bytes.data(), bytes.size()));
  }
  void add(const Table& table) {
    for (const double x : table.x()) add(x);
    for (const double y : table.y()) add(y);
    add(static_cast<double>(table.extrapolation()));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

/// The sum over all processes, which hold parts in any order.
std::uint64_t sum_of(std::uint64_t own) {
  processes::sum(std::span(&own, 1));
  return own;
}

/// A hash of every node with its place, and every element with its nodes, by their numbers in the input.
std::uint64_t mesh_hash(const mesh::Mesh& mesh) {
  // A sum of the hashes does not depend on the order in which processes have nodes and elements.
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < as_size(mesh.n_owned_nodes); ++i) {
    Hash node;
    node.add_bits(mesh.input_node[i]);
    for (const double x : mesh.x[i]) node.add_bits(x);
    sum += node.value();
  }
  // Elements count on the process of their first node, as everywhere.
  for (const mesh::ElementBlock& block : mesh.blocks)
    for (Index e = 0; e < block.n_counted; ++e) {
      Hash element;
      element.add_bits(block.input_element[as_size(e)]);
      element.add_bits(block.body);
      for (int k = 0; k < mesh::node_count(block.shape); ++k)
        element.add_bits(mesh.input_node[as_size(block.element(e)[k])]);
      sum += element.value();
    }
  return sum_of(sum);
}

/// Range and a mean over the nodes, each with a weight of its own by its number: to nine digits, because the
/// last ones depend on the number of processes.
std::string initial_text(const mesh::Mesh& mesh, const std::vector<double>& temperature) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < std::min(temperature.size(), as_size(mesh.n_owned_nodes)); ++i) {
    Hash number;
    number.add_bits(mesh.input_node[i]);
    const double weight = 1 + static_cast<double>(number.value() >> 11) * 0x1p-53;
    sum += weight * temperature[i];
    weights += weight;
    low = std::min(low, temperature[i]);
    high = std::max(high, temperature[i]);
  }
  sum = parallel::global_sum(sum);
  weights = parallel::global_sum(weights);
  low = parallel::global_min(low);
  high = parallel::global_max(high);
  return weights > 0 ? fmt::format("{:.9g} to {:.9g} K, weighted mean {:.9g} K", low, high, sum / weights)
                     : "none";
}

std::string mesh_text(const mesh::Mesh& mesh) {
  // Numbers of nodes and of each shape can be read by a human; the hash behind them tells the rest.
  const results::MeshCounts counts = results::count(mesh);
  std::string text = fmt::format("{} nodes", counts.nodes);
  for (const auto& [shape, n] : counts.elements_of_shape) text += fmt::format(", {} {}", n, shape);
  text += ", from (";
  // Numbers and corners tell meshes apart and do not depend on the division into processes.
  std::array<double, 3> low{}, high{};
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::numeric_limits<double>::max();
    high[i] = std::numeric_limits<double>::lowest();
    for (const mesh::Point& x : mesh.x) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
    low[i] = parallel::global_min(low[i]);
    high[i] = parallel::global_max(high[i]);
  }
  return text + fmt::format("{:.9g}, {:.9g}, {:.9g}) to ({:.9g}, {:.9g}, {:.9g}) m ({:016x})", low[0], low[1],
                            low[2], high[0], high[1], high[2], mesh_hash(mesh));
}

std::string material_text(const material::Material& m) {
  // Everything of a material that a result depends on goes into the hash, in a fixed order: a restart with
  // another value is noticed. Names and sources do not count.
  Hash hash;
  hash.add(m.density);
  hash.add(m.expansion_reference);
  hash.add(static_cast<double>(m.liquid_model));
  for (std::size_t i = 0; i < material::liquid_law(m.liquid_model).parameters().size(); ++i)
    hash.add(m.liquid_numbers[i]);
  for (const material::Property& property : m.properties()) {
    hash.add(property.name);
    hash.add(*property.table);
  }
  if (m.flow) {
    hash.add(static_cast<double>(m.flow->isotropic));
    hash.add(static_cast<double>(m.flow->kinematic));
    for (const auto numbers :
         {m.flow->curves.strains(), m.flow->curves.temperatures(), m.flow->curves.stresses()})
      for (const double number : numbers) hash.add(number);
  }
  // Of a law from outside the name of its file counts, not its folder.
  if (const material::ExternalLaw* law = external_law(m)) {
    const material::ExternalData& data = law->data();
    hash.add(std::string_view(std::filesystem::path(data.library).filename().native()));
    hash.add(data.behaviour);
    for (const auto& numbers : {data.properties, data.external_state_variables, data.initial_state})
      for (const double number : numbers) hash.add(number);
    hash.add(static_cast<double>(data.dissipation));
    hash.add(data.heat_share);
    hash.add(static_cast<double>(law->loaded() ? law->size() : 0));
  }
  for (const material::PhaseChange& change : m.phase_changes) {
    hash.add(change.latent_heat);
    hash.add(change.volume_change);
    hash.add(change.solidification ? 1.0 : 0.0);
    for (const auto& [temperature, fraction] : change.fraction.points()) {
      hash.add(temperature);
      hash.add(fraction);
    }
  }
  for (const double number :
       {m.casting.coherency_fraction, m.casting.brittle_range[0], m.casting.brittle_range[1],
        m.casting.arm_spacing.value_or(0), m.casting.arm_spacing_exponent,
        m.casting.melt_viscosity.value_or(0), m.casting.critical_pressure_drop, m.casting.pore_tension,
        m.casting.crack_strain.value_or(0), m.casting.crack_rate_exponent, m.casting.crack_range_exponent,
        m.casting.rigidity})
    hash.add(number);
  // Gas in the melt is optional, and a material without it hashes as one did before there was any.
  if (m.gas)
    for (const double number : {m.gas->melt[0], m.gas->melt[1], m.gas->solid[0], m.gas->solid[1],
                                m.gas->content, m.gas->surface_tension})
      hash.add(number);
  return fmt::format("{} ({:016x})", m.name, hash.value());
}

}  // namespace

results::Fingerprint fingerprint(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                 const std::vector<material::Material>& materials,
                                 const std::vector<double>& initial) {
  results::Fingerprint result = {{"analysis", analysis_text(spec)}, {"mesh", mesh_text(mesh)}};
  std::string bodies, data;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    bodies += (b > 0 ? ", " : "") + body_text(spec.bodies[b]);
    data += (b > 0 ? ", " : "") + material_text(materials[b]);
  }
  result.emplace_back("list of bodies", bodies);
  result.emplace_back("material data", data);
  result.emplace_back("initial temperature", initial_text(mesh, initial));
  return result;
}

}  // namespace solidus::setup
