// A ring on a core, a T and a column in their moulds, poured, frozen and cooled to room temperature: melt
// whose viscosity the program chooses, gravity, a core that the casting shrinks onto, walls that it leaves,
// an alloy that freezes over a range and one that ends with an eutectic, every scheme, element and sub-scale,
// in the plane, around an axis and in space. Meshes are as coarse as a casting can be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../nightly.hpp"
#include "case_folder.hpp"

namespace solidus {
namespace {

const testing::CaseFolder k_here("freezing_castings");

/// Half of a ring of 24 and 40 mm on a core in a mould, three bodies with nodes of their own; extruded where
/// layers > 0.
const std::string k_ring = R"(DefineConstant[ quads = {1, Name "quads"}, layers = {0, Name "layers"} ];
depth = 0.008;
// Gmsh joins what coincides when it extrudes: a micrometre along z keeps the bodies' nodes apart.
apart = layers > 0 ? 1e-6 : 0;
Macro Body
  Point(p) = {0, 0, z};
  Point(p+1) = {0, -ri, z}; Point(p+2) = {ri, 0, z}; Point(p+3) = {0, ri, z};
  Point(p+4) = {0, -ro, z}; Point(p+5) = {ro, 0, z}; Point(p+6) = {0, ro, z};
  Circle(p+1) = {p+1, p, p+2}; Circle(p+2) = {p+2, p, p+3};
  Circle(p+3) = {p+4, p, p+5}; Circle(p+4) = {p+5, p, p+6};
  Line(p+5) = {p+1, p+4}; Line(p+6) = {p+2, p+5}; Line(p+7) = {p+3, p+6};
  Curve Loop(p+1) = {p+5, p+3, -(p+6), -(p+1)}; Plane Surface(p+1) = {p+1};
  Curve Loop(p+2) = {p+6, p+4, -(p+7), -(p+2)}; Plane Surface(p+2) = {p+2};
  Transfinite Curve{p+1:p+4} = 4; Transfinite Curve{p+5:p+7} = m + 1;
  Transfinite Surface{p+1, p+2};
  If (quads)
    Recombine Surface{p+1, p+2};
  EndIf
  body() = {p+1, p+2}; inside() = {p+1, p+2}; outside() = {p+3, p+4}; symmetry() = {p+5, p+7};
  back() = {p+1, p+2};
  If (layers > 0)
    body() = {}; inside() = {}; outside() = {}; symmetry() = {};
    For s In {1:2}
      If (quads)
        e() = Extrude{0, 0, depth}{ Surface{p+s}; Layers{layers}; Recombine; };
      Else
        e() = Extrude{0, 0, depth}{ Surface{p+s}; Layers{layers}; };
      EndIf
      body() += {e(1)}; outside() += {e(3)}; inside() += {e(5)};
      symmetry() += {e(2 * s)};
    EndFor
  EndIf
Return
p = 1000; z = 0; ri = 0.005; ro = 0.012; m = 1; Call Body;
b0() = body(); i0() = inside(); o0() = outside(); s0() = symmetry(); k0() = back();
p = 10000; z = apart; ri = 0.012; ro = 0.020; m = 3; Call Body;
b1() = body(); i1() = inside(); o1() = outside(); s1() = symmetry(); k1() = back();
p = 20000; z = 2 * apart; ri = 0.020; ro = 0.028; m = 1; Call Body;
b2() = body(); i2() = inside(); o2() = outside(); s2() = symmetry(); k2() = back();
If (layers > 0)
  Physical Volume("core") = {b0()}; Physical Volume("casting") = {b1()}; Physical Volume("mould") = {b2()};
  Physical Surface("core_outside") = {o0()}; Physical Surface("casting_inside") = {i1()};
  Physical Surface("casting_outside") = {o1()}; Physical Surface("mould_inside") = {i2()};
  Physical Surface("mould_outside") = {o2()}; Physical Surface("core_inside") = {i0()};
  Physical Surface("core_x") = {s0()}; Physical Surface("casting_x") = {s1()};
  Physical Surface("mould_x") = {s2()}; Physical Surface("core_z") = {k0()};
  Physical Surface("casting_z") = {k1()}; Physical Surface("mould_z") = {k2()};
Else
  Physical Surface("core") = {b0()}; Physical Surface("casting") = {b1()}; Physical Surface("mould") = {b2()};
  Physical Curve("core_outside") = {o0()}; Physical Curve("casting_inside") = {i1()};
  Physical Curve("casting_outside") = {o1()}; Physical Curve("mould_inside") = {i2()};
  Physical Curve("mould_outside") = {o2()}; Physical Curve("core_inside") = {i0()};
  Physical Curve("core_x") = {s0()}; Physical Curve("casting_x") = {s1()}; Physical Curve("mould_x") = {s2()};
EndIf
)";
/// Cells of castings and moulds on two grids of the same lines, whose nodes are apart.
const std::string k_cells = R"(DefineConstant[ quads = {1, Name "quads"}, layers = {0, Name "layers"} ];
depth = 0.008;
// Gmsh joins what coincides when it extrudes: a micrometre along z keeps the bodies' nodes apart.
apart = layers > 0 ? 1e-6 : 0;
x() = {0, 0.005, 0.025, 0.033}; y() = {-0.028, -0.020, 0, 0.008, 0.016};
nx() = {1, 3, 1}; ny() = {1, 3, 2, 1};
Macro Grid  // points p + 10 i + j of the corners of the cells, cells by `in`
  For i In {0:3}
    For j In {0:4}
      Point(p + 10*i + j) = {x(i), y(j), z};
    EndFor
  EndFor
  For i In {0:2}
    For j In {0:4}
      Line(p + 100 + 10*i + j) = {p + 10*i + j, p + 10*(i+1) + j};
      Transfinite Curve{p + 100 + 10*i + j} = nx(i) + 1;
    EndFor
  EndFor
  For i In {0:3}
    For j In {0:3}
      Line(p + 200 + 10*i + j) = {p + 10*i + j, p + 10*i + j + 1};
      Transfinite Curve{p + 200 + 10*i + j} = ny(j) + 1;
    EndFor
  EndFor
Return
body() = {}; front() = {};
Macro Cell  // the cell (i, j): sides are bottom, right, top, left
  c = newreg;
  Curve Loop(c) = {p+100+10*i+j, p+200+10*(i+1)+j, -(p+100+10*i+j+1), -(p+200+10*i+j)};
  Plane Surface(c) = {c}; Transfinite Surface{c};
  If (quads)
    Recombine Surface{c};
  EndIf
  back() += {c};
  If (layers > 0)
    If (quads)
      e() = Extrude{0, 0, depth}{ Surface{c}; Layers{layers}; Recombine; };
    Else
      e() = Extrude{0, 0, depth}{ Surface{c}; Layers{layers}; };
    EndIf
    body() += {e(1)}; bottom = e(2); right = e(3); top = e(4); left = e(5);
  Else
    body() += {c}; bottom = p+100+10*i+j; right = p+200+10*(i+1)+j; top = p+100+10*i+j+1; left = p+200+10*i+j;
  EndIf
Return
)";
/// The groups of a casting and its mould made of them.
const std::string k_groups = R"(If (layers > 0)
  Physical Volume("casting") = {bc()}; Physical Volume("mould") = {bm()};
  Physical Surface("casting_outside") = {co()};
  Physical Surface("casting_x") = {cx()}; Physical Surface("casting_z") = {kc()};
  Physical Surface("mould_inside") = {mi()}; Physical Surface("mould_bottom") = {mb()};
  Physical Surface("mould_outside") = {mo()};
  Physical Surface("mould_x") = {mx()}; Physical Surface("mould_z") = {km()};
