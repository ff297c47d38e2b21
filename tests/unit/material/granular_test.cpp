/// The law of sand at a material point: paths with an answer in closed form, its tangent, and what does not
/// come back.
#include "material/granular.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "material/cards/library.hpp"

namespace solidus::material {
namespace {

constexpr double k_young = 300e6, k_poisson = 0.25;  // [Pa], [1]
constexpr double k_bulk = k_young / (3 * (1 - 2 * k_poisson)), k_shear = k_young / (2 * (1 + k_poisson));
constexpr double k_room = 293.15;
const double k_root_three = std::sqrt(3.0);

double rad(double degrees) {
  return degrees * std::acos(-1.0) / 180;
}

Material solid() {
  Material m;
  m.name = "sand";
  m.density = 1500;
  m.conductivity = Table(0.6);
  m.specific_heat = Table(1000);
  m.young_modulus = Table(k_young);
  m.poisson_ratio = Table(k_poisson);
  m.expansion = Table(0.0);
  return m;
}

Function constant(double value) {
  Function f;
  f.table = Table(value);
  return f;
}

/// Perfectly plastic, without the stiffness of grains that touch: that of the closed forms.
GranularData perfect() {
  GranularData d;
  d.cohesion = constant(80e3);
  d.tension_cutoff = constant(20e3);
  d.friction_angle = rad(35);
  d.dilatancy_angle = rad(10);
  return d;
}

/// A point that is taken along a path.
class Point {
 public:
  Point(Material material, const GranularData& data)
      : material_(std::move(material)), law_(make_granular_law(material_, data)), old_(law_->size(), 0.0) {}
  explicit Point(const GranularData& data) : Point(solid(), data) {}

  ExternalLaw::Response<double> tried(const Sym<double>& strain, double dt = 1) const {
    std::vector<double> now(old_.size());
    return law_->update(properties(), old_.data(), now.data(), strain, dt);
  }
  ExternalLaw::Response<double> go(const Sym<double>& strain, double dt = 1) {
    std::vector<double> now(old_.size());
    const auto r = law_->update(properties(), old_.data(), now.data(), strain, dt);
    EXPECT_EQ(r.status, Status::converged);
    EXPECT_GE(r.dissipation, 0);
    old_ = now;
    strain_ = strain;
    return r;
  }
  /// One step of a cylinder: the axial strain (z) is given, both lateral stresses stay.
  Sym<double> compress(double axial, double lateral_stress) {
    Sym<double> strain = strain_;
    strain[2] = axial;
    for (int i = 0; i < 50; ++i) {
      const auto r = tried(strain);
      const double residual = r.stress[0] - lateral_stress;
      if (std::abs(residual) < 1e-9 * 80e3) break;
      const double slope = r.tangent[0][0] + r.tangent[0][1];
      strain[0] -= residual / slope;
      strain[1] = strain[0];
    }
    return go(strain).stress;
  }
  double state(std::size_t which) const { return old_[ExternalLaw::k_internal + which]; }
  const Sym<double>& strain() const { return strain_; }
  double temperature = k_room;

