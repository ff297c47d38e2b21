/// A deck is written section by section, in the order in which the programs want to read it.
#include "results/formats/structural_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <set>
#include <unordered_map>

#include "material/external_law.hpp"
#include "material/tensile.hpp"
#include "mesh/files/abaqus_elements.hpp"
#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"
#include "results/formats/deck_elements.hpp"

namespace solidus::results {

namespace {

/// Names of sets: letters, digits and _, in capitals, at most 60 (Abaqus: 80, CalculiX: 80 with its own
/// suffixes). Two names that become alike get numbers.
class Names {
 public:
  /// @param kind, name  of a set that the deck makes itself
  void reserve(const std::string& kind, const std::string& name) { used_.insert(kind + name); }
  const std::string& operator()(const std::string& kind, const std::string& name) {
    std::string& text = given_[kind + "\n" + name];
    if (!text.empty()) return text;
    std::string plain;
    for (const char c : name)
      plain += std::isalnum(static_cast<unsigned char>(c)) != 0
                   ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
                   : '_';
    if (plain.empty() || std::isdigit(static_cast<unsigned char>(plain[0])) != 0) plain = "N" + plain;
    plain.resize(std::min<std::size_t>(plain.size(), 60));
    text = plain;
    for (int n = 2; !used_.insert(kind + text).second; ++n) text = fmt::format("{}_{}", plain, n);
    return text;
  }

 private:
  std::unordered_map<std::string, std::string> given_;
  std::set<std::string> used_;
};

class Writer {
 public:
  Writer(const StructuralDeck& deck, Dialect dialect)
      : d_(deck),
        calculix_(dialect == Dialect::calculix),
        components_(as_size(displacement_components(deck.kind))) {
    number_elements();
    names_.reserve("nset", k_all);
  }

  std::string text() {
    // The order of the deck: what the model is, then how it starts, then its steps.
    heading();
    nodes();
    elements();
    sets();
    surfaces();
    for (std::size_t b = 0; b < d_.mesh.bodies.size(); ++b)
      if (d_.active.body(static_cast<int>(b))) material(b);
    sections();
    equations();
    initial_conditions();
    // Either a state that is brought into equilibrium, or the temperatures of all moments as loads.
    if (d_.history.empty()) {
      step();
    } else {
      for (std::size_t m = 1; m < d_.history.size(); ++m) temperature_step(m);
    }
    return std::move(out_);
  }

 private:
  static constexpr const char* k_all = "ALL";

  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    out_ += fmt::format(format, std::forward<Args>(args)...);
    out_ += '\n';
  }
  GlobalIndex node(Index local) const { return d_.mesh.input_node[as_size(local)]; }
  bool there(std::size_t block) const { return d_.active.body(d_.mesh.blocks[block].body); }

  void number_elements() {
    first_.resize(d_.mesh.blocks.size());
    GlobalIndex next = 1;
    for (std::size_t b = 0; b < first_.size(); ++b) {
      first_[b] = next;
      if (there(b)) next += d_.mesh.blocks[b].size();
    }
  }

  void heading() {
    line("*HEADING");
    line("{}", d_.title);
    line("** SI units, temperatures in kelvin. Written by Solidus: {}.",
         d_.history.empty() ? "residual stress of a casting as the initial state"
                            : "temperatures of a casting over time as the load");
    line("** Coordinates: {}.", d_.displacement.empty() ? "nominal" : "deformed");
  }

  void nodes() {
    line("*NODE, NSET={}", k_all);
    for (Index i = 0; i < d_.mesh.n_nodes(); ++i) {
      if (!d_.active.node(i)) continue;
      mesh::Point x = d_.mesh.x[as_size(i)];
      for (std::size_t k = 0; k < components_ && !d_.displacement.empty(); ++k)
        x[k] += d_.displacement[as_size(i) * components_ + k];
      line("{}, {:.12e}, {:.12e}, {:.12e}", node(i), x[0], x[1], x[2]);
    }
  }

