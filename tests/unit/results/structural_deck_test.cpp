/// The input file for CalculiX and Abaqus: read back by our own reader, and its numbers one by one.
#include "results/formats/structural_deck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "../mesh/split_block.hpp"
#include "mesh/quadrature.hpp"
#include "results/formats/deck_elements.hpp"
#include "results/formats/deck_supports.hpp"
#include "sample.hpp"
#include "system/processes.hpp"

namespace solidus::results {
namespace {

using mesh::Shape;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two bodies that share nodes, with numbers that tell where they belong.
struct Sample {
  AnalysisKind kind;
  mesh::RawMesh raw;
  mesh::Mesh mesh;
  std::vector<std::string> absent;
  linear::ActiveSet active;
  std::vector<material::Material> materials;
  std::vector<double> displacement, temperature;
  std::vector<char> fixed;
  std::size_t components;

  explicit Sample(Shape shape, std::vector<std::string> gone = {})
      : kind(mesh::dimension(shape) == 3 ? AnalysisKind::solid : AnalysisKind::plane_strain),
        raw(mesh::dimension(shape) == 3 ? test::split_block(shape, {0.4, 0.2, 0.2}, {4, 2, 2}, 0.2)
                                        : test::split_block(shape, {0.4, 0.2}, {4, 2}, 0.2)),
        mesh(mesh::distribute(raw, {"left", "right"}, {})),
        absent(std::move(gone)),
        active(mesh, absent),
        components(static_cast<std::size_t>(displacement_components(kind))) {
    material::Material m;
    m.density = 2700;
    m.conductivity = 200.0;
    m.specific_heat = 900.0;
    m.young_modulus = Table({300, 600}, {70e9, 50e9});
    m.poisson_ratio = 0.3;
    m.expansion = 2e-5;
    materials = {m, m};
    materials[0].flow.emplace();
    materials[0].flow->flow_stress = 1e8;
    displacement.assign(mesh.x.size() * components, 1e-3);
    for (std::size_t i = 0; i < mesh.x.size(); ++i)
      temperature.push_back(300 + static_cast<double>(mesh.input_node[i]));
    fixed.assign(mesh.x.size() * components, 0);
    fixed[held() * components] = 1;
  }

  /// The node in the corner of the left body.
  std::size_t held() const {
    for (std::size_t i = 0; i < mesh.x.size(); ++i)
      if (mesh.x[i] == mesh::Point{}) return i;
    return 0;
  }
  StructuralDeck deck(bool deformed) const {
    StructuralDeck d{.title = "A sample",
                     .kind = kind,
                     .mesh = mesh,
                     .active = active,
                     .materials = materials,
                     .displacement = {},
                     .temperature = temperature,
                     .stress = {},
                     .plastic_strain = {},
                     .fixed = fixed,
                     .constraints = {},
                     .force = std::vector<double>(mesh.x.size() * components, 0.0)};
    if (deformed) d.displacement = displacement;
    d.force[held() * components + 1] = 5;
    for (const mesh::ElementBlock& block : mesh.blocks) {
      const auto n = static_cast<std::size_t>(block.size());
      const std::size_t points = mesh::stiffness_rule(block.shape).size();
      auto& stress = d.stress.emplace_back(n);
      for (std::size_t e = 0; e < n; ++e)
        for (std::size_t q = 0; q < points; ++q) {
          const double at = static_cast<double>(100 * e + q);
          stress[e].push_back({1e6 + at, 2e6 + at, 3e6 + at, 4e6 + at, 5e6 + at, 6e6 + at});
        }
      d.plastic_strain.emplace_back(n, 0.01);
    }
    return d;
  }
};

bool serial() {
  return processes::count() == 1;
}

/// The lines of a keyword's block.
std::vector<std::string> lines_of(const std::string& deck, const std::string& keyword) {
  std::vector<std::string> lines;
  std::istringstream in(deck);
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '*') {
      inside = line == keyword;
      continue;
    }
    if (inside) lines.push_back(line);
  }
  return lines;
}

/// The elements of a body by the numbers of their nodes.
std::set<std::vector<GlobalIndex>> numbers_of(const mesh::RawMesh& raw, const std::string& group) {
  std::set<std::vector<GlobalIndex>> elements;
  for (const mesh::RawBlock& block : raw.groups.at(group).blocks) {
    const auto n = static_cast<std::size_t>(mesh::node_count(block.shape));
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      std::vector<GlobalIndex> nodes;
      for (std::size_t a = 0; a < n; ++a)
        nodes.push_back(raw.input_node[static_cast<std::size_t>(block.nodes[first + a])]);
      elements.insert(nodes);
    }
  }
  return elements;
}