 private:
  ExternalLaw::Properties<double> properties() const {
    return {properties_at(material_, temperature, k_room, PhaseState<double>{1.0, 0.0}), temperature, k_room};
  }
  Material material_;
  std::shared_ptr<const ExternalLaw> law_;
  std::vector<double> old_;
  Sym<double> strain_;
};

Sym<double> hydrostatic(double volume) {
  Sym<double> e;
  e[0] = e[1] = e[2] = volume / 3;
  return e;
}

// A cell pressure p: σ_1 = −(p N + 2c √N), N = (1 + sin φ)/(1 − sin φ), that of Mohr and Coulomb, and then
// flow at constant stress with the potential's ratio of volume to axial strain.
TEST(Granular, TriaxialCompressionHasTheStrengthOfMohrAndCoulombAndTheDilationOfItsPotential) {
  for (const double cell : {0.0, 50e3, 200e3}) {
    const GranularData d = perfect();
    Point point(d);
    for (int i = 1; i <= 10; ++i) point.go(hydrostatic(-cell / k_bulk * i / 10));
    const double sine = std::sin(d.friction_angle), n = (1 + sine) / (1 - sine);
    const double expected = -(cell * n + 2 * 80e3 * std::sqrt(n));
    Sym<double> stress;
    for (int i = 1; i <= 20; ++i) stress = point.compress(-0.01 * i / 20, -cell);
    EXPECT_NEAR(stress[2], expected, 1e-8 * std::abs(expected));
    const Sym<double> before = point.strain();
    stress = point.compress(-0.02, -cell);
    EXPECT_NEAR(stress[2], expected, 1e-8 * std::abs(expected));
    const Sym<double> change = point.strain() - before;
    const double dilation = cone_slope(d.dilatancy_angle);
    EXPECT_NEAR(trace(change) / change[2], dilation / (dilation / 3 - 1 / k_root_three), 1e-8);
  }
}

TEST(Granular, UniaxialStrengthsAreThatOfMohrAndCoulombAndThreeTimesTheCutOff) {
  const double sine = std::sin(rad(35)), cosine = std::cos(rad(35));
  Point pressed(perfect());
  Sym<double> stress;
  for (int i = 1; i <= 10; ++i) stress = pressed.compress(-0.002 * i, 0);
  EXPECT_NEAR(stress[2], -2 * 80e3 * cosine / (1 - sine), 1e-8 * 80e3);
  Point pulled(perfect());
  for (int i = 1; i <= 4; ++i) stress = pulled.compress(1e-4 * i, 0);
  EXPECT_NEAR(stress[2], 3 * 20e3, 1e-8 * 80e3);
}

TEST(Granular, HydrostaticTensionOpensAtTheCutOffAndAtAnApex) {
  GranularData d = perfect();
  for (const double cut_off : {20e3, 80e3 / std::tan(rad(35))}) {
    d.tension_cutoff = constant(cut_off);
    Point point(d);
    point.go(hydrostatic(0.5 * cut_off / k_bulk));
    for (const double volume : {1e-3, 2e-3, 0.1}) {
      const Sym<double> stress = point.go(hydrostatic(volume)).stress;
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(stress[i], cut_off, 1e-8 * cut_off);
    }
    EXPECT_NEAR(point.state(Granular::k_broken), 0.1 - cut_off / k_bulk, 1e-10);
    // Shear at the apex has no strength, and pressure closes what has opened.
    const Sym<double> closed = point.go(hydrostatic(0.1 - 2e-3)).stress;
    EXPECT_NEAR(closed[0], cut_off - 2e-3 * k_bulk, 1e-8 * k_bulk * 2e-3);
  }
}

// Strain along one axis: the direction of the deviator is fixed, so p and q move along straight lines.
TEST(Granular, CompressionWithoutLateralStrainFollowsTheClosedFormInOneStepOrMany) {
  GranularData d = perfect();
  d.friction_angle = rad(10);  // sand of 35 degrees holds itself up: it stays elastic
  d.dilatancy_angle = rad(5);
  const double axial = -0.02;
  const double eta = cone_slope(d.friction_angle), dilation = cone_slope(d.dilatancy_angle),
               strength = cone_cohesion_factor(d.friction_angle) * 80e3;
  const double p = k_bulk * axial, q = 2 * k_shear * std::abs(axial) / k_root_three;
  const double slip = (q + eta * p - strength) / (k_shear + k_bulk * eta * dilation);
  ASSERT_GT(slip, 0);
  const double mean = p - k_bulk * dilation * slip, radius = q - k_shear * slip;
  for (const int n : {1, 7, 100}) {
    Point point(d);
    Sym<double> strain, stress;
    for (int i = 1; i <= n; ++i) {
      strain[2] = axial * i / n;
      stress = point.go(strain).stress;
    }
    EXPECT_NEAR(stress[2], mean - 2 * radius / k_root_three, 1e-8 * radius);
    EXPECT_NEAR(stress[0], mean + radius / k_root_three, 1e-8 * radius);
    EXPECT_NEAR(point.state(Granular::k_broken), slip, 1e-8 * slip);
  }
}

TEST(Granular, SandIsCrushedAtItsPressureAndSlidesAtTheEdgeOfThatPlane) {
  GranularData d = perfect();
  d.crushing_pressure = constant(500e3);
  Point point(d);
  EXPECT_NEAR(point.go(hydrostatic(-0.01)).stress[0], -500e3, 1e-8 * 500e3);
  EXPECT_EQ(point.state(Granular::k_broken), 0);
  Sym<double> strain = hydrostatic(-0.02);
  strain[3] = 0.05;
  const Sym<double> stress = point.go(strain).stress;
  const double radius = cone_cohesion_factor(d.friction_angle) * 80e3 + cone_slope(d.friction_angle) * 500e3;
  EXPECT_NEAR(trace(stress) / 3, -500e3, 1e-8 * 500e3);
  EXPECT_NEAR(stress[3], radius, 1e-8 * radius);
}

/// The largest difference of the tangent to central differences, relative to the elastic one.
double tangent_error(const Point& point, const Sym<double>& strain, double dt) {
  const auto r = point.tried(strain, dt);
  double error = 0;
  for (int b = 0; b < 6; ++b) {
    const double h = 1e-8;
    Sym<double> more = strain, less = strain;
    more[b] += (b < 3 ? 1 : 0.5) * h;
    less[b] -= (b < 3 ? 1 : 0.5) * h;
    const Sym<double> difference = point.tried(more, dt).stress - point.tried(less, dt).stress;
    for (int a = 0; a < 6; ++a)
      error = std::max(error, std::abs(r.tangent[a][static_cast<std::size_t>(b)] - difference[a] / (2 * h)));
  }
  return error / (2 * k_shear);
}

TEST(Granular, TangentIsTheDerivativeOfTheStressOnEveryFaceWithGrainsAndRelaxation) {
  GranularData d = perfect();
  d.crushing_pressure = constant(500e3);
  d.residual_stiffness = 0.01;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const double relaxation : {0.0, 3.0})
    for (const double angle : {0.0, 10.0, 35.0}) {
      d.dilatancy_angle = rad(angle);
      d.relaxation_time = relaxation;
      // Centres within the elastic range, on the cone, above both cut-offs and at both edges.
      for (const auto& [volume, shear] :
           {std::pair{0.0, 1e-5}, {-1e-3, 2e-3}, {2e-3, 1e-5}, {2e-3, 5e-3}, {-1e-2, 1e-4}, {-1e-2, 2e-2}}) {
        Point point(d);
        point.go(hydrostatic(-1e-5));
        Sym<double> strain;
        for (int i = 0; i < 6; ++i) strain[i] = normal(random);
        strain = (shear / norm(dev(strain))) * dev(strain) + hydrostatic(volume);
        EXPECT_LT(tangent_error(point, strain, 2), 2e-6) << angle << " " << volume << " " << shear;
        const auto r = point.tried(strain, 2);
        if (angle == 35.0)
          for (int i = 0; i < 6; ++i)
            for (int j = 0; j < i; ++j)
              EXPECT_NEAR(r.tangent[i][static_cast<std::size_t>(j)],
                          r.tangent[j][static_cast<std::size_t>(i)], 1e-9 * k_young);
      }
    }
}

TEST(Granular, BinderThatHasBurntDoesNotComeBackWithTheCold) {
  Material m = solid();
  GranularData d = perfect();
  d.burnout_rate = constant(0);
  d.burnout_rate->table = Table({500, 600}, {0.0, 0.02});
  d.burnt_stiffness = 0.1;
  d.residual_cohesion = 1e3;
  Point point(m, d);
  point.go({}, 10);
  EXPECT_EQ(point.state(Granular::k_burnt), 0);
  point.temperature = 550;
  point.go({}, 1e-9);  // the rate of a step is the mean of its ends
  for (int i = 0; i < 5; ++i) point.go({}, 20);
  const double left = std::exp(-0.01 * 100);
  EXPECT_NEAR(point.state(Granular::k_burnt), 1 - left, 1e-8);
  point.temperature = k_room;
  point.go({}, 1e-9);
  point.go({}, 1e4);
  EXPECT_NEAR(point.state(Granular::k_burnt), 1 - left, 1e-8);
  // Stiffness and strength in compression of what is left.
  const double small = -1e-7;
  EXPECT_NEAR(point.compress(small, 0)[2] / small, k_young * (0.1 + 0.9 * left), 1e-8 * k_young);
  Sym<double> stress;
  for (int i = 1; i <= 10; ++i) stress = point.compress(-0.01 * i, 0);
  const double sine = std::sin(rad(35)), cosine = std::cos(rad(35));
  EXPECT_NEAR(stress[2], -2 * (1e3 + 79e3 * left) * cosine / (1 - sine), 1e-8 * 80e3);
}

TEST(Granular, StressFallsWithTheModulusAndStaysWhereSandGetsStiffer) {
  Material m = solid();
  m.young_modulus = Table({300, 400, 500}, {300e6, 100e6, 300e6});
  Point point(m, perfect());
  point.temperature = 300;
  Sym<double> strain;
  strain[2] = -1e-5;
  const double first = point.go(strain).stress[2];
  point.temperature = 400;
  EXPECT_NEAR(point.go(strain).stress[2], first / 3, 1e-12 * std::abs(first));
  point.temperature = 500;
  EXPECT_NEAR(point.go(strain).stress[2], first / 3, 1e-12 * std::abs(first));
}

// Pure shear: dq = −H dκ, dγ = dq/G + dκ, a straight fall to the residual strength. Bonds that break are
// missed a step later: order one.
TEST(Granular, SofteningConvergesWithTheStepToItsClosedForm) {
  GranularData d = perfect();
  d.dilatancy_angle = 0;
  d.softening_strain = 0.02;
  d.residual_cohesion = 20e3;
  const double factor = cone_cohesion_factor(d.friction_angle), first = factor * 80e3;
  const double fall = factor * 60e3 / 0.02, gamma = 0.01;
  const double broken = (gamma - first / k_shear) / (1 - fall / k_shear);
  std::vector<double> errors;
  for (const int n : {100, 200, 400}) {
    Point point(d);
    Sym<double> strain, stress;
    for (int i = 1; i <= n; ++i) {
      strain[3] = 0.5 * gamma * i / n;
      stress = point.go(strain).stress;
    }
    errors.push_back(std::abs(stress[3] - (first - fall * broken)) / first);
  }
  EXPECT_LT(errors[2], 0.01);
  EXPECT_NEAR(errors[0] / errors[1], 2, 0.1);
  EXPECT_NEAR(errors[1] / errors[2], 2, 0.1);
}

TEST(Granular, ExcessAboveTheStrengthFadesWithTheRelaxationTime) {
  GranularData d = perfect();
  d.relaxation_time = 10;
  Point point(d);
  Sym<double> strain;
  strain[3] = 0.01;
  const double trial = 2 * k_shear * 0.01, limit = cone_cohesion_factor(d.friction_angle) * 80e3;
  d.dilatancy_angle = 0;
  Point flat(d);
  double excess = trial - limit;
  for (int i = 0; i < 4; ++i) {
    excess /= 1 + 5.0 / 10;
    EXPECT_NEAR(flat.go(strain, 5).stress[3], limit + excess, 1e-8 * trial);
  }
}

// Nothing that happens to a point may end a run: no step is refused and nothing is not a number.
TEST(Granular, RandomHistoriesOfWeakSandHaveAnAnswerInEveryStep) {
  GranularData d = perfect();
  d.softening_strain = 0.01;
  d.burnout_rate = constant(1e-3);
  d.burnt_stiffness = 0.01;
  d.residual_stiffness = 1e-3;
  d.crushing_pressure = constant(300e3);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int history = 0; history < 200; ++history) {
    Point point(d);
    Sym<double> strain;
    for (int step = 0; step < 50; ++step) {
      const double size = std::pow(10.0, -6 + 5 * std::abs(std::sin(7.0 * step + history)));
      for (int i = 0; i < 6; ++i) strain[i] += size * normal(random);
      const auto r = point.go(strain, 10);
      ASSERT_TRUE(std::isfinite(norm(r.stress)));
      const double p = trace(r.stress - 1e-3 * k_bulk * trace(strain) * Sym<double>::identity()) / 3;
      ASSERT_LE(p, 20e3 * (1 + 1e-9) + 1e-3 * 3 * k_bulk * norm(strain));
    }
  }
}

