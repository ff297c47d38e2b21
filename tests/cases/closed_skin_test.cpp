// A melt that no one gives a viscosity, poured into a mould: it stays on its wall as long as it is not
// coherent, carries rho g h and conducts its heat away, in the plane and in space, over a range and with an
// eutectic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case_folder.hpp"
#include "cases/case_materials.hpp"
#include "coupling/contact_states.hpp"
#include "setup/assembly.hpp"
#include "setup/case_file.hpp"
#include "setup/mesh_input.hpp"
#include "setup/scheme_input.hpp"

namespace solidus {
namespace {

const testing::CaseFolder k_here("closed_skin");

/// Half of a plate in an open mould: 40 × 30 mm of casting.
const std::string k_plate = R"(lc = 5e-3; w = 0.04; h = 0.03; t = 0.02;
Point(1) = {0, 0, 0, lc}; Point(2) = {w, 0, 0, lc}; Point(3) = {w, h, 0, lc}; Point(4) = {0, h, 0, lc};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Point(11) = {0, 0, 0, lc}; Point(12) = {w, 0, 0, lc}; Point(13) = {w, h, 0, lc};
Point(14) = {w+t, h, 0, 2*lc}; Point(15) = {w+t, -t, 0, 2*lc}; Point(16) = {0, -t, 0, 2*lc};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 15}; Line(15) = {15, 16};
Line(16) = {16, 11};
Curve Loop(2) = {11, 12, 13, 14, 15, 16}; Plane Surface(2) = {2};
Physical Surface("casting") = {1}; Physical Surface("mould") = {2};
Physical Curve("casting_outside") = {1, 2}; Physical Curve("mould_inside") = {11, 12};
Physical Curve("casting_x") = {4}; Physical Curve("mould_x") = {16}; Physical Curve("mould_bottom") = {15};
)";
/// A quarter of a box of 30 × 24 × 24 mm in a mould, symmetric about x = 0 and y = 0.
const std::string k_box = R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.03, 0.024, 0.024};
Box(2) = {0, 0, -0.012, 0.042, 0.036, 0.036};
Box(3) = {0, 0, 0, 0.03, 0.024, 0.024};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
e = 1e-5;
Physical Volume("casting") = {1}; Physical Volume("mould") = {4};
all() = Surface{:};
Physical Surface("casting_outside") = {2, 4, 5};
Physical Surface("casting_x") = {1}; Physical Surface("casting_y") = {3};
mx() = {}; my() = {}; mi() = {}; mb() = {};
For i In {0 : #all()-1}
  s = all(i);
  If (s > 6)
    b() = BoundingBox Surface{s};
    If (b(3) < e)
      mx() += {s};
    ElseIf (b(4) < e)
      my() += {s};
    ElseIf (b(5) < -0.011)
      mb() += {s};
    ElseIf (b(3) < 0.03 + e && b(4) < 0.024 + e)
      mi() += {s};
    EndIf
  EndIf
EndFor
Physical Surface("mould_x") = {mx()}; Physical Surface("mould_y") = {my()};
Physical Surface("mould_inside") = {mi()}; Physical Surface("mould_bottom") = {mb()};
Mesh.MeshSizeMin = 8e-3; Mesh.MeshSizeMax = 8e-3;
)";

/// Freezes over 45 K.
const std::string k_range = R"(title = "Freezes over a range"
like = "aluminium_alsi7mg"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "389 kJ/kg"
volume_change = -0.045
[phase_change.fraction]
kind = "linear"
solidus = "565 degC"
liquidus = "610 degC"
)";

std::string symmetry(const std::string& group, const std::string& component) {
  return "[[mechanical_condition]]\nname = \"" + group + "\"\ngroup = \"" + group +
         "\"\nkind = \"displacement\"\n" + component + " = \"0 mm\"\n";
}

std::string casting(bool solid, const std::string& material) {
  std::string text = "title = \"A casting\"\n[analysis]\nkind = \"";
  text += solid ? "solid" : "plane_strain";
  text += R"("
gravity = "9.81 m/s2"
[time]
end = "10 s"
step = "0.5 s"
[mesh]
file = ")" +
          std::string(solid ? "box.geo" : "plate.geo") +
          R"("
[[body]]
name = "casting"
material = ")" +
          material + R"("
initial_temperature = "640 degC"
[[body]]
name = "mould"
material = "steel_mould"
initial_temperature = "200 degC"
[[contact]]
name = "wall"
slave = "casting_outside"
master = "mould_inside"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "gas"
gas_conductivity = "0.06 W/m/K"
)";
  text +=
      symmetry("casting_x", "ux") + symmetry("mould_x", "ux") + symmetry("mould_bottom", solid ? "uz" : "uy");
  if (solid) text += symmetry("casting_y", "uy") + symmetry("mould_y", "uy");
  return text;
}