struct Deck : ::testing::TestWithParam<Shape> {
  test::TemporaryFolder folder;
};

TEST_P(Deck, ReadsBackWithItsNodesElementsSetsAndSurfaces) {
  if (!serial()) return;
  const Sample sample(GetParam());
  const auto path = folder.path / "a.inp";
  for (const Dialect dialect : {Dialect::calculix, Dialect::abaqus}) {
    std::ofstream(path) << structural_deck(sample.deck(false), dialect);
    mesh::RawMesh back = mesh::read_mesh(path.string(), 1);
    mesh::validate_and_orient(back, path.string());
    ASSERT_EQ(back.x.size(), sample.raw.x.size());
    for (const auto& [group, name] :
         {std::pair{"left", "LEFT"}, {"right", "RIGHT"}, {"between", "BETWEEN"}, {"x_min", "X_MIN"}}) {
      ASSERT_TRUE(back.groups.contains(name)) << name;
      const mesh::RawBlock &was = sample.raw.groups.at(group).blocks.front(),
                           &is = back.groups.at(name).blocks.front();
      EXPECT_EQ(is.shape, was.shape);
      ASSERT_EQ(is.input_element.size(), was.input_element.size()) << name;
    }
    EXPECT_EQ(numbers_of(back, "LEFT"), numbers_of(sample.raw, "left"));
    EXPECT_EQ(numbers_of(back, "RIGHT"), numbers_of(sample.raw, "right"));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Deck,
                         ::testing::Values(Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8, Shape::tet4,
                                           Shape::tet10, Shape::hex8, Shape::hex20));

TEST(StructuralDeck, GivesCalculixTheStressOfEveryPointInItsOrder) {
  if (!serial()) return;
  const Sample sample(Shape::hex8);
  const std::string deck = structural_deck(sample.deck(false), Dialect::calculix);
  const auto lines = lines_of(deck, "*INITIAL CONDITIONS, TYPE=STRESS");
  ASSERT_EQ(lines.size(), 16u * 8u);
  const mesh::Rule rule = mesh::stiffness_rule(Shape::hex8);
  for (std::size_t q = 0; q < 8; ++q) {
    double element = 0, point = 0, s[6] = {};
    std::sscanf(lines[8 + q].c_str(), "%lf, %lf, %lf, %lf, %lf, %lf, %lf, %lf", &element, &point, &s[0],
                &s[1], &s[2], &s[3], &s[4], &s[5]);
    EXPECT_EQ(element, 2);
    EXPECT_EQ(point, static_cast<double>(q + 1));
    // The first coordinate is the fastest; xy, xz, yz behind the diagonal.
    const auto ours = static_cast<std::size_t>(s[0] - 1e6 - 100);
    EXPECT_EQ(rule[ours].xi[0] > 0, (q & 1) != 0);
    EXPECT_EQ(rule[ours].xi[1] > 0, (q & 2) != 0);
    EXPECT_EQ(rule[ours].xi[2] > 0, (q & 4) != 0);
    EXPECT_NEAR(s[4] - s[0], 5e6, 1e-3);
    EXPECT_NEAR(s[5] - s[0], 4e6, 1e-3);
  }
  EXPECT_THAT(deck, Not(HasSubstr("*PLASTIC")));
}

TEST(StructuralDeck, GivesAbaqusMeansAndTheStateOfHardening) {
  if (!serial()) return;
  const Sample sample(Shape::quad4);
  const std::string deck = structural_deck(sample.deck(false), Dialect::abaqus);
  EXPECT_EQ(lines_of(deck, "*INITIAL CONDITIONS, TYPE=STRESS").size(), 8u);
  EXPECT_THAT(lines_of(deck, "*INITIAL CONDITIONS, TYPE=STRESS")[0], HasSubstr("1, 1.00000150"));
  EXPECT_THAT(deck, AllOf(HasSubstr("*PLASTIC"), HasSubstr("TYPE=CPE4")));
  EXPECT_EQ(lines_of(deck, "*INITIAL CONDITIONS, TYPE=HARDENING").size(), 4u);
}

TEST(StructuralDeck, ATemperatureHistoryIsAStepForEachMoment) {
  if (!serial()) return;
  const Sample sample(Shape::hex8);
  StructuralDeck deck = sample.deck(false);
  for (const double t : {0.0, 10.0, 25.0})
    deck.history.push_back({t, std::vector<double>(sample.mesh.x.size(), 900 - 10 * t)});
  for (const Dialect dialect : {Dialect::calculix, Dialect::abaqus}) {
    const std::string text = structural_deck(deck, dialect);
    for (const char* part :
         {"*PLASTIC", "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n", "\n1, 900\n",
          "*STEP, INC=1000\n*STATIC\n10, 10\n*BOUNDARY\n1, 1, 1\n*TEMPERATURE\n", "\n1, 800\n",
          "** t = 25 s\n*STEP, INC=1000\n*STATIC\n15, 15\n*TEMPERATURE\n", "\n1, 650\n"})
      EXPECT_NE(text.find(part), std::string::npos) << part;
    for (const char* part : {"TYPE=STRESS", "*CLOAD"}) EXPECT_EQ(text.find(part), std::string::npos) << part;
  }
}

TEST(StructuralDeck, HasDeformedCoordinatesWhereAsked) {
  if (!serial()) return;
  const Sample sample(Shape::quad4);
  const auto nominal = lines_of(structural_deck(sample.deck(false), Dialect::calculix), "*NODE, NSET=ALL");
  const auto deformed = lines_of(structural_deck(sample.deck(true), Dialect::calculix), "*NODE, NSET=ALL");
  double x[2] = {};
  std::sscanf(nominal[0].c_str(), "%*d, %lf", &x[0]);
  std::sscanf(deformed[0].c_str(), "%*d, %lf", &x[1]);
  EXPECT_NEAR(x[1] - x[0], 1e-3, 1e-12);
}

TEST(StructuralDeck, LeavesBodiesOutThatAreNotThere) {
  if (!serial()) return;
  const Sample sample(Shape::quad4, {"right"});
  const std::string deck = structural_deck(sample.deck(false), Dialect::calculix);
  EXPECT_THAT(deck, AllOf(HasSubstr("ELSET=LEFT"), Not(HasSubstr("ELSET=RIGHT"))));
  EXPECT_EQ(lines_of(deck, "*NODE, NSET=ALL").size(), 9u);
  EXPECT_EQ(lines_of(deck, "*SURFACE, NAME=BETWEEN, TYPE=ELEMENT").size(), 2u);
  EXPECT_THAT(lines_of(deck, "*BOUNDARY").size(), 1u);
  EXPECT_THAT(lines_of(deck, "*CLOAD").size(), 1u);
}

TEST(StructuralDeck, KeepsTheSetOfAllNodesApartFromAGroupOfThatName) {
  if (!serial()) return;
  Sample sample(Shape::quad4);
  sample.mesh.node_sets["all"] = {0};
  const std::string deck = structural_deck(sample.deck(false), Dialect::calculix);
  EXPECT_THAT(deck, HasSubstr("*NSET, NSET=ALL_2\n"));
  EXPECT_THAT(deck, Not(HasSubstr("*NSET, NSET=ALL\n")));
}

TEST(MissingSupports, AreThoseOfTheFreeRigidMotions) {
  if (!serial()) return;
  for (const Shape shape : {Shape::quad4, Shape::tet4}) {
    Sample sample(shape);
    const std::size_t modes = sample.components == 2 ? 3 : 6;
    std::fill(sample.fixed.begin(), sample.fixed.end(), char{0});
    const auto missing = [&](const std::vector<std::vector<Index>>& constraints = {}) {
      return missing_supports(sample.mesh, sample.active, sample.kind, sample.fixed, constraints);
    };
    const std::vector<Index> all = missing();
    EXPECT_EQ(all.size(), modes);
    for (const Index entry : all) sample.fixed[static_cast<std::size_t>(entry)] = 1;
    EXPECT_TRUE(missing().empty());
    // A plane face that is free to move: it cannot turn out of its plane.
    std::fill(sample.fixed.begin(), sample.fixed.end(), char{0});
    std::vector<Index> face;
    for (std::size_t i = 0; i < sample.mesh.x.size(); ++i)
      if (sample.mesh.x[i][0] == 0) face.push_back(static_cast<Index>(i * sample.components));
    EXPECT_EQ(missing({face}).size(), sample.components == 2 ? 2u : 4u);
  }
}

}  // namespace
}  // namespace solidus::results
