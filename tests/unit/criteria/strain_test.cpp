/// Strain in the melt, since coherency and in the brittle range, and distortion, of motions given by formula:
/// every mean strain is the closed form's.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "../mechanics/lattice.hpp"
#include "criteria/strain_criteria.hpp"

namespace solidus::criteria {
namespace {

using mesh::Point;
using mesh::Shape;

constexpr double k_solidus = 800, k_liquidus = 900, k_hot = 950, k_cold = 700;  // [K]
constexpr double k_rounding = 1e-14;                                            // of strains of 1e-2

/// The temperature at which this fraction is solid.
double at_fraction(double fraction) {
  return k_liquidus - fraction * (k_liquidus - k_solidus);
}

material::Material metal(bool melts) {
  material::Material m;
  m.name = "metal";
  if (melts)
    m.phase_changes.push_back({.name = "freezing",
                               .fraction = material::PhaseFraction::linear(k_solidus, k_liquidus),
                               .solidification = true});
  return m;
}

struct Kind {
  AnalysisKind analysis;
  Shape shape;
};
const std::vector<Kind> k_kinds{
    {AnalysisKind::plane_strain, Shape::tri3},  {AnalysisKind::plane_strain, Shape::quad4},
    {AnalysisKind::plane_strain, Shape::quad8}, {AnalysisKind::axisymmetric, Shape::tri3},
    {AnalysisKind::axisymmetric, Shape::quad4}, {AnalysisKind::solid, Shape::tet4},
    {AnalysisKind::solid, Shape::hex8},         {AnalysisKind::solid, Shape::tet10}};

using Motion = std::function<Point(const Point&)>;

/// A body whose nodes move and change their temperature as a test says.
class Bar {
 public:
  explicit Bar(const Kind& kind, bool melts = true)
      : mesh_(test::make_mesh({.shape = kind.shape, .cells = {3, 2, 2}, .distortion = 0.1})),
        kind_(kind.analysis),
        materials_{metal(melts)},
        criteria_(mesh_, mesh_, kind_, materials_) {
    heat_.temperature.assign(mesh_.x.size(), k_hot);
    mechanics_.displacement.assign(mesh_.x.size() * components(), 0.0);
    record_ = criteria_.initial({0, heat_, mechanics_});
  }

  void step(double temperature, const Motion& u, double length = 1) {
    step([temperature](const Point&) { return temperature; }, u, length);
  }
  void step(const std::function<double(const Point&)>& temperature, const Motion& u, double length = 1) {
    heat::ThermalState heat;
    for (const Point& x : mesh_.x) heat.temperature.push_back(temperature(x));
    mechanics::MechanicalState mechanics;
    for (const Point& x : mesh_.x)
      for (std::size_t i = 0; i < components(); ++i) mechanics.displacement.push_back(u(x)[i]);
    criteria_.step({time_, heat_, mechanics_}, {time_ + length, heat, mechanics}, record_);
    time_ += length;
    heat_ = heat;
    mechanics_ = mechanics;
  }

  struct Fields {
    std::vector<double> in_liquid, since_coherency, brittle, distortion;
  };
  Fields fields() const {
    const std::size_t n = record_.columns[0].values.size() / 6;
    Fields f{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n),
             std::vector<double>(mechanics_.displacement.size())};
    const std::vector<std::span<double>> spans{f.in_liquid, f.since_coherency, f.brittle, f.distortion};
    criteria_.fill({time_, heat_, mechanics_}, record_, spans);
    return f;
  }

  /// A stretch that keeps the volume; its equivalent is `equivalent` times the stretch.
  Motion stretch(double e) const {
    if (kind_ == AnalysisKind::plane_strain)
      return [e](const Point& x) { return Point{e * x[0], -e * x[1], 0}; };
    if (kind_ == AnalysisKind::axisymmetric)
      return [e](const Point& x) { return Point{-0.5 * e * x[0], e * x[1], 0}; };
    return [e](const Point& x) { return Point{e * x[0], -0.5 * e * x[1], -0.5 * e * x[2]}; };
  }
  double equivalent() const { return kind_ == AnalysisKind::plane_strain ? 2 / std::sqrt(3.0) : 1.0; }

  const mesh::Mesh& mesh() const { return mesh_; }
  const CriterionRecord& record() const { return record_; }
  const StrainCriteria& criteria() const { return criteria_; }
  std::size_t components() const { return static_cast<std::size_t>(displacement_components(kind_)); }

