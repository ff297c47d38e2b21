/// Laws of surfaces: means over a part of a step at all points, and flux and slope at a temperature.
#include <algorithm>
#include <cmath>

#include "heat/loads/surface_heat.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

SurfaceLaw::SurfaceLaw(const Flux& flux) : law_{LoadLaw::Kind::power, {flux.factor, flux.value}} {}

SurfaceLaw::SurfaceLaw(const Film& film) : law_{LoadLaw::Kind::film, {film.factor, film.ambient}} {
  if (film.coefficient.of_temperature)
    of_temperature_ = film.coefficient.table.table();
  else
    law_.functions.insert(law_.functions.begin() + 1, film.coefficient.table);
}

SurfaceLaw::SurfaceLaw(const Radiation& radiation)
    : law_{LoadLaw::Kind::radiation, {radiation.factor, radiation.ambient}} {
  if (radiation.emissivity.of_temperature)
    of_temperature_ = radiation.emissivity.table.table();
  else
    law_.functions.insert(law_.functions.begin() + 1, radiation.emissivity.table);
  if (radiation.enclosed) enclosed_ = EnclosedSide{.of_temperature = of_temperature_};
}

SurfaceLaw::Now SurfaceLaw::now(const LoadValues& mean, double otherwise) const {
  if (law_.kind == LoadLaw::Kind::power) return {1, mean[0] - mean[1]};
  return {mean[0], law_.ambient(mean, otherwise)};
}

/// The mean over the window; of an exchange in a step of backward Euler that of LoadWindow::to_end.
LoadValues SurfaceLaw::mean_over(const LoadWindow& window) const {
  const LoadValues mean = mean_load(window, law_);
  if (!window.to_end || !exchanges(*this)) return mean;
  constexpr double k_inside = 1e-9;  // of the step: a formula may jump at its ends, where steps end
  const LoadWindow::Part& step = window.parts[0];
  const double inside = k_inside * (step.end - step.begin);
  const LoadValues begin = law_.values_at(step.begin + inside), end = law_.values_at(step.end - inside);
  LoadValues corrected = mean;
  for (std::size_t k = 0; k < mean.size(); ++k) corrected[k] += 0.5 * (end[k] - begin[k]);
  // Where the coefficient jumps within the step there is no straight line.
  const bool jumps = corrected[0] < 0.5 * std::min(begin[0], end[0]) ||
                     corrected[0] > 1.5 * std::max({begin[0], end[0], 0.0});
  return jumps ? mean : corrected;
}

void SurfaceLaw::set_window(const LoadWindow& window) {
  // What falls on an enclosed surface stays until it is told again; its emissivity and the opening follow
  // time.
  if (enclosed_) {
    const LoadValues mean = mean_over(window);
    const double ambient = law_.ambient(mean, law_.functions.back().value(window.time));
    enclosed_->factor = mean[0];
    enclosed_->environment = ambient * ambient * ambient * ambient;
    for (Now& point : now_) point.coefficient = mean[0];
    return;
  }
  // Without a dependence on position one value serves all points.
  const PlaceFunction& driver = law_.functions.back();
  if (!placed()) {
    const double at_end = driver.value(window.time);
    Now& everywhere = now_.emplace_back(now(mean_over(window), at_end));
    // Without rounding where it is the same all the time.
    if (exchanges(*this) && (window.n_parts == 0 || driver.steady())) everywhere.driver = at_end;
    now_.erase(now_.begin(), now_.end() - 1);
    return;
  }
  constexpr int k_points = 2;
  std::vector<LoadValues> means(points_.size());
  std::vector<std::vector<double>> values(law_.functions.size(), std::vector<double>(points_.size()));
  std::array<double, 3> of_functions{};
  // Means over the window by Gauss points in time; functions are evaluated for all places at once.
  for (const TimePoint& time : time_points(window, law_.pointers(), k_points)) {
    for (std::size_t f = 0; f < values.size(); ++f) law_.functions[f].values(points_, time.time, values[f]);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      for (std::size_t f = 0; f < values.size(); ++f) of_functions[f] = values[f][i];
      const LoadValues v = law_.values(std::span(of_functions).first(values.size()));
      for (std::size_t k = 0; k < v.size(); ++k) means[i][k] += time.weight * v[k];
    }
  }
  set_values(means);
}

void SurfaceLaw::set_values(std::span<const LoadValues> means) {
  // Where nothing is exchanged the ambient temperature counts for nothing but the range of temperatures.
  double otherwise = 0;
  for (const LoadValues& mean : means) otherwise = std::max(otherwise, law_.ambient(mean, 0));
  now_.resize(means.size());
  for (std::size_t i = 0; i < means.size(); ++i) now_[i] = now(means[i], otherwise);
}

SurfaceFlux SurfaceLaw::at(double temperature, std::size_t point) const {
  // A prescribed flux has no slope; exchange has that of its drive and of a coefficient that
  // depends on temperature.
  const Now& n = now_[placed() ? point : 0];
  if (!exchanges(*this)) return {n.driver, 0.0};
  const bool varies = of_temperature_.has_value();
  const double c = varies ? n.coefficient * of_temperature_->value(temperature) : n.coefficient;
  const double c_slope = varies ? n.coefficient * of_temperature_->derivative(temperature) : 0.0;
  double drive = 0, drive_slope = 0;
  if (law_.kind == LoadLaw::Kind::film) {
    drive = n.driver - temperature;
    drive_slope = -1.0;
  } else {
    // Θ|Θ|³ instead of Θ⁴: the same above absolute zero, and rising everywhere an iterate may stray.
    const double cube = k_stefan_boltzmann * std::abs(temperature * temperature * temperature);
    const double ambient = n.driver * n.driver;
    // The driver of radiation is Θ_∞², so that its square is the fourth power.
    drive = k_stefan_boltzmann * ambient * ambient - cube * temperature;
    drive_slope = -4.0 * cube;
  }
  const double slope = c * drive_slope + c_slope * drive;
  return {c * drive, slope <= 0 ? slope : c * drive_slope};
}

std::optional<TemperatureRange> SurfaceLaw::ambient() const {
  if (!exchanges(*this)) return std::nullopt;
  TemperatureRange range;
  for (const Now& n : now_) {
    range.lowest = std::min(range.lowest, n.driver);
    range.highest = std::max(range.highest, n.driver);
  }
  return range;
}

}  // namespace solidus::heat