  void elements() {
    for (std::size_t b = 0; b < d_.mesh.blocks.size(); ++b) {
      // Only bodies of the last stage are in the deck.
      if (!there(b)) continue;
      const mesh::ElementBlock& block = d_.mesh.blocks[b];
      line("*ELEMENT, TYPE={}, ELSET={}", deck_element_type(d_.kind, block.shape), body_set(block.body));
      // Nodes in the order of the program that reads the deck.
      const auto order = mesh::abaqus_node_order(block.shape);
      const auto n = as_size(mesh::node_count(block.shape));
      std::vector<GlobalIndex> theirs(n);
      for (Index e = 0; e < block.size(); ++e) {
        for (std::size_t a = 0; a < n; ++a)
          theirs[order.empty() ? a : as_size(order[a])] = node(block.element(e)[a]);
        // The number of the element, then its nodes.
        std::string text = std::to_string(first_[b] + e);
        std::size_t on_line = 1;
        for (const GlobalIndex number : theirs) {  // at most 16 a line
          text += on_line == 0 ? std::to_string(number) : ", " + std::to_string(number);
          if (++on_line == 16) {
            text += ",\n";
            on_line = 0;
          }
        }
        line("{}", text);
      }
    }
  }

  const std::string& body_set(int body) { return names_("elset", name_of(as_size(body))); }
  const std::string& name_of(std::size_t body) const {
    return d_.body_names.empty() ? d_.mesh.bodies[body].name : d_.body_names[body];
  }

  void sets() {
    for (const auto& [name, set] : d_.mesh.node_sets) {
      std::vector<GlobalIndex> numbers;
      for (const Index i : set)
        if (d_.active.node(i)) numbers.push_back(node(i));
      if (numbers.empty()) continue;
      line("*NSET, NSET={}", names_("nset", name));
      for (const GlobalIndex number : numbers) line("{},", number);
    }
  }

  /// Faces by the element behind them.
  void surfaces() {
    // Faces in the deck are named by an element and one of its labels, so that the element behind
    // each is looked for.
    struct Behind {
      GlobalIndex element;
      int label;
    };
    std::unordered_map<mesh::FaceKey, Behind, mesh::FaceKeyHash> behind;
    const auto faces_of = [&](const mesh::Surface& surface, auto visit) {
      for (const mesh::ElementBlock& faces : surface.faces)
        for (Index f = 0; f < faces.size(); ++f)
          visit(mesh::face_key(faces.element(f), mesh::vertex_count(faces.shape)));
    };
    // The faces of all surfaces, then which element and which of its faces each is.
    for (const auto& [name, surface] : d_.mesh.surfaces)
      faces_of(surface, [&](const mesh::FaceKey& key) { behind[key] = {0, 0}; });
    for (std::size_t b = 0; b < d_.mesh.blocks.size(); ++b) {
      const mesh::ElementBlock& block = d_.mesh.blocks[b];
      const int vertices = mesh::vertex_count(mesh::face_shape(block.shape));
      for (Index e = 0; there(b) && e < block.size(); ++e)
        for (int k = 0; k < mesh::face_count(block.shape); ++k) {
          const auto local = mesh::face_nodes(block.shape, k);
          std::array<Index, 4> nodes{};
          for (std::size_t i = 0; i < as_size(vertices); ++i) nodes[i] = block.element(e)[local[i]];
          const auto found = behind.find(mesh::face_key(nodes.data(), vertices));
          if (found != behind.end()) found->second = {first_[b] + e, deck_face_label(block.shape, k)};
        }
    }
    // Each surface lists the faces whose element is in the deck.
    for (const auto& [name, surface] : d_.mesh.surfaces) {
      std::string lines;
      faces_of(surface, [&](const mesh::FaceKey& key) {
        const Behind& face = behind.at(key);
        if (face.element > 0) lines += fmt::format("{}, S{}\n", face.element, face.label);
      });
      if (lines.empty()) continue;
      line("*SURFACE, NAME={}, TYPE=ELEMENT", names_("surface", name));
      out_ += lines;
    }
  }

  /// Every point of the tables of a property, in rising order; one where all are constant.
  static std::vector<double> temperatures(std::initializer_list<const Table*> tables) {
    std::set<double> all;
    for (const Table* table : tables)
      if (!table->constant()) all.insert(table->x().begin(), table->x().end());
    if (all.empty()) return {293.15};
    return {all.begin(), all.end()};
  }

