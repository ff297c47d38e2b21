/// The dynamic coupled half space of Danilovskaya, Nickell and Sackman (analytic/coupled_half_space.hpp): the
/// surface is heated at once, or smoothly as sin² over the time that the wave takes to ξ = 1, where
/// temperature, displacement and stress are compared. Strip of five lengths, whose far end is not felt there
/// until τ = 2.5: the wave comes back at τ = 9, heat as from ξ = 10, erfc(9/√10) = 6e-5.
#include <gtest/gtest.h>

#include <numbers>

#include "analytic/coupled_half_space.hpp"
#include "linear_strip.hpp"

namespace solidus {
namespace {

using mechanics::DynamicsOptions;
using mechanics::Mapping;
using mechanics::MassKind;
using mechanics::Motion;
using verification::Coupled;
using verification::LinearSolid;
using verification::StripFields;
using verification::StripScheme;

constexpr double k_length = 5, k_end = 2.5;
constexpr int k_samples = 50;
constexpr double k_rise = 1;  // of the surface temperature, if it is smooth

enum class Heating { smooth, at_once };

struct Resolution {
  int quads, steps;
};
/// The split lags by a step, which must be small against the rise of the stress; a jump asks for short
/// elements that the wave passes in few steps, as the integrator damps only what changes within some of them.
constexpr Resolution resolution(Heating heating) {
  return heating == Heating::smooth ? Resolution{150, 1500} : Resolution{400, 800};
}

const StripScheme k_isentropic{"isentropic", Mapping::isentropic};
const StripScheme k_isothermal{"isothermal", Mapping::isothermal};
const StripScheme k_simultaneous{"simultaneous", Mapping::simultaneous};

/// At ξ = 1, one entry a sample.
struct History {
  std::vector<double> time, temperature, displacement, stress;
};

Table surface_temperature(Heating heating) {
  if (heating == Heating::at_once) return LinearSolid::k_start + LinearSolid::k_rise;
  constexpr int pieces = 200;
  std::vector<double> time, value;
  for (int i = 0; i <= pieces; ++i) {
    const double s = std::sin(0.5 * std::numbers::pi * i / pieces);
    time.push_back(k_rise * i / pieces);
    value.push_back(LinearSolid::k_start + LinearSolid::k_rise * s * s);
  }
  return {time, value};
}

History half_space(double delta, const StripScheme& scheme, Heating heating) {
  const LinearSolid solid{delta};
  const auto [quads, steps] = resolution(heating);
  Coupled c = verification::linear_strip(solid, scheme, k_length, quads);
  c.thermal.temperatures.push_back({"hot", "left", surface_temperature(heating)});
  c.dynamics = DynamicsOptions{MassKind::consistent, Motion::generalised_alpha(0.5), {}};
  const int every = steps / k_samples;
  const double dt = k_end / steps;
  const std::size_t at = static_cast<std::size_t>(quads / k_length);  // ξ = 1
  History h;
  verification::march_strip(c, solid, dt, steps, [&](int n, const StripFields& f) {
    if (n % every != 0) return;
    h.time.push_back(n * dt);
    h.temperature.push_back(f.temperature[at]);
    h.displacement.push_back(f.displacement[at]);
    h.stress.push_back(0.5 * (f.stress[at - 1] + f.stress[at]));
  });
  return h;
}

/// Simpson's rule.
template <class F>
double integral(const F& f, double from, double to) {
  constexpr int intervals = 16;
  const double h = (to - from) / intervals;
  double sum = f(from) + f(to);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(from + i * h);
  return sum * h / 3;
}

/// Duhamel: the answers to small steps of the surface temperature, on each side of the front's jump.
template <class F>
double answer(const F& to_step, double tau, Heating heating) {
  if (heating == Heating::at_once) return to_step(tau);
  constexpr double front = 1, k_beside = 1e-9, pi = std::numbers::pi;
  const auto part = [&](double t) {
    return 0.5 * pi * std::sin(pi * (tau - t) / k_rise) / k_rise * to_step(t);
  };
  const double from = std::max(0.0, tau - k_rise);
  if (from < front && front < tau)
    return integral(part, from, front - k_beside) + integral(part, front + k_beside, tau);
  return integral(part, from, tau);
}

History exact(double delta, const std::vector<double>& time, Heating heating) {
  const analytic::CoupledHalfSpace space{delta};
  History h;
  for (const double tau : time) {
    h.time.push_back(tau);
    h.temperature.push_back(answer([&](double t) { return space.temperature(1, t); }, tau, heating));
    h.displacement.push_back(answer([&](double t) { return space.displacement(1, t); }, tau, heating));
    h.stress.push_back(answer([&](double t) { return space.stress(1, t); }, tau, heating));
  }
  return h;
}

/// The largest difference over the largest value, at least `beside` from the front at τ = 1.
double difference(const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& time,
                  double beside) {
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(b[i]));
    if (std::abs(time[i] - 1) >= beside) worst = std::max(worst, std::abs(a[i] - b[i]));
  }
  return worst / largest;
}

