#include "heat/loads/channel_fluid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace solidus::heat {

namespace {

/// Saturated liquid: Θ [K], ρ [kg/m³], c [J/(kg K)], k [W/(m K)], μ [Pa s].
constexpr std::array<std::array<double, 5>, 21> k_water = {
    {{273.16, 999.79, 4219.9, 0.55560, 1.7914e-03}, {283.15, 999.65, 4195.8, 0.57871, 1.3060e-03},
     {293.15, 998.16, 4185.1, 0.59795, 1.0016e-03}, {303.15, 995.61, 4180.3, 0.61434, 7.9722e-04},
     {313.15, 992.18, 4178.8, 0.62845, 6.5272e-04}, {323.15, 988.01, 4179.8, 0.64059, 5.4650e-04},
     {333.15, 983.18, 4182.9, 0.65098, 4.6602e-04}, {343.15, 977.75, 4188.2, 0.65974, 4.0354e-04},
     {353.15, 971.78, 4195.6, 0.66698, 3.5404e-04}, {363.15, 965.30, 4205.1, 0.67278, 3.1417e-04},
     {373.15, 958.35, 4216.6, 0.67722, 2.8159e-04}, {383.15, 950.95, 4230.4, 0.68035, 2.5461e-04},
     {393.15, 943.11, 4246.4, 0.68224, 2.3203e-04}, {403.15, 934.83, 4264.8, 0.68295, 2.1294e-04},
     {413.15, 926.13, 4286.0, 0.68252, 1.9664e-04}, {423.15, 917.01, 4310.3, 0.68101, 1.8261e-04},
     {433.15, 907.45, 4337.9, 0.67873, 1.7043e-04}, {453.15, 887.01, 4405.6, 0.67128, 1.5038e-04},
     {473.15, 864.67, 4494.0, 0.66003, 1.3459e-04}, {493.15, 840.23, 4610.7, 0.64527, 1.2177e-04},
     {523.15, 798.89, 4865.0, 0.61688, 1.0628e-04}}};

Table column(std::size_t number) {
  std::vector<double> x, y;
  for (const auto& row : k_water) {
    x.push_back(row[0]);
    y.push_back(row[number]);
  }
  return {std::move(x), std::move(y)};
}

}  // namespace

double ChannelFluid::prandtl(double temperature) const {
  return viscosity.value(temperature) * specific_heat.value(temperature) / conductivity.value(temperature);
}

double ChannelFluid::heated(double from, double heat) const {
  // ∫ c dΘ rises with Θ and has the slope c: Newton's method converges from the first guess on.
  constexpr int k_most = 50;
  constexpr double k_same = 1e-13;
  double temperature = from + heat / specific_heat.value(from);
  if (specific_heat.constant()) return temperature;
  for (int i = 0; i < k_most; ++i) {
    const double off = specific_heat.integral(from, temperature) - heat;
    const double step = off / specific_heat.value(temperature);
    temperature -= step;
    if (std::abs(step) <= k_same * temperature) break;
  }
  return temperature;
}

const ChannelFluid& water() {
  static const ChannelFluid fluid{column(1), column(2), column(3), column(4)};
  return fluid;
}

double boiling_point_of_water(double pressure) {
  // Coefficients n_1 to n_10 of table 34.
  constexpr std::array n{0.11670521452767e4,  -0.72421316703206e6, -0.17073846940092e2, 0.12020824702470e5,
                         -0.32325550322333e7, 0.14915108613530e2,  -0.48232657361591e4, 0.40511340542057e6,
                         -0.23855557567849e0, 0.65017534844798e3};
  constexpr double k_lowest = 611.213, k_highest = 22.064e6, k_unit = 1e6;
  const double beta = std::sqrt(std::sqrt(std::clamp(pressure, k_lowest, k_highest) / k_unit));
  const double e = beta * beta + n[2] * beta + n[5], f = n[0] * beta * beta + n[3] * beta + n[6],
               g = n[1] * beta * beta + n[4] * beta + n[7];
  const double d = 2 * g / (-f - std::sqrt(f * f - 4 * e * g));
  return 0.5 * (n[9] + d - std::sqrt((n[9] + d) * (n[9] + d) - 4 * (n[8] + n[9] * d)));
}

}  // namespace solidus::heat