/// Results of a run for its skin.
struct Skin {
  double leaving_gap = 0;  ///< 1 % of the free contraction [m]
  double liquid_gap = 0;   ///< the largest where the skin was below coherency [m]
  double heat_lost = 0;    ///< of the heat flow of closed contact, the largest share that a liquid skin lost
  double push_off = 0;  ///< of ½ ρ g H² on the wall that is at rest, what is missing or more, the mean share
  double defect = 0;    ///< of the first law, over the heat exchanged
  double coherent_share = 0;  ///< of the skin at the end
  double left_area = 0;
  int newton = 0, steps = 0;
};

Skin pour(const std::string& name, bool solid, const std::string& material,
          const std::vector<std::string>& overrides, int steps) {
  k_here.write("plate.geo", k_plate);
  k_here.write("box.geo", k_box);
  k_here.write("range.toml", k_range);
  setup::Case c = setup::load_case(k_here.write(name + ".toml", casting(solid, material)), overrides);
  setup::Assembly a;
  a.materials = cases::load_materials(c.spec);
  a.mesh = setup::load_mesh(c.spec);
  setup::build(c.spec, a);
  const auto scheme =
      setup::coupling_scheme(c.spec, a.phases, setup::keeps_strain(c.spec, a.materials, a.start));
  scheme->synchronise(a.initial);
  const contact::ContactPair& wall = *a.contacts[0];
  const double height = solid ? 0.024 : 0.03,
               push = 0.5 * a.materials[0].density * 9.81 * height * height * (solid ? 0.024 : 1.0);
  Skin skin{.leaving_gap = wall.parts().spec.leaving_gap};
  coupling::State old = a.initial, next = old;
  double defect = 0, exchanged = 0, dt = 0.5;
  int counted = 0;
  constexpr double k_thin = 0.3;  // a mush of this f_S/f_c has the shear modulus of the melt still
  for (int n = 1; n <= steps; ++n) {
    const std::vector<double> coherent = coupling::coherency_of(a.phases, old.heat);
    const coupling::StepEffort effort = scheme->advance(old, next, n * dt, dt);
    next.time = n * dt;
    skin.newton += effort.mechanics.iterations;
    defect += effort.energy.defect();
    exchanged += effort.energy.heat_exchanged;
    skin.left_area = std::max(skin.left_area, effort.contacts[0].left_area);
    const contact::ContactNodalFields fields = contact::nodal_fields(wall.view(), next.heat.temperature);
    const std::vector<Index>& skin_nodes = a.mesh.surfaces.at("casting_outside").nodes;
    const auto coherent_at = [&](Index node) { return coherent[static_cast<std::size_t>(node)]; };
    double most = 0;
    for (const Index node : skin_nodes) most = std::max(most, coherent_at(node));
    int coherent_nodes = 0, nodes = 0;
    for (std::size_t i = 0; i < fields.nodes.size(); ++i) {
      const Index node = fields.nodes[i];
      if (!std::binary_search(skin_nodes.begin(), skin_nodes.end(), node)) continue;
      if (!std::isfinite(fields.opening[i])) continue;
      ++nodes;
      if (coherent_at(node) >= 1) {
        ++coherent_nodes;
        continue;
      }
      skin.liquid_gap = std::max(skin.liquid_gap, fields.opening[i]);
      // The value of a node is the mean over its points, here of a skin that is liquid all over.
      if (most < 1) skin.heat_lost = std::max(skin.heat_lost, 1 - fields.conductance[i] / 2000);
    }
    if (most < k_thin) {
      skin.push_off += std::abs(effort.contacts[0].resultant[0] / push - 1);
      ++counted;
    }
    skin.coherent_share = static_cast<double>(coherent_nodes) / nodes;
    old = next;
  }
  EXPECT_GT(counted, 0);
  skin.push_off /= counted;
  skin.defect = std::abs(defect) / exchanged;
  skin.steps = steps;
  return skin;
}

struct Poured {
  const char* name;
  bool solid;
  const char* material;
  int steps;
};

class ClosedSkin : public ::testing::TestWithParam<Poured> {};

TEST_P(ClosedSkin, StaysOnItsWallUntilItIsCoherent) {
  const Poured& of = GetParam();
  const Skin skin = pour(of.name, of.solid, of.material, {}, of.steps);
  EXPECT_LT(skin.liquid_gap, skin.leaving_gap);
  EXPECT_GT(skin.leaving_gap, 1e-6);
  EXPECT_EQ(skin.left_area, 0);
  EXPECT_LT(skin.heat_lost, 1e-9);
  EXPECT_LT(skin.push_off, 0.1);
  EXPECT_LT(skin.defect, 1e-8);
  EXPECT_GT(skin.coherent_share, 0.1);  // a part of the skin has frozen, and the rest is still liquid
  EXPECT_LT(skin.coherent_share, 1);
  RecordProperty("newton_per_step", std::to_string(1.0 * skin.newton / skin.steps));
}

