/// The semi-analytic references of the coupled schemes are themselves compared here: with closed forms where
/// the coupling vanishes, with their differential equations and with balances where it does not.
#include <gtest/gtest.h>

#include "analytic/coupled_half_space.hpp"
#include "analytic/coupled_layer.hpp"

namespace solidus {
namespace {

using analytic::CoupledHalfSpace;
using analytic::CoupledLayer;
using analytic::inverse_laplace;
using Complex = std::complex<double>;

constexpr double k_inversion = 1e-8;  // what the headers promise of the inversion
const std::vector<double> k_couplings{0.05, 0.36, 1};

template <class F>
double first(const F& f, double x, double h) {
  return (f(x + h) - f(x - h)) / (2 * h);
}
template <class F>
double second(const F& f, double x, double h) {
  return (f(x + h) - 2 * f(x) + f(x - h)) / (h * h);
}
/// Simpson's rule.
template <class F>
double integral(const F& f, double from, double to, int intervals) {
  const double h = (to - from) / intervals;
  double sum = f(from) + f(to);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(from + i * h);
  return sum * h / 3;
}

TEST(InverseLaplace, MeetsTransformsOfTables) {
  for (double t : {1e-3, 0.1, 1.0, 7.0}) {
    EXPECT_NEAR(inverse_laplace([](Complex s) { return 1.0 / (s + 1.0); }, 0, t), std::exp(-t), k_inversion);
    EXPECT_NEAR(inverse_laplace([](Complex s) { return 1.0 / (s * s); }, 0, t), t, k_inversion * t);
    EXPECT_NEAR(inverse_laplace([](Complex s) { return 1.0 / (s - 1.0); }, 1, t), std::exp(t),
                k_inversion * std::exp(t));
    EXPECT_NEAR(inverse_laplace([](Complex s) { return std::exp(-std::sqrt(s)) / s; }, 0, t),
                std::erfc(0.5 / std::sqrt(t)), k_inversion);
    EXPECT_EQ(inverse_laplace([](Complex) { return Complex(0); }, 0, t), 0);
  }
}

/// Danilovskaya's stress of the half space at θ = 1 without the heat of straining.
double danilovskaya(double xi, double tau) {
  const double a = xi / (2 * std::sqrt(tau)), b = std::sqrt(tau);
  const double heat = 0.5 * (std::exp(tau - xi) * std::erfc(a - b) + std::exp(tau + xi) * std::erfc(a + b));
  return (tau > xi ? std::exp(tau - xi) : 0) - heat;
}

TEST(CoupledHalfSpace, IsDanilovskayasWithoutCoupling) {
  const CoupledHalfSpace space{0};
  for (double tau : {0.25, 1.0, 3.0, 10.0})
    for (double xi : {0.0, 0.5, 1.2, 3.1, 11.0}) {
      EXPECT_NEAR(space.temperature(xi, tau), std::erfc(xi / (2 * std::sqrt(tau))), k_inversion);
      EXPECT_NEAR(space.stress(xi, tau), danilovskaya(xi, tau), k_inversion) << xi << " " << tau;
    }
}

TEST(CoupledHalfSpace, IsCarslawAndJaegersFilmWithoutCoupling) {
  for (double film : {0.5, 5.0}) {
    const CoupledHalfSpace space{0, film};
    for (double tau : {0.25, 1.0, 3.0})
      for (double xi : {0.0, 0.5, 2.0}) {
        const double a = xi / (2 * std::sqrt(tau)), b = film * std::sqrt(tau);
        const double exact = std::erfc(a) - std::exp(film * xi + b * b) * std::erfc(a + b);
        EXPECT_NEAR(space.temperature(xi, tau), exact, k_inversion);
      }
  }
}

TEST(CoupledHalfSpace, TendsToTheUncoupledOneAsTheCouplingVanishes) {
  const CoupledHalfSpace space{0}, weak{1e-6};
  for (double xi : {0.5, 1.2, 2.0}) {
    EXPECT_NEAR(weak.temperature(xi, 1.5), space.temperature(xi, 1.5), 1e-6);
    EXPECT_NEAR(weak.displacement(xi, 1.5), space.displacement(xi, 1.5), 1e-6);
  }
}

TEST(CoupledHalfSpace, MeetsItsEquationsOnBothSidesOfTheFront) {
  constexpr double h = 1e-2;             // of the differences
  constexpr double k_difference = 1e-3;  // h² f''''/12 with derivatives of order one; noise k_inversion/h²
  for (double film : {std::numeric_limits<double>::infinity(), 2.0})
    for (double delta : k_couplings) {
      const CoupledHalfSpace space{delta, film};
      for (const auto& place : {std::pair{0.4, 1.5}, {1.0, 1.5}, {2.2, 1.5}, {1.5, 4.0}}) {
        const double xi = place.first, tau = place.second;
        const auto u_x = [&](double x, double t) {
          return first([&](double y) { return space.displacement(y, t); }, x, h);
        };
        const auto theta_x = [&](double x) { return space.temperature(x, tau); };
        const auto theta_t = [&](double t) { return space.temperature(xi, t); };
        const double u_tt = second([&](double t) { return space.displacement(xi, t); }, tau, h);
        const double sigma_x = first([&](double x) { return space.stress(x, tau); }, xi, h);
        EXPECT_NEAR(sigma_x, u_tt, k_difference) << delta << " " << xi << " " << tau;
        EXPECT_NEAR(space.stress(xi, tau), u_x(xi, tau) - space.temperature(xi, tau), k_difference);
        const double strain_rate = first([&](double t) { return u_x(xi, t); }, tau, h);
        EXPECT_NEAR(second(theta_x, xi, h), first(theta_t, tau, h) + delta * strain_rate, k_difference);
      }
    }
}

TEST(CoupledHalfSpace, KeepsItsSurfaceFreeAndAtTheTemperatureOrTheFluxGiven) {
  for (double delta : k_couplings)
    for (double tau : {0.5, 2.0}) {
      EXPECT_NEAR((CoupledHalfSpace{delta}.temperature(0, tau)), 1, k_inversion);
      for (double film : {0.5, 5.0}) {
        const CoupledHalfSpace space{delta, film};
        constexpr double h = 1e-3;
        const double slope =
            (-3 * space.temperature(0, tau) + 4 * space.temperature(h, tau) - space.temperature(2 * h, tau)) /
            (2 * h);
        EXPECT_NEAR(-slope, film * (1 - space.temperature(0, tau)), 2e-5);  // noise k_inversion/h
        EXPECT_NEAR(space.stress(0, tau), 0, k_inversion);
      }
    }
}

TEST(CoupledHalfSpace, HasAStressFrontThatDecaysWithHalfTheCoupling) {
  constexpr double k_near = 1e-6;
  for (double delta : k_couplings)
    for (double xi : {0.5, 1.5, 3.0}) {
      const CoupledHalfSpace space{delta};
      const double jump = space.stress(xi, xi + k_near) - space.stress(xi, xi - k_near);
      EXPECT_NEAR(jump, std::exp(-delta * xi / 2), 1e-5) << delta << " " << xi;
    }
}

TEST(CoupledHalfSpace, HasNoMomentum) {
  // no force acts on it: ∫ û dξ stays zero
  for (double delta : k_couplings) {
    const CoupledHalfSpace space{delta};
    constexpr double tau = 2;
    const auto u = [&](double xi) { return space.displacement(xi, tau); };
    const double behind = integral(u, 0, tau, 200), ahead = integral(u, tau, tau + 20, 1000);
    EXPECT_NEAR(behind + ahead, 0, 1e-5);
    EXPECT_GT(ahead, 0.1);  // of numbers that large
  }
}

TEST(HalfSpaceScales, AreThoseOfSteelAtRoomTemperature) {
  // E = 210 GPa, ν = 0.3, α = 1.2e-5: β = 3αK = 6.3 MPa/K, λ + 2μ = 282.7 GPa
  const analytic::HalfSpaceScales steel(45, 7800 * 460.0, 7800, 282.7e9, 6.3e6, 293, 1);
  EXPECT_NEAR(steel.length / steel.time, 6020, 1);  // speed of sound [m/s]
  EXPECT_NEAR(steel.length * steel.length / steel.time, 1.254e-5, 1e-8);
  EXPECT_NEAR(steel.coupling, 0.01146, 1e-4);
}

TEST(CoupledLayer, IsTheCosineSeriesWithoutCoupling) {
  const CoupledLayer layer(0, 2, 3);
  for (double x : {0.0, 1.0, 2.5})
    for (double t : {0.1, 1.0, 5.0}) {
      double exact = 1;
      for (int n = 0; n < 60; ++n) {
        const double nu = (n + 0.5) * std::numbers::pi;
        exact -= 2 * std::sin(nu) / nu * std::cos(nu * x / 3) * std::exp(-nu * nu * 2 * t / 9);
      }
      EXPECT_NEAR(layer.temperature(x, t), exact, 1e-12);
    }
}

TEST(CoupledLayer, IsTheInverseOfItsTransform) {
  for (double delta : k_couplings) {
    const CoupledLayer layer(delta, 1, 1);
    for (double x : {0.0, 0.4, 0.9})
      for (double t : {1e-3, 0.05, 0.5, 2.0}) {
        const auto transform = [&](Complex s) {
          const Complex q = std::sqrt((1 + delta) * s), mean = delta * std::sinh(q) / q;
          return (std::cosh(q * x) + mean) / (s * (std::cosh(q) + mean));
        };
        EXPECT_NEAR(layer.temperature(x, t), inverse_laplace(transform, 0, t), k_inversion) << delta;
      }
  }
}

TEST(CoupledLayer, MeetsItsEquationsAndItsWalls) {
  constexpr double h = 1e-3, diffusivity = 0.7, length = 2;
  for (double delta : k_couplings) {
    const CoupledLayer layer(delta, diffusivity, length);
    const auto mean = [&](double t) { return layer.mean_temperature(t); };
    for (double t : {0.2, 1.0}) {
      const auto theta = [&](double x) { return layer.temperature(x, t); };
      EXPECT_NEAR(theta(length), 1, 1e-12);
      EXPECT_NEAR(theta(0.0), theta(1e-5), 1e-9);  // insulated: no slope
      EXPECT_NEAR(integral(theta, 0, length, 200) / length, mean(t), 1e-7);
      EXPECT_NEAR(layer.displacement(length, t), 0, 1e-12);
      for (double x : {0.5, 1.4}) {
        const auto at = [&](double time) { return layer.temperature(x, time); };
        EXPECT_NEAR((1 + delta) * first(at, t, h) - delta * first(mean, t, h),
                    diffusivity * second(theta, x, h), 1e-4);
        const auto u = [&](double y) { return layer.displacement(y, t); };
        EXPECT_NEAR(first(u, x, h), theta(x) - mean(t), 1e-6);
      }
      // rigid walls do no work: all heat that enters raises the mean
      EXPECT_NEAR(length * first(mean, t, h), diffusivity * first(theta, length, h), 1e-4);
    }
  }
}

}  // namespace
}  // namespace solidus