Else
  Physical Surface("casting") = {bc()}; Physical Surface("mould") = {bm()};
  Physical Curve("casting_outside") = {co()}; Physical Curve("casting_top") = {ct()};
  Physical Curve("casting_x") = {cx()}; Physical Curve("mould_inside") = {mi()};
  Physical Curve("mould_bottom") = {mb()}; Physical Curve("mould_outside") = {mo()};
  Physical Curve("mould_x") = {mx()};
EndIf
)";
/// Half of a T in its mould: a web 10 mm wide and 20 mm high, a flange 50 mm wide and 8 mm high above it,
/// open at the top. Extruded where layers > 0: then it lies on its side, and its mould goes all around.
const std::string k_tee = k_cells + R"(p = 1000; z = 0; Call Grid;
back() = {}; body() = {};
i = 0; j = 1; Call Cell;
co() = {bottom, right}; cx() = {left};
i = 0; j = 2; Call Cell;
cx() += {left}; ct() = {top};
i = 1; j = 2; Call Cell;
co() += {bottom, right}; ct() += {top};
bc() = body(); kc() = back();
p = 10000; z = apart; Call Grid;
back() = {}; body() = {};
i = 0; j = 0; Call Cell;
mi() = {top}; mx() = {left}; mb() = {bottom};
i = 1; j = 0; Call Cell;
mb() += {bottom};
i = 1; j = 1; Call Cell;
mi() += {left, top};
i = 2; j = 0; Call Cell;
mb() += {bottom}; mo() = {right};
i = 2; j = 1; Call Cell;
mo() += {right};
i = 2; j = 2; Call Cell;
mi() += {left}; mo() += {right};
If (layers > 0)  // lying on its side, a T has a wall above its flange too
  j = 3;
  i = 0;
  Call Cell;
  mx() += {left}; mi() += {bottom};
  i = 1;
  Call Cell;
  mi() += {bottom};
  i = 2;
  Call Cell;
  mo() += {right};
  co() += {ct()};