  void material(std::size_t body) {
    // Each table at its own temperatures, in kelvins and SI units.
    const material::Material& m = d_.materials[body];
    line("*MATERIAL, NAME={}", names_("material", name_of(body)));
    line("*DENSITY");
    line("{:.10g},", m.density);
    line("*ELASTIC");
    for (const double t : temperatures({&m.young_modulus, &m.poisson_ratio}))
      line("{:.10g}, {:.10g}, {:.10g}", m.young_modulus.value(t), m.poisson_ratio.value(t), t);
    line("*EXPANSION, ZERO={:.10g}", m.expansion_reference);
    for (const double t : temperatures({&m.expansion})) line("{:.10g}, {:.10g}", m.expansion.value(t), t);
    line("*CONDUCTIVITY");
    for (const double t : temperatures({&m.conductivity}))
      line("{:.10g}, {:.10g}", m.conductivity.value(t), t);
    line("*SPECIFIC HEAT");
    for (const double t : temperatures({&m.specific_heat}))
      line("{:.10g}, {:.10g}", m.specific_heat.value(t), t);
    if (m.flow) plasticity(*m.flow);
    if (external_law(m) != nullptr)
      line("** Elastic: the law is that of {}, which is not in this file.", external_law(m)->data().library);
  }

  /// Slow tensile curves. Kinematic hardening is in them as isotropic, overstress is not.
  void plasticity(const material::Flow& flow) {
    if (calculix_ && d_.history.empty()) {
      line("** Elastic from here on: CalculiX takes no initial hardening to go with an initial stress.");
      return;
    }
    line("*PLASTIC");
    constexpr std::array<double, 10> k_strains = {0, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1};
    for (const double t : temperatures({&flow.flow_stress}))
      for (const double strain : k_strains)
        line("{:.10g}, {:.10g}, {:.10g}", material::tensile_stress(flow, strain, t), strain, t);
  }

  void sections() {
    for (std::size_t b = 0; b < d_.mesh.bodies.size(); ++b) {
      if (!d_.active.body(static_cast<int>(b))) continue;
      line("*SOLID SECTION, ELSET={}, MATERIAL={}", body_set(static_cast<int>(b)),
           names_("material", name_of(b)));
      if (d_.kind == AnalysisKind::plane_strain) line("1.,");
    }
  }

  void equations() {
    for (const std::vector<Index>& group : d_.constraints)
      for (std::size_t i = 1; i < group.size(); ++i) {
        line("*EQUATION\n2");
        line("{}, {}, 1., {}, {}, -1.", node(node_of(group[i])), component_of(group[i]),
             node(node_of(group[0])), component_of(group[0]));
      }
  }
  Index node_of(Index entry) const { return entry / as_index(components_); }
  Index component_of(Index entry) const { return entry % as_index(components_) + 1; }

  void initial_conditions() {
    line("*INITIAL CONDITIONS, TYPE=TEMPERATURE");
    temperatures_of(d_.history.empty() ? d_.temperature : d_.history.front().temperature);
    if (!d_.history.empty()) return;
    line("*INITIAL CONDITIONS, TYPE=STRESS");
    for (std::size_t b = 0; b < d_.mesh.blocks.size(); ++b) {
      if (!there(b)) continue;
      const std::vector<int> points = calculix_points(d_.mesh.blocks[b].shape);
      for (std::size_t e = 0; e < d_.stress[b].size(); ++e)
        calculix_ ? stress_of_points(b, e, points) : stress_of_element(b, e);
    }
    if (!calculix_) hardening();
  }

  /// Abaqus and CalculiX: 11, 22, 33, 12, 13, 23.
  static std::string in_their_order(const std::array<double, 6>& s) {
    return fmt::format("{:.10e}, {:.10e}, {:.10e}, {:.10e}, {:.10e}, {:.10e}", s[0], s[1], s[2], s[3], s[5],
                       s[4]);
  }
  void stress_of_points(std::size_t b, std::size_t e, const std::vector<int>& points) {
    for (std::size_t q = 0; q < points.size(); ++q)
      line("{}, {}, {}", first_[b] + static_cast<GlobalIndex>(e), q + 1,
           in_their_order(d_.stress[b][e][as_size(points[q])]));
  }
  void stress_of_element(std::size_t b, std::size_t e) {
    std::array<double, 6> mean{};
    const auto& points = d_.stress[b][e];
    for (const auto& s : points)
      for (std::size_t i = 0; i < 6; ++i) mean[i] += s[i] / static_cast<double>(points.size());
    line("{}, {}", first_[b] + static_cast<GlobalIndex>(e), in_their_order(mean));
  }