 private:
  mesh::Mesh mesh_;
  AnalysisKind kind_;
  std::vector<material::Material> materials_;
  StrainCriteria criteria_;
  heat::ThermalState heat_;
  mechanics::MechanicalState mechanics_;
  CriterionRecord record_;
  double time_ = 0;
};

void expect_all(const std::vector<double>& values, double expected) {
  for (const double value : values) EXPECT_NEAR(value, expected, k_rounding);
}

TEST(StrainSinceCoherency, OfABarPulledAsMeltAndThenAsSolidIsWhatTheSolidTook) {
  for (const Kind& kind : k_kinds) {
    Bar bar(kind);
    bar.step(k_hot, bar.stretch(0.01));
    bar.step(k_cold, bar.stretch(0.03));  // it begins as melt
    bar.step(k_cold, bar.stretch(0.04));
    const Bar::Fields f = bar.fields();
    expect_all(f.in_liquid, 0.03 * bar.equivalent());
    expect_all(f.since_coherency, 0.01 * bar.equivalent());
    expect_all(f.brittle, 0);
  }
}

TEST(StrainSinceCoherency, IsTheWholeStrainOfABodyThatNeverMelts) {
  for (const Kind& kind : k_kinds) {
    Bar bar(kind, false);
    bar.step(k_hot, bar.stretch(0.01));
    bar.step(k_cold, bar.stretch(-0.02));
    const Bar::Fields f = bar.fields();
    expect_all(f.in_liquid, 0);
    expect_all(f.since_coherency, 0.02 * bar.equivalent());
  }
}

TEST(StrainSinceCoherency, CountsFromTheCoherencyFractionOn) {
  Bar bar(k_kinds[0]);
  bar.step(at_fraction(0.74), bar.stretch(0.01));
  bar.step(at_fraction(0.76), bar.stretch(0.02));  // begins below 0.75
  bar.step(at_fraction(0.80), bar.stretch(0.05));  // begins above
  expect_all(bar.fields().in_liquid, 0.02 * bar.equivalent());
  expect_all(bar.fields().since_coherency, 0.03 * bar.equivalent());
}

TEST(StrainSinceCoherency, ForgetsWhatMeltsAgain) {
  Bar bar(k_kinds[1]);
  bar.step(k_cold, bar.stretch(0.0));
  bar.step(at_fraction(0.95), bar.stretch(0.01));
  bar.step(k_hot, bar.stretch(0.02));
  EXPECT_GT(bar.fields().since_coherency[0], 0.01);
  EXPECT_GT(bar.fields().brittle[0], 0.001);
  bar.step(k_hot, bar.stretch(0.05));
  expect_all(bar.fields().since_coherency, 0);
  expect_all(bar.fields().brittle, 0);
  expect_all(bar.fields().in_liquid, 0.05 * bar.equivalent());
}

// Thermal strain and shrinkage of a free body.
TEST(StrainCriteria, SeeNoStrainInABodyThatShrinksFreely) {
  for (const Kind& kind : k_kinds) {
    Bar bar(kind);
    for (const double fraction : {0.2, 0.8, 0.92, 0.97, 1.0, 1.2}) {
      const double e = -0.01 * fraction;
      const bool plane = kind.analysis == AnalysisKind::plane_strain;
      bar.step(at_fraction(fraction), [&](const Point& x) {
        return plane ? Point{0, 0, 0} : Point{e * x[0], e * x[1], e * x[2]};
      });
    }
    const Bar::Fields f = bar.fields();
    expect_all(f.in_liquid, 0);
    expect_all(f.since_coherency, 0);
    // J₂ of rounding under a root
    for (const double value : f.brittle) EXPECT_NEAR(value, 0, 1e-12);
  }
}

// 0.80 to 0.95 is in the range for a third of the step, 0.95 to 1 for four fifths.
TEST(BrittleStrain, TakesTheShareOfAStepInWhichTheMetalIsBrittle) {
  for (const Kind& kind : k_kinds) {
    Bar pulled(kind), pressed(kind);
    double e = 0;
    for (const double fraction : {0.5, 0.8, 0.95, 1.0, 1.5}) {
      e += 0.01;
      pulled.step(at_fraction(fraction), pulled.stretch(e));
      pressed.step(at_fraction(fraction), pressed.stretch(-e));
    }
    const double sum = 0.01 * (1.0 / 3 + 0.8);
    for (const double value : pulled.fields().brittle) EXPECT_NEAR(value, sum, 1e-12);
    // Pressed along a line metal is pulled across it, in plane strain by as much.
    const double across = kind.analysis == AnalysisKind::plane_strain ? 1 : 0.5;
    // Two principal values are equal: the closed form loses half of its digits.
    for (const double value : pressed.fields().brittle) EXPECT_NEAR(value, across * sum, 1e-9);
    const std::vector<CriterionResult> findings = pulled.criteria().findings(pulled.record());
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_NEAR(findings[0].value, sum, 1e-12);
  }
}

TEST(BrittleStrain, OfPullAndPushAddsUpToNothing) {
  Bar bar(k_kinds[5]);
  bar.step(at_fraction(0.93), bar.stretch(0.0));
  bar.step(at_fraction(0.93), bar.stretch(0.01));
  for (const double value : bar.fields().brittle) EXPECT_NEAR(value, 0.01, 1e-12);
  bar.step(at_fraction(0.93), bar.stretch(0.0));
  for (const double value : bar.fields().brittle) EXPECT_NEAR(value, 0, 1e-12);
}

TEST(Distortion, OfARigidMotionIsNothing) {
  for (const Kind& kind : k_kinds) {
    Bar bar(kind);
    bar.step(k_cold, [](const Point&) { return Point{}; });
    bar.step(k_cold, [&](const Point& x) {
      switch (kind.analysis) {
        case AnalysisKind::plane_strain:
          return Point{0.02 - 0.03 * x[1], 0.01 + 0.03 * x[0], 0};
        case AnalysisKind::axisymmetric:
          return Point{0, 0.05, 0};
        default:
          return Point{0.02 - 0.03 * x[1] + 0.01 * x[2], 0.01 + 0.03 * x[0], -0.02 - 0.01 * x[0]};
      }
    });
    expect_all(bar.fields().distortion, 0);
  }
}

// A bend about the middle of a symmetric body holds no rigid motion but its mean.
TEST(Distortion, LeavesWhatIsNotRigid) {
  Bar bar({AnalysisKind::axisymmetric, Shape::quad4});
  for (int i = 0; i < 2; ++i) bar.step(k_cold, [](const Point&) { return Point{}; });
  bar.step(k_cold, [](const Point& x) { return Point{0.01 * x[0], 0.07, 0}; });
  const Bar::Fields f = bar.fields();
  for (std::size_t node = 0; node < bar.mesh().x.size(); ++node) {
    EXPECT_NEAR(f.distortion[2 * node], 0.01 * bar.mesh().x[node][0], k_rounding);
    EXPECT_NEAR(f.distortion[2 * node + 1], 0, k_rounding);
  }
}

TEST(Distortion, CountsFromCoherencyOn) {
  Bar bar({AnalysisKind::axisymmetric, Shape::quad4});
  bar.step(k_hot, [](const Point& x) { return Point{0.3 * x[0], 0.4 * x[1], 0}; });
  expect_all(bar.fields().distortion, 0);
  // It is coherent at three quarters of this step, on a straight line, and goes with the melt to its end.
  bar.step(k_cold, [](const Point& x) { return Point{0.35 * x[0], 0.4 * x[1], 0}; });
  expect_all(bar.fields().distortion, 0);
  // The last quarter of that step is as one of this.
  bar.step(k_cold, [](const Point& x) { return Point{0.37 * x[0], 0.4 * x[1], 0}; });
  bar.step(k_cold, [](const Point& x) { return Point{0.38 * x[0], 0.4 * x[1], 0}; });
  const Bar::Fields f = bar.fields();
  for (std::size_t node = 0; node < bar.mesh().x.size(); ++node)
    EXPECT_NEAR(f.distortion[2 * node], 0.035 * bar.mesh().x[node][0], k_rounding);
}

// Metal lies on its wall to the end of the step in which it becomes coherent, and leaves it in a short one:
// the rate of that would carry it back by 75 times its way.
TEST(Distortion, OfMetalThatLeavesItsWallInAShortStepIsItsWay) {
  Bar bar({AnalysisKind::axisymmetric, Shape::quad4});
  bar.step(k_hot, [](const Point&) { return Point{}; });
  bar.step(k_cold, [](const Point&) { return Point{}; });
  bar.step(
      k_cold,
      [](const Point& x) {
        return Point{-0.01 * x[0], 0, 0};
      },
      0.01);
  const Bar::Fields f = bar.fields();
  for (std::size_t node = 0; node < bar.mesh().x.size(); ++node)
    EXPECT_NEAR(f.distortion[2 * node], -0.01 * bar.mesh().x[node][0], k_rounding);
}

// A wall that is solid is next to melt that sinks. The nodes between them are solid, their elements on one
// side are not: they go with the melt, and that is no distortion.
TEST(Distortion, OfANodeBeginsWhenAllItsElementsAreCoherent) {
  Bar bar({AnalysisKind::axisymmetric, Shape::quad4});
  const auto half_solid = [](const Point& x) { return x[0] < 0.5 ? k_cold : k_hot; };
  const auto sinks = [](double by) {
    return [by](const Point& x) { return Point{0, x[0] < 0.2 ? 0.0 : -by, 0}; };
  };
  bar.step(half_solid, sinks(0));
  bar.step(half_solid, sinks(0.1));
  bar.step(k_cold, sinks(0.1));
  bar.step(k_cold, sinks(0.1));
  bool between = false;
  for (const Point& x : bar.mesh().x) between = between || (x[0] > 0.2 && x[0] < 0.5);
  EXPECT_TRUE(between) << "no solid node next to melt";
  expect_all(bar.fields().distortion, 0);
}

}  // namespace
}  // namespace solidus::criteria