EndIf
bm() = body(); km() = back();
)" + k_groups;
/// Half of a column in its mould, 10 mm wide and 28 mm high, open at the top; extruded as the T is.
const std::string k_column = k_cells + R"(p = 1000; z = 0; Call Grid;
back() = {}; body() = {};
i = 0; j = 1; Call Cell;
co() = {bottom, right}; cx() = {left};
i = 0; j = 2; Call Cell;
co() += {right}; cx() += {left}; ct() = {top};
bc() = body(); kc() = back();
p = 10000; z = apart; Call Grid;
back() = {}; body() = {};
i = 0; j = 0; Call Cell;
mi() = {top}; mx() = {left}; mb() = {bottom};
i = 1; j = 0; Call Cell;
mb() += {bottom}; mo() = {right};
i = 1; j = 1; Call Cell;
mi() += {left}; mo() += {right};
i = 1; j = 2; Call Cell;
mi() += {left}; mo() += {right};
If (layers > 0)
  j = 3; i = 0; Call Cell;
  mx() += {left}; mi() += {bottom};
  i = 1; Call Cell;
  mo() += {right};
  co() += {ct()};
EndIf
bm() = body(); km() = back();
)" + k_groups;

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

enum class Shape { ring, tee, column, mushroom };  // a mushroom is a T around its axis

struct Casting {
  Shape shape;
  bool solid;  ///< in space
  const char* element;
  const char* stabilisation;
  bool eutectic;
  const char* scheme;
};

std::string name(const Casting& c) {
  const char* shapes[] = {"ring", "tee", "column", "mushroom"};
  const std::string sub_scales = c.stabilisation == std::string("automatic") ? "" : c.stabilisation;
  return std::string(shapes[static_cast<int>(c.shape)]) + "_" + c.element + sub_scales +
         (c.eutectic ? "_eutectic_" : "_range_") + c.scheme;
}

std::string held(const std::string& group, const std::string& component) {
  return "[[mechanical_condition]]\nname = \"" + group + "\"\ngroup = \"" + group +
         "\"\nkind = \"displacement\"\n" + component + " = \"0 mm\"\n";
}

std::string contact(const std::string& contact_name, const std::string& slave, const std::string& master) {
  return "[[contact]]\nname = \"" + contact_name + "\"\nslave = \"" + slave + "\"\nmaster = \"" + master +
         "\"\n[contact.heat]\nconductance = \"2000 W/m2/K\"\ngap_law = \"gas\"\ngas_conductivity = \"0.06 "
         "W/m/K\"\n";
}