class GranularCards : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  /// What is reported about a card with these lines in [granular].
  std::string refusal(const std::string& lines, const std::string& before = "") {
    std::ofstream(folder_ / "sand.toml") << before << R"(
density = { value = "1500 kg/m3" }
conductivity = { value = "0.6 W/m/K" }
specific_heat = { value = "1000 J/kg/K" }
young_modulus = { value = "300 MPa" }
poisson_ratio = { value = "0.25" }
expansion = { value = "0 1/K" }
[granular]
)" << lines;
    try {
      load_material(folder_ / "sand.toml");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("granular_" + std::to_string(::getpid()));
};

TEST_F(GranularCards, ConesThatAreNoneAreRefusedWithTheirNumbers) {
  const std::string strength = "cohesion = { value = \"80 kPa\" }\ntension_cutoff = { value = \"20 kPa\" }\n";
  EXPECT_EQ(refusal(strength + "friction_angle = \"35 degree\"\n"), "");
  const auto says = [&](const std::string& lines, const std::string& part) {
    const std::string found = refusal(lines);
    EXPECT_NE(found.find(part), std::string::npos) << lines << "\n" << found;
  };
  says(strength + "friction_angle = \"90 degree\"\n", "friction_angle");
  says(strength + "friction_angle = \"0 degree\"\n", "friction_angle");
  says(strength + "friction_angle = \"30 degree\"\ndilatancy_angle = \"35 degree\"\n",
       "dilatancy_angle of 'sand', 35 degree, is above its friction_angle, 30 degree");
  says(
      "friction_angle = \"45 degree\"\ncohesion = { value = \"80 kPa\" }\n"
      "tension_cutoff = { value = \"90 kPa\" }\n",
      "above the apex of its cone, cohesion cot(friction_angle) = 80 kPa");
  says(
      "friction_angle = \"35 degree\"\ncohesion = { value = \"-1 kPa\" }\n"
      "tension_cutoff = { value = \"0 kPa\" }\n",
      "cohesion");
  says(
      "friction_angle = \"35 degree\"\ncohesion = { value = \"80 MPa\" }\n"
      "tension_cutoff = { value = \"20 kPa\" }\n",
      "more than a tenth of its young_modulus");
  says(strength + "friction_angle = \"35 degree\"\nresidual_cohesion = \"90 kPa\"\n", "residual_cohesion");
  says("friction_angle = \"35 degree\"\ncohesion = { value = \"80 kPa\" }\n", "tension_cutoff");
  EXPECT_NE(refusal(strength + "friction_angle = \"35 degree\"\n[external]\nlibrary = \"a.so\"\n"
                               "interface = \"umat\"\nstate_variables = 0\n")
                .find("not its only law"),
            std::string::npos);
}

TEST_F(GranularCards, AMetalThatMeltsIsNotGranular) {
  const std::string found = refusal(
      "cohesion = { value = \"80 kPa\" }\ntension_cutoff = { value = \"20 kPa\" }\n"
      "friction_angle = \"35 degree\"\n"
      "[[phase_change]]\nname = \"solidification\"\nsolidification = true\nlatent_heat = \"1 kJ/kg\"\n"
      "fraction = { kind = \"linear\", solidus = \"900 K\", liquidus = \"1000 K\" }\n");
  EXPECT_NE(found.find("no law of a metal that melts"), std::string::npos) << found;
}

}  // namespace
}  // namespace solidus::material
