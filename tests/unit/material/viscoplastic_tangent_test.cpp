/// The tangent of the viscoplastic law against automatic differentiation of its stress.
#include <gtest/gtest.h>

#include <algorithm>

#include "flow_cases.hpp"
#include "laws_on_duals.hpp"

namespace solidus::material::test {
namespace {

// Solid, almost solid, mushy, almost liquid, liquid: f_S = 1, 1 − 1e-12, ½, 1e-12, 0.
constexpr double k_temperatures[] = {400, 880 + 5e-11, 905, 930 - 5e-11, 950};

struct Count {
  int elastic = 0, plastic = 0;
};

/// Largest difference of the tangent to automatic differentiation, in parts of its stiffness.
double tangent_error(const Viscoplastic& law, double temperature, const Viscoplastic::State<double>& start,
                     const Sym<double>& strain, double dt, Count& count) {
  auto p = law.properties_at(temperature, 300.0);
  p.elastic.bulk = 0;  // it is many times the shear stiffness of a melt and would hide its errors
  Sym<Ad> strain_ad;
  for (int i = 0; i < 6; ++i) strain_ad[i] = Ad(strain[i], 6, i);

  const auto r = law.update(p, start, strain, dt);
  const auto r_ad = law.update(convert<Ad>(p), convert<Ad>(start), strain_ad, dt);
  EXPECT_EQ(r.status, Status::converged);
  ++(r.flow_increment > 0 ? count.plastic : count.elastic);
  const auto c = full_tangent(r);
  const double stiffness = law.shear(p.elastic, dt).twice_shear;
  double error = 0;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      // AD differentiates by tensor components; a shear component is half the engineering strain
      const double exact = r_ad.stress[a].derivatives()[static_cast<std::size_t>(b)] * (b < 3 ? 1.0 : 0.5);
      error = std::max(error, std::abs(c[a][static_cast<std::size_t>(b)] - exact));
    }
  return stiffness > 0 ? error / stiffness : error;
}

void check_tangents(LiquidModel liquid) {
  Random random(11);
  Count count;
  for (const auto isotropic : k_isotropic)
    for (const auto kinematic : k_kinematic)
      for (const double n : {1.0, 1.7, 3.0, 8.0, 30.0})
        for (const double eta : {0.0, 1e-6, 1.0, 1e6, 1e9, 1e12}) {
          const Material m = flow_material({isotropic, kinematic, eta, n, liquid});
          const Viscoplastic law(m);
          for (const double temperature : k_temperatures)
            for (const double size : {1e-4, 2e-3, 3e-2}) {
              const auto start = random_state(random);
              const double error = tangent_error(law, temperature, start, random_tensor(random, size),
                                                 decades(random, -3, 2), count);
              ASSERT_LT(error, 1e-9) << "isotropic " << static_cast<int>(isotropic) << " kinematic "
                                     << static_cast<int>(kinematic) << " n " << n << " eta " << eta << " T "
                                     << temperature << " strain " << size;
            }
        }
  EXPECT_GT(count.elastic, 1000);
  EXPECT_GT(count.plastic, 1000);
}

TEST(ViscoplasticTangent, IsTheDerivativeOfTheStressWithAMaxwellLiquid) {
  check_tangents(LiquidModel::maxwell);
}
TEST(ViscoplasticTangent, IsTheDerivativeOfTheStressWithAModifiedShearModulus) {
  check_tangents(LiquidModel::modified_shear);
}
TEST(ViscoplasticTangent, IsTheDerivativeOfTheStressInTheDegeneratedModel) {
  check_tangents(LiquidModel::degenerated);
}

TEST(ViscoplasticTangent, IsTheDerivativeOfTheStressForEveryViscosityOfTheLiquid) {
  Random random(12);
  Count count;
  for (const double liquid : {1e-3, 1.0, 1e3, 1e6, 1e9, 1e12, 1e16})
    for (const double eta : {0.0, 1.0, 1e6, 1e12})
      for (const double temperature : k_temperatures) {
        const Material m =
            flow_material({IsotropicHardening::saturation, KinematicHardening::armstrong_frederick, eta, 3.0,
                           LiquidModel::maxwell, liquid});
        const auto start = random_state(random);
        ASSERT_LT(tangent_error(Viscoplastic(m), temperature, start, random_tensor(random, 1e-2), 0.1, count),
                  1e-9)
            << "liquid " << liquid << " eta " << eta << " T " << temperature;
      }
}

TEST(ViscoplasticTangent, IsSymmetricExceptWithRecall) {
  Random random(13);
  for (const auto kinematic : k_kinematic) {
    const Material m = flow_material({IsotropicHardening::saturation, kinematic, 1e6, 3.0});
    const Viscoplastic law(m);
    const bool recalls = kinematic == KinematicHardening::armstrong_frederick;
    EXPECT_EQ(law.symmetric(), !recalls);
    const auto p = law.properties_at(400.0, 300.0);
    auto start = random_state(random);
    start.back_strain = dev(random_tensor(random, 1e-2));  // it turns the flow
    const auto c = full_tangent(law.update(p, start, random_tensor(random, 1e-2), 0.1));
    double skew = 0;
    for (std::size_t a = 0; a < 6; ++a)
      for (std::size_t b = 0; b < 6; ++b) skew = std::max(skew, std::abs(c.c[a][b] - c.c[b][a]));
    if (recalls)
      EXPECT_GT(skew, 1e-4 * p.elastic.shear);
    else
      EXPECT_LT(skew, 1e-14 * p.elastic.shear);
  }
}

}  // namespace
}  // namespace solidus::material::test