std::string cooled(const std::string& group) {
  return "[[thermal_condition]]\nname = \"" + group + "_film\"\ngroup = \"" + group +
         "\"\nkind = \"film\"\ncoefficient = \"500 W/m2/K\"\nambient = \"20 degC\"\n";
}

std::string case_text(const Casting& c) {
  const std::string element = c.element;
  const bool quads = element.starts_with("quad") || element.starts_with("hex");
  const bool linear = element == "tri3" || element == "quad4" || element == "tet4" || element == "hex8";
  const bool ring = c.shape == Shape::ring, revolved = c.shape == Shape::mushroom;
  std::string text = "title = \"A casting\"\n[analysis]\nkind = \"";
  text += c.solid ? "solid" : revolved ? "axisymmetric" : "plane_strain";
  text += std::string(R"("
gravity = "9.81 m/s2"
[time]
end = "1200 s"
step = "0.5 s"
adaptive = true
max_step = "120 s"
temperature_error = "10 K"
displacement_error = "0.05 mm"
solid_fraction_change = 0.2
[mesh]
file = ")") +
          (ring                       ? "ring.geo"
           : c.shape == Shape::column ? "column.geo"
                                      : "tee.geo") +
          "\"\norder = " + (linear ? "1" : "2") +
          "\n[[mesh.constant]]\nname = \"quads\"\nvalue = " + (quads ? "1" : "0") +
          "\n[[mesh.constant]]\nname = \"layers\"\nvalue = " + (c.solid ? "1" : "0") +
          "\n[coupling]\nscheme = \"" + c.scheme + "\"\n[mechanics]\ntolerance = 1e-4\nstabilisation = \"" +
          c.stabilisation + "\"\n";
  std::vector<std::string> bodies{"casting", "mould"};
  if (ring) bodies.emplace_back("core");
  for (const std::string& body : bodies) {
    const bool casting = body == "casting";
    text += "[[body]]\nname = \"" + body + "\"\nmaterial = \"" +
            (!casting     ? "steel_mould"
             : c.eutectic ? "aluminium_alsi7mg"
                          : "range.toml") +
            "\"\ninitial_temperature = \"" + (casting ? "640" : "150") + " degC\"\n";
    if (!revolved) text += held(body + "_x", "ux");
    if (c.solid) text += held(body + "_z", "uz");
  }
  text += contact("wall", "casting_outside", "mould_inside");
  if (ring) {
    text += contact("core", "casting_inside", "core_outside") + held("core_inside", "uy") +
            held("mould_outside", "uy") + cooled("core_inside") + cooled("mould_outside");
  } else {
    text += held("mould_bottom", revolved ? "uz" : "uy") + cooled("mould_outside") + cooled("mould_bottom");
    if (!c.solid) text += cooled("casting_top");
  }
  return text;
}

class FreezingCasting : public ::testing::TestWithParam<Casting> {};