// As the cards had it: a liquid of 1e9 Pa s lets go of its wall.
TEST_P(ClosedSkin, LeavesItWithAStiffMeltOnADryWall) {
  const Poured& of = GetParam();
  k_here.write("stiff.toml",
               std::string("like = \"") + of.material + "\"\ntwice_shear_viscosity = \"1e9 Pa s\"\n");
  const Skin skin = pour(std::string(of.name) + "_stiff", of.solid, "stiff.toml", {"contact.wall.wet=false"},
                         std::min(of.steps, 8));
  EXPECT_GT(skin.liquid_gap, skin.leaving_gap);
}

INSTANTIATE_TEST_SUITE_P(Of, ClosedSkin,
                         ::testing::Values(Poured{"plate_range", false, "range.toml", 20},
                                           Poured{"plate_eutectic", false, "aluminium_alsi7mg", 24},
                                           Poured{"box_range", true, "range.toml", 16},
                                           Poured{"box_eutectic", true, "aluminium_alsi7mg", 16}),
                         [](const auto& of) { return std::string(of.param.name); });

/// Runs the plate for 3 s and returns its summary.
std::string summary_of(const std::string& name, const std::vector<std::string>& overrides) {
  k_here.write("plate.geo", k_plate);
  k_here.write("range.toml", k_range);
  k_here.write("stiff_range.toml", "like = \"range.toml\"\ntwice_shear_viscosity = \"1e9 Pa s\"\n");
  std::vector<std::string> all = overrides;
  all.push_back("time.end=3 s");
  const testing::CaseRun r = k_here.run(name, casting(false, "range.toml"), all);
  EXPECT_TRUE(r.finished) << r.reason;
  return testing::read_text(k_here.root() / name / "summary.json");
}

TEST(ClosedSkinRun, SaysWhichModulusTheMeltHasAndWhatLeftItsWall) {
  using ::testing::HasSubstr;
  using ::testing::Not;
  const std::string thin = summary_of("thin_run", {});
  EXPECT_THAT(thin, HasSubstr("viscosity[Pa s]"));
  EXPECT_THAT(thin, HasSubstr("10 times the metallostatic head"));
  EXPECT_THAT(thin, Not(HasSubstr("liquid_metal_left_its_wall")));
  EXPECT_THAT(thin, Not(HasSubstr("left its wall")));
  const std::string stiff =
      summary_of("stiff_run", {"body.casting.material=" + (k_here.root() / "stiff_range.toml").string()});
  EXPECT_THAT(stiff, Not(HasSubstr("viscosity[Pa s]")));
  EXPECT_THAT(stiff, HasSubstr("liquid_metal_left_its_wall"));
  EXPECT_THAT(stiff, HasSubstr("contact 'wall': liquid metal left its wall"));
}

// The viscosity reaches the law in every scheme, and the tangents know that it is a constant of the step.
TEST(ClosedSkinRun, EverySchemeHasTheMeltThatTheProgramChose) {
  for (const char* scheme : {"isothermal", "isentropic", "block_iterative", "simultaneous"}) {
    SCOPED_TRACE(scheme);
    const std::string name = std::string("scheme_") + scheme;
    k_here.write("plate.geo", k_plate);
    k_here.write("range.toml", k_range);
    const testing::CaseRun r = k_here.run(name, casting(false, "range.toml"),
                                          {"time.end=3 s", std::string("coupling.scheme=") + scheme});
    ASSERT_TRUE(r.finished) << r.reason;
    for (const double iterations : r.steps.at("mechanics_iterations[1]")) EXPECT_LT(iterations, 30);
    EXPECT_LT(std::abs(r.history.at("energy_defect[J]").back()),
              1e-8 * r.history.at("heat_exchanged[J]").back());
    EXPECT_GT(r.history.at("closed_fraction[1]").back(), 0.99);
  }
}

TEST(ClosedSkinRun, GoesOnFromACheckpointWithTheSameBits) {
  k_here.write("plate.geo", k_plate);
  k_here.write("range.toml", k_range);
  k_here.expect_exact_restart("restart", casting(false, "range.toml"), 4,
                              {"time.adaptive=true", "time.skin_change=0.05", "time.end=4 s",
                               "contact.wall.normal=augmented_lagrangian", "output.checkpoint_every=1"});
}

}  // namespace
}  // namespace solidus