  void hardening() {
    bool begun = false;
    for (std::size_t b = 0; b < d_.plastic_strain.size(); ++b) {
      const auto body = as_size(d_.mesh.blocks[b].body);
      if (!there(b) || !d_.materials[body].flow) continue;
      if (!begun) line("*INITIAL CONDITIONS, TYPE=HARDENING");
      begun = true;
      for (std::size_t e = 0; e < d_.plastic_strain[b].size(); ++e)
        line("{}, {:.10g}", first_[b] + static_cast<GlobalIndex>(e), d_.plastic_strain[b][e]);
    }
  }

  void temperatures_of(std::span<const double> temperature) {
    for (Index i = 0; i < d_.mesh.n_nodes(); ++i)
      if (d_.active.node(i)) line("{}, {:.10g}", node(i), temperature[as_size(i)]);
  }

  /// Writes the step to a moment of the history. Supports of the first step stay in those that follow.
  void temperature_step(std::size_t m) {
    const double duration = d_.history[m].time - d_.history[m - 1].time;
    line("** t = {:.10g} s", d_.history[m].time);
    line("*STEP, INC=1000");
    line("*STATIC");
    line("{:.10g}, {:.10g}", duration, duration);
    if (m == 1) supports();
    line("*TEMPERATURE");
    temperatures_of(d_.history[m].temperature);
    outputs();
    line("*END STEP");
  }

  void supports() {
    std::string boundary;
    for (Index i = 0; i < d_.mesh.n_nodes(); ++i)
      for (std::size_t k = 0; d_.active.node(i) && k < components_; ++k)
        if (d_.fixed[as_size(i) * components_ + k] != 0)
          boundary += fmt::format("{}, {}, {}\n", node(i), k + 1, k + 1);
    if (!boundary.empty()) out_ += "*BOUNDARY\n" + boundary;
    if (d_.supports.empty()) return;
    line(
        "** Of a part that only contact held: these hold its rigid motions and take no force while loads "
        "are in");
    line("** equilibrium. Put your own supports in their place.");
    line("*BOUNDARY");
    for (const Index entry : d_.supports)
      line("{}, {}, {}", node(node_of(entry)), component_of(entry), component_of(entry));
  }

  void outputs() {
    if (calculix_) {
      out_ += "*NODE FILE\nU\n*EL FILE\nS\n";
    } else {
      out_ += "*OUTPUT, FIELD, VARIABLE=PRESELECT\n";
    }
  }

  /// Writes the step: supports hold the bodies where they are, and loads continue to act.
  void step() {
    line("*STEP");
    line("*STATIC");
    // Loads below rounding are left out, or every node would have one.
    std::string loads;
    double largest = 0;
    for (const double f : d_.force) largest = std::max(largest, std::abs(f));
    constexpr double k_rounding = 1e-12;
    for (Index i = 0; i < d_.mesh.n_nodes(); ++i) {
      if (!d_.active.node(i)) continue;
      for (std::size_t k = 0; k < components_; ++k) {
        const std::size_t at = as_size(i) * components_ + k;
        if (d_.fixed[at] == 0 && std::abs(d_.force[at]) > k_rounding * largest)
          loads += fmt::format("{}, {}, {:.12e}\n", node(i), k + 1, d_.force[at]);
      }
    }
    // Supports come before loads, as the programs want them.
    supports();
    if (!loads.empty()) out_ += "*CLOAD\n" + loads;
    outputs();
    line("*END STEP");
  }

  const StructuralDeck& d_;
  bool calculix_;
  std::size_t components_;
  std::vector<GlobalIndex> first_;  ///< number of the first element of each block
  Names names_;
  std::string out_;
};

}  // namespace

std::string structural_deck(const StructuralDeck& deck, Dialect dialect) {
  return Writer(deck, dialect).text();
}

}  // namespace solidus::results