TEST_P(FreezingCasting, ReachesRoomTemperatureAndClosesTheFirstLaw) {
  const Casting& c = GetParam();
  k_here.write("ring.geo", k_ring);
  k_here.write("tee.geo", k_tee);
  k_here.write("column.geo", k_column);
  k_here.write("range.toml", k_range);
  const testing::CaseRun r = k_here.run(name(c), case_text(c));
  ASSERT_TRUE(r.finished) << r.reason;
  const auto end = [&](const char* column) { return r.history.at(column).back(); };
  EXPECT_EQ(end("time[s]"), 1200);
  EXPECT_EQ(end("solid_fraction[1]"), 1);
  EXPECT_LT(end("T_max[degC]"), 25);
  for (const double defect : r.history.at("energy_defect[J]"))
    ASSERT_LT(std::abs(defect), 1e-8 * end("heat_exchanged[J]"));
  double iterations = 0, rejected = 0, turns = 0;
  for (const double n : r.steps.at("mechanics_iterations[1]")) iterations += n;
  for (const double n : r.steps.at("rejected[1]")) rejected += n;
  for (const double n : r.steps.at("coupling_iterations[1]")) turns += n;
  const auto steps = static_cast<double>(r.steps.at("time[s]").size());
  const bool simultaneous = std::string_view(c.scheme) == "simultaneous";
  // The splits solve a step again whose gaps have moved, the simultaneous scheme where fractions of phase
  // changes move.
  EXPECT_LT(iterations, simultaneous ? 15 * steps : 6 * turns);
  EXPECT_LE(rejected, 18);  // where contact opens and the flow of heat jumps

  constexpr double k_weight = 2685 * 9.81;  // [N/m³]
  if (c.shape == Shape::ring) {
    // It has shrunk onto the core and left the wall.
    EXPECT_GT(end("core_normal_force[N]"), c.solid ? 1500 : 1e5);
    EXPECT_EQ(end("wall_normal_force[N]"), 0);
    // The core carries its weight; in space the floor does.
    const double area = std::numbers::pi / 2 * (0.02 * 0.02 - 0.012 * 0.012);
    if (c.solid) return;
    EXPECT_NEAR(end("core_force_y[N]"), -k_weight * area, 0.06 * k_weight * area);
  } else if (!c.solid) {
    // It hangs by its flange, or the column rests on its bottom, with its whole weight.
    const double pi = std::numbers::pi, volume = c.shape == Shape::tee ? 0.005 * 0.02 + 0.025 * 0.008
                                                 : c.shape == Shape::column
                                                     ? 0.005 * 0.028
                                                     : pi * (0.005 * 0.005 * 0.02 + 0.025 * 0.025 * 0.008);
    EXPECT_NEAR(end("wall_normal_force[N]"), k_weight * volume, 0.01 * k_weight * volume);
  }
}

/// Every combination by night. Else every second one of the linear elements, so that each shape and each
/// element meets each alloy and each split; and of quadratic ones in space, which are dear, each element
/// once.
std::vector<Casting> castings() {
  std::vector<Casting> all;
  const bool whole = testing::nightly();
  const std::pair<const char*, const char*> plane[] = {{"quad4", "automatic"},
                                                       {"tri3", "algebraic"},
                                                       {"tri3", "orthogonal"}},
                                            space[] = {{"hex8", "automatic"},
                                                       {"tet4", "algebraic"},
                                                       {"tet4", "orthogonal"}};
  int turn = 0;
  const auto add = [&](Shape shape, bool solid, const auto& elements) {
    for (const auto& [element, stabilisation] : elements) {
      ++turn;
      for (const bool eutectic : {false, true})
        for (const bool isothermal : {false, true})
          if (whole || (eutectic != isothermal) == (turn % 2 == 0))
            all.push_back(
                {shape, solid, element, stabilisation, eutectic, isothermal ? "isothermal" : "isentropic"});
    }
  };
  for (const Shape shape : {Shape::ring, Shape::tee, Shape::column, Shape::mushroom})
    add(shape, false, plane);
  for (const Shape shape : {Shape::ring, Shape::tee, Shape::column}) add(shape, true, space);
  for (const Shape shape : {Shape::ring, Shape::tee}) {
    for (const char* element : {"quad8", "tri6"})
      for (const bool eutectic : {false, true})
        all.push_back({shape, false, element, "automatic", eutectic, eutectic ? "isothermal" : "isentropic"});
    const bool ring = shape == Shape::ring;
    if (whole || !ring) {
      all.push_back({shape, true, "hex20", "automatic", ring, ring ? "isothermal" : "isentropic"});
      all.push_back({shape, true, "tet10", "automatic", !ring, ring ? "isentropic" : "isothermal"});
    }
    for (const auto& [element, stabilisation] : plane)
      for (const bool eutectic : {false, true})
        if (whole || eutectic == ring)
          all.push_back({shape, false, element, stabilisation, eutectic, "simultaneous"});
    all.push_back({shape, true, "tet4", "automatic", ring, "simultaneous"});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Of, FreezingCasting, ::testing::ValuesIn(castings()),
                         [](const auto& of) { return name(of.param); });

}  // namespace
}  // namespace solidus