struct Difference {
  double temperature, displacement, stress;
};
Difference difference(const History& a, const History& b, double beside) {
  return {difference(a.temperature, b.temperature, a.time, beside),
          difference(a.displacement, b.displacement, a.time, beside),
          difference(a.stress, b.stress, a.time, beside)};
}

/// Without coupling heat does not feel the strain.
const StripScheme& split(double delta) {
  return delta == 0 ? k_isothermal : k_isentropic;
}
const std::vector<double> k_couplings{0, 0.05, 0.36, 1};

constexpr double k_one_percent = 0.01;  // of the largest value

/// Results of the split, for the pictures.
class Curves {
 public:
  void add(const History& exact, const History& computed) {
    histories_.push_back(exact);
    histories_.push_back(computed);
  }
  void write(const std::string& heating) const {
    for (const auto& [name, field] :
         {std::pair{"temperature", &History::temperature}, std::pair{"displacement", &History::displacement},
          std::pair{"stress", &History::stress}}) {
      auto out = verification::table("coupling_half_space_" + heating + "_" + name,
                                     "time[a/c²],exact_δ_0,computed_δ_0,exact_δ_0.05,computed_δ_0.05,"
                                     "exact_δ_0.36,computed_δ_0.36,exact_δ_1,computed_δ_1");
      for (std::size_t i = 0; i < histories_.front().time.size(); ++i) {
        out << histories_.front().time[i];
        for (const History& history : histories_) out << "," << (history.*field)[i];
        out << "\n";
      }
    }
  }

 private:
  std::vector<History> histories_;
};

void write(std::ofstream& out, double delta, const StripScheme& scheme, const Difference& d) {
  out << delta << "," << scheme.name << "," << d.temperature << "," << d.displacement << "," << d.stress
      << "\n";
}
constexpr const char* k_columns = "delta,scheme,T[largest],u[largest],stress[largest]";

TEST(CoupledHalfSpace, IsDanilovskayasAndNickellAndSackmansUnderSmoothHeating) {
  auto out = verification::table("coupling_half_space_smooth", k_columns);
  Curves curves;
  for (const double delta : k_couplings) {
    std::vector<StripScheme> schemes{split(delta)};
    if (delta > 0) schemes.push_back(k_simultaneous);
    if (delta > 0 && delta < 1) schemes.push_back(k_isothermal);
    History there;
    for (const StripScheme& scheme : schemes) {
      SCOPED_TRACE(scheme.name + " " + std::to_string(delta));
      const History here = half_space(delta, scheme, Heating::smooth);
      if (there.time.empty()) {
        there = exact(delta, here.time, Heating::smooth);
        curves.add(there, here);
      }
      const Difference d = difference(here, there, 0);
      EXPECT_LT(d.temperature, k_one_percent);
      EXPECT_LT(d.displacement, k_one_percent);
      EXPECT_LT(d.stress, k_one_percent);
      write(out, delta, scheme, d);
    }
  }
  curves.write("smooth");
}

// The stress jumps at the front, where elements ring. The split spreads the jump: where conduction is fast,
// the heat of straining that it holds back for a step acts like a viscosity of δ (λ+2μ) Δt. Temperature and
// displacement have kinks there.
TEST(CoupledHalfSpace, IsDanilovskayasAndNickellAndSackmansUnderAStepBesideItsFront) {
  constexpr double k_beside = 0.2;
  auto out = verification::table("coupling_half_space_step", k_columns);
  Curves curves;
  for (const double delta : k_couplings) {
    SCOPED_TRACE(delta);
    const History here = half_space(delta, split(delta), Heating::at_once);
    const History there = exact(delta, here.time, Heating::at_once);
    curves.add(there, here);
    const Difference d = difference(here, there, k_beside);
    EXPECT_LT(d.temperature, k_one_percent);
    EXPECT_LT(d.displacement, k_one_percent);
    EXPECT_LT(d.stress, k_one_percent);
    write(out, delta, split(delta), d);
  }
  curves.write("step");
}

}  // namespace
}  // namespace solidus
