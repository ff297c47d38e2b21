/// Each law is a function of place whose numbers are known when the case is read.
#include "setup/load_laws.hpp"

#include <cmath>
#include <memory>
#include <utility>

namespace solidus::setup {

namespace {

class Metallostatic final : public PlaceLaw {
 public:
  Metallostatic(const std::array<double, 3>& gravity, double density, TimeFunction level,
                TimeFunction squeeze)
      : level_(std::move(level)), squeeze_(std::move(squeeze)) {
    const double g = std::hypot(gravity[0], gravity[1], gravity[2]);
    weight_ = density * g;
    for (std::size_t i = 0; i < 3; ++i) up_[i] = -gravity[i] / g;
  }
  bool uses_time() const override { return !level_.constant() || !squeeze_.constant(); }
  void values(std::span<const Position> x, double time, std::span<double> values) const override {
    const double level = level_.value(time), squeeze = squeeze_.value(time);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double depth = level - (x[i][0] * up_[0] + x[i][1] * up_[1] + x[i][2] * up_[2]);
      values[i] = depth > 0 ? weight_ * depth + squeeze : 0.0;
    }
  }

 private:
  TimeFunction level_, squeeze_;
  double weight_ = 0;  ///< ρ g [N/m³]
  std::array<double, 3> up_{};
};

class Centrifugal final : public PlaceLaw {
 public:
  Centrifugal(TimeFunction omega, const std::array<double, 3>& axis, const std::array<double, 3>& point,
              std::size_t component)
      : omega_(std::move(omega)), axis_(axis), point_(point), component_(component) {}
  bool uses_time() const override { return !omega_.constant(); }
  void values(std::span<const Position> x, double time, std::span<double> values) const override {
    const double omega = omega_.value(time);
    for (std::size_t i = 0; i < x.size(); ++i) {
      double along = 0;
      for (std::size_t k = 0; k < 3; ++k) along += (x[i][k] - point_[k]) * axis_[k];
      values[i] = omega * omega * (x[i][component_] - point_[component_] - along * axis_[component_]);
    }
  }

 private:
  TimeFunction omega_;
  std::array<double, 3> axis_, point_;
  std::size_t component_;
};

}  // namespace

PlaceFunction metallostatic_pressure(const std::array<double, 3>& gravity, double density, TimeFunction level,
                                     TimeFunction squeeze) {
  return PlaceFunction(
      std::make_shared<Metallostatic>(gravity, density, std::move(level), std::move(squeeze)));
}

PlaceFunction centrifugal_acceleration(const TimeFunction& omega, const std::array<double, 3>& axis,
                                       const std::array<double, 3>& point, std::size_t component) {
  return PlaceFunction(std::make_shared<Centrifugal>(omega, axis, point, component));
}

}  // namespace solidus::setup
